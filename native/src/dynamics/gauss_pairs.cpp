#include "motion.hpp"
#include "step_lanes.hpp"

namespace motus::dynamics {
namespace {

#if defined(__x86_64__)
constexpr std::array kernels{
    StepKernel{"pairs", &make_gauss_steps<Pair, SingleSystem>, &make_gauss_steps<Pair, DoubleSystem>},
    StepKernel{"AVX2", &make_single_steps_in_quads, &make_double_steps_in_quads},
    StepKernel{"AVX-512", &make_single_steps_in_octets, &make_double_steps_in_octets}};

[[nodiscard]] std::size_t runnable() {
    if (!__builtin_cpu_supports("avx2")) return 1;
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") ? 3 : 2;
}
#else
constexpr std::array kernels{
    StepKernel{"pairs", &make_gauss_steps<Pair, SingleSystem>, &make_gauss_steps<Pair, DoubleSystem>}};

[[nodiscard]] std::size_t runnable() {
    return 1;
}
#endif

}  // namespace

std::span<const StepKernel> step_kernels() {
    static const std::size_t count = runnable();
    return std::span(kernels).first(count);
}

}  // namespace motus::dynamics
