// A program of libFuzzer for one of the targets: MOTUS_FUZZED names its function.
#include <cstddef>
#include <cstdint>

#include "targets.hpp"

// What libFuzzer calls, by this name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    motus::fuzzers::MOTUS_FUZZED({bytes, count});
    return 0;
}
