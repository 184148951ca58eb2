#include "motus/curve/bezier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bernstein.hpp"
#include "motus/core/numeric.hpp"

namespace motus::curve {
namespace {

using Coefficients = std::array<double, static_cast<std::size_t>(max_degree) + 1>;

struct Range {
    double min;
    double max;

    void include(double value) {
        min = std::min(min, value);
        max = std::max(max, value);
    }
};

/// Includes the extremes of a cubic (or lower) polynomial inside (0, 1): where its derivative, a quadratic,
/// vanishes.
void include_extremes(std::span<const double> p, Range& range) {
    const auto value = [&](double t) {
        const double s = 1.0 - t;
        if (p.size() == 2) return s * p[0] + t * p[1];
        if (p.size() == 3) return s * s * p[0] + 2.0 * s * t * p[1] + t * t * p[2];
        return s * s * s * p[0] + 3.0 * s * t * (s * p[1] + t * p[2]) + t * t * t * p[3];
    };
    const auto include = [&](double t) {
        if (t > 0.0 && t < 1.0) range.include(value(t));
    };
    if (p.size() == 3) include((p[0] - p[1]) / ((p[0] - p[1]) + (p[2] - p[1])));
    if (p.size() != 4) return;
    // Derivative a (1-t)^2 + 2 b (1-t) t + c t^2, solved without cancellation; a root at infinity is not
    // included.
    const double a = p[1] - p[0];
    const double b = p[2] - p[1];
    const double c = p[3] - p[2];
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return;
    const double q = -(b - a) - std::copysign(std::sqrt(discriminant), b - a);
    include(q / ((a - b) + (c - b)));
    include(a / q);
}

/// Includes the extremes of a polynomial of any degree: halves it as long as its coefficients, which bound
/// it, lie outside.
void include_extremes_by_halving(Coefficients p, std::size_t size, double tolerance, int depth,
                                 Range& range) {
    const auto [low, high] = std::minmax_element(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(size));
    if (depth == 0 || (*low >= range.min - tolerance && *high <= range.max + tolerance)) return;
    Coefficients left{};
    for (std::size_t level = 0; level < size; ++level) {
        left[level] = p[0];
        for (std::size_t i = 0; i + 1 < size - level; ++i) p[i] = 0.5 * (p[i] + p[i + 1]);
    }
    // p now has the coefficients of the right half, from the last level to the first.
    range.include(p[0]);
    include_extremes_by_halving(left, size, tolerance, depth - 1, range);
    include_extremes_by_halving(p, size, tolerance, depth - 1, range);
}

[[nodiscard]] Range axis_range(bernstein::Segment segment, int axis) {
    Coefficients p{};
    double largest = 0.0;
    for (std::size_t i = 0; i < segment.size(); ++i) {
        p[i] = segment[i][axis];
        largest = std::max(largest, std::abs(p[i] - p[0]));
    }
    Range range{p[0], p[0]};
    range.include(p[segment.size() - 1]);
    if (segment.size() <= 4) {
        include_extremes({p.data(), segment.size()}, range);
    } else {
        // The excess of the coefficients is quadratic in the width: 30 halvings are past the tolerance.
        include_extremes_by_halving(p, segment.size(), 1e-15 * largest, 30, range);
    }
    return range;
}

/// Adds one to the degree of `points` segments, in place of `out` (one point more).
void elevate_once(std::span<const glm::dvec3> points, std::span<glm::dvec3> out) {
    const auto n = static_cast<double>(points.size());
    out.front() = points.front();
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double weight = static_cast<double>(i) / n;
        out[i] = weight * points[i - 1] + (1.0 - weight) * points[i];
    }
    out.back() = points.back();
}

}  // namespace

std::pair<Curve, Curve> split(const Curve& curve, double t) {
    if (std::isnan(t)) throw std::invalid_argument("t: must be a number");
    const Location at = locate(curve, t);
    const std::span<const glm::dvec3> all = curve.control_points();
    const std::size_t size = curve.segment(0).size();
    const std::size_t begin = at.segment * size;
    if (at.t == 0.0 && at.segment > 0)
        return {Curve::chain(curve.degree(), all.first(begin), false),
                Curve::chain(curve.degree(), all.subspan(begin), false)};
    std::vector<glm::dvec3> left(begin + size);
    std::vector<glm::dvec3> right(all.size() - begin);
    std::copy_n(all.begin(), begin, left.begin());
    std::copy(all.begin() + static_cast<std::ptrdiff_t>(begin + size), all.end(),
              right.begin() + static_cast<std::ptrdiff_t>(size));
    bernstein::split(curve.segment(at.segment), at.t, std::span(left).last(size),
                     std::span(right).first(size));
    return {Curve::chain(curve.degree(), left, false), Curve::chain(curve.degree(), right, false)};
}

Curve elevated(const Curve& curve, int times) {
    if (times < 0) throw std::invalid_argument("times: must not be negative");
    if (times > max_degree - curve.degree())
        throw std::invalid_argument("times: the degree must not pass " + std::to_string(max_degree));
    std::vector<glm::dvec3> points(curve.control_points().begin(), curve.control_points().end());
    std::size_t size = curve.segment(0).size();
    for (int step = 0; step < times; ++step, ++size) {
        std::vector<glm::dvec3> higher(curve.segment_count() * (size + 1));
        for (std::size_t i = 0; i < curve.segment_count(); ++i)
            elevate_once(std::span(points).subspan(i * size, size),
                         std::span(higher).subspan(i * (size + 1), size + 1));
        points = std::move(higher);
    }
    return Curve::chain(curve.degree() + times, points, curve.cyclic());
}

Curve reversed(const Curve& curve) {
    const std::vector<glm::dvec3> points(curve.control_points().rbegin(), curve.control_points().rend());
    return Curve::chain(curve.degree(), points, curve.cyclic());
}

Curve transformed(const Curve& curve, const glm::dmat4& matrix) {
    require(is_finite(matrix), "matrix: must be finite");
    std::vector<glm::dvec3> points;
    points.reserve(curve.control_points().size());
    for (const glm::dvec3& p : curve.control_points()) {
        points.emplace_back(matrix * glm::dvec4(p, 1.0));
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(points.back()[axis]) <= coordinate_limit))
                throw std::invalid_argument("matrix: must leave every coordinate finite, and at most 1e100");
    }
    return Curve::chain(curve.degree(), points, curve.cyclic());
}

Box bounds(const Curve& curve) {
    Box box{curve.control_points().front(), curve.control_points().front()};
    for (std::size_t i = 0; i < curve.segment_count(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const Range range = axis_range(curve.segment(i), axis);
            box.min[axis] = std::min(box.min[axis], range.min);
            box.max[axis] = std::max(box.max[axis], range.max);
        }
    }
    return box;
}

}  // namespace motus::curve
