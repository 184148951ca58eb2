#include "motus/snow/births.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motus/core/numeric.hpp"

namespace motus::snow {
namespace {

[[nodiscard]] bool is_not_negative(double value) {
    return std::isfinite(value) && value >= 0.0;
}

/// The first number in [0, count) for which `later` holds, count where there is none; it holds for all that
/// follow.
template <class Later>
[[nodiscard]] std::uint64_t first_where(std::uint64_t count, const Later& later) {
    std::uint64_t first = 0;
    while (count > 0) {
        const std::uint64_t half = count / 2;
        if (later(first + half)) {
            count = half;
        } else {
            first += half + 1;
            count -= half + 1;
        }
    }
    return first;
}

/// Flakes of a stream and of bursts before the first of each for which `later` holds of the time of birth.
template <class Later>
[[nodiscard]] std::uint64_t count_until(const Births& births, std::uint64_t stream, const Later& later) {
    std::uint64_t count = first_where(stream, [&](std::uint64_t j) { return later(births.streamed(j)); });
    for (const Births::Piece& piece : births.pieces())
        if (piece.is_burst && !later(piece.burst)) count += piece.last - piece.first;
    return count;
}

}  // namespace

Births::Births(double rate, double delay, double duration, bool looping, std::vector<Burst> bursts,
               const RateKeys& keys)
    : rate_(rate), delay_(delay) {
    require(is_not_negative(rate), "rate: must be at least 0 and finite");
    require(is_not_negative(delay), "delay: must be at least 0 and finite");
    require(is_not_negative(duration), "duration: must be at least 0 and finite");
    std::uint64_t in_bursts = 0;
    for (const Burst& burst : bursts) {
        require(is_not_negative(burst.time), "bursts: must have times of at least 0");
        require(burst.count <= most_ids - in_bursts, "bursts: must hold fewer flakes");
        in_bursts += burst.count;
    }
    std::ranges::stable_sort(bursts, {}, &Burst::time);
    set_keys(keys);

    std::uint64_t most = rate > 0.0 || has_keys() ? most_ids - in_bursts : 0;
    // Flakes that the keys let be born at no time have no numbers.
    if (has_keys()) most = first_where(most, [&](std::uint64_t j) { return !std::isfinite(keyed(j)); });
    const double end = delay + duration;
    stream_ = looping ? most : first_where(most, [&](std::uint64_t j) { return this->streamed(j) > end; });

    Piece piece;
    const auto add = [&](std::uint64_t count) {
        piece.first = piece.last;
        piece.last += count;
        if (count > 0) pieces_.push_back(piece);
    };
    for (const Burst& burst : bursts) {
        const double time = delay + burst.time;
        const std::uint64_t until =
            first_where(stream_, [&](std::uint64_t j) { return this->streamed(j) > time; });
        piece.is_burst = false;
        add(until - piece.streamed);
        piece.streamed = until;
        piece.is_burst = true;
        piece.burst = time;
        add(burst.count);
    }
    piece.is_burst = false;
    add(stream_ - piece.streamed);
}

std::uint64_t Births::count(double time) const {
    return count_until(*this, stream_, [&](double birth) { return birth > time; });
}

std::uint64_t Births::count_older(double time, double age) const {
    return count_until(*this, stream_, [&](double birth) { return time - birth < age; });
}

void Births::set_keys(const RateKeys& keys) {
    require(keys.values.size() == keys.times.size(), "rate_values: must be as many as rate_times");
    require(are_finite(keys.times), "rate_times: must be finite");
    require(std::ranges::adjacent_find(keys.times, std::ranges::greater_equal{}) == keys.times.end(),
            "rate_times: must rise");
    require(std::ranges::all_of(keys.values, is_not_negative), "rate_values: must be at least 0 and finite");
    if (keys.times.empty()) return;
    // What is before the delay lets nothing be born.
    const auto add = [&](double start, double end, double from, double to) {
        Ramp ramp{start, from, std::isfinite(end) ? (to - from) / (end - start) : 0.0, end - start};
        require(std::isfinite(ramp.slope), "rate_times: must lie farther apart for rates so different");
        if (!ramps_.empty()) {
            const Ramp& last = ramps_.back();
            ramp.before = last.before + last.length * (last.rate + 0.5 * last.slope * last.length);
        }
        ramps_.push_back(ramp);
    };
    const auto &times = keys.times, &values = keys.values;
    if (delay_ < times.front()) add(delay_, times.front(), values.front(), values.front());
    for (std::size_t i = 1; i < times.size(); ++i) {
        if (times[i] <= delay_) continue;
        const double start = std::max(delay_, times[i - 1]);
        const double part = (start - times[i - 1]) / (times[i] - times[i - 1]);
        add(start, times[i], values[i - 1] + part * (values[i] - values[i - 1]), values[i]);
    }
    add(std::max(delay_, times.back()), std::numeric_limits<double>::infinity(), values.back(),
        values.back());
}

double Births::Ramp::reaches(double integral) const noexcept {
    const double left = integral - before;
    if (!(left > 0.0)) return start;
    // The root of rate x + slope x^2 / 2 = left, without a difference of what is alike.
    const double root = std::sqrt(std::max(0.0, rate * rate + 2.0 * slope * left));
    return start + std::min(2.0 * left / (rate + root), length);
}

std::size_t Births::ramp_of(double integral) const noexcept {
    const auto next = std::ranges::lower_bound(ramps_, integral, {}, &Ramp::before);
    return next == ramps_.begin() ? 0 : static_cast<std::size_t>(next - ramps_.begin()) - 1;
}

double Births::keyed(std::uint64_t j) const noexcept {
    const auto integral = static_cast<double>(j + 1);
    return ramps_[ramp_of(integral)].reaches(integral);
}

void Births::streamed(std::uint64_t j, std::span<double> out) const noexcept {
    if (!has_keys()) {
        for (double& birth : out) birth = streamed(j++);
        return;
    }
    std::size_t at = ramp_of(static_cast<double>(j + 1));
    for (double& birth : out) {
        const auto integral = static_cast<double>(++j);
        while (at + 1 < ramps_.size() && ramps_[at + 1].before < integral) ++at;
        birth = ramps_[at].reaches(integral);
    }
}

double Births::integral_until(double time) const noexcept {
    if (time <= delay_) return 0.0;
    const auto next = std::ranges::upper_bound(ramps_, time, {}, &Ramp::start);
    const Ramp& ramp = next == ramps_.begin() ? ramps_.front() : *(next - 1);
    const double since = time - ramp.start;
    return ramp.before + since * (ramp.rate + 0.5 * ramp.slope * since);
}

double Births::most_within(double length) const {
    double most = std::min(rate_ * length + 1.0, static_cast<double>(stream_));
    if (has_keys()) {
        // What begins within a ramp is over a length after its end; and no rate is higher than the highest.
        const double within = std::min(length, 1e300);
        double highest = 0.0, begun = 0.0;
        for (const Ramp& ramp : ramps_) {
            const double end = std::isfinite(ramp.length) ? ramp.start + ramp.length : ramp.start;
            highest = std::max({highest, ramp.rate, ramp.rate + ramp.slope * (end - ramp.start)});
            begun = std::max(begun, integral_until(end + within) - ramp.before);
        }
        most = std::min({begun + 1.0, highest * within + 1.0, static_cast<double>(stream_)});
    }
    for (const Piece& piece : pieces_)
        if (piece.is_burst) most += static_cast<double>(piece.last - piece.first);
    return most;
}

}  // namespace motus::snow
