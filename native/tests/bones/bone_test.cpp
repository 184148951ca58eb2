#include "motus/bones/bone.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "motus/bones/space.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::bones;

namespace {

constexpr std::array modes{InheritScale::full,    InheritScale::fix_shear, InheritScale::aligned,
                           InheritScale::average, InheritScale::none,      InheritScale::none_legacy};

class RandomBones : public test::Random {
  public:
    RandomBones() : Random(5) {}
    glm::dvec3 scale() { return {between(0.4, 2.0), between(0.4, 2.0), between(0.4, 2.0)}; }
    glm::dmat4 rigid() {
        const glm::dvec3 place = around_origin();
        return glm::translate(glm::dmat4(1.0), place) * glm::mat4_cast(any_rotation());
    }
    glm::dmat4 transform() {
        const glm::dmat4 placed = rigid();
        return placed * glm::scale(glm::dmat4(1.0), scale());
    }
    /// Rotated, scaled, sheared, and mirrored every other time.
    glm::dmat4 affine() {
        const glm::dmat4 placed = transform();
        const glm::dmat4 turned = placed * glm::mat4_cast(any_rotation());
        const glm::dmat4 sheared = turned * glm::scale(glm::dmat4(1.0), scale());
        return chance(0.5) ? sheared : sheared * glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
    }
    Rest bone(InheritScale mode, bool inherit_rotation = true, bool local_location = true) {
        return {rigid(), rigid(), true, inherit_rotation, local_location, mode};
    }
};

double difference(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0.0;
    for (int i = 0; i < 16; ++i) largest = std::max(largest, std::abs(a[i / 4][i % 4] - b[i / 4][i % 4]));
    return largest;
}

glm::dmat4 pose_of(const Rest& bone, const glm::dmat4& parent_pose, const glm::dmat4& basis) {
    return to_pose(parent_space(bone, parent_pose), basis);
}

}  // namespace

TEST_CASE("a bone without a parent stands on its rest", "[bone]") {
    RandomBones random;
    Rest bone;
    bone.matrix = random.rigid();
    const glm::dmat4 basis = random.transform();
    CHECK(difference(pose_of(bone, glm::dmat4(0.0), basis), bone.matrix * basis) < 1e-12);
    bone.local_location = false;
    const glm::dmat4 pose = pose_of(bone, glm::dmat4(0.0), basis);
    CHECK(glm::distance(glm::dvec3(pose[3]), glm::dvec3(bone.matrix[3] + basis[3])) < 1e-12);
}

TEST_CASE("in full inheritance a pose is the parent's times the offset at rest", "[bone]") {
    RandomBones random;
    for (int i = 0; i < 50; ++i) {
        const Rest bone = random.bone(InheritScale::full);
        const glm::dmat4 parent = random.affine();
        const glm::dmat4 basis = random.transform();
        const glm::dmat4 expected = parent * glm::inverse(bone.parent_matrix) * bone.matrix * basis;
        CHECK(difference(pose_of(bone, parent, basis), expected) < 1e-12);
    }
}

TEST_CASE("no mode changes anything under a parent that is not scaled", "[bone]") {
    RandomBones random;
    for (const InheritScale mode : modes) {
        const Rest bone = random.bone(mode);
        const glm::dmat4 parent = random.rigid();
        const glm::dmat4 basis = random.transform();
        const glm::dmat4 expected = parent * glm::inverse(bone.parent_matrix) * bone.matrix * basis;
        CHECK(difference(pose_of(bone, parent, basis), expected) < 1e-12);
    }
}

TEST_CASE("each inheritance mode takes its share of a scale along the axes", "[bone]") {
    RandomBones random;
    Rest bone;  // the parent and the bone lie along Y, at rest and posed
    bone.has_parent = true;
    const glm::dmat4 parent = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, 3.0, 4.0));
    const auto size = [&](InheritScale mode) {
        bone.inherit_scale = mode;
        const glm::dmat3 pose(pose_of(bone, parent, glm::dmat4(1.0)));
        return glm::dvec3(glm::length(pose[0]), glm::length(pose[1]), glm::length(pose[2]));
    };
    const auto is = [&](InheritScale mode, const glm::dvec3& expected) {
        return glm::distance(size(mode), expected) < 1e-12;
    };
    const double mean = std::cbrt(24.0);
    for (const bool inherit_rotation : {true, false}) {
        bone.inherit_rotation = inherit_rotation;
        CHECK(is(InheritScale::full, {2, 3, 4}));
        CHECK(is(InheritScale::fix_shear, {2, 3, 4}));
        CHECK(is(InheritScale::aligned, {2, 3, 4}));
        CHECK(is(InheritScale::average, {mean, mean, mean}));
        CHECK(is(InheritScale::none, {1, 1, 1}));
        CHECK(is(InheritScale::none_legacy, {1, 1, 1}));
    }
    // Across its parent a bone takes the scale along its own axes, or along the parent's if it is aligned.
    bone.inherit_rotation = true;
    bone.matrix = glm::rotate(glm::dmat4(1.0), 1.5707963267948966, glm::dvec3(0, 0, 1));
    CHECK(is(InheritScale::full, {3, 2, 4}));
    CHECK(is(InheritScale::fix_shear, {3, 2, 4}));
    CHECK(is(InheritScale::aligned, {2, 3, 4}));
}

TEST_CASE("every mode but the legacy one and full takes shear away", "[bone]") {
    RandomBones random;
    for (const InheritScale mode :
         {InheritScale::fix_shear, InheritScale::aligned, InheritScale::average, InheritScale::none}) {
        for (int i = 0; i < 30; ++i) {
            const Rest bone = random.bone(mode);
            const glm::dmat4 parent = random.affine();
            const glm::dmat3 pose(pose_of(bone, parent, glm::mat4_cast(random.any_rotation())));
            const glm::dmat3 axes(parent_space(bone, parent).rotation_scale);
            for (int axis = 0; axis < 3; ++axis)
                CHECK(std::abs(glm::dot(glm::normalize(axes[axis]), glm::normalize(axes[(axis + 1) % 3]))) <
                      2e-4);
            if (mode == InheritScale::none)
                CHECK(std::abs(glm::determinant(pose)) == Approx(1.0).epsilon(1e-6));
        }
    }
}

TEST_CASE("volume survives the removal of shear", "[bone]") {
    RandomBones random;
    for (int i = 0; i < 100; ++i) {
        const glm::dmat3 axes(random.affine());
        const glm::dmat3 straight = without_shear(axes, false);
        CHECK(glm::determinant(straight) == Approx(glm::determinant(axes)).epsilon(1e-6));
        CHECK(glm::length(glm::cross(straight[1], axes[1])) < 1e-12);
    }
}

TEST_CASE("a bone that does not inherit rotation keeps that of its rest", "[bone]") {
    RandomBones random;
    for (const InheritScale mode : modes) {
        const Rest bone = random.bone(mode, false);
        const glm::dmat4 a = pose_of(bone, random.rigid(), glm::dmat4(1.0));
        const glm::dmat4 b = pose_of(bone, random.rigid(), glm::dmat4(1.0));
        CHECK(difference(glm::dmat4(glm::dmat3(a)), glm::dmat4(glm::dmat3(bone.matrix))) < 1e-12);
        CHECK(difference(glm::dmat4(glm::dmat3(a)), glm::dmat4(glm::dmat3(b))) < 1e-12);
    }
}

TEST_CASE("heads go with the parent in every mode", "[bone]") {
    RandomBones random;
    for (const InheritScale mode : modes) {
        for (const bool inherit_rotation : {true, false}) {
            const Rest bone = random.bone(mode, inherit_rotation);
            const glm::dmat4 parent = random.affine();
            const glm::dvec3 head = glm::dvec3(pose_of(bone, parent, glm::dmat4(1.0))[3]);
            const glm::dvec3 carried = glm::dvec3(parent * glm::inverse(bone.parent_matrix) * bone.matrix[3]);
            CHECK(glm::distance(head, carried) < 1e-12);
        }
    }
}

TEST_CASE("without local location a bone moves along its parent's axes", "[bone]") {
    RandomBones random;
    const Rest bone = random.bone(InheritScale::average, true, false);
    const glm::dmat4 parent = random.affine();
    const glm::dvec3 step(0.2, -0.3, 0.5);
    const glm::dvec3 before = glm::dvec3(pose_of(bone, parent, glm::dmat4(1.0))[3]);
    const glm::dvec3 after = glm::dvec3(pose_of(bone, parent, glm::translate(glm::dmat4(1.0), step))[3]);
    CHECK(glm::distance(after - before, glm::dmat3(parent) * step) < 1e-12);
}

TEST_CASE("a bone's own transform can be computed back from its pose", "[bone]") {
    RandomBones random;
    for (const InheritScale mode : modes) {
        for (int i = 0; i < 40; ++i) {
            const Rest bone = random.bone(mode, i % 2 == 0, i % 3 == 0);
            const ParentSpace space = parent_space(bone, random.affine());
            const glm::dmat4 basis = random.transform();
            CHECK(difference(to_basis(space, to_pose(space, basis)), basis) < 1e-9);
        }
    }
}

TEST_CASE("parents flattened to a plane, a line or a point leave everything finite", "[bone]") {
    RandomBones random;
    for (const glm::dvec3 scale :
         {glm::dvec3(0, 1, 1), glm::dvec3(1, 0, 1), glm::dvec3(0, 0, 2), glm::dvec3(0.0)}) {
        for (const InheritScale mode : modes) {
            for (const bool inherit_rotation : {true, false}) {
                const Rest bone = random.bone(mode, inherit_rotation);
                const glm::dmat4 parent = random.rigid() * glm::scale(glm::dmat4(1.0), scale);
                const ParentSpace space = parent_space(bone, parent);
                const glm::dmat4 pose = to_pose(space, random.transform());
                const glm::dmat4 basis = to_basis(space, pose);
                for (int i = 0; i < 16; ++i) {
                    CHECK(std::isfinite(pose[i / 4][i % 4]));
                    CHECK(std::isfinite(basis[i / 4][i % 4]));
                }
            }
        }
    }
    // The axis without scale is taken as it is: the parts along the other axes are restored.
    ParentSpace flat;
    flat.rotation_scale = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, 0.0, 4.0));
    const glm::dmat3 back(to_basis(flat, glm::dmat4(1.0)));
    CHECK(glm::distance(back * glm::dvec3(1.0), glm::dvec3(0.5, 1.0, 0.25)) < 1e-12);
}
