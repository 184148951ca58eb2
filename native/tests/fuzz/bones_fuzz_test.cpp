// Bones, chains and rigs with numbers that nobody expects.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "extremes.hpp"
#include "motus/bones/chains/limited.hpp"
#include "motus/bones/chains/two_bone.hpp"
#include "motus/bones/ik/ik.hpp"
#include "motus/bones/look_at/plan.hpp"
#include "motus/bones/pose.hpp"
#include "motus/bones/space.hpp"
#include "motus/bones/tails.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::test;

namespace {

/// A rig of five bones, one after the other, and another one on the first.
struct Rig {
    explicit Rig(Dice& dice)
        : rest(dice.matrices(6)), poses(dice.matrices(6)), basis(dice.matrices(6)), inheritance(6) {
        for (int& one : inheritance) one = dice.whole(0, 31);
        for (int i = 0; i < 6; ++i) lengths.push_back(dice.single(0.1, 2.0));
    }
    [[nodiscard]] RigView view() const { return {{parents, rest, poses, basis, lengths, inheritance}}; }

    std::vector<int> parents{-1, 0, 1, 2, 3, 0};
    std::vector<float> rest, poses, basis, lengths;
    std::vector<int> inheritance;
};

[[nodiscard]] bool are_rotations(const std::vector<glm::dquat>& rotations) {
    return std::ranges::all_of(rotations,
                               [](const glm::dquat& q) { return std::abs(glm::dot(q, q) - 1.0) < 1e-6; });
}

[[nodiscard]] bool are_reasonable(const chains::Convergence& report) {
    return std::isfinite(report.residual) && report.iterations >= 0;
}

}  // namespace

TEST_CASE("two bones of arbitrary numbers are refused or give finite results", "[fuzz]") {
    for (const double share : {0.05, 0.5}) {
        Dice dice(11, share);
        std::vector<chains::TwoBone> all;
        for (int round = 0; round < 3000; ++round) {
            const chains::TwoBone chain{.root = dice.place(),
                                        .target = dice.place(),
                                        .pole = dice.place(),
                                        .length1 = dice.number(0.0, 2.0),
                                        .length2 = dice.number(0.0, 2.0),
                                        .softness = dice.number(0.0, 0.5),
                                        .stretch = dice.number(0.0, 1.0),
                                        .plane = dice.chance(0.5) ? glm::dvec3(0.0) : dice.place(),
                                        .bend = dice.chance(0.5) ? 1 : -1};
            const bool is_valid = is_finite(chain.root) && is_finite(chain.target) && is_finite(chain.pole) &&
                                  is_finite(chain.plane) && are_finite(chain.softness, chain.stretch) &&
                                  chain.length1 >= 0.0 && std::isfinite(chain.length1) &&
                                  chain.length2 >= 0.0 && std::isfinite(chain.length2);
            const bool was_solved = returns([&] {
                const chains::TwoBoneSolution found = solve_two_bone(chain);
                CHECK((is_finite(found.elbow) && is_finite(found.tip) && is_finite(found.normal)));
                CHECK((std::isfinite(found.residual) && std::isfinite(found.scale)));
            });
            CHECK(was_solved == is_valid);
            if (is_valid) all.push_back(chain);
        }
        std::vector<chains::TwoBoneSolution> out(all.size());
        chains::solve_two_bones(all, out);
        all.back().target.z = not_a_number;
        out[0].residual = 77.0;
        CHECK(is_refused([&] { chains::solve_two_bones(all, out); }, "target"));
        CHECK(out[0].residual == 77.0);
        out.pop_back();
        CHECK(is_refused([&] { chains::solve_two_bones(all, out); }, "out"));
    }
    Dice dice(12, 0.5);
    for (int round = 0; round < 3000; ++round) {
        (void)chains::soft_reach(dice.number(), dice.number(), dice.number());
        returns([&] { (void)chains::triangle_angle(dice.number(), dice.number(), dice.number()); });
    }
}

TEST_CASE("a target that is NaN counts as not reached", "[fuzz]") {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double bad : {not_a_number, infinity, -infinity}) {
            glm::dvec3 target(0.5);
            target[axis] = bad;
            std::vector<glm::dvec3> joints{{0, 0, 0}, {0, 1, 0}, {0, 2, 0.1}, {0, 3, 0}};
            const auto before = joints;
            CHECK(is_refused([&] { chains::solve(joints, target, {}); }, "target"));
            CHECK(joints == before);
            CHECK(is_refused([&] { (void)chains::solve_two_bone({.target = target}); }, "target"));
            const std::vector<glm::dquat> rest(3, no_turn);
            std::vector<glm::dquat> rotations(3, no_turn);
            const std::vector<glm::dvec3> offsets(3, glm::dvec3(0.0, 1.0, 0.0));
            const std::vector<chains::JointLimits> limits(3);
            CHECK(is_refused(
                [&] {
                    chains::solve_limited({.rest = rest, .offsets = offsets, .limits = limits}, target, {},
                                          rotations);
                },
                "target"));
            joints[2][axis] = bad;
            CHECK(is_refused([&] { chains::solve(joints, glm::dvec3(1.0), {}); }, "joints"));
        }
    }
    std::vector<glm::dvec3> joints{{0, 0, 0}, {0, 1, 0}, {0, 2, 0.1}, {0, 3, 0}};
    const auto refused_by = [&](const chains::SolverSettings& settings, const char* name) {
        return is_refused([&] { chains::solve(joints, glm::dvec3(1.0), settings); }, name);
    };
    CHECK(refused_by({not_a_number, 100, {}, {}}, "tolerance"));
    CHECK(refused_by({-1.0, 100, {}, {}}, "tolerance"));
    CHECK(refused_by({1e-6, -1, {}, {}}, "max_iterations"));
    CHECK(refused_by({1e-6, 100, glm::dvec3(not_a_number), {}}, "pole"));
    CHECK(refused_by({1e-6, 100, {}, glm::dvec3(infinity)}, "plane"));
    // Lengths that are no numbers beside a pole that is far away: no way of solving ends in another that
    // begins with it.
    CHECK(is_refused(
        [] {
            (void)chains::solve_two_bone(
                {.pole = {0.0, 1e101, 0.0}, .length1 = not_a_number, .length2 = 1e150});
        },
        "length1"));
}

TEST_CASE("chains of arbitrary numbers are refused or give finite results", "[fuzz]") {
    Dice dice(13, 0.06);
    for (int round = 0; round < 1500; ++round) {
        std::vector<glm::dvec3> joints = dice.places(2 + dice.below(5));
        chains::SolverSettings settings;
        settings.tolerance = dice.chance(0.9) ? 1e-6 : dice.number();
        settings.max_iterations = dice.chance(0.9) ? 100 : dice.whole(-1, 3);
        if (dice.chance(0.4)) settings.pole = dice.place();
        if (dice.chance(0.4)) settings.plane = dice.place();
        returns([&] {
            const chains::Convergence report = chains::solve(joints, dice.place(), settings);
            CHECK(are_reasonable(report));
            for (const glm::dvec3& joint : joints) CHECK(is_finite(joint));
        });
        std::vector<glm::dquat> frames(joints.size() - 1);
        returns([&] { chains::bone_frames(joints, frames); });
    }
}

TEST_CASE("chains with limits of arbitrary numbers are refused or give finite results", "[fuzz]") {
    Dice dice(14, 0.02);
    for (int round = 0; round < 60; ++round) {
        const std::size_t count = 1 + dice.below(3);
        const std::vector<glm::dquat> rest = dice.quaternions(count);
        std::vector<glm::dquat> rotations = dice.quaternions(count);
        const std::vector<glm::dvec3> offsets = dice.places(count);
        std::vector<chains::JointLimits> limits(count);
        for (chains::JointLimits& one : limits)
            if (dice.chance(0.7)) {
                one.min = dice.place();
                one.max = one.min + glm::dvec3(dice.number(0.0, 2.0));
            }
        const chains::Limited chain{dice.place(), dice.quaternion(), rest, offsets, limits};
        chains::SolverSettings settings;
        settings.max_iterations = 20;
        std::optional<glm::dquat> orientation;
        if (dice.chance(0.3)) orientation = dice.quaternion();
        returns([&] {
            const chains::Convergence report =
                chains::solve_limited(chain, dice.place(), settings, rotations, orientation);
            CHECK(are_reasonable(report));
            CHECK(are_rotations(rotations));
        });
        std::vector<glm::dvec3> joints(count + 1);
        returns([&] { chains::joints_of(chain, rotations, joints); });
        CHECK(is_refused([&] { chains::joints_of(chain, rotations, std::span(joints).first(count)); },
                         "joints"));
    }
}

TEST_CASE("poses made of finite numbers are finite", "[fuzz]") {
    Dice dice(15, 0.3);
    for (int round = 0; round < 1000; ++round) {
        const glm::dmat4 pose = dice.matrix();
        const Rest rest{dice.matrix(),    dice.matrix(),    dice.chance(0.7),
                        dice.chance(0.7), dice.chance(0.7), static_cast<InheritScale>(dice.whole(0, 5))};
        const ParentSpace space = parent_space(rest, pose);
        (void)to_pose(space, pose);
        (void)to_basis(space, pose);
        (void)linear_space(offset_of(rest), glm::dmat3(pose));
        (void)inverse_axes(glm::dmat3(pose));
        (void)frame_of(glm::dmat3(pose));
        (void)euler_xyz(dice.quaternion());
        (void)share_of_turn(dice.quaternion(), dice.number(0.0, 1.0));
        (void)angle_between(dice.place(), dice.place());
        (void)angle_of_turn(dice.quaternion());
        (void)smallest_turn_between(dice.place(), dice.place(), [] { return glm::dvec3(1.0, 0.0, 0.0); });
        const chains::JointLimits limits{dice.place(), dice.place()};
        returns([&] { (void)chains::clamp_rotation(dice.any_rotation(), limits); });
    }
    const Rig rig(dice);
    CHECK(is_refused([&] { (void)matrix_at(rig.rest, 6); }, "bone"));
    CHECK(is_refused([&] { (void)rest_of(rig.view(), 6); }, "bone"));
    Rig shorter = rig;
    shorter.rest.resize(16);
    CHECK(is_refused([&] { (void)shorter.view(); }, "rest"));
    const std::vector<glm::dvec3> places(3);
    const std::vector<glm::dquat> turns(3, no_turn);
    std::vector<float> out(47);
    CHECK(is_refused([&] { pack_matrices(places, turns, out); }, "out"));
}

TEST_CASE("a plan takes the rig that it was made for", "[fuzz]") {
    Dice dice(16, 0.0);
    const Rig rig(dice);
    Rig foreign = rig;
    foreign.parents = {-1, 0, 1, 2, 3, 100'000'000};
    CHECK(is_refused([&] { (void)foreign.view(); }, "parents"));
    foreign.parents = {-1, 0, 1, 2, 3, 1};
    const RigView other = foreign.view();

    const std::vector<int> turning{1, 2};
    const TailPlan tails(rig.parents, turning);
    const std::vector<glm::dvec3> targets(2, glm::dvec3(1.0));
    const std::vector<double> weights(2, 1.0);
    std::vector<glm::dquat> turns(2);
    tails.solve(rig.view(), glm::dmat4(1.0), targets, weights, turns);
    CHECK(is_refused([&] { tails.solve(other, glm::dmat4(1.0), targets, weights, turns); }, "rig"));

    const std::vector<look_at::GazeBones> heads{{.body = {0, 1}, .head = 3, .eyes = {4}}};
    const look_at::GazePlan looks(rig.parents, heads);
    const std::vector<glm::dvec3> eyes{{0.0, 1.0, 0.0}};
    std::vector<look_at::GazeInput> inputs(1);
    std::vector<glm::dquat> rows(looks.rows().size());
    std::vector<look_at::GazeDiagnostics> reports(1);
    CHECK(
        is_refused([&] { looks.solve(rig.view(), glm::dmat4(1.0), inputs, rows, reports); }, "eyes_forward"));
    inputs[0].eyes_forward = eyes;
    looks.solve(rig.view(), glm::dmat4(1.0), inputs, rows, reports);
    CHECK(is_refused([&] { looks.solve(other, glm::dmat4(1.0), inputs, rows, reports); }, "rig"));

    ik::ChainPlan plan(rig.parents, {{{1, 2, 3}, 4}}, {});
    CHECK(is_refused([&] { (void)ik::RestBones(plan, other); }, "rig"));
    const ik::RestBones rest(plan, rig.view());
    CHECK(is_refused([&] { (void)ik::AnimatedBones(plan, {}, rig.basis); }, "rest"));
    CHECK(is_refused([&] { (void)ik::AnimatedBones(plan, rest, std::span(rig.basis).first(16)); }, "basis"));
    CHECK(is_refused([&] { ik::solve(plan, {}, {}); }, "bones"));
    const ik::ChainPlan taken = std::move(plan);
    // NOLINTNEXTLINE(bugprone-use-after-move): what this is about
    CHECK(is_refused([&] { ik::solve(plan, {}, {}); }, "bones"));
    CHECK(rest.is_of(taken));
}

TEST_CASE("rigs of arbitrary numbers are solved to finite rotations", "[fuzz]") {
    for (const double share : {0.002, 0.05}) {
        Dice dice(17, share);
        for (int round = 0; round < 25; ++round) {
            const Rig rig(dice);
            const glm::dmat4 world = dice.matrix();

            const std::vector<int> turning{1, 3, 5};
            const TailPlan tails(rig.parents, turning);
            std::vector<glm::dquat> turns(3);
            tails.solve(rig.view(), world, dice.places(3), dice.numbers(3, 0.0, 1.0), turns);
            CHECK(are_rotations(turns));

            const std::vector<look_at::GazeBones> heads{{.body = {0, 1}, .head = 3, .eyes = {4}}};
            const look_at::GazePlan looks(rig.parents, heads);
            look_at::GazeInput input;
            input.settings = {dice.number(0.0, 1.0), dice.number(0.0, 1.0), dice.number(0.0, 1.0),
                              dice.number(0.0, 1.0), dice.number(0.0, 1.0), dice.number(0.0, 4.0),
                              dice.number(0.0, 4.0), dice.number(0.0, 4.0)};
            input.target = dice.place();
            input.head_forward = dice.place();
            const std::vector<glm::dvec3> eyes = dice.places(1);
            input.eyes_forward = eyes;
            input.up = dice.place();
            const std::vector<look_at::GazeInput> inputs(1, input);
            std::vector<glm::dquat> rows(looks.rows().size());
            std::vector<look_at::GazeDiagnostics> reports(1);
            looks.solve(rig.view(), world, inputs, rows, reports);
            CHECK(are_rotations(rows));
            CHECK(are_finite(reports[0].angle, reports[0].yaw, reports[0].pitch));
            if (!is_finite(input.target)) CHECK(!reports[0].reason);

            const ik::ChainPlan plan(rig.parents, {{{1, 2, 3}, 4}, {{0, 5}, 5}}, {});
            ik::ChainInput task;
            task.bones = ik::AnimatedBones(plan, ik::RestBones(plan, rig.view()), rig.basis);
            task.poses = rig.poses;
            task.world = world;
            std::vector<ik::ChainSettings> settings(2);
            for (ik::ChainSettings& one : settings)
                one = {dice.number(0.0, 1.0),
                       dice.number(0.0, 1.0),
                       dice.number(0.0, 0.5),
                       dice.number(0.0, 1.0),
                       dice.number(),
                       dice.number(),
                       dice.chance(0.5) ? 1 : -1,
                       dice.number(),
                       1e-6,
                       20,
                       dice.chance(0.5),
                       true,
                       static_cast<std::size_t>(dice.whole(0, 2))};
            const std::vector<glm::dmat4> targets{dice.matrix(), dice.matrix()};
            const std::vector<glm::dvec3> poles = dice.places(2);
            std::vector<chains::JointLimits> limits(plan.chain_bone_count(),
                                                    {glm::dvec3(-1.0), glm::dvec3(1.0)});
            if (dice.chance(0.2)) limits[0].min = dice.place();
            task.settings = settings;
            task.targets = targets;
            task.poles = poles;
            task.limits = limits;
            std::vector<glm::dquat> rotations(plan.rows().size());
            std::vector<glm::dvec3> scales(plan.rows().size());
            std::vector<ik::ChainDiagnostics> report(2);
            ik::solve(plan, task, {rotations, scales, report});
            CHECK(are_rotations(rotations));
            for (const glm::dvec3& scale : scales) CHECK(is_finite(scale));
            for (const ik::ChainDiagnostics& one : report)
                CHECK(are_finite(one.residual, one.distance, one.reach));
            std::vector<glm::dmat4> matched(2);
            std::vector<glm::dvec3> matched_poles(2);
            ik::match(plan, task, matched, matched_poles);
            for (const glm::dmat4& one : matched) CHECK(is_finite(one));
        }
    }
}

TEST_CASE("gazes in any direction are finite", "[fuzz]") {
    Dice dice(18, 0.3);
    for (int round = 0; round < 500; ++round) {
        const look_at::GazeChart chart(dice.direction(), dice.direction());
        const look_at::GazeSettings settings{
            dice.number(0.0, 1.0), dice.number(0.0, 1.0), dice.number(0.0, 1.0), dice.number(0.0, 1.0),
            dice.number(0.0, 1.0), dice.number(0.0, 4.0), dice.number(0.0, 4.0), dice.number(0.0, 4.0)};
        (void)look_at::turns_to(chart, dice.direction(), dice.direction(), settings);
        (void)chart.turn(chart.place(dice.direction()), {dice.number(), dice.number()});
    }
}
