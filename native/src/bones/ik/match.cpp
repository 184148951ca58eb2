// Matching: from an FK pose to the targets and poles for which that pose is the solution.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "aim.hpp"
#include "motus/bones/chains/two_bone.hpp"
#include "motus/bones/ik/ik.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"
#include "pose.hpp"
#include "world.hpp"

namespace motus::bones::ik {
namespace {

/// The distance of a target for which softness and stretch together leave the tip at `distance`.
double distance_before(double distance, double reach, const ChainSettings& settings) {
    const double soft = settings.softness * reach;
    double near = distance;
    double far = std::max(distance, reach + 2.0 * soft);
    constexpr int halvings = 80;
    for (int i = 0; i < halvings && near < far; ++i) {
        const double middle = 0.5 * (near + far);
        const double kept = chains::soft_reach(middle, reach, soft);
        const double tip = kept + settings.stretch * (middle - kept);
        (tip < distance ? near : far) = middle;
    }
    return far;
}

/// Orientation of the effector in the FK pose.
glm::dquat effector_frame(const ChainInput& input, const ChainPlan::Chain& chain, const Pose& pose) {
    const std::size_t last = pose.size() - 1;
    if (!chain.has_free_effector) return pose.frame(last);
    const AnimatedBone& bone = input.bones.rows()[chain.effector.row];
    return frame_in(linear_space(*bone.offset, pose.posed(last).axes), bone.rotation, bone.scale);
}

struct Match {
    glm::dmat4 target{1.0};
    glm::dvec3 pole{0.0};
};

Match match_one(const ChainInput& input, const ChainPlan::Chain& chain, const Pose& pose,
                const RigWorld& world, const ChainSettings& settings) {
    // A tail bone with the target's orientation leaves the rest of the chain to go where it begins.
    const bool turns_tail = !chain.has_free_effector && pose.size() > 1 && settings.rotation_weight >= 0.5 &&
                            !settings.use_limits;
    const std::size_t count = turns_tail ? pose.size() - 1 : pose.size();
    const Chord chord = chord_of(pose, count, settings.hinge_angle);
    double reach = 0.0;
    for (std::size_t i = 0; i < count; ++i) reach += glm::distance(pose.joints()[i], pose.joints()[i + 1]);
    const double distance = glm::distance(pose.root(), pose.joints()[count]);
    const double before = count > 1 ? distance_before(distance, reach, settings) : distance;
    const glm::dvec3 target = pose.tip() + (before - distance) * chord.along;

    Match match;
    match.target = glm::mat4_cast(frame_of(world.axes * glm::mat3_cast(effector_frame(input, chain, pose))));
    match.target[3] = glm::dvec4(world.to_world(target), 1.0);
    // The pole's side, turned by pole_angle, is that of the bend.
    const double back = -settings.pole_angle;
    const glm::dvec3 normal =
        std::cos(back) * chord.normal + std::sin(back) * glm::cross(chord.along, chord.normal);
    const glm::dvec3 side = (settings.bend < 0 ? -1.0 : 1.0) * glm::cross(normal, chord.along);
    match.pole = world.to_world(pose.root() + 0.5 * distance * chord.along + reach * side);
    return match;
}

}  // namespace

void match(const ChainPlan& plan, const ChainInput& input, std::span<glm::dmat4> targets,
           std::span<glm::dvec3> poles) {
    check_rig(plan, input);
    const std::size_t chains = plan.chain_count();
    require(input.settings.size() == chains, "settings: one entry per chain is needed");
    require(targets.size() == chains, "targets: one entry per chain is needed");
    require(poles.size() == chains, "poles: one entry per chain is needed");
    const RigWorld world(input.world);
    Pose pose(plan.longest_chain());
    for (std::size_t index = 0; index < chains; ++index) {
        targets[index] = glm::dmat4(1.0);
        poles[index] = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
        const ChainPlan::Chain chain = plan.chain(index, input.settings[index].left_out);
        if (!world.is_valid || !has_finite_numbers(input.settings[index])) continue;
        if (!pose.read(input, chain)) continue;
        const Match match = match_one(input, chain, pose, world, within_domains(input.settings[index]));
        if (!is_finite(match.target) || !is_finite(match.pole)) continue;
        targets[index] = match.target;
        poles[index] = match.pole;
    }
}

}  // namespace motus::bones::ik
