#include "motus/bones/chains/bend_plane.hpp"

#include <glm/geometric.hpp>

#include "motus/bones/chains/bend_plane-inl.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::chains {
namespace {

/// `normal` made perpendicular to a unit vector, at unit length. It is perpendicular already but for
/// rounding.
glm::dvec3 straightened(const glm::dvec3& normal, const glm::dvec3& along) {
    return glm::normalize(normal - glm::dot(normal, along) * along);
}

/// A normal that depends on the direction `along` alone: a frame (start, normal) turned by the smallest
/// rotation from start to `along`. Any such normal jumps somewhere; this one jumps at -start alone, a
/// direction in which bones do not point by chance of their axes.
glm::dvec3 fixed_normal(const glm::dvec3& along) {
    constexpr glm::dvec3 start(-0.48, 0.6, -0.64);
    constexpr glm::dvec3 normal(0.8, 0.0, -0.6);
    const double opposed = 1.0 + glm::dot(start, along);
    if (opposed < 1e-10) return straightened(normal, along);
    return straightened(normal - (start + along) * (glm::dot(normal, along) / opposed), along);
}

/// normal_across() for a plane whose part perpendicular to the line is so small that its effect fades out.
/// sine: size of that part.
glm::dvec3 normal_nearly_along(const glm::dvec3& along, const glm::dvec3& across, double sine) {
    const glm::dvec3 fixed = fixed_normal(along);
    if (sine < 1e-12) return fixed;  // what is left is rounding
    const glm::dvec3 unit = across * (1.0 / glm::length(across));
    return blended_normal(fixed, straightened(unit, along), along, smooth_step(sine / pole_band));
}

}  // namespace

glm::dvec3 blended_normal(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& along,
                          double weight) {
    return HWY_NAMESPACE::blended<double>({from, 1.0, along}, to, weight, weight);
}

glm::dvec3 normal_across(const glm::dvec3& along, const glm::dvec3& plane) {
    const double size = glm::dot(plane, plane);
    const bool is_safe = size > least_square && size < largest_square;
    const glm::dvec3 wanted = is_safe ? plane : unit_vector(plane);
    const glm::dvec3 across = wanted - glm::dot(wanted, along) * along;
    const double square = glm::dot(across, across);
    const double whole = is_safe ? size : 1.0;
    if (square >= pole_band * pole_band * whole) return across * (1.0 / std::sqrt(square));
    return normal_nearly_along(along, across, std::sqrt(square / whole));
}

glm::dvec3 faded_slowly(const BendSide& side) {
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

glm::dvec3 bend_normal(const BendSide& side) {
    return HWY_NAMESPACE::bend_normal(side, [](BendSide of) { return HWY_NAMESPACE::faded_normal(of); });
}

}  // namespace motus::bones::chains
