// The double pendulum: two bobs on massless rods, the second one hanging on the first.
//
// Integrated in canonical variables (angles and their momenta) by Gauss's method of order 16, which keeps the
// energy to some 1e-13 of its range. The states at equal intervals are cached and shared by all callers with
// the same pendulum and start; one step leads from a cached state to any time. No function of the system's
// mathematics library is used, which would differ from release to release: a chaotic motion would soon show
// it. The same bits by the same compiler (docs/library.md).
//
// Costs: O(1) a time by steps that are cached, else as many steps as lie between time 0 and it. Allocates
// the steps and some memory for its work. Any number of threads at once.
#pragma once
#include <limits>
#include <span>

#include "motus/dynamics/pendulum.hpp"

namespace motus::dynamics {

/// Kilograms, metres, m/s^2, 1/s.
struct DoublePendulum {
    double mass1 = 1.0;     ///< of the upper bob, > 0
    double mass2 = 1.0;     ///< of the lower bob, > 0
    double length1 = 1.0;   ///< of the upper rod, > 0
    double length2 = 1.0;   ///< of the lower rod, > 0
    double gravity = 9.81;  ///< >= 0
    double damping = 0.0;   ///< c, >= 0: c omega is subtracted from each angular acceleration
    /// Limits, which a real pendulum does not have, on the sizes of both angular accelerations, rad/s^2, and
    /// velocities, rad/s; > 0. With one of them the motion is integrated in small steps of Runge and Kutta's
    /// method, as many as keep the error of each some 1e-10 rad, however strong damping and pivot are.
    double most_acceleration = std::numeric_limits<double>::infinity();
    double most_velocity = std::numeric_limits<double>::infinity();

    [[nodiscard]] friend bool operator==(const DoublePendulum&, const DoublePendulum&) = default;
};

/// Angles of both rods from the downward vertical, rad, with all turns, up to 1e9 in size; angular
/// velocities, rad/s.
struct DoublePendulumState {
    double theta1 = 0.0;
    double theta2 = 0.0;
    double omega1 = 0.0;
    double omega2 = 0.0;

    [[nodiscard]] friend bool operator==(const DoublePendulumState&, const DoublePendulumState&) = default;
};

/// State at each time, s, whatever its sign and order, from the state at time 0. Each depends on its own time
/// alone, bit for bit. Throws std::invalid_argument, naming the argument, if a number is not finite or
/// outside its domain, sizes differ, a time lies beyond longest_time() or would take too many steps of so
/// stiff a motion, or velocities grow beyond all bounds (backwards in time with damping). If it throws, it
/// has written nothing.
void double_pendulum(const DoublePendulum& pendulum, const DoublePendulumState& start,
                     std::span<const double> times, std::span<DoublePendulumState> out);

/// States of a double pendulum on a moving pivot; see PivotMotion.
void double_pendulum(const DoublePendulum& pendulum, const DoublePendulumState& start,
                     const PivotMotion& pivot, std::span<const double> times,
                     std::span<DoublePendulumState> out);

/// States of many double pendulums at one time, each from a start of its own: out.size() == starts.size().
/// The same numbers as one by one, in about two thirds of the time. Also throws std::invalid_argument if the
/// cached states would not fit into the cache together: those of 500 pendulums a metre long beyond 13
/// minutes, of more than 2048 at any time.
void double_pendulums(const DoublePendulum& pendulum, std::span<const DoublePendulumState> starts,
                      double time, std::span<DoublePendulumState> out);

/// States of many double pendulums on one moving pivot.
void double_pendulums(const DoublePendulum& pendulum, std::span<const DoublePendulumState> starts,
                      const PivotMotion& pivot, double time, std::span<DoublePendulumState> out);

/// Farthest time, s, before or after 0, that the table of states may reach. Throws as double_pendulum() does.
[[nodiscard]] double longest_time(const DoublePendulum& pendulum, const DoublePendulumState& start);

/// Kinetic and potential energy, J; 0 at rest with both bobs at the pivot's height. Throws
/// std::invalid_argument as double_pendulum() does.
[[nodiscard]] double energy(const DoublePendulum& pendulum, const DoublePendulumState& state);

}  // namespace motus::dynamics
