// Pendulums: single, spherical and double.
#include "motus/dynamics/pendulum.hpp"

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "areas.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "motus/dynamics/double_pendulum.hpp"
#include "motus/dynamics/spherical_pendulum.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using namespace motus::dynamics;

constexpr double state_cost = 600.0;  // ns, rough

static_assert(sizeof(PendulumState) == 2 * sizeof(double), "states are rows of numbers");
static_assert(sizeof(SphericalState) == 6 * sizeof(double), "states are rows of numbers");
static_assert(sizeof(DoublePendulumState) == 4 * sizeof(double), "states are rows of numbers");

/// (k, axes): of x and z in the plane of a swing, or of x, y and z.
[[nodiscard]] DoubleArray rows_of(const py::object& object, const char* name, py::ssize_t axes) {
    DoubleArray array = doubles(object, name);
    if (array.ndim() != 2 || array.shape(1) != axes)
        value_error(name, "must have the shape (k, " + std::to_string(axes) + "), not " + shape_of(array));
    return array;
}

[[nodiscard]] std::span<const double> numbers_in(const DoubleArray& array) {
    return {array.data(), static_cast<std::size_t>(array.size())};
}

/// The two arguments that move a pivot.
class Pivot {
  public:
    Pivot(const Number& step, const OptionalArrayLike& accelerations, py::ssize_t axes = 2)
        : step_(number(step, "pivot_step")) {
        if (!accelerations.is_none())
            accelerations_.emplace(rows_of(accelerations, "pivot_accelerations", axes));
        if (accelerations_ && !(step_ > 0.0)) value_error("pivot_step", "must be greater than 0");
    }
    [[nodiscard]] bool moves() const noexcept { return accelerations_.has_value(); }
    [[nodiscard]] PivotMotion motion() const { return {step_, numbers_in(*accelerations_)}; }

  private:
    double step_;
    std::optional<DoubleArray> accelerations_;
};

/// solve(times, rows) for a number or an array of times: (size,) or (m, size).
template <class State, class Solve>
[[nodiscard]] DoubleArray states_at(const ArrayLike& times, const Solve& solve) {
    const Numbers at(times, "times");
    constexpr std::size_t size = sizeof(State) / sizeof(double);
    DoubleArray result = at.is_single() ? new_array({size}) : new_array({at.values().size(), size});
    const std::span<State> rows{reinterpret_cast<State*>(result.mutable_data()), at.values().size()};
    {
        const ReleaseGil released(rows.size(), state_cost);
        solve(at.values(), rows);
    }
    return result;
}

[[nodiscard]] double limit(const OptionalNumber& object, const char* name) {
    constexpr double none = std::numeric_limits<double>::infinity();
    if (object.is_none()) return none;
    return number(object, name);
}

[[nodiscard]] DoublePendulum double_pendulum_of(const Number& mass1, const Number& mass2,
                                                const Number& length1, const Number& length2,
                                                const Number& gravity, const Number& damping,
                                                const OptionalNumber& most_acceleration,
                                                const OptionalNumber& most_velocity) {
    return {number(mass1, "mass1"),
            number(mass2, "mass2"),
            number(length1, "length1"),
            number(length2, "length2"),
            number(gravity, "gravity"),
            number(damping, "damping"),
            limit(most_acceleration, "most_acceleration"),
            limit(most_velocity, "most_velocity")};
}

void bind_single(py::module_& m) {
    m.def(
        "single_pendulum",
        [](const ArrayLike& times, const Number& theta, const Number& omega, const Number& length,
           const Number& gravity, const Number& damping, const Number& pivot_step,
           const OptionalArrayLike& pivot_accelerations) {
            const Pendulum pendulum{number(length, "length"), number(gravity, "gravity"),
                                    number(damping, "damping")};
            const PendulumState start{number(theta, "theta"), number(omega, "omega")};
            const Pivot pivot(pivot_step, pivot_accelerations);
            return states_at<PendulumState>(
                times, [&](std::span<const double> at, std::span<PendulumState> rows) {
                    if (pivot.moves())
                        single_pendulum(pendulum, start, pivot.motion(), at, rows);
                    else
                        single_pendulum(pendulum, start, at, rows);
                });
        },
        "times"_a, "theta"_a, "omega"_a = 0.0, "length"_a = 1.0, "gravity"_a = 9.81, "damping"_a = 0.0,
        "pivot_step"_a = 0.0, "pivot_accelerations"_a = py::none(), R"(
Angle (rad from the downward vertical, with all turns) and angular velocity (rad/s) of a pendulum at times.

theta'' = -(gravity / length) sin(theta) - damping theta'

times: s, a number or (m,), of any sign and order.  theta, omega: the state at time 0.  length: m, > 0.  gravity: m/s^2,
>= 0.  damping: 1/s, >= 0.  pivot_accelerations: (k, 2), m/s^2, of a moving pivot in the plane of the swing (to the side
of positive angles, and up), every pivot_step seconds from time 0 on, linear in between, none after the last; times must
then be >= 0.
Returns (2,) or (m, 2). Undamped on a fixed pivot in closed form (Jacobi's elliptic functions), else integrated.
Raises ValueError if a value is not finite or outside its domain, or a time is out of the integration's reach.)");
    m.def(
        "pendulum_angle",
        [](double time, double theta, double omega, double length, double gravity, double damping) {
            PendulumState state;
            single_pendulum({length, gravity, damping}, {theta, omega}, {&time, 1}, {&state, 1});
            return state.angle;
        },
        "time"_a, "theta"_a, "omega"_a = 0.0, "length"_a = 1.0, "gravity"_a = 9.81, "damping"_a = 0.0, R"(
The angle that single_pendulum() gives for one time, as a float, without the cost of arrays.  Arguments and errors as for single_pendulum().)");
    m.def(
        "pendulum_period",
        [](const Number& theta, const Number& omega, const Number& length, const Number& gravity) {
            return pendulum_period({number(length, "length"), number(gravity, "gravity"), 0.0},
                                   {number(theta, "theta"), number(omega, "omega")});
        },
        "theta"_a, "omega"_a = 0.0, "length"_a = 1.0, "gravity"_a = 9.81, R"(
Seconds after which an undamped pendulum repeats itself, a full turn being a repetition; infinity if it never does.
Arguments and errors as single_pendulum().)");
    m.def(
        "pivot_accelerations",
        [](const Number& step, const ArrayLike& positions) {
            const DoubleArray given = rows_of(positions, "positions", 2);
            DoubleArray result = new_array({static_cast<std::size_t>(given.shape(0)), 2});
            pivot_accelerations(number(step, "step"), numbers_in(given), values_of(result));
            return result;
        },
        "step"_a, "positions"_a, R"(
Accelerations (k, 2) of a pivot that passes through positions (k, 2), m, `step` seconds (> 0) apart: those of the natural
cubic spline, for the pivot_accelerations of pendulum functions.  Raises ValueError if a value is not finite.)");
}

void bind_spherical(py::module_& m) {
    m.def(
        "spherical_pendulum",
        [](const ArrayLike& times, const Number& angle, const Number& heading, const Number& velocity,
           const Number& across, const Number& length, const Number& gravity, const Number& damping,
           const Number& pivot_step, const OptionalArrayLike& pivot_accelerations) {
            const Pendulum pendulum{number(length, "length"), number(gravity, "gravity"),
                                    number(damping, "damping")};
            const SphericalStart start{number(angle, "angle"), number(heading, "heading"),
                                       number(velocity, "velocity"), number(across, "across")};
            const Pivot pivot(pivot_step, pivot_accelerations, 3);
            return states_at<SphericalState>(
                times, [&](std::span<const double> at, std::span<SphericalState> rows) {
                    if (pivot.moves())
                        spherical_pendulum(pendulum, start, pivot.motion(), at, rows);
                    else
                        spherical_pendulum(pendulum, start, at, rows);
                });
        },
        "times"_a, "angle"_a, "heading"_a = 0.0, "velocity"_a = 0.0, "across"_a = 0.0, "length"_a = 1.0,
        "gravity"_a = 9.81, "damping"_a = 0.0, "pivot_step"_a = 0.0, "pivot_accelerations"_a = py::none(), R"(
Direction (x, y, z, of length 1, Z up) from the pivot to the bob of a pendulum that swings to all sides, and its change in
a second, at times.

times: s, a number or (m,), of any sign and order; each row depends on its own time alone.  angle: at time 0, rad from the
downward vertical, towards the heading, rad about the vertical from X to Y.  velocity, across: rad/s, by which the angle
grows, and at right angles to that, to the side to which the heading grows.  length: m, > 0.  gravity: m/s^2, >= 0.
damping: 1/s, >= 0.  pivot_step, pivot_accelerations: see single_pendulum(), here (k, 3) in space.
Returns (6,) or (m, 6). By Gauss's method of order 16, which keeps the angular momentum about the vertical. The same bits
by the same compiler.
Raises ValueError if a value is not finite or outside its domain, or a time is out of the integration's reach.)");
}

void bind_double(py::module_& m) {
    m.def(
        "double_pendulum",
        [](const ArrayLike& times, const Number& theta1, const Number& theta2, const Number& omega1,
           const Number& omega2, const Number& mass1, const Number& mass2, const Number& length1,
           const Number& length2, const Number& gravity, const Number& damping,
           const OptionalNumber& most_acceleration, const OptionalNumber& most_velocity,
           const Number& pivot_step, const OptionalArrayLike& pivot_accelerations) {
            const DoublePendulum pendulum = double_pendulum_of(mass1, mass2, length1, length2, gravity,
                                                               damping, most_acceleration, most_velocity);
            const DoublePendulumState start{number(theta1, "theta1"), number(theta2, "theta2"),
                                            number(omega1, "omega1"), number(omega2, "omega2")};
            const Pivot pivot(pivot_step, pivot_accelerations);
            return states_at<DoublePendulumState>(
                times, [&](std::span<const double> at, std::span<DoublePendulumState> rows) {
                    if (pivot.moves())
                        double_pendulum(pendulum, start, pivot.motion(), at, rows);
                    else
                        double_pendulum(pendulum, start, at, rows);
                });
        },
        "times"_a, "theta1"_a, "theta2"_a, "omega1"_a = 0.0, "omega2"_a = 0.0, "mass1"_a = 1.0,
        "mass2"_a = 1.0, "length1"_a = 1.0, "length2"_a = 1.0, "gravity"_a = 9.81, "damping"_a = 0.0,
        "most_acceleration"_a = py::none(), "most_velocity"_a = py::none(), "pivot_step"_a = 0.0,
        "pivot_accelerations"_a = py::none(), R"(
theta1, theta2 (rad from the downward vertical, with all turns), omega1, omega2 (rad/s) of a double pendulum at times.

times: s, a number or (m,), of any sign and order; each row depends on its own time alone.  theta1, theta2, omega1, omega2:
the state at time 0.  mass1, length1: of the upper bob and rod, kg and m, > 0.  gravity: m/s^2, >= 0.  damping: 1/s, >= 0,
taken as damping * omega from both angular accelerations.  most_acceleration, most_velocity: None, or limits (> 0) on the
sizes of angular accelerations and velocities, which no real pendulum has.  pivot_step, pivot_accelerations: see
single_pendulum().
Returns (4,) or (m, 4). By Gauss's method of order 16; the energy stays within some 1e-11 of its range. The same bits by
the same compiler.  Raises ValueError if a value is not finite or outside its domain, and for times beyond
double_pendulum_longest_time().)");
    m.def(
        "double_pendulum_value",
        [](double time, std::size_t which, double theta1, double theta2, double omega1, double omega2,
           double mass1, double mass2, double length1, double length2, double gravity, double damping) {
            if (which > 3) value_error("which", "must be 0 to 3");
            DoublePendulumState state;
            double_pendulum({mass1, mass2, length1, length2, gravity, damping},
                            {theta1, theta2, omega1, omega2}, {&time, 1}, {&state, 1});
            return std::array{state.theta1, state.theta2, state.omega1, state.omega2}[which];
        },
        "time"_a, "which"_a, "theta1"_a, "theta2"_a, "omega1"_a = 0.0, "omega2"_a = 0.0, "mass1"_a = 1.0,
        "mass2"_a = 1.0, "length1"_a = 1.0, "length2"_a = 1.0, "gravity"_a = 9.81, "damping"_a = 0.0, R"(
The number that double_pendulum() gives for one time in its column `which` (0 to 3), as a float, without the cost of arrays.
Arguments and errors as for double_pendulum(); ValueError for another `which`.)");
    m.def(
        "double_pendulums",
        [](const Number& time, const ArrayLike& starts, const Number& mass1, const Number& mass2,
           const Number& length1, const Number& length2, const Number& gravity, const Number& damping,
           const OptionalNumber& most_acceleration, const OptionalNumber& most_velocity,
           const Number& pivot_step, const OptionalArrayLike& pivot_accelerations) {
            const DoublePendulum pendulum = double_pendulum_of(mass1, mass2, length1, length2, gravity,
                                                               damping, most_acceleration, most_velocity);
            const Pivot pivot(pivot_step, pivot_accelerations);
            const DoubleArray given = doubles(starts, "starts");
            if (given.ndim() != 2 || given.shape(1) != 4)
                value_error("starts", "must have the shape (n, 4), not " + shape_of(given));
            const auto count = static_cast<std::size_t>(given.shape(0));
            DoubleArray result = new_array({count, 4});
            const std::span first{reinterpret_cast<const DoublePendulumState*>(given.data()), count};
            const std::span rows{reinterpret_cast<DoublePendulumState*>(result.mutable_data()), count};
            const double at = number(time, "time");
            {
                const ReleaseGil released(count, state_cost);
                if (pivot.moves())
                    double_pendulums(pendulum, first, pivot.motion(), at, rows);
                else
                    double_pendulums(pendulum, first, at, rows);
            }
            return result;
        },
        "time"_a, "starts"_a, "mass1"_a = 1.0, "mass2"_a = 1.0, "length1"_a = 1.0, "length2"_a = 1.0,
        "gravity"_a = 9.81, "damping"_a = 0.0, "most_acceleration"_a = py::none(),
        "most_velocity"_a = py::none(), "pivot_step"_a = 0.0, "pivot_accelerations"_a = py::none(), R"(
States (n, 4) of many equal double pendulums at one time, s, from states `starts` (n, 4) at time 0. The same numbers as
double_pendulum() gives one by one, in less time.  Other arguments and errors as for double_pendulum(); also ValueError
if the time is so far, or the starts are so many, that their cached states would need more than 448 MB.)");
    m.def(
        "double_pendulum_longest_time",
        [](const Number& theta1, const Number& theta2, const Number& omega1, const Number& omega2,
           const Number& mass1, const Number& mass2, const Number& length1, const Number& length2,
           const Number& gravity) {
            return longest_time({number(mass1, "mass1"), number(mass2, "mass2"), number(length1, "length1"),
                                 number(length2, "length2"), number(gravity, "gravity")},
                                {number(theta1, "theta1"), number(theta2, "theta2"), number(omega1, "omega1"),
                                 number(omega2, "omega2")});
        },
        "theta1"_a, "theta2"_a, "omega1"_a = 0.0, "omega2"_a = 0.0, "mass1"_a = 1.0, "mass2"_a = 1.0,
        "length1"_a = 1.0, "length2"_a = 1.0, "gravity"_a = 9.81, R"(
Farthest time, s, before or after 0, for which double_pendulum() gives the state.  Arguments and errors as there.)");
}

}  // namespace

void bind_pendulum(py::module_& m) {
    bind_single(m);
    bind_spherical(m);
    bind_double(m);
}

}  // namespace motus::bindings
