#include "emitter.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

[[nodiscard]] glm::dmat4 pose_of(const glm::dvec3& location, const glm::dquat& rotation,
                                 const glm::dvec3& scale) {
    return glm::translate(glm::dmat4(1.0), location) * glm::mat4_cast(rotation) *
           glm::scale(glm::dmat4(1.0), scale);
}

[[nodiscard]] glm::dvec3 times(const Rows& rows, const glm::dvec3& v) {
    glm::dvec3 out(0.0);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            out[row] += static_cast<double>(rows[static_cast<std::size_t>(3 * row + column)]) * v[column];
    return out;
}

/// What the kernel does with a glide at w.
[[nodiscard]] glm::dvec3 placed(const Glide& glide, double w, const glm::dvec3& point) {
    const glm::dvec3 location(glide.location[0], glide.location[1], glide.location[2]);
    if (!glide.is_moving) return times(glide.stretch, point) + location;
    const glm::dvec3 change(glide.location_change[0], glide.location_change[1], glide.location_change[2]);
    const glm::dvec3 axis(glide.axis[0], glide.axis[1], glide.axis[2]);
    const glm::dvec3 stretched = times(glide.stretch, point) + w * times(glide.stretch_change, point);
    const glm::dquat turn = glide.turn == 0.0F
                                ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                : glm::angleAxis(w * glide.turn * 2.0 * 3.14159265358979, axis);
    return times(glide.rotation, turn * stretched) + location + w * change;
}

}  // namespace

TEST_CASE("a moving emitter goes through its samples, and evenly between", "[snow]") {
    test::Random random(5);
    for (int round = 0; round < 200; ++round) {
        const glm::dquat first = random.any_rotation(), second = random.any_rotation();
        const glm::dvec3 here = random.in_cube(5.0), there = random.in_cube(5.0);
        const glm::dvec3 scale{random.between(-2.0, 2.0), random.between(0.5, 2.0), random.between(0.5, 2.0)};
        const std::vector<double> at{2.0, 3.5};
        const std::vector<glm::dmat4> poses{pose_of(here, first, scale), pose_of(there, second, scale)};
        const Emitter emitter(at, poses);
        CHECK(emitter.part_at(1.0) == 0);
        CHECK(emitter.part_at(2.0) == 1);
        CHECK(emitter.part_at(4.0) == 2);
        CHECK(emitter.end_of(1) == 3.5);
        const glm::dvec3 point = random.in_cube(1.0);
        const auto wanted = [&](std::size_t i) { return glm::dvec3(poses[i] * glm::dvec4(point, 1.0)); };
        const Glide glide = emitter.glide(1, 3.5, 1.5);
        CHECK(glide.w_start == 1.0F);
        CHECK(glide.w_change == -1.0F);
        CHECK(glm::length(placed(glide, 0.0, point) - wanted(0)) < 1e-5);
        CHECK(glm::length(placed(glide, 1.0, point) - wanted(1)) < 1e-5);
        CHECK(glm::length(placed(emitter.glide(0, 0.0, 0.0), 0.0, point) - wanted(0)) < 1e-5);
        CHECK(glm::length(placed(emitter.glide(2, 9.0, 0.0), 0.0, point) - wanted(1)) < 1e-5);
        CHECK(std::abs(glide.turn) <= 0.5F + 1e-6F);
    }
}

TEST_CASE("an emitter may be scaled to nothing or not move", "[snow]") {
    const std::vector<double> at{0.0, 1.0};
    const std::vector<glm::dmat4> flat(2, glm::scale(glm::dmat4(1.0), glm::dvec3(0.0)));
    const Glide glide = Emitter(at, flat).glide(1, 0.5, 0.1);
    CHECK_FALSE(glide.is_moving);
    CHECK(times(glide.rotation, {0.0, 0.0, 1.0}) == glm::dvec3(0.0, 0.0, 1.0));
    CHECK(times(glide.stretch, {1.0, 1.0, 1.0}) == glm::dvec3(0.0));
    CHECK(Emitter({}, {}).part_at(5.0) == 0);
}

TEST_CASE("an emitter refuses times that do not rise", "[snow]") {
    const std::vector<glm::dmat4> two(2, glm::dmat4(1.0));
    CHECK_THROWS_AS(Emitter(std::vector<double>{0.0}, two), std::invalid_argument);
    CHECK_THROWS_AS(Emitter(std::vector<double>{1.0, 1.0}, two), std::invalid_argument);
    CHECK_THROWS_AS(Emitter(std::vector<double>{0.0, std::numeric_limits<double>::infinity()}, two),
                    std::invalid_argument);
    const std::vector<glm::dmat4> bad(2, glm::dmat4(std::numeric_limits<double>::quiet_NaN()));
    CHECK_THROWS_AS(Emitter(std::vector<double>{0.0, 1.0}, bad), std::invalid_argument);
}
