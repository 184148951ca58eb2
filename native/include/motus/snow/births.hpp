// When flakes are born (emission): a steady stream and bursts, numbered in the order of birth.
//
// Costs: O(bursts + keys) to make, which allocates it; O(bursts), or O(log) of bursts and keys, to ask, which
// allocates nothing. Immutable: any number of threads may share one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace motus::snow {

/// Many flakes at once.
struct Burst {
    double time = 0.0;        ///< s after the delay, >= 0
    std::uint64_t count = 0;  ///< flakes
};

/// A rate that changes: from each of the times, s, to the next it goes evenly from each value, flakes a
/// second, to the next, by less than double precision holds a second. It is held before the first and after
/// the last.
struct RateKeys {
    std::vector<double> times;   ///< strictly rising, finite
    std::vector<double> values;  ///< one for each time, >= 0, finite
};

/// Flake j of the stream is born at delay + (j + 1) / rate, the first at j = 0; with keys, at the time until
/// which the integral of the rate from the delay on is j + 1. Bursts come once. What is born at the same
/// moment is numbered stream first. At most `most_ids` flakes are ever born.
class Births {
  public:
    static constexpr std::uint64_t most_ids = std::uint64_t{1} << 53U;  ///< doubles count no further

    /// rate: flakes a second, >= 0. delay: s, >= 0. duration: s, >= 0; the stream ends then, unless it is
    /// `looping`. Throws std::invalid_argument, naming the argument, where one is not finite or outside its
    /// domain, or bursts hold more than most_ids flakes. keys: take the place of the rate, unless they are
    /// empty.
    Births(double rate, double delay, double duration, bool looping, std::vector<Burst> bursts,
           const RateKeys& keys = {});

    /// Flakes born at `time` or before: those with the numbers 0 to count - 1.
    [[nodiscard]] std::uint64_t count(double time) const;

    /// Those of them whose age, time - birth, is `age` or more.
    [[nodiscard]] std::uint64_t count_older(double time, double age) const;

    /// Flakes with successive numbers that are born in a burst, all at once, or as a part of the stream.
    struct Piece {
        std::uint64_t first = 0;     ///< number of its first flake
        std::uint64_t last = 0;      ///< number after its last one
        std::uint64_t streamed = 0;  ///< flakes of the stream before the piece
        double burst = 0.0;          ///< time of birth, s
        bool is_burst = false;
    };
    /// One after the other from flake 0 on.
    [[nodiscard]] const std::vector<Piece>& pieces() const noexcept { return pieces_; }

    /// Time of birth of flake j of the stream, s; infinity with keys that let no such flake be born.
    [[nodiscard]] double streamed(std::uint64_t j) const noexcept {
        return ramps_.empty() ? delay_ + static_cast<double>(j + 1) / rate_ : keyed(j);
    }
    /// Those of flakes j, j + 1 and so on.
    void streamed(std::uint64_t j, std::span<double> out) const noexcept;
    [[nodiscard]] bool has_keys() const noexcept { return !ramps_.empty(); }
    [[nodiscard]] double rate() const noexcept { return rate_; }
    [[nodiscard]] double delay() const noexcept { return delay_; }

    /// Most flakes born within any time of this length; with keys, that or more.
    [[nodiscard]] double most_within(double length) const;

  private:
    /// A time in which the rate changes evenly, or is held until for ever.
    struct Ramp {
        double start = 0.0;
        double rate = 0.0;    ///< at the start
        double slope = 0.0;   ///< 1/s^2
        double length = 0.0;  ///< s
        double before = 0.0;  ///< integral of the rate from the delay to the start
        /// When the integral has grown to so much.
        [[nodiscard]] double reaches(double integral) const noexcept;
    };
    void set_keys(const RateKeys& keys);
    [[nodiscard]] std::size_t ramp_of(double integral) const noexcept;
    [[nodiscard]] double keyed(std::uint64_t j) const noexcept;
    [[nodiscard]] double integral_until(double time) const noexcept;

    double rate_;
    double delay_;
    std::uint64_t stream_ = 0;  ///< flakes of the stream
    std::vector<Piece> pieces_;
    std::vector<Ramp> ramps_;  ///< of keys; the last one never ends
};

}  // namespace motus::snow
