// Compiled for AVX-512, whatever else is not: see CMakeLists.txt.
#include "step_lanes.hpp"

#if defined(__AVX512F__)
namespace motus::dynamics {

void make_single_steps_in_octets(std::span<GaussStep<SingleSystem>> steps) {
    make_gauss_steps<Wide<8>, SingleSystem>(steps);
}

void make_double_steps_in_octets(std::span<GaussStep<DoubleSystem>> steps) {
    make_gauss_steps<Wide<8>, DoubleSystem>(steps);
}

}  // namespace motus::dynamics
#endif
