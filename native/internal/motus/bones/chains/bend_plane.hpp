// The plane that a chain bends in. For the topics of the library alone.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "motus/bones/chains/two_bone.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::chains {

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

/// The input of the choice of the elbow's side, of one chain or of several: Real is double, or several
/// doubles (motus/core/wide-inl.hpp).
template <class Real, class Vector>
struct BendSides {
    Vector along;  ///< unit, root to target
    Vector pole;   ///< from the root
    Vector plane;  ///< as in TwoBone
    Real near;     ///< a pole nearer to the root counts as this far away
    Real band;     ///< from this sine of its angle to the line on the pole alone decides
    Real bend;     ///< 1 or -1
};
using BendSide = BendSides<double, glm::dvec3>;

/// bend_normal() of bend_plane-inl.hpp if the pole is near the line and the plane does not decide by itself,
/// and for lengths whose squares lose digits.
[[nodiscard]] glm::dvec3 faded_slowly(const BendSide& side);

/// The unit normal n for which n x along points to the elbow's side; see TwoBone::plane. Coordinates of the
/// pole are within 1e100.
[[nodiscard]] glm::dvec3 bend_normal(const BendSide& side);

// Bounds of lengths whose squares keep all digits, and of those whose fourth powers do.
inline constexpr double least_square = 1e-200, largest_square = 1e200;
inline constexpr double least_to_square = 1e-100, largest_to_square = 1e100;

}  // namespace motus::bones::chains
