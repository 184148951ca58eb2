// Poses in the forms in which Blender reads them.
//
// Costs: O(n). Allocates nothing. Any number of threads at once, each with an `out` of its own.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/config.hpp"

namespace motus::bones {

/// Euler angles (rad) of a unit quaternion in the order XYZ, as mathutils' Quaternion.to_euler('XYZ') gives
/// them: of the two sets for the same rotation the one with the smaller sum of magnitudes; z = 0 if y is a
/// right angle.
[[nodiscard]] glm::dvec3 euler_xyz(const glm::dquat& rotation);

/// Transforms as matrices: 16 floats each, column by column. out.size() == 16 * locations.size(), and as many
/// rotations (unit quaternions) as locations, and scales (along the rotated axes) or none, which means 1;
/// else std::invalid_argument.
void pack_matrices(std::span<const glm::dvec3> locations, std::span<const glm::dquat> rotations,
                   std::span<float> out, std::span<const glm::dvec3> scales = {});

}  // namespace motus::bones
