#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "random.hpp"
#include "walkers.hpp"

using namespace motus::walker;
using motus::test::Random;

namespace {

constexpr glm::dvec3 ahead{0.0, 1.0, 0.0}, up{0.0, 0.0, 1.0};
constexpr double speed = 1.2;
constexpr std::size_t changed = 60;  ///< sample of the change, s: changed / 24
constexpr std::size_t legs = 4;

std::vector<glm::dvec3> four_feet() {
    return {{-0.2, 0.5, 0.0}, {0.2, 0.5, 0.0}, {-0.2, -0.5, 0.0}, {0.2, -0.5, 0.0}};
}

GaitChange change_to(Gait gait, std::size_t sample = changed) {
    const Pattern pattern = pattern_of(gait, four_feet(), ahead, up);
    return {sample, pattern.phases, pattern.duty};
}

/// A horse that goes over from a gait to another one.
Way way_with(Gait before, const std::vector<GaitChange>& changes) {
    Way way = way_along(8.0, [](double time) { return moved({0.0, speed * time, 0.0}); });
    way.rest = four_feet();
    const Pattern pattern = pattern_of(before, way.rest, ahead, up);
    way.phases = pattern.phases;
    way.duty = pattern.duty;
    way.changes = changes;
    return way;
}

/// A whole number when the leg lifts.
double own_cycle(const BodyTrajectory& trajectory, std::size_t leg, double time) {
    return trajectory.first_phase(0, leg) + trajectory.cycles(0, leg, time);
}

/// The distance of two phases on the circle.
double apart(double one, double other) {
    return std::abs(one - other - std::round(one - other));
}

}  // namespace

TEST_CASE("legs go over to the phases and the duty of a gait within a transition", "[gait change]") {
    for (const double transition : {1.0, 2.5}) {
        Way way = way_with(Gait::walk, {change_to(Gait::trot)});
        way.transition = transition;
        const BodyTrajectory trajectory(way);
        const double begin = way.times[changed];
        const double over = trajectory.time_at(0, trajectory.phase(0, begin) + transition);
        const GaitChange trot = change_to(Gait::trot);
        for (double time = 0.0; time < 8.0; time += 0.01) {
            const double phase = trajectory.phase(0, time);
            if (time <= begin) {
                CHECK(trajectory.duty(0, time) == way.duty);
                for (std::size_t leg = 0; leg < legs; ++leg)
                    CHECK(own_cycle(trajectory, leg, time) == Approx(phase + way.phases[leg]));
            } else if (time > over + 0.1) {
                CHECK(trajectory.duty(0, time) == Approx(trot.duty));
                // To each other, legs have the gait's phases.
                for (std::size_t leg = 1; leg < legs; ++leg)
                    CHECK(apart(own_cycle(trajectory, leg, time) - own_cycle(trajectory, 0, time),
                                trot.phases[leg] - trot.phases[0]) < 1e-9);
            }
        }
        // Half-way of the transition legs have gone half of theirs, and the duty too.
        const double half = trajectory.phase(0, begin) + 0.5 * transition;
        for (std::size_t leg = 0; leg < legs; ++leg) {
            const auto own = [&](double phase) {
                return own_cycle(trajectory, leg, trajectory.time_at(0, phase)) - phase;
            };
            const double whole = own(half + transition) - way.phases[leg];
            CHECK(std::abs(whole) <= 0.5);
            CHECK(own(half) == Approx(way.phases[leg] + 0.5 * whole).margin(0.03));
        }
    }
}

TEST_CASE("the phase is the exact sum of the cadence by each sample's duty, stride and speed",
          "[gait change]") {
    Way way = way_with(Gait::trot, {change_to(Gait::gallop), change_to(Gait::walk, 120)});
    for (std::size_t i = 0; i < way.times.size(); ++i) {
        way.strides.push_back(0.4 + 0.3 * std::sin(0.05 * static_cast<double>(i)));
        way.cadences.push_back(0.5 + 0.01 * static_cast<double>(i));
    }
    const BodyTrajectory trajectory(way);
    double phase = 0.0;
    for (std::size_t i = 0; i + 1 < way.times.size(); ++i) {
        CHECK(trajectory.phase(0, way.times[i]) == Approx(phase).epsilon(1e-12));
        const double duty = trajectory.duty(0, way.times[i]);
        phase += (way.times[i + 1] - way.times[i]) * std::max(way.cadences[i], duty * speed / way.strides[i]);
    }
    // After the last sample the cadence is the last one.
    CHECK(trajectory.phase(0, 10.0) - trajectory.phase(0, 9.0) == Approx(way.cadences.back()));
}

TEST_CASE("cycles of legs rise, and times are their inverse", "[gait change]") {
    Random random(4);
    std::vector<GaitChange> changes;
    for (const std::size_t sample : {10, 14, 40, 41, 90, 150}) {
        GaitChange change{sample, {}, random.between(0.2, 0.8)};
        for (std::size_t leg = 0; leg < legs; ++leg) change.phases.push_back(random.between(-3.0, 3.0));
        changes.push_back(change);
    }
    const BodyTrajectory trajectory(way_with(Gait::pace, changes));
    for (std::size_t leg = 0; leg < legs; ++leg) {
        double before = -std::numeric_limits<double>::infinity();
        for (double time = -1.0; time < 10.0; time += 0.007) {
            const double cycles = trajectory.cycles(0, leg, time);
            CHECK(cycles > before);
            before = cycles;
            CHECK(trajectory.time_after(0, leg, cycles) == Approx(time).margin(1e-9));
        }
    }
}

TEST_CASE("while legs go over to another gait, feet that stand do not slide", "[gait change]") {
    const Ground level = plane();
    const Walker walker(way_with(Gait::walk, {change_to(Gait::gallop), change_to(Gait::pace, 110)}), {},
                        &level);
    for (std::size_t leg = 0; leg < legs; ++leg) {
        const std::span<const Footstep> steps = walker.steps(leg);
        REQUIRE(steps.size() > 6);
        for (std::size_t i = 1; i < steps.size(); ++i) {
            CHECK(steps[i].lift >= steps[i - 1].touch);
            CHECK(steps[i].touch > steps[i].lift);
            CHECK(steps[i].start == steps[i - 1].end);
            for (int part = 0; part <= 10; ++part) {
                const double time = steps[i - 1].touch + 0.1 * part * (steps[i].lift - steps[i - 1].touch);
                CHECK(walker.foot(leg, time).position == steps[i - 1].end);
            }
        }
    }
}

TEST_CASE("a change to the gait that there is changes nothing", "[gait change]") {
    const Ground level = plane();
    const Walker plain(way_with(Gait::trot, {}), {}, &level);
    const Walker same(way_with(Gait::trot, {change_to(Gait::trot)}), {}, &level);
    for (std::size_t leg = 0; leg < legs; ++leg)
        for (double time = 0.0; time < 9.0; time += 0.05)
            CHECK(glm::distance(plain.foot(leg, time).position, same.foot(leg, time).position) < 1e-9);
}

TEST_CASE("steps have the stride of when they lift", "[gait change]") {
    Way way = way_with(Gait::trot, {});
    for (std::size_t i = 0; i < way.times.size(); ++i) way.strides.push_back(i < 96 ? 0.6 : 0.3);
    const Ground level = plane();
    const Walker walker(way, {}, &level);
    for (const Footstep& step : walker.steps(0)) {
        // A trot's duty is a half: a step is two strides long.
        const double length = glm::distance(step.start, step.end);
        if (step.lift > 0.5 && step.touch < 3.5) CHECK(length == Approx(1.2).epsilon(1e-9));
        if (step.lift > 5.0 && step.touch < 7.5) CHECK(length == Approx(0.6).epsilon(1e-9));
    }
}

TEST_CASE("natural strides are those of Alexander at any speed and height", "[gait change]") {
    for (const double height : {1e-3, 0.4, 0.9, 12.0, 1e5}) {
        for (const double speed : {0.0, 1e-3, 0.3, 1.4, 7.0, 300.0}) {
            const double froude = std::max(1e-3, speed * speed / (9.81 * height));
            CHECK(natural_stride(speed, height) ==
                  Approx(2.3 * height * std::pow(froude, 0.3)).epsilon(1e-12));
        }
    }
    // Solved for the speed: v = 0.25 g^0.5 l^1.67 h^-1.17.
    const double length = natural_stride(1.4, 0.9);
    CHECK(0.25 * std::sqrt(9.81) * std::pow(length, 1.67) * std::pow(0.9, -1.17) ==
          Approx(1.4).epsilon(0.02));
    CHECK_THROWS_WITH(natural_stride(-1.0, 1.0), Catch::StartsWith("speed"));
    CHECK_THROWS_WITH(natural_stride(1.0, std::nan("")), Catch::StartsWith("hip_height"));
}

TEST_CASE("a body with a height goes by natural strides", "[gait change]") {
    Way way = way_with(Gait::trot, {});
    way.hip_height = 0.9;
    way.cadence = 0.1;
    const BodyTrajectory trajectory(way);
    const double length = natural_stride(speed, 0.9);
    CHECK(trajectory.phase(0, 5.0) == Approx(5.0 * speed / length));
    CHECK(trajectory.stride(0, 5.0) == Approx(0.5 * length));
    const Ground level = plane();
    const Walker walker(way, {}, &level);
    for (const Footstep& step : walker.steps(0))
        if (step.lift > 0.5 && step.touch < 7.5)
            CHECK(glm::distance(step.start, step.end) == Approx(length).epsilon(1e-9));
    // A body that rests has the slowest cadence.
    way.poses.assign(way.poses.size(), glm::dmat4(1.0));
    CHECK(BodyTrajectory(way).phase(0, 5.0) == Approx(0.5));
}

TEST_CASE("with a natural stride it is the height of the hips that says what a jump is", "[trajectory]") {
    for (const double stride : {0.5, 0.05}) {
        for (const double hip_height : {1.0, 0.01}) {
            // 6 strides of the smallest a second, as a runner of its size.
            const auto runs = [&](double time) { return moved({0.0, 6.0 * hip_height * time, 0.0}); };
            Way way = way_along(4.0, runs);
            way.stride = stride;
            way.hip_height = hip_height;
            CHECK(BodyTrajectory(way).stretch_count() == 1);
            const double most = 4.0 * way.duty * 2.3 * hip_height;
            for (const auto& [by, stretches] : {std::pair(0.9, 1), std::pair(1.1, 2)}) {
                Way jumps = way;
                for (std::size_t i = 50; i < jumps.poses.size(); ++i) jumps.poses[i][3].x += by * most;
                CHECK(BodyTrajectory(jumps).stretch_count() == static_cast<std::size_t>(stretches));
                jumps.jump = 100.0;
                CHECK(BodyTrajectory(jumps).stretch_count() == 1);
            }
        }
    }
}

TEST_CASE("a stretch after a jump begins in its gait", "[gait change]") {
    Way way = way_with(Gait::walk, {change_to(Gait::trot)});
    way.resets = {changed + 3};
    const BodyTrajectory trajectory(way);
    const double begin = way.times[changed + 3];
    for (std::size_t leg = 0; leg < legs; ++leg) {
        CHECK(trajectory.first_phase(1, leg) == change_to(Gait::trot).phases[leg]);
        CHECK(trajectory.cycles(1, leg, begin) == 0.0);
    }
    CHECK(trajectory.duty(1, begin) == change_to(Gait::trot).duty);
}

TEST_CASE("invalid changes of a gait are refused by the argument's name", "[gait change]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [&](const char* name, const auto& spoil) {
        Way way = way_with(Gait::walk, {change_to(Gait::trot)});
        spoil(way);
        CHECK_THROWS_WITH(BodyTrajectory(way), Catch::StartsWith(name));
    };
    refused("changes", [](Way& way) { way.changes[0].phases.pop_back(); });
    refused("changes", [&](Way& way) { way.changes[0].phases[1] = nan; });
    refused("changes", [](Way& way) { way.changes[0].duty = 1.0; });
    refused("changes", [](Way& way) { way.changes[0].sample = way.times.size(); });
    refused("changes", [](Way& way) { way.changes.push_back(change_to(Gait::pace, 3)); });
    refused("transition", [](Way& way) { way.transition = 0.9; });
    refused("strides", [](Way& way) { way.strides = {1.0}; });
    refused("strides", [](Way& way) { way.strides.assign(way.times.size(), 0.0); });
    refused("cadences", [](Way& way) { way.cadences.assign(way.times.size(), 1e4); });
    refused("hip_height", [](Way& way) { way.hip_height = -1.0; });
    refused("duties", [&](Way& way) { way.duties.assign(way.times.size(), nan); });
}
