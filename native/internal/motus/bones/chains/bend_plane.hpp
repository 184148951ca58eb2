// The plane that a chain bends in. For the topics of the library alone.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "motus/bones/chains/two_bone.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/wide.hpp"

namespace motus::bones::chains {

// Vectors that only rare branches read are passed by value: a vector whose address is taken is kept in memory
// on the frequent branch too, which costs more than all the arithmetic of that branch.

/// A unit normal across the unit vector `along`: that of `plane`, or if `plane` is zero or along `along`, one
/// that depends on `along` alone and jumps at a single direction.
[[nodiscard]] glm::dvec3 normal_across(const glm::dvec3& along, const glm::dvec3& plane);

/// From the unit normal `from` (weight 0) to the unit normal `to` (1), about `along`. All unit, both normals
/// across `along`; so is the result. If both normals are equal, the result is that normal. A pole that goes
/// once round the line takes its normal once round too, so that every way of fading it out has a jump; this
/// function jumps at a single direction and weight, which opposite normals, as mirrored poles have them, do
/// not meet.
[[nodiscard]] glm::dvec3 blended_normal(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& along,
                                        double weight);

/// How well a pose defines the plane that it bends in, by the sine of its bend: 0 up to 1 degree, 1 from 8
/// degrees on.
[[nodiscard]] inline double certainty_of_bend(double sine) {
    constexpr double sine_of_1 = 0.01745240643728351;
    constexpr double sine_of_8 = 0.13917310096006544;
    return smooth_step((sine - sine_of_1) / (sine_of_8 - sine_of_1));
}

/// The input of the choice of the elbow's side. Real: double, or several doubles (core/wide.hpp).
template <class Real>
struct BendSide {
    glm::vec<3, Real> along;  ///< unit, root to target
    glm::vec<3, Real> pole;   ///< from the root
    glm::vec<3, Real> plane;  ///< as in TwoBone
    Real near;                ///< a pole nearer to the root counts as this far away
    Real band;                ///< from this sine of its angle to the line on the pole alone decides
    Real bend;                ///< 1 or -1
};

/// The input of one lane of several.
template <class Real>
[[nodiscard, gnu::always_inline]] inline BendSide<double> side_of(const BendSide<Real>& side, int index) {
    return {lane(side.along, index), lane(side.pole, index), lane(side.plane, index),
            lane(side.near, index),  lane(side.band, index), lane(side.bend, index)};
}

/// faded_normal() if the plane does not decide by itself, and for lengths whose squares lose digits.
[[nodiscard]] glm::dvec3 faded_slowly(const BendSide<double>& side);

// Bounds of lengths whose squares keep all digits, and of those whose fourth powers do.
inline constexpr double least_square = 1e-200, largest_square = 1e200;
inline constexpr double least_to_square = 1e-100, largest_to_square = 1e100;

/// A normal of any length, across the unit vector `along`.
template <class Real>
struct Start {
    glm::vec<3, Real> normal;
    Real length;
    glm::vec<3, Real> along;
};

/// blended_normal() of normals of any length. share: the weight over the
/// length of `to`.
template <class Real>
[[nodiscard, gnu::always_inline]] inline glm::vec<3, Real> blended(const Start<Real>& from,
                                                                   const glm::vec<3, Real>& to, Real share,
                                                                   Real weight) {
    using std::sqrt;
    // Of unit vectors: rest from + weight to + rest weight (1 - from . to) along x from. Here times length^2.
    const Real rest = Real(1.0) - weight;
    const Real detour = rest * (from.length * weight - share * glm::dot(from.normal, to));
    const Real scale = from.length * from.length;
    const glm::vec<3, Real> sum = from.normal * (rest * from.length) +
                                  glm::cross(from.along, from.normal) * detour + to * (scale * share);
    const Real square = glm::dot(sum, sum);
    const auto is_long = square > Real(1e-20) * (scale * scale);
    return select(is_long, sum, from.normal) * (Real(1.0) / select(is_long, sqrt(square), from.length));
}

/// bend_normal() if the pole is near the line and fades out.
template <class Real>
[[nodiscard, gnu::always_inline]] inline glm::vec<3, Real> faded_normal(const BendSide<Real>& side) {
    using std::max, std::sqrt;
    using Vector = glm::vec<3, Real>;
    const Vector across = glm::cross(side.along, side.pole);
    const Real square = glm::dot(across, across);
    const Real far_square = max(glm::dot(side.pole, side.pole), side.near * side.near);
    const Real size = glm::dot(side.plane, side.plane);
    const Vector plane = side.plane - side.along * glm::dot(side.plane, side.along);
    const Real plane_square = glm::dot(plane, plane);

    const Real inverse = Real(1.0) / (side.band * sqrt(far_square));
    const Real x = sqrt(square) * inverse;
    const Real slope =
        x * (Real(3.0) - Real(2.0) * x);  // smooth_step(x) / x: on the line `across` has no direction
    Vector normal = blended<Real>({plane, sqrt(plane_square), side.along}, across,
                                  side.bend * inverse * slope, x * slope);

    const auto is_slow = !((square > Real(least_square)) & (far_square < Real(largest_square)) &
                           (size > Real(least_to_square)) & (size < Real(largest_to_square)) &
                           (plane_square >= Real(pole_band * pole_band) * size));
    for (int i = 0; any(is_slow) && i < lane_count<Real>; ++i)
        if (lane(is_slow, i)) set_lane(normal, i, faded_slowly(side_of(side, i)));
    return normal;
}

/// faded_normal() of one chain.
[[nodiscard]] glm::dvec3 faded_alone(BendSide<double> side);

/// The unit normal n for which n x along points to the elbow's side; see TwoBone::plane. Coordinates of the
/// pole are within 1e100. faded(side): calls faded_normal(), not inlined, to keep the frequent branch short.
template <class Real, class Faded>
[[nodiscard, gnu::always_inline]] inline glm::vec<3, Real> bend_normal(const BendSide<Real>& side,
                                                                       const Faded& faded) {
    using std::max, std::sqrt;
    const Real vanished = 1e-290;  // squared: below it digits are lost
    const glm::vec<3, Real> across = glm::cross(side.along, side.pole);
    const Real square = glm::dot(across, across);
    const Real far_square = max(glm::dot(side.pole, side.pole), side.near * side.near);
    const auto is_clear = (square > vanished) & (square >= side.band * side.band * far_square);
    const glm::vec<3, Real> clear = across * (side.bend / sqrt(square));
    return all(is_clear) ? clear : select(is_clear, clear, faded(side));
}

[[nodiscard]] inline glm::dvec3 bend_normal(const BendSide<double>& side) {
    return bend_normal(side, faded_alone);
}

}  // namespace motus::bones::chains
