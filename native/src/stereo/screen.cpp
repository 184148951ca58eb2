#include "motus/stereo/screen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motus/core/numeric.hpp"

namespace motus::stereo {
namespace {

[[nodiscard]] bool is_length(double value) {
    return value >= 1e-30 && value <= 1e30;  // products and quotients of these do not overflow
}

/// Parallax for which the eyes turn towards each other by `angle`, rad.
[[nodiscard]] double parallax_at(const Screen& screen, double angle) {
    const double apart = screen.eye_separation - 2.0 * screen.viewing_distance * std::tan(0.5 * angle);
    return apart / screen.width;
}

void check_parallax(double parallax) {
    require(!std::isnan(parallax), "parallax: must be a number");
}

}  // namespace

void check(const Screen& screen) {
    require(is_length(screen.width), "width: must be from 1e-30 to 1e30");
    require(is_length(screen.viewing_distance), "viewing_distance: must be from 1e-30 to 1e30");
    require(is_length(screen.eye_separation), "eye_separation: must be from 1e-30 to 1e30");
}

double vergence(const Screen& screen, double parallax) {
    check(screen);
    check_parallax(parallax);
    return 2.0 * std::atan2(screen.eye_separation - parallax * screen.width, 2.0 * screen.viewing_distance);
}

double seen_distance(const Screen& screen, double parallax) {
    check(screen);
    check_parallax(parallax);
    const double left = screen.eye_separation - parallax * screen.width;
    return left > 0.0 ? screen.viewing_distance * screen.eye_separation / left
                      : std::numeric_limits<double>::infinity();
}

double divergence_limit(const Screen& screen) {
    check(screen);
    return screen.eye_separation / screen.width;
}

Limits comfortable(const Screen& screen, double angle) {
    check(screen);
    constexpr double most = 1.5;  // rad; beyond a quarter turn nothing is seen
    require(angle > 0.0 && angle < most, "angle: must lie between 0 and 1.5 rad");
    const double on_screen = vergence(screen, 0.0);
    return {-parallax_at(screen, std::min(on_screen + angle, 2.0 * most)),
            parallax_at(screen, std::max(on_screen - angle, 0.0))};
}

Comfort comfort(const Screen& screen, double parallax, double angle) {
    check_parallax(parallax);
    const Limits limits = comfortable(screen, angle);
    if (parallax > divergence_limit(screen)) return Comfort::diverging;
    return parallax < -limits.near || parallax > limits.far ? Comfort::strained : Comfort::comfortable;
}

double roundness(const Screen& screen, const Eyes& eyes, double depth) {
    check(screen);
    // Depth: V e W P' / (e - P W)^2 with P' = t f / (s d^2). Width: W f / (s d) e / (e - P W). Of eyes that
    // toe in, P' and the width are both larger by the same factor: their images stretch what is near the
    // middle.
    const double left = screen.eye_separation - parallax(eyes, depth) * screen.width;
    if (left <= 0.0) return std::numeric_limits<double>::infinity();
    return screen.viewing_distance * eyes.interaxial / (depth * left);
}

}  // namespace motus::stereo
