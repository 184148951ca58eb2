// Which instruction sets this processor has, of those that inner loops are compiled for. For the topics of
// the library alone.
#pragma once
#include <cstddef>

namespace motus {

/// How many of them, each with those before it: the one that all processors have, AVX2, and AVX-512 (F, VL,
/// DQ and BW).
[[nodiscard]] inline std::size_t runnable_sets() {
#if defined(__x86_64__)
    static const std::size_t count = [] {
        if (!__builtin_cpu_supports("avx2")) return std::size_t{1};
        const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                                __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
        return has_avx512 ? std::size_t{3} : std::size_t{2};
    }();
    return count;
#else
    return 1;
#endif
}

}  // namespace motus
