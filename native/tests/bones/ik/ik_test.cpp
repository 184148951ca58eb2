// Targets, poles, planes and softness.
#include "motus/bones/ik/ik.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "motus/bones/chains/two_bone.hpp"
#include "motus/bones/turns.hpp"
#include "sample_rigs.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::ik;
using namespace motus::bones::ik::checks;
using namespace motus::test;

TEST_CASE("the tip of a rigid chain is on its target", "[rig_ik]") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        for (const int count : {2, 3, 5, 12}) {
            for (const bool use_tail : {true, false}) {
                Solve solve = sample(seed, count, use_tail, 0.7);
                solve.run();
                INFO(count << " bones, seed " << seed);
                CHECK(solve.miss(0) < 1e-9 * length_of(solve, 0));
                CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-12));
                CHECK(solve.report[0].reason == Reason::reached);
                CHECK(glm::distance(solve.report[0].tip, solve.tip(0)) < 1e-12);
                for (const glm::dvec3& scale : solve.scales) CHECK(scale == glm::dvec3(1.0));
            }
        }
    }
}

TEST_CASE("a chain reaches its target in mirrored and unevenly scaled worlds", "[rig_ik]") {
    int reached = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        Solve solve = sample(seed, 2 + static_cast<int>(seed % 3), seed % 2 == 0, 0.6);
        solve.world = solve.world * glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.3, 0.9));
        RandomRig random(seed);
        const glm::dvec3 target = root_of(solve, 0) + 0.5 * random.direction();
        solve.targets[0] = transform(target, random.rotation());
        solve.settings[0].rotation_weight = seed % 2 == 0 ? 0.0 : 1.0;
        solve.run();
        if (solve.report[0].reason == Reason::reached) ++reached;  // some are too near
        if (solve.report[0].reason == Reason::reached) CHECK(solve.miss(0) < 1e-9 * length_of(solve, 0));
        CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-12));
        CHECK(solve.report[0].angle < 1e-7);
    }
    CHECK(reached > 14);
}

TEST_CASE("the residual that a sheared chain reports is the measured one", "[rig_ik]") {
    int reached = 0, all = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        for (const InheritScale mode : modes) {
            RandomRig random(seed);
            Solve solve;
            const glm::dvec3 scale = seed % 5 == 0 ? random.scale() * glm::dvec3(-1, 1, 1) : random.scale();
            const int flags =
                (seed % 3 == 0 ? 0 : inherits_rotation) | (seed % 4 == 0 ? 0 : has_local_location);
            const Limb limb = add_limb(solve.rig, random, 2 + static_cast<int>(seed % 3), 1.0,
                                       random.place(scale), mode, flags);
            solve.add_chain({limb.bones, seed % 2 == 0 ? limb.bones.back() : limb.hand}, glm::dvec3(0.0),
                            exact());
            solve.targets[0][3] =
                glm::dvec4(root_of(solve, 0) + 0.55 * length_of(solve, 0) * random.direction(), 1.0);
            solve.run();
            CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-11));
            ++all;
            if (solve.miss(0) < 1e-6) ++reached;
        }
    }
    CHECK(reached > 9 * all / 10);
}

namespace {

/// A chain of 2 to 4 bones, each of which has a scale of its own that those after it inherit: the straight
/// chain is not the longest.
Solve squashed(unsigned seed, InheritScale mode) {
    RandomRig random(seed);
    Solve solve;
    std::vector<int> bones{solve.rig.add(-1, random.place(), 0.5, random.place(random.scale()))};
    for (int i = 0; i < 2 + static_cast<int>(seed % 3); ++i) {
        const glm::dmat4 rest = transform(glm::dvec3(0.0), random.turn(0.3));
        const glm::dmat4 own = transform(glm::dvec3(0.0), random.turn(0.5), random.scale());
        bones.push_back(solve.rig.add(bones.back(), rest, random.between(0.5, 1.5), own, mode));
    }
    bones.erase(bones.begin());
    solve.add_chain({bones, bones.back()}, glm::dvec3(0.0), exact());
    return solve;
}

}  // namespace

TEST_CASE("squashed chains reach what turns of their bones reach", "[rig_ik]") {
    for (const InheritScale mode : modes) {
        int missed = 0;
        constexpr int all = 400;
        for (unsigned seed = 0; seed < all; ++seed) {
            Solve solve = squashed(seed, mode);
            solve.run();
            RandomRig random(seed + all);
            for (glm::dquat& rotation : solve.rotations) rotation = random.rotation();
            std::fill(solve.scales.begin(), solve.scales.end(), glm::dvec3(1.0));
            solve.targets[0][3] = glm::dvec4(solve.tip(0), 1.0);
            solve.run();
            CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-11));
            if (solve.miss(0) > 1e-6 * length_of(solve, 0)) ++missed;
        }
        INFO("mode " << static_cast<int>(mode) << ": missed " << missed << " of " << all);
        CHECK(missed <= (mode == InheritScale::fix_shear ? all / 100 : 0));
    }
}

TEST_CASE("a squashed chain does not let go of a target that moves", "[rig_ik]") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        Solve solve = squashed(seed, InheritScale::full);
        const glm::dvec3 root = root_of(solve, 0);
        const glm::dvec3 way = RandomRig(seed + 1).direction();
        const double step = 0.01 * length_of(solve, 0);
        double before = 0.0;
        for (int i = 20; i < 200; ++i) {
            solve.targets[0][3] = glm::dvec4(root + (i * step) * way, 1.0);
            solve.run();
            INFO("seed " << seed << ", step " << i);
            if (i > 20) CHECK(solve.miss(0) < before + 1.1 * step);
            before = solve.miss(0);
        }
    }
}

TEST_CASE("out of reach a chain is straight and says why", "[rig_ik]") {
    for (const int count : {1, 2, 3, 6}) {
        Solve solve = sample(3, count, true, 1.5);
        solve.run();
        CHECK(solve.report[0].reason == Reason::too_far);
        CHECK(solve.report[0].residual ==
              Approx(solve.report[0].distance - solve.report[0].reach).epsilon(1e-6));
        CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-11));
    }
    Solve solve = sample(3, 1, true, 0.3);
    solve.run();
    CHECK(solve.report[0].reason == Reason::too_near);
}

TEST_CASE("a chain's weight blends from the FK pose to the solution by slerp", "[rig_ik]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        Solve solve = sample(seed, 3, seed % 2 == 0, 0.7);
        solve.run();
        const std::vector<glm::dquat> whole = solve.rotations;
        const ChainDiagnostics report = solve.report[0];
        solve.settings[0].position_weight = 0.0;
        solve.run();
        for (const glm::dquat& rotation : solve.rotations) CHECK(rotation == no_turn);
        CHECK(solve.report[0].residual == report.residual);
        for (const double weight : {0.25, 0.5, 0.999}) {
            solve.settings[0].position_weight = weight;
            solve.run();
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK(angle_of_turn(solve.rotations[i]) ==
                      Approx(weight * angle_of_turn(whole[i])).margin(1e-9));
                CHECK(solve.rotations[i].w >= 0.0);
            }
        }
    }
}

TEST_CASE("a hinge stays a hinge, however the forearm is twisted", "[rig_ik]") {
    for (const double twist : {0.0, 0.7, -2.5}) {
        for (const bool with_pole : {false, true}) {
            RandomRig random(8);
            Solve solve;
            // The elbow bends about X; the forearm then turns about itself.
            const int upper = solve.rig.add(-1, glm::dmat4(1.0), 1.0, random.place());
            const glm::dquat elbow =
                glm::angleAxis(0.9, glm::dvec3(1, 0, 0)) * glm::angleAxis(twist, glm::dvec3(0, 1, 0));
            const int fore = solve.rig.add(upper, glm::dmat4(1.0), 0.8, transform(glm::dvec3(0.0), elbow));
            solve.add_chain({{upper, fore}, fore}, glm::dvec3(0.0), exact());
            solve.targets[0][3] = glm::dvec4(root_of(solve, 0) + 1.3 * random.direction(), 1.0);
            if (with_pole) solve.poles[0] = root_of(solve, 0) + 3.0 * random.direction();
            solve.run();
            CHECK(solve.miss(0) < 1e-9);
            // The forearm's new rotation over its old one, in the upper arm's axes.
            const glm::dquat turn = elbow * solve.rotations[1] * glm::conjugate(elbow);
            const glm::dvec3 axis = glm::normalize(glm::dvec3(turn.x, turn.y, turn.z));
            CHECK(std::abs(axis.x) == Approx(1.0).margin(1e-7));
        }
    }
}

TEST_CASE("the middle joint is on the pole's side, or opposite, or turned by the angle", "[rig_ik]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        for (const int count : {2, 3}) {
            RandomRig random(seed + 100);
            Solve solve = sample(seed, count, true, 0.6);
            const glm::dvec3 root = root_of(solve, 0), target(solve.targets[0][3]);
            solve.poles[0] = root + 5.0 * random.direction();
            const glm::dvec3 along = glm::normalize(target - root);
            const auto across = [&](const glm::dvec3& v) {
                return glm::normalize(v - glm::dot(v, along) * along);
            };
            for (const int bend : {1, -1}) {
                for (const double angle : {0.0, 0.8}) {
                    solve.settings[0].bend = bend;
                    solve.settings[0].pole_angle = angle;
                    solve.run();
                    CHECK(solve.miss(0) < 1e-8);
                    if (count > 2) continue;
                    const glm::dvec3 elbow = glm::dvec3(solve.world * solve.chain_poses(0)[1][3]) - root;
                    const glm::dvec3 expected = glm::angleAxis(angle, along) *
                                                across(static_cast<double>(bend) * (solve.poles[0] - root));
                    CHECK(glm::distance(across(elbow), expected) < 1e-7);
                }
            }
        }
    }
}

TEST_CASE("a pose that hardly bends faces the pole once the chain bends thrice as much", "[rig_ik]") {
    for (const double degrees : {-5.0, -3.0, -1.0, 1.0, 3.0, 5.0}) {
        for (const glm::dvec3& pole : {glm::dvec3(1, 0, -5), glm::dvec3(1, 0, 5), glm::dvec3(1, 5, 0)}) {
            const double angle = glm::radians(degrees);
            const double thrice = 3.0 * std::sin(0.5 * std::abs(angle));  // of the bones' length
            Solve solve;
            const int upper = solve.rig.add(-1, glm::dmat4(1.0), 1.0);
            const glm::dquat own = glm::angleAxis(angle, glm::dvec3(1, 0, 0));
            const int lower = solve.rig.add(upper, glm::dmat4(1.0), 1.0, transform(glm::dvec3(0.0), own));
            solve.add_chain({{upper, lower}, lower}, glm::dvec3(0.0), exact());
            solve.poles[0] = pole;
            for (const double height : {1.01 * thrice, 2.0 * thrice, 0.9}) {
                const double distance = 2.0 * std::sqrt(1.0 - height * height);
                solve.targets[0][3] = glm::dvec4(distance, 0.0, 0.0, 1.0);
                solve.run();
                const glm::dvec3 elbow(solve.chain_poses(0)[1][3]);
                const glm::dvec3 side = glm::normalize(glm::dvec3(0.0, pole.y, pole.z));
                CAPTURE(degrees, height, pole.y, pole.z);
                CHECK(solve.miss(0) < 1e-8);
                CHECK(glm::distance(glm::dvec3(0.0, elbow.y, elbow.z), height * side) < 1e-6);
            }
        }
    }
}

TEST_CASE("a straight chain bends about its hinge", "[rig_ik]") {
    for (const int count : {2, 4}) {
        for (const double angle : {0.0, 0.6, -2.0}) {
            Solve solve;
            std::vector<int> bones;
            for (int i = 0; i < count; ++i) bones.push_back(solve.rig.add(i - 1, glm::dmat4(1.0), 1.0));
            solve.add_chain({bones, bones.back()}, glm::dvec3(0.0, 0.8 * count, 0.0), exact());
            solve.settings[0].hinge_angle = angle;
            solve.run();
            CHECK(solve.miss(0) < 1e-9 * count);
            const glm::dvec3 hinge(std::cos(angle), 0.0, -std::sin(angle));
            const glm::dvec3 elbow(solve.chain_poses(0)[1][3]);
            CHECK(std::abs(glm::dot(elbow, hinge)) < 1e-9);
            CHECK(glm::dot(glm::cross(hinge, glm::dvec3(0, 1, 0)), elbow) > 0.1);
        }
    }
}

namespace {

/// A chain bent about X, its target, pole or FK pose moved along a line by t from -1 to 1; the largest turn
/// of a bone from one step to the next, rad.
enum class Sweep { target, pole, pole_across_line, animation };
double largest_step(Sweep sweep, int count, int steps) {
    const double size = count;
    Solve solve;
    std::vector<int> bones;
    for (int i = 0; i < count; ++i) {
        const glm::dquat own = glm::angleAxis(i == 0 ? 0.1 : 0.5, glm::dvec3(1, 0, 0));
        bones.push_back(solve.rig.add(i - 1, glm::dmat4(1.0), 1.0, transform(glm::dvec3(0.0), own)));
    }
    solve.add_chain({bones, bones.back()}, glm::dvec3(0.0), exact());
    std::vector<glm::dquat> before;
    double worst = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const double t = 2.0 * i / steps - 1.0;
        glm::dvec3 target(0.2 * size, 0.6 * size, 0.2);
        if (sweep == Sweep::target)
            target = size * glm::dvec3(1.2 * t, 0.4, 0.3);  // near the root and out of reach
        if (sweep == Sweep::pole) solve.poles[0] = size * glm::dvec3(2.0 * t, 0.7, -1.0);
        if (sweep == Sweep::pole_across_line) {
            target = {0.0, 0.7 * size, 0.0};
            solve.poles[0] = size * glm::dvec3(0.0, 0.5, t);
        }
        if (sweep == Sweep::animation) {  // through the straight pose
            const glm::dmat4 own = transform(glm::dvec3(0.0), glm::angleAxis(0.5 * t, glm::dvec3(1, 0, 0)));
            std::vector<float> values;
            Rig::store(values, own);
            for (int bone = 1; bone < count; ++bone)
                std::copy(values.begin(), values.end(), solve.rig.basis.begin() + 16 * bone);
        }
        solve.targets[0][3] = glm::dvec4(target, 1.0);
        solve.run();
        std::vector<glm::dquat> now;
        for (const glm::dmat4& pose : solve.chain_poses(0)) now.push_back(orientation(pose));
        for (std::size_t k = 0; k < before.size(); ++k)
            worst = std::max(worst, angle_between(before[k], now[k]));
        before = now;
    }
    return worst;
}

}  // namespace

TEST_CASE("no bone flips while target, pole or FK pose sweep", "[rig_ik]") {
    for (const int count : {2, 3, 5}) {
        for (const Sweep sweep : {Sweep::target, Sweep::pole, Sweep::pole_across_line, Sweep::animation}) {
            INFO("sweep " << static_cast<int>(sweep) << ", " << count << " bones");
            const double coarse = largest_step(sweep, count, 400);
            const double fine = largest_step(sweep, count, 1600);
            CHECK(fine < 0.15);
            CHECK(fine < 0.6 * coarse);  // a jump would stay as it is, however small the steps
        }
    }
}

TEST_CASE("softness keeps the tip where soft_reach says", "[rig_ik]") {
    for (const double share : {0.5, 0.85, 0.95, 1.05, 1.5}) {
        Solve solve = sample(4, 3, true, share);
        solve.settings[0].softness = 0.2;
        solve.run();
        const double reach = solve.report[0].reach;
        const double expected = chains::soft_reach(solve.report[0].distance, reach, 0.2 * reach);
        CHECK(glm::distance(solve.tip(0), root_of(solve, 0)) == Approx(expected).epsilon(1e-6));
        CHECK(solve.report[0].reason == (share < 0.8 ? Reason::reached : Reason::too_far));
    }
}
