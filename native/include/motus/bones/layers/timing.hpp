// When a layer plays what of its action, and how much of it shows: play rate, loops, blend weight.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once

namespace motus::bones::layers {

/// What follows the last frame of the action.
enum class After : int {
    nothing = 0,  ///< the layer ends
    hold = 1,     ///< the last pose stays
    repeat = 2    ///< the action begins again
};

/// Frames of the scene and of the action. Before its start a layer is not there.
struct LayerTiming {
    double start = 1.0;  ///< frame of the scene
    double first = 1.0;  ///< frame of the action that plays there; first <= last
    double last = 1.0;
    double speed =
        1.0;  ///< frames of the action in one of the scene; below 0 it is played from its last frame back
    After after = After::nothing;
    double blend_in = 0.0;   ///< frames of the scene from the start on; >= 0
    double blend_out = 0.0;  ///< frames of the scene before its end, where it has one; >= 0
};

/// frame: of the action. weight: 0 to 1. laps: how often it has begun again.
struct Moment {
    double frame = 0.0, weight = 0.0, laps = 0.0;
};

/// Throws std::invalid_argument, naming the number, where one is not finite or outside its domain.
void check(const LayerTiming& timing);

/// Throws as check() does, and where the frame is not finite.
[[nodiscard]] Moment moment_of(const LayerTiming& timing, double frame);

}  // namespace motus::bones::layers
