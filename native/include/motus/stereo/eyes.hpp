// Two eyes of a camera, and where they see a point: parallax, and the depth budget both ways.
// Lipton, "Foundations of the Stereoscopic Cinema" (1982), ch. 3; Woods, Docherty, Koch, "Image distortions
// in stereoscopic video systems" (1993), for eyes that are turned towards each other.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/config.hpp"

namespace motus::stereo {

/// How the two images are made to meet on the screen.
enum class ConvergenceMode {
    off_axis,  ///< the eyes look the same way, their images are shifted
    parallel,  ///< the eyes look the same way; only what is infinitely far lies on the screen
    toe_in,    ///< the eyes are turned towards each other, which moves corners up and down
};

/// Both eyes, each half the interaxial distance beside the centre. Distances in one unit, the lens in
/// another. What is > 0 here and in the functions below is at least 1e-30, and what is finite at most 1e30 in
/// size, so that no result overflows.
struct Eyes {
    double interaxial = 0.065;   ///< between the eyes, >= 0
    double focal_length = 50.0;  ///< > 0
    double sensor_width = 36.0;  ///< that the image's width is seen through, > 0, unit of focal_length
    double convergence = 1.95;   ///< distance of what lies on the screen, > 0, may be infinite
    ConvergenceMode mode = ConvergenceMode::off_axis;
};

/// Throws std::invalid_argument, naming the number, if one is outside its domain.
void check(const Eyes& eyes);

/// By how much the right eye sees a point at `depth` (> 0, may be infinite) further right than the left one:
/// a fraction of the image's width, positive behind the screen. At the middle of the image for eyes that toe
/// in.
[[nodiscard]] double parallax(const Eyes& eyes, double depth);

/// A point in both images, fractions of the image's width from its middle, right and up.
struct Pair {
    glm::dvec2 left{0.0, 0.0};
    glm::dvec2 right{0.0, 0.0};
};
/// point: right, up and forward of the centre of the eyes, in front of both.
[[nodiscard]] Pair project(const Eyes& eyes, const glm::dvec3& point);

/// Largest vertical parallax in the image, a fraction of its width: 0 but for eyes that toe in. depth: > 0.
/// aspect: the image's width / its height, > 0.
[[nodiscard]] double vertical_parallax(const Eyes& eyes, double depth, double aspect);

/// Depths, > 0; the far one may be infinite.
struct Range {
    double near = 0.0;
    double far = 0.0;
};

/// How much parallax there may be, fractions of the image's width, >= 0.
struct Limits {
    double near = 0.01;  ///< in front of the screen
    double far = 0.02;   ///< behind it
};

/// The depths between which parallax stays within the limits; the far one is infinite if nothing is too far.
/// Of eyes that toe in those at the middle of the image.
[[nodiscard]] Range depths_within(const Eyes& eyes, const Limits& limits);

/// Interaxial distance and convergence of off-axis eyes by which `range` takes exactly the limits; lens: its
/// focal length and sensor width count. Throws if not 0 < near < far, or both limits are 0.
[[nodiscard]] Eyes fit_budget(const Eyes& lens, const Range& range, const Limits& limits);

}  // namespace motus::stereo
