// What an audience sees of parallax on a screen: divergence, strain, depth, roundness.
// Lambooij, IJsselsteijn, Fortuin, Heynderickx, "Visual discomfort and visual fatigue of stereoscopic
// displays" (2009), for the limit of one degree of vergence.
#pragma once
#include "motus/stereo/eyes.hpp"

namespace motus::stereo {

/// A screen and who looks at it, from its middle. Metres.
struct Screen {
    double width = 12.0;             ///< > 0
    double viewing_distance = 15.0;  ///< > 0
    double eye_separation = 0.065;   ///< > 0
};

/// Throws std::invalid_argument, naming the number, where one is outside its domain. So does everything here,
/// also where a parallax is NaN.
void check(const Screen& screen);

constexpr double one_degree = 0.017453292519943295;

/// By how much the eyes turn towards each other for a parallax, rad: 0 for what seems infinitely far, below 0
/// where they would have to turn apart.
[[nodiscard]] double vergence(const Screen& screen, double parallax);

/// How far a point seems to be, m; infinite where the eyes are parallel or turned apart.
[[nodiscard]] double seen_distance(const Screen& screen, double parallax);

/// Parallax above which the eyes would have to turn apart, a fraction of the width.
[[nodiscard]] double divergence_limit(const Screen& screen);

/// The parallax that differs from the screen's vergence by `angle` (rad, > 0), not beyond divergence.
[[nodiscard]] Limits comfortable(const Screen& screen, double angle = one_degree);

/// How strained the eyes are.
enum class Comfort {
    comfortable,
    strained,   ///< outside comfortable()
    diverging,  ///< beyond divergence_limit()
};
[[nodiscard]] Comfort comfort(const Screen& screen, double parallax, double angle = one_degree);

/// How deep a small ball at `depth` seems, as a part of how wide it seems: 1 is as deep as it is wide.
/// Infinite where the eyes are turned apart. At the middle of the image.
[[nodiscard]] double roundness(const Screen& screen, const Eyes& eyes, double depth);

}  // namespace motus::stereo
