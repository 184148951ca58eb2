// Whole turns (winding numbers): what the numbers of a rotation say beyond the rotation itself.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <span>

#include "motus/config.hpp"

namespace motus::bones::layers {

/// What the numbers of a bone's rotation are: Blender's rotation modes.
enum class Rotation : int { quaternion = 0, xyz, xzy, yxz, yzx, zxy, zyx, axis_angle };

/// Of a rotation in its mode: a quaternion's w, x, y, z; Euler angles about X, Y and Z and a number that does
/// not count; an angle and its axis. rad.
using Numbers = std::array<double, 4>;

/// How many of the numbers of a mode are angles: the first ones.
[[nodiscard]] constexpr std::size_t angle_count(Rotation mode) {
    return mode == Rotation::quaternion ? 0 : mode == Rotation::axis_angle ? 1 : 3;
}

/// A unit quaternion of numbers in a rotation mode. A quaternion of no length gives half a turn about X,
/// an axis of no length gives no turn, as in Blender.
[[nodiscard]] glm::dquat rotation_of(Rotation mode, std::span<const double, 4> numbers);

/// A bone that goes around: from some numbers to others, by the angles themselves, so that two turns stay two
/// turns where a part of them is played.
struct Spin {
    Rotation mode = Rotation::quaternion;  ///< of quaternions: the bone does not go around
    Numbers from{}, to{};

    [[nodiscard]] bool is_on() const { return mode != Rotation::quaternion; }

    /// Where it begins.
    [[nodiscard]] glm::dquat start() const { return rotation_of(mode, from); }

    /// What has come after that by a share (0 to 1) of the way, in the axes of the bone's parent.
    [[nodiscard]] glm::dquat turn(double share) const;
};

/// `numbers` plus `laps` times the whole turns that are in the angles of `lap`.
[[nodiscard]] Numbers with_laps(Rotation mode, const Numbers& numbers, const Numbers& lap, double laps);

}  // namespace motus::bones::layers
