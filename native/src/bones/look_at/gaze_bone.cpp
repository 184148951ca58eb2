#include "gaze_bone.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "motus/bones/space.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::look_at {
namespace {

constexpr double nearly_vertical = 0.1;  // sine

/// Three unit axes across each other: the first along a, the second towards b.
std::optional<glm::dmat3> frame(const glm::dvec3& a, const glm::dvec3& b) {
    const std::optional<glm::dvec3> first = direction_of(a);
    if (!first) return std::nullopt;
    const std::optional<glm::dvec3> third = direction_of(glm::cross(*first, b));
    if (!third) return std::nullopt;
    return glm::dmat3(*first, glm::cross(*third, *first), *third);
}

/// The own scale of a bone, as Blender takes matrix_basis apart: a mirrored one has three negative scales.
glm::dvec3 own_scale(const glm::dmat3& basis) {
    const double sign = handedness(basis);
    return sign * glm::dvec3(glm::length(basis[0]), glm::length(basis[1]), glm::length(basis[2]));
}

/// The inverse of a matrix times some positive number; zero if there is no inverse.
glm::dmat3 inverse_but_size(const glm::dmat3& axes) {
    const glm::dmat3 rows(glm::cross(axes[1], axes[2]), glm::cross(axes[2], axes[0]),
                          glm::cross(axes[0], axes[1]));
    const double volume = glm::dot(axes[0], rows[0]);
    if (volume == 0.0) return glm::dmat3(0.0);
    return glm::transpose(volume < 0.0 ? -rows : rows);
}

/// The axis of a space that is most nearly perpendicular to a direction.
glm::dvec3 axis_across(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    if (size.x <= size.y && size.x <= size.z) return {1.0, 0.0, 0.0};
    return size.z <= size.y ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
}

}  // namespace

GazeBone::GazeBone(const RigView& rig, std::size_t bone, const glm::dmat4& parent_pose) {
    const Rest rest = rest_of(rig, bone);
    const ParentSpace space = parent_space(rest, parent_pose);
    const glm::dmat4 basis = matrix_at(rig.basis(), bone);
    rest_ = glm::dmat3(rest.matrix);
    space_ = glm::dmat3(space.rotation_scale);
    basis_ = glm::dmat3(basis);
    post_scale_ = space.post_scale;
    pose_ = to_pose(space, basis);
}

bool GazeBone::is_finite() const {
    return motus::is_finite(pose_);
}

std::optional<glm::dvec3> GazeBone::gaze(const glm::dvec3& axis) const {
    return direction_of(glm::dmat3(pose_) * axis);
}

std::optional<glm::dvec3> GazeBone::gaze_at_rest(const glm::dvec3& axis) const {
    const glm::dvec3 scale = own_scale(basis_);
    if (scale.x == 0.0 || scale.y == 0.0 || scale.z == 0.0) return std::nullopt;
    return direction_of(space_ * (scale * post_scale_ * axis));
}

glm::dvec3 GazeBone::up_at_rest(const glm::dvec3& axis, const glm::dvec3& up) const {
    const glm::dvec3 vertical = glm::transpose(rest_) * up;  // seen from the bone at rest
    if (glm::length(glm::cross(axis, vertical)) > nearly_vertical) return space_ * vertical;
    const bool is_along_y = std::abs(axis.y) > std::abs(axis.z);
    return is_along_y ? space_[2] : space_[1];
}

std::optional<glm::dquat> GazeBone::turn(const glm::dquat& rotation, const glm::dvec3& axis) {
    const glm::dvec3 scale = own_scale(basis_);
    if (scale.x == 0.0 || scale.y == 0.0 || scale.z == 0.0) return std::nullopt;
    const glm::dmat3 own = scaled(basis_, 1.0 / scale);
    const glm::dvec3 all_scale = scale * post_scale_;
    const std::optional<glm::dvec3> local = direction_of(all_scale * axis);
    if (!local) return std::nullopt;

    const glm::dvec3 across = axis_across(*local);
    const glm::dmat3 to_space = inverse_but_size(space_);
    const std::optional<glm::dmat3> from = frame(*local, across);
    const std::optional<glm::dmat3> to = frame(to_space * (rotation * (glm::dmat3(pose_) * axis)),
                                               to_space * (rotation * (space_ * (own * across))));
    if (!from || !to) return std::nullopt;
    const glm::dmat3 turned = *to * glm::transpose(*from);
    glm::dquat relative = glm::normalize(glm::conjugate(glm::quat_cast(own)) * glm::quat_cast(turned));
    if (relative.w < 0.0) relative = -relative;

    basis_ = scaled(turned, scale);
    const glm::dmat3 axes = scaled(space_ * turned, all_scale);
    for (int column = 0; column < 3; ++column) pose_[column] = glm::dvec4(axes[column], 0.0);
    return relative;
}

}  // namespace motus::bones::look_at
