// Evaluation of one Bézier segment from its control points. Private to the library.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "motus/curve/curve.hpp"

namespace motus::curve::bernstein {

/// Room for the control points of one segment.
using Points = std::array<glm::dvec3, static_cast<std::size_t>(max_degree) + 1>;
using Segment = std::span<const glm::dvec3>;

/// a at t = 0 and b at t = 1, exactly.
[[nodiscard]] inline glm::dvec3 mix(const glm::dvec3& a, const glm::dvec3& b, double t) {
    return a * (1.0 - t) + b * t;
}

/// One level of de Casteljau's scheme in place: the first `count` points become count - 1.
inline void reduce(Points& points, std::size_t count, double t) {
    for (std::size_t i = 0; i + 1 < count; ++i) points[i] = mix(points[i], points[i + 1], t);
}

[[nodiscard]] inline Points copy(Segment segment) {
    Points points;
    std::copy(segment.begin(), segment.end(), points.begin());
    return points;
}

[[nodiscard]] inline glm::dvec3 cubic(Segment p, double t) {
    const double s = 1.0 - t;
    return (s * s * s) * p[0] + (3.0 * s * s * t) * p[1] + (3.0 * s * t * t) * p[2] + (t * t * t) * p[3];
}

[[nodiscard]] inline glm::dvec3 position(Segment segment, double t) {
    if (segment.size() == 4) return cubic(segment, t);
    Points points = copy(segment);
    for (std::size_t count = segment.size(); count > 1; --count) reduce(points, count, t);
    return points[0];
}

// The differences of the last levels of de Casteljau's scheme are the derivatives (Farin, section 5.3).
[[nodiscard]] inline Jet cubic_jet(Segment p, double t) {
    const glm::dvec3 a = mix(p[0], p[1], t), b = mix(p[1], p[2], t), c = mix(p[2], p[3], t);
    const glm::dvec3 d = mix(a, b, t), e = mix(b, c, t);
    return {mix(d, e, t), 3.0 * (e - d), 6.0 * ((c - b) - (b - a)),
            6.0 * ((p[3] - p[0]) - 3.0 * (p[2] - p[1]))};
}

[[nodiscard]] inline Jet jet_of_any_degree(Segment segment, double t) {
    Points q = copy(segment);
    std::size_t count = segment.size();
    const auto n = static_cast<double>(count - 1);
    for (; count > 4; --count) reduce(q, count, t);
    Jet result;
    if (count == 4) {
        result.d3 = n * (n - 1.0) * (n - 2.0) * ((q[3] - q[0]) - 3.0 * (q[2] - q[1]));
        reduce(q, count--, t);
    }
    if (count == 3) {
        result.d2 = n * (n - 1.0) * ((q[2] - q[1]) - (q[1] - q[0]));
        reduce(q, count--, t);
    }
    result.d1 = n * (q[1] - q[0]);
    result.position = mix(q[0], q[1], t);
    return result;
}

[[nodiscard]] inline Jet jet(Segment segment, double t) {
    return segment.size() == 4 ? cubic_jet(segment, t) : jet_of_any_degree(segment, t);
}

/// Control points of the two parts of a segment cut at t; each of segment.size().
inline void split(Segment segment, double t, std::span<glm::dvec3> left, std::span<glm::dvec3> right) {
    Points points = copy(segment);
    const std::size_t last = segment.size() - 1;
    for (std::size_t level = 0; level <= last; ++level) {
        left[level] = points[0];
        right[last - level] = points[last - level];
        reduce(points, segment.size() - level, t);
    }
}

/// Largest distance of a control point from the first; 0 if it is no more than rounding of the
/// coordinates.
[[nodiscard]] inline double extent(Segment segment) {
    double farthest = 0.0;
    double coordinate = 0.0;
    for (const glm::dvec3& point : segment) {
        farthest = std::max(farthest, glm::length(point - segment[0]));
        coordinate = std::max({coordinate, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    }
    return farthest > 4.0 * std::numeric_limits<double>::epsilon() * coordinate ? farthest : 0.0;
}

}  // namespace motus::curve::bernstein
