// What a distance or a parameter outside a curve's interval means.
#pragma once
#include <cmath>

namespace motus {

/// clamp: the nearest end. extrapolate: on along the tangent of that end. loop: modulo the interval.
/// ping_pong: forth and back.
enum class Extend { clamp, extrapolate, loop, ping_pong };

/// A value brought into [0, limit], and what is left of it beyond that end (extrapolate only; < 0 before 0).
struct Extended {
    double value = 0.0;
    double beyond = 0.0;
};

/// Brings `value` into [0, limit], limit >= 0. Values inside, both ends included, are never changed.
[[nodiscard]] inline Extended extended(double value, double limit, Extend extend) {
    if (value >= 0.0 && value <= limit) return {value, 0.0};
    const double end = value < 0.0 ? 0.0 : limit;
    if (extend == Extend::extrapolate) return {end, value - end};
    if (extend == Extend::clamp || limit <= 0.0) return {end, 0.0};
    const double period = extend == Extend::loop ? limit : 2.0 * limit;
    double wrapped = std::fmod(value, period);
    if (wrapped < 0.0) wrapped += period;
    return {wrapped <= limit ? wrapped : period - wrapped, 0.0};
}

}  // namespace motus
