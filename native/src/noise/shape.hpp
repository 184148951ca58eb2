// The bumps of which the noise is the sum: what differs between the dimensions. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace motus::noise {

/// The factors of mixed().
inline constexpr std::uint32_t first_mixer = 0x7feb352dU;
inline constexpr std::uint32_t second_mixer = 0x846ca68bU;

/// A bijection of 32 bits in which each bit of the result depends on each bit given. Mueller, "Hash Function
/// Prospecting" (2018), lowbias32.
[[nodiscard]] constexpr std::uint32_t mixed(std::uint32_t bits) noexcept {
    bits = (bits ^ (bits >> 16U)) * first_mixer;
    bits = (bits ^ (bits >> 15U)) * second_mixer;
    return bits ^ (bits >> 16U);
}

template <std::size_t dimensions>
using Vector = std::array<float, dimensions>;

/// What differs between the dimensions. steepness: of the slopes, all of one length. bound: what the sum of
/// all bumps never passes. directions: of the slopes, spread evenly. shorter, longer: sizes of their
/// coordinates.
template <std::size_t dimensions>
struct Shape;

template <>
struct Shape<1> {
    static constexpr float steepness = 1.5F;
    static constexpr float bound = 2.63F;
    static constexpr float shorter = 1.0F;
    static constexpr float longer = 1.0F;
    static constexpr std::array<Vector<1>, 2> directions{{{1.0F}, {-1.0F}}};
};

template <>
struct Shape<2> {
    static constexpr float steepness = 1.25F;
    static constexpr float bound = 2.75F;
    // Every 22.5 degrees: cosine and sine of that, and of 45 degrees.
    static constexpr float c = 0.923879533F;
    static constexpr float s = 0.382683432F;
    static constexpr float d = 0.707106781F;
    static constexpr float shorter = s;
    static constexpr float longer = c;
    static constexpr float diagonal = d;
    static constexpr std::array<Vector<2>, 16> directions{{{1, 0},
                                                           {c, s},
                                                           {d, d},
                                                           {s, c},
                                                           {0, 1},
                                                           {-s, c},
                                                           {-d, d},
                                                           {-c, s},
                                                           {-1, 0},
                                                           {-c, -s},
                                                           {-d, -d},
                                                           {-s, -c},
                                                           {0, -1},
                                                           {s, -c},
                                                           {d, -d},
                                                           {c, -s}}};
};

template <>
struct Shape<3> {
    static constexpr float steepness = 2.0F;
    static constexpr float bound = 2.90F;
    // The vertices of a rhombicuboctahedron: (1, 1, 1 + sqrt(2)) over its length, in any order and with any
    // signs.
    static constexpr float a = 0.357406744F;
    static constexpr float b = 0.862856209F;
    static constexpr float shorter = a;
    static constexpr float longer = b;
    static constexpr std::array<Vector<3>, 24> directions{
        {{a, a, b}, {a, a, -b}, {a, -a, b}, {a, -a, -b}, {-a, a, b}, {-a, a, -b}, {-a, -a, b}, {-a, -a, -b},
         {a, b, a}, {a, b, -a}, {a, -b, a}, {a, -b, -a}, {-a, b, a}, {-a, b, -a}, {-a, -b, a}, {-a, -b, -a},
         {b, a, a}, {b, a, -a}, {b, -a, a}, {b, -a, -a}, {-b, a, a}, {-b, a, -a}, {-b, -a, a}, {-b, -a, -a}}};
};

/// What the corner of a cell has its name multiplied by, on each axis, before it is mixed.
inline constexpr std::uint32_t name_step = 0x9e3779b9U;

}  // namespace motus::noise
