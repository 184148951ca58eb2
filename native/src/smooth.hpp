// Smooth transitions.
#pragma once
#include <algorithm>

namespace motus {

/// 0 up to x = 0, 1 from x = 1 on, 3x^2 - 2x^3 between.
[[nodiscard]] inline double smooth_step(double x) {
    const double u = std::clamp(x, 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}

}  // namespace motus
