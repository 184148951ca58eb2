// Two bones, many chains at once. Private to the library.
#pragma once
#include <limits>
#include <span>

#include "motus/bones/chains/two_bone.hpp"

namespace motus::bones::chains {

inline constexpr double largest_double = std::numeric_limits<double>::max();

/// The line from root to target for a target that nearly lies on the root: towards the pole, if the elbow can
/// be there.
[[nodiscard]] glm::dvec3 line_of_coincident(const TwoBone& chain, glm::dvec3 target, glm::dvec3 pole);

/// solve_two_bone() for one chain of any sizes.
void solve_one(const TwoBone& chain, TwoBoneSolution& out);

/// Functions that solve many chains, for one instruction set; all sets give the same bits.
struct TwoBoneKernel {
    const char* name;
    void (*solve)(std::span<const TwoBone> chains, std::span<TwoBoneSolution> out);
};

/// The kernels that this processor can run, the fastest last.
[[nodiscard]] std::span<const TwoBoneKernel> two_bone_kernels();

}  // namespace motus::bones::chains
