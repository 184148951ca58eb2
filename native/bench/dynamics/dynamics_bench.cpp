// Pendulums and second-order filters, beside the usual fixed steps of the same work.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <vector>

#include "motus/dynamics/double_pendulum.hpp"
#include "motus/dynamics/track.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus::dynamics;
using motus::bench::keep;
using motus::bench::nanoseconds;

namespace {

constexpr double seconds = 60.0;
constexpr double high = 2.0 * std::numbers::pi / 3.0;

/// No two runs ask for the same pendulum: its table would be there already.
[[nodiscard]] DoublePendulum fresh_pendulum() {
    static int count = 0;
    DoublePendulum pendulum;
    pendulum.gravity += 1e-9 * ++count;
    return pendulum;
}

/// The textbook's equations by Runge and Kutta's method of order 4; returns the energy's error.
[[nodiscard]] double runge_kutta(const DoublePendulum& p, int steps) {
    using State = std::array<double, 4>;
    const auto slope = [&](const State& y) -> State {
        const double sine = std::sin(y[0] - y[1]), cosine = std::cos(y[0] - y[1]);
        const double all = p.mass1 + p.mass2;
        const double divisor = p.mass1 + p.mass2 * sine * sine;
        const double pull1 = -all * p.gravity * std::sin(y[0]) - p.mass2 * p.length2 * y[3] * y[3] * sine;
        const double pull2 = p.length1 * y[2] * y[2] * sine - p.gravity * std::sin(y[1]);
        return {y[2], y[3], (pull1 - p.mass2 * cosine * pull2) / (p.length1 * divisor),
                (all * pull2 - cosine * pull1) / (p.length2 * divisor)};
    };
    const auto moved = [](const State& y, const State& by, double h) -> State {
        return {y[0] + h * by[0], y[1] + h * by[1], y[2] + h * by[2], y[3] + h * by[3]};
    };
    State y{high, high, 0.0, 0.0};
    const double h = seconds / steps;
    for (int i = 0; i < steps; ++i) {
        const State k1 = slope(y);
        const State k2 = slope(moved(y, k1, h / 2));
        const State k3 = slope(moved(y, k2, h / 2));
        const State k4 = slope(moved(y, k3, h));
        for (std::size_t d = 0; d < y.size(); ++d) y[d] += h / 6 * (k1[d] + 2 * k2[d] + 2 * k3[d] + k4[d]);
    }
    return std::abs(energy(p, {y[0], y[1], y[2], y[3]}) - energy(p, {high, high, 0.0, 0.0}));
}

void bench_double_pendulum() {
    const motus::bench::Table table("60 s of double pendulums, one thread, best of several",
                                    {{"taken", "ms"}, {"error of energy", "", 0, true}});
    const double range = 44.145;  // J, of the energy above hanging at rest
    double error = 0.0;
    const double whole = nanoseconds([&] {
        const DoublePendulum pendulum = fresh_pendulum();
        const DoublePendulumState start{high, high, 0.0, 0.0};
        DoublePendulumState end;
        double_pendulum(pendulum, start, {&seconds, 1}, {&end, 1});
        error = std::abs(energy(pendulum, end) - energy(pendulum, start)) / range;
    });
    table.row("one", {1e-6 * whole, error});
    for (const int steps : {60 * 1000, 60 * 10000}) {
        double plain_error = 0.0;
        const double plain =
            nanoseconds([&] { plain_error = runge_kutta(DoublePendulum{}, steps) / range; }, 3);
        table.row("one by Runge-Kutta 4, " + std::to_string(steps / 60) + " steps a second",
                  {1e-6 * plain, plain_error});
    }
    const double known = nanoseconds([&] {
        DoublePendulumState state;
        for (int frame = 0; frame < 1000; ++frame) {
            const double time = frame / 24.0;
            double_pendulum({}, {high, high, 0.0, 0.0}, {&time, 1}, {&state, 1});
            keep(state);
        }
    });
    const double fan = nanoseconds(
        [&] {
            std::vector<DoublePendulumState> starts, states(100);
            for (int i = 0; i < 100; ++i)
                starts.push_back({high, high + i * 0.5 * std::numbers::pi / 180.0, 0.0, 0.0});
            double_pendulums(fresh_pendulum(), starts, seconds, states);
            keep(states);
        },
        3);
    table.row("a fan of 100", {1e-6 * fan});
    const motus::bench::Table looked_up("Double pendulums looked up", {{"taken", "ns", 0}});
    looked_up.row("a state whose table is there", {1e-3 * known});
}

void bench_single_pendulum() {
    const double time = 7.7;
    const auto cost = [&](const Pendulum& pendulum) {
        return 1e-3 * nanoseconds([&] {
                   PendulumState state;
                   for (int i = 0; i < 1000; ++i) {
                       single_pendulum(pendulum, {1.0, 0.0}, {&time, 1}, {&state, 1});
                       keep(state);
                   }
               });
    };
    const motus::bench::Table table("Single pendulums", {{"taken", "ns", 0}});
    table.row("closed form", {cost({})});
    table.row("a damped one whose table is there", {cost({1.0, 9.81, 0.1})});
}

void bench_filter() {
    constexpr std::size_t count = 1'000'000;
    std::vector<double> times(count), inputs(3 * count), outputs(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        times[i] = static_cast<double>(i) / 24.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            inputs[3 * i + axis] = std::sin(0.01 * static_cast<double>(i) + static_cast<double>(axis));
    }
    const SecondOrder filter(2.0, 0.5, 1.0);
    const double exact = nanoseconds([&] {
        second_order(filter, times, inputs, 3, outputs);
        keep(outputs);
    });
    const auto [k1, k2, k3] = filter.coefficients();
    const double plain = nanoseconds([&] {
        // The usual semi-implicit Euler step, stable or not.
        const double h = 1.0 / 24.0;
        std::array<double, 3> y{}, v{};
        for (std::size_t i = 1; i < count; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double x = inputs[3 * i + axis];
                const double slope = (x - inputs[3 * (i - 1) + axis]) / h;
                y[axis] += h * v[axis];
                v[axis] += h * (x + k3 * slope - y[axis] - k1 * v[axis]) / k2;
                outputs[3 * i + axis] = y[axis];
            }
        }
        keep(outputs);
    });
    const motus::bench::Table steps("A million steps of a 3-vector", {{"taken", "ms"}});
    steps.row("exact", {1e-6 * exact});
    steps.row("semi-implicit Euler", {1e-6 * plain});
    const Track track(filter, std::span(times).first(2500), std::span(inputs).first(7500), 3);
    std::array<double, 3> out{};
    const double one = nanoseconds([&] {
        for (int i = 0; i < 1000; ++i) {
            track.evaluate(0.1 * i, out);
            keep(out);
        }
    });
    const motus::bench::Table tracks("Tracks", {{"taken", "ns", 0}});
    tracks.row("of 2500 samples at any time", {1e-3 * one});
}

}  // namespace

int main() {
    bench_double_pendulum();
    bench_single_pendulum();
    bench_filter();
    return 0;
}
