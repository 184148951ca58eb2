// What an audience sees of parallax on a screen: divergence, strain, depth, roundness.
// Lambooij, IJsselsteijn, Fortuin, Heynderickx, "Visual discomfort and visual fatigue of stereoscopic
// displays" (2009), for the limit of one degree of vergence.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include "motus/stereo/eyes.hpp"

namespace motus::stereo {

/// A screen, and a viewer before its middle. Metres, from 1e-30 to 1e30.
struct Screen {
    double width = 12.0;             ///< > 0
    double viewing_distance = 15.0;  ///< > 0
    double eye_separation = 0.065;   ///< > 0
};

/// Throws std::invalid_argument, naming the number, if one is outside its domain. So do all
/// functions in this header, also if a parallax is NaN.
void check(const Screen& screen);

constexpr double one_degree = 0.017453292519943295;

/// Vergence: by how much the eyes turn towards each other for a parallax, rad. 0 for a point at infinity,
/// below 0 if the eyes would have to turn apart.
[[nodiscard]] double vergence(const Screen& screen, double parallax);

/// Perceived distance of a point, m; infinite if the eyes are parallel or turned apart.
[[nodiscard]] double seen_distance(const Screen& screen, double parallax);

/// Parallax above which the eyes would have to turn apart, a fraction of the width.
[[nodiscard]] double divergence_limit(const Screen& screen);

/// The parallax that differs from the screen's vergence by `angle` (rad, > 0), not beyond divergence.
[[nodiscard]] Limits comfortable(const Screen& screen, double angle = one_degree);

/// How strained the viewer's eyes are.
enum class Comfort {
    comfortable,
    strained,   ///< outside comfortable()
    diverging,  ///< beyond divergence_limit()
};
[[nodiscard]] Comfort comfort(const Screen& screen, double parallax, double angle = one_degree);

/// How deep a small ball at `depth` seems, as a part of how wide it seems: 1 is as deep as it is wide.
/// Infinite if the eyes are turned apart. At the middle of the image.
[[nodiscard]] double roundness(const Screen& screen, const Eyes& eyes, double depth);

}  // namespace motus::stereo
