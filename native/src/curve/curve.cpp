#include "motus/curve/curve.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "bernstein.hpp"
#include "coordinates.hpp"

namespace motus::curve {
namespace {

// A first derivative below this fraction of the segment's extent is rounding: the tangent is then a limit.
constexpr double vanishing = 1e-12;
// The tangent if there is none.
constexpr glm::dvec3 no_direction(0.0, 1.0, 0.0);

/// The largest t.
[[nodiscard]] double end_of(const Curve& curve) {
    return static_cast<double>(curve.segment_count());
}

/// Unit vector of v, which is not zero; safe if the square of its length would under- or overflow. Rounds
/// differently from unit_vector(): the last digits of all tangents depend on it.
[[nodiscard]] glm::dvec3 unit(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return glm::normalize(v / largest);
}

/// Direction in which a segment sets out, by the first control point that is away from its first one.
[[nodiscard]] std::optional<glm::dvec3> leaving(bernstein::Segment segment, double threshold) {
    for (const glm::dvec3& point : segment.subspan(1)) {
        const glm::dvec3 away = point - segment.front();
        if (glm::length(away) > threshold) return unit(away);
    }
    return std::nullopt;
}

/// Direction in which a segment arrives.
[[nodiscard]] std::optional<glm::dvec3> arriving(bernstein::Segment segment, double threshold) {
    for (std::size_t i = segment.size() - 1; i-- > 0;) {
        const glm::dvec3 ahead = segment.back() - segment[i];
        if (glm::length(ahead) > threshold) return unit(ahead);
    }
    return std::nullopt;
}

/// Tangent at t of a segment with a length, where its first derivative vanishes.
[[nodiscard]] glm::dvec3 limit_tangent(bernstein::Segment segment, double t, double extent) {
    const double threshold = vanishing * extent;
    bernstein::Points left_points;
    bernstein::Points right_points;
    const std::span<glm::dvec3> left(left_points.data(), segment.size());
    const std::span<glm::dvec3> right(right_points.data(), segment.size());
    bernstein::split(segment, t, left, right);
    if (const auto direction = leaving(right, threshold)) return *direction;
    return arriving(left, threshold).value_or(no_direction);
}

/// Tangent on a segment of zero length: that of a neighbour, the next one first.
[[nodiscard]] glm::dvec3 neighbour_tangent(const Curve& curve, std::size_t index) {
    for (std::size_t i = index + 1; i < curve.segment_count(); ++i) {
        const double size = bernstein::extent(curve.segment(i));
        if (size > 0.0) return leaving(curve.segment(i), vanishing * size).value();
    }
    for (std::size_t i = index; i-- > 0;) {
        const double size = bernstein::extent(curve.segment(i));
        // The result has a value, since some point is at least half the extent away from the end.
        if (size > 0.0) return arriving(curve.segment(i), vanishing * size).value();
    }
    return no_direction;
}

/// Curvature where the first derivative vanishes. With C = P + a t^p + ... and b t^q the first term across a,
/// it goes like t^(q - 2p).
[[nodiscard]] double limit_curvature(bernstein::Segment segment, double t, double extent) {
    bernstein::Points left_points;
    bernstein::Points right_points;
    const std::span<glm::dvec3> right(right_points.data(), segment.size());
    const bool at_end = t >= 1.0;
    bernstein::split(segment, t, {left_points.data(), segment.size()}, right);
    if (at_end)
        std::reverse_copy(left_points.begin(), left_points.begin() + std::ssize(segment), right.begin());
    const double threshold = 1e-9 * extent;
    glm::dvec3 along{0.0};
    std::size_t p = 0;
    double binomial = 1.0;
    const std::size_t n = segment.size() - 1;
    for (std::size_t k = 1; k <= n; ++k) {
        // right[0 .. n - k] becomes its k-th forward differences; times the binomial they are Taylor
        // coefficients.
        for (std::size_t i = 0; i + k <= n; ++i) right[i] = right[i + 1] - right[i];
        binomial *= static_cast<double>(n - k + 1) / static_cast<double>(k);
        const glm::dvec3 coefficient = binomial * right[0];
        if (p == 0) {
            if (glm::length(right[0]) <= threshold) continue;
            along = coefficient;
            p = k;
            continue;
        }
        const double across = glm::length(glm::cross(unit(along), coefficient));
        if (across <= threshold * binomial) continue;
        if (k == 2 * p) return 2.0 * across / glm::dot(along, along);
        return k < 2 * p ? std::numeric_limits<double>::infinity() : 0.0;
    }
    return 0.0;
}

}  // namespace

Curve::Curve(int degree, std::vector<glm::dvec3> points, bool cyclic)
    : degree_(degree),
      cyclic_(cyclic),
      points_(std::make_shared<const std::vector<glm::dvec3>>(std::move(points))) {}

Curve Curve::bezier(std::span<const glm::dvec3> control_points) {
    const std::size_t most = static_cast<std::size_t>(max_degree) + 1;
    if (control_points.size() < 2 || control_points.size() > most)
        throw std::invalid_argument("control_points: 2 to " + std::to_string(most) +
                                    " points are needed, not " + std::to_string(control_points.size()));
    require_coordinates(control_points, "control_points");
    return {
        static_cast<int>(control_points.size()) - 1, {control_points.begin(), control_points.end()}, false};
}

Curve Curve::spline(std::span<const glm::dvec3> points, std::span<const glm::dvec3> handles_left,
                    std::span<const glm::dvec3> handles_right, bool cyclic) {
    if (points.size() < 2) throw std::invalid_argument("points: at least 2 are needed");
    if (handles_left.size() != points.size())
        throw std::invalid_argument("handles_left: as many as points are needed");
    if (handles_right.size() != points.size())
        throw std::invalid_argument("handles_right: as many as points are needed");
    require_coordinates(points, "points");
    require_coordinates(handles_left, "handles_left");
    require_coordinates(handles_right, "handles_right");
    const std::size_t segments = cyclic ? points.size() : points.size() - 1;
    std::vector<glm::dvec3> control_points;
    control_points.reserve(4 * segments);
    for (std::size_t i = 0; i < segments; ++i) {
        const std::size_t next = (i + 1) % points.size();
        control_points.insert(control_points.end(),
                              {points[i], handles_right[i], handles_left[next], points[next]});
    }
    return {3, std::move(control_points), cyclic};
}

Curve Curve::chain(int degree, std::span<const glm::dvec3> control_points, bool cyclic) {
    if (degree < 1 || degree > max_degree)
        throw std::invalid_argument("degree: must lie in 1 to " + std::to_string(max_degree));
    if (control_points.empty() || control_points.size() % (static_cast<std::size_t>(degree) + 1) != 0)
        throw std::invalid_argument(
            "control_points: degree + 1 a segment and at least one segment are needed");
    require_coordinates(control_points, "control_points");
    return {degree, {control_points.begin(), control_points.end()}, cyclic};
}

Location locate(const Curve& curve, double t) noexcept {
    const std::size_t count = curve.segment_count();
    if (t >= static_cast<double>(count)) return {count - 1, 1.0};
    if (t <= 0.0) return {0, 0.0};
    // The comparison is false for a NaN, which then stays a NaN in the first segment.
    const std::size_t index = t >= 1.0 ? static_cast<std::size_t>(t) : 0;
    return {index, t - static_cast<double>(index)};
}

glm::dvec3 position(const Curve& curve, double t) {
    const Location at = locate(curve, t);
    return bernstein::position(curve.segment(at.segment), at.t);
}

glm::dvec3 position(const Curve& curve, double t, Extend extend) {
    const Extended at = extended(t, end_of(curve), extend);
    if (at.beyond == 0.0) return position(curve, at.value);
    const Jet end = jet(curve, at.value);
    return end.position + at.beyond * end.d1;
}

glm::dvec3 derivative(const Curve& curve, double t, int order) {
    const Jet all = jet(curve, t);
    switch (order) {
        case 1:
            return all.d1;
        case 2:
            return all.d2;
        case 3:
            return all.d3;
        default:
            throw std::invalid_argument("order: must be 1, 2 or 3");
    }
}

glm::dvec3 derivative(const Curve& curve, double t, int order, Extend extend) {
    const Extended at = extended(t, end_of(curve), extend);
    const glm::dvec3 on_curve = derivative(curve, at.value, order);
    if (at.beyond != 0.0 && order > 1) return glm::dvec3(0.0);
    return at.returning && order % 2 == 1 ? -on_curve : on_curve;
}

Jet jet(const Curve& curve, double t) {
    return jet(curve, locate(curve, t));
}

Jet jet(const Curve& curve, const Location& at) {
    return bernstein::jet(curve.segment(at.segment), at.t);
}

glm::dvec3 tangent(const Curve& curve, double t) {
    const Location at = locate(curve, t);
    const bernstein::Segment segment = curve.segment(at.segment);
    if (std::isnan(at.t)) return glm::dvec3(at.t);
    const double extent = bernstein::extent(segment);
    if (extent == 0.0) return neighbour_tangent(curve, at.segment);
    const glm::dvec3 d1 = bernstein::jet(segment, at.t).d1;
    if (glm::length(d1) > vanishing * extent) return unit(d1);
    return limit_tangent(segment, at.t, extent);
}

glm::dvec3 tangent(const Curve& curve, double t, Extend extend) {
    const Extended at = extended(t, end_of(curve), extend);
    const glm::dvec3 forward = tangent(curve, at.value);
    return at.returning ? -forward : forward;
}

double curvature(const Curve& curve, double t) {
    const Location at = locate(curve, t);
    const bernstein::Segment segment = curve.segment(at.segment);
    if (std::isnan(at.t)) return at.t;
    const double extent = bernstein::extent(segment);
    if (extent == 0.0) return 0.0;
    const Jet all = bernstein::jet(segment, at.t);
    const double speed = glm::length(all.d1);
    if (speed <= vanishing * extent) return limit_curvature(segment, at.t, extent);
    // Divided step by step: the cube of the speed would underflow on tiny curves.
    return glm::length(glm::cross(all.d1 / speed, all.d2 / speed)) / speed;
}

double curvature(const Curve& curve, double t, Extend extend) {
    const Extended at = extended(t, end_of(curve), extend);
    return at.beyond == 0.0 ? curvature(curve, at.value) : 0.0;
}

double torsion(const Curve& curve, double t) {
    const Location at = locate(curve, t);
    const bernstein::Segment segment = curve.segment(at.segment);
    if (std::isnan(at.t)) return at.t;
    const double extent = bernstein::extent(segment);
    if (extent == 0.0) return 0.0;
    const Jet all = bernstein::jet(segment, at.t);
    const glm::dvec3 binormal = glm::cross(all.d1 / extent, all.d2 / extent);
    const double square = glm::dot(binormal, binormal);
    // The product of the two derivatives' rounding errors, squared.
    if (square <= vanishing * vanishing * glm::dot(all.d1 / extent, all.d1 / extent)) return 0.0;
    return glm::dot(binormal, all.d3 / extent) / square / extent;
}

double torsion(const Curve& curve, double t, Extend extend) {
    const Extended at = extended(t, end_of(curve), extend);
    return at.beyond == 0.0 ? torsion(curve, at.value) : 0.0;
}

}  // namespace motus::curve
