#include "motus/bones/tails.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "motus/bones/space.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones {
namespace {

constexpr glm::dvec3 along{0.0, 1.0, 0.0};
constexpr glm::dvec3 across{1.0, 0.0, 0.0};

/// Signed scale and rotation of a bone's own transform, as Blender takes matrix_basis apart: a mirrored one
/// has three negative scales.
struct OwnTurn {
    glm::dmat3 rotation;
    glm::dvec3 scale;
};

[[nodiscard]] OwnTurn own_turn(const glm::dmat4& basis) {
    const glm::dmat3 axes(basis);
    const double sign = handedness(axes);
    const glm::dvec3 scale =
        sign * glm::dvec3(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
    return {scaled(axes, 1.0 / scale), scale};
}

/// The turn, on top of the bone's own rotation, that points the bone's tail along `way`; none if the
/// direction is undefined.
[[nodiscard]] std::optional<glm::dquat> turn_along(const ParentSpace& space, const OwnTurn& own,
                                                   const glm::dvec3& way, double weight) {
    const glm::dmat3 axes = glm::dmat3(space.rotation_scale) * own.rotation;
    const glm::dvec3 wanted = glm::inverse(axes) * way * (own.scale.y < 0.0 ? -1.0 : 1.0);
    if (!is_finite(wanted)) return std::nullopt;
    const std::optional<glm::dvec3> direction = direction_of(wanted);
    if (!direction) return std::nullopt;
    const glm::dquat turn = share_of_turn(smallest_turn(along, *direction, across), weight);
    return turn.w < 0.0 ? -turn : turn;
}

}  // namespace

TailPlan::TailPlan(std::span<const int> parents, std::span<const int> bones)
    : parents_(parents.begin(), parents.end()), size_(bones.size()) {
    const auto count = static_cast<int>(parents_.size());
    for (const int parent : parents_) {
        if (parent < -1 || parent >= count)
            throw std::invalid_argument("parents: there is no bone " + std::to_string(parent));
    }
    std::vector<std::optional<std::size_t>> row(parents_.size()), link(parents_.size());
    for (std::size_t i = 0; i < bones.size(); ++i) {
        if (bones[i] < 0 || bones[i] >= count)
            throw std::invalid_argument("bones: there is no bone " + std::to_string(bones[i]));
        std::optional<std::size_t>& place = row[static_cast<std::size_t>(bones[i])];
        if (place) throw std::invalid_argument("bones: a bone is there twice");
        place = i;
    }
    for (const int bone : bones) {
        // From the bone upwards to the topmost bone that turns, or to a bone that is a link already.
        std::vector<std::size_t> way;
        std::size_t needed = 0;
        for (int at = bone; at >= 0; at = parents_[static_cast<std::size_t>(at)]) {
            const auto one = static_cast<std::size_t>(at);
            if (way.size() == parents_.size())
                throw std::invalid_argument("parents: bones hang on each other");
            if (link[one]) {
                needed = way.size();
                break;
            }
            way.push_back(one);
            if (row[one]) needed = way.size();
        }
        way.resize(needed);
        for (const std::size_t one : std::vector<std::size_t>(way.rbegin(), way.rend())) {
            const int parent = parents_[one];
            const auto above = parent < 0 ? std::nullopt : link[static_cast<std::size_t>(parent)];
            link[one] = links_.size();
            links_.push_back({one, row[one], above});
        }
    }
}

void TailPlan::solve(const RigView& rig, const glm::dmat4& world, std::span<const glm::dvec3> targets,
                     std::span<const double> weights, std::span<glm::dquat> rotations) const {
    const std::size_t bones = parents_.size();
    if (targets.size() != size_) throw std::invalid_argument("targets: one per bone is needed");
    if (weights.size() != size_) throw std::invalid_argument("weights: one per bone is needed");
    if (rotations.size() != size_) throw std::invalid_argument("rotations: one per bone is needed");
    if (!std::ranges::equal(rig.parents(), parents_))
        throw std::invalid_argument("rig: its parents must be the plan's");
    if (rig.poses().size() != 16 * bones || rig.basis().size() != 16 * bones)
        throw std::invalid_argument("rig: must have poses and basis");

    const glm::dmat4 to_rig = glm::inverse(world);
    std::vector<glm::dmat4> poses;
    poses.reserve(links_.size());
    for (const Link& link : links_) {
        const int parent = parents_[link.bone];
        glm::dmat4 parent_pose(1.0);
        if (link.above)
            parent_pose = poses[*link.above];
        else if (parent >= 0)
            parent_pose = matrix_at(rig.poses(), static_cast<std::size_t>(parent));
        const ParentSpace space = parent_space(rest_of(rig, link.bone), parent_pose);
        glm::dmat4 basis = matrix_at(rig.basis(), link.bone);
        if (link.row) {
            const glm::dvec3 head(to_pose(space, basis)[3]);
            const glm::dvec3 tail(to_rig * glm::dvec4(targets[*link.row], 1.0));
            const OwnTurn own = own_turn(basis);
            const double weight = weights[*link.row];
            const std::optional<glm::dquat> turn =
                std::isfinite(weight) ? turn_along(space, own, tail - head, weight) : std::nullopt;
            rotations[*link.row] = turn.value_or(no_turn);
            if (turn) {
                const glm::dmat3 turned = scaled(own.rotation * glm::mat3_cast(*turn), own.scale);
                for (int column = 0; column < 3; ++column) basis[column] = glm::dvec4(turned[column], 0.0);
            }
        }
        poses.push_back(to_pose(space, basis));
    }
}

}  // namespace motus::bones
