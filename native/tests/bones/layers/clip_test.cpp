#include "motus/bones/layers/clip.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::layers;
using motus::fcurve::Cycles;
using motus::fcurve::FCurve;
using motus::fcurve::Interpolation;
using motus::fcurve::Key;
using motus::fcurve::Repeat;
using std::numbers::pi;

namespace {

/// From one value to another in ten frames.
FCurve line(double from, double to) {
    const auto key = [](double frame, double value) {
        return Key{{frame, value}, {frame - 1.0, value}, {frame + 1.0, value}, Interpolation::linear};
    };
    return {{key(0, from), key(10, to)}, false};
}

double distance(const glm::dquat& a, const glm::dquat& b) {
    return angle_of_turn(glm::conjugate(a) * b);
}

}  // namespace

TEST_CASE("rotation modes are Blender's", "[layers]") {
    const std::array<double, 4> angles{0.3, -0.5, 1.1, 0.0};
    const glm::dquat x = glm::angleAxis(0.3, glm::dvec3(1, 0, 0)),
                     y = glm::angleAxis(-0.5, glm::dvec3(0, 1, 0)),
                     z = glm::angleAxis(1.1, glm::dvec3(0, 0, 1));
    CHECK(distance(rotation_of(Rotation::xyz, angles), z * y * x) < 1e-7);
    CHECK(distance(rotation_of(Rotation::xzy, angles), y * z * x) < 1e-7);
    CHECK(distance(rotation_of(Rotation::yxz, angles), z * x * y) < 1e-7);
    CHECK(distance(rotation_of(Rotation::yzx, angles), x * z * y) < 1e-7);
    CHECK(distance(rotation_of(Rotation::zxy, angles), y * x * z) < 1e-7);
    CHECK(distance(rotation_of(Rotation::zyx, angles), x * y * z) < 1e-7);
    CHECK(distance(rotation_of(Rotation::axis_angle, std::array{pi / 2, 0.0, 0.0, 3.0}),
                   glm::angleAxis(pi / 2, glm::dvec3(0, 0, 1))) < 1e-7);
    CHECK(rotation_of(Rotation::axis_angle, std::array{1.0, 0.0, 0.0, 0.0}) == no_turn);
    CHECK(distance(rotation_of(Rotation::quaternion, std::array{2.0, 2.0, 0.0, 0.0}),
                   glm::angleAxis(pi / 2, glm::dvec3(1, 0, 0))) < 1e-7);
    CHECK(rotation_of(Rotation::quaternion, std::array{0.0, 0.0, 0.0, 0.0}) == glm::dquat(0, 1, 0, 0));
}

TEST_CASE("a clip has the values of its curves, and rest values for channels without curves", "[layers]") {
    const std::array modes{Rotation::quaternion, Rotation::xyz, Rotation::axis_angle};
    const std::array curves{ClipCurve{2, 3, 0}, ClipCurve{0, 1, 0}, ClipCurve{1, 5, -1}, ClipCurve{0, 8, 0}};
    const Clip clip(modes, curves, std::array{line(0, 1)});
    CHECK(std::vector<int>(clip.bones().begin(), clip.bones().end()) == std::vector<int>{0, 1, 2});
    CHECK(clip.channels()[0] == (location | scale));
    CHECK(clip.channels()[1] == rotation);
    CHECK(clip.given_count() == 1);
    std::vector<Transform> pose(3);
    const std::array given{0.8};
    clip.evaluate(5.0, given, pose);
    CHECK(pose[0].location == glm::dvec3(0, 0.5, 0));
    CHECK(pose[0].rotation == no_turn);
    CHECK(pose[0].scale == glm::dvec3(1, 0.5, 1));
    CHECK(distance(pose[1].rotation, glm::angleAxis(0.8, glm::dvec3(0, 0, 1))) < 1e-7);
    CHECK(distance(pose[2].rotation, glm::angleAxis(0.5, glm::dvec3(0, 1, 0))) < 1e-7);
}

TEST_CASE("a clip plays cycles, and takes what overflows for 0", "[layers]") {
    const std::array modes{Rotation::quaternion};
    const FCurve whole = line(0, 1);
    std::vector<Key> keys(whole.keys().begin(), whole.keys().end());
    const FCurve cyclic(keys, false, Cycles{.after = Repeat::with_offset});
    keys[1].place.y = 3e38f;
    // In single precision, in which it overflows.
    const FCurve steep(keys, true, Cycles{.before = Repeat::none, .after = Repeat::none});
    const Clip clip(modes, std::array{ClipCurve{0, 0, 0}, ClipCurve{0, 1, 1}}, std::array{cyclic, steep});
    std::vector<Transform> pose(1);
    clip.evaluate(1025.0, {}, pose);
    CHECK(pose[0].location == glm::dvec3(102.5, 0, 0));
}

TEST_CASE("angles beyond half a turn go around", "[layers]") {
    const auto goes = [](Rotation mode, int channel, double from, double to) {
        return Clip(std::array{mode}, std::array{ClipCurve{0, channel, 0}}, std::array{line(from, to)})
            .has_spins();
    };
    CHECK(goes(Rotation::xyz, 4, 0.0, 3.5));
    CHECK(goes(Rotation::xyz, 4, 0.0, -3.5));
    CHECK(goes(Rotation::xyz, 4, -pi, pi));
    CHECK_FALSE(goes(Rotation::xyz, 4, -pi, 3.0));
    CHECK_FALSE(goes(Rotation::xyz, 6, 0.0, 9.0));
    CHECK_FALSE(goes(Rotation::xyz, 1, 0.0, 9.0));
    CHECK(goes(Rotation::axis_angle, 3, 0.0, 9.0));
    CHECK_FALSE(goes(Rotation::axis_angle, 4, 0.0, 9.0));
    CHECK_FALSE(goes(Rotation::quaternion, 4, 0.0, 9.0));
    for (const bool is_beyond : {false, true}) {
        for (const int fcurve : {-1, 0}) {
            const std::array curves{ClipCurve{0, 3, fcurve, is_beyond}};
            CHECK(Clip(std::array{Rotation::xyz}, curves, std::array{line(0, 1)}).has_spins() == is_beyond);
        }
    }
}

TEST_CASE("a clip refuses invalid keys and curves", "[layers]") {
    const std::array modes{Rotation::quaternion};
    const auto make = [&](const ClipCurve& curve) {
        return Clip(modes, std::array{curve}, std::array{line(0, 1)});
    };
    CHECK_THROWS_AS(make({1, 0, 0}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 10, 0}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, -2}), std::invalid_argument);
    const Clip clip = make({0, 0, -1});
    std::vector<Transform> pose(1);
    CHECK_THROWS_AS(clip.evaluate(1.0, {}, pose), std::invalid_argument);
    pose.clear();
    CHECK_THROWS_AS(clip.evaluate(1.0, std::array{1.0}, pose), std::invalid_argument);
}
