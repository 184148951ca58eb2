#include "motus/stereo/eyes.hpp"

#include <cmath>
#include <limits>

#include "motus/core/numeric.hpp"

namespace motus::stereo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Distance between the eyes times the magnification of the lens. Parallax is this number times a difference
/// of two reciprocal depths.
[[nodiscard]] double strength(const Eyes& eyes) {
    return eyes.interaxial * eyes.focal_length / eyes.sensor_width;
}

/// 1 / the depth of points on the screen.
[[nodiscard]] double screen_nearness(const Eyes& eyes) {
    return eyes.mode == Mode::parallel ? 0.0 : 1.0 / eyes.convergence;
}

/// The point in the space of an eye that stands `aside` to the right and is turned by `angle` to the left.
[[nodiscard]] glm::dvec2 seen(const Eyes& eyes, const glm::dvec3& point, double aside, double angle) {
    const double right = point.x - aside;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double forward = point.z * cosine - right * sine;
    require(forward > 0.0, "point must lie in front of both eyes");
    const double scale = eyes.focal_length / eyes.sensor_width / forward;
    return {(right * cosine + point.z * sine) * scale, point.y * scale};
}

}  // namespace

void check(const Eyes& eyes) {
    require(eyes.interaxial >= 0.0 && std::isfinite(eyes.interaxial),
            "interaxial must be at least 0 and finite");
    require(eyes.focal_length > 0.0 && std::isfinite(eyes.focal_length),
            "focal_length must be greater than 0 and finite");
    require(eyes.sensor_width > 0.0 && std::isfinite(eyes.sensor_width),
            "sensor_width must be greater than 0 and finite");
    require(eyes.convergence > 0.0, "convergence must be greater than 0");
}

double parallax(const Eyes& eyes, double depth) {
    check(eyes);
    require(depth > 0.0, "depth must be greater than 0");
    if (eyes.mode == Mode::toe_in && std::isfinite(eyes.convergence)) {
        // tan(a - b), where a is the angle of the turned axis and b that of the point: the offset of both
        // images.
        const double half = 0.5 * eyes.interaxial;
        const double tangent = half / eyes.convergence, other = half / depth;
        return 2.0 * eyes.focal_length / eyes.sensor_width * (tangent - other) / (1.0 + tangent * other);
    }
    return strength(eyes) * (screen_nearness(eyes) - 1.0 / depth);
}

Pair project(const Eyes& eyes, const glm::dvec3& point) {
    check(eyes);
    require(is_finite(point), "point must be finite");
    const double half = 0.5 * eyes.interaxial;
    if (eyes.mode == Mode::toe_in) {
        // The left eye is turned to the right.
        const double angle = std::atan(half / eyes.convergence);
        return {seen(eyes, point, -half, -angle), seen(eyes, point, half, angle)};
    }
    const double shift = 0.5 * strength(eyes) * screen_nearness(eyes);
    Pair pair{seen(eyes, point, -half, 0.0), seen(eyes, point, half, 0.0)};
    pair.left.x -= shift;
    pair.right.x += shift;
    return pair;
}

double vertical_parallax(const Eyes& eyes, double depth, double aspect) {
    require(depth > 0.0 && (eyes.mode != Mode::toe_in || std::isfinite(depth)),
            "depth must be greater than 0, and finite for eyes that toe in");
    require(aspect > 0.0 && std::isfinite(aspect), "aspect must be greater than 0 and finite");
    check(eyes);
    if (eyes.mode != Mode::toe_in) return 0.0;
    // Vertical parallax grows towards the corners, which are all alike.
    const double to_edge = 0.5 * eyes.sensor_width / eyes.focal_length * depth;
    const Pair corner = project(eyes, {to_edge, to_edge / aspect, depth});
    return std::abs(corner.right.y - corner.left.y);
}

Range depths_within(const Eyes& eyes, const Limits& limits) {
    check(eyes);
    require(limits.near >= 0.0 && std::isfinite(limits.near), "near_parallax must be at least 0 and finite");
    require(limits.far >= 0.0 && std::isfinite(limits.far), "far_parallax must be at least 0 and finite");
    if (eyes.interaxial == 0.0) return {0.0, infinity};
    if (eyes.mode == Mode::toe_in && std::isfinite(eyes.convergence)) {
        // The depth at which parallax() has a given value.
        const double half = 0.5 * eyes.interaxial;
        const double tangent = half / eyes.convergence;
        const double scale = 0.5 * eyes.sensor_width / eyes.focal_length;
        const auto depth_at = [&](double wanted) {
            const double offset = wanted * scale;
            const double below = 1.0 + tangent * offset;
            const double other = (tangent - offset) / below;
            if (below <= 0.0) return 0.0;
            return other > 0.0 ? half / other : infinity;
        };
        return {depth_at(-limits.near), depth_at(limits.far)};
    }
    const double nearness = screen_nearness(eyes);
    const double nearest = nearness + limits.near / strength(eyes);
    const double farthest = nearness - limits.far / strength(eyes);
    return {nearest > 0.0 ? 1.0 / nearest : infinity, farthest > 0.0 ? 1.0 / farthest : infinity};
}

Eyes fit_budget(const Eyes& lens, const Range& range, const Limits& limits) {
    require(range.near > 0.0 && std::isfinite(range.near), "near must be greater than 0 and finite");
    require(range.far > range.near, "far must be greater than near");
    require(limits.near >= 0.0 && std::isfinite(limits.near), "near_parallax must be at least 0 and finite");
    require(limits.far >= 0.0 && std::isfinite(limits.far), "far_parallax must be at least 0 and finite");
    const double total = limits.near + limits.far;
    require(total > 0.0, "near_parallax and far_parallax must not both be 0");
    Eyes eyes = lens;
    eyes.mode = Mode::off_axis;
    const double nearest = 1.0 / range.near, farthest = 1.0 / range.far;
    eyes.interaxial = total * (lens.sensor_width / lens.focal_length) / (nearest - farthest);
    eyes.convergence = total / (limits.far * nearest + limits.near * farthest);
    check(eyes);
    return eyes;
}

}  // namespace motus::stereo
