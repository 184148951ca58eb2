#include "noise_kernel.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "motus/core/instruction_sets.hpp"
#include "shape.hpp"

namespace motus::noise {
namespace {

#define MOTUS_LOOPS "noise_loops.inc"
#include "motus/core/every_set.inc"
#undef MOTUS_LOOPS

}  // namespace

std::span<const NoiseKernel> noise_kernels() {
    return std::span(kernels).first(runnable_sets());
}

}  // namespace motus::noise
