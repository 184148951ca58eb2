#include "motus/bones/look_at/eyes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "figure.hpp"

using namespace motus::bones;
using namespace motus::bones::look_at;
using namespace motus::bones::look_at::checks;

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double tick = 1e-4;  // s

/// A time in which the eyes move.
struct Jump {
    double begins = 0.0;
    double ends = 0.0;
    glm::dvec2 from{0.0}, to{0.0};
};

/// The jumps between 0 and `seconds`, found by watching the eyes.
std::vector<Jump> watched(const Saccades& saccades, double seconds) {
    std::vector<Jump> jumps;
    const int count = static_cast<int>(seconds / tick);
    bool moves = true;  // what moves at the beginning has begun before
    Jump now;
    for (int i = 1; i < count; ++i) {
        const glm::dvec2 before = saccade(saccades, (i - 1) * tick);
        const glm::dvec2 after = saccade(saccades, i * tick);
        const bool moved = before != after;
        if (moved && !moves) now = {(i - 1) * tick, 0.0, before, before};
        if (!moved && moves && now.begins > 0.0) {
            now.ends = (i - 1) * tick;
            now.to = after;
            jumps.push_back(now);
        }
        moves = moved;
    }
    return jumps;
}

}  // namespace

TEST_CASE("a saccade takes 21 ms and 2.2 ms a degree", "[look_at]") {
    for (const double amplitude : {2.0 * degree, 10.0 * degree, 25.0 * degree}) {
        const std::vector<Jump> jumps = watched({amplitude, 2.0, 5}, 40.0);
        REQUIRE(jumps.size() > 70);
        REQUIRE(jumps.size() < 90);
        for (const Jump& jump : jumps) {
            const double size = glm::degrees(glm::distance(jump.from, jump.to));
            CHECK(jump.ends - jump.begins == Approx(0.021 + 0.0022 * size).margin(2.0 * tick));
        }
    }
}

TEST_CASE("saccades stay within their amplitude, come to all sides, and jump at their rate", "[look_at]") {
    const Saccades saccades{4.0 * degree, 3.0, 1};
    const std::vector<Jump> jumps = watched(saccades, 100.0);
    CHECK(static_cast<double>(jumps.size()) == Approx(300.0).margin(3.0));
    glm::dvec2 mean(0.0);
    double farthest = 0.0;
    for (const Jump& jump : jumps) {
        mean += jump.to / static_cast<double>(jumps.size());
        farthest = std::max(farthest, glm::length(jump.to));
    }
    CHECK(farthest <= saccades.amplitude);
    CHECK(farthest > 0.95 * saccades.amplitude);
    CHECK(glm::length(mean) < 0.2 * saccades.amplitude);
}

TEST_CASE("saccades are continuous, also if they follow each other too quickly", "[look_at]") {
    for (const double rate : {1.0, 10.0, 40.0, most_rate}) {
        const Saccades saccades{20.0 * degree, rate, 9};
        // The shortest time between two jumps, and the greatest speed of a movement of least jerk.
        const double shortest = std::min(shortest_saccade, 0.3 / rate);
        const double fastest = 1.875 * 2.0 * saccades.amplitude / shortest;
        for (int i = -20000; i < 20000; ++i) {
            const glm::dvec2 step = saccade(saccades, (i + 1) * tick) - saccade(saccades, i * tick);
            REQUIRE(glm::length(step) <= 1.001 * fastest * tick);
        }
    }
}

TEST_CASE("saccades are a function of time and seed", "[look_at]") {
    const Saccades saccades{3.0 * degree, 2.0, 1};
    Saccades another = saccades, twice = saccades;
    another.seed = 2;
    twice.amplitude *= 2.0;
    int alike = 0;
    for (const double time : {-7.3, 0.0, 0.4, 11.9, 4000.25, -7.3}) {
        CHECK(saccade(saccades, time) == saccade(saccades, time));
        if (glm::distance(saccade(saccades, time), saccade(another, time)) < 1e-3 * degree) ++alike;
    }
    CHECK(alike == 0);
    for (int i = 0; i < 100; ++i) {  // at rest, since a wider jump takes longer
        const glm::dvec2 one = saccade(saccades, i * 0.37), other = saccade(twice, i * 0.37);
        if (one == saccade(saccades, i * 0.37 - tick) && other == saccade(twice, i * 0.37 - tick))
            CHECK(glm::distance(2.0 * one, other) < 1e-15);
    }
}

TEST_CASE("no saccades and no blinks for numbers that say nothing", "[look_at]") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double number : {nan, infinity, -infinity}) {
        CHECK(saccade({number, 2.0, 0}, 1.0) == glm::dvec2(0.0));
        CHECK(saccade({0.1, number, 0}, 1.0) == glm::dvec2(0.0));
        CHECK(saccade({0.1, 2.0, 0}, number) == glm::dvec2(0.0));
        CHECK(blink(number) == 0.0);
        CHECK(blinks(number, 0, 1.0) == 0.0);
        CHECK(blinks(0.25, 0, number) == 0.0);
    }
    CHECK(saccade({0.1, 0.0, 0}, 1.0) == glm::dvec2(0.0));
    CHECK(saccade({-0.1, 2.0, 0}, 1.0) == glm::dvec2(0.0));
    CHECK(saccade({0.1, 2.0, 0}, 1e30) == glm::dvec2(0.0));
    CHECK(blinks(0.0, 0, 1.0) == 0.0);
    CHECK(blinks(-1.0, 0, 1.0) == 0.0);
    CHECK(blinks(100.0, 0, 1e30) == 0.0);
}

TEST_CASE("a blink shuts the eyes and opens them again", "[look_at]") {
    CHECK(blink(0.0) == 0.0);
    CHECK(blink(closing_seconds) == 1.0);
    CHECK(blink(closing_seconds + opening_seconds) == 0.0);
    CHECK(blink(0.5 * closing_seconds) == Approx(0.5));
    CHECK(blink(closing_seconds + 0.5 * opening_seconds) == Approx(0.5));
    for (int i = -100; i < 5000; ++i) {
        const double step = blink((i + 1) * tick) - blink(i * tick);
        const double curve = step - (blink(i * tick) - blink((i - 1) * tick));
        REQUIRE(std::abs(step) <= 1.5 * tick / closing_seconds);
        REQUIRE(std::abs(curve) <= 6.1 * tick * tick / (closing_seconds * closing_seconds));
    }
}

TEST_CASE("blinks come at their rate", "[look_at]") {
    constexpr double rate = 0.3;
    int shut = 0;
    double last = 0.0;
    const int count = static_cast<int>(1000.0 / 1e-3);
    bool is_shut = false;
    for (int i = 0; i < count; ++i) {
        const double closed = blinks(rate, 4, i * 1e-3);
        REQUIRE(closed >= 0.0);
        REQUIRE(closed <= 1.0);
        REQUIRE(std::abs(closed - last) <= 1.5 * 1e-3 / closing_seconds + 1e-12);
        last = closed;
        if (closed > 0.9 && !is_shut) ++shut;
        is_shut = closed > (is_shut ? 0.1 : 0.9);
    }
    CHECK(shut == Approx(300).margin(1));
    for (int i = 0; i < 1000; ++i) {  // faster than a blink: the eyes do not jump
        const double now = blinks(most_rate, 4, i * 1e-3), next = blinks(most_rate, 4, (i + 1) * 1e-3);
        REQUIRE(std::abs(next - now) <= 1.5 * 1e-3 / closing_seconds + 1e-12);
    }
}

TEST_CASE("eyes look beside their target by what they are told", "[rig_look_at]") {
    const glm::dvec3 ahead(0, -1, 0), up(0, 0, 1), along_eye(0, 1, 0);
    const GazeChart chart(ahead, up);
    Figure figure(2);
    figure.input.target = glm::angleAxis(30.0 * degree, up) * glm::dvec3(0.0, -1e9, 2e8);
    figure.input.settings.head_weight = 0.6;
    const auto gaze = [&](const Result& result, int eye) {
        return chart.place(glm::normalize(glm::dmat3(posed(figure, result, eye)) * along_eye));
    };
    for (const double eyes_weight : {0.0, 0.5, 1.0}) {
        for (const double weight : {0.5, 1.0}) {
            figure.input.settings.eyes_weight = eyes_weight;
            figure.input.settings.weight = weight;
            figure.input.eyes_beside = {0.0, 0.0};
            const Result plain = solve(figure);
            figure.input.eyes_beside = {2.0 * degree, -1.0 * degree};
            const Result beside = solve(figure);
            CHECK(beside.report.angle == Approx(plain.report.angle).margin(1e-9));
            CHECK(beside.report.reason == plain.report.reason);
            CHECK(beside.rotations[2] == plain.rotations[2]);
            for (const int eye : figure.bones.eyes) {
                const glm::dvec2 moved = gaze(beside, eye) - gaze(plain, eye);
                CHECK(glm::distance(moved, weight * figure.input.eyes_beside) < 1e-9);
            }
        }
    }
    figure.input.settings.eyes_limit = 0.0;
    for (const int eye : figure.bones.eyes) {
        const Result held = solve(figure);
        CHECK(is_identity(held.rotations[static_cast<std::size_t>(eye - 1)]));
    }
    figure.input.eyes_beside.x = std::numeric_limits<double>::quiet_NaN();
    const Result senseless = solve(figure);
    CHECK(is_still(senseless));
    CHECK(!senseless.report.reason);
}
