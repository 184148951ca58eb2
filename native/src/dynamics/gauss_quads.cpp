// Compiled for AVX2, whatever else is not: see CMakeLists.txt.
#include "step_lanes.hpp"

#if defined(__AVX2__)
namespace motus::dynamics {

void make_single_steps_in_quads(std::span<GaussStep<SingleSystem>> steps) {
    make_gauss_steps<Quad, SingleSystem>(steps);
}

void make_double_steps_in_quads(std::span<GaussStep<DoubleSystem>> steps) {
    make_gauss_steps<Quad, DoubleSystem>(steps);
}

}  // namespace motus::dynamics
#endif
