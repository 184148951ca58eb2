// Curves for the tests of frames and followers.
#pragma once
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "motus/curve/arc_length.hpp"
#include "random.hpp"

namespace motus::curve::samples {

using Path = std::shared_ptr<const ArcLength>;

inline Path path(Curve curve) {
    return std::make_shared<const ArcLength>(std::move(curve));
}

inline constexpr double turn = 2.0 * std::numbers::pi;

/// A spline through samples of a closed form f over [0, 1], which goes `turns` times round, with f's
/// derivative in its handles: C1. On circles its curvature is off by 1e-7 at 64 segments a turn.
inline Path sampled(const std::function<glm::dvec3(double)>& f, std::size_t segments, bool cyclic,
                    double turns = 1.0) {
    std::vector<glm::dvec3> points, left, right;
    const double step = 1.0 / static_cast<double>(segments);
    const double arc = turn * turns * step;
    const double reach = 4.0 / 3.0 * std::tan(arc / 4.0) / arc * step;
    for (std::size_t i = 0; i < segments + (cyclic ? 0 : 1); ++i) {
        const double u = static_cast<double>(i) * step;
        constexpr double h = 1e-5;
        const glm::dvec3 handle = (f(u + h) - f(u - h)) / (2.0 * h) * reach;
        points.push_back(f(u));
        left.push_back(f(u) - handle);
        right.push_back(f(u) + handle);
    }
    return path(Curve::spline(points, left, right, cyclic));
}

/// Level, anticlockwise seen from above, starting at +X towards +Y.
inline Path level_circle(double radius) {
    return sampled([=](double u) { return radius * glm::dvec3(std::cos(turn * u), std::sin(turn * u), 0.0); },
                   64, true);
}

/// In the XZ plane, starting at the bottom towards +X.
inline Path vertical_loop(double radius) {
    return sampled(
        [=](double u) { return radius * glm::dvec3(std::sin(turn * u), 0.0, -std::cos(turn * u)); }, 64,
        true);
}

inline Path helix(double radius, double rise, double turns, bool left_handed = false) {
    return sampled(
        [=](double u) {
            const double a = turn * turns * u;
            return glm::dvec3(radius * std::cos(a), (left_handed ? -radius : radius) * std::sin(a),
                              rise * turns * u);
        },
        static_cast<std::size_t>(64.0 * turns), false, turns);
}

inline Path trefoil() {
    return sampled(
        [](double u) {
            const double a = turn * u;
            return glm::dvec3(std::sin(a) + 2.0 * std::sin(2.0 * a), std::cos(a) - 2.0 * std::cos(2.0 * a),
                              -std::sin(3.0 * a));
        },
        96, true);
}

/// Level.
inline Path figure_eight() {
    return sampled(
        [](double u) { return glm::dvec3(4.0 * std::sin(turn * u), 2.0 * std::sin(2.0 * turn * u), 0.0); },
        64, true);
}

/// Level; bends left, then right.
inline Path s_curve() {
    const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 8, 0}, {8, 0, 0}, {8, 8, 0}};
    return path(Curve::bezier(points));
}

inline Path straight(const glm::dvec3& from, const glm::dvec3& to) {
    const std::vector<glm::dvec3> points{from, to};
    return path(Curve::bezier(points));
}

/// One segment of any degree with control points from a normal distribution.
inline Path random_bezier(motus::test::Random& random, int degree) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= degree; ++i) points.push_back(random.around_origin(3.0));
    return path(Curve::bezier(points));
}

/// Blender's usual case: the tangent is continuous at the joints, the curvature is not.
inline Path random_spline(motus::test::Random& random, std::size_t count, bool cyclic) {
    std::vector<glm::dvec3> points, left, right;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 place(4.0 * static_cast<double>(i % 7), 0.0, 0.0);
        points.push_back(place + random.around_origin(3.0));
        const glm::dvec3 handle = random.around_origin(3.0);
        left.push_back(points.back() - random.between(0.4, 1.6) * handle);
        right.push_back(points.back() + random.between(0.4, 1.6) * handle);
    }
    return path(Curve::spline(points, left, right, cyclic));
}

/// The curve with every control point multiplied by `factors`, axis by axis: (1, 0, 1) lays it in the XZ
/// plane.
inline Path squeezed(const Path& of, const glm::dvec3& factors) {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& p : of->curve().control_points()) points.push_back(factors * p);
    return path(Curve::chain(of->curve().degree(), points, of->curve().cyclic()));
}

}  // namespace motus::curve::samples
