// Arrays as long as any chain, of which a short one fills only the beginning. Private to the library.
#pragma once
#include <glm/vec3.hpp>

#include "motus/bones/chains/chain.hpp"
#include "motus/core/unfilled.hpp"

namespace motus::bones::chains {

template <class T>
using PerBone = Unfilled<T, most_bones>;

/// Joints, of which there is one more.
using PerJoint = Unfilled<glm::dvec3, most_bones + 1>;

}  // namespace motus::bones::chains
