#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "flakes.hpp"
#include "motus/snow/snow.hpp"

using namespace motus;
using namespace motus::snow;

TEST_CASE("random switches stay in their ranges, evenly", "[snow]") {
    SnowSettings settings = rich(20000.0);
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
    SnowSettings settings;
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
    SnowSettings settings;
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
