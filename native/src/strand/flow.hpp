// The exact motion of one free particle on a spring with drag, over one step. Private to the library.
#pragma once

namespace motus::strand {

/// Solves z'' = F + R t - pull z - resistance z' over a step, from z = 0 and z' = v:
/// z = v place_of_speed + F place_of_force + R place_of_ramp, and
/// z' = v speed_of_speed + F place_of_speed + R place_of_force.
struct Flow {
    double pull = 0.0;        ///< 1/s^2, square of the spring's rate
    double resistance = 0.0;  ///< 1/s
    double speed_of_speed = 1.0;
    double place_of_speed = 0.0;
    double place_of_force = 0.0;
    double place_of_ramp = 0.0;
};

/// pull, resistance, step: >= 0, with pull step^2 and resistance step up to some 1e4.
[[nodiscard]] Flow make_flow(double pull, double resistance, double step);

}  // namespace motus::strand
