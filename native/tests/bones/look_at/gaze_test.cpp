#include "motus/bones/look_at/gaze.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <vector>

#include "angles.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::look_at;
using motus::test::angle_between;
using std::numbers::pi;

namespace {

constexpr double degree = pi / 180.0;
const glm::dvec3 ahead{0, -1, 0};  // Blender's characters look along -Y
const glm::dvec3 up{0, 0, 1};
const GazeChart chart(ahead, up);
const GazeChart chart_in_front(ahead, up, Level::in_front);

Turns turns_to(const glm::dvec3& animated, const glm::dvec3& target, const GazeSettings& settings) {
    return turns_to(level_for(settings) == Level::all_round ? chart : chart_in_front, animated, target,
                    settings);
}

/// Direction by yaw (to the character's left) and pitch (up).
glm::dvec3 towards(double yaw, double pitch) {
    return glm::angleAxis(yaw, up) * (std::cos(pitch) * ahead + std::sin(pitch) * up);
}

GazeSettings free_head() {
    GazeSettings settings;
    settings.body_weight = 0.0;
    settings.clamp = 0.0;
    return settings;
}

glm::dvec3 gaze_after(const Turns& turns, const glm::dvec3& animated) {
    return turns.eyes * (turns.head * (turns.body * animated));
}

bool is_identity(const glm::dquat& q) {
    return q.w == 1.0 && q.x == 0.0 && q.y == 0.0 && q.z == 0.0;
}

double angle_of(const glm::dquat& q) {
    return angle_between(q, glm::dquat(1, 0, 0, 0));
}

std::vector<glm::dvec3> random_directions(unsigned seed, int count) {
    test::Random random(seed);
    std::vector<glm::dvec3> result;
    for (int i = 0; i < count; ++i) result.push_back(random.direction());
    return result;
}

/// The greatest change of a part, in multiples of the target's, as the target goes along a way of small
/// steps.
template <class Way>
double greatest_gain(const GazeSettings& settings, const glm::dvec3& animated, Way&& way) {
    constexpr int count = 4000;
    double gain = 0.0;
    Turns last = turns_to(animated, way(0.0), settings);
    glm::dvec3 last_target = way(0.0);
    for (int i = 1; i <= count; ++i) {
        const glm::dvec3 target = way(static_cast<double>(i) / count);
        const Turns turns = turns_to(animated, target, settings);
        const double moved = angle_between(target, last_target);
        if (moved < 1e-9) continue;  // at the poles of a way round
        for (const double change :
             {angle_between(turns.body, last.body), angle_between(turns.head, last.head),
              angle_between(turns.eyes, last.eyes)})
            gain = std::max(gain, change / moved);
        last = turns;
        last_target = target;
    }
    return gain;
}

}  // namespace

TEST_CASE("the original's weights: the body takes 0.3 of the turn, the head the rest", "[look_at]") {
    const Turns turns = turns_to(ahead, towards(-30 * degree, 0.0), {});
    CHECK(angle_between(turns.body, glm::angleAxis(-9 * degree, up)) < 1e-15);
    CHECK(angle_between(turns.head, glm::angleAxis(-21 * degree, up)) < 1e-15);
    CHECK(is_identity(turns.eyes));
    CHECK(turns.residual < 1e-15);
    CHECK(turns.reason == Reason::reached);
}

TEST_CASE("each part of a look takes its share of the turn that the parts before have left", "[look_at]") {
    GazeSettings settings;
    settings.weight = 0.5;
    settings.body_weight = 0.4;
    settings.head_weight = 0.5;
    settings.eyes_weight = 0.5;
    const Turns turns = turns_to(ahead, towards(0.0, 40 * degree), settings);
    const glm::dvec3 right = glm::cross(ahead, up);
    CHECK(angle_between(turns.body, glm::angleAxis(8 * degree, right)) < 1e-15);
    CHECK(angle_between(turns.head, glm::angleAxis(6 * degree, right)) < 1e-15);
    CHECK(angle_between(turns.eyes, glm::angleAxis(3 * degree, right)) < 1e-15);
}

TEST_CASE("a free gaze of full weight meets its target everywhere", "[look_at]") {
    const std::vector<glm::dvec3> directions = random_directions(1, 4000);
    for (std::size_t i = 0; i + 1 < directions.size(); i += 2) {
        GazeSettings settings = free_head();
        settings.body_weight = 0.1 * static_cast<double>(i % 11);
        const Turns turns = turns_to(directions[i], directions[i + 1], settings);
        CHECK(angle_between(gaze_after(turns, directions[i]), directions[i + 1]) < 1e-13);
        settings.head_weight = 0.0;
        settings.eyes_weight = 1.0;
        const Turns eyes = turns_to(directions[i], directions[i + 1], settings);
        CHECK(angle_between(gaze_after(eyes, directions[i]), directions[i + 1]) < 1e-13);
        CHECK(is_identity(eyes.head));
    }
}

TEST_CASE("places in the chart give their directions back", "[look_at]") {
    for (const glm::dvec3& direction : random_directions(2, 1000)) {
        const glm::dvec2 place = chart.place(direction);
        CHECK(std::hypot(place.x, place.y) == Approx(angle_between(direction, ahead)).margin(1e-14));
        CHECK(angle_between(chart.direction(place), direction) < 1e-14);
    }
    CHECK(chart.place(ahead) == glm::dvec2(0.0));
    CHECK(chart.place(towards(0.5, 0.0)).x == Approx(0.5));
    CHECK(chart.place(towards(0.0, 0.5)).y == Approx(0.5));
    CHECK(chart.place(-ahead) == glm::dvec2(pi, 0.0));
    const glm::dvec2 seen = chart.yaw_pitch(towards(2.5, -0.7));
    CHECK(seen.x == Approx(2.5));
    CHECK(seen.y == Approx(-0.7));
}

TEST_CASE("a level head stays level, a rolled one keeps its roll", "[look_at]") {
    GazeSettings settings = free_head();
    for (double yaw = -175; yaw <= 175; yaw += 10) {
        for (double pitch = -36; pitch <= 36; pitch += 6) {
            const Turns turns = turns_to(towards(0.3, 0.2), towards(yaw * degree, pitch * degree), settings);
            const glm::dvec3 right = towards(0.3 - pi / 2, 0.0);
            CHECK(std::abs((turns.head * right).z) < 1e-14);
            const glm::dvec3 rolled = glm::angleAxis(0.4, towards(0.3, 0.2)) * right;
            const glm::dvec3 level_right = towards(yaw * degree - pi / 2, 0.0);
            CHECK(angle_between(turns.head * rolled, level_right) == Approx(0.4));
        }
    }
}

TEST_CASE("a look of weight 0 turns nothing, bit for bit", "[look_at]") {
    for (const glm::dvec3& direction : random_directions(3, 200)) {
        for (int which = 0; which < 3; ++which) {
            GazeSettings settings;
            settings.eyes_weight = 0.5;
            if (which == 0) settings.weight = 0.0;
            if (which == 1) settings.clamp = 1.0;
            if (which == 2) settings.body_weight = settings.head_weight = settings.eyes_weight = 0.0;
            const Turns turns = turns_to(towards(0.4, 0.1), direction, settings);
            CHECK((is_identity(turns.body) && is_identity(turns.head) && is_identity(turns.eyes)));
        }
    }
}

TEST_CASE("more weight brings the gaze nearer", "[look_at]") {
    for (const glm::dvec3& target : {towards(1.0, 0.3), towards(-0.7, -0.9), towards(0.2, 1.2)}) {
        for (double GazeSettings::*weight : {&GazeSettings::weight, &GazeSettings::body_weight,
                                             &GazeSettings::head_weight, &GazeSettings::eyes_weight}) {
            GazeSettings settings;
            settings.clamp = 0.1;
            settings.head_weight = 0.6;
            double last = pi;
            for (double value = 0.0; value <= 1.0; value += 0.05) {
                settings.*weight = value;
                const glm::dvec3 animated = towards(-0.2, -0.1);
                const double left =
                    angle_between(gaze_after(turns_to(animated, target, settings), animated), target);
                CHECK(left < last);
                last = left;
            }
        }
    }
}

TEST_CASE("clamp and limits hold, and begin smoothly", "[look_at]") {
    for (const glm::dvec3& target : random_directions(4, 3000)) {
        GazeSettings settings;
        settings.clamp = 0.5;
        const Turns clamped = turns_to(ahead, target, settings);
        CHECK(angle_between(gaze_after(clamped, ahead), ahead) <= pi / 2 + 1e-12);

        settings.clamp = 0.0;
        settings.eyes_weight = 1.0;
        settings.body_limit = 20 * degree;
        settings.head_limit = 50 * degree;
        settings.eyes_limit = 30 * degree;
        const glm::dvec3 animated = towards(0.5, 0.3);
        const Turns turns = turns_to(animated, target, settings);
        const glm::dvec3 body = turns.body * animated, head = turns.head * body, eyes = turns.eyes * head;
        CHECK(angle_between(body, animated) <= 1.05 * settings.body_limit);
        CHECK(angle_between(head, body) <= 1.05 * settings.head_limit);
        CHECK(angle_between(eyes, head) <= 1.05 * settings.eyes_limit);
        const double to_target = angle_between(target, animated);
        if (to_target < 25 * degree) CHECK(angle_between(eyes, target) < 1e-9);
        CHECK(turns.residual == Approx(angle_between(eyes, target)).margin(1e-12));
        if (to_target < 25 * degree) CHECK(turns.reason == Reason::reached);
        if (to_target > 150 * degree) CHECK(turns.reason == Reason::limit);
    }

    GazeSettings settings = free_head();
    settings.head_limit = 60 * degree;
    constexpr double step = 0.01 * degree;
    double last = 0.0, last_speed = 1.0;
    for (double yaw = step; yaw < 130 * degree; yaw += step) {
        const double angle = angle_of(turns_to(ahead, towards(yaw, 0.0), settings).head);
        if (yaw < 48 * degree) CHECK(angle == Approx(yaw));
        const double speed = (angle - last) / step;
        CHECK(speed > -1e-9);
        CHECK(std::abs(speed - last_speed) < 1e-3);
        last = angle;
        last_speed = speed;
    }
    CHECK(last == Approx(60 * degree));
}

TEST_CASE("head and eyes have limits of their own to the left, to the right, up and down", "[look_at]") {
    GazeSettings settings = free_head();
    settings.head_sides = {40 * degree, 30 * degree, 20 * degree, 10 * degree};
    const GazeChart chart(ahead, {0.0, 0.0, 1.0});
    const auto place = [&](const glm::dvec3& target) {
        return chart.place(gaze_after(turns_to(ahead, target, settings), ahead)) / degree;
    };
    CHECK(place(towards(90 * degree, 0.0)).x == Approx(40.0));
    CHECK(place(towards(-90 * degree, 0.0)).x == Approx(-30.0));
    CHECK(place(towards(0.0, 80 * degree)).y == Approx(20.0));
    CHECK(place(towards(0.0, -80 * degree)).y == Approx(-10.0));
    const glm::dvec2 aside = place(chart.direction({15 * degree, 60 * degree}));
    CHECK(aside.x == Approx(15.0));  // one part does not shorten the other
    CHECK(aside.y == Approx(20.0));
    CHECK(turns_to(ahead, towards(60 * degree, 0.0), settings).reason == Reason::limit);
    CHECK(turns_to(ahead, towards(5 * degree, 5 * degree), settings).residual < 1e-12);

    // Slope of the place to the left over that of the target: 1 at first, no corner, no way back.
    constexpr double step = 0.01;  // degrees
    double last = 0.0, last_speed = 1.0;
    for (double yaw = step; yaw < 120.0; yaw += step) {
        const double left = place(chart.direction({yaw * degree, -3 * degree})).x;
        const double speed = (left - last) / step;
        CHECK(speed > -1e-8);
        CHECK(std::abs(speed - last_speed) < 2e-3);
        last = left;
        last_speed = speed;
    }

    settings = {};
    settings.clamp = settings.body_weight = settings.head_weight = 0.0;
    settings.eyes_weight = 1.0;
    settings.eyes_sides.up = 0.0;
    CHECK(place(towards(0.0, 30 * degree)) == glm::dvec2(0.0));
    CHECK(place(towards(0.0, -30 * degree)).y == Approx(-30.0));
}

TEST_CASE("a clamped gaze has no jump anywhere, straight behind included", "[look_at]") {
    // Of `ahead`, which has a name, Catch2 would take a reference, and the others for references too.
    const glm::dvec3 animated =
        GENERATE(as<glm::dvec3>{}, ahead, towards(0.5, -0.3), towards(0.1, -1.0), towards(-0.9, 0.5));
    GazeSettings settings;
    settings.eyes_weight = 0.5;
    SECTION("by the clamp") {
        settings.clamp = GENERATE(0.5, 0.7, 0.9);
    }
    SECTION("by limits of each part") {
        settings.clamp = 0.0;
        settings.body_limit = 30 * degree;
        settings.head_limit = 80 * degree;
        settings.eyes_limit = 35 * degree;
    }
    constexpr double most = 8.0;
    for (double pitch = -90; pitch <= 90; pitch += 15) {
        // round the head at one height; and over it, from one side to the other
        CHECK(greatest_gain(settings, animated,
                            [&](double t) { return towards(2 * pi * t, pitch * degree); }) < most);
        CHECK(greatest_gain(settings, animated, [&](double t) {
                  return glm::angleAxis(2 * pi * t, towards(pitch * degree, 0)) * up;
              }) < most);
    }
    CHECK(greatest_gain(settings, animated, [](double t) { return towards(0.0, 2 * pi * t); }) < most);
}

TEST_CASE("a free gaze jumps nowhere but straight behind", "[look_at]") {
    GazeSettings settings;
    settings.clamp = 0.0;
    constexpr double most = 40.0;
    for (double pitch = -50; pitch <= 50; pitch += 10) {
        // Past the direction behind the body's share goes round it, the faster the nearer.
        const double gain =
            greatest_gain(settings, ahead, [&](double t) { return towards(2 * pi * t, pitch * degree); });
        if (pitch != 0.0) CHECK(gain < most);
    }
    // over the head from the front up to 20 degrees before behind, at several sides
    for (double side = -60; side <= 60; side += 10) {
        CHECK(greatest_gain(settings, ahead, [&](double t) {
                  return glm::angleAxis(-(20 + 90 * t) * degree, towards(pi / 2, 0)) *
                         towards(side * degree, 0);
              }) < most);
    }
    // The head alone goes on through straight behind, as a turret does.
    CHECK(greatest_gain(free_head(), ahead, [](double t) { return towards(2 * pi * t, 0.0); }) < 1.01);
}

TEST_CASE("straight behind is defined: to the left", "[look_at]") {
    GazeSettings settings;
    settings.clamp = 0.0;
    const Turns turns = turns_to(ahead, -ahead, settings);
    CHECK(angle_between(turns.body, glm::angleAxis(0.3 * pi, up)) < 1e-14);
    CHECK(angle_between(gaze_after(turns, ahead), -ahead) < 1e-14);
    settings.clamp = 0.5;
    CHECK(angle_of(turns_to(ahead, -ahead, settings).head) < 1e-14);
}

TEST_CASE("a gaze already turned aside does not come round the back", "[look_at]") {
    // Animated 60 degrees to the left, target 170 degrees to the right: 230 degrees by the front, 130 by the
    // back.
    GazeSettings settings = free_head();
    settings.head_weight = 0.5;
    const Turns turns = turns_to(towards(60 * degree, 0), towards(-170 * degree, 0), settings);
    CHECK(angle_between(turns.head * towards(60 * degree, 0), towards(-55 * degree, 0)) < 1e-13);
}

TEST_CASE("any settings and directions give finite rotations", "[look_at]") {
    test::Random random(5);
    const auto wide = [&random] { return random.between(-1.0, 5.0); };
    const std::vector<glm::dvec3> directions = random_directions(6, 20000);
    const std::vector<glm::dvec3> axes{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (std::size_t i = 0; i + 1 < directions.size(); i += 2) {
        const GazeSettings settings{wide(), wide(), wide(), wide(), wide(), wide(), wide(), wide()};
        const glm::dvec3 from = i % 3 == 0 ? axes[random.below(axes.size())] : directions[i];
        const glm::dvec3 to = i % 5 == 0 ? axes[random.below(axes.size())] : directions[i + 1];
        const Turns turns = turns_to(from, to, settings);
        for (const glm::dquat& turn : {turns.body, turns.head, turns.eyes})
            CHECK(glm::length(turn) == Approx(1.0).epsilon(1e-13));
    }
}
