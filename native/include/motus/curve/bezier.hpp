// Operations on piecewise Bézier curves that give curves or boxes.
// Farin, "Curves and Surfaces for CAGD" (5th ed., 2002), ch. 5.4 (subdivision) and 6.1 (degree elevation).
//
// Costs: O(n). What returns a curve allocates it; bounds() allocates some memory for its work. Any number
// of threads at once.
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "motus/config.hpp"
#include "motus/curve/curve.hpp"

namespace motus::curve {

/// The parts before and after t (clamped), both open and of the same degree. The segment i that t lies
/// in is cut into parts that take t - i and i + 1 - t of its parameter; a cut at a joint cuts no segment; one
/// at an end of the curve gives that point as a part of zero length. Throws std::invalid_argument if t is
/// NaN.
[[nodiscard]] std::pair<Curve, Curve> split(const Curve& curve, double t);

/// The same curve written with a degree higher by `times` >= 0.
/// Throws std::invalid_argument if `times` is negative or the degree would pass max_degree.
[[nodiscard]] Curve elevated(const Curve& curve, int times = 1);

/// The same points run through from the end to the start: t becomes segment_count() - t.
[[nodiscard]] Curve reversed(const Curve& curve);

/// Every point p moved to the affine matrix's M (p, 1).
/// Throws std::invalid_argument if the result is not finite or passes coordinate_limit.
[[nodiscard]] Curve transformed(const Curve& curve, const glm::dmat4& matrix);

/// Axis-aligned box.
struct Box {
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};
};

/// The smallest box that holds the curve (not its control points), to 1e-14 of its size.
[[nodiscard]] Box bounds(const Curve& curve);

}  // namespace motus::curve
