// The plane that a chain bends in, of one chain or of several: see motus/core/wide-inl.hpp.
#if defined(MOTUS_BONES_CHAINS_BEND_PLANE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_BONES_CHAINS_BEND_PLANE_INL_HPP
#undef MOTUS_BONES_CHAINS_BEND_PLANE_INL_HPP
#else
#define MOTUS_BONES_CHAINS_BEND_PLANE_INL_HPP
#endif

#include <algorithm>
#include <cmath>

#include "motus/bones/chains/bend_plane.hpp"
#include "motus/core/wide-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::bones::chains::HWY_NAMESPACE {

using namespace motus::HWY_NAMESPACE;

// Vectors that only rare branches read are passed by value: a vector whose address is taken is kept in memory
// on the frequent branch too, which costs more than all the arithmetic of that branch.

template <class Real>
using Sides = BendSides<Real, Vector<Real>>;

/// The input of one lane of several.
template <class Real>
HWY_INLINE BendSide side_of(const Sides<Real>& side, int index) {
    return {lane(side.along, index), lane(side.pole, index), lane(side.plane, index),
            lane(side.near, index),  lane(side.band, index), lane(side.bend, index)};
}

/// A normal of any length, across the unit vector `along`.
template <class Real>
struct Start {
    Vector<Real> normal;
    Real length;
    Vector<Real> along;
};

/// blended_normal() of normals of any length. share: the weight over the
/// length of `to`.
template <class Real>
HWY_INLINE Vector<Real> blended(const Start<Real>& from, const Vector<Real>& to, Real share, Real weight) {
    using std::sqrt;
    // Of unit vectors: rest from + weight to + rest weight (1 - from . to) along x from. Here times length^2.
    const Real rest = Real(1.0) - weight;
    const Real detour = rest * (from.length * weight - share * dot(from.normal, to));
    const Real scale = from.length * from.length;
    const Vector<Real> sum =
        from.normal * (rest * from.length) + cross(from.along, from.normal) * detour + to * (scale * share);
    const Real square = dot(sum, sum);
    const auto is_long = square > Real(1e-20) * (scale * scale);
    return select(is_long, sum, from.normal) * (Real(1.0) / select(is_long, sqrt(square), from.length));
}

/// bend_normal() if the pole is near the line and fades out.
template <class Real>
HWY_INLINE Vector<Real> faded_normal(const Sides<Real>& side) {
    using std::max, std::sqrt;
    const Vector<Real> across = cross(side.along, side.pole);
    const Real square = dot(across, across);
    const Real far_square = max(dot(side.pole, side.pole), side.near * side.near);
    const Real size = dot(side.plane, side.plane);
    const Vector<Real> plane = side.plane - side.along * dot(side.plane, side.along);
    const Real plane_square = dot(plane, plane);

    const Real inverse = Real(1.0) / (side.band * sqrt(far_square));
    const Real x = sqrt(square) * inverse;
    const Real slope =
        x * (Real(3.0) - Real(2.0) * x);  // smooth_step(x) / x: on the line `across` has no direction
    Vector<Real> normal = blended<Real>({plane, sqrt(plane_square), side.along}, across,
                                        side.bend * inverse * slope, x * slope);

    const auto is_slow = !((square > Real(least_square)) & (far_square < Real(largest_square)) &
                           (size > Real(least_to_square)) & (size < Real(largest_to_square)) &
                           (plane_square >= Real(pole_band * pole_band) * size));
    for (int i = 0; any(is_slow) && i < lane_count<Real>; ++i)
        if (lane(is_slow, i)) set_lane(normal, i, faded_slowly(side_of(side, i)));
    return normal;
}

/// As chains::bend_normal(). faded(side): calls faded_normal(), not inlined, to keep the frequent branch
/// short.
template <class Real, class Faded>
HWY_INLINE Vector<Real> bend_normal(const Sides<Real>& side, const Faded& faded) {
    using std::max, std::sqrt;
    const Real vanished = 1e-290;  // squared: below it digits are lost
    const Vector<Real> across = cross(side.along, side.pole);
    const Real square = dot(across, across);
    const Real far_square = max(dot(side.pole, side.pole), side.near * side.near);
    const auto is_clear = (square > vanished) & (square >= side.band * side.band * far_square);
    const Vector<Real> clear = across * (side.bend / sqrt(square));
    return all(is_clear) ? clear : select(is_clear, clear, faded(side));
}

}  // namespace motus::bones::chains::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
