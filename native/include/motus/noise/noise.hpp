// Smooth noise of one, two and three variables, and random steps along a line.
//
// A sum of planes, each around a lattice point, whose heights and slopes are drawn from a hash of the point:
// Perlin, "An Image Synthesizer" (1985). In two and three dimensions, whose lattice is that of the whole
// numbers, the sum is divided by its root mean square at this place in a cell, so that the variance is the
// same everywhere and the lattice does not show, as it does in noise that is 0 at each lattice point; then z
// / sqrt(14 + z^2) keeps the result below 1. In one dimension the points lie half a unit apart, so that (1 -
// r^2)^3 as the planes' weight gives an even variance. The noise has two continuous derivatives, no period,
// and most of its power below one wave a unit.
//
// Costs: O(1) a place: 1 to 4 ns among many, 100 ns alone. Allocates nothing. Any number of threads at
// once.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/config.hpp"

namespace motus::noise {

/// Noise at a place, in [-1, 1]; its standard deviation is 0.31 in one dimension, 0.25 in two and
/// three. Different seeds give independent noises. Beyond 2^30 the noise is
/// constant; if a coordinate is NaN, it is NaN. The same bits by the same compiler (docs/library.md).
[[nodiscard]] float value(double place, std::uint32_t seed) noexcept;
[[nodiscard]] float value(const glm::dvec2& place, std::uint32_t seed) noexcept;
[[nodiscard]] float value(const glm::dvec3& place, std::uint32_t seed) noexcept;

/// As value(double), but the same again every `period` units, seamless to the second derivative: from 1 to
/// longest_period, or it throws std::invalid_argument. Places that are not finite give NaN.
[[nodiscard]] float looped(double place, std::uint32_t period, std::uint32_t seed);
inline constexpr std::uint32_t longest_period = 1U << 28U;

/// A random number in [-1, 1] for each unit, held until the next one; in the first `blend` of a unit (0:
/// none, 1: all of it) it goes over from the number before, by a smooth step. Throws std::invalid_argument if
/// `blend` is outside [0, 1]. If the place is NaN, it is NaN; beyond 2^30 it is constant.
[[nodiscard]] double steps(double place, double blend, std::uint32_t seed);

/// The derivatives of value() by the place, per unit.
[[nodiscard]] float gradient(double place, std::uint32_t seed) noexcept;
[[nodiscard]] glm::vec2 gradient(const glm::dvec2& place, std::uint32_t seed) noexcept;
[[nodiscard]] glm::vec3 gradient(const glm::dvec3& place, std::uint32_t seed) noexcept;

/// value() at many places. Throws std::invalid_argument if out.size() != places.size().
void values(std::span<const float> places, std::uint32_t seed, std::span<float> out);
void values(std::span<const glm::vec2> places, std::uint32_t seed, std::span<float> out);
void values(std::span<const glm::vec3> places, std::uint32_t seed, std::span<float> out);

}  // namespace motus::noise
