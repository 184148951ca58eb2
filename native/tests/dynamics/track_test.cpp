#include "motus/dynamics/track.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "random.hpp"

using namespace motus::dynamics;
using motus::test::Random;

namespace {

struct Input {
    std::vector<double> times;
    std::vector<double> values;
};

Input random_input(Random& random, std::size_t samples, std::size_t dimensions) {
    Input input;
    double time = random.between(0.0, 1.0);
    for (std::size_t k = 0; k < samples; ++k) {
        input.times.push_back(time);
        time += random.between(0.01, 0.21);
        for (std::size_t i = 0; i < dimensions; ++i) input.values.push_back(random.between(-2.0, 2.0));
    }
    return input;
}

/// Output at the last sample by small steps of Runge and Kutta's method: the equation itself, not its
/// solution.
double integrated(const SecondOrder& filter, const Input& input) {
    const auto all = filter.coefficients();
    const double k1 = all.k1, k2 = all.k2, k3 = all.k3;
    double y = input.values[0];
    double v = 0.0;
    for (std::size_t k = 1; k < input.times.size(); ++k) {
        const double length = input.times[k] - input.times[k - 1];
        const double slope = (input.values[k] - input.values[k - 1]) / length;
        constexpr int steps = 400;
        const double h = length / steps;
        for (int i = 0; i < steps; ++i) {
            const auto force = [&](double time, double at, double speed) {
                return (input.values[k - 1] + slope * time + k3 * slope - at - k1 * speed) / k2;
            };
            const double t = h * i;
            const double a1 = force(t, y, v);
            const double a2 = force(t + h / 2, y + h / 2 * v, v + h / 2 * a1);
            const double a3 = force(t + h / 2, y + h / 2 * (v + h / 2 * a1), v + h / 2 * a2);
            const double a4 = force(t + h, y + h * (v + h / 2 * a2), v + h * a3);
            y += h * (v + h / 6 * (a1 + a2 + a3));
            v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
    }
    return y;
}

double at(const Track& track, double time) {
    double out = 0.0;
    track.evaluate(time, {&out, 1});
    return out;
}

glm::dquat about(const glm::dvec3& axis, double angle) {
    return glm::angleAxis(angle, glm::normalize(axis));
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat turn = glm::conjugate(a) * b;
    return 2.0 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

const std::array filters{SecondOrder(0.8, 0.0, 0.0), SecondOrder(2.0, 0.3, -1.5), SecondOrder(1.0, 1.0, 0.0),
                         SecondOrder(1.5, 0.6, 2.0), SecondOrder(3.0, 2.5, 1.0)};

}  // namespace

TEST_CASE("a track solves the equation", "[track]") {
    Random random(3);
    for (const SecondOrder& filter : filters) {
        const Input input = random_input(random, 12, 1);
        const Track track(filter, input.times, input.values, 1);
        CHECK(at(track, input.times.back()) == Approx(integrated(filter, input)).margin(1e-8));
    }
}

TEST_CASE("more samples of a linear input change nothing", "[track]") {
    // A broken line, and the same line with more samples, as a higher frame rate samples linear motion.
    Random random(4);
    for (const SecondOrder& filter : filters) {
        const Input coarse = random_input(random, 30, 1);
        Input fine;
        for (std::size_t k = 0; k < coarse.times.size(); ++k) {
            fine.times.push_back(coarse.times[k]);
            fine.values.push_back(coarse.values[k]);
            if (k + 1 == coarse.times.size()) break;
            for (const double share : {0.2, 0.55, 0.9}) {
                fine.times.push_back(std::lerp(coarse.times[k], coarse.times[k + 1], share));
                fine.values.push_back(std::lerp(coarse.values[k], coarse.values[k + 1], share));
            }
        }
        const Track one(filter, coarse.times, coarse.values, 1);
        const Track other(filter, fine.times, fine.values, 1);
        for (int i = 0; i <= 200; ++i) {
            const double time = std::lerp(coarse.times.front() - 0.1, coarse.times.back() + 2.0, i / 200.0);
            CHECK(at(one, time) == Approx(at(other, time)).margin(1e-12));
        }
    }
}

TEST_CASE("outputs at the samples are those of evaluate and of second_order", "[track]") {
    Random random(5);
    constexpr std::size_t dimensions = 11;
    Input input = random_input(random, 40, dimensions);
    // Equal steps, but for their rounding.
    for (std::size_t k = 0; k < input.times.size(); ++k) input.times[k] = static_cast<double>(k) / 24.0;
    for (const SecondOrder& filter : filters) {
        const Track track(filter, input.times, input.values, dimensions);
        std::vector<double> outputs(input.values.size());
        track.outputs(outputs);
        std::array<double, dimensions> row{};
        for (std::size_t k = 0; k < input.times.size(); ++k) {
            track.evaluate(input.times[k], row);
            CHECK(std::equal(row.begin(), row.end(),
                             outputs.begin() + static_cast<std::ptrdiff_t>(k * dimensions)));
        }
        std::vector<double> plain(input.values);
        second_order(filter, input.times, plain, dimensions, plain);
        CHECK(plain == outputs);
    }
}

TEST_CASE("a track's velocity is its derivative", "[track]") {
    Random random(6);
    const Input input = random_input(random, 20, 1);
    for (const SecondOrder& filter : filters) {
        const Track track(filter, input.times, input.values, 1);
        for (std::size_t k = 0; k + 1 < input.times.size(); ++k) {
            const double time = std::lerp(input.times[k], input.times[k + 1], 0.4);
            double out = 0.0;
            double velocity = 0.0;
            track.evaluate(time, {&out, 1}, {&velocity, 1});
            const double h = 1e-6;
            CHECK(velocity == Approx((at(track, time + h) - at(track, time - h)) / (2 * h)).margin(1e-6));
        }
    }
}

TEST_CASE("an output comes to rest on its input, and lags behind a steady one", "[track]") {
    const std::array times{0.0, 1.0};
    for (const SecondOrder& filter : filters) {
        if (filter.damping() == 0.0) continue;
        const Track rests(filter, times, std::array{1.0, 3.0}, 1);
        CHECK(at(rests, 200.0) == Approx(3.0).epsilon(1e-14));
        CHECK(at(rests, -5.0) == 1.0);
        // (k3 - k1) times the velocity: none at r = 2.
        const Track moves(filter, std::array{0.0, 100.0}, std::array{0.0, 200.0}, 1);
        const double lag = filter.coefficients().k3 - filter.coefficients().k1;
        CHECK(at(moves, 99.0) == Approx(198.0 + 2.0 * lag).epsilon(1e-12));
    }
}

TEST_CASE("a filtered track starts anew, at rest, after a teleport", "[track]") {
    const std::array times{0.0, 1.0, 2.0, 3.0};
    const std::array inputs{0.0, 1.0, 50.0, 51.0};
    const std::array<std::size_t, 1> resets{2};
    const SecondOrder filter(1.0, 0.4, 0.5);
    const Track track(filter, times, inputs, 1, resets);
    CHECK(at(track, 2.0) == 50.0);
    const Track first(filter, std::array{0.0, 1.0}, std::array{0.0, 1.0}, 1);
    CHECK(at(track, 1.7) == at(first, 1.7));
    const Track second(filter, std::array{2.0, 3.0}, std::array{50.0, 51.0}, 1);
    CHECK(at(track, 2.6) == Approx(at(second, 2.6)).epsilon(1e-15));
}

TEST_CASE("a loop has no seam, and goes on for ever", "[track]") {
    Random random(7);
    for (const SecondOrder& filter : filters) {
        Input input = random_input(random, 25, 2);
        const std::size_t last = 2 * (input.times.size() - 1);
        input.values[last] = input.values[0];  // closed in one dimension, going on in the other
        const double drift = input.values[last + 1] - input.values[1];
        const double cycle = input.times.back() - input.times.front();
        const Track loop(filter, input.times, input.values, 2, {}, Start::loop);
        std::array<double, 2> here{}, later{}, here_velocity{}, later_velocity{};
        for (const double time : {input.times.front(), 0.3, 0.77, 1.9}) {
            loop.evaluate(time, here, here_velocity);
            for (const double cycles : {-2.0, 1.0, 5.0}) {
                loop.evaluate(time + cycles * cycle, later, later_velocity);
                CHECK(later[0] == Approx(here[0]).margin(1e-11));
                CHECK(later[1] == Approx(here[1] + cycles * drift).margin(1e-11));
                CHECK(later_velocity[0] == Approx(here_velocity[0]).margin(1e-9));
            }
        }
        // Before and after the seam.
        loop.evaluate(input.times.back() - 1e-9, here, here_velocity);
        loop.evaluate(input.times.back() + 1e-9, later, later_velocity);
        CHECK(std::abs(later[0] - here[0]) < 1e-6);
        CHECK(std::abs(later_velocity[0] - here_velocity[0]) < 1e-4);
        if (filter.damping() == 0.0) continue;
        // The loop is the limit of an endless run-up.
        Input many;
        for (int n = 0; n < 60; ++n) {
            for (std::size_t k = 0; k + 1 < input.times.size(); ++k) {
                many.times.push_back(input.times[k] + n * cycle);
                many.values.push_back(input.values[2 * k]);
            }
        }
        const Track run_up(filter, many.times, many.values, 1);
        loop.evaluate(many.times.back(), here);
        CHECK(at(run_up, many.times.back()) == Approx(here[0]).margin(1e-9));
    }
    const std::array times{0.0, 1.0, 2.0};
    CHECK_THROWS_AS(Track(SecondOrder(0.5, 0.0, 0.0), times, std::array{0.0, 1.0, 0.0}, 1, {}, Start::loop),
                    std::invalid_argument);
}

TEST_CASE("rotations about one axis are the filtered angle", "[track]") {
    Random random(8);
    const glm::dvec3 axis(0.3, -0.5, 0.8);
    for (const SecondOrder& filter : filters) {
        Input input = random_input(random, 40, 1);
        for (double& value : input.values) value *= 0.7;  // less than half a turn apart
        std::vector<glm::dquat> rotations;
        for (const double angle : input.values)
            rotations.push_back(about(axis, angle) * (random.chance(0.5) ? 1.0 : -1.0));
        for (const Start start : {Start::at_rest, Start::loop}) {
            if (start == Start::loop) {
                input.values.back() = input.values.front();
                rotations.back() = -rotations.front();
            }
            const Track angles(filter, input.times, input.values, 1, {}, start);
            const RotationTrack track(filter, input.times, rotations, {}, start);
            for (int i = 0; i <= 100; ++i) {
                const double time = std::lerp(input.times.front(), input.times.back() + 1.0, i / 100.0);
                CHECK(angle_between(track.evaluate(time), about(axis, at(angles, time))) < 1e-11);
            }
        }
    }
}

TEST_CASE("a loop of short cycles is finite at the farthest times", "[track]") {
    constexpr double largest = std::numeric_limits<double>::max();
    const std::array times{1.0, 1.3, 1.5};
    const std::array inputs{0.0, 1.0, 0.5, 2.0, 0.0, 3.0};  // closed in one dimension, going on in the other
    const Track loop(SecondOrder(1.0, 0.5, 0.0), times, inputs, 2, {}, Start::loop);
    for (const double time : {largest, -largest, 1e308, 1e17}) {
        std::array<double, 2> found{}, velocity{};
        loop.evaluate(time, found, velocity);
        CHECK(std::abs(found[0]) < 10.0);
        CHECK(std::isfinite(found[1]));
        CHECK(std::signbit(found[1]) == std::signbit(time));
        CHECK((std::isfinite(velocity[0]) && std::isfinite(velocity[1])));
    }
}

TEST_CASE("rotations know no first axis, and loop without a seam", "[track]") {
    Random random(9);
    const glm::dquat turned = about({1.0, 2.0, -0.5}, 2.0);
    const SecondOrder filter(1.2, 0.35, 1.0);
    std::vector<double> times;
    std::vector<glm::dquat> rotations, moved;
    for (int k = 0; k < 30; ++k) {
        times.push_back(0.1 * k);
        const double phase = 2.0 * std::numbers::pi * k / 29.0;
        rotations.push_back(
            about({std::cos(phase), std::sin(phase), 0.5}, 1.0 + 0.6 * std::sin(2.0 * phase)));
        moved.push_back(turned * rotations.back());
    }
    const double cycle = times.back();
    const RotationTrack track(filter, times, rotations);
    const RotationTrack from_elsewhere(filter, times, moved);
    const RotationTrack loop(filter, times, rotations, {}, Start::loop);
    for (int i = 0; i <= 60; ++i) {
        const double time = 0.05 * i;
        CHECK(angle_between(turned * track.evaluate(time), from_elsewhere.evaluate(time)) < 1e-12);
        CHECK(angle_between(loop.evaluate(time), loop.evaluate(time + 3.0 * cycle)) < 1e-11);
    }
    CHECK(angle_between(loop.evaluate(cycle - 1e-9), loop.evaluate(cycle + 1e-9)) < 1e-7);
    // Played backwards from a rest the output ends on the input.
    CHECK(angle_between(track.evaluate(cycle + 30.0), rotations.back()) < 1e-12);
    const std::array<std::size_t, 1> resets{10};
    const RotationTrack teleported(filter, times, rotations, resets);
    CHECK(angle_between(teleported.evaluate(times[10]), rotations[10]) < 1e-15);
    const RotationTrack before(filter, std::span(times).first(10), std::span(rotations).first(10));
    CHECK(angle_between(teleported.evaluate(0.98), before.evaluate(0.98)) < 1e-15);
}

TEST_CASE("invalid samples of a track are refused by the argument's name", "[track]") {
    const SecondOrder filter(1.0, 1.0, 0.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    using Catch::Matchers::StartsWith;
    const std::array times{0.0, 1.0};
    const std::array inputs{0.0, 1.0};
    CHECK_THROWS_WITH(Track(filter, {}, {}, 1), StartsWith("times"));
    CHECK_THROWS_WITH(Track(filter, std::array{1.0, 1.0}, inputs, 1), StartsWith("times"));
    CHECK_THROWS_WITH(Track(filter, std::array{0.0, nan}, inputs, 1), StartsWith("times"));
    CHECK_THROWS_WITH(Track(filter, times, inputs, 0), StartsWith("dimensions"));
    CHECK_THROWS_WITH(Track(filter, times, inputs, 2), StartsWith("inputs"));
    CHECK_THROWS_WITH(Track(filter, times, std::array{0.0, nan}, 1), StartsWith("inputs"));
    const std::array<std::size_t, 1> beyond{2};
    CHECK_THROWS_WITH(Track(filter, times, inputs, 1, beyond), StartsWith("resets"));
    const std::array<std::size_t, 1> inside{1};
    CHECK_THROWS_WITH(Track(filter, times, inputs, 1, inside, Start::loop), StartsWith("resets"));
    const Track track(filter, times, inputs, 1);
    double out = 0.0;
    CHECK_THROWS_WITH(track.evaluate(nan, {&out, 1}), StartsWith("time"));
    CHECK_THROWS_WITH(track.evaluate(0.0, {}), StartsWith("out"));
    const std::array rotations{glm::dquat(1.0, 0.0, 0.0, 0.0), glm::dquat(2.0, 0.0, 0.0, 0.0)};
    CHECK_THROWS_WITH(RotationTrack(filter, times, rotations), StartsWith("inputs"));
}

TEST_CASE("a track that was moved from refuses", "[track]") {
    const std::vector<double> times{0.0, 1.0}, inputs{0.0, 1.0};
    Track track(SecondOrder(1.0, 0.5, 0.0), times, inputs, 1);
    const Track other = std::move(track);
    double value = 0.0;
    other.evaluate(0.5, {&value, 1});
    CHECK(value > 0.0);
    CHECK_THROWS_AS(track.evaluate(0.5, {&value, 1}), std::invalid_argument);
    const std::vector<glm::dquat> turns(2, glm::dquat(1.0, 0.0, 0.0, 0.0));
    RotationTrack turning(SecondOrder(1.0, 0.5, 0.0), times, turns);
    const RotationTrack another = std::move(turning);
    CHECK(another.evaluate(0.5) == turns[0]);
    CHECK_THROWS_AS(turning.evaluate(0.5), std::invalid_argument);
    CHECK_THROWS_AS(turning.offset(0.5), std::invalid_argument);
}

TEST_CASE("offsets are what outputs differ from their inputs by", "[track]") {
    Random random(11);
    const Input input = random_input(random, 20, 3);
    std::vector<glm::dquat> turns;
    for (std::size_t k = 0; k < input.times.size(); ++k)
        turns.push_back(about({1.0, 2.0, 3.0}, input.values[3 * k]));
    for (const SecondOrder& filter : filters) {
        const Track track(filter, input.times, input.values, 3);
        const RotationTrack turning(filter, input.times, turns);
        std::array<double, 3> output{}, offset{};
        for (std::size_t k = 0; k < input.times.size(); ++k) {
            track.evaluate(input.times[k], output);
            track.offset(input.times[k], offset);
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(output[i] - offset[i] == Approx(input.values[3 * k + i]).margin(1e-13));
            const glm::dquat turned = turns[k] * turning.offset(input.times[k]);
            CHECK(angle_between(turned, turning.evaluate(input.times[k])) < 1e-13);
        }
        const Track rests(filter, input.times, std::vector<double>(input.times.size(), 0.3), 1);
        const std::vector<glm::dquat> still(input.times.size(), about({0.0, 1.0, 0.0}, 0.3));
        rests.offset(1.234, {offset.data(), 1});
        CHECK(offset[0] == 0.0);
        CHECK(RotationTrack(filter, input.times, still).offset(1.234) == glm::dquat(1.0, 0.0, 0.0, 0.0));
    }
}
