// Damped least squares on a chain of joints with limits. Private to the library.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "motus/bones/chains/limited.hpp"
#include "motus/bones/chains/limited_tuning.hpp"
#include "per_bone.hpp"
#include "swing_twist.hpp"

namespace motus::bones::chains {

/// Angles of all bones of a chain.
using Angles = PerBone<SwingTwist>;

/// The goal of a descent, in the pose's unit of length.
struct Goal {
    glm::dvec3 target{0.0};
    std::optional<glm::dquat> orientation;  ///< of the last bone's frame
    double orientation_weight = 0.0;  ///< length that a radian off the orientation counts as; 0: not at all
    double tolerance = 0.0;           ///< length
    /// Residual of an earlier descent; a descent that slows down well above it is given up. < 0: no earlier
    /// descent.
    double rival = -1.0;
};

/// Frames and joints of a chain at given angles, relative to the root, in a unit of length that the caller
/// chooses.
class LimitedPose {
  public:
    /// The chain must outlive the pose.
    LimitedPose(const Limited& chain, double unit) : chain_(chain) {
        joints_[0] = glm::dvec3(0.0);
        for (std::size_t i = 0; i < count(); ++i) offsets_[i] = chain.offsets[i] / unit;
    }

    void set(const Angles& angles);
    /// Sets the angles of bone `i`. The bones before it have to be set already.
    void set_bone(std::size_t i, const SwingTwist& angles);

    [[nodiscard]] const Angles& angles() const { return angles_; }
    [[nodiscard]] std::size_t count() const { return chain_.offsets.size(); }
    [[nodiscard]] const glm::dvec3& tip() const { return joints_[count()]; }
    [[nodiscard]] const glm::dvec3& joint(std::size_t i) const { return joints_[i]; }
    [[nodiscard]] const glm::dquat& socket(std::size_t i) const { return sockets_[i]; }
    [[nodiscard]] const glm::dquat& frame(std::size_t i) const { return frames_[i]; }
    [[nodiscard]] const glm::dquat& last_frame() const { return frames_[count() - 1]; }
    [[nodiscard]] glm::dvec3 twist_axis(std::size_t i) const {
        return frames_[i] * glm::dvec3(0.0, 1.0, 0.0);
    }
    [[nodiscard]] const JointLimits& limits(std::size_t i) const { return chain_.limits[i]; }
    [[nodiscard]] const glm::dvec3& offset(std::size_t i) const { return offsets_[i]; }

  private:
    const Limited& chain_;
    PerBone<glm::dvec3> offsets_;
    Angles angles_;
    PerBone<glm::dquat> sockets_;  // frames that the bones' rotations are relative to
    PerBone<glm::dquat> frames_;
    PerJoint joints_;
};

/// Rotation vector, rad, from the last bone's frame to the wanted one.
[[nodiscard]] glm::dvec3 orientation_error(const LimitedPose& pose, const glm::dquat& wanted);

/// Descends from the pose to a minimum of |tip - target|^2 + (orientation_weight * angle)^2 within the limits
/// (Levenberg-Marquardt; joints on their limits that are pulled outwards are left out). Returns the
/// iterations used, at most max_iterations; `is_at_rest` tells whether a minimum or the tolerance was met.
int descend(LimitedPose& pose, const Goal& goal, const LimitedTuning& tuning, int max_iterations,
            bool& is_at_rest);

}  // namespace motus::bones::chains
