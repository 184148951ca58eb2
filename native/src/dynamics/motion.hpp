// Integrated motions of pendulums: how they are stepped; motion-inl.hpp has their derivatives. Private to the
// library.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "gauss.hpp"
#include "motus/core/cache.hpp"

namespace motus::dynamics {

/// size: number of the variables. axes: of a pivot's accelerations, in the plane (x, z) or in space.
/// Lengths in those of the (upper) rod, masses in the sum of both, times in a power of two of seconds.
/// Momenta are scaled likewise.
struct SingleSystem {
    [[nodiscard]] friend bool operator==(const SingleSystem&, const SingleSystem&) = default;
    static constexpr std::size_t size = 2;  ///< angle, velocity
    static constexpr std::size_t axes = 2;
    double gravity = 1.0;
    double damping = 0.0;

    /// Least moment of inertia, as a fraction of that at rest; at most 1.
    [[nodiscard]] static double inertia() { return 1.0; }
};

/// The single pendulum that swings to all sides. Cartesian coordinates have no pole, at which angles would
/// turn at once. Gauss's method keeps the angular momentum about the vertical, which is quadratic in them.
struct SphericalSystem {
    [[nodiscard]] friend bool operator==(const SphericalSystem&, const SphericalSystem&) = default;
    static constexpr std::size_t size = 6;  ///< place of the bob from the pivot, velocity
    static constexpr std::size_t axes = 3;
    double gravity = 1.0;
    double damping = 0.0;

    [[nodiscard]] static double inertia() { return 1.0; }

    /// Takes rounding out of a state: the rod has the length 1, and the velocity is at right angles to it. Of
    /// an error of either there would soon be a larger one of the length.
    static void settle(std::array<double, size>& state) {
        double square = 0.0;
        for (std::size_t axis = 0; axis < axes; ++axis) square += state[axis] * state[axis];
        const double shorter = 1.0 / std::sqrt(square);
        double along = 0.0;
        for (std::size_t axis = 0; axis < axes; ++axis) {
            state[axis] *= shorter;
            along += state[axis] * state[axes + axis];
        }
        for (std::size_t axis = 0; axis < axes; ++axis) state[axes + axis] -= along * state[axis];
    }
};

/// Hamilton's equations; the second momentum in units of the lower bob's own moment of inertia. Damping takes
/// from both momenta alike, which is what c omega takes from the velocities.
struct DoubleSystem {
    [[nodiscard]] friend bool operator==(const DoubleSystem&, const DoubleSystem&) = default;
    static constexpr std::size_t size = 4;  ///< both angles, both momenta
    static constexpr std::size_t axes = 2;
    double gravity = 1.0;
    double damping = 0.0;
    double mass = 0.5;    ///< of the lower bob, of both; 0 to 1
    double other = 0.5;   ///< 1 - mass, with all its digits
    double length = 1.0;  ///< of the lower rod

    [[nodiscard]] double inertia() const { return other < 0.5 ? 2.0 * other : 1.0; }
};

/// The double pendulum with limits: no Hamiltonian has them.
struct LimitedSystem {
    [[nodiscard]] friend bool operator==(const LimitedSystem&, const LimitedSystem&) = default;
    static constexpr std::size_t size = 4;  ///< both angles, both angular velocities
    static constexpr std::size_t axes = 2;
    DoubleSystem free;
    double most_acceleration = 0.0;
    double most_velocity = 0.0;

    [[nodiscard]] static double inertia() { return 1.0; }
};

inline void add_to(ContentHash& hash, const SingleSystem& system) {
    for (const double value : {system.gravity, system.damping}) hash.add(value);
}
inline void add_to(ContentHash& hash, const SphericalSystem& system) {
    for (const double value : {system.gravity, system.damping}) hash.add(value);
}
inline void add_to(ContentHash& hash, const DoubleSystem& system) {
    for (const double value : {system.gravity, system.damping, system.mass, system.length}) hash.add(value);
}
inline void add_to(ContentHash& hash, const LimitedSystem& system) {
    add_to(hash, system.free);
    for (const double value : {system.most_acceleration, system.most_velocity}) hash.add(value);
}

template <class System>
using MakeSteps = void (*)(std::span<GaussStep<System>>);

/// The ways to make steps that this processor has, all with the same bits; the last is the fastest.
struct StepKernel {
    const char* name;
    MakeSteps<SingleSystem> single;
    MakeSteps<DoubleSystem> pair;
    MakeSteps<SphericalSystem> spherical;
};
[[nodiscard]] std::span<const StepKernel> step_kernels();

/// Makes steps in small ones of Runge and Kutta's method, each brought within the limits. They converge
/// unless they would take too many small ones.
void make_limited_steps(std::span<GaussStep<LimitedSystem>> steps);

template <class System>
[[nodiscard]] MakeSteps<System> fastest_steps();
template <>
[[nodiscard]] inline MakeSteps<SingleSystem> fastest_steps() {
    return step_kernels().back().single;
}
template <>
[[nodiscard]] inline MakeSteps<DoubleSystem> fastest_steps() {
    return step_kernels().back().pair;
}
template <>
[[nodiscard]] inline MakeSteps<SphericalSystem> fastest_steps() {
    return step_kernels().back().spherical;
}
template <>
[[nodiscard]] inline MakeSteps<LimitedSystem> fastest_steps() {
    return &make_limited_steps;
}

}  // namespace motus::dynamics
