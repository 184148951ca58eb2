// Two bones, one chain or several at once: see motus/core/wide-inl.hpp.
#if defined(MOTUS_BONES_CHAINS_TWO_BONE_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_BONES_CHAINS_TWO_BONE_LANES_INL_HPP
#undef MOTUS_BONES_CHAINS_TWO_BONE_LANES_INL_HPP
#else
#define MOTUS_BONES_CHAINS_TWO_BONE_LANES_INL_HPP
#endif

#include <algorithm>
#include <cmath>
#include <span>

#include "motus/bones/chains/bend_plane-inl.hpp"
#include "motus/bones/chains/triangle-inl.hpp"
#include "motus/core/wide-inl.hpp"
#include "two_bone_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::bones::chains::HWY_NAMESPACE {

template <class Vector>
HWY_INLINE auto largest_of(const Vector& v) {
    using std::abs, std::max;
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// soft_reach() of one chain, or of several chains in the lanes of Real.
template <class Real>
HWY_INLINE Real softened(Real distance, Real reach, Real softness) {
    using std::max, std::min;
    const Real zero = 0.0, one = 1.0, third = 1.0 / 3.0;
    const Real soft = min(max(softness, zero), reach);
    const Real excess = distance - (reach - soft);
    const auto is_before = excess <= zero;
    const auto is_straight = distance >= reach + Real(2.0) * soft;
    const Real ends = select(is_before, distance, reach);
    if (all(is_before | is_straight)) return ends;
    // The power is multiplied out: a little is subtracted from the distance instead of a lot from the reach,
    // which loses fewer digits.
    const Real t = min(excess / soft * third, one);
    return select(is_before | is_straight, ends, min(distance - excess * t * (one - t * third), reach));
}

HWY_INLINE Reason reason_of(double distance, double end, double residual, double longest) {
    if (residual <= reach_tolerance * (longest + distance)) return Reason::reached;
    return distance > end ? Reason::too_far : Reason::too_near;
}

/// One number of each of as many chains as a Real has lanes.
template <class Real, class Number>
HWY_INLINE Real gathered(const TwoBone* chains, const Number& number) {
    static_assert(lane_count<Real> <= 4);
    if constexpr (lane_count<Real> == 1)
        return number(chains[0]);
    else if constexpr (lane_count<Real> == 2)
        return Real(number(chains[0]), number(chains[1]));
    else
        return Real(number(chains[0]), number(chains[1]), number(chains[2]), number(chains[3]));
}

template <class Real, class Point>
HWY_INLINE Vector<Real> gathered_points(const TwoBone* chains, const Point& point) {
    return {gathered<Real>(chains, [&](const TwoBone& chain) -> double { return point(chain).x; }),
            gathered<Real>(chains, [&](const TwoBone& chain) -> double { return point(chain).y; }),
            gathered<Real>(chains, [&](const TwoBone& chain) -> double { return point(chain).z; })};
}

/// Fields of TwoBone for one chain, or for several chains in the lanes of Real.
template <class Real>
struct Chains {
    const TwoBone* given;
    Vector<Real> root = gathered_points<Real>(given, [](const TwoBone& c) { return c.root; });
    Vector<Real> goal = gathered_points<Real>(given, [](const TwoBone& c) { return c.target; });
    Vector<Real> target = goal - root;  ///< seen from the root
    Vector<Real> pole = gathered_points<Real>(given, [](const TwoBone& c) { return c.pole; }) - root;
    Real length1 = gathered<Real>(given, [](const TwoBone& c) { return c.length1; });
    Real length2 = gathered<Real>(given, [](const TwoBone& c) { return c.length2; });

    HWY_INLINE explicit Chains(const TwoBone* chains) : given(chains) {}

    /// Whether the squares of all relevant numbers, and the products of two squares, neither overflow nor
    /// underflow.
    HWY_INLINE bool are_plain() const {
        using std::max;
        const Real largest = max(largest_of(target), max(length1, length2));
        const Real zero = 0.0, low = 1e-100, high = 1e100;
        return all(((largest >= low) | (largest == zero)) & (largest <= high) & (largest_of(pole) <= high));
    }
};

/// Solves chains for which are_plain() is true. faded: as bend_normal() wants it.
template <class Real, class Faded>
HWY_INLINE void solve_plain(const Chains<Real>& chains, const Faded& faded, TwoBoneSolution* out) {
    using std::abs, std::max, std::min, std::sqrt;
    const Real zero = 0.0, one = 1.0;
    const Vector<Real>& target = chains.target;
    const Real longest = chains.length1 + chains.length2;
    const Real shortest = abs(chains.length1 - chains.length2);
    const Real distance = sqrt(dot(target, target));
    const Real softness = gathered<Real>(chains.given, [](const TwoBone& c) { return c.softness; });
    const Real reach = max(softened(distance, longest, softness), shortest);

    // Distance of the tip from the root, and length of the first bone; stretch multiplies both by one factor.
    Real end = reach;
    Real length1 = chains.length1;
    Real scale = one;
    const Real stretch = gathered<Real>(chains.given, [](const TwoBone& c) { return c.stretch; });
    const auto is_stretched = (stretch > zero) & (distance > reach) & (reach > zero);
    if (any(is_stretched)) {
        const Real part = reach + stretch * (distance - reach);
        end = select(is_stretched, select(stretch < one, part, distance), reach);
        length1 = select(is_stretched, length1 / reach * end, length1);
        scale = select(is_stretched, min(end / reach, Real(largest_double)), one);
    }

    const Real vanished = 1e-140;  // below it squares lose digits
    Vector<Real> along = target * (one / max(distance, vanished));
    const auto is_coincident = distance <= vanished;
    for (int i = 0; any(is_coincident) && i < lane_count<Real>; ++i)
        if (lane(is_coincident, i))
            set_lane(along, i, line_of_coincident(chains.given[i], lane(target, i), lane(chains.pole, i)));

    const Vector<Real> plane = gathered_points<Real>(chains.given, [](const TwoBone& c) { return c.plane; });
    const Real bend = gathered<Real>(chains.given, [](const TwoBone& c) -> double { return c.bend; });
    const auto has_no_plane = (plane.x == zero) & (plane.y == zero) & (plane.z == zero);
    const Real band = select(has_no_plane, Real(pole_band_no_plane), Real(pole_band));
    const Vector<Real> normal =
        bend_normal(Sides<Real>{along, chains.pole, plane, longest, band, bend}, faded);
    const Direction<Real> bone = shoulder(chains.length1, chains.length2, longest, shortest, reach);
    const Vector<Real> elbow =
        chains.root + (along * (length1 * bone.cosine) + cross(normal, along) * (length1 * bone.sine));
    const Vector<Real> tip = select(distance == end, chains.goal, chains.root + along * end);
    const Real residual = abs(distance - end);
    for (int i = 0; i < lane_count<Real>; ++i)
        out[i] = {.elbow = lane(elbow, i),
                  .tip = lane(tip, i),
                  .normal = lane(normal, i),
                  .scale = lane(scale, i),
                  .residual = lane(residual, i),
                  .reason = reason_of(lane(distance, i), lane(end, i), lane(residual, i), lane(longest, i))};
}

/// Solves as many chains at once as a Real has lanes. chains and out have the same size.
template <class Real, class Faded>
HWY_INLINE void solve_in_lanes(std::span<const TwoBone> chains, const Faded& faded,
                               std::span<TwoBoneSolution> out) {
    constexpr std::size_t lanes = lane_count<Real>;
    std::size_t i = 0;
    for (; i + lanes <= chains.size(); i += lanes) {
        if (const Chains<Real> some(&chains[i]); some.are_plain()) {
            solve_plain(some, faded, &out[i]);
        } else {
            for (std::size_t j = i; j < i + lanes; ++j) solve_one(chains[j], out[j]);
        }
    }
    for (; i < chains.size(); ++i) solve_one(chains[i], out[i]);
}

}  // namespace motus::bones::chains::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
