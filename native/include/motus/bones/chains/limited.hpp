// Inverse kinematics of chains whose joints have swing-twist limits: rotations of the bones.
// Steps of least turn with the limits as bounds, each a small quadratic program. If they do not get there,
// damped least squares, then Newton's method with all second derivatives, on the joints that are free to move
// (Nocedal, Wright, "Numerical Optimization", 2006, 16.7 and 10.3).
//
// Costs: O(bones^2) an iteration, O(bones^3) in the last stage. Allocates nothing, but takes 250 KB of the
// stack. Any number of threads at once, each with rotations of its own.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>

#include "motus/bones/chains/chain.hpp"
#include "motus/config.hpp"

namespace motus::bones::chains {

/// How far a bone may turn from its rest. The rotation is split into a twist about the bone's +Y and a swing
/// (rotation = swing * twist). The swing, as a rotation vector in the X-Z plane, stays within an ellipse
/// whose half-axes are the limits on the side it is on; the twist within its interval. Infinite: free; with
/// one free axis of the swing the limits of the other axis are a plain interval. min <= max. min <= 0 <= max
/// is not needed: if an interval of the swing does not contain 0, both axes of the swing have plain
/// intervals.
struct JointLimits {
    static constexpr double free = std::numeric_limits<double>::infinity();
    glm::dvec3 min{-free};  ///< swing about X, twist about Y, swing about Z, rad
    glm::dvec3 max{free};
};

/// The nearest rotation within the limits, swing and twist each by itself (the swing by its rotation vector;
/// of the two vectors of one swing by the nearer one); the rotation itself if it is within. rotation: unit.
/// Throws std::invalid_argument if a minimum is not <= its maximum.
[[nodiscard]] glm::dquat clamp_rotation(const glm::dquat& rotation, const JointLimits& limits);

/// A chain in the frames of its bones. Frame of bone i = frame of bone i-1 * rest[i] * rotation[i]; its next
/// joint lies at offset[i] in that frame. All spans have one size, 1 to most_bones.
struct Limited {
    glm::dvec3 root{0.0};
    glm::dquat base{1.0, 0.0, 0.0, 0.0};  ///< frame that the first bone is relative to
    std::span<const glm::dquat> rest;     ///< unit
    std::span<const glm::dvec3> offsets;
    std::span<const JointLimits> limits;
};

/// Turns the bones (rotations: in the animated pose, out the solution, all within their limits) so that the
/// last joint comes to the target, and, if `orientation` is given, the last bone's frame to it as far as
/// the position allows. The pose is led there within its limits: bent until its tip is as far from the root
/// as the target, then turned as a whole about the root, with a pole also about the line to the target; if
/// the root's limits are in the way the other joints follow. The result is continuous in target and
/// pole, except for a target right behind the root or on it, for one at which the limits stop the bend of the
/// pose, and for one between two ways in which a chain evades narrow limits. Different starts are tried only
/// if the target is not reached so; of equal residuals that of the earlier start is kept. settings.plane:
/// normal that a straight pose bends in, turned with its line from root to tip to the target's.
/// settings.max_iterations holds for each start (three times with an orientation, and once more without it if
/// the target could be reached without it); the report counts all. Reason: reached, limit (within reach of
/// the bones' lengths, but not of the limits), iterations, too_far or too_near. Deterministic; never NaN;
/// allocates nothing. Lengths and coordinates as for solve. Throws std::invalid_argument, naming the argument
/// and before anything is written, if a size differs from what is stated, a number is not finite (limits may
/// be infinite), a quaternion is not unit to 1e-3, or the domains of `settings` or of JointLimits are left.
Convergence solve_limited(const Limited& chain, const glm::dvec3& target, const SolverSettings& settings,
                          std::span<glm::dquat> rotations,
                          const std::optional<glm::dquat>& orientation = std::nullopt);

/// Joints of a chain, offsets.size() + 1 of them; limits are not read. Throws std::invalid_argument if sizes
/// do not fit, a place is not finite or larger than 1e300, or a rotation is not of length 1, to 1e-3.
void joints_of(const Limited& chain, std::span<const glm::dquat> rotations, std::span<glm::dvec3> joints);

/// Frames, +Y along the bones, of a chain of which only joints are known: frames.size() == joints.size() - 1
/// >= 1, else std::invalid_argument. The first by the smallest rotation from +Y to its bone, each of the
/// others by the smallest rotation from bone to bone, or half a turn about X if bones are opposite. A bone
/// without length has the frame of the one before it (the first: the identity).
void bone_frames(std::span<const glm::dvec3> joints, std::span<glm::dquat> frames);

}  // namespace motus::bones::chains
