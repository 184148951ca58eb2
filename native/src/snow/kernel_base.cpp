#include "kernel.hpp"

namespace motus::snow {
namespace {

#include "kernel_loops.inc"

}  // namespace

const Kernel base_kernel{"base", &stream_ages, &draw_lives, &fill};

}  // namespace motus::snow
