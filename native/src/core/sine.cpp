#include "motus/core/sine.hpp"

#include <cmath>
#include <numbers>

#include "motus/core/sine-inl.hpp"

namespace motus {

double without_turns(double angle) {
    return std::fmod(angle, 2.0 * std::numbers::pi);
}

SineCosine<double> sine_cosine(double angle) {
    return HWY_NAMESPACE::sine_cosine(angle);
}

}  // namespace motus
