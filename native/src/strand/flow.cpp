#include "flow.hpp"

#include <cmath>

namespace motus::strand {

Flow make_flow(double pull, double resistance, double step) {
    // The Taylor series of a part of the step that is so short that it converges at once, doubled until it is
    // the whole one. Closed formulas would lose all digits where the pull is small.
    constexpr double near = 0.5;
    constexpr int terms = 20;
    int doublings = 0;
    double h = step;
    while (std::sqrt(pull) * h > near || resistance * h > near) {
        h *= 0.5;
        ++doublings;
    }
    Flow flow{pull, resistance, 0.0, 0.0, 0.0, 0.0};
    double before = 0.0, now = h;  // the terms of z for v = 1
    for (int n = 1; n <= terms; ++n) {
        flow.speed_of_speed += n * now / h;
        flow.place_of_speed += now;
        flow.place_of_force += now * h / (n + 1);
        flow.place_of_ramp += now * h * h / ((n + 1) * (n + 2));
        const double next = -(pull * h * before + n * resistance * now) * h / (n * (n + 1.0));
        before = now;
        now = next;
    }
    for (; doublings > 0; --doublings, h *= 2.0) {
        const double s = flow.place_of_speed, d = flow.speed_of_speed;
        const double kept = d + resistance * s;  // z for z = 1 at first
        const double force = flow.place_of_force, ramp = flow.place_of_ramp;
        flow.place_of_ramp = kept * ramp + s * force + h * force + ramp;
        flow.place_of_force = kept * force + s * s + force;
        flow.place_of_speed = (kept + d) * s;
        flow.speed_of_speed = d * d - pull * s * s;
    }
    return flow;
}

}  // namespace motus::strand
