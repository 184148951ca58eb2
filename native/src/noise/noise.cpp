#include "motus/noise/noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "motus/core/ieee_floats.hpp"
#include "noise_kernel.hpp"
#include "shape.hpp"

namespace motus::noise {
namespace {

constexpr double farthest = 0x1p30;

template <std::size_t dimensions>
[[nodiscard]] float dot(const Vector<dimensions>& a, const Vector<dimensions>& b) noexcept {
    float sum = a[0] * b[0];
    for (std::size_t axis = 1; axis < dimensions; ++axis) sum += a[axis] * b[axis];
    return sum;
}

/// A place in one of the lattices: the cell's lowest corner, and how far into the cell.
template <std::size_t dimensions>
struct Cell {
    /// half: 0 for the whole numbers, 1 for the lattice halfway between.
    Cell(const std::array<double, dimensions>& place, std::uint32_t half) noexcept {
        for (std::size_t axis = 0; axis < dimensions; ++axis) {
            const double here = std::clamp(place[axis], -farthest, farthest) - 0.5 * half;
            const double low = std::floor(here);
            within[axis] = static_cast<float>(here - low);
            // In halves, so that no point of one lattice has the name of a point of the other.
            corner[axis] = 2 * static_cast<std::uint32_t>(static_cast<std::int64_t>(low)) + half;
        }
    }

    /// A hash of each corner; bit i of the index, from the highest on, is 1 for the upper side of axis i.
    [[nodiscard]] std::array<std::uint32_t, 1U << dimensions> hashes(std::uint32_t seed) const noexcept {
        std::array<std::uint32_t, 1U << dimensions> result{mixed(seed)};
        std::size_t count = 1;
        for (std::size_t axis = 0; axis < dimensions; ++axis, count *= 2) {
            for (std::size_t i = count; i-- > 0;) {
                result[2 * i + 1] = mixed(result[i] + (corner[axis] + 2) * name_step);
                result[2 * i] = mixed(result[i] + corner[axis] * name_step);
            }
        }
        return result;
    }

    [[nodiscard]] Vector<dimensions> from_corner(std::size_t index) const noexcept {
        Vector<dimensions> result;
        for (std::size_t axis = 0; axis < dimensions; ++axis)
            result[axis] = within[axis] - static_cast<float>((index >> (dimensions - 1 - axis)) & 1U);
        return result;
    }

    Vector<dimensions> within;
    std::array<std::uint32_t, dimensions> corner;
};

/// The bump of a lattice point: (1 - r^2)^3 times a plane of some height and slope.
template <std::size_t dimensions>
struct Bump {
    explicit Bump(std::uint32_t hash) noexcept
        : height(static_cast<float>(hash >> 16U) * (2.0F / 65535.0F) - 1.0F),
          direction(
              Shape<dimensions>::directions[((hash & 0xffffU) * static_cast<std::uint32_t>(
                                                                    Shape<dimensions>::directions.size())) >>
                                            16U]) {}

    [[nodiscard]] float plane(const Vector<dimensions>& from) const noexcept {
        return height + Shape<dimensions>::steepness * dot<dimensions>(direction, from);
    }

    float height;
    const Vector<dimensions>& direction;
};

/// Calls add(bump, from, rest) for each bump that reaches the place: the vector from its middle, and 1 - r^2.
template <std::size_t dimensions, class Add>
void for_each_bump(const std::array<double, dimensions>& place, std::uint32_t seed, const Add& add) noexcept {
    for (std::uint32_t half = 0; half < 2; ++half) {
        const Cell<dimensions> cell(place, half);
        const auto hashes = cell.hashes(seed);
        for (std::size_t index = 0; index < hashes.size(); ++index) {
            const Vector<dimensions> from = cell.from_corner(index);
            const float rest = 1.0F - dot<dimensions>(from, from);
            if (rest > 0.0F) add(Bump<dimensions>(hashes[index]), from, rest);
        }
    }
}

template <std::size_t dimensions>
[[nodiscard]] float sum_at(const std::array<double, dimensions>& place, std::uint32_t seed) noexcept {
    float sum = 0.0F;
    for_each_bump<dimensions>(place, seed,
                              [&](const Bump<dimensions>& bump, const Vector<dimensions>& from, float rest) {
                                  sum += rest * rest * rest * bump.plane(from);
                              });
    return sum * (1.0F / Shape<dimensions>::bound);
}

template <std::size_t dimensions>
[[nodiscard]] Vector<dimensions> slope_at(const std::array<double, dimensions>& place,
                                          std::uint32_t seed) noexcept {
    Vector<dimensions> sum{};
    for_each_bump<dimensions>(place, seed,
                              [&](const Bump<dimensions>& bump, const Vector<dimensions>& from, float rest) {
                                  const float steep = rest * rest * rest * Shape<dimensions>::steepness;
                                  const float falling = 6.0F * rest * rest * bump.plane(from);
                                  for (std::size_t axis = 0; axis < dimensions; ++axis)
                                      sum[axis] += steep * bump.direction[axis] - falling * from[axis];
                              });
    for (float& one : sum) one *= 1.0F / Shape<dimensions>::bound;
    return sum;
}

[[nodiscard]] std::array<double, 1> numbers(double place) noexcept {
    return {place};
}
template <class T>
[[nodiscard]] std::array<double, 2> numbers(const glm::vec<2, T>& place) noexcept {
    return {place.x, place.y};
}
template <class T>
[[nodiscard]] std::array<double, 3> numbers(const glm::vec<3, T>& place) noexcept {
    return {place.x, place.y, place.z};
}

[[nodiscard]] const float* first_number(const float& place) noexcept {
    return &place;
}
template <int dimensions>
[[nodiscard]] const float* first_number(const glm::vec<dimensions, float>& place) noexcept {
    return &place.x;
}

template <class Place>
void fill(std::span<const Place> places, std::uint32_t seed, std::span<float> out) noexcept {
    constexpr std::size_t dimensions = std::tuple_size_v<decltype(numbers(Place()))>;
    const auto fill_by = noise_kernels().back().fill[dimensions - 1];
    in_ieee_floats([&] {
        for (std::size_t begin = 0; begin < places.size(); begin += noise_block) {
            const std::size_t count = std::min(noise_block, places.size() - begin);
            const float* const from = first_number(places[begin]);
            bool are_filled = false;
            if (count == noise_block) {
                are_filled = fill_by(from, seed, &out[begin]);
            } else {
                std::array<float, dimensions * noise_block> padded{};
                std::array<float, noise_block> found{};
                std::copy_n(from, dimensions * count, padded.begin());
                are_filled = fill_by(padded.data(), seed, found.data());
                std::copy_n(found.begin(), count, &out[begin]);
            }
            for (std::size_t i = are_filled ? count : 0; i < count; ++i)
                out[begin + i] = sum_at(numbers(places[begin + i]), seed);
        }
    });
}

}  // namespace

float value(double place, std::uint32_t seed) noexcept {
    return in_ieee_floats([&] { return sum_at(numbers(place), seed); });
}
float value(const glm::dvec2& place, std::uint32_t seed) noexcept {
    return in_ieee_floats([&] { return sum_at(numbers(place), seed); });
}
float value(const glm::dvec3& place, std::uint32_t seed) noexcept {
    return in_ieee_floats([&] { return sum_at(numbers(place), seed); });
}

float gradient(double place, std::uint32_t seed) noexcept {
    return in_ieee_floats([&] { return slope_at(numbers(place), seed)[0]; });
}
glm::vec2 gradient(const glm::dvec2& place, std::uint32_t seed) noexcept {
    const Vector<2> slope = in_ieee_floats([&] { return slope_at(numbers(place), seed); });
    return {slope[0], slope[1]};
}
glm::vec3 gradient(const glm::dvec3& place, std::uint32_t seed) noexcept {
    const Vector<3> slope = in_ieee_floats([&] { return slope_at(numbers(place), seed); });
    return {slope[0], slope[1], slope[2]};
}

void values(std::span<const float> places, std::uint32_t seed, std::span<float> out) noexcept {
    fill(places, seed, out);
}
void values(std::span<const glm::vec2> places, std::uint32_t seed, std::span<float> out) noexcept {
    fill(places, seed, out);
}
void values(std::span<const glm::vec3> places, std::uint32_t seed, std::span<float> out) noexcept {
    fill(places, seed, out);
}

}  // namespace motus::noise
