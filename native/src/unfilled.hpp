// Arrays as long as any chain, of which a short one fills only the beginning. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "motus/chain.hpp"

namespace motus {

/// An array whose elements are not set to anything before they are written: for a short chain that would take
/// longer than to solve it.
template <class T, std::size_t size>
struct Unfilled : std::array<T, size> {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init,modernize-use-equals-default)
    Unfilled() {}
};

template <class T>
using PerBone = Unfilled<T, largest_chain>;

/// Joints, of which there is one more.
using PerJoint = Unfilled<glm::dvec3, largest_chain + 1>;

}  // namespace motus
