#include "turbulence.hpp"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/sine.hpp"

namespace motus::snow {
namespace {

constexpr double whole_turn = 6.283185307179586;

}  // namespace

std::array<Wave, wave_count> waves_of(double speed, double size, const glm::dvec3& drift, std::uint64_t seed,
                                      double period) {
    std::array<Wave, wave_count> waves;
    const Key key{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)};
    for (std::size_t i = 0; i < wave_count; ++i) {
        const auto number = static_cast<std::uint32_t>(i);
        const Words words = philox({number, 0, static_cast<std::uint32_t>(Stream::waves), 0}, key);
        const auto along = static_cast<double>(i) + 0.5;
        // Spread over the half sphere, the other half of which has the same waves.
        const double up = along / wave_count;
        const double level = std::sqrt(1.0 - up * up);
        const auto around = sine_cosine(whole_turn * static_cast<double>(fraction(words.a)));
        const auto aside = sine_cosine(whole_turn * static_cast<double>(fraction(words.b)));
        const glm::dvec3 direction(level * around.cosine, level * around.sine, up);
        // Lengths from half the size to twice it, shuffled against the directions.
        const double part = static_cast<double>((5 * i + 2) % wave_count) / (wave_count - 1.0);
        const glm::dvec3 vector = direction * ((0.5 + 1.5 * part) / size);
        const glm::dvec3 first =
            unit_vector(glm::cross(direction, up > 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1)));
        const glm::dvec3 across = aside.cosine * first + aside.sine * glm::cross(direction, first);
        Wave& wave = waves[i];
        wave.vector = floats_of(vector);
        wave.velocity = floats_of(across * (speed * std::sqrt(2.0 / wave_count)));
        wave.frequency = (2.0 * static_cast<double>(fraction(words.c)) - 1.0) * speed / size;
        if (period > 0.0) wave.frequency = std::floor(wave.frequency * period + 0.5) / period;
        wave.phase = static_cast<double>(fraction(words.d));
        wave.rate = static_cast<float>(glm::dot(vector, drift) + wave.frequency);
    }
    return waves;
}

float phase_at(const Wave& wave, double birth) {
    const double turns = wave.phase + wave.frequency * birth;
    return static_cast<float>(turns - std::floor(turns));
}

}  // namespace motus::snow
