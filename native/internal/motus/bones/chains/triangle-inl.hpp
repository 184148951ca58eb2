// Angles of a triangle by its sides, without inverse functions, of one triangle or several: see
// motus/core/wide-inl.hpp.
#if defined(MOTUS_BONES_CHAINS_TRIANGLE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_BONES_CHAINS_TRIANGLE_INL_HPP
#undef MOTUS_BONES_CHAINS_TRIANGLE_INL_HPP
#else
#define MOTUS_BONES_CHAINS_TRIANGLE_INL_HPP
#endif

#include <algorithm>
#include <cmath>

#include "motus/core/wide-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::bones::chains::HWY_NAMESPACE {

using namespace motus::HWY_NAMESPACE;

/// tan^2(angle / 2) = opposite / adjacent, both >= 0; their sum is 4 a b if the sides make a triangle.
template <class Real>
struct HalfAngle {
    Real opposite, adjacent;
};

/// The angle between the sides a and b, opposite c. Kahan, "Miscalculating Area and Angles of a Needle-like
/// Triangle" (2014), section 6: none of its differences loses digits, not even for needles.
template <class Real>
HWY_INLINE HalfAngle<Real> half_angle(Real a, Real b, Real c) {
    using std::max, std::min;
    const Real zero = 0.0;
    const Real longer = max(a, b);
    const Real shorter = min(a, b);
    const Real excess = select(shorter >= c, c - (longer - shorter), shorter - (longer - c));
    return {((longer - shorter) + c) * max(excess, zero),
            (longer + (shorter + c)) * max((longer - c) + shorter, zero)};
}

template <class Real>
struct Direction {
    Real cosine, sine;
};

/// cosine^2 + sine^2 = 1 to the last digits. A right angle if one of the sides is negligible beside
/// the other.
template <class Real>
HWY_INLINE Direction<Real> direction_of(const HalfAngle<Real>& half) {
    using std::sqrt;
    const Real no_side = 1e-290;
    const Real sum = half.opposite + half.adjacent;
    const Real inverse = Real(1.0) / sum;
    const Real opposite = half.opposite * inverse;
    const Real adjacent = half.adjacent * inverse;
    return {select(sum < no_side, Real(0.0), adjacent - opposite),
            select(sum < no_side, Real(1.0), Real(2.0) * sqrt(opposite * adjacent))};
}

/// Direction of the first of two bones, seen from the line to the tip at distance `reach`; longest, shortest:
/// sum and difference of the lengths. The ends of the reach are compared exactly: near them a rounding of
/// 1e-16 would become an angle of 1e-8 rad.
template <class Real>
HWY_INLINE Direction<Real> shoulder(Real length1, Real length2, Real longest, Real shortest, Real reach) {
    const Real zero = 0.0, one = 1.0;
    const auto is_straight = reach >= longest;
    const auto is_folded = (reach <= shortest) & (shortest > zero);
    const auto is_at_end = is_straight | is_folded;
    Direction<Real> bone{select(is_straight | (length1 > length2), one, Real(-1.0)), zero};
    if (all(is_at_end)) return bone;
    const Direction<Real> bent = direction_of(half_angle(length1, reach, length2));
    return {select(is_at_end, bone.cosine, bent.cosine), select(is_at_end, bone.sine, bent.sine)};
}

}  // namespace motus::bones::chains::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
