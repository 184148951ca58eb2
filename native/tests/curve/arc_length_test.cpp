#include "motus/curve/arc_length.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <thread>

#include "checks.hpp"
#include "data/arc_length.hpp"
#include "motus/curve/bezier.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::curve::checks;

namespace {

/// Length by brute force: Richardson's extrapolation of the chords' sums, whose error goes with the square of
/// the step.
[[nodiscard]] double chord_length(const Curve& curve, std::size_t segment, std::size_t steps) {
    double sum = 0.0;
    const double first = static_cast<double>(segment);
    const auto at = [&](std::size_t i) {
        if (i == steps) return curve.segment(segment).back();
        return position(curve, first + static_cast<double>(i) / static_cast<double>(steps));
    };
    for (std::size_t i = 0; i < steps; ++i) sum += glm::distance(at(i), at(i + 1));
    return sum;
}

[[nodiscard]] double brute_force_length(const Curve& curve) {
    double length = 0.0;
    for (std::size_t i = 0; i < curve.segment_count(); ++i)
        length += (4.0 * chord_length(curve, i, 20000) - chord_length(curve, i, 10000)) / 3.0;
    return length;
}

/// Largest relative difference of a chord from its step, in steps of equal distance.
[[nodiscard]] double unevenness(const ArcLength& path, int steps) {
    const double step = path.length() / steps;
    glm::dvec3 last = position_at_length(path, 0.0);
    double worst = 0.0;
    for (int i = 1; i <= steps; ++i) {
        const glm::dvec3 next = position_at_length(path, step * i);
        worst = std::max(worst, std::abs(glm::distance(last, next) / step - 1.0));
        last = next;
    }
    return worst;
}

}  // namespace

TEST_CASE("lengths and positions of the reference curves", "[arc_length]") {
    for (const reference::ArcLengthCase& known : reference::arc_length_cases) {
        INFO(known.name);
        const ArcLength path(Curve::chain(3, known.control_points, false));
        CHECK(std::abs(path.length() - known.length) <= 1e-14 * known.length);
        for (std::size_t i = 0; i < known.positions.size(); ++i) {
            const double s = known.length * static_cast<double>(i) / 10.0;
            CHECK(glm::distance(position_at_length(path, s), known.positions[i]) <= 2e-12 * known.length);
        }
    }
}

TEST_CASE("lengths of curves with a closed form are right", "[arc_length]") {
    using Points = std::vector<glm::dvec3>;
    const auto length = [](const Points& points) { return ArcLength(Curve::bezier(points)).length(); };
    CHECK(length({{0, 0, 0}, {3, 4, 0}}) == Approx(5.0).epsilon(1e-15));
    // (t, t^2): asinh(2) / 4 + sqrt(5) / 2.
    CHECK(length({{0, 0, 0}, {0.5, 0, 0}, {1, 1, 0}}) ==
          Approx(std::asinh(2.0) / 4 + std::sqrt(5.0) / 2).epsilon(1e-14));
    // (t^2, t^3): (13^1.5 - 8) / 27, with a cusp at the start.
    CHECK(length({{0, 0, 0}, {0, 0, 0}, {1.0 / 3, 0, 0}, {1, 1, 0}}) ==
          Approx((13.0 * std::sqrt(13.0) - 8.0) / 27.0).epsilon(1e-14));
    // The curve through its cusp: t from -1 to 1.
    CHECK(length({{1, -1, 0}, {-1.0 / 3, 1, 0}, {-1.0 / 3, -1, 0}, {1, 1, 0}}) ==
          Approx(2.0 * (13.0 * std::sqrt(13.0) - 8.0) / 27.0).epsilon(1e-13));
    // Out to x = 4/9 at t = 2/3, back to 0: x = 3 t^2 (1 - t).
    CHECK(length({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}}) == Approx(8.0 / 9.0).epsilon(1e-13));
    CHECK(length({{1.1, 2.2, 3.3}, {1.1, 2.2, 3.3}, {1.1, 2.2, 3.3}}) == 0.0);
}

TEST_CASE("the length is the limit of the chords", "[arc_length]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        const double length = ArcLength(sample.curve).length();
        CHECK(std::abs(brute_force_length(sample.curve) - length) <= 3e-8 * length);
    }
}

TEST_CASE("distance and parameter are inverse to each other", "[arc_length]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        check_arc_length(ArcLength(sample.curve));
    }
}

TEST_CASE("random curves of all degrees and sizes", "[arc_length]") {
    RandomCurves random(31);
    for (int trial = 0; trial < 60; ++trial) {
        const int degree = 1 + trial % 32;
        const double size = std::pow(10.0, random.between(-6.0, 6.0));
        INFO("trial " << trial << " degree " << degree << " size " << size);
        std::vector<glm::dvec3> points = random.points(static_cast<std::size_t>(degree) + 1, size);
        // Now and then points fall together, or one coordinate is far larger than the rest.
        if (trial % 3 == 1) points[points.size() / 2] = points.front();
        if (trial % 5 == 2) points.back().x *= 1e4;
        check_arc_length(ArcLength(Curve::bezier(points)));
    }
}

TEST_CASE("the largest and the smallest curves are finite work", "[arc_length]") {
    for (const double size : {0.99 * coordinate_limit, 1e90, 1e-90, 1e-140, 1e-200, 1e-300}) {
        INFO("size " << size);
        const ArcLength path(
            Curve::bezier(std::vector<glm::dvec3>{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {size, size, 0}}));
        CHECK(path.evaluation_count() <= 4000);
        CHECK(path.interval_count() <= 400);
        CHECK(path.length() >= 0.0);
        CHECK(std::isfinite(path.length()));
        CHECK(std::isfinite(path.t_at_length(0.5 * path.length())));
    }
}

TEST_CASE("equal steps of the distance are equal chords in the limit", "[arc_length]") {
    RandomCurves random(32);
    for (const Curve& curve :
         {smooth_spline(random, 6, false), smooth_spline(random, 6, true), random.bezier(9)}) {
        const ArcLength path(curve);
        const double coarse = unevenness(path, 5000);
        const double fine = unevenness(path, 20000);
        // A chord is shorter than its arc by a part that goes with the square of the step: 16 times less
        // here.
        CHECK(fine <= 0.002);
        CHECK(fine <= coarse / 12.0);
    }
}

TEST_CASE("gaps between segments and segments of zero length add nothing to the distance", "[arc_length]") {
    const glm::dvec3 o(0.0);
    const glm::dvec3 a(1, 0, 0);
    const glm::dvec3 b(5, 0, 0);
    const glm::dvec3 c(5, 2, 0);
    const ArcLength path(Curve::chain(1, std::vector{o, a, a, a, b, c}, false));
    CHECK(path.length() == Approx(3.0).epsilon(1e-15));
    CHECK(path.segment_start(0) == 0.0);
    CHECK(path.segment_start(1) == Approx(1.0));
    CHECK(path.segment_start(2) == Approx(1.0));
    CHECK(path.segment_start(3) == path.length());
    CHECK(glm::distance(position_at_length(path, 0.75), {0.75, 0, 0}) <= 1e-12);
    CHECK(glm::distance(position_at_length(path, 1.0), b) <= 1e-12);
    CHECK(glm::distance(position_at_length(path, 2.5), {5, 1.5, 0}) <= 1e-12);
    CHECK(path.length_at(1.5) == Approx(1.0));
    CHECK_THROWS(path.segment_start(4));
}

TEST_CASE("distances outside the curve are mapped as the extend mode says", "[arc_length]") {
    RandomCurves random(33);
    const ArcLength path(smooth_spline(random, 5, false));
    const double length = path.length();
    const glm::dvec3 start = position(path.curve(), 0.0);
    const glm::dvec3 end = position(path.curve(), 4.0);
    CHECK(position_at_length(path, -1.0) == start);
    CHECK(position_at_length(path, length + 1.0) == end);
    const double away = 0.7;
    CHECK(glm::distance(position_at_length(path, -away, Extend::extrapolate),
                        start - away * tangent(path.curve(), 0.0)) <= 1e-15);
    CHECK(glm::distance(position_at_length(path, length + away, Extend::extrapolate),
                        end + away * tangent(path.curve(), 4.0)) <= 1e-14);
    CHECK(t_at_length(path, length + away, Extend::extrapolate).beyond == Approx(away));
    CHECK(t_at_length(path, -away, Extend::extrapolate).beyond == Approx(-away));
    for (const double s : {0.1 * length, 0.5 * length, 0.93 * length}) {
        const glm::dvec3 here = position_at_length(path, s);
        const double tolerance = 1e-11 * length;
        CHECK(glm::distance(position_at_length(path, s + length, Extend::loop), here) <= tolerance);
        CHECK(glm::distance(position_at_length(path, s - 3.0 * length, Extend::loop), here) <= tolerance);
        CHECK(glm::distance(position_at_length(path, -s, Extend::ping_pong), here) <= tolerance);
        CHECK(glm::distance(position_at_length(path, 2.0 * length - s, Extend::ping_pong), here) <=
              tolerance);
        CHECK(glm::distance(position_at_length(path, 4.0 * length + s, Extend::ping_pong), here) <=
              tolerance);
    }
    std::vector<double> distances{-1.0, 0.3 * length, 7.0 * length};
    std::vector<glm::dvec3> positions(3);
    positions_at_length(path, distances, Extend::loop, positions);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(positions[i] == position_at_length(path, distances[i], Extend::loop));
}

TEST_CASE("the distance of a parameter outside the curve gives the position of that parameter",
          "[arc_length]") {
    RandomCurves random(34);
    const ArcLength path(smooth_spline(random, 5, false));
    for (const Extend extend : {Extend::clamp, Extend::extrapolate, Extend::loop, Extend::ping_pong}) {
        double last = -std::numeric_limits<double>::infinity();
        for (const double t : {-13.7, -9.3, -4.6, -0.4, 0.0, 0.7, 4.0, 4.2, 7.9, 8.3, 13.1}) {
            CAPTURE(static_cast<int>(extend), t);
            const double s = length_at(path, t, extend);
            CHECK(glm::distance(position_at_length(path, s, extend), position(path.curve(), t, extend)) <=
                  1e-10 * path.length());
            CHECK(s >= last);
            last = s;
        }
        CHECK((extend == Extend::clamp ? last == path.length() : last > path.length()));
    }
    CHECK(length_at(path, 9.5, Extend::loop) == Approx(2.0 * path.length() + path.length_at(1.5)));
    CHECK(length_at(path, -0.5, Extend::ping_pong) == Approx(-path.length_at(0.5)));
}

TEST_CASE("a curve without length is its point at every distance", "[arc_length]") {
    const glm::dvec3 point(1.1, 2.2, 3.3);
    const ArcLength path(Curve::chain(3, std::vector<glm::dvec3>(8, point), true));
    CHECK(path.length() == 0.0);
    CHECK(path.length_at(1.3) == 0.0);
    CHECK(path.interval_count() == 0);
    for (const Extend extend : {Extend::clamp, Extend::extrapolate, Extend::loop, Extend::ping_pong}) {
        for (const double s : {-1.0, 0.0, 2.0}) {
            CHECK(t_at_length(path, s, extend).value == 0.0);
            CHECK(length_at(path, s, extend) == 0.0);
            CHECK(position_at_length(path, s, extend) == point);
        }
    }
}

TEST_CASE("a distance that is NaN gives a parameter that is NaN", "[arc_length]") {
    const ArcLength path(RandomCurves(1).bezier(3));
    CHECK(std::isnan(path.t_at_length(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("arc lengths do not depend on earlier questions", "[arc_length]") {
    RandomCurves random(34);
    const Curve curve = smooth_spline(random, 7, true);
    const ArcLength asked(curve);
    const ArcLength fresh(curve);
    for (int i = 0; i < 1000; ++i) (void)asked.t_at_length(random.between(0.0, asked.length()));
    for (int i = 0; i < 100; ++i) {
        const double s = random.between(0.0, asked.length());
        CHECK(asked.t_at_length(s) == fresh.t_at_length(s));
        CHECK(asked.t_at_length(s) == ArcLength(curve).t_at_length(s));
    }
}

TEST_CASE("threads that build the inverse at once agree", "[arc_length]") {
    RandomCurves random(35);
    const ArcLength path(smooth_spline(random, 20, true));
    std::vector<std::vector<double>> answers(4, std::vector<double>(500));
    std::vector<std::thread> threads;
    for (std::vector<double>& answer : answers) {
        threads.emplace_back([&path, &answer] {
            for (std::size_t i = 0; i < answer.size(); ++i)
                answer[i] = path.t_at_length(path.length() * static_cast<double>(i) /
                                             static_cast<double>(answer.size()));
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::vector<double>& answer : answers) CHECK(answer == answers.front());
}

TEST_CASE("building the arc-length table takes a bounded number of evaluations and intervals",
          "[arc_length]") {
    const auto& known = reference::arc_length_cases.back();
    const ArcLength chain(Curve::chain(3, known.control_points, false));
    REQUIRE(chain.curve().segment_count() == 20);
    CHECK(chain.evaluation_count() <= 4500);  // measured: 3502
    CHECK(chain.interval_count() <= 180);     // measured: 133
    for (const Named& sample : degenerate_curves()) {
        INFO(sample.name);
        const ArcLength path(sample.curve);
        CHECK(path.evaluation_count() <= 3000);
        CHECK(path.interval_count() <= 400);
    }
    const ArcLength line(Curve::bezier(std::vector<glm::dvec3>{{0, 0, 0}, {1, 2, 3}}));
    CHECK(line.evaluation_count() == 17);
    CHECK(line.interval_count() == 1);
}

TEST_CASE("building the arc-length table takes bounded work if the curve's speed is mostly rounding error",
          "[arc_length]") {
    RandomCurves random(36);
    // The control points of a Chebyshev polynomial: the curve is smaller than they are by twelve digits and
    // more.
    for (const int degree : {40, 64}) {
        std::vector<glm::dvec3> points = random.points(static_cast<std::size_t>(degree) + 1);
        double size = 1.0;  // binomial(2 n, 2 k) / binomial(n, k)
        for (std::size_t k = 0; k < points.size(); ++k) {
            points[k] += (k % 2 == 0 ? size : -size) * glm::dvec3(1.0, 0.5, 0.2);
            const double left = 2.0 * static_cast<double>(degree) - 2.0 * static_cast<double>(k);
            const double next = static_cast<double>(k) + 1.0;
            size *= left * (left - 1.0) / (2.0 * next * (2.0 * next - 1.0)) * next / (0.5 * left);
        }
        const ArcLength path(Curve::bezier(points));
        CHECK(path.evaluation_count() <= 20000);
        CHECK(path.interval_count() <= 20000);
        CHECK(std::isfinite(path.t_at_length(0.3 * path.length())));
    }
    // Lengths whose squares are below the smallest number.
    for (const double size : {1e-155, 1e-161, 1e-165}) {
        const ArcLength path(random.bezier(3, size));
        CHECK(path.evaluation_count() <= 3000);
        CHECK(path.length() <= 20.0 * size);
        CHECK(path.t_at_length(0.5 * path.length()) <= 1.0);
    }
}

TEST_CASE("positions at several distances refuse an output of a different size", "[arc_length]") {
    const ArcLength path(RandomCurves(1).bezier(3));
    const std::vector<double> distances(3, 0.1);
    std::vector<glm::dvec3> positions(2);
    CHECK_THROWS_AS(positions_at_length(path, distances, Extend::clamp, positions), std::invalid_argument);
    positions.resize(4);
    CHECK_THROWS_AS(positions_at_length(path, distances, Extend::clamp, positions), std::invalid_argument);
}
