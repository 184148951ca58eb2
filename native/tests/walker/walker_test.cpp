#include "motus/walker/walker.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "motus/core/numeric.hpp"
#include "random.hpp"
#include "walkers.hpp"

using namespace motus::walker;
using motus::test::Random;

namespace {

constexpr glm::dvec3 up{0.0, 0.0, 1.0};
constexpr Gait all_gaits[] = {Gait::tripod, Gait::tetrapod, Gait::ripple, Gait::wave, Gait::trot, Gait::pace};

/// When a leg's first step ends.
double first_landing(const Walker& walker, std::size_t leg) {
    const auto steps = walker.steps(leg);
    return steps.size() > 1 ? steps[1].touch : steps[0].touch;
}

bool same(const Foot& a, const Foot& b) {
    return a.position == b.position && a.normal == b.normal && a.swing == b.swing;
}

/// All that a walker says at a time.
std::vector<Foot> feet_at(const Walker& walker, double time) {
    std::vector<Foot> feet;
    for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) feet.push_back(walker.foot(leg, time));
    return feet;
}

}  // namespace

TEST_CASE("a standing foot does not move by a bit", "[walker]") {
    const Ground ground = hilly_ground();
    for (const Gait gait : all_gaits) {
        const Walker walker(way_along(8.0, around, gait), {}, &ground);
        for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) {
            const auto steps = walker.steps(leg);
            REQUIRE(steps.size() > 4);
            for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
                CHECK(steps[i].touch <= steps[i + 1].lift);
                CHECK(steps[i].end == steps[i + 1].start);
                for (const double share : {0.0, 0.3, 0.999, 1.0}) {
                    const double stand = steps[i + 1].lift - steps[i].touch;
                    const double time = std::min(steps[i].touch + share * stand, steps[i + 1].lift);
                    CHECK(walker.foot(leg, time).position == steps[i].end);
                    CHECK(walker.foot(leg, time).swing == 0.0);
                }
            }
        }
    }
}

TEST_CASE("a standing foot is within half a stride of its rest place", "[walker]") {
    for (const Gait gait : all_gaits) {
        for (const double duty : {0.3, 0.5, 0.8}) {
            for (const auto& pose : {there, around}) {
                Way way = way_along(8.0, pose, gait);
                way.duty = duty;
                way.stride = 0.4;
                const BodyTrajectory trajectory(way);
                const Ground ground = plane();
                const Walker walker(way, {}, &ground);
                double farthest = 0.0;
                for (double time = 0.0; time < 9.0; time += 0.0171) {
                    const glm::dmat4 body = trajectory.pose(0, time);
                    for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) {
                        const Foot foot = walker.foot(leg, time);
                        if (foot.swing > 0.0 || time < first_landing(walker, leg)) continue;
                        const glm::dvec3 off = foot.position - in_world(body, way.rest[leg]);
                        const glm::dvec3 above = trajectory.axes(body).up;
                        farthest = std::max(farthest, glm::length(off - above * glm::dot(off, above)));
                    }
                }
                CHECK(farthest < 0.5 * way.stride + 0.02);
                CHECK(farthest > 0.2 * way.stride);
            }
        }
    }
}

TEST_CASE("feet of a body at rest are on their rest places and stay", "[walker]") {
    const Ground ground = plane();
    for (const Gait gait : all_gaits) {
        Way way = way_along(8.0, there, gait);
        const Walker walker(way, {}, &ground);
        // The body sets off after a second: nothing has moved yet, and later all has come to an end.
        for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) {
            CHECK(walker.foot(leg, 0.0).position == way.rest[leg]);
            const glm::dvec3 end = in_world(way.poses.back(), way.rest[leg]);
            CHECK(glm::length(walker.foot(leg, 100.0).position - end) <= 1e-5 * way.stride);
            CHECK(walker.foot(leg, walker.settled()).position == walker.foot(leg, 1e6).position);
            CHECK(walker.steps(leg).back().touch <= 4.0 + 2.0 / way.cadence);
            CHECK(walker.steps(leg).size() < 25);
        }
    }
    const Walker still(way_along(60.0, [](double) { return moved({1.0, 2.0, 0.0}); }), {}, &ground);
    for (std::size_t leg = 0; leg < still.leg_count(); ++leg) CHECK(still.steps(leg).size() == 1);
    const auto [offset, rotation] = still.body(3.0);
    CHECK(glm::length(offset) < 1e-12);
    CHECK(std::abs(rotation.w) == Approx(1.0));
}

TEST_CASE("all feet stand when a body sets off, and it comes walking if it moves at once", "[walker]") {
    const Ground ground = plane();
    for (const Gait gait : all_gaits) {
        const auto at_once = [](double time) { return there(time + 1.0); };
        const Walker sets_off(way_along(6.0, at_once, gait), {}, &ground);
        for (std::size_t leg = 0; leg < sets_off.leg_count(); ++leg)
            CHECK(sets_off.foot(leg, 0.0).swing == 0.0);
        const auto evenly = [](double time) { return moved({0.0, 1.5 * time, 0.0}); };
        const Walker comes(way_along(6.0, evenly, gait), {}, &ground);
        std::size_t swinging = 0;
        for (std::size_t leg = 0; leg < comes.leg_count(); ++leg)
            if (comes.foot(leg, 0.01).swing > 0.0) ++swinging;
        CHECK(swinging > 0);
    }
}

TEST_CASE("neighbours do not swing together", "[walker]") {
    const Ground ground = plane();
    const Walker walker(way_along(8.0, around, Gait::tetrapod), {}, &ground);
    for (double time = 0.0; time < 8.0; time += 0.01) {
        for (std::size_t leg = 0; leg + 2 < walker.leg_count(); ++leg) {
            const bool both = walker.foot(leg, time).swing > 0.0 && walker.foot(leg + 2, time).swing > 0.0;
            CHECK_FALSE(both);
        }
    }
}

TEST_CASE("a swing is smooth, and clears the ground", "[walker]") {
    const Ground ground = hilly_ground();
    WalkSettings settings;
    settings.clearance = 0.2;
    const Walker walker(way_along(8.0, around), settings, &ground);
    for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) {
        for (const Footstep& step : walker.steps(leg)) {
            if (step.touch == step.lift) continue;
            const double h = 1e-5 * (step.touch - step.lift);
            const auto at = [&](double time) { return walker.foot(leg, time).position; };
            // No speed where it lifts and touches.
            CHECK(glm::length(at(step.lift + h) - at(step.lift)) / h < 1e-4);
            CHECK(glm::length(at(step.touch) - at(step.touch - h)) / h < 1e-4);
            const double quarters = glm::length(step.end - step.start) / (0.25 * 0.5);
            CHECK(glm::length(step.rise) >= 0.2 * std::min(1.0, quarters) * (1.0 - 1e-12));
            for (double u = 0.02; u < 1.0; u += 0.02) {
                const glm::dvec3 foot = at(step.lift + u * (step.touch - step.lift));
                CHECK(foot.z > hills(foot.x, foot.y) - 0.03);
            }
            const glm::dvec3 apex = at(0.5 * (step.lift + step.touch));
            CHECK(glm::length(apex - 0.5 * (step.start + step.end) - step.rise) < 1e-9);
        }
    }
}

TEST_CASE("feet stand on the ground, and have its normal", "[walker]") {
    const Ground ground = hilly_ground();
    const Walker walker(way_along(8.0, around), {}, &ground);
    for (double time = 0.0; time < 9.0; time += 0.1) {
        for (const Foot& foot : feet_at(walker, time)) {
            CHECK(glm::length(foot.normal) == Approx(1.0));
            if (foot.swing == 0.0)
                CHECK(foot.position.z == Approx(hills(foot.position.x, foot.position.y)).margin(0.02));
        }
    }
    CHECK(walker.problems().empty());
}

TEST_CASE("a walk is the same at any times in any order, with any number of threads", "[walker]") {
    const Ground ground = hilly_ground();
    WalkSettings settings;
    settings.hips.assign(8, {0.0, 0.0, 0.5});
    settings.lengths.assign(8, 1.3);
    const Way way = way_along(10.0, around, Gait::ripple);
    const Walker one(way, settings, &ground, 1), many(way, settings, &ground, 7);
    Random random(8);
    for (int trial = 0; trial < 500; ++trial) {
        const double time = random.between(-1.0, 13.0);
        const std::vector<Foot> a = feet_at(one, time), b = feet_at(many, time);
        CHECK(std::ranges::equal(a, b, same));
        CHECK(one.body(time).offset == many.body(time).offset);
        CHECK(one.body(time).rotation == many.body(time).rotation);
    }
    CHECK(one.problems().size() == many.problems().size());
    CHECK(one.settled() == many.settled());
}

TEST_CASE("the body rises and leans with the ground", "[walker]") {
    const double slope = 0.25;
    const Ground hill({}, {}, Plane{{0.0, 0.0, 0.5}, {0.0, -slope, 1.0}});
    WalkSettings settings;
    settings.reach_up = settings.reach_down = 3.0;
    Way way = way_along(8.0, there);
    const Walker walker(way, settings, &hill);
    const Correction end = walker.body(30.0);
    CHECK(end.offset.z == Approx(0.5 + 4.0 * slope).epsilon(1e-3));
    const glm::dvec3 leaned = end.rotation * up;
    CHECK(glm::length(leaned - glm::normalize(glm::dvec3(0.0, -slope, 1.0))) < 1e-3);
    settings.height = 0.5;
    settings.tilt = 0.0;
    const Correction half = Walker(way, settings, &hill).body(30.0);
    CHECK(half.offset.z == Approx(0.5 * end.offset.z));
    CHECK(half.rotation == glm::dquat(1.0, 0.0, 0.0, 0.0));
    // Smooth at all times.
    for (double time = 0.0; time < 8.0; time += 0.01)
        CHECK(glm::length(walker.body(time + 0.01).offset - walker.body(time).offset) < 0.05);
}

TEST_CASE("a body walks up a wall", "[walker]") {
    // A floor, and a wall at y = 2; the body turns up in a quarter of a circle.
    const Land floor = land(6.0, 24, [](double, double) { return 0.0; });
    Land wall = land(6.0, 24, [](double, double) { return 0.0; });
    for (glm::vec3& p : wall.positions) p = {p.x, 2.0f, p.y};
    const Ground ground = ground_of(joined(floor, wall));
    const auto climb = [](double time) {
        const double s = 0.5 * time - 2.0, quarter = 0.5 * std::numbers::pi;
        const double angle = std::clamp(s, 0.0, quarter);
        glm::dvec3 place(0.0, 1.0 + std::min(s, 0.0) + std::sin(angle), 1.0 - std::cos(angle));
        place.z += std::max(0.0, s - quarter);
        return moved(place) * glm::rotate(glm::dmat4(1.0), angle, {1.0, 0.0, 0.0});
    };
    WalkSettings settings;
    settings.reach_up = 0.6;
    const Walker walker(way_along(10.0, climb), settings, &ground);
    CHECK(walker.problems().empty());
    for (const Foot& foot : feet_at(walker, 0.0)) CHECK(foot.position.z == Approx(0.0).margin(0.3));
    for (std::size_t leg = 0; leg < 8; ++leg) {
        const Foot foot = walker.foot(leg, 60.0);
        CHECK(foot.position.y == Approx(2.0));
        CHECK(foot.normal.y == Approx(-1.0));
        for (const Footstep& step : walker.steps(leg)) {
            const bool on_floor = std::abs(step.end.z) < 1e-6, on_wall = std::abs(step.end.y - 2.0) < 1e-6;
            CHECK((on_floor || on_wall));
        }
    }
}

TEST_CASE("after a jump of the body all feet are at the new place at once", "[walker]") {
    const Ground ground = plane();
    const auto pose = [](double time) { return moved({time < 2.0 ? 0.0 : 30.0, 0.5 * time, 0.0}); };
    const Way way = way_along(4.0, pose);
    const Walker walker(way, {}, &ground);
    for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) {
        CHECK(walker.foot(leg, std::nextafter(2.0, 0.0)).position.x < 5.0);
        CHECK(walker.foot(leg, 2.0).position.x > 25.0);
    }
    CHECK(glm::length(walker.body(2.0).offset) < 1e-9);
    // What comes before does not matter.
    const Walker alone(way_along(2.0, [&](double time) { return pose(time + 2.0); }), {}, &ground);
    for (double time = 0.0; time < 3.0; time += 0.07)
        for (std::size_t leg = 0; leg < walker.leg_count(); ++leg)
            CHECK(glm::length(walker.foot(leg, time + 2.0).position - alone.foot(leg, time).position) < 1e-9);
}

TEST_CASE("steps shorter than the minimum step are left out", "[walker]") {
    const Ground ground = plane();
    const auto trembles = [](double time) { return moved({0.02 * std::sin(40.0 * time), 0.0, 0.0}); };
    WalkSettings settings;
    CHECK(Walker(way_along(5.0, trembles), settings, &ground).steps(0).size() > 3);
    settings.minimum_step = 0.05;
    const Walker calm(way_along(5.0, trembles), settings, &ground);
    for (std::size_t leg = 0; leg < 8; ++leg) CHECK(calm.steps(leg).size() == 1);
}

TEST_CASE("without ground a foot is on its rest place, and a problem is reported", "[walker]") {
    const Ground deep = plane(-10.0);
    const Walker walker(way_along(6.0, there), {}, &deep);
    REQUIRE(walker.problems().size() >= 8);
    for (const Problem& problem : walker.problems()) {
        CHECK(problem.trouble == Trouble::no_ground);
        CHECK(problem.first <= problem.last);
        CHECK(walker.foot(problem.leg, problem.first).position.z == 0.0);
    }
    // No ground at all is nothing to speak of.
    const Walker free(way_along(6.0, there), {});
    CHECK(free.problems().empty());
    const Ground nothing({}, {}, std::nullopt);
    CHECK(Walker(way_along(6.0, there), {}, &nothing).problems().empty());
    CHECK(free.foot(3, 2.5).normal == up);
}

TEST_CASE("a foothold out of the leg's reach is replaced by a nearer one, or reported if there is none",
          "[walker]") {
    WalkSettings settings;
    const Way way = way_along(8.0, there);
    for (const glm::dvec3& place : way.rest) settings.hips.push_back(0.3 * place + 0.4 * up);
    settings.lengths.assign(8, 1.3);
    const Ground level = plane();
    CHECK(Walker(way, settings, &level).problems().empty());

    // A trench on the right from y = 1 on, 0.8 m beside the way, deeper than ground is looked for.
    const auto trench = [](double x, double y) { return x > 0.8 && y > 1.0 ? -2.0 : 0.0; };
    const Ground ditch = ground_of(land(8.0, 160, trench));
    const Walker beside(way, settings, &ditch);
    CHECK(beside.problems().empty());
    for (std::size_t leg = 0; leg < 8; ++leg) CHECK(beside.foot(leg, 20.0).position.z > -0.7);

    settings.lengths[2] = 0.3;
    settings.lengths[5] = 0.0;
    const Walker walker(way, settings, &level);
    REQUIRE_FALSE(walker.problems().empty());
    for (const Problem& problem : walker.problems()) {
        CHECK((problem.leg == 2 || problem.leg == 5));
        CHECK(problem.trouble == (problem.leg == 2 ? Trouble::out_of_reach : Trouble::no_length));
        CHECK((problem.first >= 0.0 && problem.first <= problem.last && problem.last <= walker.settled()));
    }
}

TEST_CASE("a foot counts as out of reach at exactly those samples at which it is", "[walker]") {
    // Legs that are too short at both ends of a stand, but not in its middle.
    WalkSettings settings;
    const Way way = way_along(8.0, there);
    for (const glm::dvec3& place : way.rest) settings.hips.push_back(place + 0.5 * up);
    settings.lengths.assign(8, 0.52);
    settings.height = settings.tilt = 0.0;
    glm::dmat4 lowered(1.0);
    lowered[3] = {0.0, 0.0, -0.1, 1.0};
    const Ground level = plane();
    for (const bool is_lowered : {false, true}) {
        if (is_lowered) settings.bodies.assign(way.times.size(), lowered);
        const Walker walker(way, settings, &level);
        std::size_t missed = 0;
        for (std::size_t leg = 0; leg < 8; ++leg) {
            for (std::size_t i = 0; i < way.times.size(); ++i) {
                const double time = way.times[i];
                const Foot foot = walker.foot(leg, time);
                if (foot.swing > 0.0) continue;
                const glm::dvec3 hip = settings.hips[leg] - (is_lowered ? 0.1 * up : glm::dvec3(0.0));
                const bool is_out = glm::length(foot.position - in_world(way.poses[i], hip)) > 0.52;
                const bool is_said = std::ranges::any_of(walker.problems(), [&](const Problem& problem) {
                    return problem.leg == leg && problem.first <= time && time <= problem.last;
                });
                CAPTURE(leg, time, is_lowered);
                CHECK(is_said == is_out);
                missed += is_out ? 1 : 0;
            }
        }
        CHECK((missed > 0) == !is_lowered);
    }
}

TEST_CASE("scaled, mirrored and vanished bodies walk too", "[walker]") {
    const Ground ground = plane();
    for (const glm::dvec3& scale : {glm::dvec3(2.0), glm::dvec3(-1.0, 1.0, 1.0), glm::dvec3(1.0, 2.0, 0.5),
                                    glm::dvec3(1.0, 1.0, -1.0), glm::dvec3(0.0)}) {
        Way way =
            way_along(6.0, [&](double time) { return there(time) * glm::scale(glm::dmat4(1.0), scale); });
        const Walker walker(way, {}, &ground);
        for (std::size_t leg = 0; leg < 8; ++leg) {
            const glm::dvec3 end = in_world(way.poses.back(), way.rest[leg]);
            CHECK(glm::length(walker.foot(leg, 50.0).position - end) <= 1e-5 * way.stride);
            for (double time = 0.0; time < 6.0; time += 0.1) {
                CHECK(motus::is_finite(walker.foot(leg, time).position));
                CHECK(walker.foot(leg, time).position.z > -0.3);
            }
        }
        CHECK(motus::is_finite(walker.body(3.0).rotation));
    }
    // It grows out of nothing.
    const Way grows = way_along(
        3.0, [](double time) { return glm::scale(glm::dmat4(1.0), glm::dvec3(std::min(1.0, 0.5 * time))); });
    const Walker walker(grows, {}, &ground);
    for (std::size_t leg = 0; leg < 8; ++leg)
        CHECK(glm::length(walker.foot(leg, 9.0).position - grows.rest[leg]) < 1e-4);
}

TEST_CASE("a walk can be planned from one sample and for any number of legs", "[walker]") {
    const Ground ground = plane();
    Way way = way_along(0.0, there);
    REQUIRE(way.times.size() == 1);
    const Walker one(way, {}, &ground);
    for (std::size_t leg = 0; leg < 8; ++leg) CHECK(one.foot(leg, 5.0).position == way.rest[leg]);
    for (const std::size_t legs : {std::size_t{1}, std::size_t{2}, std::size_t{3}, most_legs}) {
        Random random(legs);
        way = way_along(4.0, around);
        way.rest.clear();
        for (std::size_t leg = 0; leg < legs; ++leg)
            way.rest.emplace_back(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 0.0);
        way.phases = pattern_of(Gait::wave, way.rest, {0.0, 1.0, 0.0}, up).phases;
        const Walker walker(way, {}, &ground);
        for (double time = 0.0; time < 5.0; time += 0.1)
            for (const Foot& foot : feet_at(walker, time)) CHECK(motus::is_finite(foot.position));
    }
}

TEST_CASE("a walk with too many steps is refused before it is planned", "[walker]") {
    Way way = way_along(10.0, [](double time) { return moved({0.0, 100.0 * time, 0.0}); });
    way.jump = 1e9;
    way.stride = 1e-3;
    CHECK_THROWS_WITH(Walker(way, {}), Catch::StartsWith("poses"));
    way.stride = 0.5;
    way.cadence = 1000.0;
    way.poses.assign(way.times.size(), glm::dmat4(1.0));
    for (double& time : way.times) time *= 100.0;
    CHECK_THROWS_WITH(Walker(way, {}), Catch::Contains("cadence"));
}

TEST_CASE("invalid settings of a walk are refused by the argument's name", "[walker]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Way way = way_along(1.0, there);
    const auto refused = [&](const char* name, const auto& spoil) {
        WalkSettings settings;
        spoil(settings);
        CHECK_THROWS_WITH(Walker(way, settings), Catch::StartsWith(name));
    };
    refused("clearance", [](WalkSettings& s) { s.clearance = -0.1; });
    refused("reach_up", [&](WalkSettings& s) { s.reach_up = nan; });
    refused("reach_down", [](WalkSettings& s) { s.reach_down = 1e13; });
    refused("minimum_step", [](WalkSettings& s) { s.minimum_step = -1.0; });
    refused("height", [](WalkSettings& s) { s.height = 1.1; });
    refused("tilt", [&](WalkSettings& s) { s.tilt = nan; });
    refused("hips", [](WalkSettings& s) { s.hips.resize(3); });
    refused("lengths", [](WalkSettings& s) { s.hips.resize(8); });
    refused("bodies", [](WalkSettings& s) { s.bodies.resize(1); });
    refused("hips", [&](WalkSettings& s) {
        s.hips.assign(8, {0.0, nan, 0.0});
        s.lengths.assign(8, 1.0);
    });
    refused("lengths", [](WalkSettings& s) {
        s.hips.resize(8);
        s.lengths.assign(8, -1.0);
    });
    const Walker walker(way, {});
    CHECK_THROWS_WITH(walker.foot(8, 0.0), Catch::StartsWith("leg"));
    CHECK_THROWS_WITH(walker.foot(0, nan), Catch::StartsWith("time"));
    CHECK_THROWS_WITH(walker.body(nan), Catch::StartsWith("time"));
}
