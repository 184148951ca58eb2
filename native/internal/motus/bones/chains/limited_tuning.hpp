// The numbers by which chains with limits are solved. Private to the library.
// docs/limited_chains.md tells what each does and shows what solutions are like with other values.
#pragma once
#include <array>
#include <optional>
#include <span>

#include "motus/bones/chains/limited.hpp"

namespace motus::bones::chains {

/// Lengths are in units of the chain's length, angles in radians.
struct LimitedTuning {
    // Which starting poses are tried.
    int spread_starts = 4;  ///< poses spread over the limits, after those that come from the given pose
    int patience_on_target =
        4;  ///< starts in a row without gain after which no more are tried once the tip is on the target
    double widest_start = 2.0;  ///< how far a start may turn to a side without a limit
    double led_near = 1e-3;     ///< distance at which a chain that was led counts as there but for a descent
    std::array<double, 2> orientation_shares{0.3,
                                             0.03};  ///< length that a radian off counts as, stage by stage

    // How a pose is led to the target.
    int turn_steps = 8;             ///< of a root with limits, from the pose's line to the target's
    double other_side_room = 0.25;  ///< a side with less than this share of the other side's room is left
    double shown_bend = 0.5;        ///< of a straight pose, to see in which plane it bends
    double most_first_bend = 1.0;   ///< of a straight pose, before the steps
    double paying = 0.98;           ///< a step pays that leaves less than this share of the best distance
    int most_stretches = 40;        ///< steps until the pose's line is as long as the target is far
    double least_room =
        0.05;  ///< mean angle that joints can bend by about an axis; with less, each bends its widest way
    int idle_steps = 5;  ///< steps in a row that do not pay, after which it ends

    // One step of it.
    double most_turned = 0.5;   ///< of a joint
    double step_damping = 0.1;  ///< less overshoots if the target is out of reach, more is slower
    int most_dual_rounds = 20;  ///< of Newton's method on the dual problem

    // The descent that makes it exact.
    double first_damping = 1e-3;
    double least_damping = 1e-12;
    double most_damping = 1e8;   ///< at which it ends
    double damping_fall = 0.1;   ///< factor after a step that lowers the cost
    double damping_rise = 10.0;  ///< factor after one that does not
    double slow = 0.25;          ///< a step that leaves more of the cost is followed by ones of second order
    double hopeless = 0.98;      ///< a step that leaves more, far above an earlier descent's end, is the last
    double far_above = 2.0;      ///< times the cost at that end
    double largest_turn = 1.0;   ///< of an angle in one step
};

/// solve_limited() with other numbers than the usual ones.
Convergence solve_limited(const Limited& chain, const glm::dvec3& target, const SolverSettings& settings,
                          std::span<glm::dquat> rotations, const std::optional<glm::dquat>& orientation,
                          const LimitedTuning& tuning);

}  // namespace motus::bones::chains
