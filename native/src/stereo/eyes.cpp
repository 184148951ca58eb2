#include "motus/stereo/eyes.hpp"

#include <cmath>
#include <limits>

#include "motus/core/numeric.hpp"

namespace motus::stereo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least = 1e-30, most = 1e30;  // of what is divided and multiplied: no result overflows

[[nodiscard]] bool is_positive(double value) {
    return value >= least && value <= most;
}

/// Distance between the eyes times the magnification of the lens. Parallax is this number times a difference
/// of two reciprocal depths.
[[nodiscard]] double strength(const Eyes& eyes) {
    return eyes.interaxial * eyes.focal_length / eyes.sensor_width;
}

/// 1 / the depth of points on the screen.
[[nodiscard]] double screen_nearness(const Eyes& eyes) {
    return eyes.mode == ConvergenceMode::parallel ? 0.0 : 1.0 / eyes.convergence;
}

/// The point in the space of an eye that stands `aside` to the right and is turned by `angle` to the left.
[[nodiscard]] glm::dvec2 seen(const Eyes& eyes, const glm::dvec3& point, double aside, double angle) {
    const double right = point.x - aside;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double forward = point.z * cosine - right * sine;
    require(forward >= least, "point: must lie in front of both eyes");
    const double scale = eyes.focal_length / eyes.sensor_width / forward;
    return {(right * cosine + point.z * sine) * scale, point.y * scale};
}

void check_limits(const Limits& limits) {
    require(limits.near >= 0.0 && limits.near <= most, "near_parallax: must be from 0 to 1e30");
    require(limits.far >= 0.0 && limits.far <= most, "far_parallax: must be from 0 to 1e30");
}

}  // namespace

void check(const Eyes& eyes) {
    require(eyes.interaxial >= 0.0 && eyes.interaxial <= most, "interaxial: must be from 0 to 1e30");
    require(is_positive(eyes.focal_length), "focal_length: must be from 1e-30 to 1e30");
    require(is_positive(eyes.sensor_width), "sensor_width: must be from 1e-30 to 1e30");
    require(eyes.convergence >= least, "convergence: must be at least 1e-30");
}

double parallax(const Eyes& eyes, double depth) {
    check(eyes);
    require(depth >= least, "depth: must be at least 1e-30");
    if (eyes.mode == ConvergenceMode::toe_in && std::isfinite(eyes.convergence)) {
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
    for (int axis = 0; axis < 3; ++axis)
        require(std::abs(point[axis]) <= most, "point: must be 1e30 at most in size");
    const double half = 0.5 * eyes.interaxial;
    if (eyes.mode == ConvergenceMode::toe_in) {
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
    check(eyes);
    require(depth >= least, "depth: must be at least 1e-30");
    require(is_positive(aspect), "aspect: must be from 1e-30 to 1e30");
    if (eyes.mode != ConvergenceMode::toe_in) return 0.0;
    // Vertical parallax grows towards the corners, which are all alike.
    const double to_edge = 0.5 * eyes.sensor_width / eyes.focal_length * depth;
    const double turned = 0.5 * eyes.interaxial / eyes.convergence;  // tangent of the angle
    require(depth <= most && to_edge <= most && to_edge / aspect <= most &&
                depth - (to_edge + 0.5 * eyes.interaxial) * turned > 1e-6 * depth,
            "depth: must have the corners of the image in front of both eyes that toe in");
    const Pair corner = project(eyes, {to_edge, to_edge / aspect, depth});
    return std::abs(corner.right.y - corner.left.y);
}

Range depths_within(const Eyes& eyes, const Limits& limits) {
    check(eyes);
    check_limits(limits);
    if (eyes.interaxial == 0.0) return {0.0, infinity};
    if (eyes.mode == ConvergenceMode::toe_in && std::isfinite(eyes.convergence)) {
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
    require(is_positive(range.near), "near: must be from 1e-30 to 1e30");
    require(range.far > range.near, "far: must be greater than near");
    require(is_positive(lens.focal_length), "focal_length: must be from 1e-30 to 1e30");
    require(is_positive(lens.sensor_width), "sensor_width: must be from 1e-30 to 1e30");
    check_limits(limits);
    const double total = limits.near + limits.far;
    require(total > 0.0, "near_parallax: must not be 0 with far_parallax 0");
    Eyes eyes = lens;
    eyes.mode = ConvergenceMode::off_axis;
    const double nearest = 1.0 / range.near, farthest = 1.0 / range.far;
    eyes.interaxial = total * (lens.sensor_width / lens.focal_length) / (nearest - farthest);
    eyes.convergence = total / (limits.far * nearest + limits.near * farthest);
    require(eyes.interaxial <= most && eyes.convergence >= least,
            "far: must be so much farther than near that the eyes have a distance of 1e30 at most");
    return eyes;
}

}  // namespace motus::stereo
