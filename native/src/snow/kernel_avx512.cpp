// Compiled for this instruction set, whatever else is not: see CMakeLists.txt.
#include <cstring>

#include "kernel.hpp"

#if defined(__x86_64__)
#include <immintrin.h>

namespace motus::snow {
namespace {

#include "kernel_loops.inc"

}  // namespace

const Kernel avx512_kernel{"AVX-512", &stream_ages, &draw_lives, &fill};

}  // namespace motus::snow
#endif
