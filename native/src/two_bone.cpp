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

[[nodiscard]] double largest_of(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The line from the root to a target that is on it: where the elbow can be towards the pole, it is.
[[nodiscard]] glm::dvec3 line_of_coincident(const TwoBone& chain, glm::dvec3 pole) {
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

[[nodiscard]] inline Reason reason_of(double distance, double end, double longest) {
    if (std::abs(distance - end) <= reach_tolerance * (longest + distance)) return Reason::reached;
    return distance > end ? Reason::too_far : Reason::too_near;
}

/// Whether squares of all that counts, and products of two of them, neither overflow nor underflow.
[[nodiscard]] inline bool is_plain(const TwoBone& chain, const glm::dvec3& target, const glm::dvec3& pole) {
    const double largest = std::max({largest_of(target), chain.length1, chain.length2});
    return (largest >= 1e-100 || largest == 0.0) && largest <= 1e100 && largest_of(pole) <= 1e100;
}

/// Solves a chain whose numbers are plain. `target` and `pole`: seen from the root.
inline void solve_plain(const TwoBone& chain, const glm::dvec3& target, const glm::dvec3& pole,
                        TwoBoneSolution& out) {
    const double longest = chain.length1 + chain.length2;
    const double shortest = std::abs(chain.length1 - chain.length2);
    const double distance = std::sqrt(glm::dot(target, target));
    const double reach = std::max(soft_reach(distance, longest, chain.softness), shortest);

    // Where the tip stands, and how long the first bone is; both grow by one factor.
    double end = reach;
    double length1 = chain.length1;
    out.scale = 1.0;
    if (chain.stretch > 0.0 && distance > reach && reach > 0.0) {
        end = chain.stretch < 1.0 ? reach + chain.stretch * (distance - reach) : distance;
        length1 = length1 / reach * end;
        out.scale = std::min(end / reach, largest_double);
    }

    constexpr double vanished = 1e-140;  // below it squares lose digits
    glm::dvec3 along = target * (1.0 / std::max(distance, vanished));
    if (distance <= vanished)
        along = target != glm::dvec3(0.0) ? unit_vector(target) : line_of_coincident(chain, pole);

    const double band = chain.plane == glm::dvec3(0.0) ? pole_band_no_plane : pole_band;
    const glm::dvec3 normal = bend_normal({along, pole, chain.plane, longest, band, chain.bend});
    const Direction bone = shoulder(chain.length1, chain.length2, longest, shortest, reach);
    out.elbow =
        chain.root + ((length1 * bone.cosine) * along + (length1 * bone.sine) * glm::cross(normal, along));
    out.tip = distance == end ? chain.target : chain.root + end * along;
    out.normal = normal;
    out.residual = std::abs(distance - end);
    out.reason = reason_of(distance, end, longest);
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
    const glm::dvec3 target = chain.target - chain.root;
    const glm::dvec3 pole = chain.pole - chain.root;
    if (is_plain(chain, target, pole)) {
        solve_plain(chain, target, pole, out);
    } else {
        solve_far_from_one(chain, out);
    }
}

}  // namespace

double triangle_angle(double a, double b, double c) {
    const double largest = std::max({a, b, c});
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
    const HalfAngle half =
        half_angle(std::scalbn(a, -exponent), std::scalbn(b, -exponent), std::scalbn(c, -exponent));
    if (half.opposite + half.adjacent == 0.0) return 0.5 * std::numbers::pi;
    return 2.0 * std::atan2(std::sqrt(half.opposite), std::sqrt(half.adjacent));
}

double soft_reach(double distance, double reach, double softness) {
    constexpr double n = 3.0;
    const double soft = std::min(std::max(softness, 0.0), reach);
    const double excess = distance - (reach - soft);
    if (excess <= 0.0) return distance;
    if (distance >= reach + (n - 1.0) * soft) return reach;
    // The power multiplied out, so that little is taken from the distance rather than much from the reach.
    const double t = std::min(excess / soft * (1.0 / n), 1.0);
    return std::min(distance - excess * t * (1.0 - t * (1.0 / n)), reach);
}

TwoBoneSolution solve_two_bone(const TwoBone& chain) {
    TwoBoneSolution out;
    solve(chain, out);
    return out;
}

void solve_two_bones(std::span<const TwoBone> chains, std::span<TwoBoneSolution> out) {
    if (out.size() != chains.size()) throw std::invalid_argument("chains and out must have the same size");
    for (std::size_t i = 0; i < chains.size(); ++i) solve(chains[i], out[i]);
}

}  // namespace motus
