#include "motus/curve/bezier.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "checks.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::curve::checks;

TEST_CASE("both parts of a split curve are the curve", "[bezier]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        const Curve& curve = sample.curve;
        const double end = static_cast<double>(curve.segment_count());
        const double tolerance = 1e-13 * size_of(curve);
        for (const double fraction : {0.0, 0.123, 0.5, 0.77, 1.0}) {
            const double t = fraction * end;
            const Location at = locate(curve, t);
            const double cut_start = static_cast<double>(at.segment);
            const auto [before, after] = split(curve, t);
            if (at.t == 0.0 && at.segment > 0) {
                CHECK(before.segment_count() == at.segment);
                CHECK(after.segment_count() == curve.segment_count() - at.segment);
                continue;
            }
            CHECK(before.segment_count() == at.segment + 1);
            CHECK(after.segment_count() == curve.segment_count() - at.segment);
            // Up to 0.9: at 1 the next segment begins, which may lie apart.
            for (const double u : {0.0, 0.2, 0.6, 0.9}) {
                CHECK(glm::distance(position(before, cut_start + u), position(curve, cut_start + u * at.t)) <=
                      tolerance);
                CHECK(glm::distance(position(after, u),
                                    position(curve, cut_start + at.t + u * (1.0 - at.t))) <= tolerance);
            }
        }
    }
}

TEST_CASE("a split at a joint of two segments splits neither", "[bezier]") {
    RandomCurves random(5);
    const Curve curve = smooth_spline(random, 6, true);
    const auto [before, after] = split(curve, 2.0);
    CHECK(before.segment_count() == 2);
    CHECK(after.segment_count() == 4);
    CHECK_FALSE(before.cyclic());
    CHECK(std::equal(after.control_points().begin(), after.control_points().end(), curve.segment(2).begin()));
}

TEST_CASE("lengths of the parts add up", "[bezier]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        const double whole = ArcLength(sample.curve).length();
        const auto [before, after] =
            split(sample.curve, 0.37 * static_cast<double>(sample.curve.segment_count()));
        CHECK(ArcLength(before).length() + ArcLength(after).length() == Approx(whole).epsilon(1e-12));
    }
}

TEST_CASE("degree elevation keeps the curve", "[bezier]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        for (const int times : {0, 1, 4, 16}) {
            const Curve higher = elevated(sample.curve, times);
            CHECK(higher.degree() == sample.curve.degree() + times);
            CHECK(higher.cyclic() == sample.curve.cyclic());
            check_same(sample.curve, higher, 1e-14);
        }
    }
    const Curve curve = RandomCurves(1).bezier(60);
    CHECK_THROWS_AS(elevated(curve, 5), std::invalid_argument);
    CHECK_THROWS_AS(elevated(curve, -1), std::invalid_argument);
}

TEST_CASE("a reversed curve runs back", "[bezier]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        const Curve back = reversed(sample.curve);
        const double end = static_cast<double>(sample.curve.segment_count());
        for (double t = 0.037; t < end; t += 0.11) {
            CHECK(glm::distance(position(back, end - t), position(sample.curve, t)) <=
                  1e-13 * size_of(sample.curve));
        }
        const ArcLength path(sample.curve);
        const ArcLength path_back(back);
        CHECK(path_back.length() == Approx(path.length()).epsilon(1e-13));
        for (const double fraction : {0.1, 0.35, 0.8}) {
            const double s = fraction * path.length();
            CHECK(glm::distance(position_at_length(path, s),
                                position_at_length(path_back, path.length() - s)) <= 1e-10 * path.length());
        }
    }
}

TEST_CASE("a rigid motion moves the points and keeps the lengths", "[bezier]") {
    // Turned about (1, 2, 2) / 3 by the angle with cosine 0.6: a matrix of exact fractions.
    const glm::dvec3 axis(1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0);
    glm::dmat4 motion(1.0);
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 e(0.0);
        e[column] = 1.0;
        const glm::dvec3 turned = 0.6 * e + 0.8 * glm::cross(axis, e) + 0.4 * glm::dot(axis, e) * axis;
        motion[column] = glm::dvec4(turned, 0.0);
    }
    motion[3] = glm::dvec4(0.5, -2.0, 1.0, 1.0);
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        const Curve moved = transformed(sample.curve, motion);
        const double tolerance = 1e-13 * (size_of(sample.curve) + 3.0);
        for (const double t : parameters(sample.curve, 17))
            CHECK(glm::distance(position(moved, t), glm::dvec3(motion * glm::dvec4(position(sample.curve, t),
                                                                                   1.0))) <= tolerance);
        CHECK(std::abs(ArcLength(moved).length() - ArcLength(sample.curve).length()) <= 10.0 * tolerance);
    }
}

TEST_CASE("bounds hold the curve and are touched by it on every side", "[bezier]") {
    for (const Named& sample : sample_curves()) {
        INFO(sample.name);
        const Box box = bounds(sample.curve);
        const double size = size_of(sample.curve);
        glm::dvec3 low = position(sample.curve, 0.0);
        glm::dvec3 high = low;
        for (const double t : parameters(sample.curve, 20001)) {
            const glm::dvec3 p = position(sample.curve, t);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        for (std::size_t i = 0; i < sample.curve.segment_count(); ++i) {
            low = glm::min(low, sample.curve.segment(i).back());
            high = glm::max(high, sample.curve.segment(i).back());
        }
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(low[axis] >= box.min[axis] - 1e-14 * size);
            CHECK(high[axis] <= box.max[axis] + 1e-14 * size);
            // The samples miss an extreme by no more than half a step of the parameter, squared.
            CHECK(low[axis] - box.min[axis] <= 1e-5 * size);
            CHECK(box.max[axis] - high[axis] <= 1e-5 * size);
        }
    }
}

TEST_CASE("bounds of a known cubic", "[bezier]") {
    // y = 3 t (1 - t): highest 3/4 at the middle.
    const Box box =
        bounds(Curve::bezier(std::vector<glm::dvec3>{{0, 0, 0}, {1, 1, 0}, {2, 1, 0}, {3, 0, 0}}));
    CHECK(box.min == glm::dvec3(0, 0, 0));
    CHECK(box.max == glm::dvec3(3, 0.75, 0));
}
