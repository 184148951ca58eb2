#include "motus/noise/noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "noise_kernel.hpp"
#include "shape.hpp"

namespace motus::noise {
namespace {

/// The other sign if this bit of the hash is set.
[[nodiscard]] float turned(std::uint32_t hash, int bit, float number) noexcept {
    return ((hash >> bit) & 1U) != 0 ? -number : number;
}

/// A coordinate that is a number: the whole one below it, and how far it is from there.
struct Coordinate {
    explicit Coordinate(double number) noexcept {
        const double near = std::clamp<double>(number, -farthest, farthest);
        const double low = std::floor(near);
        whole = static_cast<std::uint32_t>(static_cast<std::int64_t>(low));
        within = near - low;
    }

    std::uint32_t whole;
    double within;
};

// --- Along a line ------------------------------------------------------------------------------------------

[[nodiscard]] std::uint32_t hash_of(std::uint32_t name, std::uint32_t seed) noexcept {
    return mixed(mixed(seed) + name * name_step);
}

/// A number in [-1, 1], spread evenly.
[[nodiscard]] float height_of(std::uint32_t hash) noexcept {
    return static_cast<float>(hash >> 16U) * (2.0F / 65535.0F) - 1.0F;
}

/// Calls add(height, slope, from, rest) for each bump that reaches the place: (1 - r^2)^3 times height +
/// slope r, the distance r from its middle, and 1 - r^2. First those of whole numbers, then those halfway
/// between them, whose names are odd. name_of(count) is the name of a bump that stands so many halves after
/// 0.
template <class NameOf, class Add>
void for_each_bump(double place, std::uint32_t seed, const NameOf& name_of, const Add& add) noexcept {
    const Coordinate x(place);
    const bool is_beyond = x.within >= 0.5;
    const auto add_both = [&](std::uint32_t halves, double within) {
        for (const std::uint32_t side : {0U, 1U}) {
            const std::uint32_t hash = hash_of(name_of(halves + 2 * side), seed);
            const float height = height_of(hash);
            const float from = static_cast<float>(within) - static_cast<float>(side);
            const float rest = 1.0F - from * from;
            if (rest > 0.0F) add(height, turned(hash, sign_bit, line::steepness), from, rest);
        }
    };
    add_both(2 * x.whole, x.within);
    add_both(2 * x.whole + (is_beyond ? 1U : -1U), x.within + (is_beyond ? -0.5 : 0.5));
}

template <class NameOf>
[[nodiscard]] float value_at(double place, std::uint32_t seed, const NameOf& name_of) noexcept {
    float sum = 0.0F;
    for_each_bump(place, seed, name_of, [&](float height, float slope, float from, float rest) {
        sum += rest * rest * rest * (height + slope * from);
    });
    return sum * (1.0F / line::bound);
}

[[nodiscard]] float value_at(double place, std::uint32_t seed) noexcept {
    return value_at(place, seed, std::identity());
}

[[nodiscard]] float slope_at(double place, std::uint32_t seed) noexcept {
    float sum = 0.0F;
    for_each_bump(place, seed, std::identity(), [&](float height, float slope, float from, float rest) {
        sum += rest * rest * rest * slope - 6.0F * rest * rest * (height + slope * from) * from;
    });
    return sum * (1.0F / line::bound);
}

// --- In the plane and in space -----------------------------------------------------------------------------

/// A number and its derivatives by the coordinates of the place: what is written for numbers finds both.
template <std::size_t dimensions>
struct Jet {
    float value = 0.0F;
    std::array<float, dimensions> slope{};

    // NOLINTNEXTLINE(google-explicit-constructor): a constant stands where a number may stand.
    Jet(float constant) noexcept : value(constant) {}

    /// Coordinate `axis`.
    Jet(float coordinate, std::size_t axis) noexcept : value(coordinate) { slope[axis] = 1.0F; }

    friend Jet operator+(Jet a, const Jet& b) noexcept {
        a.value += b.value;
        for (std::size_t i = 0; i < dimensions; ++i) a.slope[i] += b.slope[i];
        return a;
    }
    friend Jet operator-(const Jet& a, const Jet& b) noexcept { return a + b * Jet(-1.0F); }
    friend Jet operator*(const Jet& a, const Jet& b) noexcept {
        Jet result(a.value * b.value);
        for (std::size_t i = 0; i < dimensions; ++i)
            result.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
        return result;
    }
    friend Jet turned(std::uint32_t hash, int bit, const Jet& number) noexcept {
        return number * Jet(turned(hash, bit, 1.0F));
    }
    /// a / sqrt(b)
    friend Jet over_root(const Jet& a, const Jet& b) noexcept {
        const float root = std::sqrt(b.value);
        Jet result(a.value / root);
        for (std::size_t i = 0; i < dimensions; ++i)
            result.slope[i] = (a.slope[i] - 0.5F * a.value / b.value * b.slope[i]) / root;
        return result;
    }
};

[[nodiscard]] float over_root(float a, float b) noexcept {
    return a / std::sqrt(b);
}

/// The cell around a place along one axis: how far the place is from the lower and from the upper corners,
/// the weight of the upper ones, and the name of the lower ones.
template <class Number>
struct Axis {
    Number from_lower, from_upper, upper_weight;
    std::uint32_t name;
};

/// The weight is 6 t^5 - 15 t^4 + 10 t^3, written so that it has all digits at t = 1 too.
template <class Number>
[[nodiscard]] Axis<Number> axis_at(const Number& within, std::uint32_t whole) noexcept {
    const Number from_middle = within - Number(0.5F), square = from_middle * from_middle;
    const Number weight =
        Number(0.5F) + from_middle * (Number(1.875F) - square * (Number(5.0F) - Number(6.0F) * square));
    return {within, within - Number(1.0F), weight, whole};
}

/// The sum over all corners that lie on these sides of the first axes: of planes through heights that their
/// hashes give, weighted.
template <class Number, std::size_t dimensions, class... Distances>
[[nodiscard]] Number blended(std::uint32_t hash, const std::array<Axis<Number>, dimensions>& cell,
                             const Distances&... distances) noexcept {
    if constexpr (sizeof...(Distances) == dimensions) {
        // Heights are whole numbers of 32 bits.
        const Number steepness(Lattice<dimensions>::steepness * 0x1p31F);
        Number plane(static_cast<float>(static_cast<std::int32_t>(hash)));
        int bit = sign_bit;
        ((plane = plane + turned(hash, bit--, steepness * distances)), ...);
        return plane;
    } else {
        const Axis<Number>& axis = cell[sizeof...(Distances)];
        const Number low =
            blended(stirred(hash + axis.name * name_step), cell, distances..., axis.from_lower);
        const Number high =
            blended(stirred(hash + (axis.name + 1) * name_step), cell, distances..., axis.from_upper);
        return low + axis.upper_weight * (high - low);
    }
}

/// Lattice::softness times the variance that the sum has at this place in a cell, over all cells.
template <class Number, std::size_t dimensions>
[[nodiscard]] Number expected_square(const std::array<Axis<Number>, dimensions>& cell) noexcept {
    Number heights(1.0F), slopes(0.0F);
    for (const Axis<Number>& axis : cell) {
        const Number &upper = axis.upper_weight, lower = Number(1.0F) - upper;
        const Number squares = lower * lower + upper * upper;
        const Number lower_part = lower * axis.from_lower, upper_part = upper * axis.from_upper;
        slopes = slopes * squares + heights * (lower_part * lower_part + upper_part * upper_part);
        heights = heights * squares;
    }
    return Number(Lattice<dimensions>::heights) * heights + Number(Lattice<dimensions>::slopes) * slopes;
}

template <class Number, std::size_t dimensions>
[[nodiscard]] Number noise_in(const std::array<Axis<Number>, dimensions>& cell, std::uint32_t seed) noexcept {
    const Number sum = blended(mixed(seed), cell) * Number(0x1p-31F);
    return over_root(sum, expected_square(cell) + sum * sum);
}

template <std::size_t dimensions>
[[nodiscard]] float value_at(const std::array<double, dimensions>& place, std::uint32_t seed) noexcept {
    std::array<Axis<float>, dimensions> cell{};
    for (std::size_t axis = 0; axis < dimensions; ++axis) {
        const Coordinate x(place[axis]);
        cell[axis] = axis_at(static_cast<float>(x.within), x.whole);
    }
    return noise_in(cell, seed);
}

template <std::size_t dimensions>
[[nodiscard]] std::array<float, dimensions> slope_at(const std::array<double, dimensions>& place,
                                                     std::uint32_t seed) noexcept {
    using Number = Jet<dimensions>;
    return [&]<std::size_t... axis>(std::index_sequence<axis...> /*axes*/) {
        const std::array<Coordinate, dimensions> x{Coordinate(place[axis])...};
        const std::array cell{axis_at(Number(static_cast<float>(x[axis].within), axis), x[axis].whole)...};
        return noise_in(cell, seed).slope;
    }
    (std::make_index_sequence<dimensions>());
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

template <glm::length_t size>
[[nodiscard]] bool has_nan(const glm::vec<size, double>& place) noexcept {
    for (glm::length_t axis = 0; axis < size; ++axis)
        if (std::isnan(place[axis])) return true;
    return false;
}

template <class T>
[[nodiscard]] std::array<double, 2> numbers(const glm::vec<2, T>& place) noexcept {
    return {place.x, place.y};
}
template <class T>
[[nodiscard]] std::array<double, 3> numbers(const glm::vec<3, T>& place) noexcept {
    return {place.x, place.y, place.z};
}

template <int dimensions>
[[nodiscard]] std::span<const float> numbers_of(
    std::span<const glm::vec<dimensions, float>> places) noexcept {
    return {places.empty() ? nullptr : &places[0].x, dimensions * places.size()};
}

/// Those of the places that the kernels do not know, one by one.
void fill_far(std::size_t dimensions, std::span<const float> places, std::uint32_t seed,
              std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::span<const float> place = places.subspan(dimensions * i, dimensions);
        if (std::ranges::all_of(place, [](float number) { return std::abs(number) <= near; })) continue;
        if (dimensions == 1)
            out[i] = value(place[0], seed);
        else if (dimensions == 2)
            out[i] = value(glm::dvec2(place[0], place[1]), seed);
        else
            out[i] = value(glm::dvec3(place[0], place[1], place[2]), seed);
    }
}

void fill(std::size_t dimensions, std::span<const float> places, std::uint32_t seed, std::span<float> out) {
    require(places.size() == dimensions * out.size(), "out: must have a number for each place");
    const auto fill_by = noise_kernels().back().fill[dimensions - 1];
    in_ieee_floats([&] {
        for (std::size_t begin = 0; begin < out.size(); begin += noise_block) {
            const std::size_t count = std::min(noise_block, out.size() - begin);
            const float* const from = &places[dimensions * begin];
            bool are_near = false;
            if (count == noise_block) {
                are_near = fill_by(from, seed, &out[begin]);
            } else {
                std::array<float, 3 * noise_block> padded{};
                std::array<float, noise_block> found{};
                std::copy_n(from, dimensions * count, padded.begin());
                are_near = fill_by(padded.data(), seed, found.data());
                std::copy_n(found.begin(), count, &out[begin]);
            }
            if (!are_near)
                fill_far(dimensions, places.subspan(dimensions * begin, dimensions * count), seed,
                         out.subspan(begin, count));
        }
    });
}

}  // namespace

float value(double place, std::uint32_t seed) noexcept {
    if (std::isnan(place)) return not_a_number;
    return in_ieee_floats([&] { return value_at(place, seed); });
}
float value(const glm::dvec2& place, std::uint32_t seed) noexcept {
    if (has_nan(place)) return not_a_number;
    return in_ieee_floats([&] { return value_at(numbers(place), seed); });
}
float value(const glm::dvec3& place, std::uint32_t seed) noexcept {
    if (has_nan(place)) return not_a_number;
    return in_ieee_floats([&] { return value_at(numbers(place), seed); });
}

float looped(double place, std::uint32_t period, std::uint32_t seed) {
    require(period > 0 && period <= longest_period, "period: must be from 1 to 2^28");
    if (!std::isfinite(place)) return not_a_number;
    const double within = std::fmod(place, period);
    const std::uint32_t halves = 2 * period;
    return in_ieee_floats([&] {
        return value_at(within < 0.0 ? within + period : within, seed,
                        [&](std::uint32_t name) { return (name + halves) % halves; });
    });
}

double steps(double place, double blend, std::uint32_t seed) {
    require(blend >= 0.0 && blend <= 1.0, "blend: must be from 0 to 1");
    if (std::isnan(place)) return place;
    const Coordinate at(place);
    const double now = height_of(hash_of(at.whole, seed));
    if (at.within >= blend) return now;
    const double before = height_of(hash_of(at.whole - 1U, seed));
    return before + (now - before) * smooth_step(at.within / blend);
}

float gradient(double place, std::uint32_t seed) noexcept {
    if (std::isnan(place)) return not_a_number;
    return in_ieee_floats([&] { return slope_at(place, seed); });
}
glm::vec2 gradient(const glm::dvec2& place, std::uint32_t seed) noexcept {
    if (has_nan(place)) return glm::vec2(not_a_number);
    const auto slope = in_ieee_floats([&] { return slope_at(numbers(place), seed); });
    return {slope[0], slope[1]};
}
glm::vec3 gradient(const glm::dvec3& place, std::uint32_t seed) noexcept {
    if (has_nan(place)) return glm::vec3(not_a_number);
    const auto slope = in_ieee_floats([&] { return slope_at(numbers(place), seed); });
    return {slope[0], slope[1], slope[2]};
}

void values(std::span<const float> places, std::uint32_t seed, std::span<float> out) {
    fill(1, places, seed, out);
}
void values(std::span<const glm::vec2> places, std::uint32_t seed, std::span<float> out) {
    fill(2, numbers_of(places), seed, out);
}
void values(std::span<const glm::vec3> places, std::uint32_t seed, std::span<float> out) {
    fill(3, numbers_of(places), seed, out);
}

}  // namespace motus::noise
