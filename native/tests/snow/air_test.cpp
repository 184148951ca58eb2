#include "air.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::snow;

TEST_CASE("the relaxation is its formula, and its limit without drag", "[snow]") {
    for (const double drag : {0.0, 1e-9, 1e-3, 0.3, 0.999, 1.001, 40.0, 1000.0}) {
        for (const double age : {0.0, 1e-3, 0.5, 1.0, 7.0, 100.0}) {
            const Relaxation found = relaxation(age, drag);
            const long double x = static_cast<long double>(drag) * age;
            CAPTURE(drag, age);
            CHECK(found.decay == Approx(static_cast<double>(std::exp(-x))).epsilon(1e-13).margin(1e-300));
            const double first = drag == 0.0 ? age : static_cast<double>(-std::expm1(-x) / drag);
            CHECK(found.first == Approx(first).epsilon(1e-13));
            if (x > 0.1L) {
                const long double third = (0.5L * age * age - (age + std::expm1(-x) / drag) / drag) / drag;
                CHECK(found.third == Approx(static_cast<double>(third)).epsilon(1e-10));
            } else {
                CHECK(
                    found.third ==
                    Approx(age * age * age * static_cast<double>(1 - x / 4 + x * x / 20) / 6).epsilon(1e-5));
            }
            if (x < 1e-4L) {
                CHECK(found.second == Approx(age * age * (0.5 - static_cast<double>(x) / 6.0)).epsilon(1e-8));
            } else {
                const long double second = (age + std::expm1(-x) / drag) / drag;
                CHECK(found.second == Approx(static_cast<double>(second)).epsilon(1e-10));
            }
        }
    }
}

TEST_CASE("the air's closed form is what small steps lead to", "[snow]") {
    test::Random random(2);
    for (int round = 0; round < 6; ++round) {
        const double drag = random.between(0.2, 6.0), gusts = random.between(0.0, 1.5);
        const glm::dvec3 wind = random.in_cube(4.0), acceleration(0.0, 0.0, -9.81);
        const Air air(acceleration, drag, wind, gusts, random.between(0.1, 1.0));
        const double time = random.between(0.0, 500.0), age = random.between(0.1, 5.0);
        // Heun's method.
        constexpr int steps = 20000;
        const double h = age / steps;
        glm::dvec3 way(0.0), velocity(0.0);
        const auto slope = [&](double now, const glm::dvec3& v) {
            return acceleration + drag * (wind * (1.0 + gusts * air.gust(now)) - v);
        };
        for (int i = 0; i < steps; ++i) {
            const double now = time - age + i * h;
            const glm::dvec3 first = slope(now, velocity);
            const glm::dvec3 second = slope(now + h, velocity + h * first);
            way += h * velocity + 0.5 * h * h * first;
            velocity += 0.5 * h * (first + second);
        }
        const Air::State state = air.at(time, age);
        CHECK(glm::length(state.way - way) < 1e-5);
        CHECK(glm::length(state.velocity - velocity) < 1e-5);
        // The slopes, by the age at the same time.
        const double small = 1e-5;
        const Air::State more = air.at(time, age + small), less = air.at(time, age - small);
        CHECK(glm::length((more.way - less.way) / (2.0 * small) - state.way_slope) < 1e-6);
        CHECK(glm::length((more.velocity - less.velocity) / (2.0 * small) - state.velocity_slope) < 1e-5);
    }
}

TEST_CASE("keyed wind's closed form is what small steps lead to", "[snow]") {
    test::Random random(5);
    for (int round = 0; round < 12; ++round) {
        const double drag = round == 0 ? 1e-6 : random.between(0.05, 6.0);
        const double gusts = round % 3 == 0 ? 0.0 : random.between(0.0, 1.5);
        const glm::dvec3 acceleration(0.0, 0.0, -9.81);
        std::vector<double> times{random.between(-3.0, 1.0)};
        std::vector<glm::dvec3> winds{random.in_cube(4.0)};
        for (std::size_t key = 1; key < 1 + random.below(6); ++key) {
            times.push_back(times.back() + random.between(0.01, 2.0));
            winds.push_back(random.in_cube(4.0));
        }
        const double frequency = random.between(0.1, 1.0);
        const Air air(acceleration, drag, times, winds, gusts, frequency);
        const auto wind = [&](double now) {
            if (now <= times.front()) return winds.front();
            if (now >= times.back()) return winds.back();
            std::size_t i = 1;
            while (times[i] < now) ++i;
            return glm::mix(winds[i - 1], winds[i], (now - times[i - 1]) / (times[i] - times[i - 1]));
        };
        // Before the keys, among them, and after them.
        for (const double time : {-5.0, 0.5, 2.0, 5.0, 14.0}) {
            const double age = random.between(0.1, 6.0);
            constexpr int steps = 20000;
            const double h = age / steps;
            glm::dvec3 way(0.0), velocity(0.0);
            const auto slope = [&](double now, const glm::dvec3& v) {
                return acceleration + drag * (wind(now) * (1.0 + gusts * air.gust(now)) - v);
            };
            for (int i = 0; i < steps; ++i) {
                const double now = time - age + i * h;
                const glm::dvec3 first = slope(now, velocity);
                const glm::dvec3 second = slope(now + h, velocity + h * first);
                way += h * velocity + 0.5 * h * h * first;
                velocity += 0.5 * h * (first + second);
            }
            CAPTURE(round, drag, gusts, time, age);
            const Air::State state = air.at(time, age);
            CHECK(glm::length(state.way - way) < 1e-5);
            CHECK(glm::length(state.velocity - velocity) < 1e-5);
            const double small = 1e-5;
            const Air::State more = air.at(time, age + small), less = air.at(time, age - small);
            CHECK(glm::length((more.way - less.way) / (2.0 * small) - state.way_slope) < 1e-4);
            CHECK(glm::length((more.velocity - less.velocity) / (2.0 * small) - state.velocity_slope) < 1e-3);
        }
        // Keys that are all the same are one wind for all times.
        winds.assign(winds.size(), winds.front());
        const Air even(acceleration, drag, times, winds, gusts, frequency);
        const Air plain(acceleration, drag, winds.front(), gusts, frequency);
        for (const double time : {-4.0, 1.0, 30.0}) {
            const Air::State one = even.at(time, 2.5), other = plain.at(time, 2.5);
            CHECK(glm::length(one.way - other.way) < 1e-9);
            CHECK(glm::length(one.velocity_slope - other.velocity_slope) < 1e-9);
        }
    }
}
