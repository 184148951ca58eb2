// Gusts of wind: how much its velocity rises and falls over time.
//
// The sum of four sine waves, the slower the higher, whose rates have no common period: the first one's times
// the golden, the silver and the bronze mean. In [-1, 1]. Waves, and no noise from a lattice, so that what a
// gust does to a body in linear drag has a closed form (snow/snow.hpp).
//
// Costs: O(1) a time, some 50 ns. Allocates nothing. Any number of threads at once.
#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "motus/config.hpp"

namespace motus::noise {

class Gusts {
  public:
    /// height * sin(rate * time + phase).
    struct Wave {
        double height = 0.0;
        double rate = 0.0;   ///< rad/s
        double phase = 0.0;  ///< rad
    };
    static constexpr std::size_t count = 4;

    /// frequency: of the first wave, 1/s, above 0, at most 1000. period: time after which the gusts begin
    /// again, s, from 1e-6 to 1e30, for which all frequencies go to the nearest whole number of waves in it,
    /// at least 1; 0 for gusts without a period. Throws std::invalid_argument if a number is outside of its
    /// domain.
    explicit Gusts(double frequency, double period = 0.0);

    /// From -1 to 1 at a time, s; NaN of NaN. The same bits by the same compiler (docs/library.md).
    [[nodiscard]] double value(double time) const noexcept;

    [[nodiscard]] const std::array<Wave, count>& waves() const noexcept { return waves_; }

  private:
    std::array<Wave, count> waves_{};
};

/// Gusts::value() at many times. Throws std::invalid_argument if out.size() != times.size().
void values(const Gusts& gusts, std::span<const double> times, std::span<double> out);

}  // namespace motus::noise
