// Integrated motions of pendulums: how they are stepped. Private to the library.
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
#include "motus/core/sine.hpp"

namespace motus::dynamics {

/// Lengths in those of the (upper) rod, masses in the sum of both, times in a power of two of seconds.
/// Momenta are scaled likewise.
struct SingleSystem {
    [[nodiscard]] friend bool operator==(const SingleSystem&, const SingleSystem&) = default;
    static constexpr std::size_t size = 2;  ///< angle, velocity
    double gravity = 1.0;
    double damping = 0.0;

    /// Least moment of inertia, as a fraction of that at rest; at most 1.
    [[nodiscard]] static double inertia() { return 1.0; }

    template <class Real>
    [[gnu::always_inline]] void operator()(const Real* y, Real pivot_x, Real pivot_z, Real* f) const {
        const auto [sine, cosine] = sine_cosine_within_limit(y[0]);
        f[0] = y[1];
        f[1] = Real(0.0) - ((Real(gravity) + pivot_z) * sine + pivot_x * cosine) - Real(damping) * y[1];
    }
};

/// Hamilton's equations; the second momentum in units of the lower bob's own moment of inertia. Damping takes
/// from both momenta alike, which is what c omega takes from the velocities.
struct DoubleSystem {
    [[nodiscard]] friend bool operator==(const DoubleSystem&, const DoubleSystem&) = default;
    static constexpr std::size_t size = 4;  ///< both angles, both momenta
    double gravity = 1.0;
    double damping = 0.0;
    double mass = 0.5;    ///< of the lower bob, of both; 0 to 1
    double other = 0.5;   ///< 1 - mass, with all its digits
    double length = 1.0;  ///< of the lower rod

    [[nodiscard]] double inertia() const { return other < 0.5 ? 2.0 * other : 1.0; }

    /// Both angular velocities.
    template <class Real>
    [[gnu::always_inline]] void velocities(const Real* momenta, Real sine, Real cosine, Real* out) const {
        const Real inverse = Real(1.0) / (Real(other) + Real(mass) * sine * sine);
        out[0] = (momenta[0] - Real(mass * length) * cosine * momenta[1]) * inverse;
        out[1] = (momenta[1] - Real(1.0 / length) * cosine * momenta[0]) * inverse;
    }

    template <class Real>
    [[gnu::always_inline]] void operator()(const Real* y, Real pivot_x, Real pivot_z, Real* f) const {
        const auto [sine1, cosine1] = sine_cosine_within_limit(y[0]);
        const auto [sine2, cosine2] = sine_cosine_within_limit(y[1]);
        const Real sine = sine1 * cosine2 - cosine1 * sine2;
        const Real cosine = cosine1 * cosine2 + sine1 * sine2;
        velocities(y + 2, sine, cosine, f);
        const Real coupling = f[0] * f[1] * sine;
        const Real weight = Real(gravity) + pivot_z;
        f[2] = Real(0.0) - (weight * sine1 + pivot_x * cosine1) - Real(mass * length) * coupling -
               Real(damping) * y[2];
        f[3] = (coupling - weight * sine2 - pivot_x * cosine2) * Real(1.0 / length) - Real(damping) * y[3];
    }
};

/// The double pendulum with limits: no Hamiltonian has them.
struct LimitedSystem {
    [[nodiscard]] friend bool operator==(const LimitedSystem&, const LimitedSystem&) = default;
    static constexpr std::size_t size = 4;  ///< both angles, both angular velocities
    DoubleSystem free;
    double most_acceleration = 0.0;
    double most_velocity = 0.0;

    [[nodiscard]] static double inertia() { return 1.0; }
};

inline void add_to(ContentHash& hash, const SingleSystem& system) {
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
};
[[nodiscard]] std::span<const StepKernel> step_kernels();

/// Makes small steps of Runge and Kutta's method, each brought within the limits. They always converge.
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
[[nodiscard]] inline MakeSteps<LimitedSystem> fastest_steps() {
    return &make_limited_steps;
}

}  // namespace motus::dynamics
