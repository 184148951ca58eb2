// What samples of a scene's depth tell: near and far, violated edges of the window, and smooth curves over
// time.
//
// Costs: O(n); smooth() O(n ahead). depth_range() and smooth() allocate some memory for their work. Any
// number of threads at once.
#pragma once
#include <cstddef>
#include <optional>
#include <span>

#include "motus/stereo/eyes.hpp"

namespace motus::stereo {

/// Depths of which shares `low` and `high` (0 <= low < high <= 1) of the samples are nearer, interpolated.
/// None if no sample is above 0 and finite; others do not count.
[[nodiscard]] std::optional<Range> depth_range(std::span<const double> depths, double low = 0.01,
                                               double high = 0.99);

/// Largest parallax, >= 0, by which something in front of the screen is cut off at an edge of one eye's image
/// and not of the other's; 0 if nothing is.
struct Window {
    double left = 0.0;
    double right = 0.0;
};

/// A sample: where the centre of the eyes sees it, a fraction of the width from the middle, and its depth (>
/// 0).
struct Sample {
    double x = 0.0;
    double depth = 1.0;
};

/// tolerance: parallax in front of the screen that nobody sees, >= 0. Samples are of the row through the
/// middle for eyes that toe in, and neither they nor the ones with a depth that is not above 0, or a place
/// that is NaN, count. Throws std::invalid_argument as check() does, and if the tolerance is outside its
/// domain.
[[nodiscard]] Window window_violations(const Eyes& eyes, std::span<const Sample> samples,
                                       double tolerance = 0.0);

/// On which side of the values a smooth curve stays.
enum class Side { either, below, above };

/// Samples that a smooth curve looks ahead at most: each value takes as many steps of work, some 15 us.
inline constexpr std::size_t most_ahead = 10000;

/// Values at equal times, smoothed by what is up to `ahead` samples before and behind, without lag. Where the
/// curve shall stay `below` or `above` all values, which it does except by rounding, values up to twice as
/// far count. Writes values.size() numbers; constant values stay. Throws std::invalid_argument, naming the
/// argument, if `ahead` is more than most_ahead, sizes differ, or a value is not finite or above 1e300 in
/// size.
void smooth(std::span<const double> values, std::size_t ahead, Side side, std::span<double> out);

}  // namespace motus::stereo
