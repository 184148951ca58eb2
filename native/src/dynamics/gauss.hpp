// Gauss's collocation method with eight stages, of order 16: symplectic, and exact for polynomials of degree
// 15. Hairer, Lubich, Wanner, "Geometric Numerical Integration" (2nd ed., 2006), II.1 and VIII.6.
// Private to the library. gauss_kernel.cpp computes the stages of a step side by side.
#pragma once
#include <array>
#include <cstddef>

#include "gauss_table.hpp"

namespace motus::dynamics {

/// Acceleration of the pivot, along each of the axes, at the start and at the end of a step; linear between.
template <std::size_t axes>
struct Drive {
    std::array<double, axes> start{};
    std::array<double, axes> end{};
};

/// The derivatives at a step's stages, from which the next step of the same length can begin.
template <std::size_t size>
struct Derivatives {
    alignas(64) std::array<std::array<double, stages>, size> values{};
    bool are_known = false;
};

/// A step to be made. On return `state` is that at its end if `converged`, else as it was.
template <class System>
struct GaussStep {
    const System* system = nullptr;
    std::array<double, System::size>* state = nullptr;
    Derivatives<System::size>* derivatives = nullptr;
    double length = 0.0;
    Drive<System::axes> drive;
    bool converged = false;
    double tail = 0.0;     ///< relative size of the last coefficient of the step's polynomials: the error is
                           ///< some tenth of its square
    std::size_t work = 1;  ///< how many steps of the usual work it has taken
};

/// How many steps are made at a time: one computes while the other waits for its results.
inline constexpr std::size_t steps_at_once = 2;

}  // namespace motus::dynamics
