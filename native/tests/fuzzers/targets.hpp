// What a fuzzer calls: each of these reads arguments from bytes, calls a topic's functions with them, and
// looks at what comes of it. Programs for libFuzzer, one for each, are built by CMake's preset `fuzz`; what
// these found worth keeping lies in corpus/, and the ordinary tests go through all of it.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "extreme_numbers.hpp"

namespace motus::fuzzers {

/// That the library has broken a promise.
class Broken : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

inline void expect(bool holds, const char* what) {
    if (!holds) throw Broken(what);
}

/// Whether a call returns. What it throws instead is std::invalid_argument, and names an argument.
template <class Call>
bool returns(const Call& call) {
    try {
        call();
    } catch (const std::invalid_argument& problem) {
        if (!test::names_an_argument(problem.what()))
            throw Broken(std::string("a message that names no argument: ") + problem.what());
        return false;
    }
    return true;
}

/// Throw Broken, or whatever the library is not to throw.
void try_curve(std::span<const std::uint8_t> bytes);
void try_clip(std::span<const std::uint8_t> bytes);
void try_mesh(std::span<const std::uint8_t> bytes);
void try_snow(std::span<const std::uint8_t> bytes);

struct Target {
    std::string_view name;
    void (*run)(std::span<const std::uint8_t>);
};
inline constexpr std::array targets{Target{"curve", try_curve}, Target{"clip", try_clip},
                                    Target{"mesh", try_mesh}, Target{"snow", try_snow}};

}  // namespace motus::fuzzers
