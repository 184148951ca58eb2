#include <algorithm>
#include <array>
#include <cstddef>

#include "motion-inl.hpp"

namespace motus::dynamics {
namespace {

constexpr int substeps = 16;  // of an interval
using State = std::array<double, LimitedSystem::size>;

/// Angular velocities and accelerations, the latter within the limits.
[[nodiscard]] State derivative(const LimitedSystem& system, const State& at, double pivot_x, double pivot_z) {
    const DoubleSystem& free = system.free;
    const auto [sine1, cosine1] = HWY_NAMESPACE::sine_cosine_within_limit(at[0]);
    const auto [sine2, cosine2] = HWY_NAMESPACE::sine_cosine_within_limit(at[1]);
    const double sine = sine1 * cosine2 - cosine1 * sine2;
    const double cosine = cosine1 * cosine2 + sine1 * sine2;
    const double weight = free.gravity + pivot_z;
    const double m = free.mass * free.length;
    // Torques, in the units of the momenta; the accelerations follow from them as velocities do from momenta.
    const std::array<double, 2> torques{
        -(weight * sine1 + pivot_x * cosine1) - m * at[3] * at[3] * sine,
        (at[2] * at[2] * sine - weight * sine2 - pivot_x * cosine2) / free.length};
    std::array<double, 2> accelerations{};
    HWY_NAMESPACE::velocities(free, torques.data(), sine, cosine, accelerations.data());
    const double most = system.most_acceleration;
    return {at[2], at[3], std::clamp(accelerations[0] - free.damping * at[2], -most, most),
            std::clamp(accelerations[1] - free.damping * at[3], -most, most)};
}

[[nodiscard]] State moved(const State& from, const State& slope, double by) {
    State state = from;
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += slope[i] * by;
    return state;
}

void make_step(const GaussStep<LimitedSystem>& step) {
    const LimitedSystem& system = *step.system;
    State& y = *step.state;
    const double h = step.length / substeps;
    const auto pivot = [&](std::size_t axis, double at) {
        return step.drive.start[axis] + (step.drive.end[axis] - step.drive.start[axis]) * (at / substeps);
    };
    for (int i = 0; i < substeps; ++i) {
        const auto slope = [&](const State& at, double when) {
            return derivative(system, at, pivot(0, when), pivot(1, when));
        };
        const State k1 = slope(y, i);
        const State k2 = slope(moved(y, k1, 0.5 * h), i + 0.5);
        const State k3 = slope(moved(y, k2, 0.5 * h), i + 0.5);
        const State k4 = slope(moved(y, k3, h), i + 1);
        for (std::size_t d = 0; d < y.size(); ++d) y[d] += h / 6.0 * (k1[d] + 2.0 * (k2[d] + k3[d]) + k4[d]);
        for (std::size_t d = 2; d < y.size(); ++d)
            y[d] = std::clamp(y[d], -system.most_velocity, system.most_velocity);
    }
}

}  // namespace

void make_limited_steps(std::span<GaussStep<LimitedSystem>> steps) {
    for (GaussStep<LimitedSystem>& step : steps) {
        make_step(step);
        step.converged = true;
        step.tail = 0.0;
    }
}

}  // namespace motus::dynamics
