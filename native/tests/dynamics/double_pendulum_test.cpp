#include "motus/dynamics/double_pendulum.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <vector>

#include "data/pendulum.hpp"
#include "motion_table.hpp"
#include "random.hpp"

using namespace motus::dynamics;
using motus::test::Random;

namespace {

constexpr double pi = std::numbers::pi;

DoublePendulumState at(const DoublePendulum& pendulum, const DoublePendulumState& start, double time) {
    DoublePendulumState out;
    double_pendulum(pendulum, start, {&time, 1}, {&out, 1});
    return out;
}

/// Angular accelerations: the equations as textbooks write them. x, z: acceleration of the pivot.
std::array<double, 2> accelerations(const DoublePendulum& p, const DoublePendulumState& s, double x = 0.0,
                                    double z = 0.0) {
    // Gravity of any direction: (x, g + z) turned to the vertical.
    const double g = std::hypot(x, p.gravity + z);
    const double lean = std::atan2(x, p.gravity + z);
    const double t1 = s.theta1 + lean, t2 = s.theta2 + lean;
    const auto [m1, m2, l1, l2] = std::array{p.mass1, p.mass2, p.length1, p.length2};
    const double d = 2.0 * m1 + m2 - m2 * std::cos(2.0 * t1 - 2.0 * t2);
    const double a1 = (-g * (2.0 * m1 + m2) * std::sin(t1) - m2 * g * std::sin(t1 - 2.0 * t2) -
                       2.0 * std::sin(t1 - t2) * m2 *
                           (s.omega2 * s.omega2 * l2 + s.omega1 * s.omega1 * l1 * std::cos(t1 - t2))) /
                      (l1 * d);
    const double a2 = (2.0 * std::sin(t1 - t2) *
                       (s.omega1 * s.omega1 * l1 * (m1 + m2) + g * (m1 + m2) * std::cos(t1) +
                        s.omega2 * s.omega2 * l2 * m2 * std::cos(t1 - t2))) /
                      (l2 * d);
    return {a1 - p.damping * s.omega1, a2 - p.damping * s.omega2};
}

/// Their solution by small steps of Runge and Kutta's method.
template <class Pivot>
DoublePendulumState integrated(const DoublePendulum& p, const DoublePendulumState& start, double time,
                               const Pivot& pivot) {
    using State = std::array<double, 4>;
    const auto slope = [&](double t, const State& y) -> State {
        const auto [x, z] = pivot(t);
        const auto [a1, a2] = accelerations(p, {y[0], y[1], y[2], y[3]}, x, z);
        return {y[2], y[3], a1, a2};
    };
    const auto moved = [](const State& y, const State& by, double h) -> State {
        return {y[0] + h * by[0], y[1] + h * by[1], y[2] + h * by[2], y[3] + h * by[3]};
    };
    State y{start.theta1, start.theta2, start.omega1, start.omega2};
    const int steps = 40000;
    const double h = time / steps;
    for (int i = 0; i < steps; ++i) {
        const double t = h * i;
        const State k1 = slope(t, y);
        const State k2 = slope(t + h / 2, moved(y, k1, h / 2));
        const State k3 = slope(t + h / 2, moved(y, k2, h / 2));
        const State k4 = slope(t + h, moved(y, k3, h));
        for (std::size_t d = 0; d < 4; ++d) y[d] += h / 6 * (k1[d] + 2 * k2[d] + 2 * k3[d] + k4[d]);
    }
    return {y[0], y[1], y[2], y[3]};
}

std::array<double, 2> still(double /*time*/) {
    return {0.0, 0.0};
}

double largest_difference(const DoublePendulumState& a, const DoublePendulumState& b) {
    return std::max({std::abs(a.theta1 - b.theta1), std::abs(a.theta2 - b.theta2),
                     std::abs(a.omega1 - b.omega1), std::abs(a.omega2 - b.omega2)});
}

const DoublePendulumState high{2.0 * pi / 3.0, 2.0 * pi / 3.0, 0.0, 0.0};

}  // namespace

TEST_CASE("the double pendulum is that of the reference", "[double_pendulum]") {
    for (const auto& known : motus::reference::double_pendulum_states) {
        const DoublePendulumState found = at({}, high, known.time);
        CHECK(largest_difference(found, {known.theta1, known.theta2, known.omega1, known.omega2}) <
              known.tolerance);
    }
}

TEST_CASE("the double pendulum keeps its energy", "[double_pendulum]") {
    const double range = 44.145;  // J above hanging at rest
    for (const double time : {0.4321, 7.7, 31.3, 60.0, -60.0})
        CHECK(std::abs(energy({}, at({}, high, time)) - 14.715) < 1e-10 * range);
    // Whatever the masses and lengths.
    for (const DoublePendulum pendulum :
         {DoublePendulum{1.0, 1e-3, 1.0, 1.0}, DoublePendulum{1e-3, 1.0, 1.0, 1.0},
          DoublePendulum{1.0, 1.0, 1.0, 0.05}, DoublePendulum{1.0, 1.0, 0.05, 1.0},
          DoublePendulum{3.0, 1.0, 100.0, 70.0}, DoublePendulum{1.0, 2.0, 1.0, 1.0, 0.0}}) {
        const DoublePendulumState start{2.0, -2.5, 1.0, 3.0};
        const double scale = std::abs(energy(pendulum, start)) + (pendulum.mass1 + pendulum.mass2) *
                                                                     pendulum.gravity *
                                                                     (pendulum.length1 + pendulum.length2);
        CHECK(std::abs(energy(pendulum, at(pendulum, start, 20.0)) - energy(pendulum, start)) < 1e-9 * scale);
    }
}

TEST_CASE("the double pendulum solves the textbook's equations", "[double_pendulum]") {
    Random random(2);
    const auto draw = [&] { return random.between(0.0, 1.0); };
    for (int i = 0; i < 20; ++i) {
        const DoublePendulum pendulum{0.2 + draw(), 0.2 + draw(),  0.3 + draw(),
                                      0.3 + draw(), 15.0 * draw(), i % 2 == 0 ? 0.0 : 0.5 * draw()};
        const DoublePendulumState start{6.0 * draw() - 3.0, 6.0 * draw() - 3.0, 6.0 * draw() - 3.0,
                                        6.0 * draw() - 3.0};
        const double time = i % 3 == 0 ? -1.2 : 1.9;
        CHECK(largest_difference(at(pendulum, start, time), integrated(pendulum, start, time, still)) < 1e-7);
    }
}

TEST_CASE("each state of a double pendulum depends on its own time alone", "[double_pendulum]") {
    const DoublePendulum pendulum{1.0, 1.0, 0.9, 0.8};
    std::vector<double> times;
    for (int frame = 0; frame < 300; ++frame) times.push_back(frame / 24.0);
    std::vector<DoublePendulumState> playback(times.size());
    double_pendulum(pendulum, high, times, playback);
    // Another pendulum, by a hair, whose table has to be made up to there at once.
    for (const std::size_t frame : {299U, 7U, 123U})
        CHECK(at(pendulum, high, times[frame]) == playback[frame]);
    const DoublePendulum same{2.0, 2.0, 0.9, 0.8};  // the same motion, in a table of its own until asked
    CHECK(largest_difference(at(same, high, times[40]), playback[40]) == 0.0);
}

TEST_CASE("many double pendulums are the same as one by one", "[double_pendulum]") {
    const DoublePendulum pendulum{1.0, 0.7, 1.0, 0.9};
    std::vector<DoublePendulumState> fan;
    for (int i = 0; i < 17; ++i) fan.push_back({2.0, 2.2 + i * 0.5 * pi / 180.0, 0.0, 0.0});
    fan.push_back(fan.front());  // one twice
    std::vector<DoublePendulumState> together(fan.size());
    double_pendulums(pendulum, fan, 13.37, together);
    DoublePendulum apart = pendulum;
    apart.mass1 *= 2.0;
    apart.mass2 *= 2.0;
    for (std::size_t i = 0; i < fan.size(); ++i) CHECK(together[i] == at(apart, fan[i], 13.37));
    // Chaos: neighbours are far apart after a while.
    CHECK(std::abs(together[0].theta2 - together[1].theta2) > 0.1);
}

TEST_CASE("many double pendulums on a moved pivot are the same as one by one", "[double_pendulum]") {
    std::vector<double> samples;
    for (int k = 0; k < 120; ++k) samples.push_back(6.0 * std::sin(0.3 * k));
    const PivotMotion pivot{1.0 / 25.0, samples};
    std::vector<DoublePendulumState> fan;
    for (int i = 0; i < 9; ++i) fan.push_back({1.0, 1.2 + 0.01 * i, 0.0, 0.0});
    std::vector<DoublePendulumState> together(fan.size());
    double_pendulums({}, fan, pivot, 1.91, together);
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const double time = 1.91;
        DoublePendulumState alone;
        double_pendulum({}, fan[i], pivot, {&time, 1}, {&alone, 1});
        CHECK(together[i] == alone);
    }
    CHECK_THROWS_AS(double_pendulums({}, fan, pivot, -1.0, together), std::invalid_argument);
}

TEST_CASE("double pendulums whose tables would not fit into the cache together are refused",
          "[double_pendulum]") {
    std::vector<DoublePendulumState> fan(500);
    for (std::size_t i = 0; i < fan.size(); ++i)
        fan[i] = {2.0, 2.0 + 0.01 * static_cast<double>(i), 0.0, 0.0};
    std::vector<DoublePendulumState> out(fan.size());
    // Each of them may be asked for at that time, but their tables would push each other out at every frame.
    CHECK_THROWS_WITH(double_pendulums({}, fan, 1500.0, out), Catch::Matchers::StartsWith("time: "));
    CHECK_THROWS_WITH(double_pendulums({}, fan, -1500.0, out), Catch::Matchers::StartsWith("time: "));
    const std::vector<DoublePendulumState> few(fan.begin(), fan.begin() + 2);
    double_pendulums({}, few, 1500.0, std::span(out).first(2));
    CHECK(out[1] == at({}, few[1], 1500.0));
    fan.resize(5000);
    out.resize(5000);
    CHECK_THROWS_WITH(double_pendulums({}, fan, 1.0, out), Catch::Matchers::StartsWith("starts: "));

    SECTION("as the sum of what each table takes") {
        MotionSettings<DoubleSystem> settings;
        settings.start = {2.0, 2.0, 0.0, 0.0};
        settings.interval = 0.125;
        const MotionTable<DoubleSystem> table(settings);
        for (const double time : {0.0, 1.0, 20.0, 100.0, 1000.0}) {
            const std::size_t most = table.bytes_until(time);
            static_cast<void>(table.at(time));
            CHECK(table.bytes() <= most);
            CHECK(most < table.bytes() / 4 * 5 + 4096);
        }
    }
}

TEST_CASE("threads that ask for one pendulum get one answer", "[double_pendulum]") {
    const DoublePendulum pendulum{1.0, 1.0, 1.0, 0.77};
    std::array<std::vector<DoublePendulumState>, 4> found;
    std::vector<double> times;
    for (int i = 0; i < 200; ++i) times.push_back(i * 0.11);
    std::vector<std::thread> threads;
    for (auto& states : found) {
        threads.emplace_back([&] {
            states.resize(times.size());
            double_pendulum(pendulum, high, times, states);
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& states : found) CHECK(states == found[0]);
}

TEST_CASE("the limits of a double pendulum's velocity and acceleration hold, and wide limits change nothing",
          "[double_pendulum]") {
    DoublePendulum wide;
    wide.most_acceleration = 1e6;
    CHECK(largest_difference(at(wide, high, 3.0), at({}, high, 3.0)) < 1e-6);
    DoublePendulum narrow;
    narrow.most_velocity = 2.0;
    narrow.most_acceleration = 15.0;
    DoublePendulumState before = high;
    double fastest = 0.0;
    for (int i = 1; i < 600; ++i) {
        const double step = 0.01;
        const DoublePendulumState now = at(narrow, high, i * step);
        for (const double velocity : {now.omega1, now.omega2}) CHECK(std::abs(velocity) <= 2.0);
        CHECK(std::abs(now.omega1 - before.omega1) <= 15.0 * step * (1.0 + 1e-9));
        CHECK(std::abs(now.omega2 - before.omega2) <= 15.0 * step * (1.0 + 1e-9));
        fastest = std::max(fastest, std::abs(now.omega2));
        before = now;
    }
    CHECK(fastest == 2.0);
}

TEST_CASE("a double pendulum within wide limits moves as one without limits, whatever drives and damps it",
          "[double_pendulum]") {
    const auto limited = [](DoublePendulum pendulum) {
        pendulum.most_acceleration = 1e12;
        pendulum.most_velocity = 1e9;
        return pendulum;
    };
    const DoublePendulumState start{1.5, 2.0, 0.0, 0.0};
    const auto angles_apart = [](const DoublePendulumState& a, const DoublePendulumState& b) {
        return std::max(std::abs(a.theta1 - b.theta1), std::abs(a.theta2 - b.theta2));
    };
    SECTION("damping, up to what takes all velocity within a thousandth of a step") {
        for (const double damping : {1.0, 100.0, 500.0, 2000.0, 1e4}) {
            DoublePendulum pendulum;
            pendulum.damping = damping;
            for (const double time : {0.5, 1.3})
                CHECK(angles_apart(at(limited(pendulum), start, time), at(pendulum, start, time)) < 1e-7);
        }
    }
    SECTION("masses and lengths") {
        for (const double mass : {1e-3, 10.0, 1000.0})
            for (const double length : {0.1, 1.0})
                for (const double time : {0.5, 2.0}) {
                    const DoublePendulum pendulum{1.0, mass, 1.0, length};
                    CHECK(angles_apart(at(limited(pendulum), start, time), at(pendulum, start, time)) < 5e-6);
                }
    }
    SECTION("pivots, up to a hundred times the earth's acceleration") {
        for (const double size : {10.0, 100.0, 1000.0}) {
            std::vector<double> samples;
            for (int k = 0; k < 60; ++k) {
                samples.push_back(size * std::sin(1.7 * k));
                samples.push_back(size * std::cos(0.9 * k));
            }
            const PivotMotion pivot{1.0 / 24.0, samples};
            DoublePendulum pendulum;
            pendulum.damping = 0.5;
            for (const double time : {0.31, 0.5}) {
                DoublePendulumState found, wanted;
                double_pendulum(limited(pendulum), {0.5, 0.2, 0.0, 0.0}, pivot, {&time, 1}, {&found, 1});
                double_pendulum(pendulum, {0.5, 0.2, 0.0, 0.0}, pivot, {&time, 1}, {&wanted, 1});
                CHECK(angles_apart(found, wanted) < 2e-6);
            }
        }
    }
}

TEST_CASE("a double pendulum at its limits moves as small steps do", "[double_pendulum]") {
    struct Limits {
        double acceleration = 0.0, velocity = 0.0, damping = 0.0;
    };
    for (const Limits& limits :
         {Limits{15.0, 2.0, 0.0}, Limits{1e6, 1.0, 0.3}, Limits{4.0, 1e6, 0.0}, Limits{16.0, 8.0, 0.5}}) {
        DoublePendulum pendulum;
        pendulum.damping = limits.damping;
        pendulum.most_acceleration = limits.acceleration;
        pendulum.most_velocity = limits.velocity;
        // Euler's symmetric steps: what is right at the limits needs no order, but steps that are small.
        constexpr int steps = 100'000;
        constexpr double time = 1.5, h = time / steps;
        DoublePendulumState s{2.0, 1.5, 0.0, 0.0};
        const auto moved = [&](const DoublePendulumState& from, const DoublePendulumState& by) {
            const auto [a1, a2] = accelerations(pendulum, by);
            const double most = limits.acceleration, fastest = limits.velocity;
            DoublePendulumState next = from;
            next.theta1 += h * by.omega1;
            next.theta2 += h * by.omega2;
            next.omega1 = std::clamp(from.omega1 + h * std::clamp(a1, -most, most), -fastest, fastest);
            next.omega2 = std::clamp(from.omega2 + h * std::clamp(a2, -most, most), -fastest, fastest);
            return next;
        };
        for (int i = 0; i < steps; ++i) {
            const DoublePendulumState end = moved(s, s);
            s = moved(s, {0.5 * (s.theta1 + end.theta1), 0.5 * (s.theta2 + end.theta2),
                          0.5 * (s.omega1 + end.omega1), 0.5 * (s.omega2 + end.omega2)});
        }
        CHECK(largest_difference(at(pendulum, {2.0, 1.5, 0.0, 0.0}, time), s) < 1e-4);
    }
}

TEST_CASE("a double pendulum on a moved pivot solves its equations", "[double_pendulum]") {
    const double step = 1.0 / 25.0;
    std::vector<double> samples;
    for (int k = 0; k < 60; ++k) {
        samples.push_back(8.0 * std::sin(0.4 * k));
        samples.push_back(-5.0 * std::cos(0.23 * k));
    }
    samples[118] = samples[119] = 0.0;  // no jump, which small steps would smear
    const auto pivot = [&](double time) -> std::array<double, 2> {
        const auto k = static_cast<std::size_t>(time / step);
        if (k + 1 >= 60) return {0.0, 0.0};
        const double share = time / step - static_cast<double>(k);
        return {std::lerp(samples[2 * k], samples[2 * k + 2], share),
                std::lerp(samples[2 * k + 1], samples[2 * k + 3], share)};
    };
    const DoublePendulum pendulum{1.0, 0.5, 0.8, 0.6, 9.81, 0.1};
    const DoublePendulumState start{0.5, -0.4, 0.0, 0.0};
    for (const double time : {0.03, 1.1, 2.6}) {
        DoublePendulumState found;
        double_pendulum(pendulum, start, {step, samples}, {&time, 1}, {&found, 1});
        CHECK(largest_difference(found, integrated(pendulum, start, time, pivot)) < 2e-6);
    }
}

TEST_CASE("invalid settings of a double pendulum are refused by the argument's name", "[double_pendulum]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    using Catch::Matchers::StartsWith;
    CHECK_THROWS_WITH(at({0.0}, high, 1.0), StartsWith("mass1"));
    CHECK_THROWS_WITH(at({1.0, nan}, high, 1.0), StartsWith("mass2"));
    CHECK_THROWS_WITH(at({1.0, 1.0, -1.0}, high, 1.0), StartsWith("length1"));
    CHECK_THROWS_WITH(at({1.0, 1.0, 1.0, 0.0}, high, 1.0), StartsWith("length2"));
    CHECK_THROWS_WITH(at({1.0, 1.0, 1.0, 1.0, -1.0}, high, 1.0), StartsWith("gravity"));
    CHECK_THROWS_WITH(at({}, {0.0, nan, 0.0, 0.0}, 1.0), StartsWith("theta2"));
    CHECK_THROWS_WITH(at({}, high, nan), StartsWith("times"));
    CHECK_THROWS_AS(at({}, high, 1e9), std::invalid_argument);
    CHECK(longest_time({}, high) > 3600.0);
    // Backwards in time damping drives it on.
    DoublePendulum damped;
    damped.damping = 5.0;
    CHECK_THROWS_AS(at(damped, {1.0, 1.0, 3.0, 0.0}, -300.0), std::invalid_argument);
}
