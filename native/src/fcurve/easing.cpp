#include "easing.hpp"

#include <cmath>
#include <numbers>

namespace motus::fcurve {
namespace {

constexpr auto pi = static_cast<float>(std::numbers::pi);
constexpr auto quarter_turn = static_cast<float>(std::numbers::pi / 2.0);

/// One kind of easing as three functions of a Way.
template <class In, class Out, class InOut>
[[nodiscard]] float chosen(Easing easing, const Way& way, In in, Out out, InOut in_out) {
    switch (easing) {
        case Easing::out:
            return out(way);
        case Easing::in_out:
            return in_out(way);
        default:
            return in(way);
    }
}

// --- back ------------------------------------------------------------------------------------------------

[[nodiscard]] float back(Easing easing, float overshoot, const Way& way) {
    const auto [time, begin, change, duration] = way;
    if (easing == Easing::in) {
        const float t = time / duration;
        return change * t * t * ((overshoot + 1.0f) * t - overshoot) + begin;
    }
    if (easing != Easing::in_out) {
        const float t = time / duration - 1.0f;
        return change * (t * t * ((overshoot + 1.0f) * t + overshoot) + 1.0f) + begin;
    }
    const float wider = overshoot * 1.525f;
    float t = time / (duration / 2.0f);
    if (t < 1.0f) return change / 2.0f * (t * t * ((wider + 1.0f) * t - wider)) + begin;
    t -= 2.0f;
    return change / 2.0f * (t * t * ((wider + 1.0f) * t + wider) + 2.0f) + begin;
}

// --- bounce ----------------------------------------------------------------------------------------------

[[nodiscard]] float bounce_out(const Way& way) {
    constexpr float steepness = 7.5625f, whole = 2.75f;
    float t = way.time / way.duration;
    if (t < 1.0f / whole) return way.change * (steepness * t * t) + way.begin;
    float height = 0.984375f;
    if (t < 2.0f / whole) {
        t -= 1.5f / whole;
        height = 0.75f;
    } else if (t < 2.5f / whole) {
        t -= 2.25f / whole;
        height = 0.9375f;
    } else {
        t -= 2.625f / whole;
    }
    return way.change * ((steepness * t) * t + height) + way.begin;
}

[[nodiscard]] float bounce_in(const Way& way) {
    const Way back{way.duration - way.time, 0.0f, way.change, way.duration};
    return way.change - bounce_out(back) + way.begin;
}

[[nodiscard]] float bounce_in_out(const Way& way) {
    if (way.time < way.duration / 2.0f)
        return bounce_in({way.time * 2.0f, 0.0f, way.change, way.duration}) * 0.5f + way.begin;
    const Way second{way.time * 2.0f - way.duration, 0.0f, way.change, way.duration};
    return bounce_out(second) * 0.5f + way.change * 0.5f + way.begin;
}

// --- circular --------------------------------------------------------------------------------------------

[[nodiscard]] float circular_in(const Way& way) {
    const float t = way.time / way.duration;
    return -way.change * (std::sqrt(1.0f - t * t) - 1.0f) + way.begin;
}

[[nodiscard]] float circular_out(const Way& way) {
    const float t = way.time / way.duration - 1.0f;
    return way.change * std::sqrt(1.0f - t * t) + way.begin;
}

[[nodiscard]] float circular_in_out(const Way& way) {
    float t = way.time / (way.duration / 2.0f);
    if (t < 1.0f) return -way.change / 2.0f * (std::sqrt(1.0f - t * t) - 1.0f) + way.begin;
    t -= 2.0f;
    return way.change / 2.0f * (std::sqrt(1.0f - t * t) + 1.0f) + way.begin;
}

// --- powers ----------------------------------------------------------------------------------------------

/// change * t * t ..., from the left.
template <int power>
[[nodiscard]] float times_power(float change, float t) {
    for (int i = 0; i < power; ++i) change *= t;
    return change;
}

template <int power>
[[nodiscard]] float power_in(const Way& way) {
    return times_power<power>(way.change, way.time / way.duration) + way.begin;
}

template <int power>
[[nodiscard]] float power_out(const Way& way) {
    const float t = way.time / way.duration - 1.0f;
    constexpr bool is_odd = power % 2 == 1;
    const float raised = times_power<power - 1>(t, t);
    return is_odd ? way.change * (raised + 1.0f) + way.begin : -way.change * (raised - 1.0f) + way.begin;
}

template <int power>
[[nodiscard]] float power_in_out(const Way& way) {
    float t = way.time / (way.duration / 2.0f);
    const float half = way.change / 2.0f;
    if (t < 1.0f) return times_power<power>(half, t) + way.begin;
    t -= 2.0f;
    constexpr bool is_odd = power % 2 == 1;
    const float raised = times_power<power - 1>(t, t);
    return is_odd ? half * (raised + 2.0f) + way.begin : -way.change / 2.0f * (raised - 2.0f) + way.begin;
}

template <int power>
[[nodiscard]] float powers(Easing easing, const Way& way) {
    return chosen(easing, way, power_in<power>, power_out<power>, power_in_out<power>);
}

[[nodiscard]] float quadratic_out(const Way& way) {
    const float t = way.time / way.duration;
    return -way.change * t * (t - 2.0f) + way.begin;
}

[[nodiscard]] float quadratic_in_out(const Way& way) {
    float t = way.time / (way.duration / 2.0f);
    if (t < 1.0f) return way.change / 2.0f * t * t + way.begin;
    t -= 1.0f;
    return -way.change / 2.0f * (t * (t - 2.0f) - 1.0f) + way.begin;
}

// --- elastic ---------------------------------------------------------------------------------------------

/// The swing of an elastic way: its height, how much of it counts, and by how many frames it is late.
struct Swing {
    float height, share = 1.0f, shift = 0.0f, period;

    /// t: from -1, a whole way from the end that does not swing, to 0.
    Swing(const Key& key, const Way& way, float period_of_way, float t)
        : height(key.amplitude), period(key.period) {
        if (period == 0.0f) period = period_of_way;
        if (height != 0.0f && !(height < std::abs(way.change))) {
            shift = period / (2.0f * pi) * std::asin(way.change / height);
            return;
        }
        shift = period / 4.0f;
        if (way.change != 0.0f) blend(way, t);
        height = way.change;
    }

    /// Height at t, without the way's own change.
    [[nodiscard]] float at(float t, float duration) const {
        return height * std::pow(2.0f, 10.0f * t) * std::sin((t * duration - shift) * (2.0f * pi) / period);
    }

  private:
    /// An amplitude that is less than the change counts less, but not at the end, which it has to meet.
    void blend(const Way& way, float t) {
        share = height != 0.0f ? share * (height / std::abs(way.change)) : 0.0f;
        const float rest = std::abs(shift);
        const float distance = std::abs(t * way.duration);
        if (distance >= rest) return;
        const float part = distance / rest;
        share = share * part + (1.0f - part);
    }
};

[[nodiscard]] float elastic_in(const Key& key, const Way& way) {
    float t = way.time / way.duration;
    if (t == 1.0f) return way.begin + way.change;
    t -= 1.0f;
    const Swing swing(key, way, way.duration * 0.3f, t);
    return -swing.share * swing.at(t, way.duration) + way.begin;
}

[[nodiscard]] float elastic_out(const Key& key, const Way& way) {
    float t = way.time / way.duration;
    if (t == 1.0f) return way.begin + way.change;
    t = -t;
    const Swing swing(key, way, way.duration * 0.3f, t);
    return swing.share * swing.at(t, way.duration) + way.change + way.begin;
}

[[nodiscard]] float elastic_in_out(const Key& key, const Way& way) {
    float t = way.time / (way.duration / 2.0f);
    if (t == 2.0f) return way.begin + way.change;
    t -= 1.0f;
    const Swing swing(key, way, way.duration * (0.3f * 1.5f), t);
    if (t < 0.0f) return swing.share * -0.5f * swing.at(t, way.duration) + way.begin;
    return swing.share * 0.5f * swing.at(-t, way.duration) + way.change + way.begin;
}

[[nodiscard]] float elastic(const Key& key, const Way& way) {
    if (way.time == 0.0f) return way.begin;
    if (key.easing == Easing::in) return elastic_in(key, way);
    return key.easing == Easing::in_out ? elastic_in_out(key, way) : elastic_out(key, way);
}

// --- exponential -----------------------------------------------------------------------------------------

constexpr float least_power = 0.0009765625f;  // 2^-10, which is taken off so that the way begins at its begin
constexpr float power_scale = 1.0f / (1.0f - least_power);

[[nodiscard]] float exponential_in(const Way& way) {
    if (way.time == 0.0f) return way.begin;
    const float power = std::pow(2.0f, 10.0f * (way.time / way.duration - 1.0f));
    return way.change * (power - least_power) * power_scale + way.begin;
}

[[nodiscard]] float exponential_out(const Way& way) {
    if (way.time == 0.0f) return way.begin;
    const float power = std::pow(2.0f, -10.0f * way.time / way.duration);
    return way.change * (1.0f - (power - least_power) * power_scale) + way.begin;
}

[[nodiscard]] float exponential_in_out(const Way& way) {
    const float half = way.duration / 2.0f, change = way.change / 2.0f;
    if (way.time <= half) return exponential_in({way.time, way.begin, change, half});
    return exponential_out({way.time - half, way.begin + change, change, half});
}

// --- sinusoidal ------------------------------------------------------------------------------------------

[[nodiscard]] float sinusoidal_in(const Way& way) {
    return -way.change * std::cos(way.time / way.duration * quarter_turn) + way.change + way.begin;
}

[[nodiscard]] float sinusoidal_out(const Way& way) {
    return way.change * std::sin(way.time / way.duration * quarter_turn) + way.begin;
}

[[nodiscard]] float sinusoidal_in_out(const Way& way) {
    return -way.change / 2.0f * (std::cos(pi * way.time / way.duration) - 1.0f) + way.begin;
}

}  // namespace

float eased(const Key& key, const Way& way) {
    const Easing easing = key.easing;
    switch (key.interpolation) {
        case Interpolation::back:
            return back(easing, key.overshoot, way);
        case Interpolation::bounce:
            return chosen(easing == Easing::automatic ? Easing::out : easing, way, bounce_in, bounce_out,
                          bounce_in_out);
        case Interpolation::circular:
            return chosen(easing, way, circular_in, circular_out, circular_in_out);
        case Interpolation::cubic:
            return powers<3>(easing, way);
        case Interpolation::elastic:
            return elastic(key, way);
        case Interpolation::exponential:
            return chosen(easing, way, exponential_in, exponential_out, exponential_in_out);
        case Interpolation::quadratic:
            return chosen(easing, way, power_in<2>, quadratic_out, quadratic_in_out);
        case Interpolation::quartic:
            return powers<4>(easing, way);
        case Interpolation::quintic:
            return powers<5>(easing, way);
        case Interpolation::sinusoidal:
            return chosen(easing, way, sinusoidal_in, sinusoidal_out, sinusoidal_in_out);
        default:
            return way.begin;
    }
}

}  // namespace motus::fcurve
