// The plane that feet stand on, as a body sees it. Private to the library.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/walker/body_trajectory.hpp"

namespace motus::walker {

/// How far the plane is above that of the rest places: at the body's origin, m, and its slopes along the
/// axes.
struct Lean {
    double height = 0.0;
    double side = 0.0;
    double ahead = 0.0;
};

/// The best by least squares of how far feet are above their rest places, which these count as weights say
/// (>= 0, not all 0). All in world space. What feet without an extent across `axes` leave open is level.
[[nodiscard]] Lean lean_of(const glm::dvec3& origin, const Axes& axes, std::span<const glm::dvec3> rest,
                           std::span<const glm::dvec3> feet, std::span<const double> weights);

/// The turn that takes the body's up to the plane's normal.
[[nodiscard]] glm::dquat turn_of(const Lean& lean, const Axes& axes);

}  // namespace motus::walker
