#include <array>
#include <span>

#include "motus/core/instruction_sets.hpp"
#include "two_bone_lanes.hpp"

// This include compiles the file once for each of Highway's targets; code for no target stands at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "two_bone_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "two_bone_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::bones::chains::HWY_NAMESPACE {
namespace {

/// More than four chains at once are no faster: their numbers do not fit into the registers.
using Several = UpTo<4>;

HWY_NOINLINE Vector<Several> faded(Sides<Several> side) {
    return faded_normal(side);
}

void solve(std::span<const TwoBone> chains, std::span<TwoBoneSolution> out) {
    solve_in_lanes<Several>(chains, faded, out);
}

constexpr TwoBoneKernel kernel{HWY_STR(HWY_NAMESPACE), &solve};

}  // namespace
}  // namespace motus::bones::chains::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::bones::chains {

std::span<const TwoBoneKernel> two_bone_kernels() {
    static const Kernels<TwoBoneKernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

}  // namespace motus::bones::chains
#endif
