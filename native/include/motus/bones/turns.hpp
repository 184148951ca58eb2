// Rotations that take a direction or frame to another one (from-to rotations), and slerp.
//
// Costs: O(1), of a row O(links). Allocates nothing. Any number of threads at once.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/config.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones {

inline constexpr glm::dquat no_turn{1.0, 0.0, 0.0, 0.0};

/// 1 for right-handed axes, -1 for mirrored ones.
[[nodiscard]] inline double handedness(const glm::dmat3& axes) {
    return glm::determinant(axes) < 0.0 ? -1.0 : 1.0;
}

/// Angle between vectors of any length, rad, 0 to pi; precise for the smallest and the largest angles.
[[nodiscard]] inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The smallest rotation that takes the unit vector `from` to the unit vector `to`; half a turn about `axis`
/// (unit, made perpendicular) if they are opposite.
[[nodiscard]] glm::dquat half_turn_to(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& axis);
[[nodiscard]] inline glm::dquat smallest_turn(const glm::dvec3& from, const glm::dvec3& to,
                                              const glm::dvec3& axis) {
    const double w = 1.0 + glm::dot(from, to);
    constexpr double opposite = 1e-13;
    if (w < opposite) return half_turn_to(from, to, axis);
    const glm::dvec3 v = glm::cross(from, to);
    const double scale = 1.0 / std::sqrt(w * w + glm::dot(v, v));
    return {scale * w, scale * v.x, scale * v.y, scale * v.z};
}

/// The smallest rotation that takes the direction of `from` to that of `to`, none if one of them has no
/// length; half a turn about the result of `axis()` if they are opposite.
template <class Axis>
[[nodiscard]] inline glm::dquat smallest_turn_between(const glm::dvec3& from, const glm::dvec3& to,
                                                      const Axis& axis) {
    const double squares = glm::dot(from, from) * glm::dot(to, to);
    constexpr double tiny = 1e-200, huge = 1e200;  // outside these the squares below over- or underflow
    if (squares > tiny && squares < huge) {
        const double lengths = std::sqrt(squares);
        const double w = lengths + glm::dot(from, to);
        constexpr double opposite = 1e-13;
        if (w >= opposite * lengths) {
            const glm::dvec3 v = glm::cross(from, to);
            const double scale = 1.0 / std::sqrt(w * w + glm::dot(v, v));
            return {scale * w, scale * v.x, scale * v.y, scale * v.z};
        }
    }
    const glm::dvec3 none(0.0);
    const glm::dvec3 unit_from = direction_or(from, none);
    const glm::dvec3 unit_to = direction_or(to, none);
    return unit_from == none || unit_to == none ? no_turn : smallest_turn(unit_from, unit_to, axis());
}

/// Rotations by which the links of a row turn, in world space, from the directions `before` to those `after`,
/// vectors of any length: each link takes the next ones along, and these turn by the smallest rotation from
/// there. A link that has no length, or is not finite, before or after, turns with the one above. Throws
/// std::invalid_argument if the spans differ in size.
void turn_links(std::span<const glm::dvec3> before, std::span<const glm::dvec3> after,
                std::span<glm::dquat> turns);

/// 1 / sqrt(square) of a square that is 1 except for rounding, such as that of a product of unit quaternions.
[[nodiscard]] inline double inverse_root_near_one(double square) {
    const double excess = square - 1.0;
    constexpr double near = 1e-8;  // the next term of the series is below the doubles' rounding
    return std::abs(excess) < near ? 1.0 - 0.5 * excess : 1.0 / std::sqrt(square);
}

/// The unit quaternion nearest to a product of unit quaternions, whose length has rounding errors.
[[nodiscard]] inline glm::dquat normalized_product(const glm::dquat& product) {
    return product * inverse_root_near_one(glm::dot(product, product));
}

/// The fraction `weight` of a unit quaternion's turn, by the shorter way; exact for 0 and 1.
[[nodiscard]] glm::dquat share_of_turn(const glm::dquat& turn, double weight);

/// The fraction `weight` of the shorter way from a to b, unit quaternions.
[[nodiscard]] inline glm::dquat between(const glm::dquat& a, const glm::dquat& b, double weight) {
    return a * share_of_turn(glm::conjugate(a) * b, weight);
}

/// Angle of a unit quaternion's turn, rad, 0 to pi.
[[nodiscard]] inline double angle_of_turn(const glm::dquat& turn) {
    return 2.0 * std::atan2(std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z), std::abs(turn.w));
}

/// The frame of axes that may be scaled, sheared and mirrored: Y along the second, Z on the third one's side
/// of it, X to make it right-handed. For any linear map M, frame_of(M * axes) is the image of the frame
/// of `axes`: an orientation that matches a goal in one space matches it in every other space.
[[nodiscard]] glm::dquat frame_of(const glm::dmat3& axes);

/// The frame of axes whose second and third one have these directions, unit vectors.
[[nodiscard]] glm::dquat frame_of(const glm::dmat3& axes, const glm::dvec3& y, glm::dvec3 z);

}  // namespace motus::bones
