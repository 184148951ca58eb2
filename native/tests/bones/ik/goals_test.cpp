// Orientation, stretch and guards, limits, and the way back from a pose to its target.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "motus/bones/ik/ik.hpp"
#include "motus/bones/turns.hpp"
#include "sample_rigs.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::ik;
using namespace motus::bones::ik::checks;
using namespace motus::test;

TEST_CASE("a hand takes the target's orientation by its weight", "[rig_ik]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        for (const double position : {1.0, 0.4, 0.0}) {
            Solve solve = sample(seed, 2, false, 0.7);
            solve.settings[0].position_weight = position;
            solve.run();
            const glm::dquat goal = orientation(glm::inverse(solve.world) * solve.targets[0]);
            const glm::dquat carried = orientation(solve.effector_pose(0));
            CHECK(solve.rotations[2] == no_turn);
            for (const double weight : {0.3, 1.0}) {
                solve.settings[0].rotation_weight = weight;
                solve.run();
                const glm::dquat now = orientation(solve.effector_pose(0));
                CHECK(angle_between(now, between(carried, goal, weight)) < 1e-7);
                CHECK(solve.report[0].angle == Approx(angle_between(now, goal)).margin(1e-7));
            }
        }
    }
}

TEST_CASE("a tail bone takes the orientation and stays on its target", "[rig_ik]") {
    for (unsigned seed = 0; seed < 30; ++seed) {
        for (const int count : {3, 4, 6}) {
            Solve solve = sample(seed, count, true, 0.5);
            solve.run();
            const glm::dquat goal = orientation(glm::inverse(solve.world) * solve.targets[0]);
            const glm::dquat before = orientation(solve.effector_pose(0));
            for (const double weight : {0.5, 1.0}) {
                solve.settings[0].rotation_weight = weight;
                solve.run();
                const glm::dquat now = orientation(solve.effector_pose(0));
                CHECK(angle_between(now, between(before, goal, weight)) < 1e-7);
                CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-11));
                if (solve.report[0].reason == Reason::reached)
                    CHECK(solve.miss(0) < 1e-9 * length_of(solve, 0));
            }
            // Small weights make small differences.
            solve.settings[0].rotation_weight = 0.0;
            solve.run();
            const std::vector<glm::dmat4> without = solve.chain_poses(0);
            solve.settings[0].rotation_weight = 1e-6;
            solve.run();
            const std::vector<glm::dmat4> with = solve.chain_poses(0);
            for (std::size_t i = 0; i < with.size(); ++i)
                CHECK(angle_between(orientation(without[i]), orientation(with[i])) < 1e-4);
            // The position switched off, the bone turns where it is.
            solve.settings[0].rotation_weight = 1.0;
            solve.settings[0].position_weight = 0.0;
            solve.run();
            for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(count); ++i)
                CHECK(solve.rotations[i] == no_turn);
            CHECK(angle_between(orientation(solve.effector_pose(0)), goal) < 1e-7);
        }
    }
}

TEST_CASE("stretch takes the tip to the target, and guards know nothing of it", "[rig_ik]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        for (const InheritScale mode : modes) {
            for (const bool use_tail : {true, false}) {
                for (const double softness : {0.0, 0.15}) {
                    RandomRig random(seed);
                    Solve solve;
                    const Limb limb = add_limb(solve.rig, random, 2 + static_cast<int>(seed % 2), 1.0,
                                               random.place(), mode);
                    std::vector<int> others;
                    for (const int bone : limb.bones) {
                        const glm::dmat4 rest = random.place();
                        const glm::dvec3 scale = random.scale();
                        others.push_back(solve.rig.add(bone, rest, 0.3, random.place(scale), mode));
                    }
                    solve.add_chain({limb.bones, use_tail ? limb.bones.back() : limb.hand}, glm::dvec3(0.0),
                                    exact());
                    for (const int bone : others) solve.guards.push_back({bone, 0});
                    solve.guards.push_back({limb.hand, 0});
                    solve.settings[0].softness = softness;
                    const glm::dvec3 target =
                        root_of(solve, 0) + 1.4 * length_of(solve, 0) * random.direction();
                    solve.targets[0] = transform(target, random.rotation());

                    // Without stretch: where the guards belong.
                    solve.run();
                    std::vector<glm::dmat4> plain = solve.chain_poses(0);
                    std::vector<glm::dmat3> expected;
                    for (std::size_t i = 0; i < others.size(); ++i)
                        expected.emplace_back(solve.posed(others[i], plain[i], no_turn, glm::dvec3(1.0)));
                    expected.emplace_back(solve.posed(limb.hand, plain.back(), no_turn, glm::dvec3(1.0)));
                    others.push_back(limb.hand);

                    solve.settings[0].stretch = 1.0;
                    solve.run();
                    INFO("seed " << seed << ", mode " << static_cast<int>(mode) << ", tail " << use_tail);
                    CHECK(solve.miss(0) < 1e-8);
                    CHECK(solve.report[0].reason == Reason::reached);
                    CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-11));
                    CHECK(solve.scales[0].y > 1.2);
                    const std::vector<glm::dmat4> stretched = solve.chain_poses(0);
                    for (std::size_t i = 0; i < others.size(); ++i) {
                        const glm::dmat4& parent = i < stretched.size() ? stretched[i] : stretched.back();
                        const glm::dmat3 now(hanging_pose(solve, others[i], parent));
                        CHECK(difference(now, expected[i]) < 1e-6);
                    }
                    // Half of it.
                    solve.settings[0].stretch = 0.5;
                    solve.run();
                    const double distance = solve.report[0].distance;
                    CHECK(solve.report[0].residual ==
                          Approx(0.5 * (distance - solve.report[0].reach)).epsilon(1e-6));
                    // No weight, no stretch.
                    solve.settings[0].position_weight = 0.0;
                    solve.run();
                    for (std::size_t i = 0; i < limb.bones.size(); ++i)
                        CHECK(solve.scales[i] == glm::dvec3(1.0));
                }
            }
        }
    }
}

TEST_CASE("stretched bones keep their volume as far as they are told", "[rig_ik]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        for (const InheritScale mode : modes) {
            for (const double softness : {0.0, 0.15}) {
                RandomRig random(seed);
                Solve solve;
                const int bones = 1 + static_cast<int>(seed % 3);
                const Limb limb = add_limb(solve.rig, random, bones, 1.0, random.place(), mode);
                solve.add_chain({limb.bones, limb.bones.back()}, glm::dvec3(0.0), exact());
                solve.settings[0].softness = softness;
                const glm::dvec3 target = root_of(solve, 0) + 1.6 * length_of(solve, 0) * random.direction();
                solve.targets[0] = transform(target, random.rotation());
                solve.run();
                const std::vector<glm::dmat4> plain = solve.chain_poses(0);
                solve.settings[0].stretch = 1.0;
                INFO("seed " << seed << ", mode " << static_cast<int>(mode) << ", softness " << softness);
                for (const double volume : {0.5, 1.0}) {
                    solve.settings[0].volume = volume;
                    solve.run();
                    CHECK(solve.miss(0) < 1e-8);
                    CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-11));
                    for (const glm::dvec3& scale : solve.scales) {
                        CHECK(scale.x == scale.z);
                        CHECK(scale.x * scale.z == Approx(std::pow(scale.y, -volume)).epsilon(1e-12));
                    }
                }
                CHECK(solve.scales[0].y > 1.2);
                const bool is_plain = mode == InheritScale::full || mode == InheritScale::none;
                const std::vector<glm::dmat4> stretched = solve.chain_poses(0);
                for (std::size_t i = 0; is_plain && i < stretched.size(); ++i) {
                    const double before = glm::determinant(glm::dmat3(plain[i]));
                    CHECK(glm::determinant(glm::dmat3(stretched[i])) == Approx(before).epsilon(1e-6));
                }
                // Half of the weight, half of the stretch, and across by the same formula.
                const double whole = solve.scales[0].y;
                solve.settings[0].position_weight = 0.5;
                solve.run();
                CHECK(solve.scales[0].y == Approx(0.5 * (1.0 + whole)).epsilon(1e-12));
                CHECK(solve.scales[0].x == Approx(1.0 / std::sqrt(solve.scales[0].y)).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("without stretch there is no volume to keep", "[rig_ik]") {
    Solve solve = sample(3, 3, true, 0.7);
    solve.run();
    const std::vector<glm::dquat> rotations = solve.rotations;
    solve.settings[0].volume = 1.0;
    solve.run();
    CHECK(solve.rotations == rotations);
    for (const glm::dvec3& scale : solve.scales) CHECK(scale == glm::dvec3(1.0));
}

TEST_CASE("a guarded hand takes the target's orientation in pose space", "[rig_ik]") {
    Solve solve = sample(2, 2, false, 1.3);
    solve.guards.push_back({solve.chains[0].effector, 0});
    const ChainPlan plan(solve.rig.parents, solve.chains, solve.guards);
    REQUIRE(plan.rows().size() == 3);
    CHECK(plan.is_absolute()[2] == 1);
    solve.settings[0].stretch = 1.0;
    solve.settings[0].rotation_weight = 1.0;
    solve.run();
    CHECK(angle_between(solve.rotations[2], orientation(glm::inverse(solve.world) * solve.targets[0])) <
          1e-7);
    CHECK(solve.report[0].angle < 1e-7);
}

TEST_CASE("a stretched chain turns its tail bone to the target", "[rig_ik]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        for (const double weight : {0.4, 1.0}) {
            Solve solve = sample(seed, 3, true, 1.3);
            solve.settings[0].stretch = 1.0;
            solve.settings[0].rotation_weight = weight;
            solve.run();
            CHECK(solve.miss(0) < 1e-8);
            CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-11));
            if (weight == 1.0) CHECK(solve.report[0].angle < 1e-7);
        }
    }
}

TEST_CASE("a matched target gives the FK pose back", "[rig_ik]") {
    for (unsigned seed = 0; seed < 30; ++seed) {
        for (const int count : {1, 2, 3, 6}) {
            RandomRig random(seed);
            Solve solve = sample(seed, count, seed % 2 == 0, 0.7, seed % 3 == 0 ? 0.02 : 1.0);
            if (seed % 4 == 0)
                solve.world = solve.world * glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.2, 0.7));
            solve.settings[0].softness = seed % 5 == 0 ? 0.3 : 0.0;
            solve.settings[0].bend = seed % 2 == 0 ? -1 : 1;
            solve.settings[0].pole_angle = random.between(-3.0, 3.0);
            solve.settings[0].rotation_weight = 1.0;
            const ChainPlan plan(solve.rig.parents, solve.chains, solve.guards);
            match(plan, solve.input(plan), solve.targets, solve.poles);
            solve.run();
            INFO("seed " << seed << ", " << count << " bones");
            // A soft reach hardly moves near its end: what is exact there is the target, not the pose.
            const double tolerance = seed % 5 == 0 ? 1e-5 : 1e-7;
            for (const glm::dquat& rotation : solve.rotations) CHECK(angle_of_turn(rotation) < tolerance);
            CHECK(glm::distance(solve.tip(0), solve.tip(0, true)) <
                  1e-9 * length_of(solve, 0) + tolerance * 1e-3);
            CHECK(solve.report[0].angle < 1e-7);
            // The target is rigid.
            const glm::dmat3 axes(solve.targets[0]);
            CHECK(difference(glm::transpose(axes) * axes, glm::dmat3(1.0)) < 1e-12);
            CHECK(glm::determinant(axes) > 0.0);
        }
    }
}

TEST_CASE("one bone with limits does not roll towards a pole", "[rig_ik]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        RandomRig random(seed);
        Solve solve = sample(seed, 1, true, 0.6);
        solve.settings[0].use_limits = true;
        solve.limits.assign(1, chains::JointLimits{});
        solve.run();
        const glm::dquat without = solve.rotations[0];
        solve.poles[0] = root_of(solve, 0) + 3.0 * random.direction();
        solve.settings[0].pole_angle = random.between(-3.0, 3.0);
        solve.run();
        CHECK(angle_between(solve.rotations[0], without) < 1e-7);
    }
}

TEST_CASE("joint limits hold", "[rig_ik]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        Solve solve = sample(seed, 3, seed % 2 == 0, 0.6, 0.3);
        solve.settings[0].tolerance = 1e-6;
        solve.settings[0].use_limits = true;
        solve.limits.assign(3, chains::JointLimits{});
        solve.run();
        CHECK(solve.miss(0) < 1e-5 * length_of(solve, 0));
        chains::JointLimits tight;
        tight.min = glm::dvec3(-0.5, -0.2, -0.5);
        tight.max = glm::dvec3(0.5, 0.2, 0.5);
        solve.limits.assign(3, tight);
        solve.run();
        CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-9));
        for (std::size_t i = 0; i < 3; ++i) {
            const auto bone = static_cast<std::size_t>(solve.chains[0].bones[i]);
            const glm::dquat rotation = own_transform(solve.rig.basis, bone).rotation * solve.rotations[i];
            CHECK(angle_between(rotation, chains::clamp_rotation(rotation, tight)) < 1e-6);
        }
        if (solve.report[0].residual > 1e-4) CHECK(solve.report[0].reason != Reason::reached);
    }
}
