#include "motus/two_bone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "bend_plane.hpp"
#include "triangle.hpp"

namespace motus {
namespace {

constexpr double largest_double = std::numeric_limits<double>::max();

template <class Real>
[[nodiscard]] inline Real largest_of(const glm::vec<3, Real>& v) {
    using std::abs, std::max;
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// soft_reach() of one or two.
template <class Real>
[[nodiscard]] inline Real softened(Real distance, Real reach, Real softness) {
    using std::max, std::min;
    const Real zero = 0.0, one = 1.0, third = 1.0 / 3.0;
    const Real soft = min(max(softness, zero), reach);
    const Real excess = distance - (reach - soft);
    const auto is_before = excess <= zero;
    const auto is_straight = distance >= reach + Real(2.0) * soft;
    const Real ends = select(is_before, distance, reach);
    if (all(is_before | is_straight)) return ends;
    // The power multiplied out, so that little is taken from the distance rather than much from the reach.
    const Real t = min(excess / soft * third, one);
    return select(is_before | is_straight, ends, min(distance - excess * t * (one - t * third), reach));
}

/// The line from the root to a target that is nearly on it: where the elbow can be towards the pole, it is.
[[nodiscard]] glm::dvec3 line_of_coincident(const TwoBone& chain, glm::dvec3 target, glm::dvec3 pole) {
    if (target != glm::dvec3(0.0)) return unit_vector(target);
    const glm::dvec3 to_pole = unit_vector(pole);
    if (to_pole == glm::dvec3(0.0)) {
        const glm::dvec3 normal = unit_vector(chain.plane);
        return normal == glm::dvec3(0.0) ? glm::dvec3(0.0, 1.0, 0.0) : normal_across(normal, glm::dvec3(0.0));
    }
    const glm::dvec3 side = to_pole * static_cast<double>(chain.bend);
    if (chain.length1 > chain.length2) return side;
    if (chain.length1 < chain.length2) return -side;
    return glm::cross(side, normal_across(side, chain.plane));
}

[[nodiscard]] inline Reason reason_of(double distance, double end, double residual, double longest) {
    if (residual <= reach_tolerance * (longest + distance)) return Reason::reached;
    return distance > end ? Reason::too_far : Reason::too_near;
}

/// One number of as many chains as a Real holds.
template <class Real, class Number>
[[nodiscard, gnu::always_inline]] inline Real gathered(const TwoBone* chains, Number&& number) {
    if constexpr (lane_count<Real> == 1)
        return number(chains[0]);
    else
        return {number(chains[0]), number(chains[1])};
}

template <class Real, class Point>
[[nodiscard, gnu::always_inline]] inline glm::vec<3, Real> gathered_points(const TwoBone* chains,
                                                                           Point&& point) {
    return {gathered<Real>(chains, [&](const TwoBone& chain) -> double { return point(chain).x; }),
            gathered<Real>(chains, [&](const TwoBone& chain) -> double { return point(chain).y; }),
            gathered<Real>(chains, [&](const TwoBone& chain) -> double { return point(chain).z; })};
}

/// TwoBone, one or two at once.
template <class Real>
struct Chains {
    using Vector = glm::vec<3, Real>;

    const TwoBone* given;
    Vector root = gathered_points<Real>(given, [](const TwoBone& c) { return c.root; });
    Vector goal = gathered_points<Real>(given, [](const TwoBone& c) { return c.target; });
    Vector target = goal - root;  ///< seen from the root
    Vector pole = gathered_points<Real>(given, [](const TwoBone& c) { return c.pole; }) - root;
    Real length1 = gathered<Real>(given, [](const TwoBone& c) { return c.length1; });
    Real length2 = gathered<Real>(given, [](const TwoBone& c) { return c.length2; });

    explicit Chains(const TwoBone* chains) : given(chains) {}

    /// Whether squares of all that counts, and products of two of them, neither overflow nor underflow.
    [[nodiscard]] bool are_plain() const {
        using std::max;
        const Real largest = max(largest_of(target), max(length1, length2));
        const Real zero = 0.0, low = 1e-100, high = 1e100;
        return all(((largest >= low) | (largest == zero)) & (largest <= high) & (largest_of(pole) <= high));
    }
};

/// Solves chains whose numbers are plain.
template <class Real>
inline void solve_plain(const Chains<Real>& chains, TwoBoneSolution* out) {
    using std::abs, std::max, std::min, std::sqrt;
    using Vector = glm::vec<3, Real>;
    const Real zero = 0.0, one = 1.0;
    const Vector& target = chains.target;
    const Real longest = chains.length1 + chains.length2;
    const Real shortest = abs(chains.length1 - chains.length2);
    const Real distance = sqrt(glm::dot(target, target));
    const Real softness = gathered<Real>(chains.given, [](const TwoBone& c) { return c.softness; });
    const Real reach = max(softened(distance, longest, softness), shortest);

    // Where the tip stands, and how long the first bone is; both grow by one factor.
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
    Vector along = target * (one / max(distance, vanished));
    const auto is_coincident = distance <= vanished;
    for (int i = 0; any(is_coincident) && i < lane_count<Real>; ++i)
        if (lane(is_coincident, i))
            set_lane(along, i, line_of_coincident(chains.given[i], lane(target, i), lane(chains.pole, i)));

    const Vector plane = gathered_points<Real>(chains.given, [](const TwoBone& c) { return c.plane; });
    const Real bend = gathered<Real>(chains.given, [](const TwoBone& c) -> double { return c.bend; });
    const auto has_no_plane = (plane.x == zero) & (plane.y == zero) & (plane.z == zero);
    const Real band = select(has_no_plane, Real(pole_band_no_plane), Real(pole_band));
    const Vector normal = bend_normal<Real>({along, chains.pole, plane, longest, band, bend});
    const Direction<Real> bone = shoulder(chains.length1, chains.length2, longest, shortest, reach);
    const Vector elbow =
        chains.root + (along * (length1 * bone.cosine) + glm::cross(normal, along) * (length1 * bone.sine));
    const Vector tip = select(distance == end, chains.goal, chains.root + along * end);
    const Real residual = abs(distance - end);
    for (int i = 0; i < lane_count<Real>; ++i)
        out[i] = {.elbow = lane(elbow, i),
                  .tip = lane(tip, i),
                  .normal = lane(normal, i),
                  .scale = lane(scale, i),
                  .residual = lane(residual, i),
                  .reason = reason_of(lane(distance, i), lane(end, i), lane(residual, i), lane(longest, i))};
}

[[nodiscard]] glm::dvec3 within_doubles(const glm::dvec3& v) {
    return glm::clamp(v, glm::dvec3(-largest_double), glm::dvec3(largest_double));
}

[[nodiscard]] glm::dvec3 scaled(const glm::dvec3& v, int exponent) {
    return {std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent)};
}

/// b - a, in units of 2^exponent: 0, or 2 where the difference of two finite points overflows.
struct Difference {
    glm::dvec3 value;
    int exponent = 0;

    Difference(const glm::dvec3& a, const glm::dvec3& b) : value(b - a) {
        if (largest_of(value) <= largest_double) return;
        value = 0.25 * b - 0.25 * a;
        exponent = 2;
    }
};

/// point + offset * 2^unit. Large ones in quarters, so that a sum within the doubles has summands within
/// them.
[[nodiscard]] glm::dvec3 moved(const glm::dvec3& point, const glm::dvec3& offset, int unit) {
    if (unit < 1000) return within_doubles(point + scaled(offset, unit));
    return within_doubles(scaled(0.25 * point + scaled(offset, unit - 2), 2));
}

void solve(const TwoBone& chain, TwoBoneSolution& out);

/// Sizes far from 1, by solving the same chain in another unit of length: a power of two, so that nothing is
/// rounded but what is too small beside the rest to matter.
void solve_far_from_one(const TwoBone& chain, TwoBoneSolution& out) {
    const Difference target(chain.root, chain.target);
    const Difference pole(chain.root, chain.pole);
    const double largest = std::max({largest_of(target.value), std::scalbn(chain.length1, -target.exponent),
                                     std::scalbn(chain.length2, -target.exponent)});
    if (!(largest <= largest_double) || !(largest_of(pole.value) <= largest_double)) {
        out = {.elbow = chain.root, .tip = chain.root};  // not finite: outside the domain, but never a crash
        return;
    }
    const int unit = target.exponent + (largest > 0.0 ? std::ilogb(largest) : 0);
    TwoBone local = chain;
    local.root = glm::dvec3(0.0);
    local.target = scaled(target.value, target.exponent - unit);
    local.pole = scaled(pole.value, pole.exponent - unit);
    if (largest_of(local.pole) > 1e50) local.pole = 1e50 * unit_vector(pole.value);
    local.length1 = std::scalbn(chain.length1, -unit);
    local.length2 = std::scalbn(chain.length2, -unit);
    local.softness = std::scalbn(chain.softness, -unit);
    solve(local, out);
    out.elbow = moved(chain.root, out.elbow, unit);
    out.tip = out.tip == local.target ? chain.target : moved(chain.root, out.tip, unit);
    out.residual = std::min(std::scalbn(out.residual, unit), largest_double);
}

void solve(const TwoBone& chain, TwoBoneSolution& out) {
    if (const Chains<double> one(&chain); one.are_plain()) {
        solve_plain(one, &out);
    } else {
        solve_far_from_one(chain, out);
    }
}

}  // namespace

double triangle_angle(double a, double b, double c) {
    const double largest = std::max({a, b, c});
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
    const HalfAngle<double> half =
        half_angle(std::scalbn(a, -exponent), std::scalbn(b, -exponent), std::scalbn(c, -exponent));
    if (half.opposite + half.adjacent == 0.0) return 0.5 * std::numbers::pi;
    return 2.0 * std::atan2(std::sqrt(half.opposite), std::sqrt(half.adjacent));
}

double soft_reach(double distance, double reach, double softness) {
    return softened(distance, reach, softness);
}

TwoBoneSolution solve_two_bone(const TwoBone& chain) {
    TwoBoneSolution out;
    solve(chain, out);
    return out;
}

void solve_two_bones(std::span<const TwoBone> chains, std::span<TwoBoneSolution> out) {
    if (out.size() != chains.size()) throw std::invalid_argument("chains and out must have the same size");
    std::size_t i = 0;
    for (; i + 1 < chains.size(); i += 2) {
        if (const Chains<Pair> two(&chains[i]); two.are_plain()) {
            solve_plain(two, &out[i]);
        } else {
            solve(chains[i], out[i]);
            solve(chains[i + 1], out[i + 1]);
        }
    }
    if (i < chains.size()) solve(chains[i], out[i]);
}

}  // namespace motus
