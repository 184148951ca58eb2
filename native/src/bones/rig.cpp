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

Rest rest_of(const RigView& rig, std::size_t bone) {
    require(bone < rig.parents.size() && bone < rig.inheritance.size(), "bone: must be one of the rig");
    const int parent = rig.parents[bone];
    require(parent >= -1 && (parent < 0 || static_cast<std::size_t>(parent) < rig.rest.size() / 16),
            "rig: must have the parents that its bones name");
    const int flags = rig.inheritance[bone];
    Rest rest;
    rest.matrix = matrix_at(rig.rest, bone);
    rest.has_parent = parent >= 0;
    if (rest.has_parent) rest.parent_matrix = matrix_at(rig.rest, static_cast<std::size_t>(parent));
    rest.inherit_rotation = (flags & inherits_rotation) != 0;
    rest.local_location = (flags & has_local_location) != 0;
    constexpr int mode_bits = 7, last_mode = static_cast<int>(InheritScale::none_legacy);
    const int mode = flags & mode_bits;
    rest.inherit_scale = mode <= last_mode ? static_cast<InheritScale>(mode) : InheritScale::full;
    return rest;
}

}  // namespace motus::bones
