// The plane that a chain bends in. Private to the library.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "pair.hpp"
#include "smooth.hpp"

namespace motus {

// Vectors that only rare branches look at go by value: one whose address is taken lives in memory on the
// frequent branch too, which costs more than all the arithmetic there.

/// v at unit length whatever its size, zero for zero.
[[nodiscard]] glm::dvec3 unit_vector(glm::dvec3 v);

/// A unit normal across the unit vector `along`: `plane`'s, or where that is zero or along it, one that
/// depends on `along` alone and jumps at one odd direction only.
[[nodiscard]] glm::dvec3 normal_across(const glm::dvec3& along, const glm::dvec3& plane);

/// From the unit normal `from` (weight 0) to the unit normal `to` (1), about `along`. All unit, both normals
/// across `along`; so is the result. `to` alike `from`: that. A pole that goes once round the line takes
/// its normal once round too, so that no way of fading it out is free of a jump; this one jumps at one single
/// direction and weight, and opposite normals, which mirrored poles lead to, are not that.
[[nodiscard]] glm::dvec3 blended_normal(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& along,
                                        double weight);

/// How sure the plane is that a pose bends in, by the sine of its bend: 0 up to 1 degree, 1 from 8 degrees
/// on.
[[nodiscard]] inline double certainty_of_bend(double sine) {
    constexpr double sine_of_1 = 0.01745240643728351;
    constexpr double sine_of_8 = 0.13917310096006544;
    return smooth_step((sine - sine_of_1) / (sine_of_8 - sine_of_1));
}

/// What the elbow's side depends on. Real: double, or Pair for two at once.
template <class Real>
struct BendSide {
    glm::vec<3, Real> along;  ///< unit, root to target
    glm::vec<3, Real> pole;   ///< from the root
    glm::vec<3, Real> plane;  ///< as in TwoBone
    Real near;                ///< a pole nearer to the root counts as this far away
    Real band;                ///< sine of the pole's angle to the line from which on it decides alone
    Real bend;                ///< 1 or -1
};

/// bend_normal() where the pole is near the line and fades out.
template <class Real>
[[nodiscard]] glm::vec<3, Real> faded_normal(BendSide<Real> side);

/// The unit normal n for which n x along points to the elbow's side; see TwoBone::plane. The pole within
/// 1e100.
template <class Real>
[[nodiscard]] inline glm::vec<3, Real> bend_normal(const BendSide<Real>& side) {
    using std::max, std::sqrt;
    const Real vanished = 1e-290;  // squared: below it digits are lost
    const glm::vec<3, Real> across = glm::cross(side.along, side.pole);
    const Real square = glm::dot(across, across);
    const Real far_square = max(glm::dot(side.pole, side.pole), side.near * side.near);
    const auto is_clear = (square > vanished) & (square >= side.band * side.band * far_square);
    const glm::vec<3, Real> clear = across * (side.bend / sqrt(square));
    return all(is_clear) ? clear : select(is_clear, clear, faded_normal(side));
}

}  // namespace motus
