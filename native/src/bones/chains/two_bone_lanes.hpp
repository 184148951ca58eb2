// Two bones, one chain or several at once: templates for the functions of one instruction set, which they are
// inlined into. Private to the library.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

#include "motus/bones/chains/bend_plane.hpp"
#include "motus/bones/chains/triangle.hpp"
#include "motus/bones/chains/two_bone.hpp"

namespace motus::bones::chains {

inline constexpr double largest_double = std::numeric_limits<double>::max();

/// The line from root to target for a target that nearly lies on the root: towards the pole, if the elbow can
/// be there.
[[nodiscard]] glm::dvec3 line_of_coincident(const TwoBone& chain, glm::dvec3 target, glm::dvec3 pole);

/// solve_two_bone() for one chain of any sizes.
void solve_one(const TwoBone& chain, TwoBoneSolution& out);

/// Functions that solve many chains, for one instruction set; all sets give the same bits.
struct TwoBoneKernel {
    const char* name;
    void (*solve)(std::span<const TwoBone> chains, std::span<TwoBoneSolution> out);
};

/// The kernels that this processor can run, the fastest last.
[[nodiscard]] std::span<const TwoBoneKernel> two_bone_kernels();

template <class Real>
[[nodiscard, gnu::always_inline]] inline Real largest_of(const glm::vec<3, Real>& v) {
    using std::abs, std::max;
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// soft_reach() of one chain, or of several chains in the lanes of Real.
template <class Real>
[[nodiscard, gnu::always_inline]] inline Real softened(Real distance, Real reach, Real softness) {
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

/// The number whose bytes are a Reason, for TwoBoneSolution::reason and what is unused behind it.
template <class Real>
[[nodiscard, gnu::always_inline]] inline Real reason_bits(Reason reason) {
    return Real(std::bit_cast<double>(static_cast<std::uint64_t>(reason)));
}

// A chain's numbers as they stand in memory, one behind the other, and its solution's.
inline constexpr std::size_t chain_numbers = 16, solution_numbers = 12;
static_assert(std::endian::native == std::endian::little && std::is_standard_layout_v<TwoBone> &&
              std::is_standard_layout_v<TwoBoneSolution>);
static_assert(offsetof(TwoBone, bend) == chain_numbers * sizeof(double) &&
              offsetof(TwoBoneSolution, reason) == (solution_numbers - 1) * sizeof(double) &&
              sizeof(TwoBoneSolution) == solution_numbers * sizeof(double));

/// The numbers of several chains, each of all chains in the lanes of a Real.
template <class Real>
struct ChainNumbers {
    Real of[chain_numbers];  // NOLINT(*-avoid-c-arrays): see load_fields()

    [[gnu::always_inline]] explicit ChainNumbers(const TwoBone* chains) {
        load_fields(chains, sizeof(TwoBone), of);
    }
    [[nodiscard, gnu::always_inline]] Real operator[](std::size_t number) const { return of[number]; }
};
/// Those of one chain are read where they are needed: it has no registers for all of them.
template <>
struct ChainNumbers<double> {
    const TwoBone* chain;

    [[gnu::always_inline]] explicit ChainNumbers(const TwoBone* one) : chain(one) {}
    [[nodiscard, gnu::always_inline]] double operator[](std::size_t number) const {
        double value = 0.0;
        std::memcpy(&value, reinterpret_cast<const char*>(chain) + number * sizeof(double), sizeof(double));
        return value;
    }
};

/// Fields of TwoBone for one chain, or for several chains in the lanes of Real.
template <class Real>
struct Chains {
    using Vector = glm::vec<3, Real>;

    const TwoBone* given;
    ChainNumbers<Real> numbers{given};
    Vector root{numbers[0], numbers[1], numbers[2]};
    Vector goal{numbers[3], numbers[4], numbers[5]};
    Vector target = goal - root;  ///< seen from the root
    Vector pole = Vector(numbers[6], numbers[7], numbers[8]) - root;
    Real length1 = numbers[9];
    Real length2 = numbers[10];

    [[gnu::always_inline]] explicit Chains(const TwoBone* chains) : given(chains) {}

    [[nodiscard, gnu::always_inline]] Real softness() const { return numbers[11]; }
    [[nodiscard, gnu::always_inline]] Real stretch() const { return numbers[12]; }
    [[nodiscard, gnu::always_inline]] Vector plane() const { return {numbers[13], numbers[14], numbers[15]}; }
    [[nodiscard, gnu::always_inline]] Real bend() const {
        return [&]<int... i>(std::integer_sequence<int, i...>) {
            return Real(static_cast<double>(given[i].bend)...);
        }
        (std::make_integer_sequence<int, lane_count<Real>>());
    }

    /// Whether the squares of all relevant numbers, and the products of two squares, neither overflow nor
    /// underflow.
    [[nodiscard, gnu::always_inline]] bool are_plain() const {
        using std::max;
        const Real largest = max(largest_of(target), max(length1, length2));
        const Real zero = 0.0, low = 1e-100, high = 1e100;
        return all(((largest >= low) | (largest == zero)) & (largest <= high) & (largest_of(pole) <= high));
    }
};

/// Solves chains for which are_plain() is true. faded: as bend_normal() wants it.
template <class Real, class Faded>
[[gnu::always_inline]] inline void solve_plain(const Chains<Real>& chains, const Faded& faded,
                                               TwoBoneSolution* out) {
    using std::abs, std::max, std::min, std::sqrt;
    using Vector = glm::vec<3, Real>;
    const Real zero = 0.0, one = 1.0;
    const Vector& target = chains.target;
    const Real longest = chains.length1 + chains.length2;
    const Real shortest = abs(chains.length1 - chains.length2);
    const Real distance = sqrt(glm::dot(target, target));
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
    Vector along = target * (one / max(distance, vanished));
    const auto is_coincident = distance <= vanished;
    for (int i = 0; any(is_coincident) && i < lane_count<Real>; ++i)
        if (lane(is_coincident, i))
            set_lane(along, i, line_of_coincident(chains.given[i], lane(target, i), lane(chains.pole, i)));

    const Vector plane = chains.plane();
    const auto has_no_plane = (plane.x == zero) & (plane.y == zero) & (plane.z == zero);
    const Real band = select(has_no_plane, Real(pole_band_no_plane), Real(pole_band));
    const Vector normal =
        bend_normal(BendSide<Real>{along, chains.pole, plane, longest, band, chains.bend()}, faded);
    const Direction<Real> bone = shoulder(chains.length1, chains.length2, longest, shortest, reach);
    const Vector elbow =
        chains.root + (along * (length1 * bone.cosine) + glm::cross(normal, along) * (length1 * bone.sine));
    const Vector tip = select(distance == end, chains.goal, chains.root + along * end);
    const Real residual = abs(distance - end);
    const auto is_reached = residual <= Real(reach_tolerance) * (longest + distance);
    const auto is_too_far = distance > end;
    if constexpr (std::is_same_v<Real, double>) {
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
            select(is_too_far, reason_bits<Real>(Reason::too_far), reason_bits<Real>(Reason::too_near));
        const Real reason = select(is_reached, reason_bits<Real>(Reason::reached), why_not);
        // NOLINTNEXTLINE(*-avoid-c-arrays): see store_fields()
        const Real found[solution_numbers] = {elbow.x,  elbow.y,  elbow.z,  tip.x, tip.y,    tip.z,
                                              normal.x, normal.y, normal.z, scale, residual, reason};
        store_fields(found, out, sizeof(TwoBoneSolution));
    }
}

/// Solves as many chains at once as a Real has lanes. chains and out have the same size.
template <class Real, class Faded>
[[gnu::always_inline]] inline void solve_in_lanes(std::span<const TwoBone> chains, const Faded& faded,
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

}  // namespace motus::bones::chains
