#include "motus/dynamics/track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "samples.hpp"

namespace motus::dynamics {
namespace {

/// The state (offset, velocity) that a cycle reproduces, if the cycle turns a state of zero into `end`, and
/// multiplies other states by the matrix of `cycle`: the solution of (1 - M) s = end.
[[nodiscard]] std::array<double, 2> repeated(const Step& cycle, double offset, double velocity) {
    const double a = 1.0 - cycle.ee, b = -cycle.eu, c = -cycle.ue, d = 1.0 - cycle.uu;
    const double determinant = a * d - b * c;
    return {(d * offset - b * velocity) / determinant, (a * velocity - c * offset) / determinant};
}

/// Whether without an input a cycle reproduces every state of the filter, so that no single state is the one
/// to repeat.
[[nodiscard]] bool is_resonant(const Step& cycle) {
    const double determinant = (1.0 - cycle.ee) * (1.0 - cycle.uu) - cycle.eu * cycle.ue;
    constexpr double lost = 1e-12;  // the closing would have no digits left
    return std::abs(determinant) < lost;
}

constexpr double farthest = 1e308;  // to which a loop takes an input: the offset may be added to it

}  // namespace

Track::Track(const SecondOrder& filter, std::span<const double> times, std::span<const double> inputs,
             std::size_t dimensions, std::span<const std::size_t> resets, Start start)
    : filter_(filter), dimensions_(dimensions), is_loop_(start == Start::loop) {
    require_samples(filter, times, inputs, dimensions);
    require_start(times, resets, start);
    times_.assign(times.begin(), times.end());
    inputs_.assign(inputs.begin(), inputs.end());
    resets_.assign(resets.begin(), resets.end());
    states_.resize(2 * inputs.size());
    run();
    if (is_loop_) close_loop();
}

void Track::run() {
    Steps steps(filter_);
    auto reset = resets_.begin();
    if (reset != resets_.end() && *reset == 0) ++reset;
    for (std::size_t k = 1; k < times_.size(); ++k) {
        if (reset != resets_.end() && *reset == k) {
            std::fill_n(state(k), 2 * dimensions_, 0.0);
            ++reset;
            continue;
        }
        const Step& step = steps.between(times_[k - 1], times_[k]);
        const double scale = 1.0 / step.length;
        const double* before = state(k - 1);
        double* now = state(k);
        const double* x = inputs_.data() + (k - 1) * dimensions_;
        for (std::size_t i = 0; i < dimensions_; ++i) {
            double offset = before[i];
            double velocity = before[dimensions_ + i];
            advance(step, (x[dimensions_ + i] - x[i]) * scale, offset, velocity);
            now[i] = offset;
            now[dimensions_ + i] = velocity;
        }
    }
}

void Track::close_loop() {
    const Step cycle = make_step(filter_, times_.back() - times_.front());
    require(!is_resonant(cycle),
            "damping: must be greater than 0 where the cycle is a whole number of periods long");
    const double* end = state(times_.size() - 1);
    double* first = state(0);
    for (std::size_t i = 0; i < dimensions_; ++i) {
        const auto [offset, velocity] = repeated(cycle, end[i], end[dimensions_ + i]);
        first[i] = offset;
        first[dimensions_ + i] = velocity;
    }
    run();
}

void Track::evaluate(double time, std::span<double> out) const {
    evaluate(time, out, {});
}

template <class Visit>
void Track::at(double time, const Visit& visit) const {
    require_time(time, times_);
    const Place place = place_of(time, times_, is_loop_);
    const std::size_t last = times_.size() - 1;
    const std::size_t next = place.sample + 1;
    const bool rests = place.sample == last || std::ranges::binary_search(resets_, next);
    const double scale = rests ? 0.0 : 1.0 / (times_[next] - times_[place.sample]);
    const Step step = make_step(filter_, place.seconds);
    const double* x = inputs_.data() + place.sample * dimensions_;
    const double* from = state(place.sample);
    for (std::size_t i = 0; i < dimensions_; ++i) {
        const double slope = rests ? 0.0 : (x[dimensions_ + i] - x[i]) * scale;
        double offset = from[i];
        double speed = from[dimensions_ + i];
        if (place.seconds > 0.0) advance(step, slope, offset, speed);
        double input = x[i] + slope * place.seconds;
        if (is_loop_) {
            const double gained = place.cycles * (inputs_[last * dimensions_ + i] - inputs_[i]);
            input = std::clamp(input + gained, -farthest, farthest);
        }
        visit(i, input, offset, speed);
    }
}

void Track::evaluate(double time, std::span<double> out, std::span<double> velocity) const {
    require(out.size() == dimensions_, "out: must have a value for each dimension");
    require(velocity.empty() || velocity.size() == dimensions_,
            "velocity: must have a value for each dimension");
    at(time, [&](std::size_t i, double input, double offset, double speed) {
        out[i] = input + offset;
        if (!velocity.empty()) velocity[i] = speed;
    });
}

void Track::offset(double time, std::span<double> out) const {
    require(out.size() == dimensions_, "out: must have a value for each dimension");
    at(time, [&](std::size_t i, double, double offset, double) { out[i] = offset; });
}

void Track::outputs(std::span<double> out) const {
    require(out.size() == inputs_.size(), "out: must have a value for each input");
    for (std::size_t k = 0; k < times_.size(); ++k) {
        for (std::size_t i = 0; i < dimensions_; ++i)
            out[k * dimensions_ + i] = inputs_[k * dimensions_ + i] + state(k)[i];
    }
}

std::size_t Track::bytes() const noexcept {
    return (times_.capacity() + inputs_.capacity() + states_.capacity()) * sizeof(double) +
           resets_.capacity() * sizeof(std::size_t);
}

void second_order(const SecondOrder& filter, std::span<const double> times, std::span<const double> inputs,
                  std::size_t dimensions, std::span<double> out) {
    require_samples(filter, times, inputs, dimensions);
    require(out.size() == inputs.size(), "out: must have the size of inputs");
    constexpr std::size_t together = 8;  // dimensions
    for (std::size_t first = 0; first < dimensions; first += together) {
        const std::size_t count = std::min(together, dimensions - first);
        std::array<double, together> x{}, offset{}, velocity{};
        std::copy_n(inputs.data() + first, count, x.begin());
        std::copy_n(x.begin(), count, out.data() + first);
        Steps steps(filter);
        for (std::size_t k = 1; k < times.size(); ++k) {
            const Step& step = steps.between(times[k - 1], times[k]);
            const double scale = 1.0 / step.length;
            const std::size_t row = k * dimensions + first;
            for (std::size_t i = 0; i < count; ++i) {
                const double next = inputs[row + i];
                advance(step, (next - x[i]) * scale, offset[i], velocity[i]);
                x[i] = next;
                out[row + i] = next + offset[i];
            }
        }
    }
}

}  // namespace motus::dynamics
