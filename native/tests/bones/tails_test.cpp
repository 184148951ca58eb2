#include "motus/bones/tails.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

#include "motus/bones/turns.hpp"
#include "random.hpp"

using namespace motus::bones;
using motus::test::Random;

namespace {

/// Bones one long, each on the tail of the one before, up along the rig's Z; all of a rig's arrays.
struct Rope {
    explicit Rope(std::size_t count) : rest(16 * count), poses(16 * count), basis(16 * count) {
        for (std::size_t i = 0; i < count; ++i) {
            parents.push_back(static_cast<int>(i) - 1);
            inheritance.push_back(inherits_rotation | has_local_location);
            put(rest, i, rest_matrix(i));
            put(basis, i, glm::dmat4(1.0));
        }
    }

    [[nodiscard]] static glm::dmat4 rest_matrix(std::size_t bone) {
        const glm::dmat4 upright = glm::rotate(glm::dmat4(1.0), 1.5707963267948966, {1.0, 0.0, 0.0});
        return glm::translate(glm::dmat4(1.0), {0.0, 0.0, static_cast<double>(bone)}) * upright;
    }
    static void put(std::vector<float>& matrices, std::size_t bone, const glm::dmat4& matrix) {
        for (int i = 0; i < 16; ++i)
            matrices[16 * bone + static_cast<std::size_t>(i)] = static_cast<float>(matrix[i / 4][i % 4]);
    }
    [[nodiscard]] RigView view() const { return {{parents, rest, poses, basis, {}, inheritance}}; }

    /// Poses with the rotations of some bones on top of their own.
    [[nodiscard]] std::vector<glm::dmat4> posed(std::span<const int> bones,
                                                std::span<const glm::dquat> rotations) const {
        std::vector<glm::dmat4> found;
        for (std::size_t bone = 0; bone < parents.size(); ++bone) {
            glm::dmat4 own = matrix_at(basis, bone);
            for (std::size_t i = 0; i < bones.size(); ++i) {
                if (bones[i] == static_cast<int>(bone)) own = own * glm::mat4_cast(rotations[i]);
            }
            const glm::dmat4 above = bone == 0 ? glm::dmat4(1.0) : found[bone - 1];
            found.push_back(to_pose(parent_space(rest_of(view(), bone), above), own));
        }
        return found;
    }

    std::vector<int> parents, inheritance;
    std::vector<float> rest, poses, basis;
};

glm::dvec3 point(const glm::dmat4& pose, double along) {
    return glm::dvec3(pose * glm::dvec4(0.0, along, 0.0, 1.0));
}

}  // namespace

TEST_CASE("each tail points to its place from where its head has come", "[tails]") {
    Random random(21);
    for (int round = 0; round < 50; ++round) {
        Rope rope(6);
        for (std::size_t bone = 0; bone < 6; ++bone) {
            const glm::dvec3 axis(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 0.4);
            Rope::put(rope.basis, bone,
                      glm::rotate(glm::dmat4(1.0), random.between(-1.0, 1.0), glm::normalize(axis)));
        }
        const std::vector<glm::dmat4> animated = rope.posed({}, {});
        for (std::size_t bone = 0; bone < 6; ++bone) Rope::put(rope.poses, bone, animated[bone]);
        const std::array bones{4, 1, 2};  // bone 3 is carried by what turns
        const TailPlan plan(rope.parents, bones);
        const glm::dmat4 world =
            glm::rotate(glm::translate(glm::dmat4(1.0), {3.0, -2.0, 1.0}), 0.7, {0.0, 1.0, 0.0});
        std::array<glm::dvec3, 3> targets{};
        for (glm::dvec3& target : targets)
            target = {random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.between(-9.0, 9.0)};
        std::array<glm::dquat, 3> turns{};
        plan.solve(rope.view(), world, targets, std::array{1.0, 1.0, 1.0}, turns);
        const auto poses = rope.posed(bones, turns);
        for (std::size_t i = 0; i < bones.size(); ++i) {
            const glm::dmat4 pose = world * poses[static_cast<std::size_t>(bones[i])];
            const glm::dvec3 head = point(pose, 0.0);
            CHECK(angle_between(point(pose, 1.0) - head, targets[i] - head) < 1e-6);
            CHECK(glm::length(point(pose, 1.0) - head) == Approx(1.0).epsilon(1e-6));
        }
    }
}

TEST_CASE("tails that point there stay as they are, and so do those that nothing turns", "[tails]") {
    const Rope rope(3);
    const std::array bones{0, 1, 2};
    const TailPlan plan(rope.parents, bones);
    std::array<glm::dquat, 3> turns{};
    const std::array<glm::dvec3, 3> above{{{0.0, 0.0, 1.0}, {0.0, 0.0, 2.0}, {0.0, 0.0, 7.0}}};
    plan.solve(rope.view(), glm::dmat4(1.0), above, std::array{1.0, 1.0, 1.0}, turns);
    for (const glm::dquat& turn : turns) CHECK(angle_of_turn(turn) < 1e-7);
    // Its own head, no weight, and no number.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::array<glm::dvec3, 3> odd{{{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, {nan, 0.0, 0.0}}};
    plan.solve(rope.view(), glm::dmat4(1.0), odd, std::array{1.0, 0.0, 1.0}, turns);
    for (const glm::dquat& turn : turns) CHECK(turn == no_turn);
    // A rig of no size.
    plan.solve(rope.view(), glm::dmat4(0.0), above, std::array{1.0, 1.0, 1.0}, turns);
    for (const glm::dquat& turn : turns) CHECK(turn == no_turn);
    // Half of the way.
    const std::array<glm::dvec3, 3> beside{{{9.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
    plan.solve(rope.view(), glm::dmat4(1.0), beside, std::array{0.5, 0.0, 0.0}, turns);
    CHECK(angle_of_turn(turns[0]) == Approx(0.25 * 3.14159265358979).epsilon(1e-6));
}

TEST_CASE("plans of tails refuse what is no rig", "[tails]") {
    const std::array parents{-1, 0, 1};
    CHECK_THROWS_AS(TailPlan(parents, std::array{3}), std::invalid_argument);
    CHECK_THROWS_AS(TailPlan(parents, std::array{-1}), std::invalid_argument);
    CHECK_THROWS_AS(TailPlan(parents, std::array{1, 1}), std::invalid_argument);
    CHECK_THROWS_AS(TailPlan(std::array{-2}, std::array{0}), std::invalid_argument);
    CHECK_THROWS_AS(TailPlan(std::array{1, 0}, std::array{0}), std::invalid_argument);
    const TailPlan plan(parents, std::array{0});
    std::array<glm::dquat, 1> turns{};
    CHECK_THROWS_AS(
        plan.solve(Rope(2).view(), glm::dmat4(1.0), std::array{glm::dvec3(1.0)}, std::array{1.0}, turns),
        std::invalid_argument);
}
