#include "motus/stereo/around.hpp"

#include <cmath>

#include "motus/core/numeric.hpp"

namespace motus::stereo {
namespace {

constexpr double least = 1e-30, most = 1e30, quarter = 0.5 * std::numbers::pi;

void check_elevation(double elevation) {
    require(std::abs(elevation) <= quarter, "elevation: must be from -pi / 2 to pi / 2");
}

}  // namespace

void check(const EyesAround& eyes) {
    require(eyes.interaxial >= 0.0 && eyes.interaxial <= most, "interaxial: must be from 0 to 1e30");
    require(eyes.convergence >= least, "convergence: must be at least 1e-30");
    require(eyes.merge_from >= 0.0 && eyes.merge_from <= quarter, "merge_from: must be from 0 to pi / 2");
    require(eyes.merge_to >= eyes.merge_from && eyes.merge_to <= quarter,
            "merge_to: must be from merge_from to pi / 2");
}

double interaxial_at(const EyesAround& eyes, double elevation) {
    check(eyes);
    check_elevation(elevation);
    const double height = std::abs(elevation);
    if (height > eyes.merge_to) return 0.0;
    if (height <= eyes.merge_from) return eyes.interaxial;
    const double share = (height - eyes.merge_from) / (eyes.merge_to - eyes.merge_from);
    return eyes.interaxial * std::cos(quarter * share);
}

double parallax(const EyesAround& eyes, double distance, double elevation) {
    const double aside = 0.5 * interaxial_at(eyes, elevation);
    require(distance >= least && distance >= aside, "distance: must be at least half the interaxial");
    const double nearness = 1.0 / eyes.convergence, flatness = std::cos(elevation), turn = aside * nearness;
    if (!std::isfinite(distance)) return 2.0 * std::atan2(turn, flatness);
    require(distance <= most, "distance: must be 1e30 at most, or infinite");
    // The ray goes from `aside` to what lies straight ahead on the sphere. At the point it has gone `ahead`,
    // and is left with aside (1 - ahead nearness): the root of ahead^2 + aside^2 (1 - ahead nearness)^2 =
    // distance^2.
    const double scale = 1.0 + turn * turn;
    const double middle = aside * turn;
    const double ahead =
        (middle + std::sqrt(middle * middle + scale * (distance - aside) * (distance + aside))) / scale;
    return -2.0 * std::atan2(aside - ahead * turn, ahead * flatness);
}

}  // namespace motus::stereo
