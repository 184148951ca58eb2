// Turns beyond half a turn, which a quaternion does not tell: what the Euler angles of F-curves say of them.
#pragma once
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace motus::bones::layers {

/// What the numbers of a bone's rotation are: Blender's rotation modes.
enum class Rotation : int { quaternion = 0, xyz, xzy, yxz, yzx, zxy, zyx, axis_angle };

/// Whether the numbers of a mode are Euler angles.
[[nodiscard]] constexpr bool is_euler(Rotation mode) {
    return mode != Rotation::quaternion && mode != Rotation::axis_angle;
}

/// Unit quaternion of Euler angles about X, Y and Z, rad, in an Euler mode.
[[nodiscard]] glm::dquat of_angles(Rotation mode, const glm::dvec3& angles);

/// Euler angles of a unit quaternion: of all that mean it, those that lie nearest to `near`.
[[nodiscard]] glm::dvec3 angles_near(Rotation mode, const glm::dquat& rotation, const glm::dvec3& near);

/// How a bone turns whose Euler angles go beyond half a turn: between two rotations the angles themselves are
/// blended, as Blender's NLA does it, so that two turns stay two turns. All other bones have mode quaternion.
struct Spin {
    Rotation mode = Rotation::quaternion;
    glm::dvec3 first{0.0};  ///< angles that the F-curves begin with, rad: a rotation without angles takes those
                            ///< nearest to them

    [[nodiscard]] bool is_on() const { return is_euler(mode); }

    /// The share `weight` (0 to 1) of the way from a rotation to angles.
    [[nodiscard]] glm::dquat towards(const glm::dquat& from, const glm::dvec3& to, double weight) const {
        return of_angles(mode, glm::mix(angles_near(mode, from, first), to, weight));
    }
};

}  // namespace motus::bones::layers
