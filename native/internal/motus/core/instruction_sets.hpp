// Which instruction sets this processor has, of those that inner loops are compiled for. For the topics of
// the library alone.
#pragma once
#include <hwy/detect_targets.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace motus {

/// Whether the processor has what one of Highway's targets is compiled to, beyond what all processors of its
/// kind have. Highway's own function that asks the processor is in a shared library, which an add-on could
/// not bring along.
[[nodiscard]] inline bool has_target(std::int64_t target) {
#if defined(__x86_64__)
    switch (target) {
        case HWY_SSE4:
            return __builtin_cpu_supports("sse4.2");
        case HWY_AVX2:
            return __builtin_cpu_supports("avx2");
        case HWY_AVX3:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
        default:
            return false;
    }
#else
    static_cast<void>(target);
    return false;
#endif
}

/// The name of the widest of Highway's targets that the processor has.
[[nodiscard]] inline const char* instruction_set() {
#if defined(__x86_64__)
    if (has_target(HWY_AVX3)) return "AVX-512";
    if (has_target(HWY_AVX2)) return "AVX2";
    return has_target(HWY_SSE4) ? "SSE4" : "SSE2";
#elif defined(__aarch64__)
    return "NEON";
#else
    return "that of all processors of this kind";
#endif
}

/// What is there for several of Highway's targets, as functions in a struct: those that the processor can
/// run.
template <class Kernel>
class Kernels {
  public:
    /// `of_targets`: as MOTUS_EVERY_TARGET lists them.
    explicit Kernels(const std::array<const Kernel*, HWY_MAX_DYNAMIC_TARGETS + 1>& of_targets) {
        constexpr int lowest_bit = HWY_HIGHEST_TARGET_BIT + 1 - HWY_MAX_DYNAMIC_TARGETS;
        const Kernel* const of_all = of_targets.back();
        add(*of_all);
        for (int i = HWY_MAX_DYNAMIC_TARGETS - 1; i >= 0; --i) {
            const Kernel* const kernel = of_targets[static_cast<std::size_t>(i)];
            if (kernel != nullptr && kernel != of_all && has_target(std::int64_t{1} << (lowest_bit + i)))
                add(*kernel);
        }
    }

    /// The widest last.
    [[nodiscard]] std::span<const Kernel> runnable() const { return std::span(kernels_).first(count_); }

  private:
    void add(const Kernel& kernel) { kernels_[count_++] = kernel; }

    std::array<Kernel, HWY_MAX_DYNAMIC_TARGETS + 1> kernels_{};
    std::size_t count_ = 0;
};

}  // namespace motus

/// Pointers to what has this name in each target's namespace, null where there is none, the widest first; the
/// one that all processors have is the last. For a source that <hwy/foreach_target.h> includes once for each
/// target.
#define MOTUS_EVERY_TARGET(name) HWY_CHOOSE_TARGET_LIST(name), HWY_CHOOSE_FALLBACK(name)
