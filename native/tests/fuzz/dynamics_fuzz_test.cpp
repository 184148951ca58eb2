// Pendulums and second-order dynamics with numbers that nobody expects.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "extremes.hpp"
#include "motus/core/numeric.hpp"
#include "motus/dynamics/double_pendulum.hpp"
#include "motus/dynamics/spherical_pendulum.hpp"
#include "motus/dynamics/track.hpp"

using namespace motus;
using namespace motus::dynamics;
using namespace motus::test;

namespace {

[[nodiscard]] DoublePendulum pendulum_of(Dice& dice) {
    DoublePendulum pendulum{dice.number(0.1, 2.0), dice.number(0.1, 2.0),  dice.number(0.1, 2.0),
                            dice.number(0.1, 2.0), dice.number(0.0, 10.0), dice.number(0.0, 1.0)};
    if (dice.chance(0.2)) pendulum.most_velocity = dice.number(1.0, 9.0);
    return pendulum;
}

}  // namespace

TEST_CASE("if a state of a pendulum cannot be found, no output is written", "[fuzz]") {
    const std::vector<double> times{0.1, 0.2, 1e30};
    const DoublePendulumState untouched{7.0, 7.0, 7.0, 7.0};
    std::vector<DoublePendulumState> states(3, untouched);
    CHECK_THROWS_AS(double_pendulum({}, {1.0, 1.0}, times, states), std::invalid_argument);
    CHECK(states == std::vector<DoublePendulumState>(3, untouched));
    const PendulumState at_rest{7.0, 7.0};
    std::vector<PendulumState> found(3, at_rest);
    CHECK_THROWS_AS(single_pendulum({.damping = 0.1}, {1.0, 0.0}, times, found), std::invalid_argument);
    CHECK(found == std::vector<PendulumState>(3, at_rest));
    // Without gravity the angle grows beyond all numbers.
    const std::vector<double> far{0.1, 0.2, largest};
    CHECK_THROWS_AS(single_pendulum({.gravity = 0.0}, {1.0, 1e10}, far, found), std::invalid_argument);
    CHECK(found == std::vector<PendulumState>(3, at_rest));
}

TEST_CASE("pendulums of arbitrary numbers are refused or give finite results", "[fuzz]") {
    Dice dice(31, 0.06);
    for (int round = 0; round < 150; ++round) {
        std::vector<double> times = dice.numbers(2, 0.0, 0.5);
        const DoublePendulumState start{dice.number(), dice.number(), dice.number(), dice.number()};
        // Cases that take long, many steps of a fast motion, are left out.
        for (double& time : times)
            if (std::isfinite(time) && std::abs(time) > 1.0 && std::abs(time) < 1e15) time = 1.0;
        const DoublePendulum pendulum = pendulum_of(dice);
        const bool is_slow = !(std::abs(start.omega1) > 1e4) && !(std::abs(start.omega2) > 1e4);
        std::vector<DoublePendulumState> out(2);
        returns([&] {
            const double farthest = longest_time(pendulum, start);
            CHECK(farthest > 0.0);
            if (!is_slow) return;
            double_pendulum(pendulum, start, times, out);
            for (const DoublePendulumState& one : out)
                CHECK(are_finite(one.theta1, one.theta2, one.omega1, one.omega2));
        });
        returns([&] { (void)energy(pendulum, start); });
        const Pendulum single{dice.number(0.1, 2.0), dice.number(0.0, 10.0), dice.chance(0.5) ? 0.0 : 0.3};
        std::vector<PendulumState> found(2);
        returns([&] {
            single_pendulum(single, {start.theta1, std::clamp(start.omega1, -1e4, 1e4)}, times, found);
            for (const PendulumState& one : found) CHECK(are_finite(one.angle, one.velocity));
        });
        std::vector<SphericalState> directions(2);
        returns([&] {
            const SphericalStart all_ways{start.theta1, start.theta2, std::clamp(start.omega1, -1e4, 1e4),
                                          std::clamp(start.omega2, -1e4, 1e4)};
            spherical_pendulum(single, all_ways, times, directions);
            for (const SphericalState& one : directions)
                CHECK((is_finite(one.direction) && is_finite(one.velocity)));
        });
        returns([&] { (void)pendulum_period(single, {start.theta1, start.omega1}); });
        std::vector<double> accelerations(6);
        returns([&] { pivot_accelerations(dice.number(0.01, 1.0), dice.numbers(6), accelerations); });
    }
    CHECK(is_refused([] { (void)longest_time({}, {1e300, 0.0}); }, "theta1"));
    CHECK(is_refused([] { (void)energy({.mass1 = not_a_number}, {}); }, "mass1"));
}

TEST_CASE("filters of arbitrary numbers are refused or give finite results", "[fuzz]") {
    Dice dice(32, 0.25);
    for (int round = 0; round < 1500; ++round) {
        std::optional<SecondOrder> filter;
        returns([&] {
            switch (round % 4) {
                case 0:
                    filter = SecondOrder(dice.number(0.1, 9.0), dice.number(0.0, 2.0), dice.number());
                    break;
                case 1:
                    filter = SecondOrder::from_coefficients({dice.number(), dice.number(), dice.number()});
                    break;
                case 2:
                    filter = SecondOrder::from_mass_spring(dice.number(0.1, 2.0), dice.number(0.1, 9.0),
                                                           dice.number(0.0, 2.0));
                    break;
                default:
                    filter = SecondOrder::from_overshoot(dice.number(0.01, 0.9), dice.number(0.1, 2.0),
                                                         dice.number(0.0, 2.0), dice.number(0.001, 0.5));
            }
        });
        if (!filter) continue;
        const double time = dice.number(0.0, 5.0);
        (void)step_response(*filter, time);
        (void)overshoot(*filter);
        returns([&] { (void)settling_time(*filter, dice.number(0.001, 0.5)); });
        const bool was_made = returns([&] { (void)make_step(*filter, time); });
        CHECK(was_made == (time >= 0.0 && std::isfinite(time)));
    }
}

TEST_CASE("tracks of any numbers are refused, and those of ordinary ones finite at any time", "[fuzz]") {
    for (const double share : {0.0, 0.03}) {
        Dice dice(33, share), wild(34, 0.4);
        for (int round = 0; round < 400; ++round) {
            const std::size_t count = 1 + dice.below(5);
            const std::vector<double> times = dice.rising(count), inputs = dice.numbers(2 * count);
            const SecondOrder filter{dice.between(0.1, 5.0), dice.between(0.05, 2.0),
                                     dice.between(-2.0, 2.0)};
            const std::size_t reset_count = dice.below(2);
            const std::vector<std::size_t> resets(reset_count, dice.below(count + 1));
            const Start start = dice.chance(0.3) ? Start::loop : Start::at_rest;
            const double time = wild.number(-3.0, 9.0);
            std::vector<double> out(2), all(inputs.size());
            returns([&] {
                const Track track(filter, times, inputs, 2, resets, start);
                track.evaluate(time, out);
                if (share == 0.0) CHECK(are_finite(out));
                track.offset(time, out);
                if (share == 0.0) CHECK(are_finite(out));
            });
            returns([&] { second_order(filter, times, inputs, dice.below(3), all); });
            const std::vector<glm::dquat> turns = dice.quaternions(count);
            returns([&] {
                const RotationTrack track(filter, times, turns, resets, start);
                const glm::dquat found = track.evaluate(time);
                CHECK(glm::dot(found, found) == Approx(1.0));
            });
        }
    }
}
