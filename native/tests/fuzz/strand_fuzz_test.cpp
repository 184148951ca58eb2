// Strands with numbers that nobody expects.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "extremes.hpp"
#include "motus/core/numeric.hpp"
#include "motus/strand/motion.hpp"

using namespace motus;
using namespace motus::strand;
using namespace motus::test;

TEST_CASE("strands of arbitrary numbers are refused or stay finite", "[fuzz]") {
    Dice dice(47, 0.02);
    int solved = 0;
    for (int round = 0; round < 400; ++round) {
        const std::size_t count = 1 + dice.below(7), samples = 1 + dice.below(4);
        std::vector<Link> links(count);
        for (std::size_t i = 0; i < count; ++i) {
            links[i] = {static_cast<int>(dice.below(i + 1)) - 1,
                        dice.number(0.1, 2.0),
                        dice.number(0.0, 8.0),
                        dice.number(0.0, 2.0),
                        dice.number(-1.0, 2.0),
                        dice.number(0.0, 3.0),
                        dice.chance(0.5) ? 0.0 : dice.number(0.0, 1.0),
                        dice.chance(0.5) ? 0.0 : dice.number(0.0, 20.0),
                        dice.chance(0.5) ? std::numbers::pi : dice.number(0.0, 2.0),
                        dice.number(0.0, 0.1),
                        dice.chance(0.5) ? std::numbers::pi : dice.number(0.0, 2.0)};
        }
        std::vector<double> times = dice.numbers(samples, 0.0, 0.5);
        std::ranges::sort(times);
        const auto vectors = [&](std::size_t rows, double size) {
            std::vector<glm::dvec3> all(rows);
            for (glm::dvec3& one : all)
                one = {dice.number(-size, size), dice.number(-size, size), dice.number(-size, size)};
            return all;
        };
        std::vector<glm::dvec3> poses = vectors(samples * count, 1.0);
        if (dice.chance(0.3)) std::fill(poses.begin(), poses.end(), poses.front());  // links without a length
        const std::vector<glm::dvec3> gravity = vectors(dice.chance(0.5) ? 1 : samples, 10.0),
                                      air = vectors(1, 3.0);
        const std::vector<Obstacle> obstacles{
            {Obstacle::Shape::capsule, dice.number(0.0, 0.5), dice.number(0.0, 1.0)},
            {Obstacle::Shape::plane, 0.0, dice.number(0.0, 1.0)}};
        const std::vector<glm::dvec3> obstacle_places = vectors(4 * samples, 1.0),
                                      pin_places = vectors(samples, 1.0);
        const std::vector<std::size_t> pinned{dice.below(count)};
        const std::vector<double> pin_weights = dice.numbers(samples, 0.0, 1.0);
        const std::vector<glm::dvec3> sides = vectors(dice.chance(0.5) ? 0 : samples * count, 1.0);
        const Inputs inputs{.times = times,
                            .poses = poses,
                            .gravity = gravity,
                            .air = air,
                            .obstacles = obstacles,
                            .obstacle_places = obstacle_places,
                            .pinned = pinned,
                            .pin_places = pin_places,
                            .pin_weights = pin_weights,
                            .sides = sides,
                            .are_touching = dice.chance(0.5),
                            .friction = dice.number(0.0, 1.0)};
        returns([&] {
            Motion motion(links, inputs,
                          {.rate = dice.chance(0.1) ? dice.number(60.0, 1000.0) : 480.0,
                           .settle = dice.chance(0.2) ? 0.2 : 0.0,
                           .is_loop = dice.chance(0.2),
                           .cycles = 3});
            motion.solve(2000);
            std::vector<glm::dvec3> places(count);
            for (const double time : {0.0, 0.1, 0.37, 5.0}) {
                motion.places(time, places);
                for (const glm::dvec3& place : places) CHECK(is_finite(place));
            }
            ++solved;
        });
    }
    CHECK(solved > 50);
}
