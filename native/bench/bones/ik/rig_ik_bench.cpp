// Inverse kinematics of one rig: time per chain.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <vector>

#include "motus/bones/ik/ik.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::ik;

namespace {

constexpr int chain_count = 100;

/// Arms side by side: a shoulder, `length` bones and a hand each, a little bent.
struct Crowd {
    std::vector<int> parents, inheritance;
    std::vector<float> rest, poses, basis, lengths;
    std::vector<ChainBones> chains;
    std::vector<ChainSettings> settings;
    std::vector<glm::dmat4> targets;
    std::vector<glm::dvec3> poles;
    std::vector<chains::JointLimits> limits;

    explicit Crowd(int length) {
        for (int arm = 0; arm < chain_count; ++arm) {
            ChainBones chain;
            for (int i = 0; i < length + 2; ++i) {
                const int bone = static_cast<int>(parents.size());
                const glm::dvec3 place(arm, i, 0.0);
                add(i > 0 ? bone - 1 : -1, glm::translate(glm::dmat4(1.0), place));
                if (i > 0 && i <= length) chain.bones.push_back(bone);
                chain.effector = bone;
            }
            chains.push_back(chain);
            settings.emplace_back();
            const double angle = 0.1 * arm;
            const glm::dvec3 root(arm, 1.0, 0.0);
            targets.push_back(glm::translate(
                glm::dmat4(1.0), root + 0.6 * length * glm::dvec3(std::cos(angle), 0.5, std::sin(angle))));
            poles.push_back(root + glm::dvec3(0.0, 1.0, 3.0 * length));
        }
    }
    [[nodiscard]] RigView rig() const { return {{parents, rest, poses, basis, lengths, inheritance}}; }
    [[nodiscard]] ChainInput input(const ChainPlan& plan, const ik::RestBones& at_rest) const {
        return {
            AnimatedBones(plan, at_rest, basis), poses, glm::dmat4(1.0), settings, targets, poles, limits};
    }

  private:
    void add(int parent, const glm::dmat4& place) {
        parents.push_back(parent);
        inheritance.push_back(inherits_rotation | has_local_location);
        lengths.push_back(1.0f);
        const glm::dmat4 own = glm::mat4_cast(glm::angleAxis(0.2, glm::dvec3(1.0, 0.0, 0.0)));
        for (int i = 0; i < 16; ++i) {
            rest.push_back(static_cast<float>(place[i / 4][i % 4]));
            poses.push_back(static_cast<float>((place * own)[i / 4][i % 4]));
            basis.push_back(static_cast<float>(own[i / 4][i % 4]));
        }
    }
};

void run(const bench::Table& table, const char* name, int length, const ChainSettings& settings,
         bool has_pole, bool has_limits = false) {
    Crowd crowd(length);
    crowd.settings.assign(chain_count, settings);
    if (!has_pole) crowd.poles.assign(chain_count, glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
    if (has_limits)
        crowd.limits.assign(static_cast<std::size_t>(chain_count * length), chains::JointLimits{});
    const ChainPlan plan(crowd.parents, crowd.chains, {});
    std::vector<glm::dquat> rotations(plan.rows().size());
    std::vector<glm::dvec3> scales(plan.rows().size());
    std::vector<ChainDiagnostics> report(chain_count);
    const ik::RestBones rest(plan, crowd.rig());
    const ChainInput input = crowd.input(plan, rest);
    const auto solve = [&] { ik::solve(plan, input, {rotations, scales, report}); };
    const auto read_and_solve = [&] {
        ik::solve(plan, crowd.input(plan, rest), {rotations, scales, report});
    };
    const double time = bench::nanoseconds(solve, 50);
    const double whole = bench::nanoseconds(read_and_solve, 50);
    bench::keep(rotations);
    table.row(name, {1e-3 * time / chain_count, 1e-3 * whole / chain_count});
}

}  // namespace

int main() {
    const bench::Table table("A chain of a rig of " + std::to_string(chain_count) + " chains, one thread",
                             {{"solve", "us"}, {"read and solve", "us"}});
    ChainSettings plain;
    ChainSettings turned = plain;
    turned.rotation_weight = 1.0;
    ChainSettings soft = turned;
    soft.softness = 0.2;
    soft.stretch = 1.0;
    ChainSettings limited = plain;
    limited.use_limits = true;
    run(table, "two bones", 2, plain, false);
    run(table, "two bones, pole", 2, plain, true);
    run(table, "two bones, pole, orientation", 2, turned, true);
    run(table, "two bones, pole, orientation, soft, stretch", 2, soft, true);
    run(table, "ten bones", 10, plain, false);
    run(table, "two bones, limits", 2, limited, false, true);
    return 0;
}
