// Random numbers by a counter, Philox 4x32-10: Salmon, Moraes, Dror, Shaw, "Parallel Random Numbers: As Easy
// as 1, 2, 3" (2011). Private to the library.
#pragma once
#include <cstdint>

namespace motus::snow {

struct Key {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
};

struct Words {
    std::uint32_t a = 0, b = 0, c = 0, d = 0;
};

inline constexpr int philox_rounds = 10;
inline constexpr std::uint32_t philox_factor_of_a = 0xd2511f53U, philox_factor_of_c = 0xcd9e8d57U;

/// From one round to the next.
[[nodiscard]] inline Key next_key(Key key) {
    return {key.low + 0x9e3779b9U, key.high + 0xbb67ae85U};
}

[[nodiscard]] inline Words philox_round(Words counter, Key key) {
    const std::uint64_t first = std::uint64_t{philox_factor_of_a} * counter.a;
    const std::uint64_t second = std::uint64_t{philox_factor_of_c} * counter.c;
    return {
        static_cast<std::uint32_t>(second >> 32U) ^ counter.b ^ key.low, static_cast<std::uint32_t>(second),
        static_cast<std::uint32_t>(first >> 32U) ^ counter.d ^ key.high, static_cast<std::uint32_t>(first)};
}

/// A bijection of the counter for each key.
[[nodiscard]] inline Words philox(Words counter, Key key) {
    for (int round = 0; round < philox_rounds; ++round) {
        counter = philox_round(counter, key);
        key = next_key(key);
    }
    return counter;
}

/// In [0, 1), of the word's upper 24 bits.
[[nodiscard]] inline float fraction(std::uint32_t word) {
    return static_cast<float>(static_cast<std::int32_t>(word >> 8U)) * 0x1p-24F;
}

}  // namespace motus::snow
