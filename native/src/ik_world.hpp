// The world that a rig stands in, and checks of what comes from it. Private to the library.
#pragma once
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "bone_space.hpp"
#include "motus/rig_ik.hpp"

namespace motus {

template <class Number>
[[nodiscard]] inline bool are_finite(const Number* values, std::size_t count) {
    Number sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += 0 * values[i];
    return sum == 0;
}

/// Between pose space and the world.
struct RigWorld {
    explicit RigWorld(const glm::dmat4& matrix)
        : axes(matrix), origin(matrix[3]), is_valid(are_finite(&matrix[0][0], 16)) {
        const double volume = glm::determinant(axes);
        const double box = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
        is_valid = is_valid && std::abs(volume) > 1e-12 * box;
        if (is_valid) inverse = inverse_axes(axes);
    }
    [[nodiscard]] glm::dvec3 to_pose(const glm::dvec3& point) const { return inverse * (point - origin); }
    [[nodiscard]] glm::dvec3 to_world(const glm::dvec3& point) const { return axes * point + origin; }
    /// Length, in the world, of a vector of the pose.
    [[nodiscard]] double length(const glm::dvec3& v) const { return glm::length(axes * v); }

    glm::dmat3 axes;
    glm::dvec3 origin;
    glm::dmat3 inverse{1.0};
    bool is_valid;
};

inline constexpr std::size_t setting_count = sizeof(IkSettings) / sizeof(double);

/// Settings in the domains that they are documented with; finite ones only.
[[nodiscard]] IkSettings within_domains(IkSettings settings);

/// std::invalid_argument where bones or poses are not those of the plan's rig.
void check_ik_rig(const IkPlan& plan, const IkInput& input);

}  // namespace motus
