// Steps that are compiled for other instructions than the rest. Private to the library.
#pragma once
#include "motion.hpp"

namespace motus::dynamics {

void make_single_steps_in_quads(std::span<GaussStep<SingleSystem>> steps);
void make_double_steps_in_quads(std::span<GaussStep<DoubleSystem>> steps);
void make_single_steps_in_octets(std::span<GaussStep<SingleSystem>> steps);
void make_double_steps_in_octets(std::span<GaussStep<DoubleSystem>> steps);

}  // namespace motus::dynamics
