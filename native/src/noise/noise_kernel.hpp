// The inner loops of values(), compiled for several instruction sets. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace motus::noise {

/// Places worked on at once, a multiple of every set's lanes.
inline constexpr std::size_t noise_block = 256;

/// Largest number that the kernels know.
inline constexpr float near = 0x1p22F;

/// Noise at noise_block places for one instruction set; all sets give the bits of value(). fill[d - 1]: of d
/// dimensions, the numbers of a place after each other; whether all of them are near. What is written for
/// places of which one is not, or is NaN, means nothing.
struct NoiseKernel {
    const char* name;
    std::array<bool (*)(const float* places, std::uint32_t seed, float* out), 3> fill;
};

/// The kernels that this processor can run, the fastest last.
[[nodiscard]] std::span<const NoiseKernel> noise_kernels();

}  // namespace motus::noise
