#include "motus/snow/layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "holding.hpp"
#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"

namespace motus::snow {
namespace {

constexpr int none = -1;

[[nodiscard]] std::size_t vertex(const glm::ivec3& corners, std::size_t corner) {
    return static_cast<std::size_t>(corners[static_cast<int>(corner % 3)]);
}

void check(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles) {
    constexpr std::size_t most_triangles = std::size_t{1} << 29U;
    require(triangles.size() < most_triangles, "layer_triangles must be less than 2^29");
    for (const glm::vec3& position : positions)
        require(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z),
                "layer_positions must be finite");
    for (const glm::ivec3& corners : triangles)
        for (int i = 0; i < 3; ++i)
            require(corners[i] >= 0 && static_cast<std::size_t>(corners[i]) < positions.size(),
                    "layer_triangles must hold indices of vertices");
}

/// Goes through edges, there and back in turn, until none of them changes anything: heaps are narrow where
/// they are too steep, and a few rounds do.
template <class Change>
void there_and_back(std::size_t count, const Change& change) {
    constexpr int most_rounds = 32;
    bool has_changed = true;
    for (int round = 0; round < most_rounds && has_changed; ++round) {
        has_changed = false;
        for (std::size_t i = 0; i < count; ++i)
            if (change(round % 2 == 0 ? i : count - 1 - i, round)) has_changed = true;
    }
}

}  // namespace

Layer::Layer(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
             const glm::dvec3& up, const Collider* shelter, double hold) {
    check(positions, triangles);
    require(direction_of(up).has_value(), "up must be finite and not 0");
    positions_.assign(positions.begin(), positions.end());
    triangles_.assign(triangles.begin(), triangles.end());
    in_ieee_floats([&] {
        std::vector<glm::dvec3> normals(positions_.size());
        for (const glm::ivec3& corners : triangles_) {
            const auto place = [&](std::size_t i) { return glm::dvec3(positions_[vertex(corners, i)]); };
            const glm::dvec3 across = glm::cross(place(1) - place(0), place(2) - place(0));
            for (std::size_t corner = 0; corner < 3; ++corner) normals[vertex(corners, corner)] += across;
        }
        normals_.resize(normals.size());
        is_upright_.resize(normals.size());
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const double length = length_of(normals[i]);
            if (!(length > 0.0)) continue;
            const bool is_upright = glm::dot(normals[i], up) >= 0.0;
            is_upright_[i] = is_upright ? 1 : 0;
            normals_[i] = glm::vec3((is_upright ? 1.0 : -1.0) / length * normals[i]);
        }
    });

    struct Side {
        std::uint64_t ends = 0;
        std::uint32_t triangle = 0, side = 0;
    };
    std::vector<Side> all;
    all.reserve(3 * triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        for (std::uint32_t side = 0; side < 3; ++side) {
            const std::uint64_t a = vertex(triangles_[i], side), b = vertex(triangles_[i], side + 1);
            all.push_back({(std::min(a, b) << 32U) | std::max(a, b), static_cast<std::uint32_t>(i), side});
        }
    }
    std::ranges::sort(all, [](const Side& a, const Side& b) {
        return a.ends != b.ends           ? a.ends < b.ends
               : a.triangle != b.triangle ? a.triangle < b.triangle
                                          : a.side < b.side;
    });
    sides_.resize(triangles_.size());
    for (std::size_t first = 0; first < all.size();) {
        std::size_t last = first;
        for (; last < all.size() && all[last].ends == all[first].ends; ++last)
            sides_[all[last].triangle][static_cast<int>(all[last].side)] = static_cast<int>(edges_.size());
        edges_.emplace_back(static_cast<int>(all[first].ends >> 32U),
                            static_cast<int>(static_cast<std::uint32_t>(all[first].ends)));
        const auto end = [&](int i) {
            return glm::dvec3(positions_[static_cast<std::size_t>(edges_.back()[i])]);
        };
        lengths_.push_back(static_cast<float>(length_of(end(1) - end(0))));
        if (last == first + 1) loose_.push_back({all[first].triangle, all[first].side});
        first = last;
    }
    ends_.assign(edges_.size(), -1.0F);
    in_ieee_floats([&] {
        if (shelter != nullptr) find_ends(*shelter, unit_vector(up), hold);
        measure();
    });
}

void Layer::find_ends(const Collider& shelter, const glm::dvec3& up, double hold) {
    const Holding holding = holding_of(positions_, triangles_, shelter, up, hold, thread_count());
    constexpr std::size_t grain = 256;
    in_parts(edges_.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto from = static_cast<std::size_t>(edges_[i].x),
                       to = static_cast<std::size_t>(edges_[i].y);
            ends_[i] = end_on_edge(holding, positions_, shelter, up, from, to).value_or(-1.0F);
        }
    });
}

/// How much snow lies on each vertex for each metre of depth, and which edges it has.
void Layer::measure() {
    std::vector<double> areas(positions_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const auto place = [&](std::size_t corner) {
            return glm::dvec3(positions_[vertex(triangles_[i], corner)]);
        };
        const double third = length_of(glm::cross(place(1) - place(0), place(2) - place(0))) / 6.0;
        std::array<std::optional<float>, 3> ends;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto side = static_cast<std::size_t>(sides_[i][static_cast<int>(corner)]);
            if (ends_[side] < 0.0F) continue;
            const bool is_along = static_cast<std::size_t>(edges_[side].x) == vertex(triangles_[i], corner);
            ends.at(corner) = is_along ? ends_[side] : 1.0F - ends_[side];
        }
        const std::array<double, 3> parts = shown_parts(ends);
        for (std::size_t corner = 0; corner < 3; ++corner)
            areas[vertex(triangles_[i], corner)] += parts.at(corner) * third;
    }
    areas_.assign(areas.begin(), areas.end());

    spoke_starts_.assign(positions_.size() + 1, 0);
    for (const glm::ivec2& edge : edges_)
        for (int end = 0; end < 2; ++end) ++spoke_starts_[static_cast<std::size_t>(edge[end]) + 1];
    for (std::size_t i = 1; i < spoke_starts_.size(); ++i) spoke_starts_[i] += spoke_starts_[i - 1];
    spokes_.resize(spoke_starts_.back());
    std::vector<std::uint32_t> next(spoke_starts_.begin(), spoke_starts_.end() - 1);
    for (std::size_t i = 0; i < edges_.size(); ++i)
        for (int end = 0; end < 2; ++end)
            spokes_[next[static_cast<std::size_t>(edges_[i][end])]++] = static_cast<std::uint32_t>(i);
}

/// Collects the triangles that are shown, with their vertices and edges numbered anew.
class Layer::Builder {
  public:
    Builder(const Layer& layer, std::span<const float> depths, float thinnest)
        : layer_(layer),
          depths_(depths),
          thinnest_(thinnest),
          vertices_(layer.positions_.size(), none),
          feet_(layer.positions_.size(), none),
          rims_(layer.positions_.size(), none),
          posts_(layer.positions_.size(), none),
          edges_(layer.edges_.size(), none),
          cuts_(layer.edges_.size(), none) {}

    [[nodiscard]] Mesh build() {
        for (std::size_t i = 0; i < layer_.triangles_.size(); ++i)
            if (!is_degenerate(layer_.triangles_[i])) show(i);
        for (const Loose& loose : layer_.loose_) close(loose);
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] static bool is_degenerate(const glm::ivec3& corners) {
        return corners.x == corners.y || corners.y == corners.z || corners.z == corners.x;
    }
    [[nodiscard]] bool is_deep(std::size_t at) const { return depths_[at] > thinnest_; }

    [[nodiscard]] int add(const glm::vec3& position, float depth) {
        mesh_.positions.push_back(position);
        mesh_.depths.push_back(depth);
        return static_cast<int>(mesh_.positions.size() - 1);
    }
    [[nodiscard]] int add_edge(int a, int b) {
        mesh_.edges.emplace_back(a, b);
        return static_cast<int>(mesh_.edges.size() - 1);
    }
    void add_triangle(const glm::ivec3& corners, const glm::ivec3& sides) {
        mesh_.triangles.push_back(corners);
        mesh_.sides.push_back(sides);
    }

    /// The part of a triangle that lies on the deep side of the line along which the layer is cut.
    void show(std::size_t index) {
        const glm::ivec3 &corners = layer_.triangles_[index], &sides = layer_.sides_[index];
        std::array<int, 4> around{}, edges{};  // the edges leave the vertices
        std::size_t count = 0;
        const auto go = [&](int at, int edge) {
            if (count > 0 && around.at(count - 1) == at) --count;
            around.at(count) = at;
            edges.at(count++) = edge;
        };
        // From the first deep corner on, so that a quadrilateral is divided as Cover has its volume.
        std::size_t start = 0;
        while (start < 2 && !(is_deep(vertex(corners, start)) && !is_deep(vertex(corners, start + 2))))
            ++start;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t corner = (start + i) % 3;
            const std::size_t a = vertex(corners, corner), b = vertex(corners, corner + 1);
            const int side = sides[static_cast<int>(corner)];
            if (is_deep(a)) go(top(a), is_deep(b) ? edge(side) : part(side));
            if (is_deep(a) && !is_deep(b)) go(cut(side), none);
            if (!is_deep(a) && is_deep(b)) go(cut(side), part(side));
        }
        if (count < 3) return;
        for (std::size_t i = 0; i < count; ++i)
            if (edges.at(i) == none) edges.at(i) = border(around.at(i), around.at((i + 1) % count), index);
        if (count == 3) {
            add_triangle({around[0], around[1], around[2]}, {edges[0], edges[1], edges[2]});
            return;
        }
        const int across = add_edge(around[0], around[2]);
        add_triangle({around[0], around[1], around[2]}, {edges[0], edges[1], across});
        add_triangle({around[0], around[2], around[3]}, {across, edges[2], edges[3]});
    }

    /// Where no snow lies: under the surface, if that tells which of its sides is the upper one.
    [[nodiscard]] float sunk(std::size_t at) const { return layer_.is_upright_[at] != 0 ? -thinnest_ : 0.0F; }

    [[nodiscard]] int top(std::size_t at) {
        if (vertices_[at] != none) return vertices_[at];
        const float depth = depths_[at];
        // From the surface, at the thinnest that is shown, to the depth itself.
        const float share = depth < 2.0F * thinnest_ ? std::max(0.0F, depth / (2.0F * thinnest_)) : 1.0F;
        const float off = share * depth + (1.0F - share) * sunk(at);
        return vertices_[at] = add(layer_.positions_[at] + off * layer_.normals_[at], depth);
    }
    [[nodiscard]] int foot(std::size_t at) {
        if (feet_[at] == none) feet_[at] = add(layer_.positions_[at] + sunk(at) * layer_.normals_[at], 0.0F);
        return feet_[at];
    }
    [[nodiscard]] int post(std::size_t at) {
        if (posts_[at] == none) posts_[at] = add_edge(top(at), foot(at));
        return posts_[at];
    }
    [[nodiscard]] int edge(int index) {
        const auto at = static_cast<std::size_t>(index);
        if (edges_[at] == none) {
            const glm::ivec2& ends = layer_.edges_[at];
            edges_[at] =
                add_edge(top(static_cast<std::size_t>(ends.x)), top(static_cast<std::size_t>(ends.y)));
        }
        return edges_[at];
    }
    /// The part of an edge up to where the layer is cut.
    [[nodiscard]] int part(int index) {
        const auto at = static_cast<std::size_t>(index);
        if (edges_[at] == none) {
            const glm::ivec2& ends = layer_.edges_[at];
            const auto x = static_cast<std::size_t>(ends.x), y = static_cast<std::size_t>(ends.y);
            edges_[at] = add_edge(top(is_deep(x) ? x : y), cut(index));
        }
        return edges_[at];
    }
    /// Where the layer ends within a triangle, from one cut to the other; between bare vertices that is one
    /// of the triangle's sides, which the triangle beyond may share.
    [[nodiscard]] int border(int a, int b, std::size_t triangle) {
        const glm::ivec3& corners = layer_.triangles_[triangle];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            if (rims_[vertex(corners, corner)] != a || rims_[vertex(corners, corner + 1)] != b) continue;
            int& found = edges_[static_cast<std::size_t>(layer_.sides_[triangle][static_cast<int>(corner)])];
            if (found == none) found = add_edge(a, b);
            return found;
        }
        return add_edge(a, b);
    }

    /// Where the layer is cut on an edge, one end of which is deep: on the surface, as deep as what is
    /// hidden at most.
    [[nodiscard]] int cut(int index) {
        const auto at = static_cast<std::size_t>(index);
        if (cuts_[at] != none) return cuts_[at];
        const auto x = static_cast<std::size_t>(layer_.edges_[at].x);
        const auto y = static_cast<std::size_t>(layer_.edges_[at].y);
        const float part = layer_.ends_[at] >= 0.0F ? layer_.ends_[at]
                                                    : (depths_[x] - thinnest_) / (depths_[x] - depths_[y]);
        // At a bare vertex all cuts are one.
        constexpr float near = 1e-3F;
        if (const float left = is_deep(x) ? 1.0F - part : part; left < near)
            return cuts_[at] = rim(is_deep(x) ? y : x);
        return cuts_[at] = add(glm::mix(layer_.positions_[x], layer_.positions_[y], part), thinnest_);
    }
    [[nodiscard]] int rim(std::size_t at) {
        if (rims_[at] == none) rims_[at] = add(layer_.positions_[at], depths_[at]);
        return rims_[at];
    }

    /// A wall from a loose edge of what is shown down to the surface.
    void close(const Loose& loose) {
        const glm::ivec3& corners = layer_.triangles_[loose.triangle];
        const std::size_t a = vertex(corners, loose.side), b = vertex(corners, loose.side + 1);
        if (is_degenerate(corners) || !(is_deep(a) || is_deep(b))) return;
        const int side = layer_.sides_[loose.triangle][static_cast<int>(loose.side)];
        if (is_deep(a) && is_deep(b)) {
            const int under = add_edge(foot(a), foot(b)), across = add_edge(top(a), foot(b));
            add_triangle({top(b), top(a), foot(b)}, {edge(side), across, post(b)});
            add_triangle({top(a), foot(a), foot(b)}, {post(a), under, across});
            return;
        }
        const int end = cut(side);
        const std::size_t deep = is_deep(a) ? a : b;
        const int above = part(side), under = add_edge(foot(deep), end);
        if (is_deep(a))
            add_triangle({end, top(a), foot(a)}, {above, post(a), under});
        else
            add_triangle({top(b), end, foot(b)}, {above, under, post(b)});
    }

    const Layer& layer_;
    std::span<const float> depths_;
    float thinnest_;
    std::vector<int> vertices_, feet_, rims_, posts_, edges_, cuts_;  ///< new numbers, or `none`
    Mesh mesh_;
};

bool Layer::is_too_steep(std::size_t edge, std::span<const float> depths, float steepest) const {
    const float a = depths[static_cast<std::size_t>(edges_[edge].x)];
    const float b = depths[static_cast<std::size_t>(edges_[edge].y)];
    return std::abs(a - b) > steepest * lengths_[edge];
}

/// Hands on to lower vertices what is too high, over edges on which snow does not end: volumes stay.
class Layer::Spreading {
  public:
    Spreading(const Layer& layer, std::vector<float>& depths, float steepest)
        : layer_(layer), depths_(depths), steepest_(steepest) {}

    void run() {
        // Beside the line at which snow ends more rounds gain nothing.
        constexpr int rounds_at_ends = 6;
        there_and_back(layer_.edges_.size(), [&](std::size_t edge, int round) {
            if (layer_.ends_[edge] >= 0.0F && round >= rounds_at_ends) return false;
            return layer_.is_too_steep(edge, depths_, steepest_) && lower(edge);
        });
    }

  private:
    /// A little less steep than may be, so that there is an end to it.
    static constexpr float slack = 0.02F;

    /// Whether anything was handed on.
    [[nodiscard]] bool lower(std::size_t edge) {
        const auto x = static_cast<std::size_t>(layer_.edges_[edge].x);
        const auto y = static_cast<std::size_t>(layer_.edges_[edge].y);
        const std::size_t high = depths_[x] > depths_[y] ? x : y, low = high == x ? y : x;
        const float most = steepest_ * layer_.lengths_[edge], aim = (1.0F - slack) * most;
        if (layer_.ends_[edge] < 0.0F) {
            return hand_on(high, low, aim, std::numeric_limits<float>::infinity());
        }
        // Nothing goes over the line at which snow ends, so it goes to what is lower on this side.
        const float goal = depths_[low] + aim;
        bool has_changed = false;
        for (std::size_t i = layer_.spoke_starts_[high]; i < layer_.spoke_starts_[high + 1]; ++i) {
            const std::size_t spoke = layer_.spokes_[i];
            if (layer_.ends_[spoke] >= 0.0F) continue;
            const glm::ivec2& ends = layer_.edges_[spoke];
            const auto other =
                static_cast<std::size_t>(static_cast<std::size_t>(ends.x) == high ? ends.y : ends.x);
            if (depths_[high] > goal && depths_[high] - depths_[other] > slack * most)
                has_changed |= hand_on(high, other, 0.0F, depths_[high] - goal);
        }
        return has_changed;
    }

    /// Until the higher one of two vertices is `above` the lower one, or has become lower by `most`.
    [[nodiscard]] bool hand_on(std::size_t high, std::size_t low, float above, float most) {
        const double here = static_cast<double>(layer_.areas_[high]);
        const double there = static_cast<double>(layer_.areas_[low]);
        if (!(here > 0.0) || !(there > 0.0)) return false;
        const double top = static_cast<double>(depths_[high]), bottom = static_cast<double>(depths_[low]);
        const double over = top - bottom - static_cast<double>(above);
        const double change = std::min(static_cast<double>(most), there / (here + there) * over);
        depths_[high] = static_cast<float>(top - change);
        depths_[low] = static_cast<float>(bottom + here / there * change);
        return true;
    }

    const Layer& layer_;
    std::vector<float>& depths_;
    float steepest_;
};

void Layer::fall_off(std::vector<float>& depths, float steepest) const {
    Spreading(*this, depths, steepest).run();
    there_and_back(edges_.size(), [&](std::size_t edge, int) {
        float& a = depths[static_cast<std::size_t>(edges_[edge].x)];
        float& b = depths[static_cast<std::size_t>(edges_[edge].y)];
        const float most = steepest * lengths_[edge];
        if (a > b + most)
            a = b + most;
        else if (b > a + most)
            b = a + most;
        else
            return false;
        return true;
    });
}

Layer::Mesh Layer::at(std::span<const float> depths, float thinnest, float steepest) const {
    require(depths.size() == positions_.size(), "depths must be as many as the vertices");
    require(std::ranges::all_of(depths, [](float depth) { return std::isfinite(depth); }),
            "depths must be finite");
    require(thinnest >= 0.0F && std::isfinite(thinnest), "thinnest must be at least 0 and finite");
    require(steepest > 0.0F, "steepest must be greater than 0");
    return in_ieee_floats([&] {
        std::vector<float> fallen(depths.begin(), depths.end());
        fall_off(fallen, steepest);
        return Builder(*this, fallen, thinnest).build();
    });
}

}  // namespace motus::snow
