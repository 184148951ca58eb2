// The tree of a Picker. Private to the library.
//
// The vertices lie along a Hilbert curve. Each eight that follow each other are a leaf; leaves and nodes have
// their parents by their number alone, and the vertices below a node follow each other. A triangle belongs to
// the leaf of one of its corners. Boxes are there twice: tight ones around the vertices, and those around the
// triangles.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "motus/core/executor.hpp"
#include "motus/mesh/picker.hpp"
#include "picker_boxes.hpp"
#include "picker_leaves.hpp"
#include "picker_near.hpp"
#include "picker_order.hpp"
#include "picker_ray.hpp"

namespace motus::mesh {

struct Picker::Tree {
    /// Places of a triangle's corners, in the order in which they were given.
    using Corners = std::array<std::uint32_t, 3>;

    Executor executor{1};
    bool all_finite = true;       ///< false: a vertex may be not finite
    Array<std::uint32_t> order;   ///< vertex at each place along the curve
    Array<std::uint32_t> places;  ///< place of each vertex
    Array<PickerPoint> points;    ///< by place; full leaves, the last one padded with NaN
    Array<std::uint32_t> starts;  ///< first of each leaf's triangles, and the end of the last's
    Array<std::uint32_t> names;   ///< of the triangles, by leaf
    Array<Corners> corners;       ///< beside them
    PickerBoxes around_vertices;
    PickerBoxes around_triangles;  ///< none if there are no triangles

    void sort_in(std::span<const glm::ivec3> triangles);
    /// Computes all boxes for the present points.
    void refit();
    /// Updates the boxes that touch a box in which vertices were moved.
    void refit_touching(const PickerBox& box);
    /// use(boxes, leaf_boxes): for both PickerBoxes, with what computes those of their leaves.
    template <class Use>
    void with_leaf_boxes(const Use& use);

    [[nodiscard]] PickerLeaves leaves() const {
        return {.points = points, .starts = starts, .corners = corners};
    }
    [[nodiscard]] RayTree for_rays() const {
        return {.boxes = around_triangles,
                .starts = starts,
                .names = names,
                .corners = corners,
                .order = order,
                .points = points};
    }

    [[nodiscard]] NearTree for_points() const {
        return {.boxes = around_vertices, .all_finite = all_finite, .order = order, .points = points};
    }
};

}  // namespace motus::mesh
