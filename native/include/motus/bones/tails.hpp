// Bones that turn so that their tails point to given places, as by aim constraints: chains that trail.
//
// Costs: O(bones) to plan and to solve. Planning allocates the plan, solving some memory for its work. A
// plan is immutable: any number of threads may solve by it at once.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "motus/bones/rig.hpp"
#include "motus/config.hpp"
#include "motus/core/leaves_zero.hpp"

namespace motus::bones {

/// Bones of one rig that point their tails to places; the hierarchy is checked once. Each bone turns about
/// its own head, after the bones above have moved that head, and keeps its length. What is moved from has no
/// bones.
class TailPlan {
  public:
    /// parents: index of each bone's parent, -1 for none, in any order. bones: those that turn, in any order.
    /// Throws std::invalid_argument, naming the argument, if an index is none of a bone's, a bone is there
    /// twice, or parents form a circle.
    TailPlan(std::span<const int> parents, std::span<const int> bones);

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::span<const int> parents() const noexcept { return parents_; }

    /// targets: places in world space, one for each of the bones. weights: the share of each turn, 0 to 1.
    /// rotations: of each bone, on top of its own (rotation of PoseBone.matrix_basis * result), w >= 0;
    /// exactly the identity if the tail points there already, the place is the bone's own head, or a number
    /// is not finite. world: the rig's matrix_world. Of rig.poses only those of the topmost bones' parents
    /// are read, rig.lengths is not read. Throws std::invalid_argument if a span has another size, or the
    /// rig's parents are not the plan's.
    void solve(const RigView& rig, const glm::dmat4& world, std::span<const glm::dvec3> targets,
               std::span<const double> weights, std::span<glm::dquat> rotations) const;

  private:
    /// A bone that turns, or that lies between a turning bone and one above it.
    struct Link {
        std::size_t bone = 0;
        std::optional<std::size_t> row;
        std::optional<std::size_t> above;  ///< the link of the parent bone, if there is one
    };

    std::vector<int> parents_;
    std::vector<Link> links_;  ///< parents first
    LeavesZero<std::size_t> size_;
};

}  // namespace motus::bones
