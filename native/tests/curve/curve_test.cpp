#include "motus/curve/curve.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "checks.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::curve::checks;

namespace {

using Points = std::vector<glm::dvec3>;

/// Position by the definition, sum of binomial (1-t)^(n-k) t^k p_k, in long double.
[[nodiscard]] glm::dvec3 by_definition(const Points& points, double t) {
    const std::size_t n = points.size() - 1;
    long double binomial = 1.0L;
    long double x[3] = {0.0L, 0.0L, 0.0L};
    for (std::size_t k = 0; k <= n; ++k) {
        const long double weight = binomial *
                                   std::pow(1.0L - static_cast<long double>(t), static_cast<int>(n - k)) *
                                   std::pow(static_cast<long double>(t), static_cast<int>(k));
        for (int axis = 0; axis < 3; ++axis) x[axis] += weight * static_cast<long double>(points[k][axis]);
        binomial *= static_cast<long double>(n - k) / static_cast<long double>(k + 1);
    }
    return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

/// A quarter of a helix of the given radius and pitch, as a polynomial of degree 9 through its Taylor series:
/// close to the exact one near t = 0.
[[nodiscard]] Curve helix(double radius, double rise) {
    // Power form in t, cos and sin cut off after t^9, to Bernstein form: p_j = sum of binomial(j, k) /
    // binomial(9, k) c_k.
    std::vector<glm::dvec3> power(10, glm::dvec3(0.0));
    double factorial = 1.0;
    for (int k = 0; k < 10; ++k) {
        if (k > 0) factorial *= k;
        const double sign = k % 4 < 2 ? 1.0 : -1.0;
        power[static_cast<std::size_t>(k)][k % 2] = radius * sign / factorial;
    }
    power[1].z = rise;
    const auto binomial = [](int n, int k) {
        double value = 1.0;
        for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
        return value;
    };
    Points points(10, glm::dvec3(0.0));
    for (int j = 0; j < 10; ++j) {
        for (int k = 0; k <= j; ++k)
            points[static_cast<std::size_t>(j)] +=
                binomial(j, k) / binomial(9, k) * power[static_cast<std::size_t>(k)];
    }
    return Curve::bezier(points);
}

}  // namespace

TEST_CASE("a Bezier curve is its Bernstein sum at any degree", "[curve]") {
    RandomCurves random(1);
    for (const int degree : {1, 2, 3, 4, 8, 16, 32, 64}) {
        const Points points = random.points(static_cast<std::size_t>(degree) + 1);
        const Curve curve = Curve::bezier(points);
        CHECK(curve.degree() == degree);
        for (const double t : parameters(curve, 33))
            CHECK(glm::distance(position(curve, t), by_definition(points, t)) <= 4e-15);
        CHECK(position(curve, 0.0) == points.front());
        CHECK(position(curve, 1.0) == points.back());
    }
}

TEST_CASE("a spline goes through its points with Blender's handles", "[curve]") {
    const Points points{{0, 0, 0}, {1, 2, 0}, {3, 1, 1}};
    const Points left{{-1, 0, 0}, {0, 2, 0}, {2, 1, 1}};
    const Points right{{1, 0, 0}, {2, 2, 0}, {4, 1, 1}};
    const Curve open = Curve::spline(points, left, right, false);
    const Curve cyclic = Curve::spline(points, left, right, true);
    REQUIRE(open.segment_count() == 2);
    REQUIRE(cyclic.segment_count() == 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double t = static_cast<double>(i);
        CHECK(position(open, t) == points[i]);
        CHECK(position(cyclic, t) == points[i]);
        CHECK(derivative(cyclic, t) == 3.0 * (right[i] - points[i]));
    }
    CHECK(position(cyclic, 3.0) == points[0]);
    CHECK(derivative(cyclic, 3.0) == 3.0 * (points[0] - left[0]));
    CHECK(derivative(open, 2.0) == 3.0 * (points[2] - left[2]));
}

TEST_CASE("derivatives are the limits of differences", "[curve]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        check_derivatives(sample.curve);
    }
}

TEST_CASE("a derivative of another order is refused", "[curve]") {
    const Curve curve = RandomCurves(1).bezier(3);
    CHECK_THROWS_AS(derivative(curve, 0.5, 0), std::invalid_argument);
    CHECK_THROWS_AS(derivative(curve, 0.5, 4), std::invalid_argument);
}

TEST_CASE("parameters outside the interval are mapped as the extend mode says", "[curve]") {
    RandomCurves random(2);
    const Curve curve = smooth_spline(random, 5, false);
    const glm::dvec3 start = position(curve, 0.0);
    const glm::dvec3 end = position(curve, 4.0);
    CHECK(position(curve, -0.5) == start);
    CHECK(position(curve, 9.0) == end);
    CHECK(position(curve, -0.5, Extend::clamp) == start);
    CHECK(position(curve, -0.5, Extend::extrapolate) == start - 0.5 * derivative(curve, 0.0));
    CHECK(position(curve, 4.25, Extend::extrapolate) == end + 0.25 * derivative(curve, 4.0));
    CHECK(position(curve, 5.5, Extend::loop) == position(curve, 1.5));
    CHECK(position(curve, -0.5, Extend::loop) == position(curve, 3.5));
    CHECK(position(curve, 5.5, Extend::ping_pong) == position(curve, 2.5));
    CHECK(position(curve, -0.5, Extend::ping_pong) == position(curve, 0.5));
    CHECK(position(curve, 13.5, Extend::ping_pong) == position(curve, 2.5));
    for (const Extend extend : {Extend::clamp, Extend::extrapolate, Extend::loop, Extend::ping_pong}) {
        CHECK(position(curve, 4.0, extend) == end);
        CHECK(position(curve, 0.0, extend) == start);
        CHECK(position(curve, 2.75, extend) == position(curve, 2.75));
    }
}

TEST_CASE("derivatives outside the interval are those of the extended position", "[curve]") {
    RandomCurves random(2);
    const Curve curve = smooth_spline(random, 5, false);
    const double h = 1e-5;
    for (const Extend extend : {Extend::extrapolate, Extend::loop, Extend::ping_pong}) {
        for (const double t : {-9.3, -4.6, -0.4, 0.7, 4.2, 7.9, 8.3, 13.1}) {
            CAPTURE(static_cast<int>(extend), t);
            const auto difference = [&](auto&& f) { return (f(t + h) - f(t - h)) / (2.0 * h); };
            const glm::dvec3 d1 = derivative(curve, t, 1, extend);
            const glm::dvec3 d2 = derivative(curve, t, 2, extend);
            const glm::dvec3 d3 = derivative(curve, t, 3, extend);
            CHECK(glm::distance(d1, difference([&](double x) { return position(curve, x, extend); })) <=
                  1e-7);
            CHECK(glm::distance(d2, difference([&](double x) { return derivative(curve, x, 1, extend); })) <=
                  1e-6);
            CHECK(glm::distance(d3, difference([&](double x) { return derivative(curve, x, 2, extend); })) <=
                  1e-5);
            CHECK(glm::distance(tangent(curve, t, extend), glm::normalize(d1)) <= 1e-14);
            const glm::dvec3 binormal = glm::cross(d1, d2);
            const double square = glm::dot(binormal, binormal);
            CHECK(curvature(curve, t, extend) ==
                  Approx(std::sqrt(square) / std::pow(glm::length(d1), 3)).margin(1e-14));
            CHECK(torsion(curve, t, extend) ==
                  Approx(square > 0.0 ? glm::dot(binormal, d3) / square : 0.0).margin(1e-14));
        }
    }
}

TEST_CASE("with extend mode clamp, parameters outside the interval give the values at its ends", "[curve]") {
    RandomCurves random(3);
    const Curve curve = smooth_spline(random, 5, false);
    for (const auto& [t, end] : {std::pair{-3.0, 0.0}, std::pair{4.1, 4.0}}) {
        for (const int order : {1, 2, 3})
            CHECK(derivative(curve, t, order, Extend::clamp) == derivative(curve, end, order));
        CHECK(tangent(curve, t, Extend::clamp) == tangent(curve, end));
        CHECK(curvature(curve, t, Extend::clamp) == curvature(curve, end));
        CHECK(torsion(curve, t, Extend::clamp) == torsion(curve, end));
    }
}

TEST_CASE("curvature and torsion of a helix", "[curve]") {
    const double radius = 2.0;
    const double rise = 0.7;
    const double square = radius * radius + rise * rise;
    const Curve curve = helix(radius, rise);
    for (const double t : {0.0, 0.1, 0.2}) {
        CHECK(curvature(curve, t) == Approx(radius / square).epsilon(1e-7));
        CHECK(torsion(curve, t) == Approx(rise / square).epsilon(1e-4));
    }
    const Curve mirrored = helix(radius, -rise);
    CHECK(torsion(mirrored, 0.1) == Approx(-rise / square).epsilon(1e-4));
}

TEST_CASE("curvature scales with the inverse of the size, at any size", "[curve]") {
    for (const double size : {1e-30, 1e-6, 1e6, 1e30}) {
        const Curve unit = RandomCurves(4).bezier(3);
        const Curve scaled = RandomCurves(4).bezier(3, size);
        CHECK(curvature(scaled, 0.3) * size == Approx(curvature(unit, 0.3)).epsilon(1e-9));
        CHECK(torsion(scaled, 0.3) * size == Approx(torsion(unit, 0.3)).epsilon(1e-9));
    }
}

TEST_CASE("the tangent is a unit vector everywhere", "[curve]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        for (const double t : parameters(sample.curve, 65)) {
            const glm::dvec3 along = tangent(sample.curve, t);
            CHECK(glm::length(along) == Approx(1.0).epsilon(1e-14));
            const glm::dvec3 d1 = derivative(sample.curve, t);
            if (glm::length(d1) > 1e-6 * size_of(sample.curve))
                CHECK(glm::distance(along, glm::normalize(d1)) <= 1e-14);
        }
    }
}

TEST_CASE("the tangent at a point where the derivative vanishes is the limit of the tangents beside it",
          "[curve]") {
    SECTION("handle on its point: towards the next one") {
        const Curve curve = Curve::bezier(Points{{0, 0, 0}, {0, 0, 0}, {3, 4, 0}, {3, 4, 0}});
        CHECK(glm::distance(tangent(curve, 0.0), {0.6, 0.8, 0.0}) <= 1e-15);
        CHECK(glm::distance(tangent(curve, 1.0), {0.6, 0.8, 0.0}) <= 1e-15);
        CHECK(curvature(curve, 0.0) == 0.0);
    }
    SECTION("cusp: from the right") {
        const Curve curve = Curve::bezier(Points{{0, 0, 0}, {4, 4, 0}, {0, 4, 0}, {4, 0, 0}});
        REQUIRE(glm::length(derivative(curve, 0.5)) == 0.0);
        CHECK(glm::distance(tangent(curve, 0.5), tangent(curve, 0.5 + 1e-7)) <= 1e-6);
        CHECK(curvature(curve, 0.5) == std::numeric_limits<double>::infinity());
        CHECK(torsion(curve, 0.5) == 0.0);
    }
    SECTION("a parabola run through quadratically keeps its curvature") {
        // (t^2, t^4, 0): y = x^2, curvature 2 at the start.
        const Curve curve =
            Curve::bezier(Points{{0, 0, 0}, {0, 0, 0}, {1.0 / 6, 0, 0}, {0.5, 0, 0}, {1, 1, 0}});
        CHECK(curvature(curve, 0.0) == Approx(2.0));
    }
    SECTION("the same from the end") {
        const Curve curve =
            Curve::bezier(Points{{1, 1, 0}, {0.5, 0, 0}, {1.0 / 6, 0, 0}, {0, 0, 0}, {0, 0, 0}});
        CHECK(curvature(curve, 1.0) == Approx(2.0));
        CHECK(glm::distance(tangent(curve, 1.0), {-1.0, 0.0, 0.0}) <= 1e-15);
    }
    SECTION("a segment of zero length takes its neighbour's") {
        const glm::dvec3 a(1, 0, 0);
        const glm::dvec3 b(1, 5, 0);
        const Curve curve = Curve::chain(1, Points{{0, 0, 0}, a, a, a, a, b, b, b}, false);
        CHECK(tangent(curve, 1.5) == glm::dvec3(0, 1, 0));
        CHECK(tangent(curve, 3.5) == glm::dvec3(0, 1, 0));
        CHECK(curvature(curve, 1.5) == 0.0);
    }
    SECTION("all points in one") {
        const Curve curve = Curve::bezier(Points(4, {1.1, 2.2, 3.3}));
        CHECK(tangent(curve, 0.5) == glm::dvec3(0, 1, 0));
        CHECK(curvature(curve, 0.5) == 0.0);
        CHECK(torsion(curve, 0.5) == 0.0);
        CHECK(glm::distance(position(curve, 0.3), {1.1, 2.2, 3.3}) <= 1e-15);
    }
}

TEST_CASE("invalid control points and handles are refused", "[curve]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const Points two{{0, 0, 0}, {1, 0, 0}};
    CHECK_THROWS_AS(Curve::bezier(Points{}), std::invalid_argument);
    CHECK_THROWS_AS(Curve::bezier(Points{{0, 0, 0}}), std::invalid_argument);
    CHECK_THROWS_AS(Curve::bezier(Points(66)), std::invalid_argument);
    CHECK_THROWS_AS(Curve::bezier(Points{{0, 0, 0}, {nan, 0, 0}}), std::invalid_argument);
    CHECK_THROWS_AS(Curve::bezier(Points{{0, 0, 0}, {0, 0, infinity}}), std::invalid_argument);
    CHECK_THROWS_AS(Curve::bezier(Points{{0, 0, 0}, {0, 0, 1.1 * coordinate_limit}}), std::invalid_argument);
    CHECK_THROWS_AS(Curve::spline(two, two, Points(3), false), std::invalid_argument);
    CHECK_THROWS_AS(Curve::spline(two, Points(1), two, false), std::invalid_argument);
    CHECK_THROWS_AS(Curve::spline(Points(1), Points(1), Points(1), true), std::invalid_argument);
    CHECK_THROWS_AS(Curve::spline(two, Points{{nan, 0, 0}, {0, 0, 0}}, two, false), std::invalid_argument);
    CHECK_THROWS_AS(Curve::chain(3, Points(7), false), std::invalid_argument);
    CHECK_THROWS_AS(Curve::chain(0, Points(4), false), std::invalid_argument);
    CHECK_THROWS_AS(Curve::chain(3, Points{}, false), std::invalid_argument);
}

TEST_CASE("the limit of the curvature holds at any size", "[curve]") {
    // (t^2, t^4): the parabola y = x^2, which sets out with speed 0.
    for (const double size : {1e-90, 1.0, 1e90}) {
        CAPTURE(size);
        Points points{{0, 0, 0}, {0, 0, 0}, {1.0 / 6.0, 0, 0}, {0.5, 0, 0}, {1, 1, 0}};
        for (glm::dvec3& p : points) p *= size;
        CHECK(size * curvature(Curve::bezier(points), 0.0) == Approx(2.0));
    }
}

TEST_CASE("a moved-from curve can still be evaluated", "[curve]") {
    const Curve same = RandomCurves(5).bezier(4);
    Curve curve = same;
    const Curve moved = std::move(curve);
    // NOLINTBEGIN(bugprone-use-after-move): that is what it is about
    CHECK(moved == same);
    CHECK(curve.segment_count() == 1);
    CHECK(position(curve, 0.3) == position(same, 0.3));
    CHECK(tangent(curve, 0.3) == tangent(same, 0.3));
    Curve other = RandomCurves(6).bezier(2);
    other = std::move(curve);
    CHECK(other == same);
    CHECK(ArcLength(curve).length() == ArcLength(same).length());
    // NOLINTEND(bugprone-use-after-move)
}
