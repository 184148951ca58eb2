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

#include "motus/core/instruction_sets.hpp"

namespace motus::sculpt {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

#define MOTUS_LOOPS "vertex_loops.inc"
#include "motus/core/every_set.inc"
#undef MOTUS_LOOPS

}  // namespace

std::span<const PullKernel> pull_kernels() {
    return std::span(kernels).first(runnable_sets());
}

}  // namespace motus::sculpt
