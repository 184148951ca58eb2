// What clang's __builtin_cpu_supports reads, as the runtime libraries of GCC and clang have it and zig's does
// not: a bit for each feature that the processor has and the system keeps the registers of. Those that
// core/instruction_sets.hpp asks for alone.
#include <cpuid.h>

extern "C" {

struct ProcessorModel {
    unsigned vendor, type, subtype, features[1];
};

__attribute__((visibility("hidden"))) ProcessorModel __cpu_model;

}  // extern "C"

namespace {

// The numbers of the bits, which GCC and clang share.
constexpr unsigned SSE42 = 1U << 8, AVX2 = 1U << 10, AVX512F = 1U << 15, AVX512VL = 1U << 20,
                   AVX512BW = 1U << 21, AVX512DQ = 1U << 22;

// The registers that the system keeps: SSE's and AVX's, and AVX-512's beside these.
constexpr unsigned KEPT_AVX = 0x06, KEPT_AVX512 = 0xE6;

unsigned kept_registers() {
    unsigned low, high;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

// Before all other constructors.
__attribute__((constructor(101))) void ask_the_processor() {
    unsigned a, b, c, d;
    if (!__get_cpuid(1, &a, &b, &c, &d)) return;
    unsigned features = (c & bit_SSE4_2) ? SSE42 : 0;
    const unsigned kept = (c & bit_OSXSAVE) ? kept_registers() : 0;
    if ((kept & KEPT_AVX) == KEPT_AVX && __get_cpuid_count(7, 0, &a, &b, &c, &d)) {
        if (b & bit_AVX2) features |= AVX2;
        if ((kept & KEPT_AVX512) == KEPT_AVX512) {
            if (b & bit_AVX512F) features |= AVX512F;
            if (b & bit_AVX512VL) features |= AVX512VL;
            if (b & bit_AVX512BW) features |= AVX512BW;
            if (b & bit_AVX512DQ) features |= AVX512DQ;
        }
    }
    __cpu_model.features[0] = features;
}

}  // namespace
