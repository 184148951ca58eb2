#include "bones.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motus/bones/turns.hpp"
#include "world.hpp"

namespace motus::bones::ik {
namespace {

bool is_matrix_finite(std::span<const float> matrices, std::size_t bone) {
    return are_finite(matrices.subspan(16 * bone, 16));
}

void read(RestBone& result, const RigView& rig, std::size_t bone) {
    const int parent = rig.parents()[bone];
    result.is_finite = is_matrix_finite(rig.rest(), bone) && std::isfinite(rig.lengths()[bone]) &&
                       (parent < 0 || is_matrix_finite(rig.rest(), static_cast<std::size_t>(parent)));
    if (!result.is_finite) return;
    result.offset = offset_of(rest_of(rig, bone));
    result.length = static_cast<double>(rig.lengths()[bone]);
}

void read(AnimatedBone& result, const RestBone& rest, std::span<const float> basis, std::size_t bone) {
    result.is_finite = rest.is_finite && is_matrix_finite(basis, bone);
    result.offset = &rest.offset;
    if (!result.is_finite) return;
    const OwnTransform own = own_transform(basis, bone);
    result.rotation = own.rotation;
    result.scale = own.scale;
    const Offset& offset = rest.offset;
    result.head = offset.head + (offset.local_location ? offset.turn * own.location : own.location);
}

}  // namespace

OwnTransform own_transform(std::span<const float> basis, std::size_t bone) {
    const float* m = &basis[16 * bone];
    glm::dmat3 axes;
    for (int axis = 0; axis < 3; ++axis) {
        axes[axis] = {static_cast<double>(m[0]), static_cast<double>(m[1]), static_cast<double>(m[2])};
        m += 4;
    }
    OwnTransform own;
    own.location = {static_cast<double>(m[0]), static_cast<double>(m[1]), static_cast<double>(m[2])};
    const double sign = handedness(axes);
    for (int axis = 0; axis < 3; ++axis) {
        own.scale[axis] = sign * std::sqrt(glm::dot(axes[axis], axes[axis]));
        axes[axis] *= sign;
    }
    // Numbers of single precision are not so small that their squares would vanish.
    own.rotation = own.scale.y != 0.0 && own.scale.z != 0.0
                       ? frame_of(axes, axes[1] / std::abs(own.scale.y), axes[2] / std::abs(own.scale.z))
                       : frame_of(axes);
    return own;
}

RestBones::RestBones(const ChainPlan& plan, const RigView& rig) : plan_(plan.identity()) {
    if (!std::ranges::equal(rig.parents(), plan.parents()))
        throw std::invalid_argument("rig: its parents must be the plan's");
    if (rig.lengths().size() != rig.size()) throw std::invalid_argument("rig: must have lengths");
    std::vector<RestBone> rows(plan.rows().size());
    for (std::size_t row = 0; row < rows.size(); ++row)
        read(rows[row], rig, static_cast<std::size_t>(plan.rows()[row]));
    rows_ = std::make_shared<const std::vector<RestBone>>(std::move(rows));
}

std::span<const RestBone> RestBones::rows() const noexcept {
    if (!rows_) return {};
    return *rows_;
}

AnimatedBones::AnimatedBones(const ChainPlan& plan, RestBones rest, std::span<const float> basis)
    : rest_(std::move(rest)) {
    const std::span<const RestBone> at_rest = rest_.rows();
    if (!rest_.is_of(plan)) throw std::invalid_argument("rest: must be of the same plan");
    if (basis.size() != 16 * plan.parents().size())
        throw std::invalid_argument("basis: there must be one for each bone of the plan");
    std::vector<AnimatedBone> rows(at_rest.size());
    for (std::size_t row = 0; row < rows.size(); ++row)
        read(rows[row], at_rest[row], basis, static_cast<std::size_t>(plan.rows()[row]));
    for (std::size_t index = 0; index < plan.chain_count(); ++index) {
        const ChainPlan::Chain chain = plan.chain(index);
        const std::size_t last = chain.first_row + chain.bones.size() - 1;
        for (std::size_t row = chain.first_row; row < last; ++row) rows[row].next = rows[row + 1].head;
        rows[last].next = chain.has_free_effector ? rows[chain.effector.row].head
                                                  : glm::dvec3(0.0, at_rest[last].length, 0.0);
    }
    rows_ = std::make_shared<const std::vector<AnimatedBone>>(std::move(rows));
}

std::span<const AnimatedBone> AnimatedBones::rows() const noexcept {
    if (!rows_) return {};
    return *rows_;
}

}  // namespace motus::bones::ik
