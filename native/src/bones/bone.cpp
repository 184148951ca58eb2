#include "motus/bones/bone.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "motus/bones/space.hpp"

namespace motus::bones {
namespace {

// Blender's thresholds, in single precision: Blender's results jump at these values, and the results here
// jump at the same ones.
constexpr double small_cosine = 1e-4;
constexpr double cosine_of_parallel = 1.0 - 1.1920929e-7;
constexpr double shortest_axis = 1e-35;

glm::dmat4 affine(const glm::dmat3& axes, const glm::dvec3& location) {
    glm::dmat4 matrix(axes);
    matrix[3] = glm::dvec4(location, 1.0);
    return matrix;
}

glm::dvec3 transform(const glm::dmat4& matrix, const glm::dvec3& point) {
    return glm::dmat3(matrix) * point + glm::dvec3(matrix[3]);
}

/// Normalizes a vector in place and returns its former length; a vector of no length becomes zero.
double normalize_in_place(glm::dvec3& v) {
    const double length = glm::length(v);
    v = length > shortest_axis ? v / length : glm::dvec3(0.0);
    return length > shortest_axis ? length : 0.0;
}

glm::dvec3 sizes(const glm::dmat3& axes) {
    return {glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])};
}

/// Lengths of the axes, scaled so that their product is the volume, which shear makes smaller than the
/// product of the lengths.
glm::dvec3 sizes_of_volume(const glm::dmat3& axes) {
    const glm::dvec3 size = sizes(axes);
    const double product = size.x * size.y * size.z;
    return product == 0.0 ? size : size * std::cbrt(std::abs(glm::determinant(axes) / product));
}

glm::dmat3 normalized(glm::dmat3 axes) {
    for (int axis = 0; axis < 3; ++axis) normalize_in_place(axes[axis]);
    return axes;
}

/// The parent space of a bone that inherits rotation: the
/// parent's axes without the scale that the mode leaves out.
LinearSpace turning_parent(InheritScale mode, const glm::dmat3& pose) {
    switch (mode) {
        case InheritScale::none:
        case InheritScale::average:
            return {without_shear(pose, true)};
        case InheritScale::aligned: {
            const glm::dmat3 straight = without_shear(pose, false);
            return {normalized(straight), sizes(straight)};
        }
        case InheritScale::none_legacy:
            return {normalized(pose)};
        case InheritScale::full:
        case InheritScale::fix_shear:
            break;
    }
    return {pose};
}

/// The parent space of a bone that does not inherit rotation: the parent's axes at rest, with the scale that
/// the mode inherits.
LinearSpace still_parent(InheritScale mode, const glm::dmat3& rest, const glm::dmat3& pose) {
    switch (mode) {
        case InheritScale::full:
            return {scaled(rest, sizes(pose))};
        case InheritScale::fix_shear:
            return {scaled(rest, sizes_of_volume(pose))};
        case InheritScale::aligned:
            return {rest, sizes_of_volume(pose)};
        default:
            return {rest};
    }
}

/// A unit vector perpendicular to the two other axes of a matrix, some of which may be zero.
glm::dvec3 filling(const glm::dmat3& unit, int axis) {
    const glm::dvec3& next = unit[(axis + 1) % 3];
    const glm::dvec3& last = unit[(axis + 2) % 3];
    const glm::dvec3 both = glm::cross(next, last);
    if (glm::length(both) > 0.5) return glm::normalize(both);
    glm::dvec3 best(0.0);
    for (int seed = 0; seed < 3; ++seed) {
        glm::dvec3 candidate(0.0);
        candidate[(axis + seed) % 3] = 1.0;
        candidate -= next * glm::dot(next, candidate) + last * glm::dot(last, candidate);
        if (glm::length(candidate) > 1.1 * glm::length(best)) best = candidate;
    }
    return glm::normalize(best);
}

}  // namespace

glm::dmat3 without_shear(const glm::dmat3& axes, bool unit) {
    glm::dvec3 y = axes[1], x = axes[0], z = axes[2];
    const double y_squared = glm::dot(y, y);
    if (y_squared > 0.0) {
        x -= y * (glm::dot(x, y) / y_squared);
        z -= y * (glm::dot(z, y) / y_squared);
        if (unit) y /= std::sqrt(y_squared);
    }
    glm::dvec3 unit_x = x, unit_z = z;
    const double length_x = normalize_in_place(unit_x);
    const double length_z = normalize_in_place(unit_z);
    const double cosine = glm::dot(unit_x, unit_z);
    if (std::abs(cosine) > small_cosine && std::abs(cosine) < cosine_of_parallel) {
        const double angle = std::acos(cosine);
        const double half_way = 0.5 * (angle + 0.5 * std::numbers::pi);
        const glm::dvec3 across = glm::normalize(unit_x - cosine * unit_z);
        unit_x = std::sin(half_way) * across + std::cos(half_way) * unit_z;
        unit_z = glm::normalize(glm::cross(glm::cross(unit_x, unit_z), unit_x));
        const double keep_area = std::sqrt(std::sin(angle));
        x = unit_x * (length_x * keep_area);
        z = unit_z * (length_z * keep_area);
    }
    return unit ? glm::dmat3(unit_x, y, unit_z) : glm::dmat3(x, y, z);
}

glm::dmat3 inverse_of_flat(const glm::dmat3& axes) {
    const glm::dvec3 size = sizes(axes);
    glm::dmat3 unit(0.0);
    std::array<bool, 3> is_missing{};
    // Gram-Schmidt: axes that are not zero keep their directions as far as these differ; the axes that are
    // missing complete the frame.
    constexpr double same = 1e-7;
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] > shortest_axis) unit[axis] = axes[axis] / size[axis];
        for (int before = 0; before < axis; ++before)
            unit[axis] -= unit[before] * glm::dot(unit[before], unit[axis]);
        const double left = glm::length(unit[axis]);
        is_missing[static_cast<std::size_t>(axis)] = !(left > same);
        unit[axis] = left > same ? unit[axis] / left : glm::dvec3(0.0);
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (is_missing[static_cast<std::size_t>(axis)]) unit[axis] = filling(unit, axis);
    }
    glm::dmat3 rows = unit;  // its inverse, transposed
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] > shortest_axis) rows[axis] /= size[axis];
    }
    return glm::transpose(rows);
}

Offset offset_of(const Rest& bone) {
    Offset offset;
    offset.has_parent = bone.has_parent;
    offset.inherit_rotation = bone.inherit_rotation;
    offset.local_location = bone.local_location;
    offset.inherit_scale = bone.inherit_scale;
    offset.turn = glm::dmat3(bone.matrix);
    offset.head = glm::dvec3(bone.matrix[3]);
    if (bone.has_parent) {
        offset.parent_turn = glm::dmat3(bone.parent_matrix);
        const glm::dmat3 to_parent = inverse_axes(offset.parent_turn);
        offset.turn = to_parent * offset.turn;
        offset.head = to_parent * (offset.head - glm::dvec3(bone.parent_matrix[3]));
    }
    return offset;
}

LinearSpace special_space(const Offset& bone, const glm::dmat3& parent_pose) {
    LinearSpace space = bone.inherit_rotation
                            ? turning_parent(bone.inherit_scale, parent_pose)
                            : still_parent(bone.inherit_scale, bone.parent_turn, parent_pose);
    if (bone.inherit_scale == InheritScale::average)
        space.axes *= std::cbrt(std::abs(glm::determinant(parent_pose)));
    space.axes = space.axes * bone.turn;
    if (bone.inherit_scale == InheritScale::fix_shear) space.axes = without_shear(space.axes, false);
    return space;
}

ParentSpace parent_space(const Rest& bone, const glm::dmat4& parent_pose) {
    const Offset offset = offset_of(bone);
    const glm::dmat3 parent_axes(parent_pose);
    const LinearSpace linear = linear_space(offset, parent_axes);
    ParentSpace space;
    space.post_scale = linear.post_scale;
    const glm::dvec3 head = bone.has_parent ? transform(parent_pose, offset.head) : offset.head;
    // Blender's own matrix has another origin if the bone does not inherit all. Nothing reads that origin.
    space.rotation_scale = affine(linear.axes, head);
    if (!bone.has_parent)
        space.location = affine(bone.local_location ? offset.turn : glm::dmat3(1.0), head);
    else
        space.location = affine(bone.local_location ? parent_axes * offset.turn : parent_axes, head);
    return space;
}

glm::dmat4 to_pose(const ParentSpace& space, const glm::dmat4& basis) {
    const glm::dmat3 axes = glm::dmat3(space.rotation_scale) * glm::dmat3(basis);
    return affine(scaled(axes, space.post_scale), transform(space.location, glm::dvec3(basis[3])));
}

glm::dmat4 to_basis(const ParentSpace& space, const glm::dmat4& pose) {
    const glm::dmat3 axes = inverse_axes(glm::dmat3(space.rotation_scale)) * glm::dmat3(pose);
    glm::dvec3 unscale(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        if (space.post_scale[axis] != 0.0) unscale[axis] = 1.0 / space.post_scale[axis];
    }
    const glm::dvec3 location =
        inverse_axes(glm::dmat3(space.location)) * (glm::dvec3(pose[3]) - glm::dvec3(space.location[3]));
    return affine(scaled(axes, unscale), location);
}

}  // namespace motus::bones
