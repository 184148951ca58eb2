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
using std::numbers::pi;

namespace {

Key key(double frame, double value, Interpolation interpolation, double handle = 1.0) {
    return {{frame, value}, {frame - handle, value}, {frame + handle, value}, interpolation};
}

double distance(const glm::dquat& a, const glm::dquat& b) {
    return angle_of_turn(glm::conjugate(a) * b);
}

}  // namespace

TEST_CASE("a clip evaluates constant and linear keys, between and beyond them", "[layers]") {
    const std::array keys{key(1, 2, Interpolation::linear), key(5, 10, Interpolation::constant),
                          key(9, 4, Interpolation::linear)};
    CHECK(value_at(keys, false, 3.0) == 6.0);
    CHECK(value_at(keys, false, 8.5) == 10.0);
    CHECK(value_at(keys, false, 9.0) == 4.0);
    CHECK(value_at(keys, false, -10.0) == 2.0);
    CHECK(value_at(keys, false, 20.0) == 4.0);
    CHECK(value_at(keys, true, 0.0) == 0.0);   // as from 1 to 5
    CHECK(value_at(keys, true, 11.0) == 1.0);  // as from 5 to 9
    CHECK(value_at(std::span(keys).first(1), true, 7.0) == 2.0);
    CHECK(value_at(keys, false, 9.0 - 5e-5) == 4.0);  // so near a key Blender has its value
}

TEST_CASE("a Bezier piece is its own cubic", "[layers]") {
    test::Random random(1);
    for (int i = 0; i < 500; ++i) {
        Key from = key(1.0, random.between(-2.0, 2.0), Interpolation::bezier);
        Key to = key(11.0, random.between(-2.0, 2.0), Interpolation::bezier);
        from.right = {random.between(1.0, 11.0), random.between(-3.0, 3.0)};
        to.left = {random.between(1.0, 11.0), random.between(-3.0, 3.0)};
        const std::array keys{from, to};
        const double t = random.between(0.05, 0.95);
        const glm::dvec2 on = (1 - t) * (1 - t) * (1 - t) * from.place +
                              3 * t * (1 - t) * (1 - t) * from.right + 3 * t * t * (1 - t) * to.left +
                              t * t * t * to.place;
        CHECK(value_at(keys, false, on.x) == Approx(on.y).margin(1e-7));
    }
}

TEST_CASE("handles that are longer than the way are shortened", "[layers]") {
    Key from = key(0, 0, Interpolation::bezier), to = key(4, 1, Interpolation::bezier);
    from.right = {40, 10};
    to.left = {-36, -9};
    std::array keys{from, to};
    const double beyond = value_at(keys, false, 1.3);
    keys[0].right = {4, 1};
    keys[1].left = {0, 0};
    CHECK(beyond == Approx(value_at(keys, false, 1.3)));
}

TEST_CASE("beyond a Bezier key its handle leads on", "[layers]") {
    Key only = key(5, 1, Interpolation::bezier);
    only.left = {3, 0};
    only.right = {6, 3};
    const std::array keys{only};
    CHECK(value_at(keys, true, 1.0) == -1.0);
    CHECK(value_at(keys, true, 7.0) == 5.0);
    CHECK(value_at(keys, false, 7.0) == 1.0);
}

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
    const std::array keys{key(0, 0, Interpolation::linear), key(10, 1, Interpolation::linear)};
    const std::array curves{Curve{2, 3, 0, 2, false}, Curve{0, 1, 0, 2, false}, Curve{1, 5, 0, 0, false},
                            Curve{0, 8, 0, 2, false}};
    const Clip clip(modes, curves, keys);
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

TEST_CASE("angles beyond half a turn go around", "[layers]") {
    const auto goes = [](Rotation mode, int channel, double from, double to) {
        const std::array keys{key(0, from, Interpolation::linear), key(10, to, Interpolation::linear)};
        return Clip(std::array{mode}, std::array{Curve{0, channel, 0, 2, false}}, keys).has_spins();
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
    for (const bool is_beyond : {false, true})
        CHECK(Clip(std::array{Rotation::xyz}, std::array{Curve{0, 3, 0, 0, is_beyond}}, {}).has_spins() ==
              is_beyond);
}

TEST_CASE("a clip refuses invalid keys and curves", "[layers]") {
    const std::array modes{Rotation::quaternion};
    const std::array keys{key(3, 0, Interpolation::linear), key(1, 1, Interpolation::linear)};
    const auto make = [&](const Curve& curve) { return Clip(modes, std::array{curve}, keys); };
    CHECK_THROWS_AS(make({1, 0, 0, 1, false}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 10, 0, 1, false}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1, 2, false}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0, 2, false}), std::invalid_argument);
    const std::array bad{key(std::numeric_limits<double>::infinity(), 0, Interpolation::linear)};
    CHECK_THROWS_AS(Clip(modes, std::array{Curve{0, 0, 0, 1, false}}, bad), std::invalid_argument);
    const Clip clip = make({0, 0, 0, 0, false});
    std::vector<Transform> pose(1);
    CHECK_THROWS_AS(clip.evaluate(1.0, {}, pose), std::invalid_argument);
    pose.clear();
    CHECK_THROWS_AS(clip.evaluate(1.0, std::array{1.0}, pose), std::invalid_argument);
}
