// The boxes of a picking tree. Private to the library.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "motus/core/parallel.hpp"
#include "picker_order.hpp"

namespace motus::mesh {

constexpr std::size_t fan_out = 8;

using Lanes = std::array<float, fan_out>;

/// The bounding boxes of up to eight leaves or nodes. Boxes of missing children, or without finite
/// positions, are empty: from infinity to -infinity.
struct alignas(64) PickerNode {
    std::array<Lanes, 3> low;   ///< by axis
    std::array<Lanes, 3> high;  ///< by axis
};

// The vector units' type, of the size that every processor has.
using FourFloats __attribute__((vector_size(16))) = float;

template <class Vector, class Values>
[[nodiscard]] inline Vector load(const Values& values, std::size_t first) noexcept {
    Vector vector;
    std::memcpy(&vector, &values[first], sizeof(vector));
    return vector;
}
template <class Vector, class Values>
inline void store(const Vector& vector, Values& values, std::size_t first) noexcept {
    std::memcpy(&values[first], &vector, sizeof(vector));
}
template <class Vector>
[[nodiscard]] inline Vector larger(const Vector& a, const Vector& b) noexcept {
    return a > b ? a : b;
}
template <class Vector>
[[nodiscard]] inline Vector smaller(const Vector& a, const Vector& b) noexcept {
    return a < b ? a : b;
}

/// A vertex and 0. NaN in all four, if one coordinate is not finite.
using PickerPoint = FourFloats;

/// A bounding box; it grows by comparisons that are false for NaN.
struct PickerBox {
    PickerPoint low{inf, inf, inf, inf};
    PickerPoint high{-inf, -inf, -inf, -inf};

    void add(const PickerPoint& point) noexcept {
        low = smaller(point, low);
        high = larger(point, high);
    }

    static constexpr float inf = std::numeric_limits<float>::infinity();
};

/// Boxes around leaves, eight by eight up to the root. Where a node is follows from its number: below a lane
/// of node n of a level are node or leaf fan_out * n + lane.
class PickerBoxes {
  public:
    PickerBoxes() = default;
    explicit PickerBoxes(std::size_t leaves) : leaves_(leaves) {
        PickerNode empty{};
        for (Lanes& lanes : empty.low) lanes.fill(PickerBox::inf);
        for (Lanes& lanes : empty.high) lanes.fill(-PickerBox::inf);
        for (std::size_t count = leaves; count > 0 && (levels_.empty() || count > 1);) {
            count = (count + fan_out - 1) / fan_out;
            levels_.emplace_back(count, empty);
        }
    }

    [[nodiscard]] bool empty() const noexcept { return levels_.empty(); }
    [[nodiscard]] std::size_t top() const noexcept { return levels_.size() - 1; }
    [[nodiscard]] const PickerNode& node(std::size_t level, std::size_t index) const noexcept {
        return levels_[level][index];
    }
    [[nodiscard]] PickerBox box(std::size_t level, std::size_t index) const noexcept {
        const PickerNode& from = levels_[level][index];
        PickerBox box;
        for (int axis = 0; axis < 3; ++axis) {
            const auto of_axis = static_cast<std::size_t>(axis);
            box.low[axis] = *std::min_element(from.low[of_axis].begin(), from.low[of_axis].end());
            box.high[axis] = *std::max_element(from.high[of_axis].begin(), from.high[of_axis].end());
        }
        return box;
    }

    /// Computes all boxes, beginning with those of the leaves.
    template <class LeafBox>
    void refit(const LeafBox& leaf_box, const Executor& executor) {
        constexpr std::size_t grain = 64;
        for (std::size_t level = 0; level < levels_.size(); ++level) {
            const std::size_t children = level == 0 ? leaves_ : levels_[level - 1].size();
            const auto refit_nodes = [&](std::size_t first, std::size_t last) {
                for (std::size_t child = first * fan_out; child < std::min(children, last * fan_out); ++child)
                    set(level, child, level == 0 ? leaf_box(child) : box(level - 1, child));
            };
            in_parts(levels_[level].size(), grain, refit_nodes, executor);
        }
    }

    /// Updates the boxes of the leaves that touch `region`, and the boxes above them.
    template <class LeafBox>
    void refit_touching(const PickerBox& region, const LeafBox& leaf_box) {
        if (!empty()) refit_below(region, leaf_box, top(), 0);
    }

  private:
    template <class LeafBox>
    void refit_below(const PickerBox& region, const LeafBox& leaf_box, std::size_t level, std::size_t index) {
        for (std::size_t lane = 0; lane < fan_out; ++lane) {
            const PickerNode& node = levels_[level][index];
            bool touches = true;
            for (int axis = 0; axis < 3; ++axis) {
                const auto of_axis = static_cast<std::size_t>(axis);
                touches = touches && node.low[of_axis][lane] <= region.high[axis] &&
                          node.high[of_axis][lane] >= region.low[axis];
            }
            if (!touches) continue;
            const std::size_t child = index * fan_out + lane;
            if (level > 0) refit_below(region, leaf_box, level - 1, child);
            set(level, child, level == 0 ? leaf_box(child) : box(level - 1, child));
        }
    }

    void set(std::size_t level, std::size_t child, const PickerBox& box) noexcept {
        PickerNode& node = levels_[level][child / fan_out];
        for (int axis = 0; axis < 3; ++axis) {
            node.low[static_cast<std::size_t>(axis)][child % fan_out] = box.low[axis];
            node.high[static_cast<std::size_t>(axis)][child % fan_out] = box.high[axis];
        }
    }

    std::size_t leaves_ = 0;
    std::vector<Array<PickerNode>> levels_;  ///< from the leaves' boxes up to the root, which is alone
};

}  // namespace motus::mesh
