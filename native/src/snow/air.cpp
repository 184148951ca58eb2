#include "air.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motus/core/sine.hpp"

namespace motus::snow {
namespace {

/// e^{-x}, x >= 0, by arithmetic alone: the system's exp differs from release to release.
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
        const double second = (age - first) / drag;
        return {decay, first, second, (0.5 * age * age - second) / drag};
    }
    // (1/2 - (1 - (1 - e^{-x}) / x) / x) / x, whose terms cancel where x is small: 1/6 - x/24 + x^2/120 ...
    double third = 0.0;
    for (int k = 19; k >= 3; --k) third = (1.0 - x * third) / k;
    third *= 0.5;
    const double second = 0.5 - x * third;
    const double first = 1.0 - x * second;
    return {1.0 - x * first, age * first, age * age * second, age * age * age * third};
}

Air::Air(const glm::dvec3& acceleration, double drag, const glm::dvec3& wind, double gusts, double frequency,
         double period)
    : steady_(acceleration + drag * wind), drag_(drag), gusty_(gusts * wind), waves_(frequency, period) {}

Air::Air(const glm::dvec3& acceleration, double drag, std::span<const double> times,
         std::span<const glm::dvec3> winds, double gusts, double frequency, double period)
    : Air(acceleration, drag, glm::dvec3(0.0), 0.0, frequency, period) {
    gusts_ = gusts;
    // Before the first key the wind has always been there.
    Key key;
    key.time = times.front();
    key.wind = key.flow.velocity = winds.front();
    key.gusty = key.gusty_base = gusty_formula(key, key.time);
    keys_.push_back(key);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const Key& before = keys_.back();
        key.time = times[i];
        key.wind = winds[i];
        key.slope =
            i + 1 < times.size() ? (winds[i + 1] - winds[i]) / (times[i + 1] - times[i]) : glm::dvec3(0.0);
        key.flow = steady_flow(before, key.time);
        key.gusty = gusty_flow(before, key.time);
        key.gusty_base = gusty_formula(key, key.time);
        keys_.push_back(key);
    }
}

/// Of sines times a linear wind p + q t: with R the relaxed sine and S the relaxed R, t R - S is relaxed
/// t sin. The same for integrals.
Air::Flow Air::gusty_formula(const Key& key, double time) const {
    double value = 0.0, relaxed = 0.0, twice_relaxed = 0.0, way = 0.0, later_way = 0.0;
    for (const noise::Gusts::Wave& wave : waves_.waves()) {
        const auto [sine, cosine] = sine_cosine(wave.rate * time + wave.phase);
        // A sine is the imaginary part of e^{i w t}; relaxing divides by k + i w, integrating by i w.
        const double k = drag_, w = wave.rate, square = k * k + w * w;
        const std::array<double, 2> one{sine, cosine};
        const auto relax = [&](const std::array<double, 2>& of) -> std::array<double, 2> {
            return {(k * of[0] - w * of[1]) / square, (k * of[1] + w * of[0]) / square};
        };
        const auto integrate = [&](const std::array<double, 2>& of) -> std::array<double, 2> {
            return {-of[1] / w, of[0] / w};
        };
        const auto first = relax(one), second = relax(first), sum = integrate(first);
        value += wave.height * one[0];
        relaxed += wave.height * first[0];
        twice_relaxed += wave.height * second[0];
        way += wave.height * sum[0];
        later_way += wave.height * (integrate(sum)[0] + integrate(second)[0]);
    }
    const double since = time - key.time;
    const glm::dvec3 wind = key.wind + since * key.slope;
    return {gusts_ * drag_ * (wind * relaxed - key.slope * twice_relaxed),
            gusts_ * drag_ * (wind * way - key.slope * later_way), gusts_ * wind * value};
}

Air::Flow Air::gusty_flow(const Key& key, double time) const {
    if (gusts_ == 0.0) return {};
    const Flow now = gusty_formula(key, time);
    if (time < key.time) return now;
    const Relaxation r = relaxation(time - key.time, drag_);
    const glm::dvec3 off = key.gusty.velocity - key.gusty_base.velocity;
    return {now.velocity + off * r.decay, key.gusty.way + (now.way - key.gusty_base.way) + off * r.first,
            now.wind};
}

Air::Flow Air::steady_flow(const Key& key, double time) const {
    const double since = time - key.time;
    // Before the first key.
    if (since < 0.0) return {key.wind, key.wind * since, key.wind};
    const Relaxation r = relaxation(since, drag_);
    return {key.flow.velocity * r.decay + drag_ * (key.wind * r.first + key.slope * r.second),
            key.flow.way + key.flow.velocity * r.first + drag_ * (key.wind * r.second + key.slope * r.third),
            key.wind + since * key.slope};
}

Air::Flow Air::flow_at(double time) const {
    const auto next = std::ranges::upper_bound(keys_, time, {}, &Key::time);
    const Key& key = next == keys_.begin() ? keys_.front() : *(next - 1);
    const Flow steady = steady_flow(key, time), gusty = gusty_flow(key, time);
    return {steady.velocity + gusty.velocity, steady.way + gusty.way, steady.wind + gusty.wind};
}

Air::Gusts Air::gusts_at(double time) const {
    Gusts sum;
    for (const noise::Gusts::Wave& wave : waves_.waves()) {
        const auto [sine, cosine] = sine_cosine(wave.rate * time + wave.phase);
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

Air::State Air::at(double time, double age, const Relaxation& r) const {
    State state{steady_ * r.second, steady_ * r.first, steady_ * r.first, steady_ * r.decay, r};
    if (!keys_.empty() && drag_ > 0.0) {
        const Flow now = flow_at(time), born = flow_at(time - age);
        state.way += now.way - born.way - r.first * born.velocity;
        state.way_slope += (1.0 - r.decay) * born.wind;
        state.velocity += now.velocity - r.decay * born.velocity;
        state.velocity_slope += drag_ * r.decay * born.wind;
    }
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
