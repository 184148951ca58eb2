#include "motus/snow/births.hpp"

#include <algorithm>
#include <cmath>
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

Births::Births(double rate, double delay, double duration, bool looping, std::vector<Burst> bursts)
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

    const std::uint64_t most = rate > 0.0 ? most_ids - in_bursts : 0;
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

double Births::most_within(double length) const {
    double most = std::min(rate_ * length + 1.0, static_cast<double>(stream_));
    for (const Piece& piece : pieces_)
        if (piece.is_burst) most += static_cast<double>(piece.last - piece.first);
    return most;
}

}  // namespace motus::snow
