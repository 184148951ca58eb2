// Smooth noise of one, two and three variables.
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

/// The derivatives of value() by the place, per unit.
[[nodiscard]] float gradient(double place, std::uint32_t seed) noexcept;
[[nodiscard]] glm::vec2 gradient(const glm::dvec2& place, std::uint32_t seed) noexcept;
[[nodiscard]] glm::vec3 gradient(const glm::dvec3& place, std::uint32_t seed) noexcept;

/// value() at many places. Throws std::invalid_argument if out.size() != places.size().
void values(std::span<const float> places, std::uint32_t seed, std::span<float> out);
void values(std::span<const glm::vec2> places, std::uint32_t seed, std::span<float> out);
void values(std::span<const glm::vec3> places, std::uint32_t seed, std::span<float> out);

}  // namespace motus::noise
