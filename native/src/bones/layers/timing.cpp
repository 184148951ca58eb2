#include "motus/bones/layers/timing.hpp"

#include <algorithm>
#include <cmath>

#include "motus/core/numeric.hpp"

namespace motus::bones::layers {
namespace {

/// How far an action of that length is played, 0 to length, after so many of its frames.
double played(double frames, double length, After after) {
    if (after != After::repeat || length <= 0.0) return std::min(frames, length);
    const double rest = frames - length * std::floor(frames / length);
    return std::clamp(rest, 0.0, length);
}

/// A ramp that rises from 0 to 1 over a width; 1 without one.
double ramp(double way, double width) {
    return width > 0.0 ? smooth_step(way / width) : 1.0;
}

}  // namespace

Moment moment_of(const Timing& timing, double frame) {
    const double length = timing.last - timing.first;
    const double elapsed = frame - timing.start;
    const double rate = std::abs(timing.speed);
    const double way = played(std::max(elapsed, 0.0) * rate, length, timing.after);
    Moment result{timing.speed < 0.0 ? timing.last - way : timing.first + way, 0.0};
    if (elapsed < 0.0) return result;
    result.weight = ramp(elapsed, timing.blend_in);
    if (timing.after == After::nothing && rate > 0.0) {
        const double left = length / rate - elapsed;
        result.weight *= left < 0.0 ? 0.0 : ramp(left, timing.blend_out);
    }
    return result;
}

}  // namespace motus::bones::layers
