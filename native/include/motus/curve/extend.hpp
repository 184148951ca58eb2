// What a distance or a parameter outside a curve's interval means: its extrapolation, or wrap mode.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <cmath>

namespace motus::curve {

/// clamp: the nearest end. extrapolate: on along the tangent of that end. loop: modulo the interval.
/// ping_pong: forth and back.
enum class Extend { clamp, extrapolate, loop, ping_pong };

/// A value brought into [0, limit], and how it differs from the original.
struct Extended {
    double value = 0.0;
    double beyond = 0.0;     ///< how far the original lies beyond an end (extrapolate only; < 0 before 0)
    double laps = 0.0;       ///< whole intervals (loop, ping_pong): the original is laps * limit +- value
    bool returning = false;  ///< the sign above is minus: on the way back (ping_pong only)
};

/// Brings `value` into [0, limit], limit >= 0. Values inside, both ends included, are never changed; NaN
/// stays NaN.
[[nodiscard]] inline Extended extended(double value, double limit, Extend extend) {
    if (value >= 0.0 && value <= limit) return {value, 0.0};
    if (std::isnan(value)) return {value};
    const double end = value < 0.0 ? 0.0 : limit;
    if (extend == Extend::extrapolate) return {end, value - end};
    if (extend == Extend::clamp || limit <= 0.0) return {end};
    const double intervals = extend == Extend::loop ? 1.0 : 2.0;
    const double period = intervals * limit;
    double wrapped = std::fmod(value, period);
    if (wrapped < 0.0) wrapped += period;
    const double laps = intervals * std::round((value - wrapped) / period);
    if (wrapped <= limit) return {wrapped, 0.0, laps};
    return {period - wrapped, 0.0, laps + intervals, true};
}

}  // namespace motus::curve
