#include "air.hpp"

#include <cmath>
#include <numbers>

#include "motus/core/sine.hpp"

namespace motus::snow {
namespace {

/// e^{-x}, x >= 0, with the same bits on every machine, which the system's has not.
[[nodiscard]] double decay_of(double x) {
    constexpr double farthest = 700.0;
    if (x > farthest) return 0.0;
    const double halvings = std::floor(x / std::numbers::ln2 + 0.5);
    const double rest = halvings * std::numbers::ln2 - x;
    double sum = 1.0;
    for (int k = 16; k > 0; --k) sum = 1.0 + sum * rest / k;
    return std::ldexp(sum, -static_cast<int>(halvings));
}

}  // namespace

Relaxation relaxation(double age, double drag) {
    const double x = drag * age;
    if (x >= 1.0) {
        const double decay = decay_of(x);
        const double first = (1.0 - decay) / drag;
        return {decay, first, (age - first) / drag};
    }
    // (1 - (1 - e^{-x}) / x) / x, whose terms cancel where x is small.
    double sum = 0.0;
    for (int k = 19; k >= 2; --k) sum = (1.0 - x * sum) / k;
    const double second = sum;  // 1/2 - x/6 + x^2/24 ...
    const double first = 1.0 - x * second;
    return {1.0 - x * first, age * first, age * age * second};
}

Air::Air(const glm::dvec3& acceleration, double drag, const glm::dvec3& wind, double gusts, double frequency)
    : steady_(acceleration + drag * wind), drag_(drag), gusty_(gusts * wind) {
    // Rates without a common period.
    constexpr std::array<double, waves> rates{1.0, 1.618033988749895, 2.414213562373095, 3.302775637731995};
    constexpr std::array<double, waves> heights{0.4, 0.3, 0.2, 0.1};
    for (std::size_t i = 0; i < waves; ++i)
        waves_[i] = {heights[i], 2.0 * std::numbers::pi * frequency * rates[i], static_cast<double>(i)};
}

Air::Gusts Air::gusts_at(double time) const {
    Gusts sum;
    for (const Wave& wave : waves_) {
        const SineCosine<Pair> at = sine_cosine(Pair(wave.rate * time + wave.phase));
        const double sine = lane(at.sine, 0), cosine = lane(at.cosine, 0);
        sum.value += wave.height * sine;
        sum.integral -= wave.height * cosine / wave.rate;
        sum.relaxed +=
            wave.height * (drag_ * sine - wave.rate * cosine) / (drag_ * drag_ + wave.rate * wave.rate);
    }
    return sum;
}

double Air::gust(double time) const {
    return gusts_at(time).value;
}

Air::State Air::at(double time, double age) const {
    const Relaxation r = relaxation(age, drag_);
    State state{steady_ * r.second, steady_ * r.first, steady_ * r.first, steady_ * r.decay, r};
    if (gusty_ == glm::dvec3(0.0) || drag_ == 0.0) return state;
    const Gusts now = gusts_at(time), born = gusts_at(time - age);
    const double relaxed = now.relaxed - r.decay * born.relaxed;
    state.way += gusty_ * (now.integral - born.integral - relaxed);
    state.way_slope += gusty_ * (born.value * (1.0 - r.decay));
    state.velocity += gusty_ * (drag_ * relaxed);
    state.velocity_slope += gusty_ * (drag_ * r.decay * born.value);
    return state;
}

}  // namespace motus::snow
