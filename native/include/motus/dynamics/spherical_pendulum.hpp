// The spherical pendulum: a bob on a massless rod that swings to all sides.
//
// Integrated in Cartesian coordinates, which have no pole, by Gauss's method of order 16. The states at equal
// intervals are cached and shared by all callers with the same pendulum and start; one step leads from a
// cached state to any time. Nothing of the system's mathematics library is used. The same bits by the same
// compiler (docs/library.md).
//
// Costs: O(1) a time by steps that are cached, else as many steps as lie between time 0 and it. Allocates
// the steps and some memory for its work. Any number of threads at once.
#pragma once
#include <glm/vec3.hpp>
#include <span>

#include "motus/config.hpp"
#include "motus/dynamics/pendulum.hpp"

namespace motus::dynamics {

/// How a spherical pendulum starts. Angles up to 1e9 in size, rad; angular velocities, rad/s.
struct SphericalStart {
    double angle = 0.0;     ///< from the downward vertical, towards the heading
    double heading = 0.0;   ///< about the upward vertical, from x towards y
    double velocity = 0.0;  ///< by which the angle grows
    double across = 0.0;    ///< at right angles to that, to the side to which the heading grows
};

/// Z is up.
struct SphericalState {
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< from the pivot to the bob, of length 1
    glm::dvec3 velocity{0.0};              ///< change of the direction, 1/s

    [[nodiscard]] friend bool operator==(const SphericalState&, const SphericalState&) = default;
};

/// State at each time, s, whatever its sign and order, from the start at time 0. Each depends on its own time
/// alone, bit for bit. The angular momentum about the vertical is kept to some 1e-13 of the largest, and the
/// energy without damping to some 1e-12 of its range. Throws std::invalid_argument, naming the argument, if a
/// number is not finite or outside its domain, sizes differ, a time would need a table of too many steps, or
/// velocities grow beyond all bounds (backwards in time with damping). If it throws, it has written nothing.
void spherical_pendulum(const Pendulum& pendulum, const SphericalStart& start, std::span<const double> times,
                        std::span<SphericalState> out);

/// States on a moving pivot, whose accelerations are x0, y0, z0, x1, y1, z1, ... in space.
void spherical_pendulum(const Pendulum& pendulum, const SphericalStart& start, const PivotMotion& pivot,
                        std::span<const double> times, std::span<SphericalState> out);

}  // namespace motus::dynamics
