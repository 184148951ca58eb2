// Rotations as swing and twist, and their limits. Private to the library.
#pragma once
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "motus/bones/chains/limited.hpp"

namespace motus::bones::chains {

/// A rotation = exp(swing) * (turn by twist about +Y); rad.
struct SwingTwist {
    glm::dvec2 swing;  ///< rotation vector's X and Z
    double twist;
};

/// Swing and twist of a rotation: a swing of length <= pi, a twist in [-pi, pi].
[[nodiscard]] SwingTwist swing_twist_of(const glm::dquat& rotation);
[[nodiscard]] glm::dquat rotation_of(const SwingTwist& angles);

/// The swing within the limits that is nearest to `swing`, whose angles are taken as they are, even beyond
/// pi.
[[nodiscard]] glm::dvec2 clamp_swing(const glm::dvec2& swing, const JointLimits& limits);
/// Derivative of `kept` = clamp_swing(swing) by the swing.
[[nodiscard]] glm::dmat2 slope_of_clamp(const glm::dvec2& swing, const glm::dvec2& kept,
                                        const JointLimits& limits);
/// The twist within the limits that is an equal turn to `twist`; if there is none, the nearest twist within
/// the limits.
[[nodiscard]] double clamp_twist(double twist, const JointLimits& limits);

/// Directions in which a swing may move towards `pull` without leaving its limits: both axes, the one along
/// the edge of the limits, or none.
struct Ways {
    std::size_t count = 0;
    std::array<glm::dvec2, 2> directions{};
    double curvature =
        0.0;  ///< of the edge times the pull against it: what the way along it costs by its square
};
[[nodiscard]] Ways swing_ways(const glm::dvec2& swing, const JointLimits& limits, const glm::dvec2& pull);
[[nodiscard]] bool may_twist(double twist, const JointLimits& limits, double pull);

/// Angular velocities of a bone, in its socket, by the X and the Z angle of its swing, and their derivatives.
struct SwingRates {
    glm::dvec3 x, z;
    glm::dvec3 x_by_x, x_by_z, z_by_z;  // x_by_z the mean of both orders
};

[[nodiscard]] SwingRates swing_rates(const glm::dvec2& swing);

}  // namespace motus::bones::chains
