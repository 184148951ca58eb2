#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "walkers.hpp"

using namespace motus::walker;

namespace {

constexpr std::size_t leg = 3;
const glm::dvec3 offset{0.15, -0.1, 0.0};

/// Along a circle at 1 m/s, upright.
glm::dmat4 turning(double time) {
    const double turned = 0.5 * time;
    return glm::rotate(moved({2.0 * std::cos(turned), 2.0 * std::sin(turned), 0.0}), turned, {0.0, 0.0, 1.0});
}

Walker walking(const std::vector<ChosenStep>& chosen, WalkSettings settings = {}) {
    static const Ground ground = hilly_ground();
    settings.chosen = chosen;
    return {way_along(6.0, turning), settings, &ground};
}

/// The step of the leg that begins as it does.
const Footstep& step_from(const Walker& walker, double lift) {
    return step_at(walker.steps(leg), lift);
}

void check_same(const Footstep& one, const Footstep& other) {
    CHECK(one.lift == other.lift);
    CHECK(one.touch == other.touch);
    CHECK(one.start == other.start);
    CHECK(one.end == other.end);
    CHECK(one.end_turn == other.end_turn);
}

}  // namespace

TEST_CASE("a chosen step finds ground where it is moved to, and the plan around it follows", "[chosen]") {
    const Walker planned = walking({});
    const Footstep before = planned.steps(leg)[4], next = planned.steps(leg)[5];
    const glm::dmat4 pose = turning(before.middle);
    const glm::dvec3 wanted = in_world(pose, eight_feet()[leg] + offset);
    // At any time of the swing and the stand.
    for (const double time :
         {before.lift, 0.5 * (before.lift + before.touch), before.touch, before.middle, next.lift - 1e-9}) {
        const Walker walker = walking({{leg, time, offset, 0.0, std::nullopt}});
        REQUIRE(walker.steps(leg).size() == planned.steps(leg).size());
        for (std::size_t other = 0; other < 8; ++other) {
            for (std::size_t i = 0; i < planned.steps(other).size(); ++i) {
                const Footstep& step = walker.steps(other)[i];
                const bool is_chosen = other == leg && i == 4;
                CHECK(step.chosen == (is_chosen ? std::optional<std::size_t>(0) : std::nullopt));
                if (other != leg || i < 4 || i > 5) check_same(step, planned.steps(other)[i]);
            }
        }
        const Footstep& step = walker.steps(leg)[4];
        const Footstep& after = walker.steps(leg)[5];
        // Linear between samples, and between the vertices of the ground.
        CHECK(glm::distance(glm::dvec2(step.end), glm::dvec2(wanted)) < 1e-3);
        CHECK(step.end.z == Approx(hills(step.end.x, step.end.y)).margin(0.02));
        CHECK(after.start == step.end);
        CHECK(after.end == next.end);
        CHECK(walker.foot(leg, before.middle).position == step.end);
        CHECK(walker.body(before.middle).offset != planned.body(before.middle).offset);
    }
    // Before the foot lifts, the step before is the one.
    const Walker earlier = walking({{leg, before.lift - 1e-9, offset, 0.0, std::nullopt}});
    CHECK(earlier.steps(leg)[3].chosen.has_value());
    CHECK(earlier.steps(leg)[4].end == before.end);
}

TEST_CASE("each step is chosen by the middle of its stand", "[chosen]") {
    const Ground level = plane();
    for (const auto& pose : {turning, there}) {
        const Way way = way_along(6.0, pose);
        const Walker planned(way, {}, &level);
        for (std::size_t row = 0; row < planned.steps(leg).size(); ++row) {
            WalkSettings settings;
            settings.chosen = {{leg, planned.steps(leg)[row].middle, {}, 0.1, std::nullopt}};
            const Walker walker(way, settings, &level);
            REQUIRE(walker.steps(leg).size() == planned.steps(leg).size());
            for (std::size_t i = 0; i < planned.steps(leg).size(); ++i)
                CHECK(walker.steps(leg)[i].chosen.has_value() == (i == row));
        }
    }
}

TEST_CASE("next to a jump each step is chosen by its planned time, and lifts before the jump", "[chosen]") {
    const Ground level = plane();
    for (const auto& pose : {turning, there, around}) {
        for (const std::size_t reset :
             {std::size_t(30), std::size_t(61), std::size_t(96), std::size_t(107)}) {
            Way way = way_along(6.0, pose);
            way.resets = {reset, reset + 25};
            const Walker planned(way, {}, &level);
            for (std::size_t of_leg = 0; of_leg < 8; ++of_leg) {
                const auto steps = planned.steps(of_leg);
                for (std::size_t row = 0; row < steps.size(); ++row) {
                    WalkSettings settings;
                    settings.chosen = {{of_leg, steps[row].planned, {}, 0.1, std::nullopt}};
                    const Walker walker(way, settings, &level);
                    REQUIRE(walker.steps(of_leg).size() == steps.size());
                    for (std::size_t i = 0; i < steps.size(); ++i)
                        REQUIRE(walker.steps(of_leg)[i].chosen.has_value() == (i == row));
                    // Each stretch begins with a step that is put.
                    if (row == 0 || steps[row].lift == steps[row].touch) continue;
                    const auto jump = std::ranges::upper_bound(way.resets, steps[row].planned, {},
                                                               [&](std::size_t at) { return way.times[at]; });
                    if (jump != way.resets.end()) CHECK(steps[row].lift < way.times[*jump]);
                }
            }
        }
    }
}

TEST_CASE("a fixed step stands where it is told, whatever body and ground do", "[chosen]") {
    const double lift = walking({}).steps(leg)[4].lift;
    // On a stool on which there is no ground.
    const Stand stand{{0.4, 2.3, 0.7}, 2.0 * glm::angleAxis(0.4, glm::dvec3(0.6, 0.0, 0.8))};
    const Walker walker = walking({{leg, lift, offset, 0.0, stand}});
    const Footstep& step = step_from(walker, lift);
    CHECK(step.end == stand.place);
    CHECK(glm::length(step.end_turn) == Approx(1.0));
    CHECK(glm::dot(step.end_turn, stand.turn) == Approx(2.0));
    CHECK(glm::distance(step.end_normal, step.end_turn * glm::dvec3(0.0, 0.0, 1.0)) < 1e-12);
    for (const double time : {step.touch, step.middle}) {
        const Foot foot = walker.foot(leg, time);
        CHECK(foot.position == stand.place);
        CHECK(foot.turn == step.end_turn);
    }
}

TEST_CASE("a chosen step is turned about the ground's normal", "[chosen]") {
    const Footstep flat = walking({}).steps(leg)[4];
    const Footstep turned = walking({{leg, flat.middle, {}, 0.3, std::nullopt}}).steps(leg)[4];
    CHECK(turned.end == flat.end);
    const glm::dvec3 ahead = flat.end_turn * glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 wanted = std::cos(0.3) * ahead + std::sin(0.3) * glm::cross(flat.end_normal, ahead);
    CHECK(glm::distance(turned.end_turn * glm::dvec3(0.0, 1.0, 0.0), wanted) < 1e-9);
    CHECK(glm::distance(turned.end_turn * glm::dvec3(0.0, 0.0, 1.0), flat.end_normal) < 1e-9);
}

TEST_CASE("while the body rests a foot has one stand, which is chosen as a whole", "[chosen]") {
    const Ground level = plane();
    const auto stops = [](double time) {
        return moved({0.0, std::min(time, 2.0) + std::max(0.0, time - 8.0), 0.0});
    };
    const Way way = way_along(10.0, stops);
    const Walker planned(way, {}, &level);
    const Footstep resting = step_at(planned.steps(leg), 5.0);
    for (const double time : {resting.touch, 4.0, 5.0, 7.0}) {
        for (const double minimum : {0.0, 0.1}) {
            WalkSettings settings;
            settings.minimum_step = minimum;
            settings.chosen = {{leg, time, {0.05, 0.0, 0.0}, 0.0, std::nullopt}};
            const Walker walker(way, settings, &level);
            for (const double at : {3.8, 5.0, 7.0})
                CHECK(glm::distance(walker.foot(leg, at).position, resting.end + glm::dvec3(0.05, 0.0, 0.0)) <
                      1e-9);
        }
    }
}

TEST_CASE("of several chosen steps for one stand the last one counts", "[chosen]") {
    const Footstep step = walking({}).steps(leg)[4];
    const ChosenStep one{leg, step.touch, offset, 0.0, std::nullopt};
    const ChosenStep other{leg, step.middle, -offset, 0.0, std::nullopt};
    const Footstep both = walking({one, other}).steps(leg)[4];
    CHECK(both.chosen == std::optional<std::size_t>(1));
    CHECK(both.end == walking({other}).steps(leg)[4].end);
}

TEST_CASE("a chosen step stays where its leg does not reach, which is told", "[chosen]") {
    WalkSettings settings;
    settings.hips.assign(8, glm::dvec3(0.0, 0.0, 0.5));
    settings.lengths.assign(8, 2.0);
    const Walker planned = walking({}, settings);
    REQUIRE(planned.problems().empty());
    const Footstep step = planned.steps(leg)[4];
    const Walker walker = walking({{leg, step.middle, {3.0, 0.0, 0.0}, 0.0, std::nullopt}}, settings);
    REQUIRE(walker.problems().size() == 1);
    CHECK(walker.problems()[0].leg == leg);
    CHECK(walker.problems()[0].trouble == Trouble::out_of_reach);
    CHECK(walker.problems()[0].first >= step.touch);
    CHECK(glm::distance(walker.steps(leg)[4].end, step.end) > 2.5);
}

TEST_CASE("invalid chosen steps are refused", "[chosen]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const ChosenStep good{leg, 1.0, offset, 0.1, Stand{}};
    CHECK_NOTHROW(walking({good}));
    const auto refused = [&](const auto& spoil) {
        ChosenStep step = good;
        spoil(step);
        CHECK_THROWS_WITH(walking({step}), Catch::StartsWith("chosen: must have"));
    };
    refused([](ChosenStep& step) { step.leg = 8; });
    refused([&](ChosenStep& step) { step.time = nan; });
    refused([](ChosenStep& step) { step.offset.x = 1e13; });
    refused([&](ChosenStep& step) { step.turn = nan; });
    refused([&](ChosenStep& step) { step.fixed->place.z = nan; });
    refused([](ChosenStep& step) { step.fixed->turn = {0.0, 0.0, 0.0, 0.0}; });
}
