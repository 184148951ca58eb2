// Functions that tracks of numbers and of rotations share. Private to the library.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>

#include "motus/core/numeric.hpp"
#include "motus/dynamics/second_order.hpp"
#include "motus/dynamics/track.hpp"

namespace motus::dynamics {

/// What an array is checked for is found for so many of its numbers at once, of which none waits for another.
inline constexpr std::size_t checked_at_once = 4;

/// Throws if times are not those of samples; returns the shortest time between two, or infinity.
inline double require_times(std::span<const double> times) {
    require(!times.empty(), "times: must have at least one sample");
    std::array<double, checked_at_once> shortest{};
    shortest.fill(std::numeric_limits<double>::infinity());
    bool rise = true;
    const auto look = [&](std::size_t k, double& least) {
        const double length = times[k + 1] - times[k];
        rise &= length > 0.0;
        least = length < least ? length : least;
    };
    std::size_t k = 0;
    for (; k + checked_at_once < times.size(); k += checked_at_once)
        for (std::size_t i = 0; i < checked_at_once; ++i) look(k + i, shortest[i]);
    for (; k + 1 < times.size(); ++k) look(k, shortest[0]);
    if (!rise || !are_finite(times.front(), times.back())) {
        require(are_finite(times), "times: must be finite");
        require(std::ranges::adjacent_find(times, std::ranges::greater_equal{}) == times.end(),
                "times: must strictly rise");
    }
    require(std::isfinite(times.back() - times.front()), "times: must be finite, their range too");
    return *std::ranges::min_element(shortest);
}

inline void require_time(double time, std::span<const double> times) {
    require(std::isfinite(time), "time: must be finite");
    require(!times.empty(), "times: must have at least one sample: the track was moved from");
}

/// Of a filter whose inputs change by at most `slope` a second: whether outputs stay finite, roughly. Each
/// sample adds at most this to the pair (e, u) of Step, and no step makes the pair larger than the filter's
/// rate does, whatever its damping.
[[nodiscard]] inline bool is_bounded(const SecondOrder& filter, std::size_t samples, double slope,
                                     double input) {
    const double rate = filter.rate();
    const double lag = std::abs(filter.lead() - filter.coefficients().k1);
    const double scale = (1.0 + rate) * (1.0 + 1.0 / rate);
    const double added = slope * (1.0 + lag) * scale * scale * static_cast<double>(samples);
    return std::isfinite(added + input) && added < 1e300 && input < 1e300;
}

inline void require_bounded(const SecondOrder& filter, std::span<const double> times, double slope,
                            double input) {
    require(is_bounded(filter, times.size(), slope, input),
            "inputs: must be smaller, or change more slowly, for such a filter");
}

/// The largest size of a number; NaN or infinity if one is not finite.
[[nodiscard]] inline double largest_of(std::span<const double> numbers) {
    std::array<double, checked_at_once> largest{}, nothing{};
    const auto look = [](double number, double& most, double& none) {
        none += 0.0 * number;  // NaN if the number is not finite
        most = std::abs(number) > most ? std::abs(number) : most;
    };
    std::size_t k = 0;
    for (; k + checked_at_once <= numbers.size(); k += checked_at_once)
        for (std::size_t i = 0; i < checked_at_once; ++i) look(numbers[k + i], largest[i], nothing[i]);
    for (; k < numbers.size(); ++k) look(numbers[k], largest[0], nothing[0]);
    double all = 0.0;
    for (const double none : nothing) all += none;
    return *std::ranges::max_element(largest) + all;
}

/// The largest change a second.
[[nodiscard]] inline double steepest_of(std::span<const double> times, std::span<const double> inputs,
                                        std::size_t dimensions) {
    double slope = 0.0;
    for (std::size_t k = 1; k < times.size(); ++k) {
        double change = 0.0;
        for (std::size_t i = 0; i < dimensions; ++i)
            change =
                std::max(change, std::abs(inputs[k * dimensions + i] - inputs[(k - 1) * dimensions + i]));
        slope = std::max(slope, change / (times[k] - times[k - 1]));
    }
    return slope;
}

inline void require_samples(const SecondOrder& filter, std::span<const double> times,
                            std::span<const double> inputs, std::size_t dimensions) {
    const double shortest = require_times(times);
    require(dimensions > 0, "dimensions: must be greater than 0");
    require(inputs.size() / dimensions == times.size() && inputs.size() % dimensions == 0,
            "inputs: must have a row for each time");
    const double largest = largest_of(inputs);
    require(std::isfinite(largest), "inputs: must be finite");
    // No slope is as large as this one, which is found sooner.
    if (!is_bounded(filter, times.size(), 2.0 * largest / shortest, largest))
        require_bounded(filter, times, steepest_of(times, inputs, dimensions), largest);
}

inline void require_start(std::span<const double> times, std::span<const std::size_t> resets, Start start) {
    require(std::ranges::adjacent_find(resets, std::ranges::greater_equal{}) == resets.end() &&
                (resets.empty() || resets.back() < times.size()),
            "resets: must rise and be indices of samples");
    if (start == Start::loop) {
        require(resets.empty(), "resets: must be empty in a loop");
        require(times.size() > 1, "times: must have at least two samples in a loop");
    }
}

/// Steps of one filter. The last one is kept: most samples lie equally far apart.
class Steps {
  public:
    explicit Steps(const SecondOrder& filter) : filter_(filter) {}

    /// From `first` to `last`. Lengths that differ by no more than the rounding of such times are one.
    [[nodiscard]] const Step& between(double first, double last) {
        const double length = last - first;
        const double rounding =
            2.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(first), std::abs(last));
        if (!(std::abs(length - step_.length) <= rounding)) step_ = make_step(filter_, length);
        return step_;
    }

  private:
    const SecondOrder& filter_;
    Step step_{.length = std::numeric_limits<double>::quiet_NaN()};
};

/// One step of a dimension, whose input has the given slope: offset is the output less the input.
template <class Value>
inline void advance(const Step& step, const Value& slope, Value& offset, Value& velocity) {
    const Value lag = step.lag * slope;
    const Value e = offset - lag;
    const Value u = velocity - slope;
    offset = (step.ee * e + step.eu * u) + lag;
    velocity = (step.ue * e + step.uu * u) + slope;
}

/// Where a time lies among samples: in the interval that begins at `sample`, `seconds` after it. cycles: how
/// many whole ones come before, in a loop.
struct Place {
    std::size_t sample = 0;
    double seconds = 0.0;
    double cycles = 0.0;
};

/// The last sample whose time is not after the given one, and the first if there is none. Samples mostly
/// come evenly: they are looked at first where they then would be, since a search has to wait for memory at
/// each step.
[[nodiscard]] inline std::size_t sample_before(double time, std::span<const double> times) {
    const double share = (time - times.front()) / (times.back() - times.front());
    const double last = static_cast<double>(times.size() - 1);
    if (share > 0.0 && share < 1.0) {
        const auto near = static_cast<std::size_t>(share * last);
        for (const std::size_t sample : {near, near + 1, std::max<std::size_t>(near, 1) - 1}) {
            if (sample + 1 < times.size() && times[sample] <= time && time < times[sample + 1]) return sample;
        }
    }
    const auto after = std::ranges::upper_bound(times, time);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - times.begin() - 1, 0));
}

[[nodiscard]] inline Place place_of(double time, std::span<const double> times, bool is_loop) {
    Place place;
    if (is_loop) {
        const double cycle = times.back() - times.front();
        constexpr double most = std::numeric_limits<double>::max();  // of short cycles there are more
        place.cycles = std::floor(std::clamp((time - times.front()) / cycle, -most, most));
        time = std::clamp(time - place.cycles * cycle, times.front(), times.back());
    }
    place.sample = sample_before(time, times);
    place.seconds = std::clamp(time - times[place.sample], 0.0, std::numeric_limits<double>::max());
    return place;
}

}  // namespace motus::dynamics
