#include "motus/core/sine.hpp"

#include <cmath>
#include <numbers>

namespace motus {

double without_turns(double angle) {
    return std::fmod(angle, 2.0 * std::numbers::pi);
}

}  // namespace motus
