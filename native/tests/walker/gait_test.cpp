#include "motus/walker/gait.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus::walker;
using motus::test::Random;

namespace {

constexpr Gait all_gaits[] = {Gait::tripod, Gait::tetrapod, Gait::ripple, Gait::wave,
                              Gait::trot,   Gait::pace,     Gait::walk,   Gait::run,
                              Gait::canter, Gait::gallop,   Gait::hop};
constexpr glm::dvec3 forward{0.0, 1.0, 0.0}, up{0.0, 0.0, 1.0};

/// L1 R1 L2 R2 ..., from the front.
std::vector<glm::dvec3> pairs(int rows) {
    std::vector<glm::dvec3> rest;
    for (int row = 0; row < rows; ++row)
        for (const double x : {-1.0, 1.0}) rest.emplace_back(x, -0.5 * row, 0.0);
    return rest;
}

/// The legs that swing at a phase.
std::vector<int> swinging(const Pattern& pattern, double phase) {
    std::vector<int> legs;
    for (std::size_t leg = 0; leg < pattern.phases.size(); ++leg) {
        const double at = phase + pattern.phases[leg];
        if (at - std::floor(at) < 1.0 - pattern.duty) legs.push_back(static_cast<int>(leg));
    }
    return legs;
}

}  // namespace

TEST_CASE("neighbours alternate in tripods and tetrapods", "[gait]") {
    const Pattern six = pattern_of(Gait::tripod, pairs(3), forward, up);
    CHECK(six.duty == 0.5);
    CHECK(swinging(six, 0.1) == std::vector{0, 3, 4});  // L1 R2 L3
    CHECK(swinging(six, 0.6) == std::vector{1, 2, 5});
    const Pattern eight = pattern_of(Gait::tetrapod, pairs(4), forward, up);
    CHECK(swinging(eight, 0.1) == std::vector{0, 3, 4, 7});  // L1 R2 L3 R4
    CHECK(swinging(eight, 0.6) == std::vector{1, 2, 5, 6});
    CHECK(swinging(eight, 0.45).empty());
    CHECK(swinging(eight, 0.95).empty());
}

TEST_CASE("a trot goes by diagonals, a pace by sides", "[gait]") {
    CHECK(swinging(pattern_of(Gait::trot, pairs(2), forward, up), 0.2) == std::vector{0, 3});
    CHECK(swinging(pattern_of(Gait::trot, pairs(4), forward, up), 0.2) == std::vector{0, 2, 5, 7});
    CHECK(swinging(pattern_of(Gait::pace, pairs(4), forward, up), 0.2) == std::vector{0, 2, 4, 6});
    CHECK(swinging(pattern_of(Gait::pace, pairs(4), forward, up), 0.7) == std::vector{1, 3, 5, 7});
}

TEST_CASE("the gaits of horses touch down as Hildebrand and Alexander say", "[gait]") {
    // Cycles from the first touch-down on: left and right fore legs, left and right hind legs.
    const auto touches = [](Gait gait) {
        std::vector<double> found;
        const Pattern pattern = pattern_of(gait, pairs(2), forward, up);
        for (const double phase : pattern.phases) found.push_back(phase > 0.0 ? 1.0 - phase : 0.0);
        return found;
    };
    const auto is = [&](Gait gait, const std::vector<double>& wanted) {
        const std::vector<double> found = touches(gait);
        for (std::size_t leg = 0; leg < 4; ++leg) CHECK(found[leg] == Approx(wanted[leg]).margin(1e-12));
    };
    is(Gait::walk, {0.25, 0.75, 0.0, 0.5});  // hind, fore of the same side, hind, fore
    is(Gait::canter, {0.6, 0.3, 0.3, 0.0});  // a hind leg, a diagonal, the leading fore leg
    is(Gait::gallop, {0.5, 0.3, 0.1, 0.0});
    is(Gait::hop, {0.0, 0.0, 0.0, 0.0});
    for (const Gait gait : {Gait::canter, Gait::gallop}) {
        // The leading fore leg leaves the ground before the first hind leg comes down again.
        CHECK(touches(gait)[0] + pattern_of(gait, pairs(2), forward, up).duty < 0.99);
    }
}

TEST_CASE("on two legs a walk has both feet on the ground at times, a run none", "[gait]") {
    const Pattern walk = pattern_of(Gait::walk, pairs(1), forward, up),
                  run = pattern_of(Gait::run, pairs(1), forward, up);
    std::set<std::size_t> walking, running;
    for (int part = 0; part < 100; ++part) {
        walking.insert(swinging(walk, part / 100.0).size());
        running.insert(swinging(run, part / 100.0).size());
    }
    CHECK(walking == std::set<std::size_t>{0, 1});
    CHECK(running == std::set<std::size_t>{1, 2});
    CHECK(std::abs(walk.phases[0] - walk.phases[1]) == 0.5);
    CHECK(std::abs(run.phases[0] - run.phases[1]) == 0.5);
}

TEST_CASE("in a wave one leg swings at a time, from the back to the front", "[gait]") {
    for (const int rows : {1, 2, 3, 4}) {
        const Pattern wave = pattern_of(Gait::wave, pairs(rows), forward, up);
        std::vector<int> order;
        for (int part = 0; part < 2 * rows; ++part) {
            const std::vector<int> legs = swinging(wave, (part + 0.5) / (2.0 * rows));
            REQUIRE(legs.size() == 1);
            order.push_back(legs[0]);
        }
        std::vector<int> wanted;
        for (const int side : {0, 1})
            for (int row = rows - 1; row >= 0; --row) wanted.push_back(2 * row + side);
        CHECK(order == wanted);
    }
}

TEST_CASE("a ripple runs forwards on both sides, and no two legs lift together", "[gait]") {
    for (const int rows : {2, 3, 4, 5, 8}) {
        const Pattern ripple = pattern_of(Gait::ripple, pairs(rows), forward, up);
        std::vector<double> lifts;
        for (const double phase : ripple.phases) lifts.push_back(1.0 - phase);
        for (int row = 0; row + 1 < rows; ++row) {
            for (const int side : {0, 1}) {
                const auto leg = static_cast<std::size_t>(2 * row + side);
                const double later = lifts[leg] - lifts[leg + 2];
                CHECK(later - std::floor(later) == Approx(1.0 / rows));
            }
        }
        std::ranges::sort(lifts);
        for (std::size_t i = 1; i < lifts.size(); ++i) CHECK(lifts[i] - lifts[i - 1] > 0.4 / (2 * rows));
    }
}

TEST_CASE("legs are told by where they are, not by their order", "[gait]") {
    Random random(5);
    for (const Gait gait : all_gaits) {
        const std::vector<glm::dvec3> rest = pairs(4);
        const Pattern usual = pattern_of(gait, rest, forward, up);
        std::vector<std::size_t> order{0, 1, 2, 3, 4, 5, 6, 7};
        random.shuffle(std::span(order));
        std::vector<glm::dvec3> mixed;
        // Turned so that forward is -X, and far away.
        for (const std::size_t leg : order) mixed.emplace_back(50.0 - rest[leg].y, rest[leg].x, 3.0);
        const Pattern found = pattern_of(gait, mixed, {-2.0, 0.0, 0.0}, {0.0, 0.0, 0.5});
        CHECK(found.duty == usual.duty);
        for (std::size_t i = 0; i < order.size(); ++i) CHECK(found.phases[i] == usual.phases[order[i]]);
    }
}

TEST_CASE("every gait is defined for any number of legs", "[gait]") {
    Random random(6);
    for (const Gait gait : all_gaits) {
        for (const int legs : {1, 2, 3, 5, 7, 16, 256}) {
            std::vector<glm::dvec3> rest;
            for (int leg = 0; leg < legs; ++leg) rest.push_back(random.in_cube());
            const Pattern pattern = pattern_of(gait, rest, forward, up);
            REQUIRE(pattern.phases.size() == rest.size());
            CHECK(std::ranges::all_of(pattern.phases, [](double p) { return p >= 0.0 && p < 1.0; }));
            CHECK((pattern.duty >= least_duty && pattern.duty <= most_duty));
        }
    }
}

TEST_CASE("legs in one line alternate", "[gait]") {
    const std::vector<glm::dvec3> line{{0, 3, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0, 0}};
    const Pattern pace = pattern_of(Gait::pace, line, forward, up);
    CHECK(swinging(pace, 0.2) == std::vector{0, 2});
    const std::vector<glm::dvec3> tailed{{-1, 1, 0}, {1, 1, 0}, {-1, 0, 0}, {0, -2, 0}};
    CHECK(swinging(pattern_of(Gait::pace, tailed, forward, up), 0.7) == std::vector{1, 3});
}

TEST_CASE("invalid sets of legs are refused", "[gait]") {
    const std::vector<glm::dvec3> none, many(most_legs + 1, glm::dvec3(0.0));
    std::vector<glm::dvec3> strange = pairs(2);
    strange[1].x = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(pattern_of(Gait::wave, none, forward, up), Catch::Contains("rest"));
    CHECK_THROWS_WITH(pattern_of(Gait::wave, many, forward, up), Catch::Contains("rest"));
    CHECK_THROWS_WITH(pattern_of(Gait::wave, strange, forward, up), Catch::Contains("rest"));
    CHECK_THROWS_WITH(pattern_of(Gait::wave, pairs(2), glm::dvec3(0.0), up), Catch::Contains("forward"));
    CHECK_THROWS_WITH(pattern_of(Gait::wave, pairs(2), forward, -2.0 * forward), Catch::Contains("up"));
}
