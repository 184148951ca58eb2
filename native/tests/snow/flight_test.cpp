#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "flakes.hpp"
#include "motus/noise/noise.hpp"
#include "motus/snow/snow.hpp"

using namespace motus;
using namespace motus::snow;

TEST_CASE("steering is the integral of the turned direction", "[snow]") {
    for (const double frequency : {0.4, 1.0, 3.0}) {
        for (const bool apart : {false, true}) {
            SnowSettings settings;
            settings.rate = 0.0;
            settings.bursts = {{0.0, 40}};
            settings.lifetime = 20.0;
            settings.cone_radius = 0.0;
            settings.snow = true;
            settings.snow_frequency = frequency;
            settings.snow_offsets = apart;
            const Snow snow(settings);
            const double age = 7.3;
            const Flakes now = flakes_at(snow, age);
            // By the velocities, which are the direction itself.
            std::vector<glm::dvec3> sums(now.age.size());
            constexpr int steps = 1460;
            for (int i = 0; i < steps; ++i) {
                const Flakes then = flakes_at(snow, age * (i + 0.5) / steps);
                for (std::size_t f = 0; f < sums.size(); ++f) {
                    sums[f] += age / steps * glm::dvec3(then.velocity[f]);
                    if (i % 100 != 0) continue;
                    CHECK(glm::length(then.velocity[f]) == Approx(5.0).epsilon(2e-3));
                    const glm::dvec4 q(then.rotation[f]);
                    const glm::dvec3 ahead = glm::dquat(q.x, q.y, q.z, q.w) * glm::dvec3(0.0, 0.0, 1.0);
                    CHECK(glm::length(5.0 * ahead - glm::dvec3(then.velocity[f])) < 0.02);
                    if (apart) continue;
                    const double at = frequency * static_cast<double>(then.age[f]);
                    const double p = -settings.max_angle * noise::value(at, 0);
                    const double q2 = -settings.max_angle * noise::value(at, 1);
                    const glm::dvec3 wanted(std::sin(q2), -std::sin(p) * std::cos(q2),
                                            std::cos(p) * std::cos(q2));
                    CHECK(glm::length(glm::dvec3(then.velocity[f]) - 5.0 * wanted) < 0.01);
                }
            }
            for (std::size_t f = 0; f < sums.size(); ++f)
                CHECK(glm::length(glm::dvec3(now.position[f]) - sums[f]) < 2e-3);
            const bool differ = glm::length(now.position[0] - now.position[1]) > 0.01F;
            CHECK(differ == apart);
        }
    }
}

TEST_CASE("the velocity is the position's derivative, and nothing jumps", "[snow]") {
    for (SnowSettings settings : kinds(500.0)) {
        settings.random_lifetime = false;
        const Snow snow(settings);
        constexpr double h = 1.0 / 512.0;
        for (const double time : {1.7, 3.0, 3.01, 3.02, 3.03, 2.5 + 0.25}) {
            const Flakes before = flakes_at(snow, time - h), now = flakes_at(snow, time),
                         after = flakes_at(snow, time + h);
            for (std::size_t i = 0; i < now.id.size(); ++i) {
                const auto b = std::ranges::lower_bound(before.id, now.id[i]) - before.id.begin();
                const auto a = std::ranges::lower_bound(after.id, now.id[i]) - after.id.begin();
                const auto earlier = static_cast<std::size_t>(b), later = static_cast<std::size_t>(a);
                if (earlier >= before.id.size() || before.id[earlier] != now.id[i]) continue;
                if (later >= after.id.size() || after.id[later] != now.id[i]) continue;
                const glm::dvec3 step =
                    glm::dvec3(after.position[later]) - glm::dvec3(before.position[earlier]);
                CHECK(glm::length(step / (2.0 * h) - glm::dvec3(now.velocity[i])) < 0.02);
                CHECK(std::abs(glm::dot(now.rotation[i], after.rotation[later])) > 0.999F);
            }
        }
    }
}

TEST_CASE("turbulent air moves flakes at its speed, and gathers them nowhere", "[snow]") {
    SnowSettings settings;
    settings.rate = 0.0;
    settings.bursts = {{0.0, 40000}};
    settings.shape = Shape::box;
    settings.cone_radius = 10.0;
    settings.start_speed = 0.0;
    settings.turbulence = 0.6;
    settings.turbulence_size = 2.0;
    double square = 0.0, divergence = 0.0, shear = 0.0;
    glm::dvec3 mean(0.0);
    const Snow snow(settings);
    for (const glm::vec3& velocity : flakes_at(snow, 1.3).velocity) {
        square += glm::dot(glm::dvec3(velocity), glm::dvec3(velocity)) / 40000.0;
        mean += glm::dvec3(velocity) / 40000.0;
    }
    CHECK(square == Approx(0.36).epsilon(0.1));
    CHECK(glm::length(mean) < 0.05);
    // The air's slopes, by emitters that stand apart by a little.
    constexpr double h = 0.02;
    const auto moved = [&](int axis, double by) {
        glm::dvec3 offset(0.0);
        offset[axis] = by;
        settings.emitter_times = {0.0};
        settings.emitter_matrices = {glm::translate(glm::dmat4(1.0), offset)};
        return flakes_at(Snow(settings), 1.3).velocity;
    };
    std::array<std::vector<glm::vec3>, 3> more{moved(0, h), moved(1, h), moved(2, h)};
    std::array<std::vector<glm::vec3>, 3> less{moved(0, -h), moved(1, -h), moved(2, -h)};
    for (std::size_t i = 0; i < more[0].size(); ++i) {
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const glm::dvec3 slope = (glm::dvec3(more[axis][i]) - glm::dvec3(less[axis][i])) / (2.0 * h);
            sum += slope[static_cast<int>(axis)];
            shear = std::max(shear, glm::length(slope));
        }
        divergence = std::max(divergence, std::abs(sum));
    }
    CHECK(shear > 0.5);
    CHECK(divergence < 1e-2 * shear);
}

TEST_CASE("keyed wind carries flakes along, the same at any time", "[snow]") {
    SnowSettings settings;
    settings.rate = 2000.0;
    settings.start_speed = 0.0;
    settings.cone_radius = 0.0;
    settings.lifetime = 8.0;
    settings.drag = 2.0;
    settings.wind_times = {1.0, 2.0, 2.5, 6.0};
    settings.wind_values = {{1.0, 0.0, 0.0}, {1.0, 3.0, 0.0}, {-2.0, 0.0, 1.0}, {0.0, 0.0, 0.0}};
    const Snow snow(settings);
    constexpr double h = 1.0 / 512.0;
    for (const double time : {0.7, 1.5, 2.26, 4.0, 9.0}) {
        const Flakes before = flakes_at(snow, time - h), now = flakes_at(snow, time),
                     after = flakes_at(snow, time + h);
        for (std::size_t i = 0; i < now.id.size(); ++i) {
            const auto at = [&](const Flakes& flakes) {
                const auto row = static_cast<std::size_t>(now.id[i] - flakes.id.front());
                return row < flakes.id.size() ? glm::dvec3(flakes.position[row]) : glm::dvec3(1e9);
            };
            const glm::dvec3 step = at(after) - at(before);
            // Keys that bend the wind so much are a little rounded off.
            if (glm::length(step) < 1e3)
                CHECK(glm::length(step / (2.0 * h) - glm::dvec3(now.velocity[i])) < 0.03);
        }
    }
    // Long after the last key the air is still.
    for (const glm::vec3& velocity : flakes_at(snow, 40.0).velocity) CHECK(glm::length(velocity) < 1e-6F);
}

TEST_CASE("with a period gusts and eddies do to a flake what they did to the one a period before", "[snow]") {
    SnowSettings settings = rich(64.0);
    settings.bursts.clear();
    settings.delay = 0.0;
    settings.emitter_times.clear();
    settings.emitter_matrices.clear();
    // Nothing that is drawn by the flake's number.
    settings.cone_radius = 0.0;
    settings.random_speed = settings.random_orientation = settings.random_lifetime = settings.random_size =
        false;
    settings.random_color = settings.snow = false;
    settings.tumble = 0.0;
    settings.period = 1.5;
    for (const bool has_keys : {false, true}) {
        if (has_keys) {
            settings.wind_times = {0.0};
            settings.wind_values = {settings.wind};
        }
        const Snow snow(settings);
        const Flakes before = flakes_at(snow, 4.0), after = flakes_at(snow, 5.5);
        const Flakes between = flakes_at(snow, 4.75);
        REQUIRE(before.id.size() == after.id.size());
        REQUIRE(before.id.size() == between.id.size());
        bool differs = false;
        for (std::size_t i = 0; i < before.id.size(); ++i) {
            CHECK(glm::length(before.position[i] - after.position[i]) < 1e-4F);
            CHECK(glm::length(before.velocity[i] - after.velocity[i]) < 1e-4F);
            differs = differs || glm::length(before.position[i] - between.position[i]) > 1e-2F;
        }
        CHECK(differs);
    }
    settings.period = 1e-9;
    CHECK_THROWS_WITH(Snow(settings), Catch::StartsWith("period"));
}

TEST_CASE("gravity adds to the way, with snow too", "[snow]") {
    SnowSettings settings;
    settings.rate = 1000.0;
    settings.snow = true;
    const Flakes floating = flakes_at(Snow(settings), 9.0);
    settings.gravity = true;
    const Flakes falling = flakes_at(Snow(settings), 9.0);
    for (std::size_t i = 0; i < floating.age.size(); ++i) {
        const double age = 9.0 - static_cast<double>(floating.id[i] + 1) / 1000.0;
        const glm::dvec3 way = glm::dvec3(falling.position[i]) - glm::dvec3(floating.position[i]);
        CHECK(glm::length(way - glm::dvec3(0.0, 0.0, -0.5 * 9.81 * age * age)) < 1e-5);
    }
}
