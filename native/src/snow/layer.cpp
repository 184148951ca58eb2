#include "motus/snow/layer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"

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

}  // namespace

Layer::Layer(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
             const glm::dvec3& up) {
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
          posts_(layer.positions_.size(), none),
          edges_(layer.edges_.size(), none) {}

    [[nodiscard]] Mesh build() {
        for (std::size_t i = 0; i < layer_.triangles_.size(); ++i) {
            const glm::ivec3& corners = layer_.triangles_[i];
            if (is_degenerate(corners) || !is_shown(corners)) continue;
            glm::ivec3 placed(0), sides(0);
            for (std::size_t corner = 0; corner < 3; ++corner) {
                placed[static_cast<int>(corner)] = top(vertex(corners, corner));
                sides[static_cast<int>(corner)] = edge(layer_.sides_[i][static_cast<int>(corner)]);
            }
            mesh_.triangles.push_back(placed);
            mesh_.sides.push_back(sides);
        }
        for (const Loose& loose : layer_.loose_) close(loose);
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] static bool is_degenerate(const glm::ivec3& corners) {
        return corners.x == corners.y || corners.y == corners.z || corners.z == corners.x;
    }
    [[nodiscard]] bool is_deep(std::size_t at) const { return depths_[at] > thinnest_; }
    [[nodiscard]] bool is_shown(const glm::ivec3& corners) const {
        return is_deep(vertex(corners, 0)) || is_deep(vertex(corners, 1)) || is_deep(vertex(corners, 2));
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

    /// Where no snow lies: under the surface, if that tells which of its sides is the upper one.
    [[nodiscard]] float sunk(std::size_t at) const { return layer_.is_upright_[at] != 0 ? -thinnest_ : 0.0F; }

    [[nodiscard]] int top(std::size_t at) {
        if (vertices_[at] != none) return vertices_[at];
        const float depth = depths_[at];
        // From sunk, at no depth, by way of the surface, at the thinnest that is shown, to the depth itself.
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

    /// A wall from a loose edge of what is shown down to the surface.
    void close(const Loose& loose) {
        const glm::ivec3& corners = layer_.triangles_[loose.triangle];
        const std::size_t a = vertex(corners, loose.side), b = vertex(corners, loose.side + 1);
        if (is_degenerate(corners) || !(is_deep(a) || is_deep(b))) return;
        const int under = add_edge(foot(a), foot(b)), across = add_edge(top(a), foot(b));
        const int above = edge(layer_.sides_[loose.triangle][static_cast<int>(loose.side)]);
        mesh_.triangles.emplace_back(top(b), top(a), foot(b));
        mesh_.sides.emplace_back(above, across, post(b));
        mesh_.triangles.emplace_back(top(a), foot(a), foot(b));
        mesh_.sides.emplace_back(post(a), under, across);
    }

    const Layer& layer_;
    std::span<const float> depths_;
    float thinnest_;
    std::vector<int> vertices_, feet_, posts_, edges_;  ///< new numbers, or `none`
    Mesh mesh_;
};

void Layer::fall_off(std::vector<float>& depths, float steepest) const {
    // Heaps are narrow where they are too steep: a few rounds, which go through the edges there and back.
    constexpr int most_rounds = 32;
    bool has_changed = true;
    const auto lower = [&](std::size_t edge) {
        float& a = depths[static_cast<std::size_t>(edges_[edge].x)];
        float& b = depths[static_cast<std::size_t>(edges_[edge].y)];
        const float most = steepest * lengths_[edge];
        if (a > b + most) {
            a = b + most;
            has_changed = true;
        } else if (b > a + most) {
            b = a + most;
            has_changed = true;
        }
    };
    for (int round = 0; round < most_rounds && has_changed; ++round) {
        has_changed = false;
        for (std::size_t i = 0; i < edges_.size(); ++i) lower(round % 2 == 0 ? i : edges_.size() - 1 - i);
    }
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
