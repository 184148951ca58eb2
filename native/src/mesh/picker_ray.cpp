// Ray hits.
// Triangles: Woop, Benthin, Wald, "Watertight ray/triangle intersection" (2013), in double precision. Two
// triangles compute the same numbers for the side of their common edge on which a ray passes, so that no ray
// slips between them.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "motus/core/numeric.hpp"
#include "picker_tree.hpp"

namespace motus::mesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec3 position(const PickerPoint& point) {
    return {point[0], point[1], point[2]};
}

/// A ray that triangles are held against.
class Ray {
  public:
    /// `direction` of length 1.
    Ray(const glm::dvec3& origin, const glm::dvec3& direction) : origin_(origin) {
        const glm::dvec3 along = glm::abs(direction);
        z_ = along.x >= along.y && along.x >= along.z ? 0 : along.y >= along.z ? 1 : 2;
        x_ = (z_ + 1) % 3;
        y_ = (z_ + 2) % 3;
        shear_ = {direction[x_] / direction[z_], direction[y_] / direction[z_], 1.0 / direction[z_]};
    }

    /// The distance to a triangle, and the corners' weights that give the point; infinity if it is not
    /// met.
    [[nodiscard]] double meet(const std::array<glm::dvec3, 3>& triangle, glm::dvec3& weights) const {
        const glm::dvec3 a = sheared(triangle[0]), b = sheared(triangle[1]), c = sheared(triangle[2]);
        const double u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
        if (!((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0))) return infinity;
        const double sum = u + v + w;
        const double distance = (u * a.z + v * b.z + w * c.z) / sum;
        if (!(distance >= 0.0 && distance < infinity)) return infinity;
        // A triangle without area may have a sum other than 0 by rounding.
        if (glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) == glm::dvec3(0.0))
            return infinity;
        weights = glm::dvec3(u, v, w) / sum;
        return distance;
    }

  private:
    /// A position relative to the origin, sheared so that the ray is the third axis.
    [[nodiscard]] glm::dvec3 sheared(const glm::dvec3& p) const {
        const glm::dvec3 d = p - origin_;
        return {d[x_] - shear_.x * d[z_], d[y_] - shear_.y * d[z_], shear_.z * d[z_]};
    }

    glm::dvec3 origin_;
    glm::length_t x_ = 0, y_ = 0, z_ = 0;
    glm::dvec3 shear_{0.0};
};

/// Where a ray enters the boxes of a node. Boxes are taken to be larger by `pad`, at least far above the
/// rounding of where triangles are met, so that no box hides what is in it.
class Slabs {
  public:
    Slabs(const glm::dvec3& origin, const glm::dvec3& direction, double pad) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double d = direction[static_cast<glm::length_t>(axis)];
            const double o = origin[static_cast<glm::length_t>(axis)];
            // Along a box's side there is no way through its slab; the number replaced is far below rounding.
            backwards_[axis] = d < 0.0;
            inverse_[axis] = 1.0 / (std::abs(d) < 1e-100 ? std::copysign(1e-100, d) : d);
            if (std::abs(d) < 1e-100) backwards_[axis] = std::signbit(d);
            near_[axis] = backwards_[axis] ? o - pad : o + pad;
            far_[axis] = backwards_[axis] ? o + pad : o - pad;
        }
    }

    /// Distances at which the lanes' boxes are entered; infinity if they are not within `most`.
    [[nodiscard]] std::array<double, fan_out> entries(const PickerNode& node, double most) const {
        std::array<double, fan_out> found{};
        for (std::size_t lanes = 0; lanes < fan_out; lanes += 2) {
            TwoDoubles in{}, out = TwoDoubles{} + most;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Lanes& near = backwards_[axis] ? node.high[axis] : node.low[axis];
                const Lanes& far = backwards_[axis] ? node.low[axis] : node.high[axis];
                const auto of_near = __builtin_convertvector(load<TwoFloats>(near, lanes), TwoDoubles);
                const auto of_far = __builtin_convertvector(load<TwoFloats>(far, lanes), TwoDoubles);
                in = larger((of_near - near_[axis]) * inverse_[axis], in);
                out = smaller((of_far - far_[axis]) * inverse_[axis], out);
            }
            store(in <= out ? in : TwoDoubles{} + infinity, found, lanes);
        }
        return found;
    }

  private:
    std::array<bool, 3> backwards_{};
    std::array<double, 3> inverse_{}, near_{}, far_{};
};

/// The first triangle so far, and the search for nearer ones. points(place): where a vertex is.
template <class Tree, class Points>
class Search {
  public:
    Search(const Tree& tree, const Points& points, const Ray& ray, const Slabs& slabs, double rounding,
           double farthest)
        : tree_(tree),
          points_(points),
          ray_(ray),
          slabs_(slabs),
          rounding_(rounding),
          best_{none, {}, farthest, {}} {}

    void descend(std::size_t level, std::size_t node) {
        const std::array<double, fan_out> entries =
            slabs_.entries(tree_.around_triangles.node(level, node), best_.distance + rounding_);
        std::array<std::size_t, fan_out> lanes{};  // that are met, the nearest first
        std::size_t count = 0;
        for (std::size_t lane = 0; lane < fan_out; ++lane) {
            if (entries[lane] == infinity) continue;
            std::size_t at = count++;
            for (; at > 0 && entries[lanes[at - 1]] > entries[lane]; --at) lanes[at] = lanes[at - 1];
            lanes[at] = lane;
        }
        for (std::size_t i = 0; i < count && entries[lanes[i]] <= best_.distance + rounding_; ++i) {
            if (level > 0)
                descend(level - 1, node * fan_out + lanes[i]);
            else
                try_leaf(node * fan_out + lanes[i]);
        }
    }

    [[nodiscard]] std::optional<Hit> found() const {
        return best_.triangle != none ? std::optional(best_) : std::nullopt;
    }

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  ///< above all triangles

    void try_leaf(std::size_t leaf) {
        for (std::size_t slot = tree_.starts[leaf]; slot < tree_.starts[leaf + 1]; ++slot) {
            const auto [a, b, c] = tree_.corners[slot];
            const std::array triangle{points_(a), points_(b), points_(c)};
            glm::dvec3 weights(0.0);
            const double distance = ray_.meet(triangle, weights);
            const std::uint32_t name = tree_.names[slot];
            if (distance < best_.distance ||
                (distance == best_.distance && distance < infinity && name < best_.triangle))
                best_ = {name,
                         weights.x * triangle[0] + weights.y * triangle[1] + weights.z * triangle[2],
                         distance,
                         {tree_.order[a], tree_.order[b], tree_.order[c]}};
        }
    }

    const Tree& tree_;
    const Points& points_;
    const Ray& ray_;
    const Slabs& slabs_;
    double rounding_;
    Hit best_;
};

/// The boxes of the tree may be wrong by `slack`.
template <class Tree, class Points>
std::optional<Hit> first_met(const Tree& tree, const Points& points, const glm::dvec3& origin,
                             const glm::dvec3& direction, double slack, double farthest = infinity) {
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (tree.around_triangles.empty() || !is_finite(origin) || !is_finite(direction) || !(largest > 0.0))
        return {};
    const glm::dvec3 unit = glm::normalize(direction / largest);

    const std::size_t top = tree.around_triangles.top();
    const PickerBox box = tree.around_triangles.box(top, 0);
    double extent = 0.0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        extent = std::max({extent, std::abs(box.low[static_cast<std::size_t>(axis)] - origin[axis]),
                           std::abs(box.high[static_cast<std::size_t>(axis)] - origin[axis])});
    // Empty, with nothing finite.
    if (!(extent < infinity)) return {};
    const double rounding = 1e-13 * (extent + slack);
    const Ray ray(origin, unit);
    const Slabs slabs(origin, unit, rounding + slack);
    Search search(tree, points, ray, slabs, rounding, farthest);
    search.descend(top, 0);
    return search.found();
}

}  // namespace

std::optional<Hit> Picker::ray(const glm::dvec3& origin, const glm::dvec3& direction, double farthest) const {
    const auto points = [this](std::size_t place) { return position(tree().points[place]); };
    return first_met(tree(), points, origin, direction, 0.0, farthest);
}

std::optional<Hit> Picker::ray(const glm::dvec3& origin, const glm::dvec3& direction,
                               std::span<const glm::vec3> positions, float slack) const {
    if (positions.size() != vertex_count())
        throw std::invalid_argument("positions: there must be one for each vertex of the mesh");
    require(slack >= 0.0f && std::isfinite(slack), "slack: must be finite and >= 0");
    const auto points = [&](std::size_t place) { return glm::dvec3(positions[tree().order[place]]); };
    return first_met(tree(), points, origin, direction, static_cast<double>(slack));
}

}  // namespace motus::mesh
