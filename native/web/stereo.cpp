// The budget of depth of a stereo camera, and what an audience sees of it.
#include "motus/stereo/eyes.hpp"
#include "motus/stereo/screen.hpp"
#include "web.hpp"

namespace motus::web {

/// Parallax that is comfortable on a screen. out: in front of it, behind it, and the largest for which eyes
/// need not turn apart; fractions of its width.
MOTUS_WEB(comfortable_parallax)(double width, double viewing_distance, double* out) {
    const stereo::Screen screen{.width = width, .viewing_distance = viewing_distance};
    const stereo::Limits limits = stereo::comfortable(screen);
    out[0] = limits.near;
    out[1] = limits.far;
    out[2] = stereo::divergence_limit(screen);
}

/// Eyes by which the depths from `near` to `far` take exactly a parallax in front of the screen and one
/// behind it. out: interaxial, convergence.
MOTUS_WEB(fit_budget)
(double near, double far, double near_parallax, double far_parallax, double focal_length, double* out) {
    const stereo::Eyes eyes = stereo::fit_budget({.focal_length = focal_length}, {near, far},
                                                 {.near = near_parallax, .far = far_parallax});
    out[0] = eyes.interaxial;
    out[1] = eyes.convergence;
}

/// For each depth the parallax, a fraction of the width, where the audience sees it, m from the screen's
/// viewer, how round it looks, and the number of the Comfort. out: four numbers a depth.
MOTUS_WEB(seen_depths)
(const double* depths, std::size_t count, double interaxial, double convergence, double focal_length,
 double width, double viewing_distance, double* out) {
    const stereo::Eyes eyes{
        .interaxial = interaxial, .focal_length = focal_length, .convergence = convergence};
    const stereo::Screen screen{.width = width, .viewing_distance = viewing_distance};
    for (std::size_t i = 0; i < count; ++i) {
        const double parallax = stereo::parallax(eyes, depths[i]);
        *out++ = parallax;
        *out++ = stereo::seen_distance(screen, parallax);
        *out++ = stereo::roundness(screen, eyes, depths[i]);
        *out++ = static_cast<double>(stereo::comfort(screen, parallax));
    }
}

}  // namespace motus::web
