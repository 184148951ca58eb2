#include "motus/bones/layers/transform.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"
#include "trigonometry.hpp"

namespace motus::bones::layers {
namespace {

/// a + share * (b - a).
glm::dvec3 mixed(const glm::dvec3& a, const glm::dvec3& b, double weight) {
    return weight >= 1.0 ? b : a + weight * (b - a);
}

/// Sine of half the angle of a unit quaternion, and that half: 0 to a quarter turn, the shorter way.
struct HalfAngle {
    double sine, radians;
};
HalfAngle half_angle(const glm::dquat& turn) {
    const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    return {sine, arc_tangent(sine, std::abs(turn.w))};
}

constexpr double quarter_turn = 0.5 * std::numbers::pi;

}  // namespace

Transform transform_of(const glm::dmat4& matrix) {
    Transform result;
    result.location = glm::dvec3(matrix[3]);
    glm::dmat3 axes(matrix);
    const double sign = handedness(axes);
    for (int i = 0; i < 3; ++i) result.scale[i] = sign * length_of(axes[i]);
    axes *= sign;
    result.rotation = frame_of(axes);
    return result;
}

glm::dmat4 matrix_of(const Transform& transform) {
    const glm::dmat3 axes = glm::mat3_cast(transform.rotation);
    glm::dmat4 result(1.0);
    for (int i = 0; i < 3; ++i) result[i] = glm::dvec4(transform.scale[i] * axes[i], 0.0);
    result[3] = glm::dvec4(transform.location, 1.0);
    return result;
}

bool is_finite(const Transform& transform) {
    return motus::is_finite(transform.location) && motus::is_finite(transform.rotation) &&
           motus::is_finite(transform.scale);
}

glm::dquat part_of_turn(const glm::dquat& turn, double weight) {
    if (weight <= 0.0) return no_turn;
    const glm::dquat near = turn.w < 0.0 ? -turn : turn;
    if (weight >= 1.0) return near;
    const double sine = std::sqrt(near.x * near.x + near.y * near.y + near.z * near.z);
    const Angle part = angle_of(weight * arc_tangent(sine, near.w));
    const double along = sine > 1e-150 ? part.sine / sine : weight;
    return {part.cosine, along * near.x, along * near.y, along * near.z};
}

glm::dquat whole_turn(const glm::dquat& part, double weight) {
    const glm::dquat near = part.w < 0.0 ? -part : part;
    if (weight >= 1.0) return near;
    const HalfAngle half = half_angle(near);
    if (half.sine == 0.0) return no_turn;
    // Written so that a weight of NaN makes the result NaN.
    const bool is_more = weight * quarter_turn <= half.radians;
    const Angle whole = angle_of(is_more ? quarter_turn : half.radians / weight);
    const double along = half.sine > 1e-150 ? whole.sine / half.sine : 1.0 / weight;
    return {whole.cosine, along * near.x, along * near.y, along * near.z};
}

bool has_whole_turn(const glm::dquat& part, double weight) {
    constexpr double rounding = 1e-12;  // rad
    return half_angle(part).radians <= weight * quarter_turn + rounding;
}

Transform overridden(const Transform& base, const Transform& source, double weight, unsigned channels) {
    Transform result = base;
    if ((channels & location) != 0) result.location = mixed(base.location, source.location, weight);
    if ((channels & scale) != 0) result.scale = mixed(base.scale, source.scale, weight);
    if ((channels & rotation) != 0)
        result.rotation =
            weight >= 1.0
                ? source.rotation
                : normalized_product(base.rotation *
                                     part_of_turn(glm::conjugate(base.rotation) * source.rotation, weight));
    return result;
}

Transform added(const Transform& base, const Transform& source, const Transform& reference, double weight,
                unsigned channels) {
    Transform result = base;
    if ((channels & location) != 0) result.location += weight * (source.location - reference.location);
    if ((channels & rotation) != 0)
        result.rotation = normalized_product(
            base.rotation * part_of_turn(glm::conjugate(reference.rotation) * source.rotation, weight));
    if ((channels & scale) != 0) {
        for (int i = 0; i < 3; ++i) {
            if (reference.scale[i] == 0.0) continue;
            result.scale[i] *= 1.0 + weight * (source.scale[i] / reference.scale[i] - 1.0);
        }
    }
    return result;
}

Transform between_transforms(const Transform& base, const Transform& result) {
    Transform move;
    move.location = result.location - base.location;
    move.rotation = normalized_product(glm::conjugate(base.rotation) * result.rotation);
    for (int i = 0; i < 3; ++i) {
        if (base.scale[i] != 0.0) move.scale[i] = result.scale[i] / base.scale[i];
    }
    return move;
}

}  // namespace motus::bones::layers
