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

inline void require_times(std::span<const double> times) {
    require(!times.empty(), "times: must have at least one sample");
    require(are_finite(times), "times: must be finite");
    require(std::ranges::adjacent_find(times, std::ranges::greater_equal{}) == times.end(),
            "times: must strictly rise");
    require(std::isfinite(times.back() - times.front()), "times: must be finite, their range too");
}

inline void require_time(double time, std::span<const double> times) {
    require(std::isfinite(time), "time: must be finite");
    require(!times.empty(), "times: must have at least one sample: the track was moved from");
}

/// Of a filter whose inputs change by at most `slope` a second: whether outputs stay finite, roughly. Each
/// sample adds at most this to the pair (e, u) of Step, and no step makes the pair larger than the filter's
/// rate does, whatever its damping.
inline void require_bounded(const SecondOrder& filter, std::span<const double> times, double slope,
                            double input) {
    const double rate = filter.rate();
    const double lag = std::abs(filter.lead() - filter.coefficients().k1);
    const double scale = (1.0 + rate) * (1.0 + 1.0 / rate);
    const double added = slope * (1.0 + lag) * scale * scale * static_cast<double>(times.size());
    require(std::isfinite(added + input) && added < 1e300 && input < 1e300,
            "inputs: must be smaller, or change more slowly, for such a filter");
}

/// The largest change a second, and the largest number.
[[nodiscard]] inline std::array<double, 2> largest_of(std::span<const double> times,
                                                      std::span<const double> inputs,
                                                      std::size_t dimensions) {
    double slope = 0.0, input = 0.0;
    for (const double x : inputs) input = std::max(input, std::abs(x));
    for (std::size_t k = 1; k < times.size(); ++k) {
        double change = 0.0;
        for (std::size_t i = 0; i < dimensions; ++i)
            change =
                std::max(change, std::abs(inputs[k * dimensions + i] - inputs[(k - 1) * dimensions + i]));
        slope = std::max(slope, change / (times[k] - times[k - 1]));
    }
    return {slope, input};
}

inline void require_samples(const SecondOrder& filter, std::span<const double> times,
                            std::span<const double> inputs, std::size_t dimensions) {
    require_times(times);
    require(dimensions > 0, "dimensions: must be greater than 0");
    require(inputs.size() / dimensions == times.size() && inputs.size() % dimensions == 0,
            "inputs: must have a row for each time");
    require(are_finite(inputs), "inputs: must be finite");
    const auto [slope, input] = largest_of(times, inputs, dimensions);
    require_bounded(filter, times, slope, input);
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
