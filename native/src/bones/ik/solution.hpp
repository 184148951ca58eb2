// One chain's solution, and the steps after it: weights, stretch, the bones that are children of the chain.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "aim.hpp"
#include "motus/bones/ik/ik.hpp"
#include "pose.hpp"

namespace motus::bones::ik {

/// The task of one chain, in pose space; all numbers are finite and within their domains.
struct Task {
    ChainSettings settings;
    glm::dvec3 target{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  ///< frame_of() the target
    std::optional<glm::dvec3> pole;
    std::span<const chains::JointLimits> limits;
};

/// Memory for chains of up to `longest` bones, and the work on one after another.
class Solution {
  public:
    explicit Solution(std::size_t longest);

    /// Reads the FK pose; false if a number is not finite.
    [[nodiscard]] bool read(const ChainInput& input, const ChainPlan::Chain& chain) {
        return pose_.read(input, chain);
    }
    /// The present pose: after read() the FK pose, after solve() the
    /// whole solution, after write() the solution by its weights.
    [[nodiscard]] const Pose& pose() const { return pose_; }

    /// Finds the solution, weights but rotation_weight aside.
    AimReport solve(const ChainPlan::Chain& chain, const Task& task);

    /// Takes the FK pose for the solution: nothing turns.
    void stay();

    /// Blends and writes the chain's rows. rows: the bones of all. Returns the angle left between effector
    /// and target.
    double write(std::span<const AnimatedBone> rows, const ChainPlan::Chain& chain, const Task& task,
                 const ChainOutput& output);

  private:
    void turn_tail(const Task& task, AimGoal goal, AimReport& report, double stretch);
    void reach_tail(const glm::dquat& frame, AimGoal goal, AimReport& report, double stretch);
    void take_pose();
    void stretch_bones(double rest, double last_stretch, double volume);
    void pose_weighted(const Task& task, bool is_stretched);
    void write_guards(std::span<const AnimatedBone> rows, const ChainPlan::Chain& chain,
                      const ChainOutput& output) const;
    [[nodiscard]] double write_effector(std::span<const AnimatedBone> rows, const ChainPlan::Chain& chain,
                                        const Task& task, const ChainOutput& output) const;

    Pose pose_;
    Aim aim_;
    std::vector<glm::dquat> plain_;      // solution without stretch; a tail bone's as if it had no goal
    std::vector<glm::dquat> rotations_;  // the same of the stretched solution
    std::vector<double> stretches_;
    std::vector<glm::dvec3> joints_;
    bool is_stretched_ = false;
    bool turns_tail_ = false;  // the last bone has a goal of its own, and no limits in the way
    glm::dquat tail_frame_{1.0, 0.0, 0.0, 0.0};  // frame of the last bone by the position alone
    glm::dquat tail_goal_{1.0, 0.0, 0.0, 0.0};   // frame of the last bone by the whole solution
};

}  // namespace motus::bones::ik
