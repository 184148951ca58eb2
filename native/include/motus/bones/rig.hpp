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

/// All bones of one rig, in the order of its pose; views of the caller's arrays. Matrices are 16 floats,
/// column by column, in armature space. Of `poses` only those of the parents of chains are read, which are
/// evaluated before.
struct RigView {
    std::span<const int> parents;      ///< index of each bone's parent, -1 for none
    std::span<const float> rest;       ///< Bone.matrix_local
    std::span<const float> poses;      ///< PoseBone.matrix
    std::span<const float> basis;      ///< PoseBone.matrix_basis: the animated (FK) transform
    std::span<const float> lengths;    ///< Bone.length
    std::span<const int> inheritance;  ///< InheritScale | inherits_rotation | has_local_location
};

/// std::invalid_argument if there is no matrix of that bone.
[[nodiscard]] glm::dmat4 matrix_at(std::span<const float> matrices, std::size_t bone);

/// The bone at rest. std::invalid_argument if the rig has no such bone, or not the parent that the bone
/// names.
[[nodiscard]] Rest rest_of(const RigView& rig, std::size_t bone);

}  // namespace motus::bones
