// The world that a rig stands in, and checks of what comes from it. Private to the library.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <type_traits>

#include "bone_space.hpp"
#include "motus/rig_ik.hpp"

namespace motus {

[[nodiscard]] inline bool are_finite(std::span<const float> values) {
    float sum = 0.0f;
    for (const float value : values) sum += 0.0f * value;
    return sum == 0.0f;
}

template <class... Numbers>
[[nodiscard]] inline bool are_finite(const Numbers&... values) requires(
    std::is_same_v<Numbers, double>&&...) {
    return ((0.0 * values) + ...) == 0.0;
}

[[nodiscard]] inline bool is_finite(const glm::dvec3& v) {
    return are_finite(v.x, v.y, v.z);
}

[[nodiscard]] inline bool is_finite(const glm::dvec4& v) {
    return are_finite(v.x, v.y, v.z, v.w);
}

[[nodiscard]] inline bool is_finite(const glm::dquat& q) {
    return are_finite(q.w, q.x, q.y, q.z);
}

[[nodiscard]] inline bool is_finite(const glm::dmat4& m) {
    return is_finite(m[0]) && is_finite(m[1]) && is_finite(m[2]) && is_finite(m[3]);
}

[[nodiscard]] bool is_finite(const IkSettings& settings);
[[nodiscard]] bool is_finite(const IkReport& report);

/// Between pose space and the world.
struct RigWorld {
    explicit RigWorld(const glm::dmat4& matrix)
        : axes(matrix), origin(matrix[3]), is_valid(is_finite(matrix)) {
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

/// Settings in the domains that they are documented with; finite ones only.
[[nodiscard]] IkSettings within_domains(IkSettings settings);

/// std::invalid_argument where bones or poses are not those of the plan's rig.
void check_ik_rig(const IkPlan& plan, const IkInput& input);

}  // namespace motus
