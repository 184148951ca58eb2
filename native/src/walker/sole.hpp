// How soles lie on the ground and roll over heel and toe. Private to the library.
//
// The times at which a heel has rolled down and begins to rise: Perry, "Gait Analysis" (1992), ch. 2.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "motus/walker/walker.hpp"

namespace motus::walker {

/// Where a sole is, in the world.
struct SolePose {
    glm::dvec3 position{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< from the body's space
};

/// What steps are measured by.
struct Pace {
    double stride = 0.5;  ///< m
    double duty = 0.5;
};

/// The soles of all feet of a walker: how they lie on the ground and roll.
class SoleFrame {
  public:
    /// up: in the body's space, not zero.
    SoleFrame(const Soles& soles, const glm::dvec3& up);

    /// The turn, from the body's space to the world, of a sole that lies flat on ground with this normal
    /// (unit) under a body with this pose.
    [[nodiscard]] glm::dquat flat(const glm::dmat4& pose, const glm::dvec3& normal) const;
    /// A flat sole, turned about the ground's normal by an angle, rad, counter-clockwise from above.
    [[nodiscard]] glm::dquat turned(const glm::dquat& flat, double angle) const;
    /// The ground's normal under a flat sole.
    [[nodiscard]] glm::dvec3 normal(const glm::dquat& flat) const { return flat * up_; }
    /// A sole that is flat at a place, rolled by a pitch, rad: over the toe if it is above 0, else over the
    /// heel.
    [[nodiscard]] SolePose rolled(const glm::dvec3& place, const glm::dquat& flat, double pitch) const;
    /// Sets how each step rolls, except the first one: as much less as it is shorter than its stride, and the
    /// other way round if it goes backwards. steps: of one leg on one stretch. paces: one for each.
    void add_rolls(std::vector<Footstep>& steps, std::span<const Pace> paces) const;
    /// The sole on a step at a time, and in the stand that follows it. next: the step after, if there is one.
    [[nodiscard]] SolePose at(const Footstep& step, const Footstep* next, double time) const;

  private:
    Soles soles_;
    glm::dvec3 up_, ahead_, side_;  ///< of the body's space, orthonormal
};

}  // namespace motus::walker
