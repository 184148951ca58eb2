// From seconds, metres and kilograms to a motion's own units, and how long its intervals are. Private to the
// library.
#pragma once
#include <algorithm>
#include <cmath>

#include "motion_table.hpp"
#include "motus/core/numeric.hpp"
#include "motus/dynamics/pendulum.hpp"

namespace motus::dynamics {

[[nodiscard]] inline bool is_positive(double value) {
    return std::isfinite(value) && value > 0.0;
}
[[nodiscard]] inline bool is_not_negative(double value) {
    return std::isfinite(value) && value >= 0.0;
}

inline void require_valid(const Pendulum& pendulum) {
    require(is_positive(pendulum.length), "length: must be greater than 0 and finite");
    require(is_not_negative(pendulum.gravity), "gravity: must be at least 0 and finite");
    require(is_not_negative(pendulum.damping), "damping: must be at least 0 and finite");
}

/// Whether an angle is one that a motion can be integrated from.
[[nodiscard]] inline bool is_angle(double value) {
    constexpr double largest = 1e9;
    return std::abs(value) <= largest;
}

/// The power of two next to a number > 0, in its exponent; between -1000 and 1000.
[[nodiscard]] inline int exponent_of(double value) {
    constexpr int most = 1000;
    return std::clamp(std::ilogb(value), -most, most);
}

/// Seconds in a unit of time, and the gravity in it; the rod's length is the unit of length. A power of two,
/// by which times are scaled without rounding.
struct TimeUnit {
    int exponent = 0;
    double gravity = 0.0;

    TimeUnit(double length, double earth) : exponent(earth > 0.0 ? exponent_of(length / earth) / 2 : 0) {
        gravity = std::scalbn(earth / length, 2 * exponent);
    }
    [[nodiscard]] double from_seconds(double time) const { return std::scalbn(time, -exponent); }
    [[nodiscard]] double to_seconds(double time) const { return std::scalbn(time, exponent); }
    [[nodiscard]] double from_rate(double rate) const { return std::scalbn(rate, exponent); }
    [[nodiscard]] double to_rate(double rate) const { return std::scalbn(rate, -exponent); }
    /// m/s^2, in lengths of the rod.
    [[nodiscard]] double from_acceleration(double value, double length) const {
        return std::scalbn(value / length, 2 * exponent);
    }
};

/// How far apart the nodes of a table lie, in units of time, for the highest rate (>= 0) at which the motion
/// swings or turns at first.
[[nodiscard]] inline double interval_for(double rate) {
    constexpr int slowest = -3;  // an eighth of the unit
    return std::scalbn(1.0, slowest - (rate > 1.0 ? exponent_of(rate) : 0));
}

/// Has the motion follow a moved pivot: nodes then lie on its samples.
template <class System>
void drive(MotionSettings<System>& settings, const PivotMotion& pivot, const TimeUnit& unit, double length) {
    require(is_positive(pivot.step), "step: must be greater than 0 and finite");
    require(pivot.accelerations.size() % System::axes == 0,
            System::axes == 2 ? "accelerations: must be pairs of x and z"
                              : "accelerations: must be triples of x, y and z");
    const double step = unit.from_seconds(pivot.step);
    constexpr int most_halvings = 20;
    const int halvings =
        step > settings.interval ? std::max(exponent_of(step / settings.interval), 0) + 1 : 0;
    require(halvings <= most_halvings, "step: must be shorter for so fast a pendulum");
    settings.interval = std::scalbn(step, -halvings);
    settings.intervals_per_sample = 1 << halvings;
    for (const double value : pivot.accelerations) {
        require(std::isfinite(value), "accelerations: must be finite");
        settings.accelerations.push_back(unit.from_acceleration(value, length));
    }
}

}  // namespace motus::dynamics
