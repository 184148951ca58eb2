#include "motion.hpp"
#include "motus/core/instruction_sets.hpp"
#include "step_lanes.hpp"

namespace motus::dynamics {
namespace {

#if defined(__x86_64__)
constexpr std::array kernels{
    StepKernel{"pairs", &make_gauss_steps<Pair, SingleSystem>, &make_gauss_steps<Pair, DoubleSystem>},
    StepKernel{"AVX2", &make_single_steps_in_quads, &make_double_steps_in_quads},
    StepKernel{"AVX-512", &make_single_steps_in_octets, &make_double_steps_in_octets}};
#else
constexpr std::array kernels{
    StepKernel{"pairs", &make_gauss_steps<Pair, SingleSystem>, &make_gauss_steps<Pair, DoubleSystem>}};
#endif

}  // namespace

std::span<const StepKernel> step_kernels() {
#if defined(__x86_64__)
    return std::span(kernels).first(has_target(HWY_AVX3) ? 3 : has_target(HWY_AVX2) ? 2 : 1);
#else
    return kernels;
#endif
}

}  // namespace motus::dynamics
