#include "motus/noise/gusts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motus/core/numeric.hpp"
#include "motus/core/sine.hpp"

namespace motus::noise {

Gusts::Gusts(double frequency, double period) {
    constexpr double most = 1000.0;
    require(frequency > 0.0 && frequency <= most, "frequency: must be greater than 0 and at most 1000");
    require(period == 0.0 || (period >= 1e-6 && period <= 1e30), "period: must be 0, or from 1e-6 to 1e30");
    constexpr std::array<double, count> rates{1.0, 1.618033988749895, 2.414213562373095, 3.302775637731995};
    constexpr std::array<double, count> heights{0.4, 0.3, 0.2, 0.1};
    for (std::size_t i = 0; i < count; ++i) {
        double rate = 2.0 * std::numbers::pi * frequency * rates[i];
        if (period > 0.0)
            rate = 2.0 * std::numbers::pi * std::max(std::round(frequency * rates[i] * period), 1.0) / period;
        waves_[i] = {heights[i], rate, static_cast<double>(i)};
    }
}

double Gusts::value(double time) const noexcept {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += wave.height * sine_cosine(wave.rate * time + wave.phase).sine;
    return sum;
}

void values(const Gusts& gusts, std::span<const double> times, std::span<double> out) {
    require(out.size() == times.size(), "out: must be as many as times");
    std::ranges::transform(times, out.begin(), [&](double time) { return gusts.value(time); });
}

}  // namespace motus::noise
