#include "motus/snow/snow.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "flakes.hpp"
#include "motus/noise/noise.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

[[nodiscard]] std::array<Settings, 4> kinds(double rate) {
    std::array<Settings, 4> all{rich(rate), rich(rate), rich(rate), rich(rate)};
    all[1].snow = false;
    all[1].shape = Shape::sphere;
    all[2].snow_offsets = true;
    all[2].shape = Shape::cone;
    all[3] = Settings{};
    all[3].rate = rate;
    return all;
}

}  // namespace

TEST_CASE("any frame is the same in any order and by any threads", "[snow]") {
    for (const Settings& settings : kinds(30000.0)) {
        const Snow snow(settings);
        const Flakes first = flakes_at(snow, 3.3);
        CHECK(first.age.size() > 1000);
        static_cast<void>(flakes_at(snow, 0.9));
        for (const std::size_t threads : {1, 2, 3, 8})
            CHECK(are_same(flakes_at(Snow(settings), 3.3, threads), first));
    }
}

TEST_CASE("flakes live from their birth to their lifetime, in the order of numbers", "[snow]") {
    for (const Settings& settings : kinds(701.0)) {
        const Snow snow(settings);
        for (const double time : {-1.0, 0.0, 0.3, 0.31, 0.8, 2.0, 2.8, 4.0, 1000.0}) {
            const Flakes now = flakes_at(snow, time);
            CHECK(std::ranges::is_sorted(now.id));
            CHECK(std::ranges::adjacent_find(now.id) == now.id.end());
            for (std::size_t i = 0; i < now.age.size(); ++i) {
                CHECK(now.age[i] >= 0.0F);
                CHECK(now.age[i] < static_cast<float>(settings.lifetime + 1.0));
            }
            // A flake that lives now and lived then is so much older, and keeps what it was given.
            const Flakes then = flakes_at(snow, time + 0.25);
            std::size_t both = 0;
            for (std::size_t i = 0, j = 0; i < now.id.size() && j < then.id.size();) {
                if (now.id[i] == then.id[j]) {
                    CHECK(then.age[j] - now.age[i] == Approx(0.25F).margin(1e-5));
                    CHECK(now.size[i] == then.size[j]);
                    CHECK(now.color[i] == then.color[j]);
                    ++both, ++i, ++j;
                } else {
                    now.id[i] < then.id[j] ? ++i : ++j;
                }
            }
            if (time > 2.0) CHECK(both > 100);
        }
    }
}

TEST_CASE("plain flakes fly straight from the square", "[snow]") {
    Settings settings;
    settings.rate = 10000.0;
    settings.cone_radius = 2.0;
    const Flakes now = flakes_at(Snow(settings), 50.0);
    REQUIRE(now.age.size() == 20000);
    double mean = 0.0, square = 0.0;
    for (std::size_t i = 0; i < now.age.size(); ++i) {
        const double birth = static_cast<double>(now.id[i] + 1) / 10000.0;
        CHECK(now.age[i] == Approx(50.0 - birth).margin(1e-7));
        CHECK(std::abs(now.position[i].x) <= 2.0F);
        CHECK(std::abs(now.position[i].y) <= 2.0F);
        CHECK(now.position[i].z == Approx(5.0 * (50.0 - birth)).margin(1e-5));
        CHECK(now.velocity[i] == glm::vec3(0.0F, 0.0F, 5.0F));
        CHECK(now.size[i] == 1.0F);
        CHECK(now.color[i] == glm::vec4(1.0F));
        CHECK(now.rotation[i] == glm::vec4(1.0F, 0.0F, 0.0F, 0.0F));
        mean += now.position[i].x / 20000.0;
        square += now.position[i].x * now.position[i].x / 20000.0;
    }
    CHECK(std::abs(mean) < 0.04);
    CHECK(square == Approx(4.0 / 3.0).epsilon(0.03));
}

TEST_CASE("shapes are filled evenly", "[snow]") {
    Settings settings;
    settings.rate = 20000.0;
    settings.start_speed = 0.0;
    settings.cone_radius = 1.5;
    settings.cone_angle = 0.5;
    // Mean square of the distance from the Z axis, over r^2, and of z.
    struct Expected {
        Shape shape;
        double level, height;
    };
    for (const Expected& one : {Expected{Shape::disc, 0.5, 0.0}, Expected{Shape::box, 2.0 / 3.0, 1.0 / 3.0},
                                Expected{Shape::sphere, 0.4, 0.2}, Expected{Shape::cone, 0.5, 0.0}}) {
        settings.shape = one.shape;
        const Flakes now = flakes_at(Snow(settings), 10.0);
        double level = 0.0, height = 0.0;
        glm::dvec3 mean(0.0);
        const auto count = static_cast<double>(now.age.size());
        for (const glm::vec3& at : now.position) {
            const glm::dvec3 p = glm::dvec3(at) / 1.5;
            level += (p.x * p.x + p.y * p.y) / count;
            height += p.z * p.z / count;
            mean += p / count;
        }
        CAPTURE(static_cast<int>(one.shape));
        CHECK(level == Approx(one.level).epsilon(0.02));
        CHECK(height == Approx(one.height).epsilon(0.02).margin(1e-12));
        CHECK(glm::length(mean) < 0.02);
    }
}

TEST_CASE("a surface is covered evenly, and left along its normals", "[snow]") {
    test::Random random(6);
    Settings settings;
    settings.rate = 100000.0;
    settings.lifetime = 1.0;
    settings.shape = Shape::surface;
    // Triangles of very different areas, each at a height of its own, two of them without area.
    std::vector<double> areas;
    double whole = 0.0;
    for (int i = 0; i < 12; ++i) {
        const auto height = static_cast<float>(i);
        const float width = i % 5 == 3 ? 0.0F : std::pow(2.0F, random.between(-4.0F, 2.0F));
        for (const glm::vec3& corner :
             {glm::vec3(0.0F, 0.0F, height), glm::vec3(width, 0.0F, height), glm::vec3(0.0F, 2.0F, height)})
            settings.surface_positions.push_back(corner);
        settings.surface_triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        areas.push_back(static_cast<double>(width));
        whole += areas.back();
    }
    settings.start_speed = 0.0;
    std::vector<double> found(areas.size());
    const Flakes now = flakes_at(Snow(settings), 3.0);
    glm::dvec3 mean(0.0);
    for (const glm::vec3& at : now.position) {
        const auto triangle = static_cast<std::size_t>(std::lround(at.z));
        found.at(triangle) += 1e-5;
        CHECK(at.x >= 0.0F);
        CHECK(at.y >= 0.0F);
        CHECK(static_cast<double>(at.x) / areas.at(triangle) + static_cast<double>(at.y) / 2.0 < 1.00001);
        mean += 1e-5 * glm::dvec3(static_cast<double>(at.x) / areas.at(triangle), at.y, 0.0);
    }
    for (std::size_t i = 0; i < areas.size(); ++i) CHECK(found[i] == Approx(areas[i] / whole).margin(0.006));
    CHECK(mean.x == Approx(1.0 / 3.0).epsilon(0.01));
    CHECK(mean.y == Approx(2.0 / 3.0).epsilon(0.01));

    settings.start_speed = 2.0;
    for (const glm::vec3& velocity : flakes_at(Snow(settings), 3.0).velocity)
        CHECK(velocity == glm::vec3(0.0F, 0.0F, 2.0F));
}

TEST_CASE("a camera's frustum is filled evenly, and left downwards", "[snow]") {
    Settings settings;
    settings.rate = 100000.0;
    settings.lifetime = 1.0;
    settings.start_speed = 0.0;
    settings.shape = Shape::frustum;
    settings.frustum_angles = {0.7, 0.4};
    settings.frustum_far = 12.0;
    const glm::dvec2 wide = glm::tan(settings.frustum_angles);
    const glm::dmat4 pose = glm::translate(glm::dmat4(1.0), glm::dvec3(3.0, -2.0, 1.5)) *
                            glm::rotate(glm::dmat4(1.0), 1.2, glm::dvec3(1.0, 0.3, -0.2));
    settings.emitter_times = {0.0};
    settings.emitter_matrices = {pose};
    for (const double nearest : {0.0, 0.1, 4.0, 11.5}) {
        settings.frustum_near = nearest;
        CAPTURE(nearest);
        const Flakes now = flakes_at(Snow(settings), 3.0);
        // By the volume up to a distance, and across each picture.
        const double low = std::pow(nearest / 12.0, 3.0);
        std::array<double, 8> shares{};
        glm::dvec2 mean(0.0), square(0.0);
        for (const glm::vec3& at : now.position) {
            const glm::dvec3 seen(glm::inverse(pose) * glm::dvec4(glm::dvec3(at), 1.0));
            const double distance = -seen.z;
            CHECK(distance >= nearest - 1e-5);
            CHECK(distance <= 12.00001);
            const double part = (std::pow(distance / 12.0, 3.0) - low) / (1.0 - low);
            shares.at(static_cast<std::size_t>(std::clamp(8.0 * part, 0.0, 7.0))) += 1e-5;
            const glm::dvec2 aside = glm::dvec2(seen) / (distance * wide);
            if (distance > 0.01) CHECK(std::max(std::abs(aside.x), std::abs(aside.y)) < 1.001);
            mean += 1e-5 * aside;
            square += 1e-5 * aside * aside;
        }
        for (const double share : shares) CHECK(share == Approx(0.125).margin(0.004));
        for (int axis = 0; axis < 2; ++axis) {
            CHECK(std::abs(mean[axis]) < 0.01);
            CHECK(square[axis] == Approx(1.0 / 3.0).epsilon(0.02));
        }
    }
    settings.start_speed = 2.0;
    for (const bool is_moving : {false, true}) {
        if (is_moving) {
            settings.emitter_times.push_back(5.0);
            settings.emitter_matrices.emplace_back(1.0);
        }
        const Flakes now = flakes_at(Snow(settings), 3.0);
        for (std::size_t i = 0; i < now.id.size(); i += 100) {
            CHECK(now.velocity[i] == glm::vec3(0.0F, 0.0F, -2.0F));
            CHECK(now.rotation[i] == glm::vec4(0.0F, 1.0F, 0.0F, 0.0F));
        }
    }
}

TEST_CASE("random switches stay in their ranges, evenly", "[snow]") {
    Settings settings = rich(20000.0);
    settings.snow = settings.gravity = false;
    settings.drag = settings.turbulence = 0.0;
    settings.delay = 0.0;
    settings.bursts.clear();
    settings.emitter_times.clear();
    settings.emitter_matrices.clear();
    const Flakes now = flakes_at(Snow(settings), 50.0);
    double speed = 0.0, along = 0.0, red = 0.0, size = 0.0;
    const auto count = static_cast<double>(now.age.size());
    for (std::size_t i = 0; i < now.age.size(); ++i) {
        const double fast = glm::length(glm::dvec3(now.velocity[i]));
        CHECK(std::abs(fast - 5.0) <= 1.00001);
        speed += (fast - 5.0) * (fast - 5.0) / count;
        const double cosine = now.velocity[i].z / fast;
        CHECK(cosine >= std::cos(0.6) - 1e-6);
        along += cosine / count;
        CHECK(std::abs(now.size[i] - 1.0F) <= 0.10001F);
        size += (now.size[i] - 1.0) * (now.size[i] - 1.0) / count;
        CHECK(now.color[i].x + now.color[i].y == Approx(1.0F));
        red += now.color[i].x / count;
        // The rotation turns +Z to where the flake heads; tumbling is about any axis.
        CHECK(glm::length(now.rotation[i]) == Approx(1.0F).epsilon(1e-5));
    }
    CHECK(count == Approx(50000.0).epsilon(0.01));
    CHECK(speed == Approx(1.0 / 3.0).epsilon(0.03));
    CHECK(along == Approx(0.5 * (1.0 + std::cos(0.6))).epsilon(0.001));
    CHECK(size == Approx(0.01 / 3.0).epsilon(0.03));
    CHECK(red == Approx(0.5).epsilon(0.02));
}

TEST_CASE("a random lifetime is even, and never negative", "[snow]") {
    Settings settings;
    settings.rate = 100000.0;
    settings.lifetime = 0.4;
    settings.random_lifetime = true;
    const Flakes now = flakes_at(Snow(settings), 20.0);
    // Of flakes of age a those with lifetime 0.4 + u > a: (1.4 - a) / 2, of all that are born.
    std::array<double, 14> shares{};
    for (const float age : now.age) {
        REQUIRE(age < 1.4F);
        shares.at(std::min<std::size_t>(13, static_cast<std::size_t>(10.0F * age))) += 1e-4;
    }
    for (std::size_t i = 0; i < shares.size(); ++i)
        CHECK(shares.at(i) == Approx(0.5 * (1.4 - 0.1 * (static_cast<double>(i) + 0.5))).margin(0.02));
}

TEST_CASE("random numbers have nothing to do with each other or the seed", "[snow]") {
    Settings settings;
    settings.rate = 30000.0;
    settings.start_speed = 0.0;
    settings.shape = Shape::box;
    settings.random_size = true;
    const auto columns = [&](std::uint64_t seed) {
        settings.seed = seed;
        const Flakes now = flakes_at(Snow(settings), 4.0);
        std::array<std::vector<double>, 4> all;
        for (std::size_t i = 0; i < now.age.size(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                all[axis].push_back(static_cast<double>(now.position[i][static_cast<int>(axis)]));
            all[3].push_back(10.0 * (static_cast<double>(now.size[i]) - 1.0));
        }
        return all;
    };
    const auto first = columns(1), second = columns(2), third = columns(1 + (std::uint64_t{1} << 32U));
    const auto correlation = [](const std::vector<double>& a, const std::vector<double>& b,
                                std::size_t shift) {
        double sum = 0.0;
        for (std::size_t i = 0; i + shift < a.size(); ++i) sum += a[i] * b[i + shift];
        return 3.0 * sum / static_cast<double>(a.size());
    };
    for (std::size_t one = 0; one < 4; ++one) {
        for (std::size_t other = 0; other < 4; ++other) {
            for (const std::size_t shift : {0U, 1U, 2U, 256U}) {
                if (one != other || shift > 0)
                    CHECK(std::abs(correlation(first[one], first[other], shift)) < 0.02);
                CHECK(std::abs(correlation(first[one], second[other], shift)) < 0.02);
                CHECK(std::abs(correlation(first[one], third[other], shift)) < 0.02);
            }
        }
    }
}

TEST_CASE("steering is the integral of the turned direction", "[snow]") {
    for (const double frequency : {0.4, 1.0, 3.0}) {
        for (const bool apart : {false, true}) {
            Settings settings;
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
    for (Settings settings : kinds(500.0)) {
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
    Settings settings;
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
    Settings settings;
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

TEST_CASE("gravity adds to the way, with snow too", "[snow]") {
    Settings settings;
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

TEST_CASE("flakes stay where the emitter was when they were born", "[snow]") {
    Settings settings;
    settings.rate = 100.0;
    settings.start_speed = 0.0;
    settings.cone_radius = 0.0;
    settings.lifetime = 10.0;
    settings.emitter_times = {1.0, 3.0};
    settings.emitter_matrices = {glm::dmat4(1.0), glm::translate(glm::dmat4(1.0), glm::dvec3(4.0, 0.0, 0.0))};
    const Flakes now = flakes_at(Snow(settings), 5.0);
    for (std::size_t i = 0; i < now.age.size(); ++i) {
        const double birth = static_cast<double>(now.id[i] + 1) / 100.0;
        CHECK(now.position[i].x == Approx(std::clamp(2.0 * (birth - 1.0), 0.0, 4.0)).margin(1e-5));
    }
}

TEST_CASE("looping has no end, and the flow no seam", "[snow]") {
    Settings settings;
    settings.rate = 50.0;
    settings.duration = 3.0;
    const auto count = [&](double time) { return Snow(settings).living(time).count; };
    for (const double time : {2.5, 3.0, 3.5, 6.0, 9000.0}) CHECK(count(time) == 100);
    settings.looping = false;
    CHECK(count(3.0) == 100);
    CHECK(count(4.0) == 50);
    CHECK(count(5.0) == 0);
}

TEST_CASE("late times are as good as early ones", "[snow]") {
    Settings settings;
    settings.rate = 1024.0;
    settings.snow = true;
    const Snow snow(settings);
    const Flakes early = flakes_at(snow, 4.25), late = flakes_at(snow, 1048576.25);
    REQUIRE(early.age.size() == late.age.size());
    CHECK(same_bits(early.age, late.age));
    CHECK(same_bits(early.velocity, late.velocity));
    CHECK(late.id.front() > 1000000000);
    CHECK(flakes_at(snow, 1e300).age.empty());
    CHECK_THROWS_AS(snow.living(std::numeric_limits<double>::infinity()), std::invalid_argument);
}

TEST_CASE("bad settings are refused with a sentence", "[snow]") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refuses = [](const char* name, const auto& change) {
        Settings settings;
        change(settings);
        CHECK_THROWS_WITH(Snow(settings), Catch::StartsWith(name));
    };
    for (const double bad : {-1.0, nan}) {
        refuses("rate", [&](Settings& s) { s.rate = bad; });
        refuses("lifetime", [&](Settings& s) { s.lifetime = bad; });
        refuses("delay", [&](Settings& s) { s.delay = bad; });
        refuses("duration", [&](Settings& s) { s.duration = bad; });
        refuses("cone_angle", [&](Settings& s) { s.cone_angle = bad; });
        refuses("cone_radius", [&](Settings& s) { s.cone_radius = bad; });
        refuses("drag", [&](Settings& s) { s.drag = bad; });
        refuses("frustum_angles", [&](Settings& s) { s.frustum_angles.y = bad; });
        refuses("frustum_near", [&](Settings& s) { s.frustum_near = bad; });
        refuses("frustum_far", [&](Settings& s) { s.frustum_far = bad; });
        refuses("gusts", [&](Settings& s) { s.gusts = bad; });
        refuses("gust_frequency", [&](Settings& s) { s.gust_frequency = bad; });
        refuses("snow_frequency", [&](Settings& s) { s.snow_frequency = bad; });
        refuses("turbulence must", [&](Settings& s) { s.turbulence = bad; });
        refuses("turbulence_size", [&](Settings& s) { s.turbulence_size = bad; });
        refuses("tumble", [&](Settings& s) { s.tumble = bad; });
    }
    refuses("start_speed", [&](Settings& s) { s.start_speed = nan; });
    refuses("start_size", [&](Settings& s) { s.start_size = 1e300; });
    refuses("max_angle", [&](Settings& s) { s.max_angle = nan; });
    refuses("wind", [&](Settings& s) { s.wind.y = nan; });
    refuses("wind_values", [&](Settings& s) { s.wind_times = {1.0}; });
    refuses("wind_values", [&](Settings& s) { s.wind_times = {1.0}, s.wind_values = {{nan, 0.0, 0.0}}; });
    refuses("wind_times", [&](Settings& s) { s.wind_times = {nan}, s.wind_values = {{}}; });
    refuses("wind_times must rise", [&](Settings& s) {
        s.wind_times = {1.0, 1.0}, s.wind_values = {{}, {}};
    });
    refuses("start_color", [&](Settings& s) { s.start_color.clear(); });
    refuses("start_color", [&](Settings& s) { s.start_color = {{1.0F, {}}, {0.0F, {}}}; });
    refuses("emitter_matrices", [&](Settings& s) { s.emitter_times = {0.0}; });
    refuses("surface_triangles must have an area", [&](Settings& s) { s.shape = Shape::surface; });
    refuses("surface_triangles must name", [&](Settings& s) {
        s.shape = Shape::surface;
        s.surface_triangles = {{0, 1, 2}};
    });
    refuses("surface_positions", [&](Settings& s) {
        s.shape = Shape::surface;
        s.surface_positions = {glm::vec3(std::numeric_limits<float>::infinity())};
    });
    refuses("rate must be lower: up to 2e+12 flakes", [&](Settings& s) { s.rate = 1e12; });
    refuses("rate must be lower", [&](Settings& s) { s.lifetime = 1e12; });
    refuses("rate must be lower", [&](Settings& s) { s.bursts = {{1.0, 1000000000000U}}; });
    refuses("lifetime must be shorter", [&](Settings& s) { s.rate = 0.1, s.lifetime = 1e6, s.snow = true; });

    Settings none;
    none.rate = 0.0;
    CHECK(flakes_at(Snow(none), 5.0).age.empty());
    none.rate = 100.0;
    none.lifetime = 0.0;
    CHECK(flakes_at(Snow(none), 5.0).age.empty());
    const Snow snow{Settings{}};
    const Living living = snow.living(1.0);
    std::vector<float> few(living.count - 1);
    CHECK_THROWS_AS(snow.evaluate(living, {.age = few}), std::invalid_argument);
}

TEST_CASE("only what is wanted is filled, and it is the same", "[snow]") {
    const Snow snow(rich(1000.0));
    const Living living = snow.living(3.0);
    Flakes all(living.count), some(living.count);
    snow.evaluate(living, all.fields());
    snow.evaluate(living, {.position = some.position});
    snow.evaluate(living, {.rotation = some.rotation});
    snow.evaluate(living, {.color = some.color});
    snow.evaluate(living, {.size = some.size, .id = some.id});
    snow.evaluate(living, {.velocity = some.velocity, .age = some.age});
    CHECK(are_same(all, some));
}
