// What eyes do by themselves while they look at something: small jumps, and blinks. Each is a function of a
// time and a seed, so that any moment is known without those before it.
//
// A jump takes as long as those of people do, 21 ms and 2.2 ms a degree: Carpenter, "Movements of the Eyes"
// (1988). Blinks accompany nearly all turns of the gaze by more than 33 degrees, and begin along with them:
// Evinger and others, "Not looking while leaping", Exp Brain Res 100 (1994).
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>

#include "motus/config.hpp"

namespace motus::bones::look_at {

/// Jumps of the eyes about what they look at. The amplitude is clamped to [0, pi], the rate to [0,
/// most_rate].
struct Saccades {
    double amplitude = 0.0;  ///< farthest from the target, rad
    double rate = 2.0;       ///< jumps a second, on average
    std::uint32_t seed = 0;  ///< different seeds jump at different times to different places
};

inline constexpr double most_rate = 100.0;         ///< jumps or blinks a second
inline constexpr double closing_seconds = 0.1;     ///< of a blink, until the eyes are shut
inline constexpr double opening_seconds = 0.2;     ///< of a blink, until they are open again
inline constexpr double shortest_saccade = 21e-3;  ///< s, of a jump by hardly anything
inline constexpr double saccade_slope = 2.2e-3;    ///< s a degree

/// Where the eyes look beside their target at a time, s: rad to the left and up, no farther than the
/// amplitude. Jump n, one in each 1 / rate of the time, goes from one random place to the next; nearer places
/// are likelier. It begins and ends without speed and acceleration. It is shorter than the main sequence says
/// if the next one would begin before it ends. (0, 0) at a rate of 0, if a number is not finite, and
/// more than 2^30 jumps away from time 0.
[[nodiscard]] glm::dvec2 saccade(const Saccades& saccades, double seconds);

/// How far a blink has shut the eyes, 0 to 1, `since` seconds after its beginning; 0 before, after, and if
/// the number is not finite. One continuous derivative.
[[nodiscard]] double blink(double since);

/// How far blinks have shut the eyes at a time, s: one at a random time in each 1 / rate. 0 at a
/// rate of 0, if a number is not finite, and more than 2^30 blinks away from time 0. rate: blinks a second,
/// clamped to [0, most_rate].
[[nodiscard]] double blinks(double rate, std::uint32_t seed, double seconds);

}  // namespace motus::bones::look_at
