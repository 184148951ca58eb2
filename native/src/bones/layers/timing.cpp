#include "motus/bones/layers/timing.hpp"

#include <algorithm>
#include <cmath>

#include "motus/core/numeric.hpp"

namespace motus::bones::layers {
namespace {

/// How far an action of some length is played, 0 to length, and how often it has begun again.
struct Played {
    double way, laps;
};

/// How far an action is played, and how often it has begun again, after a number of the action's frames.
Played played(double frames, double length, After after) {
    if (after != After::repeat || length <= 0.0 || std::isinf(length)) return {std::min(frames, length), 0.0};
    // Of numbers so large, or a length so small, that the laps cannot be counted, the first frame.
    const double laps = std::floor(frames / length);
    const double rest = frames - length * laps;
    return {std::min(std::max(0.0, rest), length), std::isfinite(laps) ? laps : 0.0};
}

/// A ramp that rises from 0 to 1 over a width; 1 if the width is 0.
double ramp(double way, double width) {
    return width > 0.0 ? smooth_step(way / width) : 1.0;
}

}  // namespace

void check(const LayerTiming& timing) {
    require(std::isfinite(timing.start), "start: must be finite");
    require(std::isfinite(timing.last), "last: must be finite");
    require(std::isfinite(timing.first) && timing.first <= timing.last,
            "first: must be finite, and no later than last");
    require(std::isfinite(timing.speed), "speed: must be finite");
    require(std::isfinite(timing.blend_in) && timing.blend_in >= 0.0,
            "blend_in: must be at least 0 and finite");
    require(std::isfinite(timing.blend_out) && timing.blend_out >= 0.0,
            "blend_out: must be at least 0 and finite");
}

Moment moment_of(const LayerTiming& timing, double frame) {
    check(timing);
    require(std::isfinite(frame), "frame: must be finite");
    const double length = timing.last - timing.first;
    const double elapsed = frame - timing.start;
    const double rate = std::abs(timing.speed);
    const auto [way, laps] = played(std::max(elapsed, 0.0) * rate, length, timing.after);
    Moment result{timing.speed < 0.0 ? timing.last - way : timing.first + way, 0.0, laps};
    // Where the frames' range is no number: the end that is played to.
    if (!std::isfinite(result.frame)) result.frame = timing.speed < 0.0 ? timing.first : timing.last;
    if (elapsed < 0.0) return result;
    result.weight = ramp(elapsed, timing.blend_in);
    if (timing.after == After::nothing && rate > 0.0) {
        const double left = length / rate - elapsed;
        result.weight *= left >= 0.0 ? ramp(left, timing.blend_out) : 0.0;
    }
    return result;
}

}  // namespace motus::bones::layers
