#include "lean.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "random.hpp"
#include "walkers.hpp"

using namespace motus::walker;
using motus::test::Random;

namespace {

constexpr glm::dvec3 up{0.0, 0.0, 1.0};

}  // namespace

TEST_CASE("a body follows the plane that its feet stand on", "[lean]") {
    Random random(4);
    for (int trial = 0; trial < 100; ++trial) {
        const glm::dquat turn = random.any_rotation();
        const glm::dvec3 origin = random.in_cube(5.0);
        const Axes axes{turn * glm::dvec3(1.0, 0.0, 0.0), turn * glm::dvec3(0.0, 1.0, 0.0), turn * up};
        const Lean wanted{random.between(-1.0, 1.0), random.between(-0.7, 0.7), random.between(-0.7, 0.7)};
        std::vector<glm::dvec3> rest, feet;
        std::vector<double> weights;
        for (int leg = 0; leg < 6; ++leg) {
            const glm::dvec3 place = random.in_cube(), beside = 0.1 * random.in_cube();
            const glm::dvec3 foot(place.x + beside.x, place.y + beside.y, 0.0);
            const double above = wanted.height + wanted.side * foot.x + wanted.ahead * foot.y;
            rest.push_back(origin + turn * glm::dvec3(place.x, place.y, 0.3));
            feet.push_back(origin + turn * glm::dvec3(foot.x, foot.y, 0.3 + above));
            weights.push_back(random.between(0.1, 1.0));
        }
        const Lean found = lean_of(origin, axes, rest, feet, weights);
        CHECK(found.height == Approx(wanted.height).margin(1e-6));
        CHECK(found.side == Approx(wanted.side).margin(1e-6));
        CHECK(found.ahead == Approx(wanted.ahead).margin(1e-6));

        const glm::dvec3 normal = glm::normalize(axes.up - found.side * axes.side - found.ahead * axes.ahead);
        CHECK(glm::length(turn_of(found, axes) * axes.up - normal) < 1e-12);
        CHECK(glm::length(turn_of(found, axes)) == Approx(1.0));
    }
}

TEST_CASE("rest places that are in no plane are level all the same", "[lean]") {
    Random random(5);
    std::vector<glm::dvec3> rest;
    for (int leg = 0; leg < 6; ++leg) rest.push_back(random.in_cube());
    const std::vector<double> weights{1.0, 0.2, 1.0, 0.5, 1.0, 1.0};
    const Lean level = lean_of({0.1, 0.2, 0.3}, {}, rest, rest, weights);
    CHECK(std::abs(level.height) + std::abs(level.side) + std::abs(level.ahead) < 1e-9);
    std::vector<glm::dvec3> higher = rest;
    for (glm::dvec3& foot : higher) foot.z += 0.4;
    CHECK(lean_of({0.1, 0.2, 0.3}, {}, rest, higher, weights).height == Approx(0.4));
}

TEST_CASE("a slope that the feet leave undetermined is level", "[lean]") {
    const std::vector<double> weights{1.0, 1.0};
    const std::vector<glm::dvec3> rest{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
    const std::vector<glm::dvec3> feet{{-1.0, 0.0, 0.1}, {1.0, 0.0, 0.5}};
    const Lean two = lean_of({0.0, 0.0, 1.0}, {}, rest, feet, weights);
    CHECK(two.height == Approx(0.3));
    CHECK(two.side == Approx(0.2));
    CHECK(two.ahead == 0.0);
    const Lean one = lean_of({0.0, 0.0, 1.0}, {}, {rest.data(), 1}, {feet.data(), 1}, {weights.data(), 1});
    CHECK(one.height == Approx(0.1));
    CHECK((one.side == 0.0 && one.ahead == 0.0));
    CHECK(turn_of(one, {}) == glm::dquat(1.0, 0.0, 0.0, 0.0));
}

TEST_CASE("the fitted plane weighs each foot by its weight", "[lean]") {
    const std::vector<glm::dvec3> rest = eight_feet();
    std::vector<glm::dvec3> feet = rest;
    std::vector<double> weights(8, 1.0);
    feet[2].z = 1.0;
    const Lean whole = lean_of(glm::dvec3(0.0), {}, rest, feet, weights);
    weights[2] = 0.0;
    const Lean none = lean_of(glm::dvec3(0.0), {}, rest, feet, weights);
    CHECK(whole.height == Approx(0.125));
    CHECK(std::abs(none.height) < 1e-12);
}
