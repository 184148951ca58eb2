// Curves of any control points: what is asked of them is finite, and agrees with itself.
#include "motus/curve/curve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "bytes.hpp"
#include "motus/core/numeric.hpp"
#include "motus/curve/arc_length.hpp"
#include "motus/curve/nearest.hpp"
#include "targets.hpp"

namespace motus::fuzzers {

using namespace curve;

namespace {

std::optional<Curve> curve_of(Bytes& bytes) {
    std::optional<Curve> made;
    const bool cyclic = bytes.flag();
    if (bytes.flag()) {
        const std::vector<glm::dvec3> points = bytes.places(bytes.count(5));
        const std::vector<glm::dvec3> left = bytes.places(points.size()), right = bytes.places(points.size());
        returns([&] { made = Curve::spline(points, left, right, cyclic); });
    } else {
        const int degree = bytes.whole(0, 8);
        const std::size_t segments = bytes.count(3);
        const std::vector<glm::dvec3> points =
            bytes.places(segments * (static_cast<std::size_t>(degree) + 1));
        returns([&] { made = Curve::chain(degree, points, cyclic); });
    }
    return made;
}

/// How far from the origin a curve goes: not beyond its control points.
double size_of(const Curve& curve) {
    double size = 0.0;
    for (const glm::dvec3& point : curve.control_points())
        for (int axis = 0; axis < 3; ++axis) size = std::max(size, std::abs(point[axis]));
    return size;
}

void look_at(const Curve& curve, double t, Extend extend) {
    const glm::dvec3 clamped = position(curve, t);
    expect(is_finite(clamped) == !std::isnan(t), "position: finite but for NaN");
    for (int axis = 0; axis < 3 && !std::isnan(t); ++axis)
        expect(std::abs(clamped[axis]) <= size_of(curve) * (1.0 + 1e-12),
               "position: within the control points");
    if (!std::isfinite(t)) return;
    expect(std::abs(length_of(tangent(curve, t)) - 1.0) < 1e-9, "tangent: unit");
    expect(std::abs(length_of(tangent(curve, t, extend)) - 1.0) < 1e-9, "tangent: unit beyond the ends too");
    expect(curvature(curve, t) >= 0.0, "curvature: not below 0, nor NaN");
    expect(!std::isnan(torsion(curve, t)), "torsion: not NaN");
    for (const int order : {1, 2, 3}) expect(is_finite(derivative(curve, t, order)), "derivative: finite");
}

void measure(const Curve& curve, Bytes& bytes) {
    const ArcLength path(curve);
    expect(std::isfinite(path.length()) && path.length() >= 0.0, "length: finite, not below 0");
    double before = 0.0;
    for (int i = 0; i <= 8; ++i) {
        const double t = static_cast<double>(curve.segment_count()) * i / 8.0, at = path.length_at(t);
        expect(at >= before && at <= path.length(), "length_at: rises to the length");
        before = at;
        const double s = path.length() * i / 8.0, back = path.t_at_length(s);
        expect(back >= 0.0 && back <= static_cast<double>(curve.segment_count()),
               "t_at_length: on the curve");
        expect(std::abs(path.length_at(back) - s) <= 1e-9 * path.length(),
               "t_at_length: turns length_at about");
    }
    const Extended beyond = t_at_length(path, bytes.number(), bytes.choice<Extend>(4));
    (void)beyond;
}

}  // namespace

void try_curve(std::span<const std::uint8_t> data) {
    Bytes bytes(data);
    const std::optional<Curve> curve = curve_of(bytes);
    if (!curve) return;
    for (int round = 0; round < 4; ++round) look_at(*curve, bytes.number(-1.0, 5.0), bytes.choice<Extend>(4));
    measure(*curve, bytes);
    const glm::dvec3 point = bytes.place();
    returns([&] {
        const Nearest found = nearest(*curve, point);
        expect(is_finite(found.position) && std::isfinite(found.distance), "nearest: finite");
        const double ends =
            std::min(length_of(position(*curve, 0.0) - point),
                     length_of(position(*curve, static_cast<double>(curve->segment_count())) - point));
        expect(found.distance <= ends * (1.0 + 1e-9), "nearest: no farther than the ends");
    });
}

}  // namespace motus::fuzzers
