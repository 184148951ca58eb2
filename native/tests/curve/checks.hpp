// Curves to test on, and properties that hold for every curve.
#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "motus/curve/arc_length.hpp"
#include "motus/curve/curve.hpp"
#include "random.hpp"

namespace motus::curve::checks {

struct Named {
    std::string name;
    Curve curve;
};

class RandomCurves : public test::Random {
  public:
    using Random::Random;
    [[nodiscard]] std::vector<glm::dvec3> points(std::size_t count, double size = 1.0) {
        std::vector<glm::dvec3> result(count);
        for (glm::dvec3& p : result) p = in_cube(size);
        return result;
    }
    [[nodiscard]] Curve bezier(int degree, double size = 1.0) {
        return Curve::bezier(points(static_cast<std::size_t>(degree) + 1, size));
    }
};

/// Blender-like spline: smooth at its points, with handles of a third of the way.
[[nodiscard]] inline Curve smooth_spline(RandomCurves& random, std::size_t count, bool cyclic,
                                         double size = 1.0) {
    const std::vector<glm::dvec3> points = random.points(count, size);
    std::vector<glm::dvec3> left(count);
    std::vector<glm::dvec3> right(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 arm = (points[(i + 1) % count] - points[(i + count - 1) % count]) / 6.0;
        left[i] = points[i] - arm;
        right[i] = points[i] + arm;
    }
    return Curve::spline(points, left, right, cyclic);
}

/// Every way in which a curve stops, turns on the spot or has no length.
[[nodiscard]] inline std::vector<Named> degenerate_curves() {
    const glm::dvec3 o(0.0);
    const glm::dvec3 a(1.0, 2.0, 0.5);
    const glm::dvec3 b(3.0, -1.0, 2.0);
    const auto bezier = [](const std::vector<glm::dvec3>& p) { return Curve::bezier(p); };
    return {
        {"exact cusp", bezier({{0, 0, 0}, {4, 4, 0}, {0, 4, 0}, {4, 0, 0}})},
        {"cusp off the middle", bezier({{0, 0, 0}, {6, 3, 0}, {-2.25, 3.75, 0}, {3, 1, 0}})},
        {"near cusp", bezier({{0, 0, 0}, {4.0001, 4, 0}, {-0.0001, 4, 0}, {4, 0, 0}})},
        {"start handle on its point", bezier({o, o, a, b})},
        {"both handles on their points", bezier({o, o, b, b})},
        {"handles crossed over", bezier({o, b, o, b})},
        {"three points in one", bezier({o, o, o, b})},
        {"straight, even", bezier({o, b / 3.0, 2.0 * b / 3.0, b})},
        {"straight, back on itself", bezier({{0, 0, 0}, {3, 0, 0}, {-2, 0, 0}, {1, 0, 0}})},
        {"out and back", bezier({o, b, o})},
        {"segment of zero length inside",
         Curve::chain(3, std::vector{o, a, b, b, b, b, b, b, b, a, o, a}, false)},
        {"zero length at both ends", Curve::chain(1, std::vector{o, o, o, a, a, b, b, b}, false)},
        {"two apart", Curve::chain(2, std::vector{o, a, b, b + a, b + 2.0 * a, o}, false)},
        {"degree 12 with doubled points", bezier({o, o, o, a, a, a, b, b, a, a, o, b, b})},
    };
}

/// Curves of all kinds: degrees 1 to 32, splines, sizes 1e-6 to 1e6, degenerate ones.
[[nodiscard]] inline std::vector<Named> sample_curves() {
    RandomCurves random(7);
    std::vector<Named> curves = degenerate_curves();
    for (const int degree : {1, 2, 3, 4, 5, 7, 10, 16, 24, 32})
        curves.push_back({"degree " + std::to_string(degree), random.bezier(degree)});
    for (const double size : {1e-6, 1e-3, 1e3, 1e6})
        curves.push_back({"size " + std::to_string(size), random.bezier(3, size)});
    curves.push_back({"open spline", smooth_spline(random, 9, false)});
    curves.push_back({"cyclic spline", smooth_spline(random, 12, true)});
    return curves;
}

/// Largest distance of a control point from the first: what errors are measured against.
[[nodiscard]] inline double size_of(const Curve& curve) {
    double size = 0.0;
    for (const glm::dvec3& p : curve.control_points())
        size = std::max(size, glm::distance(p, curve.control_points()[0]));
    return size;
}

/// `count` parameters from 0 to the end, both included.
[[nodiscard]] inline std::vector<double> parameters(const Curve& curve, std::size_t count) {
    std::vector<double> t(count);
    for (std::size_t i = 0; i < count; ++i)
        t[i] = static_cast<double>(curve.segment_count()) * static_cast<double>(i) /
               static_cast<double>(count - 1);
    return t;
}

/// Each derivative is the limit of the differences of the one below.
inline void check_derivatives(const Curve& curve) {
    const double h = 1e-5;
    for (std::size_t segment = 0; segment < curve.segment_count(); ++segment) {
        for (const double local : {0.1, 0.35, 0.5, 0.8}) {
            const double t = static_cast<double>(segment) + local;
            const Jet here = jet(curve, t);
            const Jet before = jet(curve, t - h);
            const Jet after = jet(curve, t + h);
            const double degree = curve.degree();
            const double scale = size_of(curve) * degree;
            // Second order differences: h^2 times the derivative two orders up, and rounding over h.
            CHECK(glm::distance((after.position - before.position) / (2.0 * h), here.d1) <=
                  1e-9 * scale * degree * degree);
            CHECK(glm::distance((after.d1 - before.d1) / (2.0 * h), here.d2) <=
                  1e-9 * scale * degree * degree * degree);
            CHECK(glm::distance((after.d2 - before.d2) / (2.0 * h), here.d3) <=
                  1e-9 * scale * degree * degree * degree * degree);
            CHECK(derivative(curve, t, 1) == here.d1);
            CHECK(derivative(curve, t, 2) == here.d2);
            CHECK(derivative(curve, t, 3) == here.d3);
            CHECK(glm::distance(position(curve, t), here.position) <= 1e-14 * scale);
        }
    }
}

/// Checks that both curves go through the same points at the same parameters.
inline void check_same(const Curve& one, const Curve& other, double tolerance) {
    REQUIRE(one.segment_count() == other.segment_count());
    for (const double t : parameters(one, 101))
        CHECK(glm::distance(position(one, t), position(other, t)) <= tolerance * size_of(one));
}

/// length_at and t_at_length are inverse to each other, rising, and end where they should.
inline void check_arc_length(const ArcLength& path) {
    const double end = static_cast<double>(path.curve().segment_count());
    CHECK(path.length_at(0.0) == 0.0);
    CHECK(path.length_at(end) == path.length());
    CHECK(path.t_at_length(0.0) == 0.0);
    CHECK(path.t_at_length(path.length()) == (path.length() > 0.0 ? end : 0.0));
    double last_t = 0.0;
    RandomCurves random(3);
    std::vector<double> distances;
    for (int i = 0; i < 2000; ++i) distances.push_back(random.between(0.0, path.length()));
    std::sort(distances.begin(), distances.end());
    double worst = 0.0;
    for (const double s : distances) {
        const double t = path.t_at_length(s);
        CHECK(t >= last_t - 1e-9);
        last_t = t;
        worst = std::max(worst, std::abs(path.length_at(t) - s));
    }
    CHECK(worst <= 2e-12 * path.length());
}

}  // namespace motus::curve::checks
