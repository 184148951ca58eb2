// Second-order dynamics, and the double pendulum.
#include <vector>

#include "motus/dynamics/double_pendulum.hpp"
#include "motus/dynamics/second_order.hpp"
#include "web.hpp"

namespace motus::web {

/// out: the value at each time.
MOTUS_WEB(step_response)
(const double* times, std::size_t count, double frequency, double damping, double response, double* out) {
    const dynamics::SecondOrder filter(frequency, damping, response);
    for (std::size_t i = 0; i < count; ++i) out[i] = dynamics::step_response(filter, times[i]).value;
}

/// out: the overshoot, a fraction of the step, and the settling time, s.
MOTUS_WEB(step_measures)(double frequency, double damping, double response, double* out) {
    const dynamics::SecondOrder filter(frequency, damping, response);
    out[0] = dynamics::overshoot(filter);
    out[1] = dynamics::settling_time(filter);
}

/// From rest at two angles, with rods a metre long. out: two angles and their velocities a time.
MOTUS_WEB(double_pendulum)
(const double* times, std::size_t count, double theta1, double theta2, double mass2, double length2,
 double* out) {
    std::vector<dynamics::DoublePendulumState> states(count);
    dynamics::double_pendulum({.mass2 = mass2, .length2 = length2}, {.theta1 = theta1, .theta2 = theta2},
                              {times, count}, states);
    for (const dynamics::DoublePendulumState& state : states) {
        *out++ = state.theta1;
        *out++ = state.theta2;
        *out++ = state.omega1;
        *out++ = state.omega2;
    }
}

}  // namespace motus::web
