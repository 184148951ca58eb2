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
    const double range = 44.145;  // J, of the energy above hanging at rest
    double error = 0.0;
    const double whole = nanoseconds([&] {
        const DoublePendulum pendulum = fresh_pendulum();
        const DoublePendulumState start{high, high, 0.0, 0.0};
        DoublePendulumState end;
        double_pendulum(pendulum, start, {&seconds, 1}, {&end, 1});
        error = std::abs(energy(pendulum, end) - energy(pendulum, start)) / range;
    });
    std::printf("  60 s of a double pendulum, energy within %.0e %12.2f ms\n", error, 1e-6 * whole);
    for (const int steps : {60 * 1000, 60 * 10000}) {
        double plain_error = 0.0;
        const double plain =
            nanoseconds([&] { plain_error = runge_kutta(DoublePendulum{}, steps) / range; }, 3);
        std::printf("    Runge-Kutta 4, %5d steps a second, within %.0e %8.2f ms\n", steps / 60, plain_error,
                    1e-6 * plain);
    }
    const double known = nanoseconds([&] {
        DoublePendulumState state;
        for (int frame = 0; frame < 1000; ++frame) {
            const double time = frame / 24.0;
            double_pendulum({}, {high, high, 0.0, 0.0}, {&time, 1}, {&state, 1});
            keep(state);
        }
    });
    std::printf("  a state whose table is there %26.2f us\n", 1e-6 * known);
    const double fan = nanoseconds(
        [&] {
            std::vector<DoublePendulumState> starts, states(100);
            for (int i = 0; i < 100; ++i)
                starts.push_back({high, high + i * 0.5 * std::numbers::pi / 180.0, 0.0, 0.0});
            double_pendulums(fresh_pendulum(), starts, seconds, states);
            keep(states);
        },
        3);
    std::printf("  60 s of a fan of 100, one thread %22.1f ms\n", 1e-6 * fan);
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
    std::printf("  a single pendulum, closed form %24.0f ns\n", cost({}));
    std::printf("  a damped one whose table is there %21.0f ns\n", cost({1.0, 9.81, 0.1}));
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
    std::printf("  a million exact steps of a 3-vector %19.2f ms (semi-implicit Euler %.2f)\n", 1e-6 * exact,
                1e-6 * plain);
    const Track track(filter, std::span(times).first(2500), std::span(inputs).first(7500), 3);
    std::array<double, 3> out{};
    const double one = nanoseconds([&] {
        for (int i = 0; i < 1000; ++i) {
            track.evaluate(0.1 * i, out);
            keep(out);
        }
    });
    std::printf("  a track of 2500 samples at any time %19.0f ns\n", 1e-3 * one);
}

}  // namespace

int main() {
    std::printf("Dynamics, processor time of one thread, best of several.\n\n");
    bench_double_pendulum();
    bench_single_pendulum();
    bench_filter();
    return 0;
}
