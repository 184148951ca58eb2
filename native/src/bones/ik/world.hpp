// The world space of a rig, and checks of input in world space. Private to the library.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "motus/bones/ik/ik.hpp"
#include "motus/bones/space.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::ik {

/// Whether all numbers of these are finite.
[[nodiscard]] bool has_finite_numbers(const ChainSettings& settings);
[[nodiscard]] bool has_finite_numbers(const ChainDiagnostics& report);

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

/// The settings, each brought into its documented domain; finite ones only.
[[nodiscard]] ChainSettings within_domains(ChainSettings settings);

/// std::invalid_argument if bones or poses are not those of the plan's rig.
void check_rig(const ChainPlan& plan, const ChainInput& input);

}  // namespace motus::bones::ik
