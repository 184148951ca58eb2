// Blender's NURBS and poly splines as piecewise Bézier curves, exactly.
// Piegl and Tiller, "The NURBS Book" (2nd ed., 1997), ch. 2 and 5.3; Ramshaw, "Blossoming" (1987).
//
// Costs: O(n order^2). Allocates what is returned, and some memory for its work. Any number of threads at
// once.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/curve/curve.hpp"

namespace motus::curve {

/// The options of a Blender NURBS spline that its knot vector depends on.
struct BSplineSettings {
    int order = 4;              ///< 2 to 6; the degree is order - 1
    bool cyclic = false;        ///< the points go round
    bool use_endpoint = false;  ///< the curve begins and ends on the first and the last point
    bool use_bezier = false;    ///< inner knots are repeated: `order` points at a time form a Bézier segment
};

/// Knots as Blender sets them: point_count + order of them, on a cyclic spline order - 1 more (its first
/// order - 1 points are then used again at the end).
[[nodiscard]] std::vector<double> bspline_knots(std::size_t point_count, const BSplineSettings& settings);

/// A non-rational B-spline (all weights 1) of degree order - 1; one segment for every knot span of the curve
/// that is not empty. Point and flag combinations that Blender shows as the bare control polygon (fewer
/// points than the order, or use_bezier with a count that does not fill the last segment) give that polygon,
/// written with the same degree. Throws std::invalid_argument if the order is outside 2 to 6, there are
/// fewer than 2 points, or one is not finite.
[[nodiscard]] Curve bspline(std::span<const glm::dvec3> points, const BSplineSettings& settings);

/// Straight segments from point to point, of degree 1. Throws as bspline() does.
[[nodiscard]] Curve poly_line(std::span<const glm::dvec3> points, bool cyclic);

}  // namespace motus::curve
