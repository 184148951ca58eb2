// Steps that are set in time: when their feet touch down and lift, and how the steps around make room.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "random.hpp"
#include "timing.hpp"
#include "walkers.hpp"

using namespace motus::walker;
using motus::test::Random;

namespace {

constexpr std::size_t leg = 3, row = 4;
constexpr double speed = 1.0;

glm::dmat4 ahead(double time) {
    return moved({0.0, speed * time, 0.0});
}

/// Goes 2 m, rests from 2 s to 8 s, and goes on.
glm::dmat4 with_rest(double time) {
    return moved({0.0, std::min(time, 2.0) + std::max(0.0, time - 8.0), 0.0});
}

Walker walking(const Way& way, const std::vector<ChosenStep>& chosen) {
    static const Ground level = plane();
    WalkSettings settings;
    settings.chosen = chosen;
    return {way, settings, &level};
}

Walker walking(const std::vector<ChosenStep>& chosen) {
    return walking(way_along(8.0, ahead), chosen);
}

ChosenStep timed(const Footstep& step, std::optional<double> touch, std::optional<double> until) {
    ChosenStep chosen;
    chosen.leg = leg;
    chosen.time = step.planned;
    chosen.touch = touch;
    chosen.until = until;
    return chosen;
}

bool is_same(const Footstep& one, const Footstep& other) {
    return one.lift == other.lift && one.touch == other.touch && one.start == other.start &&
           one.end == other.end && one.end_turn == other.end_turn && one.middle == other.middle &&
           one.planned == other.planned;
}

/// Each foot stands with the same bits until it lifts, lifts after it has touched down, and moves without a
/// jump.
void check_walks(const Walker& walker, std::size_t of_leg = leg) {
    const auto steps = walker.steps(of_leg);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (i > 0) {
            REQUIRE(steps[i].lift < steps[i].touch);
            REQUIRE(steps[i - 1].touch <= steps[i].lift);
            REQUIRE(steps[i].start == steps[i - 1].end);
            for (const double moment : {steps[i].lift, steps[i].touch}) {
                const glm::dvec3 before = walker.foot(of_leg, moment - 1e-5).position;
                REQUIRE(glm::distance(before, walker.foot(of_leg, moment + 1e-5).position) < 1e-4);
            }
        }
        const double until = i + 1 < steps.size() ? steps[i + 1].lift : steps[i].touch + 1.0;
        for (const double share : {0.0, 0.3, 0.9})
            REQUIRE(walker.foot(of_leg, steps[i].touch + share * (until - steps[i].touch)).position ==
                    steps[i].end);
    }
}

}  // namespace

TEST_CASE("a timed step touches down and lifts when it is told, and the steps around make room", "[timed]") {
    const Walker planned = walking(std::vector<ChosenStep>{});
    const auto before = planned.steps(leg);
    const Footstep step = before[row], next = before[row + 1];
    const double cycle = next.lift - step.lift;
    for (const double later : {-0.3, 0.0, 0.2, 0.45}) {
        for (const double longer : {-0.2, 0.0, 0.3, 0.45}) {
            const double touch = step.touch + later * cycle, until = next.lift + longer * cycle;
            if (until - touch < 0.25 * (next.lift - step.touch)) continue;
            const Walker walker = walking({timed(step, touch, until)});
            const auto steps = walker.steps(leg);
            REQUIRE(steps.size() == before.size());
            CHECK(steps[row].touch == touch);
            CHECK(steps[row + 1].lift == until);
            CHECK(steps[row].chosen == std::optional<std::size_t>(0));
            CHECK(walker.problems().empty());
            check_walks(walker);
            // It stands where its rest place is in the middle of its stand.
            const double middle = 0.5 * (touch + until);
            CHECK(steps[row].middle == Approx(middle));
            CHECK(glm::distance(steps[row].end, in_world(ahead(middle), eight_feet()[leg])) < 1e-9);
            // Swings and stands around take half as long as planned at least.
            for (std::size_t i = 1; i < steps.size(); ++i) {
                CHECK(steps[i].planned == Approx(before[i].planned));
                if (i != row)
                    CHECK(steps[i].touch - steps[i].lift >= 0.499 * (before[i].touch - before[i].lift));
                if (i - 1 != row)
                    CHECK(steps[i].lift - steps[i - 1].touch >=
                          0.499 * (before[i].lift - before[i - 1].touch));
            }
            for (std::size_t other = 0; other < 8; ++other)
                if (other != leg)
                    CHECK(std::ranges::equal(walker.steps(other), planned.steps(other), is_same));
            CHECK(is_same(steps[1], before[1]));
            CHECK(is_same(steps[row + 3], before[row + 3]));
        }
    }
}

TEST_CASE("moments around a timed one are moved by half a cycle less for each cycle", "[timed]") {
    const Walker planned = walking(std::vector<ChosenStep>{});
    const auto before = planned.steps(leg);
    const double cycle = before[row + 1].lift - before[row].lift;
    const double shift = 0.4 * cycle;
    const Walker walker = walking({timed(before[row], before[row].touch + shift, std::nullopt)});
    const auto steps = walker.steps(leg);
    const auto wanted = [&](double moment) {
        return moment + std::max(0.0, shift - 0.5 * std::abs(moment - before[row].touch));
    };
    for (std::size_t i = 1; i < steps.size(); ++i) {
        CHECK(steps[i].lift == Approx(wanted(before[i].lift)).margin(1e-9));
        CHECK(steps[i].touch == Approx(wanted(before[i].touch)).margin(1e-9));
    }
}

TEST_CASE("a foot that stands for more than a cycle misses steps", "[timed]") {
    const Walker planned = walking(std::vector<ChosenStep>{});
    const auto before = planned.steps(leg);
    const Footstep step = before[row];
    const double cycle = before[row + 1].lift - step.lift;
    for (const int missed : {1, 2, 3}) {
        const double until = before[row + 1].lift + (missed + 0.2) * cycle;
        const Walker walker = walking({timed(step, std::nullopt, until)});
        const auto steps = walker.steps(leg);
        REQUIRE(steps.size() == before.size() - static_cast<std::size_t>(missed));
        CHECK(steps[row + 1].lift == until);
        CHECK(walker.foot(leg, until).position == walker.foot(leg, step.touch).position);
        CHECK(is_same(steps.back(), before.back()));
        check_walks(walker);
    }
    // Nor does it step before, if it lands a cycle earlier or later.
    for (const double later : {-1.1, 1.1}) {
        const double touch = step.touch + later * cycle;
        const Walker walker = walking({timed(step, touch, std::nullopt)});
        REQUIRE(walker.steps(leg).size() == before.size() - 1);
        const auto found = std::ranges::find(walker.steps(leg), touch, &Footstep::touch);
        REQUIRE(found != walker.steps(leg).end());
        CHECK(found->chosen == std::optional<std::size_t>(0));
        CHECK(found->planned == step.planned);
        CHECK(walker.problems().empty());
        check_walks(walker);
    }
}

TEST_CASE("a swing between two moments that are set is as long as they say", "[timed]") {
    const Walker planned = walking(std::vector<ChosenStep>{});
    const auto before = planned.steps(leg);
    const Footstep step = before[row], next = before[row + 1];
    const double cycle = next.lift - step.lift;
    for (const double later : {-0.2, 0.3, 0.6, 1.0, 1.4, 2.6}) {
        const double touch = next.touch + later * cycle;
        const Walker walker =
            walking({timed(step, std::nullopt, next.lift), timed(next, touch, std::nullopt)});
        const auto steps = walker.steps(leg);
        CHECK(steps[row + 1].lift == next.lift);
        CHECK(steps[row + 1].touch == touch);
        CHECK(steps[row + 1].planned == next.planned);
        CHECK(walker.problems().empty());
        CHECK(is_same(steps[row - 1], before[row - 1]));
        CHECK(is_same(steps.back(), before.back()));
        check_walks(walker);
    }
}

TEST_CASE("moments that cannot be are told, and left out", "[timed]") {
    const Walker planned = walking(std::vector<ChosenStep>{});
    const auto before = planned.steps(leg);
    const Footstep step = before[row], next = before[row + 1];
    // `kept`: the same steps with the moments that are possible, on which those that are not have no effect.
    const auto troubles = [&](const std::vector<ChosenStep>& chosen,
                              const std::vector<ChosenStep>& kept = {}) {
        const Walker walker = walking(chosen);
        check_walks(walker);
        for (std::size_t other = 0; other < 8; ++other)
            CHECK(std::ranges::equal(walker.steps(other), walking(kept).steps(other), is_same));
        std::vector<Trouble> found;
        for (const Problem& problem : walker.problems()) found.push_back(problem.trouble);
        return found;
    };
    using Troubles = std::vector<Trouble>;
    CHECK(troubles({timed(step, -3.0, std::nullopt)}) == Troubles{Trouble::no_touch});
    CHECK(troubles({timed(step, step.touch, step.touch - 0.1)}, {timed(step, step.touch, std::nullopt)}) ==
          Troubles{Trouble::no_lift});
    CHECK(troubles({timed(before[0], 0.5, std::nullopt)}) == Troubles{Trouble::no_touch});
    for (const double rested : {8.5, 10.0, 20.0, 1e300})
        CHECK(troubles({timed(before.back(), std::nullopt, rested)}) == Troubles{Trouble::no_lift});
    // What comes of no step does not keep others from their moments.
    const ChosenStep later = timed(step, step.touch + 0.1, next.lift + 0.1);
    CHECK(troubles({later, timed(before.back(), std::nullopt, 20.0)},
                   {later, timed(before.back(), std::nullopt, std::nullopt)}) == Troubles{Trouble::no_lift});
    // Each foot stands until after the next one is to touch down.
    CHECK(troubles({timed(step, std::nullopt, next.touch), timed(next, step.touch, std::nullopt)},
                   {timed(step, std::nullopt, next.touch), timed(next, std::nullopt, std::nullopt)}) ==
          Troubles{Trouble::no_touch});
    // A chosen step without times is left out if the foot still stands where it stood before.
    const ChosenStep moved{leg, next.middle, {0.1, 0.0, 0.0}},
        held = timed(step, std::nullopt, next.middle + 2.0);
    CHECK(troubles({moved}, {moved}).empty());
    CHECK(troubles({held, moved}, {held}) == Troubles{Trouble::left_out});
    CHECK(walking({held, moved}).problems().front().first == next.middle);
    // Of several for one stand the last one counts.
    CHECK(troubles({timed(step, -3.0, std::nullopt), timed(step, step.touch, std::nullopt)},
                   {timed(step, step.touch, std::nullopt)})
              .empty());
}

TEST_CASE("a body that rests has its feet on their rest places in the end", "[timed]") {
    const Way way = way_along(12.0, with_rest);
    const Walker planned = walking(way, {});
    const auto before = planned.steps(leg);
    const Footstep resting = step_at(before, 5.0), last = before.back();
    for (const double touch : {last.touch - 0.4, last.touch + 0.6}) {
        const Walker walker = walking(way, {timed(last, touch, std::nullopt)});
        check_walks(walker);
        CHECK(walker.problems().empty());
        CHECK(glm::distance(walker.foot(leg, 20.0).position, in_world(with_rest(12.0), eight_feet()[leg])) <
              1e-9);
    }
    const double goes = step_at(before, 9.0).lift;
    for (const double until : {goes + 0.3, goes + 1.0}) {
        const Walker walker = walking(way, {timed(resting, resting.touch - 0.1, until)});
        check_walks(walker);
        CHECK(walker.problems().empty());
        CHECK(walker.foot(leg, until).position == walker.foot(leg, resting.touch).position);
    }
}

TEST_CASE("a foot steps long after the body has come to rest, and walks as planned before", "[timed]") {
    const Walker planned = walking(std::vector<ChosenStep>{});
    const auto before = planned.steps(leg);
    const Footstep last = before.back();
    // It stands on its rest place before that, so there is no step.
    for (const double touch : {12.0, 20.0, 20.3, 333.3, 1e5, 1e300}) {
        const Walker walker = walking({timed(last, touch, std::nullopt)});
        CHECK(std::ranges::equal(walker.steps(leg), before, is_same));
        REQUIRE(walker.problems().size() == 1);
        CHECK(walker.problems()[0].trouble == Trouble::no_touch);
    }
    // A foot that stands elsewhere steps.
    ChosenStep early = timed(before[before.size() - 2], 30.0, 40.0), late = timed(last, 50.0, std::nullopt);
    early.offset = {0.2, 0.0, 0.0};
    const Walker walker = walking({early, late});
    const auto steps = walker.steps(leg);
    REQUIRE(steps.size() == before.size());
    for (std::size_t i = 0; i + 3 < steps.size(); ++i) CHECK(is_same(steps[i], before[i]));
    CHECK(steps[steps.size() - 2].touch == 30.0);
    CHECK(steps.back().touch == 50.0);
    CHECK(steps.back().lift == 40.0);
    CHECK(steps.back().end == last.end);
    CHECK(walker.problems().empty());
    check_walks(walker);
    // A foot that is put aside goes back to its rest place when it is told to lift.
    ChosenStep aside = timed(last, std::nullopt, 60.0);
    aside.offset = {0.3, 0.0, 0.0};
    const Walker goes_back = walking({aside});
    CHECK(goes_back.steps(leg).size() == before.size() + 1);
    CHECK(goes_back.steps(leg).back().lift == 60.0);
    CHECK(glm::distance(goes_back.steps(leg).back().end, last.end) < 1e-9);
    CHECK(goes_back.problems().empty());
    check_walks(goes_back);
}

TEST_CASE("steps that are timed at random never overlap", "[timed]") {
    Random random(7);
    Way way = way_along(10.0, [](double time) {
        return moved({0.0, time + 0.4 * std::sin(2.0 * time), 0.0});
    });
    for (const double time : way.times) {
        way.strides.push_back(0.5 + 0.2 * std::sin(time));
        way.cadences.push_back(1.0 + 0.5 * std::cos(time));
    }
    const Pattern trot = pattern_of(Gait::trot, way.rest, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
    way.changes = {{100, trot.phases, trot.duty}};
    const Walker planned = walking(way, {});
    const auto before = planned.steps(leg);
    std::size_t kept = 0;
    for (int turn = 0; turn < 300; ++turn) {
        std::vector<ChosenStep> chosen;
        const int count = random.whole(1, 5);
        for (int i = 0; i < count; ++i) {
            const Footstep& step = before[random.below(before.size())];
            chosen.push_back(timed(step, std::nullopt, std::nullopt));
            if (random.chance(0.7)) chosen.back().touch = step.touch + random.between(-1.0, 1.0);
            if (random.chance(0.5)) chosen.back().until = step.touch + random.between(-0.2, 3.0);
            if (random.chance(0.3)) chosen.back().offset = random.in_cube(0.1);
        }
        const Walker walker = walking(way, chosen);
        check_walks(walker);
        if (walker.problems().empty()) ++kept;
    }
    CHECK(kept > 60);
}

TEST_CASE("moments keep their order, and set ones are where they are set", "[timed]") {
    Random random(8);
    for (int turn = 0; turn < 200; ++turn) {
        Timing timing;
        std::vector<std::pair<double, double>> set;
        for (double planned = random.between(0.1, 2.0); planned < 20.0; planned += random.between(0.1, 4.0)) {
            const double wanted = planned + random.between(-1.0, 1.0);
            if (timing.set(planned, wanted)) set.emplace_back(planned, wanted);
        }
        for (const auto& [planned, wanted] : set)
            CHECK(timing.moved(planned) == Approx(wanted).epsilon(1e-12));
        double before = timing.moved(-1.0);
        CHECK(before == -1.0);
        for (int i = -99; i < 3000; ++i) {
            const double now = timing.moved(0.01 * i);
            REQUIRE(now - before > 0.2499 * 0.01);
            before = now;
        }
        CHECK(timing.shift(30.0) == 0.0);
    }
    const Timing none;
    CHECK(none.shift(3.0) == 0.0);
}

TEST_CASE("times of chosen steps have to be finite", "[timed]") {
    const Footstep step = walking(std::vector<ChosenStep>{}).steps(leg)[row];
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(walking({timed(step, nan, std::nullopt)}), Catch::StartsWith("chosen: must have"));
    CHECK_THROWS_WITH(walking({timed(step, std::nullopt, nan)}), Catch::StartsWith("chosen: must have"));
}
