#include "motus/curve/nearest.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "checks.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::curve::checks;

namespace {

/// An arc of radius 1 about the origin as a Bézier curve: the Taylor polynomials of cosine and sine. It is
/// off by angle^(degree + 1) / (degree + 1)!.
Curve nearly_an_arc(double angle, std::size_t degree) {
    std::vector<glm::dvec3> points(degree + 1, glm::dvec3(0.0));
    double coefficient = 1.0;  // of t^k in the exponential of i angle t, but for the power of i
    for (std::size_t k = 0; k <= degree; ++k) {
        double share = coefficient;  // times C(i, k) / C(degree, k)
        for (std::size_t i = degree + 1; i-- > k;) {
            points[i][static_cast<glm::length_t>(k % 2)] += k % 4 < 2 ? share : -share;
            if (i > 0) share *= static_cast<double>(i - k) / static_cast<double>(i);
        }
        coefficient *= angle / static_cast<double>(k + 1);
    }
    return Curve::bezier(points);
}

}  // namespace

TEST_CASE("no sample of the curve is nearer than the nearest point", "[nearest]") {
    RandomCurves random(11);
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        const double size = size_of(sample.curve);
        for (int trial = 0; trial < 12; ++trial) {
            const glm::dvec3 point = sample.curve.control_points()[0] + random.in_cube(1.5 * size);
            const Nearest found = nearest(sample.curve, point);
            CHECK(found.distance == Approx(glm::distance(found.position, point)).epsilon(1e-15));
            CHECK(glm::distance(found.position, position(sample.curve, found.t)) <= 1e-14 * size);
            double nearest_sample = glm::distance(position(sample.curve, 0.0), point);
            for (const double t : parameters(sample.curve, 1001))
                nearest_sample = std::min(nearest_sample, glm::distance(position(sample.curve, t), point));
            CHECK(found.distance <= nearest_sample * (1.0 + 1e-12) + 1e-13 * size);
        }
    }
}

TEST_CASE("away from the ends the way to the nearest point is across the curve", "[nearest]") {
    RandomCurves random(12);
    int inside = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Curve curve = random.bezier(3 + trial % 5);
        const glm::dvec3 point = random.in_cube(2.0);
        const Nearest found = nearest(curve, point);
        if (found.t <= 0.0 || found.t >= 1.0) continue;
        ++inside;
        CHECK(std::abs(glm::dot(found.position - point, tangent(curve, found.t))) <= 1e-12);
    }
    CHECK(inside > 50);
}

TEST_CASE("a point of the curve is its own nearest point", "[nearest]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        for (const double t : parameters(sample.curve, 23)) {
            const glm::dvec3 point = position(sample.curve, t);
            CHECK(nearest(sample.curve, point).distance <= 1e-13 * size_of(sample.curve));
        }
    }
}

TEST_CASE("a far bend is not hidden by a near one", "[nearest]") {
    // A W whose middle looks the best to a local search from the middle.
    const Curve curve =
        Curve::bezier(std::vector<glm::dvec3>{{0, 0, 0}, {1, -8, 0}, {2, 12, 0}, {3, -8, 0}, {4, 0, 0}});
    const Nearest left = nearest(curve, {0.8, -3.0, 0.0});
    const Nearest right = nearest(curve, {3.2, -3.0, 0.0});
    CHECK(left.t < 0.5);
    CHECK(right.t > 0.5);
    CHECK(left.distance == Approx(right.distance).epsilon(1e-12));
}

TEST_CASE("nearest point of a segment and of a curve without length", "[nearest]") {
    const Curve line = Curve::bezier(std::vector<glm::dvec3>{{0, 0, 0}, {4, 0, 0}});
    const Nearest found = nearest(line, {1.0, 2.0, 0.0});
    CHECK(found.t == Approx(0.25));
    CHECK(found.distance == Approx(2.0));
    CHECK(nearest(line, {-3.0, 4.0, 0.0}).distance == Approx(5.0));
    CHECK(nearest(line, {-3.0, 4.0, 0.0}).t == 0.0);
    const Curve dot = Curve::bezier(std::vector<glm::dvec3>(4, {1, 1, 1}));
    CHECK(nearest(dot, {1, 1, 3}).distance == 2.0);
}

TEST_CASE("the nearest point of a small curve far from the origin is found at once", "[nearest]") {
    // Its coordinates carry rounding of 1e-10, a ten millionth of its size.
    RandomCurves random(13);
    const std::vector<glm::dvec3> near_origin = random.points(4, 1e-3);
    const glm::dvec3 far(1e6);
    std::vector<glm::dvec3> moved;
    for (const glm::dvec3& p : near_origin) moved.push_back(p + far);
    const Curve curve = Curve::bezier(moved);
    for (int trial = 0; trial < 50; ++trial) {
        const glm::dvec3 point = random.in_cube(2e-3);
        const double expected = nearest(Curve::bezier(near_origin), point).distance;
        CHECK(nearest(curve, far + point).distance == Approx(expected).margin(1e-9));
    }
    CHECK_THROWS_AS(nearest(curve, glm::dvec3(1e200)), std::invalid_argument);
    CHECK_THROWS_AS(nearest(curve, glm::dvec3(0.0, std::nan(""), 0.0)), std::invalid_argument);
}

TEST_CASE("from the centre of an arc few parts of it are looked at", "[nearest]") {
    constexpr std::size_t most = 300;  // by the chords alone up to 8 million
    RandomCurves random(14);
    for (const double angle : {0.3, 1.0, 1.57, 3.0}) {
        for (std::size_t degree = 2; degree <= 24; ++degree) {
            CAPTURE(angle, degree);
            const Curve arc = nearly_an_arc(angle, degree);
            const Nearest found = nearest(arc, glm::dvec3(0.0));
            CHECK(found.parts <= most);
            for (const double t : parameters(arc, 1001))
                REQUIRE(found.distance <= glm::length(position(arc, t)) * (1.0 + 2e-12));
            CHECK(nearest(arc, random.in_cube(1e-9)).parts <= most);
            CHECK(nearest(arc, {0.0, 0.0, 1.0}).parts <= most);
        }
    }
    for (int trial = 0; trial < 200; ++trial) {
        const Curve curve = random.bezier(2 + trial % 40);
        CHECK(nearest(curve, random.in_cube(2.0)).parts <= most);
    }
}
