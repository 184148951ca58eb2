#include <cstring>

#include "kernel.hpp"
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace motus::snow {
namespace {

#include "kernel_loops.inc"

}  // namespace

const Kernel base_kernel{"base", &stream_ages, &draw_lives, &fill};

}  // namespace motus::snow
