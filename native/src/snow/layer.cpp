#include "motus/snow/layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "heaps.hpp"
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

[[nodiscard]] bool is_degenerate(const glm::ivec3& corners) {
    return corners.x == corners.y || corners.y == corners.z || corners.z == corners.x;
}

void check(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles) {
    constexpr std::size_t most_triangles = std::size_t{1} << 29U;
    require(triangles.size() < most_triangles, "layer_triangles: must be less than 2^29");
    for (const glm::vec3& position : positions)
        require(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z),
                "layer_positions: must be finite");
    for (const glm::ivec3& corners : triangles)
        for (int i = 0; i < 3; ++i)
            require(corners[i] >= 0 && static_cast<std::size_t>(corners[i]) < positions.size(),
                    "layer_triangles: must hold indices of vertices");
}

}  // namespace

SnowLayer::SnowLayer(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                     const glm::dvec3& up, const Collider* shelter, double hold, const Executor& executor) {
    check(positions, triangles);
    require(direction_of(up).has_value(), "up: must be finite and not 0");
    require(hold >= 0.0, "hold: must be at least 0");
    number(positions, triangles);
    in_ieee_floats([&] { find_normals(up); });
    find_edges();
    ends_.assign(edges_.size(), -1.0F);
    in_ieee_floats([&] {
        if (shelter != nullptr) find_ends(*shelter, unit_vector(up), hold, executor);
        heaps_ = std::make_shared<const Heaps>(
            Heaps::Net{positions_, numbers_, triangles_, edges_, sides_, ends_});
    });
    leave_out_degenerate();
}

void SnowLayer::number(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles) {
    vertex_count_ = positions.size();
    std::vector<int> found(positions.size(), none);
    numbers_.reserve(positions.size());
    positions_.reserve(positions.size());
    triangles_.reserve(triangles.size());
    for (glm::ivec3 corners : triangles) {
        for (int i = 0; i < 3; ++i) {
            const auto given = static_cast<std::size_t>(corners[i]);
            if (found[given] == none) {
                found[given] = static_cast<int>(numbers_.size());
                numbers_.push_back(static_cast<std::uint32_t>(given));
                positions_.push_back(positions[given]);
            }
            corners[i] = found[given];
        }
        triangles_.push_back(corners);
    }
}

void SnowLayer::find_normals(const glm::dvec3& up) {
    std::vector<glm::dvec3> normals(positions_.size());
    for (const glm::ivec3& corners : triangles_) {
        const auto place = [&](std::size_t i) { return glm::dvec3(positions_[vertex(corners, i)]); };
        const glm::dvec3 across = glm::cross(place(1) - place(0), place(2) - place(0));
        for (std::size_t corner = 0; corner < 3; ++corner) normals[vertex(corners, corner)] += across;
    }
    normals_.resize(normals.size());
    is_upright_.resize(normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
        // Squares of what comes from floats are within the range of doubles.
        const double length = glm::length(normals[i]);
        if (!(length > 0.0)) continue;
        const bool is_upright = glm::dot(normals[i], up) >= 0.0;
        is_upright_[i] = is_upright ? 1 : 0;
        normals_[i] = glm::vec3((is_upright ? 1.0 : -1.0) / length * normals[i]);
    }
}

void SnowLayer::find_edges() {
    // Sides by their lower ends, and of each lower end by their upper ones, then by triangles and corners,
    // of which there are less than 2^31.
    const auto ends_of = [&](std::size_t triangle, std::size_t side) {
        const auto a = static_cast<std::uint32_t>(vertex(triangles_[triangle], side));
        const auto b = static_cast<std::uint32_t>(vertex(triangles_[triangle], side + 1));
        return std::pair(std::min(a, b), std::max(a, b));
    };
    std::vector<std::uint32_t> starts(positions_.size() + 1);
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        for (std::size_t side = 0; side < 3; ++side) ++starts[ends_of(i, side).first + 1];
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    std::vector<std::uint64_t> all(3 * triangles_.size());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        for (std::size_t side = 0; side < 3; ++side) {
            const auto [lower, upper] = ends_of(i, side);
            all[next[lower]++] = (static_cast<std::uint64_t>(upper) << 32U) | (4 * i + side);
        }
    }
    sides_.resize(triangles_.size());
    edges_.reserve(positions_.size() + triangles_.size());
    for (std::uint32_t lower = 0; lower < positions_.size(); ++lower) {
        const auto around = std::span(all).subspan(starts[lower], starts[lower + 1] - starts[lower]);
        std::ranges::sort(around);
        for (std::size_t first = 0; first < around.size();) {
            const auto upper = static_cast<std::uint32_t>(around[first] >> 32U);
            std::size_t last = first;
            for (; last < around.size() && around[last] >> 32U == upper; ++last) {
                const auto at = static_cast<std::uint32_t>(around[last]);
                sides_[at / 4][static_cast<int>(at % 4)] = static_cast<int>(edges_.size());
            }
            // From the vertex that was given first.
            const bool is_along = numbers_[lower] < numbers_[upper];
            edges_.emplace_back(is_along ? lower : upper, is_along ? upper : lower);
            if (const auto at = static_cast<std::uint32_t>(around[first]); last == first + 1)
                loose_.push_back({at / 4, at % 4});
            first = last;
        }
    }
    std::ranges::sort(loose_, {}, [&](const Loose& loose) {
        const glm::ivec2& edge =
            edges_[static_cast<std::size_t>(sides_[loose.triangle][static_cast<int>(loose.side)])];
        return std::pair(numbers_[static_cast<std::size_t>(edge.x)],
                         numbers_[static_cast<std::size_t>(edge.y)]);
    });
}

void SnowLayer::find_ends(const Collider& shelter, const glm::dvec3& up, double hold,
                          const Executor& executor) {
    const Holding holding = holding_of(positions_, triangles_, shelter, up, hold, executor);
    constexpr std::size_t grain = 256;
    in_parts(
        edges_.size(), grain,
        [&](std::size_t first, std::size_t last) {
            Shelter above(shelter, up);
            for (std::size_t i = first; i < last; ++i) {
                const auto from = static_cast<std::size_t>(edges_[i].x),
                           to = static_cast<std::size_t>(edges_[i].y);
                ends_[i] = end_on_edge(holding, positions_, above, from, to).value_or(-1.0F);
            }
        },
        executor);
}

/// Triangles that are lines or points show no snow, though snow that ends at their sides has no wall there.
void SnowLayer::leave_out_degenerate() {
    std::erase_if(loose_, [&](const Loose& loose) { return is_degenerate(triangles_[loose.triangle]); });
    std::vector<std::uint32_t> places(triangles_.size());
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        places[i] = kept;
        if (is_degenerate(triangles_[i])) continue;
        triangles_[kept] = triangles_[i];
        sides_[kept++] = sides_[i];
    }
    triangles_.resize(kept);
    sides_.resize(kept);
    for (Loose& loose : loose_) loose.triangle = places[loose.triangle];
}

/// Collects the triangles that are shown, with their vertices and edges numbered anew as they are first
/// named.
class SnowLayer::Builder {
  public:
    Builder(const SnowLayer& layer, std::span<const float> depths, float thinnest)
        : layer_(layer),
          depths_(depths),
          thinnest_(thinnest),
          vertices_(layer.positions_.size(), none),
          edges_(layer.edges_.size(), none) {}

    [[nodiscard]] Mesh build() {
        reserve();
        for (std::size_t i = 0; i < layer_.triangles_.size(); ++i) {
            const glm::ivec3& corners = layer_.triangles_[i];
            const int deep = (is_deep(vertex(corners, 0)) ? 1 : 0) + (is_deep(vertex(corners, 1)) ? 1 : 0) +
                             (is_deep(vertex(corners, 2)) ? 1 : 0);
            if (deep == 3)
                show_whole(i);
            else if (deep > 0)
                show(i);
        }
        if (!layer_.loose_.empty()) {
            feet_.assign(vertices_.size(), none);
            posts_.assign(vertices_.size(), none);
        }
        for (const Loose& loose : layer_.loose_) close(loose);
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] bool is_deep(std::size_t at) const { return depths_[at] > thinnest_; }

    /// For where few triangles are cut, of which there are two a vertex, and three edges.
    void reserve() {
        const auto tops = static_cast<std::size_t>(
            std::ranges::count_if(depths_, [&](float depth) { return depth > thinnest_; }));
        const std::size_t some = tops + tops / 8;
        mesh_.positions.reserve(some);
        mesh_.depths.reserve(some);
        mesh_.edges.reserve(3 * some);
        mesh_.triangles.reserve(2 * some);
        mesh_.sides.reserve(2 * some);
    }

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
    /// What is shown of an edge with a deep end: all, or from there to where the layer is cut.
    [[nodiscard]] int edge(int index) {
        const auto at = static_cast<std::size_t>(index);
        if (edges_[at] != none) return edges_[at];
        const auto x = static_cast<std::size_t>(layer_.edges_[at].x);
        const auto y = static_cast<std::size_t>(layer_.edges_[at].y);
        const bool is_x = is_deep(x);
        const int end = is_x && is_deep(y) ? top(y) : make_cut(at, is_x);
        return edges_[at] = add_edge(top(is_x ? x : y), end);
    }
    /// Where the layer is cut on an edge, one end of which is deep: on the surface, as deep as what is
    /// hidden at most.
    [[nodiscard]] int make_cut(std::size_t at, bool is_x_deep) {
        const auto x = static_cast<std::size_t>(layer_.edges_[at].x);
        const auto y = static_cast<std::size_t>(layer_.edges_[at].y);
        const float part = layer_.ends_[at] >= 0.0F ? layer_.ends_[at]
                                                    : (depths_[x] - thinnest_) / (depths_[x] - depths_[y]);
        // At a bare vertex all cuts are one.
        constexpr float near = 1e-3F;
        if (const float left = is_x_deep ? 1.0F - part : part; left < near) {
            const std::size_t bare = is_x_deep ? y : x;
            if (vertices_[bare] == none) vertices_[bare] = add(layer_.positions_[bare], depths_[bare]);
            return vertices_[bare];
        }
        return add(glm::mix(layer_.positions_[x], layer_.positions_[y], part), thinnest_);
    }

    [[nodiscard]] int cut(int index) { return mesh_.edges[static_cast<std::size_t>(edge(index))].y; }

    void show_whole(std::size_t index) {
        const glm::ivec3 &corners = layer_.triangles_[index], &sides = layer_.sides_[index];
        const int last = edge(sides.z), first = edge(sides.x), second = edge(sides.y);
        const auto number = [&](std::size_t corner) { return vertices_[vertex(corners, corner)]; };
        add_triangle({number(2), number(0), number(1)}, {last, first, second});
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
            if (!is_deep(a) && !is_deep(b)) continue;
            const int shown = edge(side);
            go(is_deep(a) ? vertices_[a] : cut(side), shown);
            if (is_deep(a) && !is_deep(b)) go(cut(side), none);
        }
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
    /// Where the layer ends within a triangle, from one cut to the other; between bare vertices that is one
    /// of the triangle's sides, which the triangle beyond may share.
    [[nodiscard]] int border(int a, int b, std::size_t triangle) {
        const glm::ivec3& corners = layer_.triangles_[triangle];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            if (vertices_[vertex(corners, corner)] != a || vertices_[vertex(corners, corner + 1)] != b)
                continue;
            int& found = edges_[static_cast<std::size_t>(layer_.sides_[triangle][static_cast<int>(corner)])];
            if (found == none) found = add_edge(a, b);
            return found;
        }
        return add_edge(a, b);
    }

    [[nodiscard]] int foot(std::size_t at) {
        if (feet_[at] == none) feet_[at] = add(layer_.positions_[at] + sunk(at) * layer_.normals_[at], 0.0F);
        return feet_[at];
    }
    /// Down a wall, from a deep vertex to the surface.
    [[nodiscard]] int post(std::size_t at) {
        if (posts_[at] == none) posts_[at] = add_edge(vertices_[at], foot(at));
        return posts_[at];
    }

    /// A wall from a loose edge of what is shown down to the surface.
    void close(const Loose& loose) {
        const glm::ivec3& corners = layer_.triangles_[loose.triangle];
        const std::size_t a = vertex(corners, loose.side), b = vertex(corners, loose.side + 1);
        if (!is_deep(a) && !is_deep(b)) return;
        const int side = layer_.sides_[loose.triangle][static_cast<int>(loose.side)];
        const int above = edge(side), top_a = vertices_[a], top_b = vertices_[b];
        if (is_deep(a) && is_deep(b)) {
            const int foot_b = foot(b), foot_a = foot(a);
            const int under = add_edge(foot_a, foot_b), across = add_edge(top_a, foot_b);
            add_triangle({top_b, top_a, foot_b}, {above, across, post(b)});
            add_triangle({top_a, foot_a, foot_b}, {post(a), under, across});
            return;
        }
        const int end = cut(side);
        const std::size_t deep = is_deep(a) ? a : b;
        const int under = add_edge(foot(deep), end);
        if (is_deep(a))
            add_triangle({end, top_a, foot(a)}, {above, post(a), under});
        else
            add_triangle({top_b, end, foot(b)}, {above, under, post(b)});
    }

    const SnowLayer& layer_;
    std::span<const float> depths_;
    float thinnest_;
    std::vector<int> vertices_;  ///< new numbers, or `none`; of bare vertices those of the cuts there
    std::vector<int> edges_;     ///< new numbers, or `none`; those with one deep end go from there to the cut
    std::vector<int> feet_, posts_;  ///< of walls: vertices on the surface, and edges down to these
    Mesh mesh_;
};

std::vector<SnowLayer::Column> SnowLayer::columns() const {
    std::vector<Column> found;
    found.reserve(numbers_.size());
    for (std::size_t i = 0; i < numbers_.size(); ++i)
        if (normals_[i] != glm::vec3(0.0F)) found.push_back({numbers_[i], positions_[i], normals_[i]});
    return found;
}

SnowLayer::Mesh SnowLayer::at(std::span<const float> depths, float thinnest, float steepest,
                              std::span<const float> left) const {
    require(depths.size() == vertex_count_, "depths: must be as many as the vertices");
    require(std::ranges::all_of(depths, [](float depth) { return std::isfinite(depth); }),
            "depths: must be finite");
    require(thinnest >= 0.0F && std::isfinite(thinnest), "thinnest: must be at least 0 and finite");
    require(steepest > 0.0F, "steepest: must be greater than 0");
    require(left.empty() || left.size() == vertex_count_, "left: must be as many as the vertices, or none");
    require(std::ranges::all_of(left, [](float share) { return share >= 0.0F && std::isfinite(share); }),
            "left: must be at least 0 and finite");
    return in_ieee_floats([&] {
        std::vector<float> fallen;
        fallen.reserve(numbers_.size());
        for (const std::uint32_t given : numbers_) fallen.push_back(depths[given]);
        if (heaps_) heaps_->settle(fallen, steepest);
        if (!left.empty())
            for (std::size_t i = 0; i < fallen.size(); ++i) fallen[i] *= left[numbers_[i]];
        return Builder(*this, fallen, thinnest).build();
    });
}

}  // namespace motus::snow
