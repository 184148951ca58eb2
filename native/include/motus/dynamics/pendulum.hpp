// The single pendulum: a bob on a massless rod, theta'' = -(g / L) sin(theta) - c theta'.
//
// Without damping the motion is known in closed form by Jacobi's elliptic functions: Abramowitz, Stegun,
// "Handbook of Mathematical Functions" (1964), 16-17. With damping it is integrated (see motion.hpp).
//
// Costs: O(1) a time; with damping or a moved pivot by steps that are cached, else as many as lie between
// time 0 and it. Allocates those and some memory for its work. Any number of threads at once.
#pragma once
#include <span>

namespace motus::dynamics {

/// Metres, m/s^2, 1/s.
struct Pendulum {
    double length = 1.0;    ///< > 0
    double gravity = 9.81;  ///< >= 0
    double damping = 0.0;   ///< c, >= 0: the loss of velocity in a second, as a fraction of the velocity
};

/// Angle from the downward vertical, rad, with all turns; angular velocity, rad/s.
struct PendulumState {
    double angle = 0.0;
    double velocity = 0.0;

    [[nodiscard]] friend bool operator==(const PendulumState&, const PendulumState&) = default;
};

/// State at each time, s, whatever its sign and order, from the state at time 0; in the closed form to some
/// 1e-15 of the angle and as much for each period that has passed, else to some 1e-12.
/// Throws std::invalid_argument, naming the argument, if a number is not finite or outside its domain, or
/// sizes differ, a damped motion would need a table of too many steps, or an angle would be beyond all
/// numbers. With damping or a moved pivot the angle at the start is
/// 1e9 at most in size. If it throws, it has written nothing.
void single_pendulum(const Pendulum& pendulum, const PendulumState& start, std::span<const double> times,
                     std::span<PendulumState> out);

/// Time, s, after which an undamped pendulum repeats itself, a full turn being a repetition too; infinity
/// if it never does: it rests, has no gravity to turn it back, or just reaches the top.
[[nodiscard]] double pendulum_period(const Pendulum& pendulum, const PendulumState& start);

/// The motion of a pivot: accelerations of the pivot in the plane of the swing, (x, z)
/// in m/s^2, x to the side to which positive angles swing and z up; at times 0, step, 2 step, ..., linear
/// between, none after the last. Times below 0 are refused with std::invalid_argument, since the pivot's past
/// is not known.
struct PivotMotion {
    double step = 0.0;                           ///< s, > 0
    std::span<const double> accelerations = {};  ///< x0, z0, x1, z1, ...
};
void single_pendulum(const Pendulum& pendulum, const PendulumState& start, const PivotMotion& pivot,
                     std::span<const double> times, std::span<PendulumState> out);

/// Accelerations of a pivot that passes through positions (x, z), m, `step` seconds apart: those of the
/// natural cubic spline, which starts and ends without acceleration. `out` has the size of `positions`. de
/// Boor, "A Practical Guide to Splines" (1978), IV.
void pivot_accelerations(double step, std::span<const double> positions, std::span<double> out);

}  // namespace motus::dynamics
