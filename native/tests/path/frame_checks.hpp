// Checks that several tests of frames share.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "angles.hpp"
#include "motus/path/frames.hpp"

namespace motus::path::checks {

using test::angle_between;

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

}  // namespace motus::path::checks
