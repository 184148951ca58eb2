// Which instruction sets this processor has, of those that inner loops are compiled for. For the topics of
// the library alone.
#pragma once
#include <array>
#include <cstddef>

namespace motus {

/// How many of these sets the processor has, in an order in which each includes those before: the one that
/// all processors have, AVX2, and AVX-512 (F, VL, DQ and BW).
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

/// How many of Highway's targets (MOTUS_EVERY_TARGET) the processor has; SSE4 comes before AVX2. Highway's
/// own function that asks the processor is in a shared library, which an add-on could not bring along.
[[nodiscard]] inline std::size_t runnable_targets() {
#if defined(__x86_64__)
    return runnable_sets() > 1 || __builtin_cpu_supports("sse4.2") ? runnable_sets() + 1 : 1;
#else
    return 1;
#endif
}

/// The name of the widest of Highway's targets that the processor has.
[[nodiscard]] inline const char* instruction_set() {
#if defined(__x86_64__)
    static constexpr std::array names{"SSE2", "SSE4", "AVX2", "AVX-512"};
    return names[runnable_targets() - 1];
#elif defined(__aarch64__)
    return "NEON";
#else
    return "that of all processors of this kind";
#endif
}

}  // namespace motus

/// The functions of this name in each target's namespace, with commas between, for a source that
/// <hwy/foreach_target.h> includes once for each target.
#if defined(__x86_64__)
#define MOTUS_EVERY_TARGET(name) HWY_STATIC_DISPATCH(name), N_SSE4::name, N_AVX2::name, N_AVX3::name
#else
#define MOTUS_EVERY_TARGET(name) HWY_STATIC_DISPATCH(name)
#endif
