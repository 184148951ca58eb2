// Two eyes of a camera that sees all around: each column of the picture is seen from another place on a
// circle. Peleg, Ben-Ezra, Pritch, "Omnistereo: Panoramic Stereo Imaging" (2001). The rays are the ones of
// Cycles' spherical stereo.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <numbers>

#include "motus/config.hpp"

namespace motus::stereo {

/// Both eyes, each half the interaxial distance beside the centre, at right angles to the direction in which
/// they look. Distances in one unit; what is > 0 is at least 1e-30, and what is finite at most 1e30 in size.
struct EyesAround {
    double interaxial = 0.065;  ///< between the eyes at the horizon, >= 0
    double convergence = 1.95;  ///< radius of the sphere of zero parallax, > 0, may be infinite
    double merge_from =
        0.5 * std::numbers::pi;  ///< rad above or below the horizon where the eyes begin to approach
    double merge_to =
        0.5 * std::numbers::pi;  ///< and where they have met; 0 <= merge_from <= merge_to <= pi / 2
};

/// Throws std::invalid_argument, naming the number, if one is outside its domain.
void check(const EyesAround& eyes);

/// Distance between the eyes in a row of the picture at an elevation, rad, from -pi / 2 to pi / 2: falls as a
/// quarter of a cosine between merge_from and merge_to.
[[nodiscard]] double interaxial_at(const EyesAround& eyes, double elevation);

/// By how much further right the right eye sees a point than the left one, rad of azimuth: positive behind
/// the sphere of zero parallax. distance: of the point from the centre, at least half the interaxial, may be
/// infinite. elevation: of the row of the picture, rad, from -pi / 2 to pi / 2. At the horizon 2 asin(h /
/// convergence) - 2 asin(h / distance), where h is the distance of the rays from the centre: half the
/// interaxial by the cosine of the angle at which the eyes converge.
[[nodiscard]] double parallax(const EyesAround& eyes, double distance, double elevation = 0.0);

}  // namespace motus::stereo
