#include "lean.hpp"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace motus::walker {
namespace {

/// A point in the axes of the body.
[[nodiscard]] glm::dvec3 seen(const glm::dvec3& point, const glm::dvec3& origin, const Axes& axes) {
    const glm::dvec3 from = point - origin;
    return {glm::dot(from, axes.side), glm::dot(from, axes.ahead), glm::dot(from, axes.up)};
}

[[nodiscard]] double height_at(const Lean& plane, const glm::dvec3& point) {
    return plane.height + plane.side * point.x + plane.ahead * point.y;
}

/// z = height + side x + ahead y by weighted least squares. point(i): x, y, z.
template <class Point, class Weight>
[[nodiscard]] Lean fit(std::size_t count, const Point& point, const Weight& weight) {
    double sum = 0.0;
    glm::dvec3 mean(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        sum += weight(i);
        mean += weight(i) * point(i);
    }
    mean /= sum;
    double xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 d = point(i) - mean;
        const double w = weight(i);
        xx += w * d.x * d.x;
        xy += w * d.x * d.y;
        yy += w * d.y * d.y;
        xz += w * d.x * d.z;
        yz += w * d.y * d.z;
    }
    // Too small to be visible, but it makes a slope that the points leave undetermined 0.
    const double ridge = 1e-9 * (xx + yy);
    xx += ridge;
    yy += ridge;
    const double determinant = xx * yy - xy * xy;
    Lean plane;
    if (determinant > 0.0) {
        plane.side = (yy * xz - xy * yz) / determinant;
        plane.ahead = (xx * yz - xy * xz) / determinant;
    }
    plane.height = mean.z - plane.side * mean.x - plane.ahead * mean.y;
    return plane;
}

}  // namespace

Lean lean_of(const glm::dvec3& origin, const Axes& axes, std::span<const glm::dvec3> rest,
             std::span<const glm::dvec3> feet, std::span<const double> weights) {
    const auto rest_seen = [&](std::size_t i) { return seen(rest[i], origin, axes); };
    const Lean level = fit(rest.size(), rest_seen, [](std::size_t) { return 1.0; });
    // Rest places that are not in one plane do not tilt the body when it rests on them.
    const auto above_rest = [&](std::size_t i) {
        const glm::dvec3 place = rest_seen(i), foot = seen(feet[i], origin, axes);
        const double own = place.z - height_at(level, place);
        return glm::dvec3(foot.x, foot.y, foot.z - own - height_at(level, foot));
    };
    return fit(rest.size(), above_rest, [&](std::size_t i) { return weights[i]; });
}

glm::dquat turn_of(const Lean& lean, const Axes& axes) {
    // From up to up + across: the half-way vector's parts, of which none vanishes.
    const glm::dvec3 across = -lean.side * axes.side - lean.ahead * axes.ahead;
    const double length = std::sqrt(1.0 + glm::dot(across, across));
    const glm::dvec3 turn = glm::cross(axes.up, across) / length;
    return glm::normalize(glm::dquat(1.0 + 1.0 / length, turn.x, turn.y, turn.z));
}

}  // namespace motus::walker
