#include "motus/bones/turns.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus::bones;
using motus::test::Random;

namespace {

std::vector<glm::dquat> turned(const std::vector<glm::dvec3>& before, const std::vector<glm::dvec3>& after) {
    std::vector<glm::dquat> turns(before.size());
    turn_links(before, after, turns);
    return turns;
}

}  // namespace

TEST_CASE("links of a row turn to their directions, and no more than they need beneath the links above",
          "[turns]") {
    Random random(11);
    for (int time = 0; time < 200; ++time) {
        std::vector<glm::dvec3> before, after;
        for (int link = 0; link < 6; ++link) {
            before.push_back(random.in_cube(2.0));
            after.push_back(random.in_cube(2.0));
        }
        const std::vector<glm::dquat> turns = turned(before, after);
        glm::dquat above = no_turn;
        for (std::size_t i = 0; i < turns.size(); ++i) {
            CHECK(glm::length(turns[i]) == Approx(1.0).epsilon(1e-14));
            CHECK(angle_between(turns[i] * before[i], after[i]) < 1e-13);
            // The smallest turn is as large as the angle between both directions.
            CHECK(angle_of_turn(turns[i] * glm::conjugate(above)) ==
                  Approx(angle_between(above * before[i], after[i])).margin(1e-7));
            above = turns[i];
        }
    }
}

TEST_CASE("links that hang straight as before do not turn, and those that are bent as one turn as one",
          "[turns]") {
    const std::vector<glm::dvec3> before{{0.0, 1.0, 0.0}, {0.0, 2.0, 1.0}, {0.5, 0.0, 3.0}};
    for (const glm::dquat& turn : turned(before, before)) CHECK(turn == no_turn);
    const glm::dquat whole = glm::angleAxis(1.1, glm::dvec3(1.0, 0.0, 0.0));  // across the first link
    std::vector<glm::dvec3> after;
    for (const glm::dvec3& link : before) after.push_back(3.0 * (whole * link));
    for (const glm::dquat& turn : turned(before, after))
        CHECK(angle_of_turn(turn * glm::conjugate(whole)) < 1e-14);
}

TEST_CASE("links that point back turn by half a turn, and those without a length with the link above",
          "[turns]") {
    const glm::dvec3 none(0.0);
    const double nan = std::numeric_limits<double>::quiet_NaN(), huge = 1e300, tiny = 1e-300;
    for (const glm::dvec3& link :
         {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, -2.0, 0.0), glm::dvec3(0.1, 0.2, 0.3)}) {
        const std::vector<glm::dquat> turns = turned({link, none, link}, {-link, link, none});
        CHECK(angle_of_turn(turns[0]) == Approx(3.14159265358979));
        CHECK(glm::distance(turns[0] * link, -link) < 1e-14);
        CHECK(turns[1] == turns[0]);
        CHECK(turns[2] == turns[0]);
        CHECK(turned({link}, {glm::dvec3(nan)})[0] == no_turn);
        for (const double size : {huge, tiny})
            CHECK(angle_of_turn(turned({link * size}, {-link * size})[0]) == Approx(3.14159265358979));
    }
    CHECK(turned({}, {}).empty());
    std::array<glm::dquat, 1> one{};
    CHECK_THROWS_AS(turn_links({}, {}, one), std::invalid_argument);
    CHECK_THROWS_AS(turn_links(std::array{none}, {}, one), std::invalid_argument);
}
