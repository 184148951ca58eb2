// A bone's own transform, and how one is laid over another. Every function gives the same bits by the same
// compiler (docs/library.md): it uses neither the system's trigonometry nor its powers.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "motus/bones/turns.hpp"
#include "motus/config.hpp"

namespace motus::bones::layers {

/// What PoseBone.matrix_basis is made of: the rotation is a unit quaternion, the scale lies along its axes.
struct Transform {
    glm::dvec3 location{0.0, 0.0, 0.0};
    glm::dquat rotation = no_turn;
    glm::dvec3 scale{1.0, 1.0, 1.0};
};

/// Which parts of a Transform something says: a sum of these.
enum Channels : std::uint8_t { no_channel = 0, location = 1, rotation = 2, scale = 4 };

/// Parts of a matrix without shear, as Blender takes it apart: of a mirrored one all scales are negative.
[[nodiscard]] Transform transform_of(const glm::dmat4& matrix);
[[nodiscard]] glm::dmat4 matrix_of(const Transform& transform);

/// Whether all numbers are finite.
[[nodiscard]] bool is_finite(const Transform& transform);

/// The share `weight` (0 to 1) of a unit quaternion's turn, the shorter way; 0 and 1 exactly.
[[nodiscard]] glm::dquat part_of_turn(const glm::dquat& turn, double weight);

/// The turn of which part_of_turn() makes `part` by `weight` (0 to 1), at most half a turn: where it would be
/// more, or the weight is 0, half a turn the same way. No turn is no turn by any weight. Of a weight that is
/// NaN it is NaN.
[[nodiscard]] glm::dquat whole_turn(const glm::dquat& part, double weight);

/// Whether whole_turn() is at most half a turn by itself, so that its part by `weight` is `part`.
[[nodiscard]] bool has_whole_turn(const glm::dquat& part, double weight);

/// From `base` to `source` by `weight`: rotations along the shorter arc, locations and scales on straight
/// lines. Only what `channels` names.
[[nodiscard]] Transform overridden(const Transform& base, const Transform& source, double weight,
                                   unsigned channels);

/// What leads from `reference` to `source`, by `weight` on top of `base`: locations add, rotations come after
/// the base's own, scales multiply by 1 + weight (source / reference - 1). Where a scale of the reference is
/// 0 that scale of the base stays. Only what `channels` names.
[[nodiscard]] Transform added(const Transform& base, const Transform& source, const Transform& reference,
                              double weight, unsigned channels);

/// What comes on top of `base`, channel by channel, so that it becomes `result`: location added, rotation
/// after the base's own, scale multiplied. A scale of 0 stays.
[[nodiscard]] Transform between_transforms(const Transform& base, const Transform& result);

}  // namespace motus::bones::layers
