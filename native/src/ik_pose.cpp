#include "ik_pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "turns.hpp"

namespace motus {
namespace {

glm::dvec3 sign_of(const glm::dvec3& v) {
    return {std::copysign(1.0, v.x), std::copysign(1.0, v.y), std::copysign(1.0, v.z)};
}

bool is_finite(const float* values, std::size_t count) {
    float sum = 0.0f;
    for (std::size_t i = 0; i < count; ++i) sum += 0.0f * values[i];
    return sum == 0.0f;
}

/// Where a bone's head is, seen from its parent in the pose (from the armature without one).
glm::dvec3 head_of(const BoneOffset& offset, const glm::dvec3& location) {
    return offset.head + (offset.local_location ? offset.turn * location : location);
}

bool is_finite(const RigView& rig, std::size_t bone) {
    const int parent = rig.parents[bone];
    return is_finite(&rig.rest[16 * bone], 16) && is_finite(&rig.basis[16 * bone], 16) &&
           (parent < 0 || is_finite(&rig.rest[16 * static_cast<std::size_t>(parent)], 16));
}

}  // namespace

OwnTransform own_transform(const RigView& rig, std::size_t bone) {
    const float* m = &rig.basis[16 * bone];
    glm::dmat3 axes;
    for (int axis = 0; axis < 3; ++axis) {
        axes[axis] = {static_cast<double>(m[0]), static_cast<double>(m[1]), static_cast<double>(m[2])};
        m += 4;
    }
    OwnTransform own;
    own.location = {static_cast<double>(m[0]), static_cast<double>(m[1]), static_cast<double>(m[2])};
    const double sign = glm::determinant(axes) < 0.0 ? -1.0 : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        own.scale[axis] = sign * std::sqrt(glm::dot(axes[axis], axes[axis]));
        axes[axis] *= sign;
    }
    // Of single precision, none of them is so small that its square would vanish.
    own.rotation = own.scale.y != 0.0 && own.scale.z != 0.0
                       ? frame_of(axes, axes[1] / std::abs(own.scale.y), axes[2] / std::abs(own.scale.z))
                       : frame_of(axes);
    return own;
}

glm::dquat rotation_of_space(const glm::dmat3& axes) {
    return frame_of(glm::determinant(axes) < 0.0 ? -axes : axes);
}

glm::dquat frame_in(const LinearSpace& space, const glm::dquat& rotation, const glm::dvec3& scale) {
    return frame_of(scaled(space.axes * glm::mat3_cast(rotation), sign_of(scale)));
}

glm::dquat rotation_in(const LinearSpace& space, const glm::dquat& frame, const glm::dvec3& scale) {
    return frame_of(scaled(inverse_axes(space.axes) * glm::mat3_cast(frame), sign_of(scale)));
}

HangingBone read_hanging(const RigView& rig, std::size_t bone) {
    return {bone_offset(bone_rest(rig, bone)), own_transform(rig, bone)};
}

IkPose::IkPose(std::size_t longest) : bones_(longest), posed_(longest), joints_(longest + 1) {}

bool IkPose::read(const RigView& rig, const IkPlan::Chain& chain) {
    count_ = chain.bones.size();
    const auto first = static_cast<std::size_t>(chain.bones.front());
    const int parent = rig.parents[first];
    parent_axes_ = glm::dmat3(1.0);
    glm::dvec3 parent_head(0.0);
    if (parent >= 0) {
        const auto index = static_cast<std::size_t>(parent);
        if (!is_finite(&rig.poses[16 * index], 16)) return false;
        const glm::dmat4 pose = matrix_at(rig.poses, index);
        parent_axes_ = glm::dmat3(pose);
        parent_head = glm::dvec3(pose[3]);
    }
    for (std::size_t i = 0; i < count_; ++i) {
        const auto index = static_cast<std::size_t>(chain.bones[i]);
        if (!is_finite(rig, index)) return false;
        const auto [offset, own] = read_hanging(rig, index);
        bones_[i].offset = offset;
        bones_[i].rotation = own.rotation;
        bones_[i].scale = own.scale;
        const glm::dvec3 head = head_of(offset, own.location);
        if (i > 0)
            bones_[i - 1].next = head;
        else
            joints_[0] = parent_head + parent_axes_ * head;
    }
    IkBone& last = bones_[count_ - 1];
    if (chain.has_free_effector) {
        if (!is_finite(rig, chain.effector.bone)) return false;
        const auto [offset, own] = read_hanging(rig, chain.effector.bone);
        last.next = head_of(offset, own.location);
    } else {
        const float length = rig.lengths[static_cast<std::size_t>(chain.bones.back())];
        if (!std::isfinite(length)) return false;
        last.next = {0.0, static_cast<double>(length), 0.0};
    }
    for (std::size_t i = 0; i < count_; ++i) put(i, bones_[i].rotation, 1.0);
    return true;
}

void IkPose::enter(std::size_t i) {
    posed_[i].space = linear_space(bones_[i].offset, i > 0 ? posed_[i - 1].axes : parent_axes_);
}

glm::dvec3 IkPose::reach_of(std::size_t i, double stretch) const {
    const IkBone& bone = bones_[i];
    glm::dvec3 reach = bone.scale * posed_[i].space.post_scale * bone.next;
    reach.y *= stretch;
    return reach;
}

void IkPose::place(std::size_t i, const glm::dquat& rotation, double stretch) {
    PosedBone& posed = posed_[i];
    posed.rotation = rotation;
    posed.stretch = stretch;
    glm::dvec3 scale = bones_[i].scale * posed.space.post_scale;
    scale.y *= stretch;
    posed.axes = scaled(posed.space.axes * glm::mat3_cast(rotation), scale);
    joints_[i + 1] = joints_[i] + posed.axes * bones_[i].next;
}

glm::dquat IkPose::frame(std::size_t i) const {
    return frame_in(posed_[i].space, posed_[i].rotation, bones_[i].scale);
}

glm::dquat IkPose::rotation_for(std::size_t i, const glm::dquat& frame) const {
    return rotation_in(posed_[i].space, frame, bones_[i].scale);
}

}  // namespace motus
