// Ray hits.
// Triangles: Woop, Benthin, Wald, "Watertight ray/triangle intersection" (2013), in double precision. Two
// triangles compute the same numbers for the side of their common edge on which a ray passes, so that no ray
// slips between them.
#include "picker_ray.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "motus/core/instruction_sets.hpp"
#include "motus/core/numeric.hpp"
#include "picker_tree.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "picker_ray.cpp"
#include <hwy/foreach_target.h>

#include "motus/core/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::mesh::HWY_NAMESPACE {
namespace {

using namespace motus::HWY_NAMESPACE;

constexpr double infinity = std::numeric_limits<double>::infinity();

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
    [[nodiscard]] HWY_INLINE double meet(const std::array<glm::dvec3, 3>& triangle,
                                         glm::dvec3& weights) const {
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

/// Where the corners of a triangle are.
using Corners = std::array<const PickerPoint*, 3>;

/// A point and the end of its neighbourhood along an axis, rounded so that the neighbourhood is larger.
[[nodiscard]] float rounded_down(double number) {
    constexpr double largest = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::min();
    return static_cast<float>(std::clamp(number - 0x1p-23 * std::abs(number) - least, -largest, largest));
}

/// The box around the part of a ray in which something may be met. What it does not touch is passed for the
/// price of a comparison, and a short way touches little.
class Part {
  public:
    /// Larger by `pad`, at least far above the rounding of where triangles are met, so that nothing that is
    /// met lies outside.
    Part(const glm::dvec3& origin, const glm::dvec3& direction, double pad)
        : origin_(origin), direction_(direction), pad_(pad) {}

    void end_at(double distance) {
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const double end = origin_[axis] + distance * direction_[axis];
            const auto of_axis = static_cast<std::size_t>(axis);
            low_[of_axis] = rounded_down(std::min(origin_[axis], end) - pad_);
            high_[of_axis] = -rounded_down(-std::max(origin_[axis], end) - pad_);
        }
    }

    /// A bit for each lane's box that it touches.
    [[nodiscard]] std::uint32_t touched(const PickerNode& node) const {
        constexpr hn::CappedTag<float, fan_out> numbers;
        std::uint32_t bits = 0;
        for (std::size_t first = 0; first < fan_out; first += hn::MaxLanes(numbers)) {
            auto touches = hn::Zero(numbers) == hn::Zero(numbers);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto low = hn::LoadU(numbers, &node.low[axis][first]);
                const auto high = hn::LoadU(numbers, &node.high[axis][first]);
                touches = hn::And(touches, hn::And(low <= hn::Set(numbers, high_[axis]),
                                                   high >= hn::Set(numbers, low_[axis])));
            }
            std::array<std::uint8_t, 8> found{};
            hn::StoreMaskBits(numbers, touches, found.data());
            bits |= std::uint32_t{found[0]} << first;
        }
        return bits;
    }

    [[nodiscard]] bool touches(const Corners& corners) const {
        bool touches = true;
        for (std::size_t axis = 0; axis < 4; axis += lanes_of_four) {
            const Four a = hn::LoadU(as_four, corners[0]->data() + axis);
            const Four b = hn::LoadU(as_four, corners[1]->data() + axis);
            const Four c = hn::LoadU(as_four, corners[2]->data() + axis);
            const Four low = hn::Min(hn::Min(a, b), c), high = hn::Max(hn::Max(a, b), c);
            touches = touches && hn::AllTrue(as_four, hn::And(low <= hn::LoadU(as_four, &high_[axis]),
                                                              high >= hn::LoadU(as_four, &low_[axis])));
        }
        return touches;
    }

  private:
    glm::dvec3 origin_, direction_;
    double pad_;
    std::array<float, 4> low_{}, high_{};  ///< the last is 0, as that of a point
};

/// Where a ray enters the boxes of a node. Boxes are taken to be larger by `pad`, as the ray's part is.
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
        constexpr hn::CappedTag<double, fan_out> numbers;
        constexpr hn::Rebind<float, decltype(numbers)> halves;
        std::array<double, fan_out> found{};
        for (std::size_t first = 0; first < fan_out; first += hn::MaxLanes(numbers)) {
            auto in = hn::Zero(numbers), out = hn::Set(numbers, most);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Lanes& near = backwards_[axis] ? node.high[axis] : node.low[axis];
                const Lanes& far = backwards_[axis] ? node.low[axis] : node.high[axis];
                const auto of_near = hn::PromoteTo(numbers, hn::LoadU(halves, &near[first]));
                const auto of_far = hn::PromoteTo(numbers, hn::LoadU(halves, &far[first]));
                const auto inverse = hn::Set(numbers, inverse_[axis]);
                in = hn::Max((of_near - hn::Set(numbers, near_[axis])) * inverse, in);
                out = hn::Min((of_far - hn::Set(numbers, far_[axis])) * inverse, out);
            }
            hn::StoreU(hn::IfThenElse(in <= out, in, hn::Set(numbers, infinity)), numbers, &found[first]);
        }
        return found;
    }

  private:
    std::array<bool, 3> backwards_{};
    std::array<double, 3> inverse_{}, near_{}, far_{};
};

/// The first triangle so far, and the search for nearer ones.
class Search {
  public:
    /// `direction` of length 1; nothing lies farther away than `reach`.
    Search(const RayTree& tree, const glm::dvec3& origin, const glm::dvec3& direction, double rounding,
           double reach, double farthest)
        : tree_(tree),
          ray_(origin, direction),
          slabs_(origin, direction, rounding + tree.slack),
          part_(origin, direction, rounding + tree.slack),
          rounding_(rounding),
          best_{none, {}, farthest, {}} {
        part_.end_at(std::min(reach, farthest) + rounding);
    }

    void descend(std::size_t level, std::size_t index) {
        const PickerNode& node = tree_.boxes.node(level, index);
        std::uint32_t touched = part_.touched(node);
        if (touched == 0) return;
        const std::array<double, fan_out> entries = slabs_.entries(node, best_.distance + rounding_);
        std::array<std::size_t, fan_out> lanes{};  // that are met, the nearest first
        std::size_t count = 0;
        for (; touched != 0; touched &= touched - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(touched));
            if (entries[lane] == infinity) continue;
            std::size_t at = count++;
            for (; at > 0 && entries[lanes[at - 1]] > entries[lane]; --at) lanes[at] = lanes[at - 1];
            lanes[at] = lane;
        }
        for (std::size_t i = 0; i < count && entries[lanes[i]] <= best_.distance + rounding_; ++i) {
            if (level > 0)
                descend(level - 1, index * fan_out + lanes[i]);
            else
                try_leaf(index * fan_out + lanes[i]);
        }
    }

    [[nodiscard]] std::optional<Hit> found() const {
        return best_.triangle != none ? std::optional(best_) : std::nullopt;
    }

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  ///< above all triangles

    HWY_NOINLINE void try_leaf(std::size_t leaf) {
        std::array<PickerPoint, 3> moved{};
        for (std::size_t slot = tree_.starts[leaf]; slot < tree_.starts[leaf + 1]; ++slot) {
            const auto [a, b, c] = tree_.corners[slot];
            Corners corners{moved.data(), moved.data() + 1, moved.data() + 2};
            if (tree_.positions.empty()) {
                corners = {&tree_.points[a], &tree_.points[b], &tree_.points[c]};
            } else {
                moved = {moved_point(a), moved_point(b), moved_point(c)};
            }
            if (!part_.touches(corners)) continue;
            const std::array triangle{position(*corners[0]), position(*corners[1]), position(*corners[2])};
            glm::dvec3 weights(0.0);
            const double distance = ray_.meet(triangle, weights);
            const std::uint32_t name = tree_.names[slot];
            if (distance < best_.distance ||
                (distance == best_.distance && distance < infinity && name < best_.triangle)) {
                best_ = {name,
                         weights.x * triangle[0] + weights.y * triangle[1] + weights.z * triangle[2],
                         distance,
                         {tree_.order[a], tree_.order[b], tree_.order[c]}};
                part_.end_at(distance + rounding_);
            }
        }
    }

    /// Where the vertex at a place is, if the tree does not hold that.
    [[nodiscard]] PickerPoint moved_point(std::uint32_t place) const {
        const glm::vec3& position = tree_.positions[tree_.order[place]];
        PickerPoint point;
        for (std::size_t axis = 0; axis < 4; axis += lanes_of_four) {
            const auto coordinate = [&](std::size_t i) HWY_ATTR {
                return axis + i < 3 ? position[static_cast<glm::length_t>(axis + i)] : 0.0F;
            };
            hn::StoreU(four_of(coordinate), as_four, point.data() + axis);
        }
        return point;
    }

    [[nodiscard]] static glm::dvec3 position(const PickerPoint& point) {
        return {point[0], point[1], point[2]};
    }

    const RayTree& tree_;
    Ray ray_;
    Slabs slabs_;
    Part part_;
    double rounding_;
    Hit best_;
};

std::optional<Hit> first_met(const RayTree& tree, const glm::dvec3& origin, const glm::dvec3& direction,
                             double farthest) {
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (tree.boxes.empty() || !is_finite(origin) || !is_finite(direction) || !(largest > 0.0)) return {};
    const glm::dvec3 unit = glm::normalize(direction / largest);

    const std::size_t top = tree.boxes.top();
    const PickerBox box = tree.boxes.box(top, 0);
    double extent = 0.0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        extent = std::max({extent, std::abs(box.low[static_cast<std::size_t>(axis)] - origin[axis]),
                           std::abs(box.high[static_cast<std::size_t>(axis)] - origin[axis])});
    // Empty, with nothing finite.
    if (!(extent < infinity)) return {};
    const double rounding = 1e-13 * (extent + tree.slack);
    Search search(tree, origin, unit, rounding, 2.0 * (extent + tree.slack), farthest);
    search.descend(top, 0);
    return search.found();
}

constexpr RayKernel kernel{HWY_STR(HWY_NAMESPACE), &first_met};

}  // namespace
}  // namespace motus::mesh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::mesh {

std::span<const RayKernel> ray_kernels() {
    static const Kernels<RayKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

std::optional<Hit> Picker::ray(const glm::dvec3& origin, const glm::dvec3& direction, double farthest) const {
    return ray_kernels().back().first_met(tree().for_rays(), origin, direction, farthest);
}

std::optional<Hit> Picker::ray(const glm::dvec3& origin, const glm::dvec3& direction,
                               std::span<const glm::vec3> positions, float slack) const {
    if (positions.size() != vertex_count())
        throw std::invalid_argument("positions: there must be one for each vertex of the mesh");
    require(slack >= 0.0f && std::isfinite(slack), "slack: must be finite and >= 0");
    RayTree deformed = tree().for_rays();
    deformed.slack = static_cast<double>(slack);
    deformed.positions = positions;
    return ray_kernels().back().first_met(deformed, origin, direction,
                                          std::numeric_limits<double>::infinity());
}

}  // namespace motus::mesh
#endif
