// A chain with limits led to its target by steps too small to change sides. Private to the library.
#pragma once
#include <glm/vec3.hpp>
#include <optional>

#include "limited_descent.hpp"

namespace motus::bones::chains {

/// Where to lead a chain, in the pose's unit of length, seen from its root.
struct LeadGoal {
    glm::dvec3 target{0.0};
    glm::dvec3 normal{0.0};          ///< to bend in if the pose at the start is straight
    std::optional<glm::dvec3> side;  ///< direction to bend towards, across the line from root to target, unit
    double certainty = 1.0;          ///< of the side, 0 to 1: how far the bend turns there
    double tolerance = 0.0;          ///< length
};

/// Leads the pose to the target. First the pose is bent along its own line from root to tip, until that line
/// is as long as the target is far; then it is turned as a whole about the root, which keeps the bend if the
/// root's limits allow the turn. If they do not, the other joints follow. The result is continuous in the
/// target and the side wherever the target is reached, except for a target on the root or straight behind it.
/// Returns the number of steps, about max_steps at most.
int lead(LimitedPose& pose, const LeadGoal& goal, const LimitedTuning& tuning, int max_steps);

}  // namespace motus::bones::chains
