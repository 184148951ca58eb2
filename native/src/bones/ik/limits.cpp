// Chains whose bones have limits, as solve_limited() sees them.
#include <glm/geometric.hpp>

#include "aim.hpp"
#include "motus/bones/turns.hpp"

namespace motus::bones::ik {

// A bone's frame there is its space's rotation times its own. What lies between a bone and the next, and the
// next joint's place, are taken from the pose: constant if spaces are not sheared.
void Aim::find_rotations(const Pose& pose, const AimGoal& goal, const Line& line, AimReport& report) {
    const std::size_t count = goal.count;
    const std::span<const glm::dvec3> joints = pose.joints();
    chains::Limited chain;
    chain.root = pose.root();
    glm::dquat frame = no_turn;
    for (std::size_t i = 0; i < count; ++i) {
        const PosedBone& bone = pose.posed(i);
        const glm::dquat space = rotation_of_space(bone.space.axes);
        rest_[i] = glm::normalize(glm::conjugate(frame) * space);
        rotations_[i] = bone.rotation;
        frame = space * bone.rotation;
        offsets_[i] = glm::conjugate(frame) * (joints[i + 1] - joints[i]);
    }
    chain.rest = {rest_.data(), count};
    chain.offsets = {offsets_.data(), count};
    chain.limits = goal.limits.subspan(0, count);

    chains::SolverSettings settings;
    settings.tolerance = goal.tolerance;
    settings.max_iterations = goal.max_iterations;
    settings.plane = line.carried;
    if (count > 1 && (goal.pole || goal.pole_angle != 0.0)) {  // one bone has no bend to turn
        const glm::dvec3 side = glm::cross(line.chord.normal, line.chord.along);
        settings.pole = pose.root() + report.reach * (0.5 * line.chord.along + side);
    }
    std::optional<glm::dquat> orientation;
    if (goal.orientation)
        orientation = glm::normalize(*goal.orientation * glm::conjugate(pose.frame(count - 1)) * frame);
    const bool is_whole = report.end == report.distance;
    const glm::dvec3 end = is_whole ? goal.target : pose.root() + report.end * line.chord.along;
    const chains::Convergence found =
        chains::solve_limited(chain, end, settings, {rotations_.data(), count}, orientation);
    report.reason = found.reason;
    report.iterations += found.iterations;
    chains::joints_of(chain, {rotations_.data(), count}, {joints_.data(), count + 1});
}

}  // namespace motus::bones::ik
