#include "motus/walker/ground.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
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

}  // namespace

TEST_CASE("rays meet what is first, of triangles and a plane", "[ground]") {
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

TEST_CASE("what is no ground is refused, and vertices that are nowhere are not met", "[ground]") {
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

TEST_CASE("where the ground ends a foot finds its side", "[footing]") {
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
    CHECK(obstacle(plane(), start, end, up, 1.0) == 0.0);
    CHECK(obstacle(plane(-3.0), start, end, up, 1.0) == 0.0);
    const auto hill = [](double x, double) { return 0.4 * std::max(0.0, 1.0 - 1.5 * std::abs(x)); };
    const Ground ground = ground_of(land(2.0, 200, hill));
    const double rise = obstacle(ground, start, end, up, 1.0);
    CHECK(rise >= 0.4);
    CHECK(rise < 0.6);
    for (double u = 0.0; u <= 1.0; u += 0.01) {
        const glm::dvec3 foot = start + (end - start) * along(u) + rise * above(u) * up;
        CHECK(foot.z >= hill(foot.x, foot.y) - 0.03);
    }
}
