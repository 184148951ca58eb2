// A floor that targets of chains do not go below.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <glm/vec3.hpp>

#include "motus/config.hpp"

namespace motus::bones::ik {

/// A plane, and a margin above it within which targets are held back softly.
struct Floor {
    glm::dvec3 place{0.0};         ///< a point of the plane
    glm::dvec3 up{0.0, 0.0, 1.0};  ///< of any length but 0
    double height = 0.0;           ///< of the lowest target above the plane, in its unit
    double margin = 0.0;           ///< in the same unit, >= 0; less counts as 0
};

/// A target, or the place above the floor that takes its stead. With h for its height above the lowest one
/// and b for the margin, the height becomes h from b on, 0 up to -b, and (h + b)^2 / (4 b) between: one
/// continuous derivative, nowhere below 0 and nowhere more than b / 4 above h. The target itself if a number
/// is not finite, or the floor has no direction.
[[nodiscard]] glm::dvec3 above_floor(const glm::dvec3& target, const Floor& floor);

}  // namespace motus::bones::ik
