// What the tests of frames look at.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "motus/frames.hpp"

namespace frame_checks {

using motus::FrameMode;
using motus::FrameSettings;

inline constexpr double speed = 7.0;
inline const glm::dvec3 z{0.0, 0.0, 1.0};

inline FrameSettings mode(FrameMode which) {
    FrameSettings settings;
    settings.mode = which;
    return settings;
}

inline glm::dvec3 forward(const glm::dquat& q) {
    return q * glm::dvec3(0, 1, 0);
}
inline glm::dvec3 up(const glm::dquat& q) {
    return q * z;
}

inline double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::conjugate(a) * b;
    return 2.0 * std::atan2(glm::length(glm::dvec3(d.x, d.y, d.z)), std::abs(d.w));
}

inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
}

}  // namespace frame_checks
