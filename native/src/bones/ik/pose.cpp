#include "pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motus/bones/turns.hpp"
#include "world.hpp"

namespace motus::bones::ik {
namespace {

glm::dvec3 sign_of(const glm::dvec3& v) {
    return {std::copysign(1.0, v.x), std::copysign(1.0, v.y), std::copysign(1.0, v.z)};
}

}  // namespace

glm::dquat rotation_of_space(const glm::dmat3& axes) {
    return frame_of(handedness(axes) * axes);
}

glm::dquat frame_in(const LinearSpace& space, const glm::dquat& rotation, const glm::dvec3& scale) {
    return frame_of(scaled(space.axes * glm::mat3_cast(rotation), sign_of(scale)));
}

glm::dquat rotation_in(const LinearSpace& space, const glm::dquat& frame, const glm::dvec3& scale) {
    return frame_of(scaled(inverse_axes(space.axes) * glm::mat3_cast(frame), sign_of(scale)));
}

Pose::Pose(std::size_t longest) : posed_(longest), joints_(longest + 1) {}

bool Pose::read(const ChainInput& input, const ChainPlan::Chain& chain) {
    const std::span<const AnimatedBone> rows = input.bones.rows();
    first_ = 0;
    bones_ = rows.subspan(chain.first_row - chain.left_out, chain.left_out + chain.bones.size());
    const auto is_finite = [](const AnimatedBone& bone) { return bone.is_finite; };
    if (!std::all_of(bones_.begin(), bones_.end(), is_finite)) return false;
    if (chain.has_free_effector && !rows[chain.effector.row].is_finite) return false;
    parent_axes_ = glm::dmat3(1.0);
    joints_[0] = bones_[0].head;
    if (chain.parent >= 0) {
        const auto parent = static_cast<std::size_t>(chain.parent);
        if (!are_finite(input.poses.subspan(16 * parent, 16))) return false;
        const glm::dmat4 pose = matrix_at(input.poses, parent);
        parent_axes_ = glm::dmat3(pose);
        joints_[0] = glm::dvec3(pose[3]) + parent_axes_ * bones_[0].head;
    }
    for (std::size_t i = 0; i < size(); ++i) put(i, bones_[i].rotation, 1.0);
    first_ = chain.left_out;
    bones_ = bones_.subspan(first_);
    return true;
}

glm::dvec3 Pose::stretched(double stretch) const {
    const double across = stretch == 1.0 || volume_ == 0.0 ? 1.0 : std::pow(stretch, -0.5 * volume_);
    return {across, stretch, across};
}

void Pose::enter(std::size_t i) {
    const std::size_t place = first_ + i;
    posed_[place].space = linear_space(*bones_[i].offset, place > 0 ? posed_[place - 1].axes : parent_axes_);
}

glm::dvec3 Pose::reach_of(std::size_t i, double stretch) const {
    const AnimatedBone& bone = bones_[i];
    return bone.scale * posed(i).space.post_scale * bone.next * stretched(stretch);
}

void Pose::place(std::size_t i, const glm::dquat& rotation, double stretch) {
    PosedBone& posed = posed_[first_ + i];
    posed.rotation = rotation;
    posed.stretch = stretch;
    const glm::dvec3 scale = bones_[i].scale * posed.space.post_scale * stretched(stretch);
    posed.axes = scaled(posed.space.axes * glm::mat3_cast(rotation), scale);
    joints_[first_ + i + 1] = joints_[first_ + i] + posed.axes * bones_[i].next;
}

glm::dquat Pose::frame(std::size_t i) const {
    return frame_in(posed(i).space, posed(i).rotation, bones_[i].scale);
}

glm::dquat Pose::rotation_for(std::size_t i, const glm::dquat& frame) const {
    return rotation_in(posed(i).space, frame, bones_[i].scale);
}

}  // namespace motus::bones::ik
