// The point of a curve that is nearest to a given one (closest point, point projection).
//
// Costs: O(n). Allocates some memory for its work. Any number of threads at once.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>

#include "motus/config.hpp"
#include "motus/curve/curve.hpp"

namespace motus::curve {

struct Nearest {
    double t = 0.0;
    glm::dvec3 position{0.0};
    double distance = 0.0;
    std::size_t parts = 0;  ///< pieces of the curve that were examined: the work of the search
};

/// The nearest of all points of the curve, not only a local one: branch and bound over halved segments, then
/// Newton's method on the foot of the perpendicular. The distance is right to 1e-12 of itself (or 1e-14 of
/// the segment's size), apart from the rounding of the coordinates; of several points that are equally near
/// it is one. A part is left out if its chord, or a bound of its squared distance, shows that it is farther
/// away, so that at most some hundred parts a segment are examined, even if the point is the centre of an
/// arc. Throws std::invalid_argument if a coordinate of the point is not finite or passes coordinate_limit.
[[nodiscard]] Nearest nearest(const Curve& curve, const glm::dvec3& point);

}  // namespace motus::curve
