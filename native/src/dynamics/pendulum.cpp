#include "motus/dynamics/pendulum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motion_cache.hpp"
#include "swing.hpp"
#include "units.hpp"

namespace motus::dynamics {
namespace {

void require_valid(const Pendulum& pendulum, const PendulumState& start, std::span<const double> times,
                   std::span<const PendulumState> out) {
    require_valid(pendulum);
    require(std::isfinite(start.angle), "angle: must be finite");
    require(std::isfinite(start.velocity), "velocity: must be finite");
    require(are_finite(times), "times: must be finite");
    require(times.size() == out.size(), "out: must have a state for each time");
}

/// Settings of the motion that are the same with and without a moving pivot.
[[nodiscard]] MotionSettings<SingleSystem> settings_of(const Pendulum& pendulum, const PendulumState& start,
                                                       const TimeUnit& unit) {
    require(is_angle(start.angle), "angle: must be 1e9 at most with damping or a moved pivot");
    MotionSettings<SingleSystem> settings;
    settings.system = {unit.gravity, unit.from_rate(pendulum.damping)};
    settings.start = {start.angle, unit.from_rate(start.velocity)};
    settings.interval = interval_for(std::abs(settings.start[1]));
    return settings;
}

/// The state that `state_at` gives for each time; writes nothing if any of the calls throws.
template <class StateAt>
void write(std::span<const double> times, std::span<PendulumState> out, const StateAt& state_at) {
    std::vector<PendulumState> states;
    states.reserve(times.size());
    for (const double time : times) {
        states.push_back(state_at(time));
        if (!are_finite(states.back().angle, states.back().velocity))
            throw std::invalid_argument("times: must not reach where the angle is beyond all numbers");
    }
    std::ranges::copy(states, out.begin());
}

void integrate(MotionSettings<SingleSystem> settings, const TimeUnit& unit, std::span<const double> times,
               std::span<PendulumState> out) {
    Motion<SingleSystem> motion(std::move(settings));
    write(times, out, [&](double time) {
        const auto [angle, velocity] = motion.at(unit.from_seconds(time));
        return PendulumState{angle, unit.to_rate(velocity)};
    });
}

}  // namespace

void single_pendulum(const Pendulum& pendulum, const PendulumState& start, std::span<const double> times,
                     std::span<PendulumState> out) {
    require_valid(pendulum, start, times, out);
    if (pendulum.damping == 0.0) {
        const Swing swing(pendulum, start);
        write(times, out, [&](double time) { return swing.at(time); });
        return;
    }
    const TimeUnit unit(pendulum.length, pendulum.gravity);
    integrate(settings_of(pendulum, start, unit), unit, times, out);
}

void single_pendulum(const Pendulum& pendulum, const PendulumState& start, const PivotMotion& pivot,
                     std::span<const double> times, std::span<PendulumState> out) {
    require_valid(pendulum, start, times, out);
    const TimeUnit unit(pendulum.length, pendulum.gravity);
    MotionSettings<SingleSystem> settings = settings_of(pendulum, start, unit);
    drive(settings, pivot, unit, pendulum.length);
    integrate(std::move(settings), unit, times, out);
}

double pendulum_period(const Pendulum& pendulum, const PendulumState& start) {
    require_valid(pendulum, start, {}, {});
    return Swing(pendulum, start).period();
}

void pivot_accelerations(double step, std::span<const double> positions, std::span<double> out) {
    require(is_positive(step), "step: must be greater than 0 and finite");
    require(positions.size() % 2 == 0, "positions: must be pairs of x and z");
    require(positions.size() == out.size(), "out: must have the size of positions");
    require(are_finite(positions), "positions: must be finite");
    const std::size_t count = positions.size() / 2;
    std::vector<double> found(positions.size());
    // a[k-1] + 4 a[k] + a[k+1] = 6 (p[k-1] - 2 p[k] + p[k+1]) / step^2, solved by elimination.
    std::vector<double> factors(count);
    for (std::size_t k = 1; k + 1 < count; ++k) factors[k] = 1.0 / (4.0 - factors[k - 1]);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto at = [&](std::size_t k) { return positions[2 * k + axis]; };
        const auto a = [&](std::size_t k) -> double& { return found[2 * k + axis]; };
        for (std::size_t k = 1; k + 1 < count; ++k) {
            const double second = 6.0 * ((at(k + 1) - at(k)) - (at(k) - at(k - 1))) / (step * step);
            a(k) = (second - a(k - 1)) * factors[k];
        }
        for (std::size_t k = count; k-- > 1;)
            if (k + 1 < count) a(k) -= factors[k] * a(k + 1);
    }
    require(are_finite(found), "positions: must be nearer to each other for so short a step");
    std::ranges::copy(found, out.begin());
}

}  // namespace motus::dynamics
