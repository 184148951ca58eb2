// Waves: sine, triangle, saw and square.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <cstdint>

namespace motus::dynamics {

/// sine, triangle: 0 at the start of a wave, and rising. saw: from -1 up to 1, and at once back. square: 1,
/// then -1.
enum class Wave : std::uint8_t { sine, triangle, saw, square };

/// A wave of the length 1 at a place, in [-1, 1]; the same bits at places that lie whole waves apart, if both
/// are exact. share: fraction of a wave for which `square` is 1. Throws std::invalid_argument if `share` is
/// outside [0, 1]. A place that is not finite gives NaN.
[[nodiscard]] double wave(Wave shape, double place, double share = 0.5);

}  // namespace motus::dynamics
