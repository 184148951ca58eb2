// Numbers and hashes that the noise is made of. Private to the library.
#pragma once
#include <cstddef>
#include <cstdint>

namespace motus::noise {

/// Coordinates beyond are taken for this, so that names of lattice points are whole numbers of 32 bits.
inline constexpr float farthest = 0x1p30F;

inline constexpr std::uint32_t first_mixer = 0x7feb352dU;
inline constexpr std::uint32_t second_mixer = 0x846ca68bU;

/// Factor of a lattice point's coordinate on each axis before the hash.
inline constexpr std::uint32_t name_step = 0x9e3779b9U;

/// A bijection of 32 bits in which each bit of the result depends on each bit given. Mueller, "Hash Function
/// Prospecting" (2018), lowbias32.
[[nodiscard]] constexpr std::uint32_t mixed(std::uint32_t bits) noexcept {
    bits = (bits ^ (bits >> 16U)) * first_mixer;
    bits = (bits ^ (bits >> 15U)) * second_mixer;
    return bits ^ (bits >> 16U);
}

/// The first step of mixed(): enough for bits 13 and up, which alone are looked at, where it is taken once
/// for each axis.
[[nodiscard]] constexpr std::uint32_t stirred(std::uint32_t bits) noexcept {
    return (bits ^ (bits >> 16U)) * first_mixer;
}

/// From this bit of a hash on, downwards, the signs of a slope's coordinates.
inline constexpr int sign_bit = 15;

/// The line's bumps. steepness: of their slopes. bound: what the sum of all of them never passes.
namespace line {
inline constexpr float steepness = 1.5F;
inline constexpr float bound = 2.63F;
}  // namespace line

/// The lattice in the plane and in space. steepness: each coordinate of a slope, but for its sign; such that
/// the noise is about as steep at lattice points as between them. softness: the noise is z / sqrt(softness +
/// z^2), where z is the sum over its standard deviation at this place in a cell. heights, slopes: what the
/// variances of both count in softness times that deviation's square; heights are spread evenly over [-1, 1].
template <std::size_t dimensions>
struct Lattice {
    static constexpr float steepness = dimensions == 2 ? 1.7F : 1.85F;
    static constexpr float softness = 14.0F;
    static constexpr float heights = softness / 3.0F;
    static constexpr float slopes = softness * steepness * steepness;
};

}  // namespace motus::noise
