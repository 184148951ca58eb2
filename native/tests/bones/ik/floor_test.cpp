#include "motus/bones/ik/floor.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "random.hpp"

using namespace motus;
using namespace motus::bones::ik;

namespace {

double height_of(const glm::dvec3& place, const Floor& floor) {
    return glm::dot(place - floor.place, glm::normalize(floor.up)) - floor.height;
}

}  // namespace

TEST_CASE("a target is lifted above the floor along its normal, by the formula", "[ik]") {
    test::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        Floor floor;
        floor.place = random.around_origin(2.0);
        floor.up = random.between(0.1, 5.0) * random.direction();
        floor.height = random.between(-0.5, 0.5);
        floor.margin = i % 3 == 0 ? 0.0 : random.between(0.0, 0.5);
        const glm::dvec3 target = random.around_origin(2.0);
        const glm::dvec3 lifted = above_floor(target, floor);
        const double before = height_of(target, floor), after = height_of(lifted, floor), b = floor.margin;
        CHECK(glm::length(glm::cross(lifted - target, floor.up)) < 1e-12);
        CHECK(after >= -1e-12);
        CHECK(after - before >= -1e-12);
        if (before >= b) CHECK(lifted == target);
        if (before <= -b) CHECK(std::abs(after) < 1e-12);
        if (std::abs(before) < b)
            CHECK(after == Approx((before + b) * (before + b) / (4.0 * b)).margin(1e-12));
    }
}

TEST_CASE("the margin has one continuous derivative", "[ik]") {
    Floor floor;
    floor.margin = 0.2;
    constexpr double step = 1e-4;
    double slope = 0.0;
    for (int i = -5000; i < 5000; ++i) {
        const double now = above_floor({0.0, 0.0, i * step}, floor).z;
        const double next = above_floor({0.0, 0.0, (i + 1) * step}, floor).z;
        const double slope_now = (next - now) / step;
        REQUIRE(slope_now >= slope - 1e-9);
        REQUIRE(slope_now - slope <= 1.01 * step / (2.0 * floor.margin));
        slope = slope_now;
    }
    CHECK(slope == Approx(1.0));
}

TEST_CASE("a floor that says nothing lifts nothing", "[ik]") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec3 target(0.3, 0.2, -1.0);
    CHECK(above_floor(target, {{0, 0, 0}, {0, 0, 0}, 0.0, 0.0}) == target);
    CHECK(above_floor(target, {{0, 0, 0}, {0, nan, 1}, 0.0, 0.0}) == target);
    CHECK(above_floor(target, {{0, nan, 0}, {0, 0, 1}, 0.0, 0.0}) == target);
    CHECK(above_floor(target, {{0, 0, 0}, {0, 0, 1}, nan, 0.0}) == target);
    CHECK(above_floor(target, {{0, 0, 0}, {0, 0, 1}, 0.0, nan}) == target);
    CHECK(above_floor(target, {{0, 0, 0}, {0, 0, 1}, 0.0, -1.0}) == glm::dvec3(0.3, 0.2, 0.0));
}
