// Numbers that are not finite, chains without length, plans that make no sense.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "motus/bones/ik/ik.hpp"
#include "motus/bones/turns.hpp"
#include "sample_rigs.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::ik;
using namespace motus::bones::ik::checks;
using namespace motus::test;
using std::numbers::pi;

namespace {

/// Three limbs of one rig.
Solve three_chains() {
    RandomRig random(77);
    Solve solve;
    for (int i = 0; i < 3; ++i) {
        const Limb limb = add_limb(solve.rig, random, 2 + i, 1.0, random.place());
        solve.add_chain({limb.bones, i == 1 ? limb.hand : limb.bones.back()}, 0.5 * random.vector(), exact());
        solve.settings.back().rotation_weight = 0.5;
        solve.settings.back().stretch = 0.5;
        if (i != 1) solve.guards.push_back({limb.hand, i});
    }
    solve.limits.assign(9, chains::JointLimits{});
    return solve;
}

bool is_finite(const Solve& solve) {
    double sum = 0.0;
    for (const glm::dquat& q : solve.rotations) sum += 0.0 * (q.w + q.x + q.y + q.z);
    for (const glm::dvec3& v : solve.scales) sum += 0.0 * (v.x + v.y + v.z);
    for (const ChainDiagnostics& r : solve.report)
        sum +=
            0.0 * (r.residual + r.angle + r.iterations + r.distance + r.reach + r.tip.x + r.tip.y + r.tip.z);
    return sum == 0.0;
}

}  // namespace

TEST_CASE("a chain with a number that is not finite is neutral and disturbs no other", "[rig_ik]") {
    Solve sound = three_chains();
    sound.run();
    const auto bone = static_cast<std::size_t>(sound.chains[1].bones[1]);
    const auto infinite = std::numeric_limits<float>::infinity();
    for (int damage = 0; damage < 10; ++damage) {
        Solve solve = three_chains();
        if (damage == 0) solve.targets[1][3].y = not_a_number;
        if (damage == 1) solve.settings[1].stretch = not_a_number;
        if (damage == 2) solve.poles[1] = glm::dvec3(0.0, std::numeric_limits<double>::infinity(), 0.0);
        if (damage == 3) solve.rig.basis[16 * bone + 5] = std::nanf("");
        if (damage == 4) solve.rig.rest[16 * bone] = infinite;
        if (damage == 5)
            solve.rig.poses[16 * (static_cast<std::size_t>(solve.chains[1].bones[0]) - 1)] = infinite;
        if (damage == 6)
            solve.rig.basis[16 * static_cast<std::size_t>(solve.chains[1].effector) + 12] = infinite;
        if (damage == 7) {
            solve.settings[1].use_limits = true;
            solve.limits[2].min.x = not_a_number;
        }
        if (damage == 8) solve.targets[1][3].x = 1e300;
        if (damage == 9) solve.settings[1].is_on = false;
        solve.run();
        INFO("damage " << damage);
        CHECK(is_finite(solve));
        CHECK(solve.report[1].reason == (damage == 9 ? std::optional(Reason::reached) : std::nullopt));
        const std::size_t first = 2;
        for (std::size_t row = 0; row < solve.rows.size(); ++row) {
            const bool is_of_chain =
                (row >= first && row < first + 3) || solve.rows[row] == solve.chains[1].effector;
            if (is_of_chain) {
                CHECK(solve.rotations[row] == no_turn);
                CHECK(solve.scales[row] == glm::dvec3(1.0));
            } else {
                CHECK(solve.rotations[row] == sound.rotations[row]);
                CHECK(solve.scales[row] == sound.scales[row]);
            }
        }
        CHECK(solve.report[0].residual == sound.report[0].residual);
        CHECK(solve.report[2].residual == sound.report[2].residual);
    }
}

TEST_CASE("a chain's results do not depend on the others", "[rig_ik]") {
    Solve all = three_chains();
    all.run();
    for (std::size_t chain = 0; chain < 3; ++chain) {
        Solve one = three_chains();
        one.chains = {all.chains[chain]};
        one.guards.clear();
        if (chain != 1) one.guards.push_back({all.guards[chain == 0 ? 0 : 1].bone, 0});
        one.settings = {all.settings[chain]};
        one.targets = {all.targets[chain]};
        one.poles = {all.poles[chain]};
        one.limits.clear();
        one.run();
        for (std::size_t row = 0; row < one.rows.size(); ++row) {
            CHECK(one.rotations[row] == all.rotations[all.row_of(one.rows[row])]);
            CHECK(one.scales[row] == all.scales[all.row_of(one.rows[row])]);
        }
    }
}

TEST_CASE("guarded bones of a muted chain keep the FK pose", "[rig_ik]") {
    Solve solve = three_chains();
    solve.settings[0].is_on = false;
    solve.run();
    const int guard = solve.guards[0].bone;
    const glm::dmat3 expected(
        solve.posed(guard, solve.chain_poses(0, true).back(), no_turn, glm::dvec3(1.0)));
    CHECK(difference(glm::dmat3(hanging_pose(solve, guard, solve.chain_poses(0).back())), expected) < 1e-6);
}

TEST_CASE("degenerate chains stay finite", "[rig_ik]") {
    for (const int count : {1, 2, 3, 5}) {
        for (int degenerate = 0; degenerate < 6; ++degenerate) {
            for (const bool use_limits : {false, true}) {
                Solve solve;
                std::vector<int> bones;
                for (int i = 0; i < count; ++i) {
                    const double length = degenerate == 0 || (degenerate == 1 && i == 0) ? 0.0 : 1.0;
                    const glm::dvec3 scale = degenerate == 2   ? glm::dvec3(0.0)
                                             : degenerate == 3 ? glm::dvec3(1, 0, 1)
                                                               : glm::dvec3(1.0);
                    const double fold = degenerate == 4 && i > 0 ? pi : 0.0;
                    const glm::dquat own = glm::angleAxis(fold, glm::dvec3(1, 0, 0));
                    bones.push_back(solve.rig.add(i - 1, glm::dmat4(1.0), length,
                                                  transform(glm::dvec3(0.0), own, scale)));
                }
                solve.add_chain({bones, bones.back()}, glm::dvec3(0.0));
                solve.limits.assign(static_cast<std::size_t>(count), chains::JointLimits{});
                solve.settings[0].use_limits = use_limits;
                solve.settings[0].stretch = 1.0;
                solve.settings[0].rotation_weight = 0.7;
                for (const glm::dvec3& target : {glm::dvec3(0.0), glm::dvec3(0, -1, 0), glm::dvec3(0, 100, 0),
                                                 glm::dvec3(1e-30, 0, 0)}) {
                    for (const glm::dvec3& pole : {glm::dvec3(not_a_number), glm::dvec3(0.0), target}) {
                        solve.targets[0][3] = glm::dvec4(target, 1.0);
                        solve.poles[0] = pole;
                        solve.run();
                        INFO(count << " bones, case " << degenerate << ", limits " << use_limits);
                        CHECK(is_finite(solve));
                        CHECK(solve.report[0].residual == Approx(solve.miss(0)).margin(1e-9));
                    }
                }
            }
        }
    }
}

TEST_CASE("bones that are left out carry the chain as they are animated", "[rig_ik]") {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        for (const bool use_tail : {true, false}) {
            Solve whole = sample(seed, 5, use_tail, 0.3);
            const std::size_t left_out = 1 + seed % 4;
            whole.settings[0].left_out = left_out;
            whole.settings[0].rotation_weight = seed % 2 == 0 ? 1.0 : 0.0;
            // The bones as a chain of their own, whose parent stands where it is animated.
            Solve part = whole;
            part.settings[0].left_out = 0;
            part.chains[0].bones.erase(part.chains[0].bones.begin(),
                                       part.chains[0].bones.begin() + static_cast<std::ptrdiff_t>(left_out));
            whole.run();
            part.run();
            INFO("seed " << seed << ", tail " << use_tail);
            for (std::size_t row = 0; row < left_out; ++row) {
                CHECK(whole.rotations[row] == no_turn);
                CHECK(whole.scales[row] == glm::dvec3(1.0));
            }
            for (std::size_t row = 0; row < part.rows.size(); ++row) {
                CHECK(whole.rows[left_out + row] == part.rows[row]);
                CHECK(angle_between(whole.rotations[left_out + row], part.rotations[row]) < 1e-5);
            }
            CHECK(whole.report[0].residual == Approx(part.report[0].residual).margin(1e-6));
            CHECK(whole.report[0].reach == Approx(part.report[0].reach).epsilon(1e-6));
        }
    }
}

TEST_CASE("a chain keeps at least one bone whichever bones are left out", "[rig_ik]") {
    for (const std::size_t left_out :
         {std::size_t{4}, std::size_t{5}, std::numeric_limits<std::size_t>::max()}) {
        Solve solve = sample(3, 5, true, 0.5);
        solve.settings[0].left_out = left_out;
        solve.run();
        Solve same = sample(3, 5, true, 0.5);
        same.settings[0].left_out = 4;
        same.run();
        CHECK(solve.rotations == same.rotations);
        CHECK(solve.miss(0) == Approx(solve.report[0].residual).margin(1e-9));
    }
}

TEST_CASE("guards on bones that are left out stay where they are animated", "[rig_ik]") {
    Solve solve = sample(8, 4, true, 2.0);
    const std::vector<int> bones = solve.chains[0].bones;
    const int low = solve.rig.add(bones[0], transform(glm::dvec3(0.1), no_turn), 0.3);
    const int high = solve.rig.add(bones[2], transform(glm::dvec3(0.1), no_turn), 0.3);
    solve.guards = {{low, 0}, {high, 0}};
    solve.settings[0].stretch = 1.0;
    solve.settings[0].left_out = 2;
    solve.run();
    const std::vector<glm::dmat4> poses = solve.chain_poses(0);
    for (const auto& [guard, place] : {std::pair{low, 0}, std::pair{high, 2}}) {
        const glm::dmat4 shown = hanging_pose(solve, guard, poses[static_cast<std::size_t>(place)]);
        CHECK(is_finite(solve));
        CHECK(solve.scales[solve.row_of(guard)].y == Approx(glm::length(glm::dvec3(shown[1]))));
    }
    const glm::dmat4 low_pose = hanging_pose(solve, low, poses[0]);
    CHECK(difference(glm::dmat3(low_pose),
                     glm::dmat3(matrix_at(solve.rig.poses, static_cast<std::size_t>(low)))) < 1e-5);
}

TEST_CASE("a plan says which of its bones make no chain", "[rig_ik]") {
    const std::vector<int> parents{-1, 0, 1, 1, 3};
    const auto refused = [&](std::vector<ChainBones> chains, const std::vector<Guard>& guards,
                             const char* argument) {
        try {
            const ChainPlan plan(parents, std::move(chains), guards);
        } catch (const std::invalid_argument& problem) {
            return std::string(problem.what()).rfind(argument, 0) == 0;
        }
        return false;
    };
    CHECK(refused({{{}, 0}}, {}, "chains"));
    CHECK(refused({{{0, 2}, 2}}, {}, "chains"));
    CHECK(refused({{{5}, 5}}, {}, "chains"));
    CHECK(refused({{{0, 1}, 4}}, {}, "effectors"));
    CHECK(refused({{{0, 1}, -1}}, {}, "effectors"));
    CHECK(refused({{{0, 1}, 1}}, {{1, 0}}, "guards"));
    CHECK(refused({{{0, 1}, 1}}, {{4, 0}}, "guards"));
    CHECK(refused({{{0, 1}, 1}}, {{2, 1}}, "guards"));
    CHECK_THROWS_AS(ChainPlan({-1, 7}, {}, {}), std::invalid_argument);

    const ChainPlan plan(parents, {{{0, 1}, 2}, {{3, 4}, 4}}, {{3, 0}, {2, 0}});
    const std::vector<int> rows(plan.rows().begin(), plan.rows().end());
    CHECK(rows == std::vector<int>{0, 1, 3, 4, 2, 3});
    const std::vector<int> absolute(plan.is_absolute().begin(), plan.is_absolute().end());
    CHECK(absolute == std::vector<int>{0, 0, 0, 0, 1, 1});
    CHECK_THROWS_AS(ik::solve(plan, {}, {}), std::invalid_argument);
}

TEST_CASE("an array of bones has to fit its plan", "[rig_ik]") {
    Solve solve = three_chains();
    const ChainPlan plan(solve.rig.parents, solve.chains, solve.guards);
    const ChainPlan copy = plan;  // NOLINT(performance-unnecessary-copy-initialization)
    const ik::RestBones rest(plan, solve.rig.view());
    CHECK_NOTHROW(AnimatedBones(copy, rest, solve.rig.basis));

    // A plan with equal numbers of bones, rows and chains, in a different order.
    std::vector<ChainBones> turned(solve.chains.rbegin(), solve.chains.rend());
    std::vector<Guard> guards = solve.guards;
    for (Guard& guard : guards) guard.chain = static_cast<int>(turned.size()) - 1 - guard.chain;
    const ChainPlan other(solve.rig.parents, turned, guards);
    REQUIRE(other.rows().size() == plan.rows().size());
    CHECK_THROWS_AS(AnimatedBones(other, rest, solve.rig.basis), std::invalid_argument);
    const ChainInput input = solve.input(plan);
    solve.rotations.resize(plan.rows().size());
    solve.scales.resize(plan.rows().size());
    solve.report.resize(plan.chain_count());
    const ChainOutput output{solve.rotations, solve.scales, solve.report};
    CHECK_NOTHROW(ik::solve(copy, input, output));
    CHECK_THROWS_AS(ik::solve(other, input, output), std::invalid_argument);
    std::vector<glm::dmat4> targets(plan.chain_count());
    std::vector<glm::dvec3> poles(plan.chain_count());
    CHECK_THROWS_AS(match(other, input, targets, poles), std::invalid_argument);

    Rig rig = solve.rig;
    rig.parents[0] = rig.size() - 1;
    CHECK_THROWS_AS(ik::RestBones(plan, rig.view()), std::invalid_argument);
}

TEST_CASE("each setting that is not finite, and limits that leave nothing, make a chain neutral",
          "[rig_ik]") {
    constexpr double ChainSettings::*settings[] = {
        &ChainSettings::position_weight, &ChainSettings::rotation_weight, &ChainSettings::softness,
        &ChainSettings::stretch,         &ChainSettings::volume,          &ChainSettings::pole_angle,
        &ChainSettings::hinge_angle,     &ChainSettings::tolerance};
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (double ChainSettings::*const setting : settings) {
        for (const double value : {not_a_number, infinite, -infinite}) {
            Solve solve = sample(3, 3, true, 0.7);
            solve.settings[0].*setting = value;
            solve.run();
            CHECK_FALSE(solve.report[0].reason);
            for (const glm::dquat& rotation : solve.rotations) CHECK(rotation == no_turn);
        }
    }
    for (const double value : {not_a_number, infinite, -infinite}) {
        Solve solve = sample(3, 3, true, 0.7);
        solve.settings[0].use_limits = true;
        solve.limits.resize(3);
        solve.limits[1].min.x = solve.limits[1].max.x = value;
        solve.run();
        CHECK_FALSE(solve.report[0].reason);
        for (const glm::dquat& rotation : solve.rotations) CHECK(rotation == no_turn);
    }
}

TEST_CASE("own transforms are taken apart as Blender does", "[rig_ik]") {
    RandomRig random(1);
    for (int i = 0; i < 50; ++i) {
        Rig rig;
        const glm::dvec3 scale = i % 2 == 0 ? random.scale() : -random.scale();
        const glm::dmat4 own = random.place(scale);
        rig.add(-1, glm::dmat4(1.0), 1.0, own);
        const OwnTransform parts = own_transform(rig.basis, 0);
        CHECK(difference(glm::dmat3(transform(parts.location, parts.rotation, parts.scale)),
                         glm::dmat3(own)) < 1e-6);
        CHECK(glm::distance(parts.scale, scale) < 1e-6);
    }
}
