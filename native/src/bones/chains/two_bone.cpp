#include "motus/bones/chains/two_bone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motus/bones/chains/bend_plane.hpp"
#include "motus/core/numeric.hpp"
#include "two_bone_lanes-inl.hpp"

namespace motus::bones::chains {

using namespace HWY_NAMESPACE;

namespace {

/// As solve_plain() wants it.
HWY_NOINLINE glm::dvec3 faded(BendSide side) {
    return faded_normal(side);
}

[[nodiscard]] glm::dvec3 within_doubles(const glm::dvec3& v) {
    return glm::clamp(v, glm::dvec3(-largest_double), glm::dvec3(largest_double));
}

[[nodiscard]] glm::dvec3 scaled(const glm::dvec3& v, int exponent) {
    return {std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent)};
}

/// b - a, in units of 2^exponent: 0, or 2 if the difference of two finite points overflows.
struct Difference {
    glm::dvec3 value;
    int exponent = 0;

    Difference(const glm::dvec3& a, const glm::dvec3& b) : value(b - a) {
        if (largest_of(value) <= largest_double) return;
        value = 0.25 * b - 0.25 * a;
        exponent = 2;
    }
};

/// point + offset * 2^unit. Large numbers are added in quarters, so that the terms of a sum that is a finite
/// double are finite too.
[[nodiscard]] glm::dvec3 moved(const glm::dvec3& point, const glm::dvec3& offset, int unit) {
    if (unit < 1000) return within_doubles(point + scaled(offset, unit));
    return within_doubles(scaled(0.25 * point + scaled(offset, unit - 2), 2));
}

/// Solves a chain whose sizes are far from 1 in another unit of length, a power of two. That rounds only
/// numbers that are too small beside the others to matter.
void solve_far_from_one(const TwoBone& chain, TwoBoneSolution& out) {
    const Difference target(chain.root, chain.target);
    const Difference pole(chain.root, chain.pole);
    const double largest = std::max({largest_of(target.value), std::scalbn(chain.length1, -target.exponent),
                                     std::scalbn(chain.length2, -target.exponent)});
    const int unit = target.exponent + (largest > 0.0 ? std::ilogb(largest) : 0);
    TwoBone local = chain;
    local.root = glm::dvec3(0.0);
    local.target = scaled(target.value, target.exponent - unit);
    local.pole = scaled(pole.value, pole.exponent - unit);
    if (largest_of(local.pole) > 1e50) local.pole = 1e50 * unit_vector(pole.value);
    local.length1 = std::scalbn(chain.length1, -unit);
    local.length2 = std::scalbn(chain.length2, -unit);
    local.softness = std::scalbn(chain.softness, -unit);
    solve_plain(Chains<double>(&local), faded, &out);
    out.elbow = moved(chain.root, out.elbow, unit);
    out.tip = out.tip == local.target ? chain.target : moved(chain.root, out.tip, unit);
    out.residual = std::min(std::scalbn(out.residual, unit), largest_double);
}

[[nodiscard]] bool is_length(double value) {
    return value >= 0.0 && std::isfinite(value);
}

void check(const TwoBone& chain) {
    require(is_finite(chain.root), "root: must be finite");
    require(is_finite(chain.target), "target: must be finite");
    require(is_finite(chain.pole), "pole: must be finite");
    require(is_finite(chain.plane), "plane: must be finite");
    require(is_length(chain.length1), "length1: must be at least 0 and finite");
    require(is_length(chain.length2), "length2: must be at least 0 and finite");
    require(std::isfinite(chain.softness), "softness: must be finite");
    require(std::isfinite(chain.stretch), "stretch: must be finite");
}

/// False for arguments that check() refuses, and for numbers that are too large to decide without check().
[[nodiscard]] bool may_be_valid(const TwoBone& chain) {
    const glm::dvec3 points = (chain.root + chain.target) + (chain.pole + chain.plane);
    const double sum = ((points.x + points.y) + (points.z + chain.softness)) +
                       (chain.stretch + (chain.length1 + chain.length2));
    return std::isfinite(sum) && chain.length1 >= 0.0 && chain.length2 >= 0.0;
}

}  // namespace

glm::dvec3 line_of_coincident(const TwoBone& chain, glm::dvec3 target, glm::dvec3 pole) {
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

void solve_one(const TwoBone& chain, TwoBoneSolution& out) {
    if (const Chains<double> one(&chain); one.are_plain()) {
        solve_plain(one, faded, &out);
    } else {
        solve_far_from_one(chain, out);
    }
}

double triangle_angle(double a, double b, double c) {
    require(is_length(a), "a: must be at least 0 and finite");
    require(is_length(b), "b: must be at least 0 and finite");
    require(is_length(c), "c: must be at least 0 and finite");
    const double largest = std::max({a, b, c});
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
    const HalfAngle<double> half =
        half_angle(std::scalbn(a, -exponent), std::scalbn(b, -exponent), std::scalbn(c, -exponent));
    if (half.opposite + half.adjacent == 0.0) return 0.5 * std::numbers::pi;
    return 2.0 * std::atan2(std::sqrt(half.opposite), std::sqrt(half.adjacent));
}

double soft_reach(double distance, double reach, double softness) {
    if (std::isnan(distance) || std::isnan(reach) || std::isnan(softness)) return distance + reach + softness;
    return softened(distance, reach, softness);
}

TwoBoneSolution solve_two_bone(const TwoBone& chain) {
    check(chain);
    TwoBoneSolution out;
    solve_one(chain, out);
    return out;
}

void solve_two_bones(std::span<const TwoBone> chains, std::span<TwoBoneSolution> out) {
    require(out.size() == chains.size(), "out: must be as many as chains");
    for (const TwoBone& chain : chains)
        if (!may_be_valid(chain)) check(chain);
    two_bone_kernels().back().solve(chains, out);
}

}  // namespace motus::bones::chains
