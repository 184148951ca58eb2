// A chain of bones in its pose: where its joints are when its bones are turned.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bones.hpp"
#include "motus/bones/ik/ik.hpp"
#include "motus/bones/space.hpp"

namespace motus::bones::ik {

/// A bone in a pose.
struct PosedBone {
    LinearSpace space;                        ///< the space that the bone's own transform acts in
    glm::dmat3 axes{1.0};                     ///< its pose's
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< its own
    double stretch = 1.0;                     ///< scale along its Y on top of its own
};

/// All bones and joints of one chain. Made once for the longest chain of a plan and filled for each.
class Pose {
  public:
    explicit Pose(std::size_t longest);

    /// Puts the chain's bones, which the input keeps, into their FK pose. False if a number is not finite.
    [[nodiscard]] bool read(const ChainInput& input, const ChainPlan::Chain& chain);

    /// How much of its volume a bone keeps that place() stretches, 0 to 1; none at first.
    void keep_volume(double share) noexcept { volume_ = share; }
    /// Scales on top of a bone's own if it is stretched.
    [[nodiscard]] glm::dvec3 stretched(double stretch) const;

    [[nodiscard]] std::size_t size() const noexcept { return bones_.size(); }
    [[nodiscard]] const AnimatedBone& bone(std::size_t i) const { return bones_[i]; }
    [[nodiscard]] const PosedBone& posed(std::size_t i) const { return posed_[first_ + i]; }
    /// The bone at a place in the chain that also counts left out bones.
    [[nodiscard]] const PosedBone& posed_of_all(std::size_t place) const { return posed_[place]; }
    [[nodiscard]] std::span<const glm::dvec3> joints() const { return {&joints_[first_], size() + 1}; }
    [[nodiscard]] const glm::dvec3& root() const { return joints_[first_]; }
    [[nodiscard]] const glm::dvec3& tip() const { return joints_[first_ + size()]; }

    /// The joint after bone i relative to the bone's root, in the bone's space before the bone's own
    /// rotation, computed from the space that the bone has now.
    [[nodiscard]] glm::dvec3 reach_of(std::size_t i, double stretch) const;
    /// Computes the space of bone i from the pose of the bone before it.
    void enter(std::size_t i);
    /// Poses bone i, whose space is computed (enter()), and moves the next joint to its place.
    void place(std::size_t i, const glm::dquat& rotation, double stretch);
    /// Sets rotation and stretch of a bone.
    void put(std::size_t i, const glm::dquat& rotation, double stretch) {
        enter(i);
        place(i, rotation, stretch);
    }

    /// Orientation (see frame_of) of bone i in its pose.
    [[nodiscard]] glm::dquat frame(std::size_t i) const;
    /// Own rotation by which bone i, whose space is computed (enter()), has this orientation.
    [[nodiscard]] glm::dquat rotation_for(std::size_t i, const glm::dquat& frame) const;

  private:
    glm::dmat3 parent_axes_{1.0};
    double volume_ = 0.0;
    std::size_t first_ = 0;  // index of the first solved bone; the bones before it are left out
    std::span<const AnimatedBone> bones_;
    std::vector<PosedBone> posed_;
    std::vector<glm::dvec3> joints_;
};

/// frame_of() of a bone with that rotation in that space; the scale's signs count.
[[nodiscard]] glm::dquat frame_in(const LinearSpace& space, const glm::dquat& rotation,
                                  const glm::dvec3& scale);

/// The rotation by which a bone in that space has this frame.
[[nodiscard]] glm::dquat rotation_in(const LinearSpace& space, const glm::dquat& frame,
                                     const glm::dvec3& scale);

/// The rotation that a space itself is: the nearest along Y and Z, of its opposite if it is mirrored.
/// Turning it by that rotation and turning a bone in it by the turn seen from there come to the same if
/// the space is not sheared.
[[nodiscard]] glm::dquat rotation_of_space(const glm::dmat3& axes);

}  // namespace motus::bones::ik
