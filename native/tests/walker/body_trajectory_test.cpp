#include "motus/walker/body_trajectory.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "random.hpp"
#include "walkers.hpp"

using namespace motus::walker;
using motus::test::Random;

namespace {

/// At 2 m/s ahead.
glm::dmat4 ahead(double time) {
    return moved({0.0, 2.0 * time, 0.0});
}

}  // namespace

TEST_CASE("the cadence grows with the speed, and is never below the set cadence", "[trajectory]") {
    Way way = way_along(4.0, ahead);
    way.stride = 0.4;
    const BodyTrajectory fast(way);
    CHECK(fast.phase(0, 3.0) == Approx(way.duty * 2.0 / 0.4 * 3.0));
    way.cadence = 10.0;
    CHECK(BodyTrajectory(way).phase(0, 3.0) == Approx(30.0));
    CHECK_FALSE(fast.starts_slowly(0));
    CHECK(BodyTrajectory(way).starts_slowly(0));

    // On the spot: the feet on the outside decide.
    Way spin = way_along(4.0, [](double time) {
        return glm::rotate(glm::dmat4(1.0), 0.8 * time, {0.0, 0.0, 1.0});
    });
    spin.stride = 0.2;
    double radius = 0.0;
    for (const glm::dvec3& place : spin.rest) radius = std::max(radius, glm::length(place));
    CHECK(BodyTrajectory(spin).phase(0, 3.0) == Approx(spin.duty * 0.8 * radius / 0.2 * 3.0).epsilon(1e-3));

    // Up and down, feet have nowhere to go.
    const Way bounce = way_along(4.0, [](double time) { return moved({0.0, 0.0, std::sin(9.0 * time)}); });
    CHECK(BodyTrajectory(bounce).phase(0, 3.0) == Approx(3.0 * bounce.cadence));
}

TEST_CASE("times and phases are each other's inverse, beyond the ends too", "[trajectory]") {
    Random random(1);
    const Way way = way_along(6.0, around);
    const BodyTrajectory trajectory(way);
    double before = -std::numeric_limits<double>::infinity();
    for (double time = -2.0; time < 9.0; time += 0.013) {
        const double phase = trajectory.phase(0, time);
        CHECK(phase > before);
        before = phase;
        CHECK(trajectory.time_at(0, phase) == Approx(time).margin(1e-9));
    }
    CHECK(trajectory.phase(0, 0.0) == 0.0);
    CHECK(trajectory.phase(0, 8.0) - trajectory.phase(0, 7.0) == Approx(way.cadence));
}

TEST_CASE("the body's poses are the samples, interpolated linearly between them", "[trajectory]") {
    Random random(2);
    Way way = way_along(3.0, around);
    for (glm::dmat4& pose : way.poses) pose = pose * glm::scale(glm::dmat4(1.0), {2.0, -1.0, 0.5});
    const BodyTrajectory trajectory(way);
    for (std::size_t i = 0; i < way.times.size(); ++i)
        CHECK(trajectory.pose(0, way.times[i]) == way.poses[i]);
    const glm::dmat4 half = trajectory.pose(0, 0.5 * (way.times[3] + way.times[4]));
    for (int axis = 0; axis < 3; ++axis)
        CHECK(glm::length(half[axis]) ==
              Approx(0.5 * (glm::length(way.poses[3][axis]) + glm::length(way.poses[4][axis]))));
    CHECK(glm::length(half[3] - 0.5 * (way.poses[3][3] + way.poses[4][3])) < 1e-12);
    // Before the first sample the body moves at its first velocity, unless that is slow, and it rests at the
    // end.
    const glm::dvec3 step(way.poses[1][3] - way.poses[0][3]);
    CHECK(glm::length(glm::dvec3(trajectory.pose(0, -1.0)[3] - way.poses[0][3]) + 24.0 * step) < 1e-9);
    CHECK(trajectory.pose(0, 100.0) == way.poses.back());
    way.cadence = 100.0;
    CHECK(BodyTrajectory(way).pose(0, -1.0) == way.poses.front());
}

TEST_CASE("axes are at right angles whatever the pose is", "[trajectory]") {
    Random random(3);
    Way way = way_along(1.0, ahead);
    for (int trial = 0; trial < 200; ++trial) {
        way.up = random.direction();
        const BodyTrajectory trajectory(way);
        glm::dmat4 pose(1.0);
        for (int axis = 0; axis < 3; ++axis) pose[axis] = glm::dvec4(random.in_cube(), 0.0);
        if (trial % 4 == 0) pose[trial % 3] = glm::dvec4(0.0);
        if (trial == 0) pose = glm::dmat4(0.0);
        const Axes axes = trajectory.axes(pose);
        const glm::dmat3 all(axes.side, axes.ahead, axes.up);
        const glm::dmat3 product = glm::transpose(all) * all;
        for (int axis = 0; axis < 3; ++axis)
            CHECK(glm::length(product[axis] - glm::dmat3(1.0)[axis]) < 1e-12);
    }
    way.up = {0.0, 0.0, 1.0};
    CHECK(BodyTrajectory(way).axes(glm::dmat4(0.0)).up == glm::dvec3(0.0, 0.0, 1.0));
}

TEST_CASE("a jump of the body begins a new stretch of the walk", "[trajectory]") {
    Way way = way_along(4.0, [](double time) { return moved({time < 2.0 ? 0.0 : 30.0, 0.5 * time, 0.0}); });
    const BodyTrajectory found(way);
    REQUIRE(found.stretch_count() == 2);
    CHECK(found.first_sample(1) == 48);
    CHECK(found.last_sample(0) == 47);
    CHECK(found.stretch_at(1.999) == 0);
    CHECK(found.stretch_at(2.0) == 1);
    CHECK(found.stretch_at(-9.0) == 0);
    CHECK(found.stretch_at(9.0) == 1);
    CHECK(found.phase(1, 2.0) == 0.0);
    // Until the jump the body keeps its place.
    CHECK(found.pose(0, 1.99) == way.poses[47]);
    way.jump = 100.0;
    CHECK(BodyTrajectory(way).stretch_count() == 1);
    way.resets = {0, 20, 48};
    const BodyTrajectory told(way);
    REQUIRE(told.stretch_count() == 3);
    CHECK(told.first_sample(1) == 20);
    way.jump = 1e-9;
    CHECK(BodyTrajectory(way).stretch_count() == way.times.size());
}

TEST_CASE("invalid times and poses of a body are refused by the argument's name", "[trajectory]") {
    const Way good = way_along(1.0, ahead);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [&](const char* name, const auto& spoil) {
        Way way = good;
        spoil(way);
        CHECK_THROWS_WITH(BodyTrajectory(way), Catch::StartsWith(name));
    };
    refused("times", [](Way& w) {
        w.times.clear();
        w.poses.clear();
    });
    refused("times", [&](Way& w) { w.times[3] = nan; });
    refused("times", [](Way& w) { w.times[3] = w.times[2]; });
    refused("times", [](Way& w) { w.times.resize(most_samples + 1); });
    refused("poses", [](Way& w) { w.poses.pop_back(); });
    refused("poses", [&](Way& w) { w.poses[2][1][3] = nan; });
    refused("poses", [](Way& w) { w.poses[2][1][3] = 1e13; });
    refused("rest", [](Way& w) { w.rest.clear(); });
    refused("rest", [](Way& w) { w.rest.resize(most_legs + 1); });
    refused("rest", [&](Way& w) { w.rest[1].y = nan; });
    refused("phases", [](Way& w) { w.phases.pop_back(); });
    refused("phases", [&](Way& w) { w.phases[0] = nan; });
    refused("duty", [](Way& w) { w.duty = 0.0; });
    refused("duty", [](Way& w) { w.duty = 1.0; });
    refused("stride", [](Way& w) { w.stride = 0.0; });
    refused("stride", [&](Way& w) { w.stride = nan; });
    refused("cadence", [](Way& w) { w.cadence = 0.0; });
    refused("up", [](Way& w) { w.up = glm::dvec3(0.0); });
    refused("resets", [](Way& w) { w.resets = {5, 5}; });
    refused("resets", [](Way& w) { w.resets = {1000}; });
    refused("jump", [](Way& w) { w.jump = 0.0; });
    refused("jump", [&](Way& w) { w.jump = nan; });
}
