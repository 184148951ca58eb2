#include "motus/bones/rig.hpp"

#include "motus/core/numeric.hpp"

namespace motus::bones {

glm::dmat4 matrix_at(std::span<const float> matrices, std::size_t bone) {
    require(bone < matrices.size() / 16, "bone: must have a matrix");
    const float* value = matrices.data() + 16 * bone;
    glm::dmat4 matrix;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) matrix[column][row] = static_cast<double>(*value++);
    }
    return matrix;
}

RigView::RigView(const RigArrays& arrays) : arrays_(arrays) {
    const std::size_t bones = arrays.parents.size();
    for (const int parent : arrays.parents)
        require(parent >= -1 && (parent < 0 || static_cast<std::size_t>(parent) < bones),
                "parents: must hold indices of bones, or -1");
    const auto require_of_each = [bones](std::size_t size, std::size_t of_each, bool may_be_empty,
                                         const char* message) {
        require(size == of_each * bones || (may_be_empty && size == 0), message);
    };
    require_of_each(arrays.rest.size(), 16, false, "rest: must be as many as the bones' matrices");
    require_of_each(arrays.inheritance.size(), 1, false, "inheritance: must be as many as the bones");
    require_of_each(arrays.poses.size(), 16, true, "poses: must be as many as the bones' matrices, or empty");
    require_of_each(arrays.basis.size(), 16, true, "basis: must be as many as the bones' matrices, or empty");
    require_of_each(arrays.lengths.size(), 1, true, "lengths: must be as many as the bones, or empty");
}

Rest rest_of(const RigView& rig, std::size_t bone) {
    require(bone < rig.size(), "bone: must be one of the rig");
    const int parent = rig.parents()[bone];
    const int flags = rig.inheritance()[bone];
    Rest rest;
    rest.matrix = matrix_at(rig.rest(), bone);
    rest.has_parent = parent >= 0;
    if (rest.has_parent) rest.parent_matrix = matrix_at(rig.rest(), static_cast<std::size_t>(parent));
    rest.inherit_rotation = (flags & inherits_rotation) != 0;
    rest.local_location = (flags & has_local_location) != 0;
    constexpr int mode_bits = 7, last_mode = static_cast<int>(InheritScale::none_legacy);
    const int mode = flags & mode_bits;
    rest.inherit_scale = mode <= last_mode ? static_cast<InheritScale>(mode) : InheritScale::full;
    return rest;
}

}  // namespace motus::bones
