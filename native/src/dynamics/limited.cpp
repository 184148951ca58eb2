#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "motion-inl.hpp"

namespace motus::dynamics {
namespace {

constexpr int substeps = 16;  // of a step, where that is accurate enough
/// Largest difference between two substeps and one of their length: of angles, rad, and of angular velocities
/// as a part of their size. The error of the two is a fifteenth of it while no limit is met within them.
constexpr double largest_difference = 1e-9;
/// Largest product of damping and the length of two substeps: beyond 2.8 Runge and Kutta's method lets a
/// velocity grow that damping takes away.
constexpr double most_damped = 2.0;
constexpr int most_pairs = 16 * substeps / 2;  // that a step tries; a longer one is made as several steps
constexpr double least_width = 0x1p-20;        // of a pair, in substeps
using State = std::array<double, LimitedSystem::size>;

/// Brings angular velocities within the limit.
void limit(const LimitedSystem& system, State& state) {
    for (std::size_t d = 2; d < state.size(); ++d)
        state[d] = std::clamp(state[d], -system.most_velocity, system.most_velocity);
}

/// Angular velocities and accelerations, both within the limits.
[[nodiscard]] State derivative(const LimitedSystem& system, State at, double pivot_x, double pivot_z) {
    limit(system, at);
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

/// A step in pairs of substeps, which are halved as long as they are not accurate: where damping is strong,
/// and where a limit is met, at which Runge and Kutta's method has no order.
class LimitedStep {
  public:
    explicit LimitedStep(const GaussStep<LimitedSystem>& step)
        : step_(step), system_(*step.system), substep_(step.length / substeps), state_(*step.state) {}

    /// Whether the step was made by as many pairs as it may take.
    [[nodiscard]] bool run() {
        for (int i = 0; i < substeps; i += 2)
            if (!advance(i, 2.0)) return false;
        return true;
    }

    [[nodiscard]] const State& state() const noexcept { return state_; }
    [[nodiscard]] int pairs() const noexcept { return pairs_; }

  private:
    [[nodiscard]] double pivot(std::size_t axis, double at) const {
        return step_.drive.start[axis] + (step_.drive.end[axis] - step_.drive.start[axis]) * (at / substeps);
    }
    [[nodiscard]] State slope(const State& at, double when) const {
        return derivative(system_, at, pivot(0, when), pivot(1, when));
    }

    /// One substep; k1: the slope at its start. Times and widths are in substeps.
    [[nodiscard]] State substep(const State& from, const State& k1, double start, double width) const {
        const double h = substep_ * width, middle = start + 0.5 * width;
        const State k2 = slope(moved(from, k1, 0.5 * h), middle);
        const State k3 = slope(moved(from, k2, 0.5 * h), middle);
        const State k4 = slope(moved(from, k3, h), start + width);
        State y = from;
        for (std::size_t d = 0; d < y.size(); ++d) y[d] += h / 6.0 * (k1[d] + 2.0 * (k2[d] + k3[d]) + k4[d]);
        limit(system_, y);
        return y;
    }

    /// Moves the state on by a pair of substeps that together have a width, or by the two pairs of its
    /// halves.
    [[nodiscard]] bool advance(double start, double width) {
        const double half = 0.5 * width;
        if (std::abs(substep_ * width) * system_.free.damping <= most_damped) {
            if (++pairs_ > most_pairs) return false;
            const State first = slope(state_, start);
            const State between = substep(state_, first, start, half);
            const State end = substep(between, slope(between, start + half), start + half, half);
            if (are_close(end, substep(state_, first, start, width))) {
                state_ = end;
                return true;
            }
        }
        return width > least_width && advance(start, half) && advance(start + half, half);
    }

    [[nodiscard]] static bool are_close(const State& fine, const State& coarse) {
        for (std::size_t d = 0; d < fine.size(); ++d) {
            const double scale = d < 2 ? 1.0 : std::max(1.0, std::abs(fine[d]));
            if (!(std::abs(fine[d] - coarse[d]) <= largest_difference * scale)) return false;
        }
        return true;
    }

    const GaussStep<LimitedSystem>& step_;
    const LimitedSystem& system_;
    double substep_;
    State state_;
    int pairs_ = 0;
};

}  // namespace

void make_limited_steps(std::span<GaussStep<LimitedSystem>> steps) {
    for (GaussStep<LimitedSystem>& step : steps) {
        LimitedStep made(step);
        step.converged = made.run();
        if (step.converged) *step.state = made.state();
        step.tail = 0.0;  // the pairs have been judged
        step.work = 1 + static_cast<std::size_t>(2 * made.pairs() / substeps);
    }
}

}  // namespace motus::dynamics
