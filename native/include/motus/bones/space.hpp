// The linear part of a bone's parent space: its rotation and scale, without the location.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "motus/bones/bone.hpp"
#include "motus/config.hpp"

namespace motus::bones {

/// A bone at rest, relative to its parent at rest.
struct Offset {
    glm::dmat3 turn{1.0};         ///< axes in the parent's at rest; in armature space without a parent
    glm::dvec3 head{0.0};         ///< place in the parent's at rest; in armature space without a parent
    glm::dmat3 parent_turn{1.0};  ///< axes of the parent at rest, armature space
    bool has_parent = false;
    bool inherit_rotation = true;
    bool local_location = true;
    InheritScale inherit_scale = InheritScale::full;
};

[[nodiscard]] Offset offset_of(const Rest& bone);

/// The linear part of a ParentSpace: `axes` is its rotation_scale without the location.
struct LinearSpace {
    glm::dmat3 axes{1.0};
    glm::dvec3 post_scale{1.0};
};

/// Whether the space is parent_pose * turn and nothing else.
[[nodiscard]] inline bool is_plain(const Offset& bone) {
    return bone.inherit_rotation && bone.inherit_scale == InheritScale::full;
}

/// The rules for a bone that has a parent and is not plain (is_plain()).
[[nodiscard]] LinearSpace special_space(const Offset& bone, const glm::dmat3& parent_pose);

/// Space of a bone whose parent's pose has these axes (armature space; not read without a parent).
[[nodiscard]] inline LinearSpace linear_space(const Offset& bone, const glm::dmat3& parent_pose) {
    if (!bone.has_parent) return {bone.turn, glm::dvec3(1.0)};
    if (is_plain(bone)) return {parent_pose * bone.turn, glm::dvec3(1.0)};
    return special_space(bone, parent_pose);
}

/// Axes, each multiplied by a factor of its own.
[[nodiscard]] inline glm::dmat3 scaled(const glm::dmat3& axes, const glm::dvec3& scale) {
    return {scale.x * axes[0], scale.y * axes[1], scale.z * axes[2]};
}

/// Blender's removal of shear with Y as the axis that keeps its direction: X and Z lose their parts along
/// Y, then share the turn that makes them perpendicular; the volume stays, or with `unit` every axis gets
/// the length 1.
[[nodiscard]] glm::dmat3 without_shear(const glm::dmat3& axes, bool unit);

/// Inverse of axes that lie in a plane, or nearly so: an axis of no length is taken as a unit vector across
/// the others; an axis in the plane of the others as perpendicular to them.
[[nodiscard]] glm::dmat3 inverse_of_flat(const glm::dmat3& axes);

/// Inverse of a bone's axes; finite for any axes.
[[nodiscard]] inline glm::dmat3 inverse_axes(const glm::dmat3& axes) {
    const glm::dvec3 yz = glm::cross(axes[1], axes[2]);
    const double volume = glm::dot(axes[0], yz);
    const double box = glm::dot(axes[0], axes[0]) * glm::dot(axes[1], axes[1]) * glm::dot(axes[2], axes[2]);
    constexpr double flat = 1e-28;  // squared
    if (!(volume * volume > flat * box) || box < 1e-250) return inverse_of_flat(axes);
    const double scale = 1.0 / volume;
    return glm::transpose(
        glm::dmat3(scale * yz, scale * glm::cross(axes[2], axes[0]), scale * glm::cross(axes[0], axes[1])));
}

}  // namespace motus::bones
