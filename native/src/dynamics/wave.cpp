#include "motus/dynamics/wave.hpp"

#include <cmath>
#include <numbers>

#include "motus/core/numeric.hpp"

namespace motus::dynamics {

double wave(Wave shape, double place, double share) {
    require(share >= 0.0 && share <= 1.0, "share: must be from 0 to 1");
    const double within = place - std::floor(place);
    if (std::isnan(within)) return within;
    switch (shape) {
        case Wave::sine:
            return std::sin(2.0 * std::numbers::pi * within);
        case Wave::triangle:
            return within < 0.25 ? 4.0 * within : within < 0.75 ? 2.0 - 4.0 * within : 4.0 * within - 4.0;
        case Wave::saw:
            return 2.0 * within - 1.0;
        case Wave::square:
            break;
    }
    return within < share ? 1.0 : -1.0;
}

}  // namespace motus::dynamics
