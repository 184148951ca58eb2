#include "pull_kernel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace motus::sculpt {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// None of the sets may use FMA, which rounds otherwise.
// NOLINTBEGIN(readability-duplicate-include): once for each set
namespace base {
constexpr const char* name = "base";
constexpr int lanes = 4;
#include "lanes.inc"
#include "shape_loops.inc"
#include "vertex_loops.inc"
}  // namespace base

#if defined(__x86_64__)
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
constexpr const char* name = "AVX2";
constexpr int lanes = 8;
#include "lanes.inc"
#include "shape_loops.inc"
#include "vertex_loops.inc"
}  // namespace avx2
#if defined(__clang__)
#pragma clang attribute pop
#pragma clang attribute push(__attribute__((target("avx512f,avx512vl,avx512dq,avx512bw"))), \
                             apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512dq,avx512bw,prefer-vector-width=512")
#endif
namespace avx512 {
constexpr const char* name = "AVX-512";
constexpr int lanes = 16;
#include "lanes.inc"
#include "shape_loops.inc"
#include "vertex_loops.inc"
}  // namespace avx512
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif
// NOLINTEND(readability-duplicate-include)

#if defined(__x86_64__)
constexpr std::array kernels{base::kernel, avx2::kernel, avx512::kernel};
#else
constexpr std::array kernels{base::kernel};
#endif

[[nodiscard]] std::size_t runnable_kernels() {
#if defined(__x86_64__)
    const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
    return has_avx512 ? 3 : __builtin_cpu_supports("avx2") ? 2 : 1;
#else
    return 1;
#endif
}

}  // namespace

std::span<const PullKernel> pull_kernels() {
    static const std::size_t count = runnable_kernels();
    return std::span(kernels).first(count);
}

}  // namespace motus::sculpt
