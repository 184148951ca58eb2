// A rig's bones as the arrays that Blender's foreach_get fills.
//
// Costs: O(1) a bone. Allocates nothing. Any number of threads at once.
#pragma once
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <span>

#include "motus/bones/bone.hpp"
#include "motus/config.hpp"

namespace motus::bones {

/// Flags of one bone in RigView::inheritance, beside InheritScale in the lowest three bits.
inline constexpr int inherits_rotation = 8;
inline constexpr int has_local_location = 16;

/// The arrays of a rig's bones, in the order of its pose. Matrices are 16 floats, column by column, in
/// armature space.
struct RigArrays {
    std::span<const int> parents;      ///< index of each bone's parent, -1 for none
    std::span<const float> rest;       ///< Bone.matrix_local
    std::span<const float> poses;      ///< PoseBone.matrix; read of the parents of chains alone, which are
                                       ///< evaluated before; or empty
    std::span<const float> basis;      ///< PoseBone.matrix_basis: the animated (FK) transform; or empty
    std::span<const float> lengths;    ///< Bone.length; or empty
    std::span<const int> inheritance;  ///< InheritScale | inherits_rotation | has_local_location
};

/// A view of arrays that fit together, which are the caller's: what reads a rig takes one, and asks only
/// whether what may be empty is there.
class RigView {
  public:
    RigView() = default;  ///< of no bones
    /// std::invalid_argument if an array does not have as many bones as `parents`, or a parent is none of
    /// them.
    RigView(const RigArrays& arrays);

    [[nodiscard]] std::size_t size() const noexcept { return arrays_.parents.size(); }
    [[nodiscard]] std::span<const int> parents() const noexcept { return arrays_.parents; }
    [[nodiscard]] std::span<const float> rest() const noexcept { return arrays_.rest; }
    [[nodiscard]] std::span<const int> inheritance() const noexcept { return arrays_.inheritance; }
    [[nodiscard]] std::span<const float> poses() const noexcept { return arrays_.poses; }
    [[nodiscard]] std::span<const float> basis() const noexcept { return arrays_.basis; }
    [[nodiscard]] std::span<const float> lengths() const noexcept { return arrays_.lengths; }

  private:
    RigArrays arrays_;
};

/// std::invalid_argument if there is no matrix of that bone.
[[nodiscard]] glm::dmat4 matrix_at(std::span<const float> matrices, std::size_t bone);

/// The bone at rest. std::invalid_argument if the rig has no such bone.
[[nodiscard]] Rest rest_of(const RigView& rig, std::size_t bone);

}  // namespace motus::bones
