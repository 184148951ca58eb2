// A bone's pose from its parent's (forward kinematics), by Blender's rules of inheritance.
// Blender 3.4-5.2, BKE_bone_parent_transform_calc_from_matrices, which is Bone.convert_local_to_pose in
// Python.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <glm/mat4x4.hpp>

#include "motus/config.hpp"

namespace motus::bones {

/// How a bone takes its parent's scale (Blender's Bone.inherit_scale, in its order).
enum class InheritScale : int {
    full = 0,
    fix_shear = 1,
    aligned = 2,
    average = 3,
    none = 4,
    none_legacy = 5
};

/// A bone at rest. Armature space.
struct Rest {
    glm::dmat4 matrix{1.0};         ///< Bone.matrix_local
    glm::dmat4 parent_matrix{1.0};  ///< the parent's; read only if has_parent
    bool has_parent = false;
    bool inherit_rotation = true;  ///< Bone.use_inherit_rotation
    bool local_location = true;    ///< Bone.use_local_location
    InheritScale inherit_scale = InheritScale::full;
};

/// The transforms that turn a bone's own transform (PoseBone.matrix_basis) into its pose in armature space
/// (PoseBone.matrix).
struct ParentSpace {
    glm::dmat4 rotation_scale{1.0};
    glm::dmat4 location{1.0};
    glm::dvec3 post_scale{1.0};
};

/// The space that a bone stands in when its parent's pose is `parent_pose` (armature space; not read without
/// a parent).
[[nodiscard]] ParentSpace parent_space(const Rest& bone, const glm::dmat4& parent_pose);

/// Pose, in armature space, of a bone with the given own transform.
[[nodiscard]] glm::dmat4 to_pose(const ParentSpace& space, const glm::dmat4& basis);

/// The own transform that gives a pose. Along an axis where the parent's scale is zero, the result is not
/// divided by it.
[[nodiscard]] glm::dmat4 to_basis(const ParentSpace& space, const glm::dmat4& pose);

}  // namespace motus::bones
