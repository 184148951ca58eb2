// A chain's bones as they are animated, each beside its parent. Private to the library.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/bones/ik/ik.hpp"
#include "motus/bones/rig.hpp"
#include "motus/bones/space.hpp"

namespace motus::bones::ik {

/// A bone's own transform, taken apart as Blender does it: location * rotation * scale; if it is mirrored,
/// all three scales are negative.
struct OwnTransform {
    glm::dvec3 location{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};
[[nodiscard]] OwnTransform own_transform(std::span<const float> basis, std::size_t bone);

/// A bone of a chain, or one that hangs on a chain, at rest.
struct RestBone {
    Offset offset;
    double length = 0.0;
    bool is_finite = false;  ///< else all the rest may be anything
};

/// A bone as it is animated.
struct AnimatedBone {
    const Offset* offset = nullptr;           ///< of its RestBone
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< its own
    glm::dvec3 scale{1.0};                    ///< its own
    glm::dvec3 head{0.0};    ///< seen from its parent in the pose (from the armature without one)
    glm::dvec3 next{0.0};    ///< of a chain's bone: the next joint, or the tip, seen from it in its pose
    bool is_finite = false;  ///< else all the rest may be anything
};

}  // namespace motus::bones::ik
