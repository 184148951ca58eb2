// One small step of a chain with limits. Private to the library.
#pragma once
#include <glm/vec3.hpp>

#include "limited_descent.hpp"

namespace motus::bones::chains {

/// Turns the joints, least in all and all within their limits, so that the tip moves by `error` as far as a
/// step of moderate size goes. A continuous function of the pose and the error, whichever joints stand on
/// their limits: what lets a row of steps be continuous. False if nothing moves.
bool step_towards(LimitedPose& pose, const glm::dvec3& error);

/// One small step that changes the tip's distance from the root, by all joints but the root. along: unit,
/// from the root to the tip.
bool step_along(LimitedPose& pose, const glm::dvec3& along, double error);

}  // namespace motus::bones::chains
