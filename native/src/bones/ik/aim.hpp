// Turns a chain's bones so that its tip comes to a target. Pose space.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "motus/bones/reason.hpp"
#include "pose.hpp"

namespace motus::bones::ik {

/// Direction and bend of a chain: perpendicular unit vectors; normal x along points to the side of the bend.
struct Chord {
    glm::dvec3 along{0.0, 1.0, 0.0};
    glm::dvec3 normal{1.0, 0.0, 0.0};
};

/// The Chord of the first `count` bones in their pose: the plane that they lie in, or, the straighter they
/// are (sine of the bend below that of 8 degrees, wholly at 1 degree), the first bone's hinge, X turned by
/// hinge_angle about Y.
[[nodiscard]] Chord chord_of(const Pose& pose, std::size_t count, double hinge_angle);

/// A turn in pose space expressed in a space: the turn about the axis as it is in that space. Exact if the
/// space is not sheared. to_space: inverse of the space's matrix.
[[nodiscard]] glm::dquat seen_from(const glm::dmat3& to_space, const glm::dquat& turn);

struct AimGoal {
    std::size_t count = 0;   ///< bones to turn, from the root
    glm::dvec3 target{0.0};  ///< of the joint after them
    double softness = 0.0;   ///< fraction of their length
    double hinge_angle = 0.0;
    std::optional<glm::dvec3> pole;
    int bend = 1;
    double pole_angle = 0.0;  ///< turns the bend about the line from root to target
    double tolerance = 1e-6;  ///< fraction of the length
    int max_iterations = 100;
    std::span<const chains::JointLimits> limits;  ///< one per bone, or empty
    std::optional<glm::dquat> orientation;        ///< frame() wanted of the last bone; read only with limits
};

struct AimReport {
    Reason reason = Reason::reached;  ///< of the joints' positions
    int iterations = 0;
    double distance = 0.0;  ///< root to target
    double reach = 0.0;     ///< of the straight chain, in the pose reached
    double end = 0.0;       ///< how far from the root softness lets the tip go for that target
};

/// Solver for chains of up to `longest` bones, with its memory.
class Aim {
  public:
    explicit Aim(std::size_t longest);

    /// Turns the bones from the pose in which they stand; no bone is stretched before or after.
    AimReport turn(Pose& pose, const AimGoal& goal);

  private:
    /// The line from root to target and the plane to bend in, and the turn that takes the pose's there.
    struct Line {
        Chord chord;
        glm::dvec3 carried{1.0, 0.0, 0.0};  ///< the pose's normal, turned with its line and no further
        glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    };
    [[nodiscard]] static Line line_to_target(const Pose& pose, const AimGoal& goal, double length);
    void measure(const Pose& pose, std::size_t count, AimReport& report, const AimGoal& goal);
    void find_joints(const Pose& pose, const AimGoal& goal, const Line& line, AimReport& report);
    void find_rotations(const Pose& pose, const AimGoal& goal, const Line& line, AimReport& report);
    void turn_bones(Pose& pose, std::size_t count, const Line& line);
    /// Brings the tip to its place by the smallest turns, if these are so small that they add up as vectors;
    /// the remaining error is of the order of their square. Otherwise returns false and leaves the pose as it
    /// was.
    [[nodiscard]] bool nudge(Pose& pose, std::size_t count) const;
    void keep(const Pose& pose, std::size_t count);
    /// Brings the tip nearer to `end` from the rotations that were kept; returns how many steps it took.
    int finish(Pose& pose, const AimGoal& goal, const glm::dvec3& end, double reach);
    /// If the tip is off `end`, starts again from the chain aimed at a nearer place on the same side: in
    /// sheared spaces the straight chain is not the longest one, and no small turn leads from it to longer
    /// ones. Returns whether the tip came nearer.
    [[nodiscard]] bool fold(Pose& pose, const AimGoal& goal, const Line& line, const glm::dvec3& end,
                            AimReport& report);

    std::vector<double> lengths_;
    std::vector<glm::dvec3> joints_;     // where they are to be
    std::vector<glm::dmat3> to_spaces_;  // inverse of the space that each bone was turned in
    std::vector<glm::dquat> best_;
    std::vector<glm::dquat> nearest_;  // of the searches so far
    std::vector<glm::dmat3> slopes_;   // of the tip by each bone's turn about X, Y and Z
    // of chains with limits
    std::vector<glm::dquat> rest_;
    std::vector<glm::dvec3> offsets_;
    std::vector<glm::dquat> rotations_;
};

}  // namespace motus::bones::ik
