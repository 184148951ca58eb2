// Boxes around the leaves of a picking tree, by each instruction set. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "picker_boxes.hpp"

namespace motus::mesh {

/// The points of a tree, eight a leaf, and the triangles of its leaves. Views of what the tree holds.
struct PickerLeaves {
    std::span<const PickerPoint> points;
    std::span<const std::uint32_t> starts;
    std::span<const std::array<std::uint32_t, 3>> corners;  ///< of triangles: points
};

/// The same boxes by all of them: of the leaves from `first` to before `last`.
struct LeafKernel {
    using Boxes = void (*)(const PickerLeaves& leaves, std::size_t first, std::size_t last, PickerBox* out);
    const char* name = nullptr;
    Boxes around_vertices = nullptr;
    Boxes around_triangles = nullptr;
};

/// Those that this processor can run, the widest last.
[[nodiscard]] std::span<const LeafKernel> leaf_kernels();

}  // namespace motus::mesh
