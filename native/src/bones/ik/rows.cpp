// From a chain's solution to its rows: weights, the effector, the guards.
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "motus/bones/turns.hpp"
#include "solution.hpp"

namespace motus::bones::ik {
namespace {

glm::dquat relative(const glm::dquat& from, const glm::dquat& to) {
    const glm::dquat turn = normalized_product(glm::conjugate(from) * to);
    return turn.w < 0.0 ? -turn : turn;
}

/// A bone's pose as rotation and scale. A mirrored one has a negative scale along X; shear is left out.
struct PoseParts {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

PoseParts pose_of(const AnimatedBone& bone, const PosedBone& parent) {
    const LinearSpace space = linear_space(*bone.offset, parent.axes);
    const glm::dmat3 axes = scaled(space.axes * glm::mat3_cast(bone.rotation), bone.scale * space.post_scale);
    PoseParts parts;
    parts.rotation = frame_of(axes);
    const glm::dmat3 unit = glm::mat3_cast(parts.rotation);
    for (int axis = 0; axis < 3; ++axis) parts.scale[axis] = glm::dot(unit[axis], axes[axis]);
    return parts;
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
    return angle_of_turn(glm::conjugate(a) * b);
}

}  // namespace

void Solution::pose_weighted(const Task& task, bool is_stretched) {
    const double weight = task.settings.position_weight;
    const std::vector<glm::dquat>& solved = is_stretched ? rotations_ : plain_;
    for (std::size_t i = 0; i < pose_.size(); ++i) {
        const double stretch = is_stretched ? 1.0 + weight * (stretches_[i] - 1.0) : 1.0;
        const glm::dquat rotation = between(pose_.bone(i).rotation, solved[i], weight);
        pose_.enter(i);
        pose_.place(i, rotation, stretch);
    }
    if (!turns_tail_) return;
    const std::size_t last = pose_.size() - 1;
    const glm::dquat frame = between(pose_.frame(last), task.orientation, task.settings.rotation_weight);
    pose_.place(last, pose_.rotation_for(last, frame), pose_.posed(last).stretch);
}

double Solution::write(std::span<const AnimatedBone> rows, const ChainPlan::Chain& chain, const Task& task,
                       const ChainOutput& output) {
    const double weight = task.settings.position_weight;
    const std::size_t count = pose_.size();
    for (std::size_t row = chain.first_row - chain.left_out; row < chain.first_row; ++row) {
        output.rotations[row] = no_turn;
        output.scales[row] = glm::dvec3(1.0);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t row = chain.first_row + i;
        output.rotations[row] = share_of_turn(relative(pose_.bone(i).rotation, rotations_[i]), weight);
        output.scales[row] = pose_.stretched(1.0 + weight * (stretches_[i] - 1.0));
    }
    if (chain.has_free_effector) {
        output.rotations[chain.effector.row] = no_turn;
        output.scales[chain.effector.row] = glm::dvec3(1.0);
    }
    const bool has_goal = task.settings.rotation_weight > 0.0;
    double angle = 0.0;
    if (!chain.guards.empty() || chain.is_effector_absolute) {
        pose_weighted(task, false);
        write_guards(rows, chain, output);
        if (chain.is_effector_absolute) angle = write_effector(rows, chain, task, output);
    }
    if (!has_goal || chain.is_effector_absolute) return angle;
    pose_weighted(task, is_stretched_);
    if (chain.has_free_effector) return write_effector(rows, chain, task, output);
    const std::size_t last = count - 1;
    if (turns_tail_)
        output.rotations[chain.first_row + last] =
            relative(pose_.bone(last).rotation, pose_.posed(last).rotation);
    return angle_between(pose_.frame(last), task.orientation);
}

void Solution::write_guards(std::span<const AnimatedBone> rows, const ChainPlan::Chain& chain,
                            const ChainOutput& output) const {
    for (const ChainPlan::Hanging& guard : chain.guards) {
        const PoseParts parts = pose_of(rows[guard.row], pose_.posed_of_all(guard.on));
        output.rotations[guard.row] = parts.rotation;
        output.scales[guard.row] = parts.scale;
    }
}

double Solution::write_effector(std::span<const AnimatedBone> rows, const ChainPlan::Chain& chain,
                                const Task& task, const ChainOutput& output) const {
    const ChainPlan::Hanging& effector = chain.effector;
    const AnimatedBone& bone = rows[effector.row];
    const PosedBone& parent = pose_.posed_of_all(effector.on);
    const double weight = task.settings.rotation_weight;
    glm::dquat frame = no_turn;
    if (chain.is_effector_absolute) {
        const PoseParts parts = pose_of(bone, parent);
        frame = between(parts.rotation, task.orientation, weight);
        output.rotations[effector.row] = frame;
        output.scales[effector.row] = parts.scale;
    } else {
        const LinearSpace space = linear_space(*bone.offset, parent.axes);
        frame = between(frame_in(space, bone.rotation, bone.scale), task.orientation, weight);
        output.rotations[effector.row] = relative(bone.rotation, rotation_in(space, frame, bone.scale));
    }
    return weight > 0.0 ? angle_between(frame, task.orientation) : 0.0;
}

}  // namespace motus::bones::ik
