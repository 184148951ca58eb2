#include "motus/curve/bspline.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "bernstein.hpp"
#include "coordinates.hpp"
#include "motus/curve/bezier.hpp"

namespace motus::curve {
namespace {

constexpr int lowest_order = 2;
constexpr int highest_order = 6;

void require_order(int order) {
    if (order < lowest_order || order > highest_order)
        throw std::invalid_argument("order: must lie in 2 to 6");
}

/// Whether Blender draws a spline, not the control polygon, through this many points.
[[nodiscard]] bool is_drawn(std::size_t point_count, const BSplineSettings& settings) {
    const auto order = static_cast<std::size_t>(settings.order);
    if (point_count < order) return false;
    if (!settings.use_bezier) return true;
    if (!settings.use_endpoint && point_count <= order) return false;
    return !settings.cyclic || point_count % (order - 1) == 0;
}

/// Value of the blossom of the polynomial on the knot span [knots[span], knots[span + 1]): de Boor's scheme
/// with an argument of its own at each level. `points` are the degree + 1 that the span depends on.
[[nodiscard]] glm::dvec3 blossom(std::array<glm::dvec3, highest_order> points,
                                 std::span<const double> arguments, const std::vector<double>& knots,
                                 std::size_t span) {
    const std::size_t degree = arguments.size();
    for (std::size_t level = 1; level <= degree; ++level) {
        for (std::size_t k = degree; k >= level; --k) {
            const double low = knots[span - degree + k];
            const double high = knots[span + 1 + k - level];
            points[k] = bernstein::mix(points[k - 1], points[k], (arguments[level - 1] - low) / (high - low));
        }
    }
    return points[degree];
}

}  // namespace

std::vector<double> bspline_knots(std::size_t point_count, const BSplineSettings& settings) {
    require_order(settings.order);
    if (point_count == 0) throw std::invalid_argument("point_count: at least 1 is needed");
    const auto order = static_cast<std::size_t>(settings.order);
    const bool cyclic = settings.cyclic;
    const std::size_t count = point_count + order + (cyclic ? order - 1 : 0);
    // How often a knot occurs: inside the curve, and the first one.
    const std::size_t inner = settings.use_bezier ? order - 1 : 1;
    std::size_t first = settings.use_bezier ? std::min<std::size_t>(2, inner) : 1;
    if (settings.use_endpoint) first = cyclic ? order - 1 : order;
    // The last knots repeat the widths of the first spans, from where the first ones stop.
    const std::size_t tail = cyclic ? 2 * order - 1 : (settings.use_endpoint ? order : 0);

    std::vector<double> knots;
    knots.reserve(count);
    double value = 0.0;
    if (settings.use_endpoint && cyclic) knots.push_back(value++);
    std::size_t left = first;
    while (knots.size() < count - tail) {
        knots.push_back(value);
        if (--left > 0) continue;
        value += 1.0;
        left = inner;
    }
    for (std::size_t i = 0; i < tail; ++i) knots.push_back(value + (knots[i] - knots[0]));
    return knots;
}

Curve bspline(std::span<const glm::dvec3> points, const BSplineSettings& settings) {
    require_order(settings.order);
    if (!is_drawn(points.size(), settings))
        return elevated(poly_line(points, settings.cyclic), settings.order - 2);
    require_coordinates(points, "points");
    const std::vector<double> knots = bspline_knots(points.size(), settings);
    const auto degree = static_cast<std::size_t>(settings.order) - 1;
    const std::size_t spans_end = points.size() + (settings.cyclic ? degree : 0);
    std::vector<glm::dvec3> control_points;
    for (std::size_t span = degree; span < spans_end; ++span) {
        if (!(knots[span] < knots[span + 1])) continue;
        std::array<glm::dvec3, highest_order> local{};
        for (std::size_t k = 0; k <= degree; ++k) local[k] = points[(span - degree + k) % points.size()];
        // Bézier point j of the span is the blossom at its start, degree - j times, and its end, j times.
        std::array<double, highest_order> arguments{};
        arguments.fill(knots[span]);
        for (std::size_t j = 0; j <= degree; ++j) {
            if (j > 0) arguments[degree - j] = knots[span + 1];
            control_points.push_back(blossom(local, {arguments.data(), degree}, knots, span));
        }
    }
    return Curve::chain(settings.order - 1, control_points, settings.cyclic);
}

Curve poly_line(std::span<const glm::dvec3> points, bool cyclic) {
    if (points.size() < 2) throw std::invalid_argument("points: at least 2 are needed");
    require_coordinates(points, "points");
    const std::size_t segments = cyclic ? points.size() : points.size() - 1;
    std::vector<glm::dvec3> control_points;
    control_points.reserve(2 * segments);
    for (std::size_t i = 0; i < segments; ++i) {
        control_points.push_back(points[i]);
        control_points.push_back(points[(i + 1) % points.size()]);
    }
    return Curve::chain(1, control_points, cyclic);
}

}  // namespace motus::curve
