#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <vector>

#include "walker/walkers.hpp"

using namespace motus::walker;

namespace {

constexpr double strike = 0.4, push = 0.9, heel = 0.06, toe = 0.15, ankle = 0.09, stride = 0.6;
constexpr glm::dvec3 ahead{0.0, 1.0, 0.0}, up{0.0, 0.0, 1.0};

/// Somebody on two legs whose origin is on the ground.
Way biped_way(double seconds, const std::function<glm::dmat4(double)>& pose) {
    Way way = way_along(seconds, pose);
    way.rest = {{-0.1, 0.0, ankle}, {0.1, 0.0, ankle}};
    const Pattern pattern = pattern_of(Gait::walk, way.rest, ahead, up);
    way.phases = pattern.phases;
    way.duty = pattern.duty;
    way.stride = stride;
    return way;
}

WalkSettings rolling() {
    WalkSettings settings;
    settings.soles = {ahead, ankle, heel, toe, strike, push};
    return settings;
}

glm::dmat4 ahead_by(double distance) {
    return glm::translate(glm::dmat4(1.0), {0.0, distance, 0.0});
}

/// Where a point of the sole is: from a foot's place, ahead and down in the body's space.
glm::dvec3 on_sole(const Foot& foot, double forward) {
    return foot.position + foot.turn * glm::dvec3(0.0, forward, -ankle);
}

/// How far the toe points down, rad.
double pitch_of(const Foot& foot) {
    return -std::asin((foot.turn * ahead).z);
}

}  // namespace

TEST_CASE("a sole rolls over its heel, lies flat and rolls over its toe", "[sole]") {
    const Ground level = plane(0.25);
    const Walker walker(biped_way(6.0, [](double time) { return ahead_by(0.8 * time); }), rolling(), &level);
    int whole = 0;
    for (std::size_t leg = 0; leg < 2; ++leg) {
        const auto steps = walker.steps(leg);
        for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
            const Footstep& step = steps[i];
            const Footstep& next = steps[i + 1];
            if (next.push < push || step.strike > -strike) continue;  // the body sets off, or comes to rest
            ++whole;
            CHECK(glm::distance(step.end, glm::dvec3(step.end.x, step.end.y, 0.25 + ankle)) < 1e-9);
            CHECK(pitch_of(walker.foot(leg, step.touch)) == Approx(-strike));
            CHECK(pitch_of(walker.foot(leg, next.lift)) == Approx(push));
            // Perry: of a stand a fifth for the heel, a half for the toe.
            const double stand = next.lift - step.touch;
            const double down = step.touch + 0.2 * stand, lifts = next.lift - 0.5 * stand;
            const glm::dvec3 behind = on_sole({step.end, up, 0.0, step.end_turn}, -heel);
            const glm::dvec3 before = on_sole({step.end, up, 0.0, step.end_turn}, toe);
            for (int part = 0; part <= 40; ++part) {
                const double time = step.touch + part / 40.0 * stand;
                const Foot foot = walker.foot(leg, time);
                if (time < down - 1e-9) CHECK(glm::distance(on_sole(foot, -heel), behind) < 1e-9);
                if (time > lifts + 1e-9) CHECK(glm::distance(on_sole(foot, toe), before) < 1e-9);
                if (time > down + 1e-6 && time < lifts - 1e-6) {
                    CHECK(foot.position == step.end);
                    CHECK(foot.turn == step.end_turn);
                }
                for (const double forward : {-heel, 0.0, toe}) CHECK(on_sole(foot, forward).z > 0.25 - 1e-9);
            }
        }
    }
    CHECK(whole > 6);
}

TEST_CASE("a rolling sole goes on smoothly, and stays above the ground", "[sole]") {
    const Ground level = plane();
    const Walker walker(biped_way(5.0, [](double time) { return ahead_by(0.7 * time); }), rolling(), &level);
    const double apart = 1e-4;
    for (std::size_t leg = 0; leg < 2; ++leg) {
        for (double time = 0.5; time < 6.5; time += 0.003) {
            const Foot before = walker.foot(leg, time - apart), now = walker.foot(leg, time),
                       after = walker.foot(leg, time + apart);
            CHECK(glm::distance(before.position, now.position) < 10.0 * apart);
            CHECK(glm::distance(before.position + after.position, 2.0 * now.position) <
                  400.0 * apart * apart);
            CHECK(std::abs(pitch_of(after) - 2.0 * pitch_of(now) + pitch_of(before)) <
                  2000.0 * apart * apart);
            for (const double forward : {-heel, toe}) CHECK(on_sole(now, forward).z > -1e-3);
        }
    }
}

TEST_CASE("soles lie on the ground, and keep the heading of the body", "[sole]") {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, -0.3, 1.0));
    const Ground slope{{}, {}, Plane{{0.0, 0.0, 0.0}, normal}};
    const double heading = 0.7;
    const glm::dmat4 pose = glm::rotate(glm::dmat4(1.0), heading, up);
    const Walker walker(biped_way(1.0, [&](double) { return pose; }), rolling(), &slope);
    for (std::size_t leg = 0; leg < 2; ++leg) {
        const Foot foot = walker.foot(leg, 0.5);
        CHECK(glm::distance(foot.turn * up, normal) < 1e-12);
        const glm::dvec3 wanted = glm::dvec3(pose * glm::dvec4(ahead, 0.0));
        CHECK(glm::distance(foot.turn * ahead, glm::normalize(wanted - normal * glm::dot(wanted, normal))) <
              1e-12);
        CHECK(glm::dot(foot.position, normal) == Approx(ankle));
    }
}

TEST_CASE("on a wall that the body faces, soles point along its up", "[sole]") {
    const Ground wall{{}, {}, Plane{{0.0, 0.4, 0.0}, {0.0, -1.0, 0.0}}};
    WalkSettings settings = rolling();
    Way way = biped_way(1.0, [](double) { return glm::dmat4(1.0); });
    way.rest = {{-0.1, 0.6, 0.3}, {0.1, 0.6, 0.3}};
    settings.hips = {{-0.1, 0.0, 0.3}, {0.1, 0.0, 0.3}};
    settings.lengths = {2.0, 2.0};
    const Walker walker(way, settings, &wall);
    const Foot foot = walker.foot(0, 0.5);
    CHECK(glm::distance(foot.turn * up, {0.0, -1.0, 0.0}) < 1e-9);
    CHECK(glm::distance(foot.turn * ahead, {0.0, 0.0, 1.0}) < 1e-9);
}

TEST_CASE("who goes backwards touches down with the toe, and who goes sideways does not roll", "[sole]") {
    const Ground level = plane();
    const auto rolls = [&](const glm::dvec3& velocity) {
        const Walker walker(
            biped_way(5.0, [&](double time) { return glm::translate(glm::dmat4(1.0), velocity * time); }),
            rolling(), &level);
        const Footstep& step = walker.steps(0)[2];
        return std::pair(step.push, step.strike);
    };
    CHECK(rolls({0.0, 0.8, 0.0}) == std::pair(push, -strike));
    CHECK(rolls({0.0, -0.8, 0.0}) == std::pair(-push, strike));
    const auto [aside_push, aside_strike] = rolls({0.8, 0.0, 0.0});
    CHECK(std::abs(aside_push) + std::abs(aside_strike) < 1e-9);
    const auto [slow, slow_strike] = rolls({0.0, 0.3, 0.0});  // steps of 0.3 m, half a stride
    CHECK(slow == Approx(0.5 * push));
    CHECK(slow_strike == Approx(-0.5 * strike));
}

TEST_CASE("a body that rests stands on flat soles", "[sole]") {
    const Ground level = plane();
    const Walker walker(biped_way(5.0, [](double time) { return ahead_by(std::min(2.0, 0.8 * time)); }),
                        rolling(), &level);
    for (std::size_t leg = 0; leg < 2; ++leg) {
        const Foot foot = walker.foot(leg, 30.0);
        CHECK(foot.position == walker.steps(leg).back().end);
        CHECK(pitch_of(foot) == 0.0);
    }
}

TEST_CASE("soles that cannot be are refused", "[sole]") {
    const Way way = biped_way(1.0, [](double) { return glm::dmat4(1.0); });
    const auto made = [&](auto change) {
        WalkSettings settings = rolling();
        change(settings.soles);
        return Walker(way, settings);
    };
    CHECK_THROWS_WITH(made([](Soles& s) { s.ankle = -1.0; }), Catch::Contains("ankle"));
    CHECK_THROWS_WITH(made([](Soles& s) { s.heel = -1.0; }), Catch::Contains("heel"));
    CHECK_THROWS_WITH(made([](Soles& s) { s.toe = std::nan(""); }), Catch::Contains("toe"));
    CHECK_THROWS_WITH(made([](Soles& s) { s.strike = 2.0; }), Catch::Contains("strike"));
    CHECK_THROWS_WITH(made([](Soles& s) { s.push = -0.1; }), Catch::Contains("push"));
    CHECK_THROWS_WITH(made([](Soles& s) { s.forward.x = INFINITY; }), Catch::Contains("forward"));
}
