#include "bend_plane.hpp"

#include "motus/two_bone.hpp"
#include "smooth.hpp"

namespace motus {
namespace {

/// `normal` without its part along a unit vector, at unit length. Across it already but for rounding.
glm::dvec3 straightened(const glm::dvec3& normal, const glm::dvec3& along) {
    return glm::normalize(normal - glm::dot(normal, along) * along);
}

/// A frame (start, normal) turned by the smallest rotation that takes start to `along`: of all normals that
/// depend on one direction alone this jumps least, at -start. No bone points there by chance of its axes.
glm::dvec3 fixed_normal(const glm::dvec3& along) {
    constexpr glm::dvec3 start(-0.48, 0.6, -0.64);
    constexpr glm::dvec3 normal(0.8, 0.0, -0.6);
    const double opposed = 1.0 + glm::dot(start, along);
    if (opposed < 1e-10) return straightened(normal, along);
    return straightened(normal - (start + along) * (glm::dot(normal, along) / opposed), along);
}

// Squares of lengths between which squares keep their digits.
constexpr double tiny = 1e-200, huge = 1e200;
constexpr double root_of_tiny = 1e-100, root_of_huge = 1e100;

/// A normal of any length, across the unit vector `along`.
template <class Real>
struct Start {
    glm::vec<3, Real> normal;
    Real length;
    glm::vec<3, Real> along;
};

/// blended_normal() of normals that need not be divided by their lengths first. share: the weight over the
/// length of `to`.
template <class Real>
inline glm::vec<3, Real> blended(const Start<Real>& from, const glm::vec<3, Real>& to, Real share,
                                 Real weight) {
    using std::sqrt;
    // Of unit vectors: rest from + weight to + rest weight (1 - from . to) along x from. Here times length^2.
    const Real rest = Real(1.0) - weight;
    const Real detour = rest * (from.length * weight - share * glm::dot(from.normal, to));
    const Real scale = from.length * from.length;
    const glm::vec<3, Real> sum = from.normal * (rest * from.length) +
                                  glm::cross(from.along, from.normal) * detour + to * (scale * share);
    const Real square = glm::dot(sum, sum);
    const auto is_long = square > Real(1e-20) * (scale * scale);
    return select(is_long, sum, from.normal) * (Real(1.0) / select(is_long, sqrt(square), from.length));
}

/// normal_across() where the plane's part across the line is so small that it fades out. sine: its share.
glm::dvec3 normal_nearly_along(const glm::dvec3& along, const glm::dvec3& across, double sine) {
    const glm::dvec3 fixed = fixed_normal(along);
    if (sine < 1e-12) return fixed;  // what is left is rounding
    const glm::dvec3 unit = across * (1.0 / glm::length(across));
    return blended_normal(fixed, straightened(unit, along), along, smooth_step(sine / pole_band));
}

/// faded_normal() without a plane that decides by itself, and of lengths whose squares do not keep their
/// digits.
glm::dvec3 faded_slowly(const BendSide<double>& side) {
    const bool has_plane = side.plane != glm::dvec3(0.0);
    const glm::dvec3 without = normal_across(side.along, side.plane) * (has_plane ? 1.0 : side.bend);
    const glm::dvec3 across = glm::cross(side.along, side.pole);
    const double distance = std::max(glm::length(side.pole), side.near);
    const double sine = distance > 0.0 ? glm::length(across) / distance : 0.0;
    const double weight = smooth_step(sine / side.band);
    const glm::dvec3 of_pole = unit_vector(across);
    if (weight == 0.0 || of_pole == glm::dvec3(0.0)) return without;
    return blended_normal(without, side.bend * straightened(of_pole, side.along), side.along, weight);
}

BendSide<double> lane(const BendSide<double>& side, int /*index*/) {
    return side;
}
BendSide<double> lane(const BendSide<Pair>& side, int index) {
    return {lane(side.along, index), lane(side.pole, index), lane(side.plane, index),
            lane(side.near, index),  lane(side.band, index), lane(side.bend, index)};
}

}  // namespace

glm::dvec3 unit_vector(glm::dvec3 v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest >= 1e-100 && largest <= 1e100) return glm::normalize(v);
    if (!(largest > 0.0)) return v;
    const int exponent = std::ilogb(largest);
    return glm::normalize(
        glm::dvec3(std::scalbn(v.x, -exponent), std::scalbn(v.y, -exponent), std::scalbn(v.z, -exponent)));
}

glm::dvec3 blended_normal(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& along,
                          double weight) {
    return blended<double>({from, 1.0, along}, to, weight, weight);
}

glm::dvec3 normal_across(const glm::dvec3& along, const glm::dvec3& plane) {
    const double size = glm::dot(plane, plane);
    const bool is_safe = size > tiny && size < huge;
    const glm::dvec3 wanted = is_safe ? plane : unit_vector(plane);
    const glm::dvec3 across = wanted - glm::dot(wanted, along) * along;
    const double square = glm::dot(across, across);
    const double whole = is_safe ? size : 1.0;
    if (square >= pole_band * pole_band * whole) return across * (1.0 / std::sqrt(square));
    return normal_nearly_along(along, across, std::sqrt(square / whole));
}

// Not inlined, for the sake of the frequent branch of bend_normal().
template <class Real>
[[gnu::noinline]] glm::vec<3, Real> faded_normal(BendSide<Real> side) {
    using std::max, std::sqrt;
    using Vector = glm::vec<3, Real>;
    const Vector across = glm::cross(side.along, side.pole);
    const Real square = glm::dot(across, across);
    const Real far_square = max(glm::dot(side.pole, side.pole), side.near * side.near);
    const Real size = glm::dot(side.plane, side.plane);
    const Vector plane = side.plane - side.along * glm::dot(side.plane, side.along);
    const Real plane_square = glm::dot(plane, plane);

    const Real inverse = Real(1.0) / (side.band * sqrt(far_square));
    const Real x = sqrt(square) * inverse;
    const Real slope =
        x * (Real(3.0) - Real(2.0) * x);  // smooth_step(x) / x: on the line `across` has no direction
    Vector normal = blended<Real>({plane, sqrt(plane_square), side.along}, across,
                                  side.bend * inverse * slope, x * slope);

    const auto is_slow =
        !((square > Real(tiny)) & (far_square < Real(huge)) & (size > Real(root_of_tiny)) &
          (size < Real(root_of_huge)) & (plane_square >= Real(pole_band * pole_band) * size));
    for (int i = 0; any(is_slow) && i < lane_count<Real>; ++i)
        if (lane(is_slow, i)) set_lane(normal, i, faded_slowly(lane(side, i)));
    return normal;
}

template glm::vec<3, double> faded_normal(BendSide<double>);
template glm::vec<3, Pair> faded_normal(BendSide<Pair>);

}  // namespace motus
