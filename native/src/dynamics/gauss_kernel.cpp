#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "gauss.hpp"
#include "motion.hpp"
#include "motus/core/instruction_sets.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gauss_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "motion-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::dynamics::HWY_NAMESPACE {
namespace {

using Lanes = UpTo<stages>;

template <class System>
class GaussStages {
    static constexpr std::size_t size = System::size;
    static constexpr std::size_t axes = System::axes;
    static constexpr std::size_t width = lane_count<Lanes>;
    static constexpr std::size_t count = stages / width;
    using Row = std::array<Lanes, count>;
    using Values = std::array<Lanes, size>;

  public:
    explicit GaussStages(GaussStep<System>& step) : step_(step) {
        load_drive();
        if (step.derivatives->are_known) {
            const auto& before = step.derivatives->values;
            for (std::size_t d = 0; d < size; ++d) f_[d] = product(gauss.next, before[d]);
        } else {
            Values y{};
            for (std::size_t d = 0; d < size; ++d) y[d] = Lanes((*step.state)[d]);
            for (std::size_t i = 0; i < count; ++i) {
                Values f{};
                derive(*step.system, y.data(), pivot(i).data(), f.data());
                for (std::size_t d = 0; d < size; ++d) f_[d][i] = f[d];
            }
        }
    }

    [[nodiscard]] bool is_done() const noexcept { return is_done_; }

    /// One round of the fixed-point iteration.
    void iterate() {
        using std::abs, std::max;
        std::array<Row, size> y{};
        for (std::size_t d = 0; d < size; ++d) {
            alignas(64) Stages f{};
            keep(f_[d], f);
            y[d] = product(gauss.integrals, f);
            const Lanes start((*step_.state)[d]);
            const Lanes h(step_.length);
            for (Lanes& one : y[d]) one = start + h * one;
        }
        Lanes change(0.0);
        Lanes largest(0.0);
        for (std::size_t i = 0; i < count; ++i) {
            Values at{};
            Values f{};
            for (std::size_t d = 0; d < size; ++d) at[d] = y[d][i];
            derive(*step_.system, at.data(), pivot(i).data(), f.data());
            for (std::size_t d = 0; d < size; ++d) {
                change = max(change, abs(f[d] - f_[d][i]));
                largest = max(largest, abs(f[d]));
                f_[d][i] = f[d];
            }
        }
        judge(largest_of(change), largest_of(largest));
    }

    /// Writes the state at the end of the step.
    void finish() {
        step_.converged = converged_;
        step_.tail = 0.0;
        for (std::size_t d = 0; d < size; ++d) {
            auto& f = step_.derivatives->values[d];
            keep(f_[d], f);
            // Angles, the first half, are judged as they are, what drives them by its size.
            const double scale = 2 * d < size ? 1.0 : std::max(1.0, std::abs((*step_.state)[d]));
            step_.tail = std::max(step_.tail, std::abs(step_.length * dot(gauss.tail, f)) / scale);
            if (converged_) (*step_.state)[d] += step_.length * dot(gauss.weights, f);
        }
        step_.derivatives->are_known = converged_;
    }

  private:
    using Stages = std::array<double, stages>;
    using Table = std::array<Stages, stages>;

    void load_drive() {
        for (std::size_t axis = 0; axis < axes; ++axis) {
            const double start = step_.drive.start[axis];
            const double more = step_.drive.end[axis] - start;
            alignas(64) Stages at{};
            for (std::size_t i = 0; i < stages; ++i) at[i] = start + more * gauss.nodes[i];
            drive_[axis] = row_of(at);
        }
    }

    /// Acceleration of the pivot at the stages in row i.
    [[nodiscard]] HWY_INLINE std::array<Lanes, axes> pivot(std::size_t i) const {
        std::array<Lanes, axes> at{};
        for (std::size_t axis = 0; axis < axes; ++axis) at[axis] = drive_[axis][i];
        return at;
    }

    /// Sums over j of table[j] times f[j]; in the same order whatever the number of lanes.
    [[nodiscard]] static HWY_INLINE Row product(const Table& table, const Stages& f) {
        Row sums;
        for (Lanes& sum : sums) sum = Lanes(0.0);
        for (std::size_t j = 0; j < stages; ++j) {
            const Row part = row_of(table[j]);
            const Lanes factor(f[j]);
            for (std::size_t i = 0; i < count; ++i) sums[i] = sums[i] + part[i] * factor;
        }
        return sums;
    }

    [[nodiscard]] static HWY_INLINE Row row_of(const Stages& values) {
        Row row{};
        for (std::size_t i = 0; i < count; ++i) load(values.data() + i * width, row[i]);
        return row;
    }
    static HWY_INLINE void keep(const Row& row, Stages& values) {
        for (std::size_t i = 0; i < count; ++i) store(row[i], values.data() + i * width);
    }

    [[nodiscard]] static double dot(const Stages& a, const Stages& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < stages; ++i) sum += a[i] * b[i];
        return sum;
    }

    [[nodiscard]] static HWY_INLINE double largest_of(Lanes lanes) {
        double largest = lane(lanes, 0);
        for (int i = 1; i < static_cast<int>(width); ++i) largest = std::max(largest, lane(lanes, i));
        return largest;
    }

    /// Judges by largest differences, which, unlike sums, do not depend on the number of lanes.
    void judge(double change, double largest) {
        constexpr double rounding = 1e-15;
        constexpr int most = 24;
        const double goal = rounding * largest + 1e-300;
        // The next round is expected to change the result by the same factor less than this one as this one
        // did than the last.
        const bool has_last = rounds_ > 0;
        const bool is_small = change <= goal || (has_last && change * change <= goal * last_change_);
        const bool has_stopped = has_last && change >= last_change_ && change <= 1e3 * goal;
        converged_ = is_small || has_stopped;
        ++rounds_;
        is_done_ = converged_ || rounds_ >= most || !(largest < 1e290);
        last_change_ = change;
    }

    std::array<Row, size> f_{};
    std::array<Row, axes> drive_{};
    GaussStep<System>& step_;
    double last_change_ = 0.0;
    int rounds_ = 0;
    bool converged_ = false;
    bool is_done_ = false;
};

template <class System>
void make_gauss_steps(std::span<GaussStep<System>> steps) {
    for (std::size_t i = 0; i < steps.size(); i += steps_at_once) {
        GaussStages<System> one(steps[i]);
        if (i + 1 < steps.size()) {
            GaussStages<System> other(steps[i + 1]);
            while (!one.is_done() && !other.is_done()) {
                one.iterate();
                other.iterate();
            }
            while (!other.is_done()) other.iterate();
            other.finish();
        }
        while (!one.is_done()) one.iterate();
        one.finish();
    }
}

constexpr StepKernel kernel{HWY_STR(HWY_NAMESPACE), &make_gauss_steps<SingleSystem>,
                            &make_gauss_steps<DoubleSystem>, &make_gauss_steps<SphericalSystem>};

}  // namespace
}  // namespace motus::dynamics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::dynamics {

std::span<const StepKernel> step_kernels() {
    static const Kernels<StepKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

}  // namespace motus::dynamics
#endif
