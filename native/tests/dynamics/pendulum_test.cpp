#include "motus/dynamics/pendulum.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "data/pendulum.hpp"
#include "random.hpp"

using namespace motus::dynamics;
using motus::test::Random;

namespace {

constexpr double pi = std::numbers::pi;

PendulumState at(const Pendulum& pendulum, const PendulumState& start, double time) {
    PendulumState out;
    single_pendulum(pendulum, start, {&time, 1}, {&out, 1});
    return out;
}

double energy(const Pendulum& p, const PendulumState& s) {
    return 0.5 * p.length * s.velocity * s.velocity - p.gravity * std::cos(s.angle);
}

/// The equation by small steps of Runge and Kutta's method. pivot: its accelerations (x, z) at a time.
template <class Pivot>
PendulumState integrated(const Pendulum& p, PendulumState s, double time, const Pivot& pivot) {
    const int steps = 20000;
    const double h = time / steps;
    const auto force = [&](double t, double angle, double velocity) {
        const auto [x, z] = pivot(t);
        return -(p.gravity + z) / p.length * std::sin(angle) - x / p.length * std::cos(angle) -
               p.damping * velocity;
    };
    for (int i = 0; i < steps; ++i) {
        const double t = i * h;
        const double a1 = force(t, s.angle, s.velocity);
        const double v2 = s.velocity + h / 2 * a1;
        const double a2 = force(t + h / 2, s.angle + h / 2 * s.velocity, v2);
        const double v3 = s.velocity + h / 2 * a2;
        const double a3 = force(t + h / 2, s.angle + h / 2 * v2, v3);
        const double v4 = s.velocity + h * a3;
        const double a4 = force(t + h, s.angle + h * v3, v4);
        s.angle += h / 6 * (s.velocity + 2 * v2 + 2 * v3 + v4);
        s.velocity += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    return s;
}

std::array<double, 2> still(double /*time*/) {
    return {0.0, 0.0};
}

}  // namespace

TEST_CASE("periods of the single pendulum are those of the reference", "[pendulum]") {
    for (const auto& [degrees, seconds] : motus::reference::pendulum_periods) {
        const PendulumState start{degrees * pi / 180.0, 0.0};
        CHECK(pendulum_period({}, start) == Approx(seconds).epsilon(3e-15 * 180.0 / (180.0 - degrees)));
        const PendulumState later = at({}, start, 5.0 * seconds);
        CHECK(std::abs(later.angle - start.angle) < 1e-11);
        // At a quarter of the period it hangs, at half of it it is on the other side.
        CHECK(std::abs(at({}, start, 0.25 * seconds).angle) < 1e-12);
        CHECK(at({}, start, 0.5 * seconds).angle == Approx(-start.angle).epsilon(1e-12));
    }
    // For the smallest angles the motion is harmonic.
    const double w = std::sqrt(9.81);
    CHECK(at({}, {1e-9, 0.0}, 1.3).angle == Approx(1e-9 * std::cos(1.3 * w)).epsilon(1e-12));
}

TEST_CASE("the single pendulum solves its equation", "[pendulum]") {
    Random random(1);
    const auto draw = [&] { return random.between(0.0, 1.0); };
    for (int i = 0; i < 60; ++i) {
        const Pendulum pendulum{0.2 + 3.0 * draw(), 20.0 * draw(), i % 2 == 0 ? 0.0 : draw()};
        const PendulumState start{20.0 * draw() - 10.0, 16.0 * draw() - 8.0};
        const double time = 4.0 * draw() - (i % 3 == 0 ? 4.0 : 0.0);
        const PendulumState found = at(pendulum, start, time);
        const PendulumState expected = integrated(pendulum, start, time, still);
        CHECK(std::abs(found.angle - expected.angle) < 1e-8);
        CHECK(std::abs(found.velocity - expected.velocity) < 1e-7);
    }
}

TEST_CASE("the closed form and the integrated motion are one", "[pendulum]") {
    // Hardly any damping, which is enough to have it integrated.
    for (const PendulumState start :
         {PendulumState{1.0, 0.5}, PendulumState{-2.0, -3.0}, PendulumState{2.0, 9.0},
          PendulumState{8.0, -9.0}, PendulumState{3.1, 0.0}}) {
        for (const double time : {0.1, 3.3, -2.0, 20.0}) {
            const PendulumState closed = at({1.3, 9.81, 0.0}, start, time);
            const PendulumState stepped = at({1.3, 9.81, 1e-300}, start, time);
            CHECK(std::abs(closed.angle - stepped.angle) < 1e-10);
            CHECK(std::abs(closed.velocity - stepped.velocity) < 1e-10);
        }
    }
}

TEST_CASE("a pendulum that hangs, stands, or just reaches the top", "[pendulum]") {
    CHECK(at({}, {0.0, 0.0}, 7.0) == PendulumState{0.0, 0.0});
    CHECK(at({}, {pi, 0.0}, 7.0).angle == pi);
    CHECK(at({}, {3.0 * pi, 0.0}, 7.0).angle == 3.0 * pi);
    CHECK(pendulum_period({}, {0.0, 0.0}) == std::numeric_limits<double>::infinity());
    // From the bottom with 2 sqrt(g / L) it takes for ever to the top: theta = 2 atan(sinh(w t)).
    const Pendulum pendulum{1.0, 4.0, 0.0};
    for (const double time : {0.3, 1.0, 4.0}) {
        const PendulumState state = at(pendulum, {0.0, 4.0}, time);
        CHECK(state.angle == Approx(2.0 * std::atan(std::sinh(2.0 * time))).epsilon(1e-14));
        CHECK(state.velocity == Approx(4.0 / std::cosh(2.0 * time)).epsilon(1e-13));
    }
    CHECK(at(pendulum, {0.0, 4.0}, 1e4).angle == Approx(pi).epsilon(1e-15));
    // On both sides of that it is nearly the same for a while.
    CHECK(at(pendulum, {0.0, 4.0 * (1.0 - 1e-12)}, 3.0).angle ==
          Approx(at(pendulum, {0.0, 4.0}, 3.0).angle).epsilon(1e-8));
    CHECK(at(pendulum, {0.0, 4.0 * (1.0 + 1e-12)}, 3.0).angle ==
          Approx(at(pendulum, {0.0, 4.0}, 3.0).angle).epsilon(1e-8));
    // Without gravity nothing turns it.
    CHECK(at({2.0, 0.0, 0.0}, {1.0, 3.0}, 5.0).angle == 16.0);
    CHECK(at({2.0, 0.0, 0.5}, {1.0, 3.0}, 5.0).angle ==
          Approx(1.0 + 6.0 * (1.0 - std::exp(-2.5))).epsilon(1e-13));
}

TEST_CASE("a pendulum that rotates keeps its turns and its energy", "[pendulum]") {
    for (const double velocity : {7.0, -7.0, 60.0}) {
        const PendulumState start{0.4, velocity};
        const double period = pendulum_period({}, start);
        const PendulumState later = at({}, start, 1000.0 * period);
        CHECK(later.angle == Approx(0.4 + std::copysign(2000.0 * pi, velocity)).margin(1e-8));
        for (const double time : {0.01, 0.7, 33.3}) {
            const double before = energy({}, start);
            CHECK(energy({}, at({}, start, time)) == Approx(before).epsilon(1e-13));
        }
    }
}

TEST_CASE("each state depends on its own time alone", "[pendulum]") {
    const Pendulum damped{0.7, 9.81, 0.2};
    const std::vector<double> times{12.0, 0.1, -0.5, 3.0, 12.0, 0.1};
    std::vector<PendulumState> together(times.size());
    single_pendulum(damped, {2.0, 0.1}, times, together);
    for (std::size_t i = 0; i < times.size(); ++i) CHECK(together[i] == at(damped, {2.0, 0.1}, times[i]));
}

TEST_CASE("a pendulum on a moved pivot solves its equation", "[pendulum]") {
    const double step = 1.0 / 24.0;
    std::vector<double> accelerations;
    for (int k = 0; k < 60; ++k) {
        accelerations.push_back(6.0 * std::sin(0.31 * k));
        accelerations.push_back(4.0 * std::cos(0.17 * k * k));
    }
    accelerations[118] = accelerations[119] = 0.0;  // no jump, which small steps would smear
    const auto pivot = [&](double time) -> std::array<double, 2> {
        const double place = time / step;
        const auto k = static_cast<std::size_t>(place);
        if (k + 1 >= 60) return {0.0, 0.0};
        const double share = place - static_cast<double>(k);
        return {std::lerp(accelerations[2 * k], accelerations[2 * k + 2], share),
                std::lerp(accelerations[2 * k + 1], accelerations[2 * k + 3], share)};
    };
    for (const Pendulum pendulum :
         {Pendulum{1.1, 9.81, 0.0}, Pendulum{0.05, 9.81, 0.4}, Pendulum{30.0, 0.0, 0.0}}) {
        for (const double time : {0.02, 1.0, 2.2, 3.5}) {
            PendulumState found;
            single_pendulum(pendulum, {0.3, 0.0}, {step, accelerations}, {&time, 1}, {&found, 1});
            const PendulumState expected = integrated(pendulum, {0.3, 0.0}, time, pivot);
            CHECK(std::abs(found.angle - expected.angle) < 2e-6);
        }
    }
    const double past = -0.1;
    PendulumState out;
    CHECK_THROWS_AS(single_pendulum({}, {}, {step, accelerations}, {&past, 1}, {&out, 1}),
                    std::invalid_argument);
    // In free fall it goes on as it was.
    const std::vector<double> falling{0.0, -9.81, 0.0, -9.81, 0.0, -9.81};
    const double time = 1.5;
    single_pendulum({1.0, 9.81, 0.0}, {0.5, 2.0}, {1.0, falling}, {&time, 1}, {&out, 1});
    CHECK(out.angle == Approx(3.5).epsilon(1e-13));
}

TEST_CASE("a pivot's accelerations are those of a spline through its positions", "[pendulum]") {
    // The second derivative of the spline, integrated twice, comes through the positions again.
    const std::vector<double> positions{0.0, 0.0, 1.0, -0.5, 3.0, 0.0, 2.0, 2.0, 2.5, 2.0};
    std::vector<double> a(positions.size());
    const double step = 0.25;
    pivot_accelerations(step, positions, a);
    CHECK(a[0] == 0.0);
    CHECK(a[9] == 0.0);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        for (std::size_t k = 1; k + 1 < 5; ++k) {
            const auto p = [&](std::size_t i) { return positions[2 * i + axis]; };
            const auto c = [&](std::size_t i) { return a[2 * i + axis]; };
            // Slope at k seen from the left and from the right.
            const double left = (p(k) - p(k - 1)) / step + step / 6.0 * (2.0 * c(k) + c(k - 1));
            const double right = (p(k + 1) - p(k)) / step - step / 6.0 * (2.0 * c(k) + c(k + 1));
            CHECK(left == Approx(right).margin(1e-12));
        }
    }
}

TEST_CASE("invalid settings of a pendulum are refused by the argument's name", "[pendulum]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    using Catch::Matchers::StartsWith;
    CHECK_THROWS_WITH(at({0.0, 9.81, 0.0}, {}, 1.0), StartsWith("length"));
    CHECK_THROWS_WITH(at({1.0, -1.0, 0.0}, {}, 1.0), StartsWith("gravity"));
    CHECK_THROWS_WITH(at({1.0, 1.0, -1.0}, {}, 1.0), StartsWith("damping"));
    CHECK_THROWS_WITH(at({}, {nan, 0.0}, 1.0), StartsWith("angle"));
    CHECK_THROWS_WITH(at({}, {0.0, nan}, 1.0), StartsWith("velocity"));
    CHECK_THROWS_WITH(at({}, {}, nan), StartsWith("times"));
    CHECK_THROWS_AS(at({1.0, 9.81, 0.1}, {1.0, 0.0}, 1e9), std::invalid_argument);
    CHECK(std::isfinite(at({1.0, 9.81, 0.0}, {1.0, 0.0}, 1e9).angle));
    // Heavily damped: each interval takes thousands of steps.
    CHECK_THROWS_AS(at({1.0, 9.81, 1e4}, {1.0, 0.0}, 8000.0), std::invalid_argument);
}

TEST_CASE("a pendulum that turns too fast for its gravity turns evenly", "[pendulum]") {
    const Pendulum weak{1.0, 1e-10, 0.0};
    for (const double velocity : {1e120, -1e300, 1.7e308}) {
        const PendulumState start{1.0, velocity};
        CHECK(at(weak, start, 1e-120) == PendulumState{1.0 + velocity * 1e-120, velocity});
        CHECK(pendulum_period(weak, start) == std::numeric_limits<double>::infinity());
    }
    CHECK_THROWS_AS(at(weak, {1.0, 1.7e308}, 10.0), std::invalid_argument);
    CHECK_THROWS_AS(at({5e-324, 9.81, 0.0}, {1.0, 0.0}, 1.0), std::invalid_argument);
}
