// A bone in the pose of the bones below it, and its turns in the rig's space.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "motus/bones/rig.hpp"

namespace motus::bones::look_at {

/// A bone whose pose's axes are those of its space, its own rotation, and scales.
class GazeBone {
  public:
    /// parent_pose: armature space; not read without a parent.
    GazeBone(const RigView& rig, std::size_t bone, const glm::dmat4& parent_pose);

    [[nodiscard]] const glm::dmat4& pose() const noexcept { return pose_; }
    [[nodiscard]] glm::dvec3 place() const { return {pose_[3].x, pose_[3].y, pose_[3].z}; }
    [[nodiscard]] bool is_finite() const;

    /// Where the bone's own `axis` points; none where its scale is zero.
    [[nodiscard]] std::optional<glm::dvec3> gaze(const glm::dvec3& axis) const;

    /// The gaze without the bone's own rotation; none if a scale is zero.
    [[nodiscard]] std::optional<glm::dvec3> gaze_at_rest(const glm::dvec3& axis) const;

    /// `up`, a unit vector of the armature at rest, as the space of the bone has turned it; if `axis`
    /// at rest lies nearly along it, the bone's own Y or Z without its own rotation. Not unit.
    [[nodiscard]] glm::dvec3 up_at_rest(const glm::dvec3& axis, const glm::dvec3& up) const;

    /// Turns the bone about its place by a rotation of the rig's space. What its own `axis` points at turns
    /// by exactly that; the rest of the bone too if no parent shears it, else as nearly as its rotation
    /// can. Gives the rotation on top of its own, w >= 0. The bone stays as it is, and the result is none,
    /// if its axes have no inverse.
    std::optional<glm::dquat> turn(const glm::dquat& rotation, const glm::dvec3& axis);

  private:
    glm::dmat3 rest_{1.0};
    glm::dmat3 space_{1.0};
    glm::dmat3 basis_{1.0};
    glm::dvec3 post_scale_{1.0};
    glm::dmat4 pose_{1.0};
};

}  // namespace motus::bones::look_at
