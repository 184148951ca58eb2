// What a ray meets first in a picking tree, by each instruction set. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "motus/mesh/picker.hpp"
#include "picker_boxes.hpp"

namespace motus::mesh {

/// The triangles of a tree, by leaf, and where their corners are. Views of what the tree holds.
struct RayTree {
    const PickerBoxes& boxes;
    double slack = 0.0;  ///< by which boxes may be wrong
    std::span<const std::uint32_t> starts;
    std::span<const std::uint32_t> names;
    std::span<const std::array<std::uint32_t, 3>> corners;
    std::span<const std::uint32_t> order;
    std::span<const PickerPoint> points;     ///< by place
    std::span<const glm::vec3> positions{};  ///< by vertex, in place of the points, if there are any
};

/// The same bits by all of them.
struct RayKernel {
    const char* name = nullptr;
    /// Numbers need not be finite.
    std::optional<Hit> (*first_met)(const RayTree& tree, const glm::dvec3& origin,
                                    const glm::dvec3& direction, double farthest) = nullptr;
};

/// Those that this processor can run, the widest last.
[[nodiscard]] std::span<const RayKernel> ray_kernels();

}  // namespace motus::mesh
