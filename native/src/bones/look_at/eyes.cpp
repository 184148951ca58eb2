#include "motus/bones/look_at/eyes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "motus/core/numeric.hpp"
#include "motus/noise/noise.hpp"

namespace motus::bones::look_at {
namespace {

constexpr double jitter = 0.7;          // share of the time of one jump or blink within which it begins
constexpr double most_events = 0x1p30;  // since time 0: noise::steps() knows no more

/// Independent random numbers of one seed.
enum class Draw : std::uint32_t { beginning, distance, direction };

/// In [0, 1], for each whole number.
double random(double number, std::uint32_t seed, Draw draw) {
    constexpr std::uint32_t apart = 0x9e3779b9U;
    return 0.5 + 0.5 * noise::steps(number + 0.5, 0.0, seed + apart * static_cast<std::uint32_t>(draw));
}

/// When event `number` of `rate` events a second begins, s.
double beginning(double number, double rate, std::uint32_t seed) {
    return (number + jitter * random(number, seed, Draw::beginning)) / rate;
}

/// The last event that has begun at a time.
double last_begun(double rate, std::uint32_t seed, double seconds) {
    const double number = std::floor(seconds * rate);
    return seconds < beginning(number, rate, seed) ? number - 1.0 : number;
}

/// Place to which jump `number` leads.
glm::dvec2 place_after(const Saccades& saccades, double number) {
    const double distance = saccades.amplitude * random(number, saccades.seed, Draw::distance);
    const double angle = 2.0 * std::numbers::pi * random(number, saccades.seed, Draw::direction);
    return distance * glm::dvec2(std::cos(angle), std::sin(angle));
}

/// From 0 to 1 with two continuous derivatives: the movement of least jerk.
double least_jerk(double share) {
    const double x = std::clamp(share, 0.0, 1.0);
    return x * x * x * (10.0 + x * (6.0 * x - 15.0));
}

}  // namespace

glm::dvec2 saccade(const Saccades& saccades, double seconds) {
    if (!are_finite(saccades.amplitude, saccades.rate, seconds)) return {0.0, 0.0};
    const Saccades clamped{std::clamp(saccades.amplitude, 0.0, std::numbers::pi),
                           std::clamp(saccades.rate, 0.0, most_rate), saccades.seed};
    if (clamped.rate == 0.0 || clamped.amplitude == 0.0) return {0.0, 0.0};
    if (std::abs(seconds) * clamped.rate > most_events) return {0.0, 0.0};
    const double number = last_begun(clamped.rate, clamped.seed, seconds);
    const glm::dvec2 from = place_after(clamped, number - 1.0);
    const glm::dvec2 to = place_after(clamped, number);
    const double begins = beginning(number, clamped.rate, clamped.seed);
    const double by_size = shortest_saccade + saccade_slope * glm::degrees(glm::distance(from, to));
    const double lasts = std::min(by_size, beginning(number + 1.0, clamped.rate, clamped.seed) - begins);
    return from + least_jerk((seconds - begins) / lasts) * (to - from);
}

double blink(double since) {
    if (!(since > 0.0 && since < closing_seconds + opening_seconds)) return 0.0;
    return since < closing_seconds ? smooth_step(since / closing_seconds)
                                   : smooth_step(1.0 - (since - closing_seconds) / opening_seconds);
}

double blinks(double rate, std::uint32_t seed, double seconds) {
    if (!are_finite(rate, seconds) || rate <= 0.0) return 0.0;
    const double often = std::min(rate, most_rate);
    if (std::abs(seconds) * often > most_events) return 0.0;
    // Of blinks that follow each other quickly the one that shuts the eyes more counts.
    double closed = 0.0;
    double number = last_begun(often, seed, seconds);
    while (true) {
        const double since = seconds - beginning(number, often, seed);
        if (since >= closing_seconds + opening_seconds) return closed;
        closed = std::max(closed, blink(since));
        number -= 1.0;
    }
}

}  // namespace motus::bones::look_at
