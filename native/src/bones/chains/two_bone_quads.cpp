// Compiled for AVX2, whatever else is not: see CMakeLists.txt.
#include "two_bone_lanes.hpp"

#if defined(__AVX2__)
namespace motus::bones::chains {

void solve_quads(std::span<const TwoBone> chains, std::span<TwoBoneSolution> out) {
    solve_in_lanes<Quad>(chains, out);
}

}  // namespace motus::bones::chains
#endif
