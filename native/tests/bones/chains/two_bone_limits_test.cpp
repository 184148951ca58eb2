// Two bones where the plane, the line or the numbers run out.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "two_bone_checks.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::chains;
using namespace motus::bones::chains::checks;
using std::numbers::pi;

namespace {

/// The elbow while `move(chain, u)` runs from u = 0 to 1: whether it jumps, which is to go farther than
/// 0.05 within 1e-11 of the way.
template <class Move>
bool jumps(const TwoBone& chain, Move&& move) {
    const auto elbow = [&](double u) {
        TwoBone at = chain;
        move(at, u);
        return solve_two_bone(at).elbow;
    };
    const auto jumps_between = [&](auto&& self, double u0, const glm::dvec3& elbow0, double u1,
                                   const glm::dvec3& elbow1) -> bool {
        if (glm::distance(elbow0, elbow1) < 0.05) return false;
        if (u1 - u0 < 1e-11) return true;
        const double half = 0.5 * (u0 + u1);
        const glm::dvec3 elbow_half = elbow(half);
        return self(self, u0, elbow0, half, elbow_half) || self(self, half, elbow_half, u1, elbow1);
    };
    constexpr int steps = 1000;
    glm::dvec3 last = elbow(0.0);
    for (int i = 1; i <= steps; ++i) {
        const double u = static_cast<double>(i) / steps;
        const glm::dvec3 now = elbow(u);
        if (jumps_between(jumps_between, u - 1.0 / steps, last, u, now)) return true;
        last = now;
    }
    return false;
}

}  // namespace

TEST_CASE("a pole that crosses the line turns the elbow through the plane", "[two_bone]") {
    RandomTwoBones random(11);
    for (int i = 0; i < 300; ++i) {
        TwoBone chain = random.reachable();
        if (i % 3 > 0) chain.plane = random.direction();
        const glm::dvec3 line = glm::normalize(chain.target - chain.root);
        const glm::dvec3 place = chain.root + random.between(-4.0, 4.0) * line;
        const glm::dvec3 way = random.direction();
        // Through the line, or past it within the band.
        const glm::dvec3 miss = i % 2 == 0 ? glm::dvec3(0.0) : 0.05 * random.direction();
        CAPTURE(i);
        CHECK_FALSE(
            jumps(chain, [&](TwoBone& at, double u) { at.pole = place + miss + (2.0 * u - 1.0) * way; }));
        // Next with the plane across the way, which the normals of both sides are parallel and opposite to.
        chain.plane = glm::cross(line, way);
        CHECK_FALSE(jumps(chain, [&](TwoBone& at, double u) { at.pole = place + (2.0 * u - 1.0) * way; }));
    }
}

TEST_CASE("a pole that passes by the root does not flip the elbow", "[two_bone]") {
    RandomTwoBones random(12);
    for (int i = 0; i < 100; ++i) {
        TwoBone chain = random.reachable();
        if (i % 2 == 0) chain.plane = random.direction();
        const glm::dvec3 way = random.direction();
        CHECK_FALSE(jumps(chain, [&](TwoBone& at, double u) { at.pole = at.root + (2.0 * u - 1.0) * way; }));
    }
}

TEST_CASE("a target that crosses the pole turns the elbow through the plane", "[two_bone]") {
    const TwoBone chain{.root = {0, 0, 0}, .pole = {0, 3, 0}, .plane = {0.3, 0.1, 1.0}};
    CHECK_FALSE(jumps(chain, [](TwoBone& at, double u) {
        at.target = 1.5 * glm::dvec3(std::sin(u - 0.5), std::cos(u - 0.5), 0.2 * std::sin(u - 0.5));
    }));
}

TEST_CASE("a pole on the line from root to target leaves the bend to the given plane", "[two_bone]") {
    TwoBone chain{.root = {0, 0, 0}, .target = {0, 1.5, 0}, .pole = {0, 4, 0}, .plane = {0, 0, 2}};
    for (const int bend : {1, -1}) {
        chain.bend = bend;
        chain.pole = {0, 4, 0};
        CHECK(glm::distance(solve_two_bone(chain).normal, glm::dvec3(0, 0, 1)) < 1e-15);
        CHECK(solve_two_bone(chain).elbow.x < -0.6);  // plane x line
        chain.pole = {4.0 * std::sin(1.01 * pole_band), 4.0 * std::cos(1.01 * pole_band), 0.0};
        CHECK(bend * solve_two_bone(chain).elbow.x > 0.6);
        chain.pole = {0.0, 4.0 * std::cos(1.01 * pole_band), 4.0 * std::sin(1.01 * pole_band)};
        CHECK(bend * solve_two_bone(chain).elbow.z > 0.6);
    }
}

TEST_CASE("as the pole nears the line from root to target, its plane turns into the given plane",
          "[two_bone]") {
    const auto normal = [](double share, const glm::dvec3& plane) {
        const double sine = share * pole_band;
        return solve_two_bone({.root = {0, 0, 0},
                               .target = {0, 1.5, 0},
                               .pole = {4.0 * sine, 4.0 * std::sqrt(1.0 - sine * sine), 0.0},
                               .plane = plane})
            .normal;
    };
    const glm::dvec3 of_pole(0, 0, -1);
    for (const glm::dvec3 plane : {glm::dvec3(1, 0, 0), {0, 0, 1}, {0.6, 0, 0.8}}) {
        double last = -1.0;
        for (double share = 0.0; share <= 1.0; share += 0.05) {
            const double towards_pole = glm::dot(normal(share, plane), of_pole);
            CHECK(towards_pole > last - 1e-15);
            last = towards_pole;
        }
        CHECK(glm::distance(normal(0.0, plane), plane) < 1e-15);
        CHECK(glm::distance(normal(1.0, plane), of_pole) < 1e-15);
    }
    for (double share = 0.0; share <= 1.0; share += 0.05)  // both the same: nothing turns
        CHECK(glm::distance(normal(share, of_pole), of_pole) < 1e-15);
}

TEST_CASE("a plane along the line gives way without a jump", "[two_bone]") {
    const TwoBone chain{.root = {0, 0, 0}, .target = {0, 1.5, 0}, .pole = {0, 9, 0}};
    CHECK_FALSE(
        jumps(chain, [](TwoBone& at, double u) { at.plane = glm::dvec3(u - 0.5, 1.0, 0.3 * (u - 0.5)); }));
}

TEST_CASE("the fixed normal jumps at one direction only", "[two_bone]") {
    // The lines that a rig's axes suggest: all round the circles across its axes and diagonals.
    TwoBone chain{.root = {0, 0, 0}, .pole = {0, 0, 0}};
    for (const glm::dvec3 axis :
         {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {0, 1, -1}, {1, 1, 1}}) {
        const glm::dvec3 start = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.5, -0.2)));
        CHECK_FALSE(jumps(chain, [&](TwoBone& at, double u) {
            at.target = 1.5 * (glm::angleAxis(2.0 * pi * u, glm::normalize(axis)) * start);
        }));
    }
    for (const glm::dvec3 line : {glm::dvec3(0.48, -0.6, 0.64), {-0.48, 0.6, -0.64}}) {
        chain.target = line;
        CHECK(length_error(chain, solve_two_bone(chain)) < 1e-15);
    }
}

TEST_CASE("a side of the elbow that changes at once is a jump", "[two_bone]") {  // or jumps() would be blind
    const TwoBone chain{.root = {0, 0, 0}, .target = {0, 1.5, 0}, .pole = {0, 0, 9}};
    CHECK(jumps(chain, [](TwoBone& at, double u) { at.bend = u < 0.3 ? 1 : -1; }));
}

TEST_CASE("the elbow passes the ends of the reach without a jump", "[two_bone]") {
    for (const double softness : {0.0, 0.2}) {
        for (const double stretch : {0.0, 0.5, 1.0}) {
            const TwoBone chain{.root = {0, 0, 0},
                                .pole = {0, 1, 0},
                                .length1 = 1.3,
                                .length2 = 0.8,
                                .softness = softness,
                                .stretch = stretch};
            CHECK_FALSE(jumps(chain, [](TwoBone& at, double u) { at.target = {0.1 + 3.0 * u, 0, 0}; }));
        }
    }
}

TEST_CASE("a target on the root folds the chain towards the pole", "[two_bone]") {
    RandomTwoBones random(13);
    for (int i = 0; i < 1000; ++i) {
        TwoBone chain = random.reachable();
        chain.target = chain.root;
        chain.pole = chain.root + 0.5 * random.direction();
        if (i % 2 == 0) chain.length2 = chain.length1;
        if (i % 3 == 0) chain.plane = random.direction();
        const TwoBoneSolution at = solve_two_bone(chain);
        const glm::dvec3 side = double(chain.bend) * glm::normalize(chain.pole - chain.root);
        CHECK(glm::distance(at.elbow, chain.root + chain.length1 * side) < 1e-14);
        CHECK(length_error(chain, at) < 1e-14);
        CHECK(at.residual == std::abs(chain.length1 - chain.length2));
        CHECK(at.reason == (i % 2 == 0 ? Reason::reached : Reason::too_near));
        CHECK(std::abs(glm::length(at.normal) - 1.0) < 1e-15);
    }
}

TEST_CASE("zero lengths and coincident points", "[two_bone]") {
    const glm::dvec3 points[] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
    for (const glm::dvec3& target : points) {
        for (const glm::dvec3& pole : points) {
            for (const glm::dvec3& plane : points) {
                for (const double l1 : {0.0, 1.0}) {
                    for (const double l2 : {0.0, 1.0}) {
                        const TwoBone chain{.root = {0, 0, 0},
                                            .target = target,
                                            .pole = pole,
                                            .length1 = l1,
                                            .length2 = l2,
                                            .plane = plane};
                        const TwoBoneSolution at = solve_two_bone(chain);
                        CAPTURE(target.x, target.y, pole.x, pole.y, plane.x, plane.y, l1, l2);
                        CHECK(length_error(chain, at) < 1e-15);
                        const double distance = glm::length(target);
                        const double end = std::clamp(distance, std::abs(l1 - l2), l1 + l2);
                        CHECK(glm::length(at.tip) == Approx(end).margin(1e-15));
                        CHECK(at.residual == Approx(std::abs(distance - end)).margin(1e-15));
                        CHECK(std::abs(glm::length(at.normal) - 1.0) < 1e-15);
                    }
                }
            }
        }
    }
}

TEST_CASE("far from the origin only the coordinates are rounded", "[two_bone]") {
    RandomTwoBones random(14);
    for (int i = 0; i < 2000; ++i) {
        TwoBone chain = random.reachable();
        const double far = std::pow(10.0, random.between(0.0, 9.0));
        const glm::dvec3 place = far * random.direction();
        chain.target = place + (chain.target - chain.root);
        chain.pole = place + (chain.pole - chain.root);
        chain.root = place;
        const TwoBoneSolution at = solve_two_bone(chain);
        CHECK(length_error(chain, at) < 2e-15 * (chain.length1 + chain.length2) + 3.0 * 1.2e-16 * far);
        if (at.reason == Reason::reached) CHECK(at.residual <= 1e-12 * (chain.length1 + chain.length2));
    }
}

TEST_CASE("the unit of length does not matter", "[two_bone]") {
    RandomTwoBones random(15);
    for (int i = 0; i < 2000; ++i) {
        TwoBone chain = random.reachable();
        chain.root = {0, 0, 0};
        chain.softness = random.between(0.0, 0.5);
        chain.stretch = random.between(0.0, 1.0);
        chain.target *= random.between(0.1, 2.0);
        const TwoBoneSolution at = solve_two_bone(chain);
        for (const int exponent : {-900, -400, 400, 900, 1015}) {
            const double unit = std::ldexp(1.0, exponent);
            TwoBone other = chain;
            other.target *= unit;
            other.pole *= unit;
            other.length1 *= unit;
            other.length2 *= unit;
            other.softness *= unit;
            const TwoBoneSolution there = solve_two_bone(other);
            CHECK(glm::distance(there.elbow / unit, at.elbow) < 1e-14);
            CHECK(glm::distance(there.tip / unit, at.tip) < 1e-14);
            CHECK(glm::distance(there.normal, at.normal) < 1e-12);
            CHECK(there.residual / unit == Approx(at.residual).margin(1e-14));
            CHECK(there.scale == Approx(at.scale).epsilon(1e-14));
            CHECK(there.reason == at.reason);
        }
    }
}

TEST_CASE("points at both ends of the doubles", "[two_bone]") {
    constexpr double most = std::numeric_limits<double>::max();
    const TwoBone chain{.root = {-most, 0, 0},
                        .target = {most, 0, 0},
                        .pole = {0, most, 0},
                        .length1 = most,
                        .length2 = most};
    TwoBoneSolution at = solve_two_bone(chain);  // 2 most apart: just straight
    CHECK(at.tip == chain.target);
    CHECK(std::abs(at.elbow.x) < 1e-7 * most);
    CHECK(std::abs(at.elbow.y) < 1e-7 * most);
    TwoBone shorter = chain;
    shorter.length2 = 0.5 * most;
    at = solve_two_bone(shorter);
    CHECK(at.tip.x == Approx(0.5 * most));
    CHECK(at.residual == Approx(0.5 * most));
    CHECK(at.reason == Reason::too_far);
}

TEST_CASE("every finite input has a finite answer", "[two_bone]") {
    RandomTwoBones random(16);
    for (int i = 0; i < 300000; ++i) {
        const TwoBone chain = random.wild();
        const TwoBoneSolution at = solve_two_bone(chain);
        CAPTURE(i);
        REQUIRE(is_finite(at.elbow));
        REQUIRE(is_finite(at.tip));
        REQUIRE(std::abs(glm::length(at.normal) - 1.0) < 1e-14);
        REQUIRE(std::isfinite(at.scale));
        REQUIRE(at.scale >= 1.0);
        REQUIRE(std::isfinite(at.residual));
        REQUIRE(at.residual >= 0.0);
        REQUIRE(static_cast<int>(at.reason) <= static_cast<int>(Reason::too_near));
    }
}

TEST_CASE("two bones with numbers that are not finite are refused", "[two_bone]") {
    const double odd[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()};
    for (const double value : odd) {
        for (int place = 0; place < 16; ++place) {
            TwoBone chain;
            double* const places[] = {&chain.root.x,   &chain.root.y,   &chain.root.z,   &chain.target.x,
                                      &chain.target.y, &chain.target.z, &chain.pole.x,   &chain.pole.y,
                                      &chain.pole.z,   &chain.plane.x,  &chain.plane.y,  &chain.plane.z,
                                      &chain.length1,  &chain.length2,  &chain.softness, &chain.stretch};
            *places[place] = value;
            CAPTURE(value, place);
            CHECK_THROWS_AS(solve_two_bone(chain), std::invalid_argument);
        }
    }
}
