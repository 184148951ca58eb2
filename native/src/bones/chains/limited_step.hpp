// One small step of a chain with limits. Private to the library.
#pragma once
#include <glm/vec3.hpp>

#include "limited_descent.hpp"

namespace motus::bones::chains {

/// Turns the joints by the least turns within their limits that move the tip by `error`, or as far towards it
/// as a step of moderate size goes. The result is continuous in the pose and the error even if joints reach
/// their limits, so that a series of steps is continuous too. False if nothing moves.
bool step_towards(LimitedPose& pose, const LimitedTuning& tuning, const glm::dvec3& error);

/// One small step that changes the tip's distance from the root, by all joints but the root. along: unit,
/// from the root to the tip.
bool step_along(LimitedPose& pose, const LimitedTuning& tuning, const glm::dvec3& along, double error);

}  // namespace motus::bones::chains
