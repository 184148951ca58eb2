#include "motus/curve/bspline.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "checks.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::curve::checks;

namespace {

/// Basis function i of the given order at u, by the definition (Cox and de Boor's recursion).
[[nodiscard]] double basis(const std::vector<double>& knots, std::size_t i, std::size_t order, double u) {
    if (order == 1) return knots[i] <= u && u < knots[i + 1] ? 1.0 : 0.0;
    const double before = knots[i + order - 1] - knots[i];
    const double after = knots[i + order] - knots[i + 1];
    double value = 0.0;
    if (before > 0.0) value += (u - knots[i]) / before * basis(knots, i, order - 1, u);
    if (after > 0.0) value += (knots[i + order] - u) / after * basis(knots, i + 1, order - 1, u);
    return value;
}

[[nodiscard]] glm::dvec3 by_definition(const std::vector<glm::dvec3>& points,
                                       const std::vector<double>& knots, std::size_t order, double u) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i + order < knots.size(); ++i)
        sum += basis(knots, i, order, u) * points[i % points.size()];
    return sum;
}

/// The spline and the definition agree inside every knot span that is not empty.
void check_against_definition(const std::vector<glm::dvec3>& points, const BSplineSettings& settings) {
    const Curve curve = bspline(points, settings);
    const std::vector<double> knots = bspline_knots(points.size(), settings);
    const std::size_t order = static_cast<std::size_t>(settings.order);
    const std::size_t end = points.size() + (settings.cyclic ? order - 1 : 0);
    REQUIRE(knots.size() == end + order);
    CHECK(std::is_sorted(knots.begin(), knots.end()));
    std::size_t segment = 0;
    for (std::size_t span = order - 1; span < end; ++span) {
        if (knots[span] == knots[span + 1]) continue;
        for (const double local : {0.0, 0.25, 0.6, 0.99}) {
            const double u = knots[span] + local * (knots[span + 1] - knots[span]);
            CHECK(glm::distance(position(curve, static_cast<double>(segment) + local),
                                by_definition(points, knots, order, u)) <= 1e-14);
        }
        ++segment;
    }
    CHECK(curve.segment_count() == segment);
    CHECK(curve.degree() == settings.order - 1);
}

}  // namespace

TEST_CASE("a B-spline agrees with Cox and de Boor for every order and flag", "[bspline]") {
    RandomCurves random(21);
    for (int order = 2; order <= 6; ++order) {
        for (const bool cyclic : {false, true}) {
            for (const bool endpoint : {false, true}) {
                for (const std::size_t count : {6u, 7u, 11u}) {
                    INFO(order << " " << cyclic << " " << endpoint << " " << count);
                    check_against_definition(random.points(count), {order, cyclic, endpoint, false});
                }
                // As many points as fill the last segment, whether the curve is cyclic or not.
                const std::size_t count = static_cast<std::size_t>(order - 1) * 4;
                if (order == 2) continue;
                INFO(order << " " << cyclic << " " << endpoint << " bezier");
                check_against_definition(random.points(count), {order, cyclic, endpoint, true});
            }
        }
    }
}

TEST_CASE("a B-spline has the knots that Blender gives it", "[bspline]") {
    using Knots = std::vector<double>;
    CHECK(bspline_knots(5, {4, false, false, false}) == Knots{0, 1, 2, 3, 4, 5, 6, 7, 8});
    CHECK(bspline_knots(5, {4, false, true, false}) == Knots{0, 0, 0, 0, 1, 2, 2, 2, 2});
    CHECK(bspline_knots(7, {4, false, true, true}) == Knots{0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2});
    CHECK(bspline_knots(4, {3, true, false, false}) == Knots{0, 1, 2, 3, 4, 5, 6, 7, 8});
}

TEST_CASE("with endpoints the spline begins and ends on its points", "[bspline]") {
    RandomCurves random(22);
    for (int order = 2; order <= 6; ++order) {
        const std::vector<glm::dvec3> points = random.points(9);
        const Curve curve = bspline(points, {order, false, true, false});
        CHECK(glm::distance(position(curve, 0.0), points.front()) <= 1e-15);
        CHECK(glm::distance(position(curve, static_cast<double>(curve.segment_count())), points.back()) <=
              1e-15);
    }
}

TEST_CASE("the segments of a B-spline join smoothly", "[bspline]") {
    RandomCurves random(23);
    const Curve curve = bspline(random.points(8), {4, true, false, false});
    const double end = static_cast<double>(curve.segment_count());
    REQUIRE(curve.segment_count() == 8);
    for (double joint = 0.0; joint < end; joint += 1.0) {
        const Jet after = jet(curve, joint);
        const Jet before = jet(curve, (joint == 0.0 ? end : joint) - 1e-9);
        CHECK(glm::distance(after.position, before.position) <= 1e-8);
        CHECK(glm::distance(after.d1, before.d1) <= 1e-7);
        CHECK(glm::distance(after.d2, before.d2) <= 1e-7);
    }
    CHECK(glm::distance(position(curve, 0.0), position(curve, end)) <= 1e-15);
}

TEST_CASE("a NURBS spline that Blender draws as its control polygon is that polygon", "[bspline]") {
    RandomCurves random(24);
    const std::vector<glm::dvec3> points = random.points(3);
    const Curve few = bspline(points, {4, false, true, false});
    CHECK(few.degree() == 3);
    check_same(poly_line(points, false), few, 1e-15);
    const std::vector<glm::dvec3> seven = random.points(7);
    check_same(poly_line(seven, true), bspline(seven, {4, true, false, true}), 1e-15);
}

TEST_CASE("a poly line goes straight from point to point", "[bspline]") {
    const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
    const Curve open = poly_line(points, false);
    const Curve cyclic = poly_line(points, true);
    CHECK(open.segment_count() == 2);
    CHECK(cyclic.segment_count() == 3);
    CHECK(position(open, 1.5) == glm::dvec3(1, 1, 0));
    CHECK(position(cyclic, 3.0) == points[0]);
    CHECK(ArcLength(cyclic).length() == Approx(3.0 + std::sqrt(5.0)).epsilon(1e-14));
}

TEST_CASE("invalid points, weights and orders of a B-spline are refused", "[bspline]") {
    const std::vector<glm::dvec3> points(5, {1, 2, 3});
    CHECK_THROWS_AS(bspline(points, {1, false, false, false}), std::invalid_argument);
    CHECK_THROWS_AS(bspline(points, {7, false, false, false}), std::invalid_argument);
    CHECK_THROWS_AS(bspline(std::span(points).first(1), {2, false, false, false}), std::invalid_argument);
    CHECK_THROWS_AS(poly_line(std::span(points).first(1), true), std::invalid_argument);
}
