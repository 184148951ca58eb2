// Two bones, one chain or several at once: see motus/core/wide-inl.hpp.
#if defined(MOTUS_BONES_CHAINS_TWO_BONE_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_BONES_CHAINS_TWO_BONE_LANES_INL_HPP
#undef MOTUS_BONES_CHAINS_TWO_BONE_LANES_INL_HPP
#else
#define MOTUS_BONES_CHAINS_TWO_BONE_LANES_INL_HPP
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

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

// A chain's numbers as they stand in memory, one behind the other, and its solution's.
inline constexpr std::size_t chain_numbers = 16, solution_numbers = 12;
static_assert(std::endian::native == std::endian::little && std::is_standard_layout_v<TwoBone> &&
              std::is_standard_layout_v<TwoBoneSolution>);
static_assert(offsetof(TwoBone, bend) == chain_numbers * sizeof(double) &&
              offsetof(TwoBoneSolution, reason) == (solution_numbers - 1) * sizeof(double) &&
              sizeof(TwoBoneSolution) == solution_numbers * sizeof(double));

/// The number whose bytes are a Reason, for TwoBoneSolution::reason and what is unused behind it.
HWY_INLINE double bits_of(Reason reason) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(reason));
}

/// The numbers of several chains, each of all chains in the lanes of a Real.
template <class Real>
struct ChainNumbers {
    Real of[chain_numbers];  // NOLINT(*-avoid-c-arrays): as load_fields() has it

    HWY_INLINE explicit ChainNumbers(const TwoBone* chains) { load_fields(chains, sizeof(TwoBone), of); }
    HWY_INLINE Real operator[](std::size_t number) const { return of[number]; }
};
/// Those of one chain are read where they are needed: it has no registers for all of them.
template <>
struct ChainNumbers<double> {
    const TwoBone* chain;

    HWY_INLINE explicit ChainNumbers(const TwoBone* one) : chain(one) {}
    HWY_INLINE double operator[](std::size_t number) const {
        double value = 0.0;
        std::memcpy(&value, reinterpret_cast<const char*>(chain) + number * sizeof(double), sizeof(double));
        return value;
    }
};

/// Fields of TwoBone for one chain, or for several chains in the lanes of Real.
template <class Real>
struct Chains {
    const TwoBone* given;
    ChainNumbers<Real> numbers{given};
    Vector<Real> root{numbers[0], numbers[1], numbers[2]};
    Vector<Real> goal{numbers[3], numbers[4], numbers[5]};
    Vector<Real> target = goal - root;  ///< seen from the root
    Vector<Real> pole = Vector<Real>{numbers[6], numbers[7], numbers[8]} - root;
    Real length1 = numbers[9];
    Real length2 = numbers[10];

    HWY_INLINE explicit Chains(const TwoBone* chains) : given(chains) {}

    HWY_INLINE Real softness() const { return numbers[11]; }
    HWY_INLINE Real stretch() const { return numbers[12]; }
    HWY_INLINE Vector<Real> plane() const { return {numbers[13], numbers[14], numbers[15]}; }
    HWY_INLINE Real bend() const {
        static_assert(lane_count<Real> <= 4);
        if constexpr (lane_count<Real> == 1)
            return given[0].bend;
        else if constexpr (lane_count<Real> == 2)
            return Real(double(given[0].bend), double(given[1].bend));
        else
            return Real(double(given[0].bend), double(given[1].bend), double(given[2].bend),
                        double(given[3].bend));
    }

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
    const Real reach = max(softened(distance, longest, chains.softness()), shortest);

    // Distance of the tip from the root, and length of the first bone; stretch multiplies both by one factor.
    Real end = reach;
    Real length1 = chains.length1;
    Real scale = one;
    const Real stretch = chains.stretch();
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

    const Vector<Real> plane = chains.plane();
    const auto has_no_plane = (plane.x == zero) & (plane.y == zero) & (plane.z == zero);
    const Real band = select(has_no_plane, Real(pole_band_no_plane), Real(pole_band));
    const Vector<Real> normal =
        bend_normal(Sides<Real>{along, chains.pole, plane, longest, band, chains.bend()}, faded);
    const Direction<Real> bone = shoulder(chains.length1, chains.length2, longest, shortest, reach);
    const Vector<Real> elbow =
        chains.root + (along * (length1 * bone.cosine) + cross(normal, along) * (length1 * bone.sine));
    const Vector<Real> tip = select(distance == end, chains.goal, chains.root + along * end);
    const Real residual = abs(distance - end);
    const auto is_reached = residual <= Real(reach_tolerance) * (longest + distance);
    const auto is_too_far = distance > end;
    if constexpr (lane_count<Real> == 1) {
        const Reason why_not = is_too_far ? Reason::too_far : Reason::too_near;
        // Number by number: what is put together first is copied in parts that are larger, and waits for
        // them.
        out->elbow.x = elbow.x;
        out->elbow.y = elbow.y;
        out->elbow.z = elbow.z;
        out->tip.x = tip.x;
        out->tip.y = tip.y;
        out->tip.z = tip.z;
        out->normal.x = normal.x;
        out->normal.y = normal.y;
        out->normal.z = normal.z;
        out->scale = scale;
        out->residual = residual;
        out->reason = is_reached ? Reason::reached : why_not;
    } else {
        const Real why_not =
            select(is_too_far, Real(bits_of(Reason::too_far)), Real(bits_of(Reason::too_near)));
        const Real reason = select(is_reached, Real(bits_of(Reason::reached)), why_not);
        // NOLINTNEXTLINE(*-avoid-c-arrays): as store_fields() has it
        const Real found[solution_numbers] = {elbow.x,  elbow.y,  elbow.z,  tip.x, tip.y,    tip.z,
                                              normal.x, normal.y, normal.z, scale, residual, reason};
        store_fields(found, out, sizeof(TwoBoneSolution));
    }
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
