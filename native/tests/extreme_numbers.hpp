// Numbers that formulas do not expect, and what messages of exceptions look like: for programs without Catch2
// too.
#pragma once
#include <array>
#include <cctype>
#include <cstddef>
#include <limits>
#include <string_view>

namespace motus::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double largest = std::numeric_limits<double>::max();

/// Zeros, the smallest and the largest numbers of both precisions, the ends of whole numbers, and no numbers.
inline constexpr std::array extremes{0.0,
                                     -0.0,
                                     std::numeric_limits<double>::denorm_min(),
                                     1e-310,
                                     -std::numeric_limits<double>::min(),
                                     1e-200,
                                     1e-150,
                                     -1e-45,
                                     1.2e-38,
                                     1e-16,
                                     1e-6,
                                     -0.5,
                                     1.0,
                                     -1.0,
                                     6.283185307179586,
                                     -1000.0,
                                     1e6,
                                     2147483648.0,
                                     -4294967296.0,
                                     0x1p53,
                                     -1e18,
                                     1e30,
                                     3.5e38,
                                     -1e100,
                                     1e154,
                                     -1e200,
                                     1e300,
                                     -1e300,
                                     largest,
                                     -largest,
                                     infinity,
                                     -infinity,
                                     not_a_number};

/// Whether a message begins with the name of an argument, a word in small letters, and a colon.
[[nodiscard]] inline bool names_an_argument(std::string_view message) {
    const std::size_t end = message.find(": ");
    if (end == 0 || end == std::string_view::npos) return false;
    for (const char letter : message.substr(0, end))
        if (std::islower(letter) == 0 && std::isdigit(letter) == 0 && letter != '_') return false;
    return true;
}

}  // namespace motus::test
