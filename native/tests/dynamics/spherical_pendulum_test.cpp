#include "motus/dynamics/spherical_pendulum.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus::dynamics;
using motus::test::Random;

namespace {

constexpr double pi = std::numbers::pi;

[[nodiscard]] SphericalState at(const Pendulum& pendulum, const SphericalStart& start, double time) {
    SphericalState out;
    spherical_pendulum(pendulum, start, {&time, 1}, {&out, 1});
    return out;
}

/// Of a bob of 1 kg, J.
[[nodiscard]] double energy(const Pendulum& p, const SphericalState& s) {
    return 0.5 * p.length * p.length * glm::dot(s.velocity, s.velocity) +
           p.gravity * p.length * s.direction.z;
}

/// Angular momentum about the vertical, of 1 kg and a rod of 1 m.
[[nodiscard]] double momentum(const SphericalState& s) {
    return s.direction.x * s.velocity.y - s.direction.y * s.velocity.x;
}

[[nodiscard]] SphericalStart drawn(Random& random) {
    const double angle = random.between(-3.0, 3.0);
    const double heading = random.between(-4.0, 4.0);
    const double velocity = random.between(-6.0, 6.0);
    const double across = random.between(-6.0, 6.0);
    return {angle, heading, velocity, across};
}

/// Largest difference of two states.
[[nodiscard]] double apart(const SphericalState& a, const SphericalState& b) {
    return glm::length(a.direction - b.direction) + glm::length(a.velocity - b.velocity);
}

/// The angle from hanging down and its rate, by theta'' = l^2 cos / sin^3 - (g / L) sin in small steps of
/// Runge and Kutta's method, l the angular momentum about the vertical.
[[nodiscard]] std::array<double, 2> integrated(const Pendulum& p, std::array<double, 2> y, double l,
                                               double time) {
    const int steps = 40000;
    const double h = time / steps;
    const auto slope = [&](const std::array<double, 2>& s) -> std::array<double, 2> {
        const double sine = std::sin(s[0]);
        return {s[1], l * l * std::cos(s[0]) / (sine * sine * sine) - p.gravity / p.length * sine};
    };
    const auto moved = [](const std::array<double, 2>& s, const std::array<double, 2>& by, double t) {
        return std::array<double, 2>{s[0] + t * by[0], s[1] + t * by[1]};
    };
    for (int i = 0; i < steps; ++i) {
        const auto k1 = slope(y);
        const auto k2 = slope(moved(y, k1, 0.5 * h));
        const auto k3 = slope(moved(y, k2, 0.5 * h));
        const auto k4 = slope(moved(y, k3, h));
        for (std::size_t d = 0; d < 2; ++d) y[d] += h / 6.0 * (k1[d] + 2.0 * (k2[d] + k3[d]) + k4[d]);
    }
    return y;
}

}  // namespace

TEST_CASE("a spherical pendulum begins as it is told", "[pendulum]") {
    const SphericalState state = at({2.0, 9.81, 0.0}, {0.6, 0.4, 0.5, -0.7}, 0.0);
    const glm::dvec3 outward{std::cos(0.4), std::sin(0.4), 0.0};
    const glm::dvec3 aside{-std::sin(0.4), std::cos(0.4), 0.0};
    const glm::dvec3 up{0.0, 0.0, 1.0};
    CHECK(glm::length(state.direction - (std::sin(0.6) * outward - std::cos(0.6) * up)) < 1e-15);
    const glm::dvec3 velocity = 0.5 * (std::cos(0.6) * outward + std::sin(0.6) * up) - 0.7 * aside;
    CHECK(glm::length(state.velocity - velocity) < 1e-15);
}

TEST_CASE("in a plane the spherical pendulum is the single one, over the top too", "[pendulum]") {
    Random random(3);
    for (int i = 0; i < 40; ++i) {
        const double length = random.between(0.2, 3.0);
        const double damping = i % 3 == 0 ? random.between(0.0, 1.0) : 0.0;
        const Pendulum pendulum{length, 9.81, damping};
        const double angle = random.between(-3.0, 3.0);
        const double velocity = random.between(-9.0, 9.0);
        const double heading = random.between(-4.0, 4.0);
        const double time = random.between(damping > 0.0 ? 0.0 : -5.0, 5.0);
        PendulumState flat;
        single_pendulum(pendulum, {angle, velocity}, {&time, 1}, {&flat, 1});
        const SphericalState found = at(pendulum, {angle, heading, velocity, 0.0}, time);
        const glm::dvec3 outward{std::cos(heading), std::sin(heading), 0.0};
        const glm::dvec3 up{0.0, 0.0, 1.0};
        CHECK(glm::length(found.direction - (std::sin(flat.angle) * outward - std::cos(flat.angle) * up)) <
              1e-9);
        CHECK(glm::length(found.velocity - flat.velocity * (std::cos(flat.angle) * outward +
                                                            std::sin(flat.angle) * up)) < 1e-8);
    }
}

TEST_CASE("a conical pendulum goes round at one height, in the time of its formula", "[pendulum]") {
    const Pendulum pendulum{1.3, 9.81, 0.0};
    for (const double angle : {0.01, 0.5, 1.2, 1.5}) {
        // tan(angle) g / L = rate^2 sin(angle); across is the speed on the unit sphere.
        const double rate = std::sqrt(pendulum.gravity / (pendulum.length * std::cos(angle)));
        const SphericalStart start{angle, 0.0, 0.0, std::sin(angle) * rate};
        for (const double share : {0.25, 0.5, 1.0, 40.0, -3.0}) {
            const double time = share * 2.0 * pi / rate;
            const SphericalState found = at(pendulum, start, time);
            const glm::dvec3 expected{std::sin(angle) * std::cos(rate * time),
                                      std::sin(angle) * std::sin(rate * time), -std::cos(angle)};
            CHECK(glm::length(found.direction - expected) < 1e-11);
        }
    }
}

TEST_CASE("small swings are ellipses", "[pendulum]") {
    const double w = std::sqrt(9.81);
    const double small = 1e-6;
    for (const double time : {0.1, 0.9, 3.0}) {
        const SphericalState found = at({}, {small, 0.0, 0.0, 0.5 * small * w}, time);
        CHECK(found.direction.x == Approx(small * std::cos(w * time)).margin(1e-5 * small));
        CHECK(found.direction.y == Approx(0.5 * small * std::sin(w * time)).margin(1e-5 * small));
    }
}

TEST_CASE("an ellipse of a spherical pendulum turns as Airy's formula says", "[pendulum]") {
    // By 3/8 sin(a) sin(b) of a turn each swing, for half axes a and b: Airy (1851).
    const double a = 0.04;
    const double b = 0.02;
    const Pendulum pendulum{1.0, 9.81, 0.0};
    const SphericalStart start{a, 0.0, 0.0, b * std::sqrt(9.81)};
    const auto distance = [&](double time) {
        const glm::dvec3 at_time = at(pendulum, start, time).direction;
        return std::hypot(at_time.x, at_time.y);
    };
    // The farthest place after 20 half swings, by golden sections.
    const double half = pi / std::sqrt(9.81) * (1.0 + (a * a + b * b) / 16.0);
    double low = 19.8 * half;
    double high = 20.2 * half;
    constexpr double golden = 0.6180339887498949;
    for (int i = 0; i < 60; ++i) {
        const double left = high - golden * (high - low);
        const double right = low + golden * (high - low);
        (distance(left) > distance(right) ? high : low) = distance(left) > distance(right) ? right : left;
    }
    const glm::dvec3 farthest = at(pendulum, start, 0.5 * (low + high)).direction;
    const double turned = std::atan2(farthest.y, farthest.x);
    CHECK(turned == Approx(10.0 * 2.0 * pi * 0.375 * a * b).epsilon(5e-3));
}

TEST_CASE("the angle of a spherical pendulum solves its own equation", "[pendulum]") {
    Random random(5);
    for (int i = 0; i < 20; ++i) {
        const double length = random.between(0.5, 3.0);
        const Pendulum pendulum{length, 9.81, 0.0};
        const double angle = random.between(0.5, 2.5);
        const double velocity = random.between(-2.0, 2.0);
        const double across = random.between(1.0, 4.0);
        const double time = random.between(0.5, 3.0);
        const auto expected = integrated(pendulum, {angle, velocity}, std::sin(angle) * across, time);
        const SphericalState found = at(pendulum, {angle, 1.0, velocity, across}, time);
        CHECK(std::acos(-found.direction.z) == Approx(expected[0]).margin(1e-8));
    }
}

TEST_CASE("a spherical pendulum keeps energy, angular momentum and its rod", "[pendulum]") {
    Random random(7);
    for (int i = 0; i < 12; ++i) {
        const double length = random.between(0.2, 3.0);
        const Pendulum pendulum{length, 9.81, 0.0};
        const SphericalStart start = drawn(random);
        const SphericalState before = at(pendulum, start, 0.0);
        const double range = 9.81 * length + energy(pendulum, before) + 9.81 * length;
        const double fastest = std::sqrt(2.0 * range) / length;
        for (const double time : {0.3, 10.0, -60.0, 600.0}) {
            const SphericalState after = at(pendulum, start, time);
            CHECK(std::abs(energy(pendulum, after) - energy(pendulum, before)) < 1e-11 * range);
            CHECK(std::abs(momentum(after) - momentum(before)) < 1e-12 * fastest);
            CHECK(glm::length(after.direction) == Approx(1.0).epsilon(1e-15));
            CHECK(std::abs(glm::dot(after.direction, after.velocity)) < 1e-11 * fastest);
        }
    }
}

TEST_CASE("damping takes the angular momentum by its rate, and energy all the time", "[pendulum]") {
    const Pendulum pendulum{0.8, 9.81, 0.4};
    const SphericalStart start{1.0, 0.3, -1.0, 2.0};
    const double before = momentum(at(pendulum, start, 0.0));
    double last = std::numeric_limits<double>::infinity();
    for (double time = 0.0; time < 8.0; time += 0.25) {
        const SphericalState state = at(pendulum, start, time);
        CHECK(momentum(state) == Approx(before * std::exp(-0.4 * time)).epsilon(1e-11));
        CHECK(energy(pendulum, state) < last);
        last = energy(pendulum, state);
    }
}

TEST_CASE("a heading turns the whole motion, and a mirrored start mirrors it", "[pendulum]") {
    const Pendulum pendulum{1.0, 9.81, 0.1};
    const SphericalState one = at(pendulum, {0.9, 0.0, 0.2, 1.5}, 2.5);
    const SphericalState turned = at(pendulum, {0.9, 0.5 * pi, 0.2, 1.5}, 2.5);
    const SphericalState mirrored = at(pendulum, {0.9, 0.0, 0.2, -1.5}, 2.5);
    CHECK(glm::length(turned.direction - glm::dvec3(-one.direction.y, one.direction.x, one.direction.z)) <
          1e-13);
    CHECK(mirrored.direction == glm::dvec3(one.direction.x, -one.direction.y, one.direction.z));
}

TEST_CASE("without gravity a bob goes round on a great circle", "[pendulum]") {
    const SphericalState found = at({2.0, 0.0, 0.0}, {0.5 * pi, 0.0, 0.0, 1.0}, 2.0);
    CHECK(glm::length(found.direction - glm::dvec3(std::cos(2.0), std::sin(2.0), 0.0)) < 1e-13);
}

TEST_CASE("each state of a spherical pendulum depends on its own time alone", "[pendulum]") {
    const Pendulum pendulum{0.7, 9.81, 0.2};
    const SphericalStart start{2.0, 0.1, 0.4, 1.0};
    const std::vector<double> times{12.0, 0.1, -0.5, 3.0, 12.0, 0.1};
    std::vector<SphericalState> together(times.size());
    spherical_pendulum(pendulum, start, times, together);
    for (std::size_t i = 0; i < times.size(); ++i) CHECK(together[i] == at(pendulum, start, times[i]));
}

TEST_CASE("a spherical pendulum feels its pivot in space", "[pendulum]") {
    // In free fall it goes on along its circle; a steady push to y is gravity that leans.
    const double time = 1.5;
    SphericalState out;
    const std::vector<double> falling{0.0, 0.0, -9.81, 0.0, 0.0, -9.81, 0.0, 0.0, -9.81};
    spherical_pendulum({1.0, 9.81, 0.0}, {0.5, 0.3, 2.0, 0.0}, {1.0, falling}, {&time, 1}, {&out, 1});
    CHECK(apart(out, at({1.0, 0.0, 0.0}, {0.5, 0.3, 2.0, 0.0}, time)) < 1e-11);
    // At rest along the leaning gravity it stays.
    const double push = 3.0;
    const std::vector<double> pushed{0.0, push, 0.0, 0.0, push, 0.0, 0.0, push, 0.0};
    const double leaning = std::atan2(push, 9.81);
    spherical_pendulum({1.0, 9.81, 0.0}, {leaning, -0.5 * pi, 0.0, 0.0}, {1.0, pushed}, {&time, 1},
                       {&out, 1});
    CHECK(apart(out, at({1.0, 9.81, 0.0}, {leaning, -0.5 * pi, 0.0, 0.0}, 0.0)) < 1e-11);
    // In the plane it is the single pendulum's own pivot.
    std::vector<double> flat;
    std::vector<double> spatial;
    for (int k = 0; k < 40; ++k) {
        const double x = 4.0 * std::sin(0.3 * k);
        const double z = 2.0 * std::cos(0.2 * k);
        flat.insert(flat.end(), {x, z});
        spatial.insert(spatial.end(), {x, 0.0, z});
    }
    PendulumState single;
    single_pendulum({1.1, 9.81, 0.1}, {0.3, 0.0}, {0.05, flat}, {&time, 1}, {&single, 1});
    spherical_pendulum({1.1, 9.81, 0.1}, {0.3, 0.0, 0.0, 0.0}, {0.05, spatial}, {&time, 1}, {&out, 1});
    CHECK(out.direction.x == Approx(std::sin(single.angle)).margin(1e-10));
    CHECK(out.direction.y == 0.0);
    const double past = -0.1;
    CHECK_THROWS_AS(spherical_pendulum({}, {}, {1.0, falling}, {&past, 1}, {&out, 1}), std::invalid_argument);
    CHECK_THROWS_AS(spherical_pendulum({}, {}, {0.05, flat}, {&time, 1}, {&out, 1}), std::invalid_argument);
}

TEST_CASE("a spherical pendulum that hangs or stands stays, and refuses what is no motion", "[pendulum]") {
    CHECK(at({}, {}, 7.0) == SphericalState{});
    CHECK(at({}, {pi, 0.0, 0.0, 0.0}, 0.5).direction.z == Approx(1.0).epsilon(1e-14));
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (const SphericalStart& start : {SphericalStart{none}, SphericalStart{0.0, 1e10},
                                        SphericalStart{0.0, 0.0, none}, SphericalStart{0.0, 0.0, 0.0, none}})
        CHECK_THROWS_AS(at({}, start, 1.0), std::invalid_argument);
    for (const Pendulum& pendulum :
         {Pendulum{0.0, 9.81, 0.0}, Pendulum{1.0, -1.0, 0.0}, Pendulum{1.0, 9.81, none}})
        CHECK_THROWS_AS(at(pendulum, {}, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(at({}, {1.0}, 1e9), std::invalid_argument);
    CHECK_THROWS_AS(at({}, {1.0}, none), std::invalid_argument);
}
