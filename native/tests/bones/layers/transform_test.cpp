#include "motus/bones/layers/transform.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "random.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::layers;
using std::numbers::pi;

namespace {

constexpr unsigned all = location | rotation | scale;
const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

double distance(const glm::dquat& a, const glm::dquat& b) {
    return angle_of_turn(glm::conjugate(a) * b);
}

Transform random_transform(test::Random& random) {
    const glm::dvec3 place = random.in_cube(3.0);
    const glm::dvec3 axis = glm::normalize(random.around_origin());
    const double angle = random.between(-3.0, 3.0);
    const glm::dvec3 size = glm::dvec3(1.5) + random.in_cube(1.0);
    return {place, glm::angleAxis(angle, axis), size};
}

}  // namespace

TEST_CASE("a part of a turn is about the same axis, by the shorter way", "[layers]") {
    const glm::dquat turn = glm::angleAxis(1.2, z);
    CHECK(distance(part_of_turn(turn, 0.25), glm::angleAxis(0.3, z)) < 1e-15);
    CHECK(distance(part_of_turn(-turn, 0.25), glm::angleAxis(0.3, z)) < 1e-15);
    CHECK(distance(part_of_turn(glm::angleAxis(1.5 * pi, y), 0.5), glm::angleAxis(-0.25 * pi, y)) < 1e-15);
    CHECK(part_of_turn(turn, 0.0) == no_turn);
    CHECK(part_of_turn(turn, 1.0) == turn);
    CHECK(part_of_turn(no_turn, 0.5) == no_turn);
    test::Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const double angle = random.between(0.0, pi);
        const double weight = random.between(0.0, 1.0);
        const glm::dvec3 axis = glm::normalize(random.around_origin());
        const glm::dquat part = part_of_turn(glm::angleAxis(angle, axis), weight);
        CHECK(distance(part, glm::angleAxis(angle * weight, axis)) < 4e-15);
    }
}

TEST_CASE("a whole turn is the one that a part was taken of", "[layers]") {
    test::Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const glm::dquat turn = random.rotation(3.14);
        const double weight = random.between(0.01, 1.0);
        const glm::dquat part = part_of_turn(turn, weight);
        CHECK(distance(whole_turn(part, weight), turn) < 1e-11);
        CHECK(distance(whole_turn(-part, weight), turn) < 1e-11);
        CHECK(has_whole_turn(part, weight));
    }
    CHECK(whole_turn(no_turn, 0.0) == no_turn);
    CHECK(has_whole_turn(no_turn, 0.0));
    CHECK(distance(whole_turn(glm::angleAxis(1e-170, x), 0.5), glm::angleAxis(2e-170, x)) < 1e-15);
    for (const double weight : {0.25, 0.0}) {
        CHECK(distance(whole_turn(glm::angleAxis(-1.0, z), weight), glm::angleAxis(-pi, z)) < 1e-9);
        CHECK_FALSE(has_whole_turn(glm::angleAxis(1.0, z), weight));
    }
}

TEST_CASE("matrices are taken apart as Blender does", "[layers]") {
    test::Random random(2);
    for (int i = 0; i < 500; ++i) {
        const Transform given = random_transform(random);
        const Transform found = transform_of(matrix_of(given));
        CHECK(distance(found.rotation, given.rotation) < 1e-7);
        CHECK(glm::length(found.location - given.location) == 0.0);
        CHECK(glm::length(found.scale - given.scale) < 1e-14);
    }
    const Transform mirrored = transform_of(glm::scale(glm::dmat4(1.0), glm::dvec3(-2, 3, 4)));
    CHECK(mirrored.scale == glm::dvec3(-2, -3, -4));
    CHECK(distance(mirrored.rotation, glm::angleAxis(pi, x)) < 1e-12);
    CHECK(is_finite(transform_of(glm::dmat4(0.0))));
}

TEST_CASE("a layer that overrides goes from the pose beneath to its own pose by its weight", "[layers]") {
    const Transform base{{1, 2, 3}, glm::angleAxis(0.2, x), {1, 2, 0}};
    const Transform source{{3, 2, 1}, glm::angleAxis(1.0, x), {2, 1, 4}};
    const Transform half = overridden(base, source, 0.5, all);
    CHECK(half.location == glm::dvec3(2, 2, 2));
    CHECK(distance(half.rotation, glm::angleAxis(0.6, x)) < 1e-15);
    CHECK(half.scale == glm::dvec3(1.5, 1.5, 2));
    const Transform whole = overridden(base, source, 1.0, all);
    CHECK(whole.location == source.location);
    CHECK(whole.rotation == source.rotation);
    CHECK(whole.scale == source.scale);
    const Transform turned = overridden(base, source, 1.0, rotation);
    CHECK(turned.location == base.location);
    CHECK(turned.scale == base.scale);
}

TEST_CASE("an additive layer adds its difference from the reference", "[layers]") {
    const Transform base{{1, 0, 0}, glm::angleAxis(0.5, z), {2, 2, 2}};
    const Transform reference{{0, 1, 0}, glm::angleAxis(0.1, x), {2, 1, 0}};
    const Transform source{{0, 3, 0}, glm::angleAxis(0.9, x), {3, 1, 5}};
    const Transform half = added(base, source, reference, 0.5, all);
    CHECK(half.location == glm::dvec3(1, 1, 0));
    CHECK(distance(half.rotation, glm::angleAxis(0.5, z) * glm::angleAxis(0.4, x)) < 1e-15);
    CHECK(half.scale == glm::dvec3(2.5, 2, 2));  // a reference of 0 says nothing
    test::Random random(3);
    for (int i = 0; i < 200; ++i) {
        const Transform one = random_transform(random);
        const Transform other = random_transform(random);
        const Transform same = added(one, other, other, random.between(0.0, 1.0), all);
        CHECK(glm::length(same.location - one.location) == 0.0);
        CHECK(distance(same.rotation, one.rotation) < 1e-7);
        CHECK(glm::length(same.scale - one.scale) < 1e-15);
        // On top of the reference itself all of it is the source.
        const Transform whole = added(other, one, other, 1.0, all);
        CHECK(glm::length(whole.location - one.location) < 1e-14);
        CHECK(distance(whole.rotation, one.rotation) < 1e-7);
        CHECK(glm::length(whole.scale - one.scale) < 1e-14);
    }
}

TEST_CASE("the difference of two transforms, applied to the first, gives the second", "[layers]") {
    test::Random random(4);
    for (int i = 0; i < 200; ++i) {
        const Transform base = random_transform(random);
        const Transform result = random_transform(random);
        const Transform move = between_transforms(base, result);
        CHECK(glm::length(base.location + move.location - result.location) < 1e-14);
        CHECK(distance(base.rotation * move.rotation, result.rotation) < 1e-7);
        CHECK(glm::length(base.scale * move.scale - result.scale) < 1e-14);
    }
    const Transform flat{{0, 0, 0}, no_turn, {0, 1, 1}};
    CHECK(between_transforms(flat, Transform{}).scale == glm::dvec3(1, 1, 1));
}
