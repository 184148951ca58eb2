// Which vertices of a picking tree are near a point, by each instruction set. Private to the library.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "picker_boxes.hpp"

namespace motus::mesh {

/// The vertices of a tree. Views of what the tree holds.
struct NearTree {
    const PickerBoxes& boxes;  ///< around the vertices
    bool all_finite = true;    ///< false: a vertex may be not finite
    std::span<const std::uint32_t> order;
    std::span<const PickerPoint> points;  ///< by place

    /// The vertices, by place, below a lane of a node: from the first to before the second.
    [[nodiscard]] std::pair<std::size_t, std::size_t> below(std::size_t level,
                                                            std::size_t child) const noexcept {
        const std::size_t shift = 3 * (level + 1);
        return {std::min(order.size(), child << shift), std::min(order.size(), (child + 1) << shift)};
    }
};

/// The same bits by all of them. Numbers need not be finite.
struct NearKernel {
    const char* name = nullptr;
    std::optional<std::uint32_t> (*nearest)(const NearTree& tree, const glm::vec3& point) = nullptr;
    /// As Picker::within(), in any order.
    std::vector<std::uint32_t> (*within)(const NearTree& tree, const glm::vec3& point, float radius,
                                         const glm::mat3& metric) = nullptr;
};

/// Those that this processor can run, the widest last.
[[nodiscard]] std::span<const NearKernel> near_kernels();

}  // namespace motus::mesh
