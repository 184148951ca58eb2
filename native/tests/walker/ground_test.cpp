#include "motus/walker/ground.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "footing.hpp"
#include "motus/walker/step.hpp"
#include "random.hpp"
#include "walkers.hpp"

using namespace motus::walker;
using motus::test::Random;

namespace {

constexpr glm::dvec3 up{0.0, 0.0, 1.0};
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where a foot is at a fraction of a swing that passes over the ground.
[[nodiscard]] glm::dvec3 swung(const glm::dvec3& start, const glm::dvec3& end, const Clearing& over,
                               double u) {
    Footstep step;
    step.upwards = over.upwards;
    step.downwards = over.downwards;
    const double share = step.share(u);
    return (share >= 1.0 ? end : start + (end - start) * share) + over.rise * above(u) * up;
}

}  // namespace

TEST_CASE("a ray finds the first of the triangles and the plane that it meets", "[ground]") {
    const Land floor = land(2.0, 4, [](double, double) { return 0.5; });
    const Ground both(floor.positions, floor.triangles, Plane{{0.0, 0.0, 0.0}, {0.0, 0.0, -3.0}});
    const auto on_mesh = both.ray({0.3, 0.2, 2.0}, -up, infinity);
    REQUIRE(on_mesh);
    CHECK(glm::length(on_mesh->point - glm::dvec3(0.3, 0.2, 0.5)) < 1e-12);
    CHECK(on_mesh->normal == up);
    CHECK(on_mesh->distance == Approx(1.5));
    const auto beside = both.ray({3.0, 0.2, 2.0}, -up, infinity);
    REQUIRE(beside);
    CHECK(beside->point == glm::dvec3(3.0, 0.2, 0.0));
    CHECK(beside->normal == up);
    const auto from_below = both.ray({0.3, 0.2, -2.0}, up, infinity);
    REQUIRE(from_below);
    CHECK(from_below->normal == -up);
    CHECK(from_below->distance == 2.0);
    CHECK(both.ray({0.3, 0.2, 2.0}, -up, 1.51).has_value());
    CHECK_FALSE(both.ray({0.3, 0.2, 2.0}, -up, 1.49).has_value());
    CHECK_FALSE(both.ray({3.0, 0.2, 2.0}, up, infinity).has_value());
    CHECK_FALSE(both.ray({3.0, 0.2, 2.0}, {1.0, 0.0, 0.0}, infinity).has_value());
    CHECK(Ground({}, {}, std::nullopt).is_empty());
    CHECK_FALSE(Ground({}, {}, std::nullopt).ray({0.0, 0.0, 1.0}, -up, infinity).has_value());
}

TEST_CASE("invalid ground meshes are refused, and triangles with vertices at NaN are not met", "[ground]") {
    Land floor = land(1.0, 1, [](double, double) { return 0.0; });
    CHECK_THROWS_WITH(Ground(floor.positions, std::vector<glm::ivec3>{{0, 1, 4}}, std::nullopt),
                      Catch::StartsWith("triangles"));
    CHECK_THROWS_WITH(Ground(floor.positions, std::vector<glm::ivec3>{{0, -1, 2}}, std::nullopt),
                      Catch::StartsWith("triangles"));
    CHECK_THROWS_WITH(Ground({}, {}, Plane{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}), Catch::StartsWith("plane"));
    CHECK_THROWS_WITH(Ground({}, {}, Plane{{infinity, 0.0, 0.0}, up}), Catch::StartsWith("plane"));
    floor.positions[0].z = std::numeric_limits<float>::quiet_NaN();
    const Ground ground = ground_of(floor);
    CHECK_FALSE(ground.ray({-0.9, -0.9, 1.0}, -up, infinity).has_value());
}

TEST_CASE("a foot stands on the ground along the body's up, within reach", "[footing]") {
    Random random(2);
    const Ground ground = hilly_ground();
    for (int trial = 0; trial < 100; ++trial) {
        const glm::dvec3 rest(random.between(-5.0, 5.0), random.between(-5.0, 5.0), 0.0);
        const auto place = footing(ground, {rest, rest + glm::dvec3(0.4, 0.0, 0.3), up}, {1.0, 1.0});
        REQUIRE(place);
        CHECK(glm::length(glm::dvec2(place->point - rest)) < 1e-12);
        CHECK(place->point.z == Approx(hills(rest.x, rest.y)).margin(0.02));
        CHECK(place->normal.z > 0.5);
    }
    CHECK_FALSE(footing(plane(-1.1), {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.2}, up}, {1.0, 1.0}).has_value());
    CHECK(footing(plane(-0.9), {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.2}, up}, {1.0, 1.0}).has_value());
    // Above the reach it is a wall in the way or nothing.
    CHECK_FALSE(footing(plane(1.1), {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.2}, up}, {1.0, 1.0}).has_value());
}

TEST_CASE("a foot stands on a wall before it, not behind it", "[footing]") {
    const Land floor = land(4.0, 8, [](double, double) { return 0.0; });
    const Ground ground = ground_of(joined(floor, box({0.8f, -2.0f, 0.0f}, {0.9f, 2.0f, 3.0f})));
    const auto place = footing(ground, {{1.2, 0.1, 0.0}, {0.0, 0.0, 0.3}, up}, {0.5, 1.0});
    REQUIRE(place);
    CHECK(place->point.x == Approx(0.8));
    CHECK(place->normal.x == Approx(-1.0));
    CHECK(place->point.z == Approx(0.5));
}

TEST_CASE("a ray tells whether it leaves what it meets", "[ground]") {
    const Land cube = box({-1.0f, -1.0f, 0.0f}, {1.0f, 1.0f, 1.0f});
    const Ground ground(cube.positions, cube.triangles, Plane{{0.0, 0.0, -1.0}, up});
    for (const glm::dvec3& direction : {up, -up, glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, -1.0, 0.0)}) {
        const glm::dvec3 inside(0.1, 0.2, 0.4);
        CHECK(ground.ray(inside, direction, infinity)->leaves);
        CHECK_FALSE(ground.ray(inside - 1.3 * direction, direction, infinity)->leaves);
    }
    CHECK_FALSE(ground.ray({5.0, 0.0, 0.0}, -up, infinity)->leaves);
    CHECK(ground.ray({5.0, 0.0, -2.0}, up, infinity)->leaves);
}

TEST_CASE("below a roof a foot stands on the ground under the roof", "[footing]") {
    const Land floor = land(4.0, 8, [](double, double) { return 0.0; });
    const Land table = box({-1.0f, -1.0f, 0.3f}, {1.0f, 1.0f, 0.4f});
    const Land stone = box({0.2f, -0.3f, -0.1f}, {0.6f, 0.3f, 0.12f});
    const Land more = box({0.3f, -0.2f, 0.05f}, {0.5f, 0.2f, 0.16f});
    const Ground ground = ground_of(joined(joined(floor, table), joined(stone, more)));
    const Reach reach{0.5, 0.5};
    const auto height = [&](const glm::dvec3& rest, const glm::dvec3& hip) {
        const auto place = footing(ground, {rest, hip, up}, reach);
        return place ? place->point.z : infinity;
    };
    for (const double z : {-0.05, -1e-9, 0.0, 1e-9, 0.02}) {
        CHECK(height({-0.5, 0.1, z}, {0.0, 0.0, 0.2}) == Approx(0.0).margin(1e-6));
        CHECK(height({0.25, 0.1, z}, {0.0, 0.0, 0.2}) == Approx(0.12));
        CHECK(height({0.4, 0.1, z}, {0.0, 0.0, 0.2}) == Approx(0.16));
        // One of the two surfaces is not below the place.
        CHECK(height({-1.3, 0.1, z}, {-0.8, 0.0, 0.2}) == Approx(0.0).margin(1e-6));
        CHECK(height({-0.8, 0.1, z}, {-1.3, 0.0, 0.2}) == Approx(0.0).margin(1e-6));
    }
    // On the roof, and over hills that the hip is within.
    CHECK(height({0.4, 0.1, 0.38}, {0.0, 0.0, 0.6}) == Approx(0.4));
    CHECK(footing(plane(0.4), {{0.5, 0.0, 0.0}, {0.0, 0.0, 0.2}, up}, reach)->point.z == Approx(0.4));
    // Stones that stand on each other with a crack between, a roof without an upper side, a room.
    const Land crack = box({-3.0f, -3.0f, 0.13f}, {3.0f, 3.0f, 0.2f});
    const Ground stones = ground_of(joined(box({-3.0f, -3.0f, -0.1f}, {3.0f, 3.0f, 0.12f}), crack));
    CHECK(footing(stones, {{0.5, 0.0, 0.0}, {0.0, 0.0, 0.3}, up}, reach)->point.z == Approx(0.2));
    Land room = box({-3.0f, -3.0f, 0.0f}, {3.0f, 3.0f, 0.4f});
    for (glm::ivec3& corners : room.triangles) std::swap(corners.x, corners.y);
    CHECK(footing(ground_of(room), {{0.5, 0.0, 0.1}, {0.0, 0.0, 0.2}, up}, reach)->point.z ==
          Approx(0.0).margin(1e-6));
}

TEST_CASE("a swing below a roof stays below it", "[footing]") {
    const Land floor = land(4.0, 8, [](double, double) { return 0.0; });
    const Land stone = box({-0.1f, -1.0f, 0.0f}, {0.1f, 1.0f, 0.15f});
    const Ground ground =
        ground_of(joined(joined(floor, stone), box({-2.0f, -1.0f, 0.4f}, {2.0f, 1.0f, 0.5f})));
    const glm::dvec3 start(-0.5, 0.0, 0.0), end(0.5, 0.0, 0.0);
    const Clearing found = clearing(ground, start, end, up, 0.8);
    CHECK(found.upwards + found.downwards == 0.0);
    CHECK(found.rise < 0.16);
    for (double u = 0.0; u <= 1.0; u += 0.001) {
        const glm::dvec3 foot = swung(start, end, found, u);
        if (std::abs(foot.x) <= 0.1) CHECK(foot.z >= 0.15);
    }
}

TEST_CASE("ground whose faces are turned over is no roof", "[footing]") {
    const auto hill = [](double x, double) { return 0.4 * std::max(0.0, 1.0 - 1.5 * std::abs(x)); };
    Land turned = land(2.0, 200, hill);
    for (glm::ivec3& corners : turned.triangles) std::swap(corners.x, corners.y);
    const Ground ground = ground_of(turned), usual = ground_of(land(2.0, 200, hill));
    for (const double x : {-0.9, -0.3, 0.0, 0.2, 0.5}) {
        const Search search{{x, 0.1, -0.05}, {x - 0.2, 0.0, 0.2}, up};
        CHECK(footing(ground, search, {0.6, 0.5})->point.z == Approx(hill(x, 0.1)).margin(0.01));
    }
    const glm::dvec3 start(-1.0, 0.0, 0.0), end(1.0, 0.0, 0.0);
    CHECK(clearing(ground, start, end, up, 1.0).rise == clearing(usual, start, end, up, 1.0).rise);
}

TEST_CASE("beyond the edge of the ground a foot stands on the side of the block", "[footing]") {
    const Ground block = ground_of(box({-1.0f, -1.0f, -3.0f}, {1.0f, 1.0f, 0.0f}));
    const Search beyond{{1.3, 0.2, 0.0}, {0.5, 0.2, 0.4}, up};
    CHECK_FALSE(footing(block, beyond, {0.5, 0.6}).has_value());
    const auto place = footing_around_edge(block, beyond, {0.5, 0.6});
    REQUIRE(place);
    CHECK(place->point.x == Approx(1.0));
    CHECK(place->point.z == Approx(-0.6));
    CHECK(place->normal.x == Approx(1.0));
    const Ground sheet = ground_of(land(1.0, 2, [](double, double) { return 0.0; }));
    CHECK_FALSE(footing_around_edge(sheet, beyond, {0.5, 0.6}).has_value());
}

TEST_CASE("a swing rises as high as keeps it above the ground", "[footing]") {
    const glm::dvec3 start(-1.0, 0.0, 0.0), end(1.0, 0.0, 0.0);
    CHECK(clearing(plane(), start, end, up, 1.0).rise == 0.0);
    CHECK(clearing(plane(-3.0), start, end, up, 1.0).rise == 0.0);
    const auto hill = [](double x, double) { return 0.4 * std::max(0.0, 1.0 - 1.5 * std::abs(x)); };
    const Ground ground = ground_of(land(2.0, 200, hill));
    const Clearing found = clearing(ground, start, end, up, 1.0);
    CHECK(found.rise >= 0.4);
    CHECK(found.rise < 0.6);
    CHECK(found.upwards + found.downwards == 0.0);
    for (double u = 0.0; u <= 1.0; u += 0.01) {
        const glm::dvec3 foot = swung(start, end, found, u);
        CHECK(foot.z >= hill(foot.x, foot.y) - 0.03);
    }
}

TEST_CASE("a swing passes over the edges of stairs, up and down, however close to one it begins and ends",
          "[footing]") {
    constexpr double tread = 0.3, riser = 0.15;
    constexpr int stairs = 8;
    Land all;
    for (int i = 0; i < stairs; ++i) {
        const auto front = static_cast<float>(tread * i), top = static_cast<float>(riser * (i + 1));
        all = joined(all, box({-1.0f, front, -1.0f}, {1.0f, 3.0f, top}));
    }
    const Ground ground = ground_of(joined(all, land(6.0, 2, [](double, double) { return 0.0; })));
    const auto height = [&](double y) {
        double found = 0.0;
        for (int i = 0; i < stairs; ++i)
            if (y >= static_cast<double>(static_cast<float>(tread * i)))
                found = static_cast<double>(static_cast<float>(riser * (i + 1)));
        return found;
    };
    Random random(1);
    for (int round = 0; round < 300; ++round) {
        const auto place = [&] {
            // Half of the places are close to an edge, some within a micrometre.
            const double y = random.between(-0.4, 2.4), near = tread * std::floor(random.between(0.0, 7.0));
            const double by = std::pow(10.0, random.between(-6.0, -1.5)) * (random.chance(0.5) ? -1.0 : 1.0);
            const double chosen = random.chance(0.5) ? y : near + by;
            return glm::dvec3(random.between(-0.8, 0.8), chosen, height(chosen));
        };
        const glm::dvec3 start = place(), end = place();
        if (glm::length(end - start) < 0.01 || glm::length(end - start) > 0.8) continue;
        const Clearing found = clearing(ground, start, end, up, 2.0);
        double deepest = 0.0, highest = 0.0;
        for (double u = 0.0; u <= 1.0; u += 0.0005) {
            const glm::dvec3 foot = swung(start, end, found, u);
            deepest = std::max(deepest, height(foot.y) - foot.z);
            highest = std::max(highest, foot.z - std::max({start.z, end.z, height(0.5 * (start.y + end.y))}));
        }
        CAPTURE(start.y, end.y, found.rise, found.upwards, found.downwards);
        CHECK(deepest < 1e-6);
        CHECK(highest < 0.6);
    }
}
