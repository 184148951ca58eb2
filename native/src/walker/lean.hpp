// The plane that feet stand on, as a body sees it. Private to the library.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/walker/body_trajectory.hpp"

namespace motus::walker {

/// Height of the plane above that of the rest places at the body's origin, m, and its slopes along the axes.
struct Lean {
    double height = 0.0;
    double side = 0.0;
    double ahead = 0.0;
};

/// The plane fitted by weighted least squares to the heights of the feet above their rest places. weights: >=
/// 0, not all 0. All in world space. A slope that feet do not determine, because they have no extent across
/// `axes`, is 0.
[[nodiscard]] Lean lean_of(const glm::dvec3& origin, const Axes& axes, std::span<const glm::dvec3> rest,
                           std::span<const glm::dvec3> feet, std::span<const double> weights);

/// The turn that takes the body's up to the plane's normal.
[[nodiscard]] glm::dquat turn_of(const Lean& lean, const Axes& axes);

}  // namespace motus::walker
