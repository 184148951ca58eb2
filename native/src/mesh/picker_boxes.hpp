// The boxes of a picking tree. Private to the library.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
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

/// A vertex and 0. NaN in all four, if one coordinate is not finite.
struct alignas(16) PickerPoint : std::array<float, 4> {};

/// A bounding box; it grows by comparisons that are false for NaN.
struct PickerBox {
    PickerPoint low{inf, inf, inf, inf};
    PickerPoint high{-inf, -inf, -inf, -inf};

    void add(const PickerPoint& point) noexcept {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = point[axis] < low[axis] ? point[axis] : low[axis];
            high[axis] = point[axis] > high[axis] ? point[axis] : high[axis];
        }
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
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = *std::min_element(from.low[axis].begin(), from.low[axis].end());
            box.high[axis] = *std::max_element(from.high[axis].begin(), from.high[axis].end());
        }
        return box;
    }

    /// Computes all boxes, beginning with those of the leaves. leaf_boxes(first, last, out) writes those of
    /// the leaves from `first` to before `last`.
    template <class LeafBoxes>
    void refit(const LeafBoxes& leaf_boxes, const Executor& executor) {
        constexpr std::size_t grain = 64;
        for (std::size_t level = 0; level < levels_.size(); ++level) {
            const std::size_t all = level == 0 ? leaves_ : levels_[level - 1].size();
            const auto refit_nodes = [&](std::size_t first, std::size_t last) {
                for (std::size_t node = first; node < last; ++node) {
                    const std::size_t begin = node * fan_out, end = std::min(all, begin + fan_out);
                    if (level == 0) {
                        refit_leaves(leaf_boxes, begin, end);
                    } else {
                        for (std::size_t child = begin; child < end; ++child)
                            set(level, child, box(level - 1, child));
                    }
                }
            };
            in_parts(levels_[level].size(), grain, refit_nodes, executor);
        }
    }

    /// Updates the boxes of the leaves that touch `region`, and the boxes above them.
    template <class LeafBoxes>
    void refit_touching(const PickerBox& region, const LeafBoxes& leaf_boxes) {
        if (!empty()) refit_below(region, leaf_boxes, top(), 0);
    }

  private:
    template <class LeafBoxes>
    void refit_below(const PickerBox& region, const LeafBoxes& leaf_boxes, std::size_t level,
                     std::size_t index) {
        std::size_t first = fan_out, last = 0;  // of the leaves that touch the region
        for (std::size_t lane = 0; lane < fan_out; ++lane) {
            const PickerNode& node = levels_[level][index];
            bool touches = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                touches = touches && node.low[axis][lane] <= region.high[axis] &&
                          node.high[axis][lane] >= region.low[axis];
            }
            if (!touches) continue;
            const std::size_t child = index * fan_out + lane;
            if (level > 0) {
                refit_below(region, leaf_boxes, level - 1, child);
                set(level, child, box(level - 1, child));
            } else {
                first = std::min(first, lane);
                last = lane + 1;
            }
        }
        if (first < last) refit_leaves(leaf_boxes, index * fan_out + first, index * fan_out + last);
    }

    /// Of one node.
    template <class LeafBoxes>
    void refit_leaves(const LeafBoxes& leaf_boxes, std::size_t first, std::size_t last) {
        std::array<PickerBox, fan_out> around;
        leaf_boxes(first, last, around.data());
        for (std::size_t leaf = first; leaf < last; ++leaf) set(0, leaf, around[leaf - first]);
    }

    void set(std::size_t level, std::size_t child, const PickerBox& box) noexcept {
        PickerNode& node = levels_[level][child / fan_out];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.low[axis][child % fan_out] = box.low[axis];
            node.high[axis][child % fan_out] = box.high[axis];
        }
    }

    std::size_t leaves_ = 0;
    std::vector<Array<PickerNode>> levels_;  ///< from the leaves' boxes up to the root, which is alone
};

}  // namespace motus::mesh
