// Look-at: how body, head and eyes share the turn of a gaze to its target.
// Weights and clamp mean what they mean in Unity's Animator.SetLookAtWeight.
//
// All directions are seen from the chest, in a chart of the sphere about the chest's forward direction: the
// place of a direction is the angle it lies off forward, towards where it lies (azimuthal equidistant). In
// this chart a turn is a vector, shares are fractions of it, and no turn leads round the back. The one
// direction without a place of its own is the one exactly behind the chest (every way is equally long; the
// left one is taken): a target that passes through it makes free turns change sides at once, as a person
// does. Turns that are limited, by the clamp or by a limit of their own, shrink to none as the target nears
// it (over the last 45 degrees, if the limit is 90 degrees or less), and so change sides without a jump: the
// result is then a continuous function of the target everywhere.
//
// Costs: O(1). Allocates nothing. Any number of threads at once.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "motus/bones/reason.hpp"
#include "motus/config.hpp"

namespace motus::bones::look_at {

/// Which directions have a level orientation, one without roll. No choice is continuous on the whole sphere.
/// Level is told by the chest's up for gazes within 37 degrees of the horizon, and by up leaning back (below
/// the horizon forward) as they near the vertical, so that a gaze may pass straight over the zenith without
/// spinning.
enum class Level {
    all_round,  ///< as above; two directions, about 60 degrees above and below the one behind, have no
                ///< level. For heads that turn right round
    in_front,  ///< farther than 73 degrees off forward, level passes over to what forward's up becomes by the
               ///< shortest turn: every direction but the one behind has it. For turns that are limited
};

/// Directions as places in the chest's chart, rad: x to the left, y up, (0, 0) straight ahead.
class GazeChart {
  public:
    /// forward: unit. up: any vector not along forward; its part across forward counts.
    GazeChart(const glm::dvec3& forward, const glm::dvec3& up, Level level = Level::all_round);

    /// Place of a unit direction; the length is its angle from forward, 0 to pi.
    [[nodiscard]] glm::dvec2 place(const glm::dvec3& direction) const;

    /// The unit direction at a place.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec2& place) const;

    /// A level orientation that looks in the direction at a place: +Y that way, +X to the right.
    [[nodiscard]] glm::dquat level(const glm::dvec2& place) const;

    /// Rotation that takes the direction at `from` to the one at `to`, and level to level: a level head stays
    /// level, a head that is not level keeps its roll. w >= 0.
    [[nodiscard]] glm::dquat turn(const glm::dvec2& from, const glm::dvec2& to) const;

    /// Yaw (positive to the left) and pitch (positive up) of a unit direction, rad.
    [[nodiscard]] glm::dvec2 yaw_pitch(const glm::dvec3& direction) const;

  private:
    glm::dvec3 forward_;
    glm::dvec3 left_;
    glm::dvec3 up_;
    Level level_;
};

/// Greatest parts of a turn in the chart's directions, rad; pi and more: none. Clamped to >= 0.
struct SideLimits {
    double left = std::numbers::pi;
    double right = std::numbers::pi;
    double up = std::numbers::pi;
    double down = std::numbers::pi;
};

/// How a turn is shared and limited. Weights are clamped to [0, 1], limits to >= 0.
struct GazeSettings {
    double weight = 1.0;       ///< of the whole turn
    double body_weight = 0.3;  ///< share of the whole turn that the body takes, evenly over its bones
    double head_weight = 1.0;  ///< share that the head takes of what the body leaves
    double eyes_weight = 0.0;  ///< share that the eyes take of what the head leaves
    double clamp = 0.5;        ///< 0: free, 0.5: 90 degrees to each side, 1: no turn at all
    double body_limit = std::numbers::pi;  ///< greatest turn of the gaze by the body, rad; pi and more: none
    double head_limit = std::numbers::pi;  ///< by the head
    double eyes_limit = std::numbers::pi;  ///< by each eye
    SideLimits head_sides{};               ///< of the head, within head_limit
    SideLimits eyes_sides{};               ///< of each eye, within eyes_limit
};

/// all_round if nothing keeps the head from turning right round: no clamp, no limit of the head, and none to
/// one of the two sides at least.
[[nodiscard]] Level level_for(const GazeSettings& settings);

/// A place in the chart, or a step from one to another, and whether a limit made it shorter.
struct GazeStep {
    glm::dvec2 by{0.0};
    bool is_limited = false;
};

/// `turn`, a step from the place `from`, by no more than `limit`: as it is up to 0.8 of the limit, then
/// slower, twice continuously differentiable; and shrunk towards zero if `target`, the place of the
/// target, is nearly behind. The angle between the directions at its ends is within the limit, 5 % more
/// if `from` is 120 degrees off.
[[nodiscard]] GazeStep limited_turn(const glm::dvec2& from, const glm::dvec2& turn, double limit,
                                    const glm::dvec2& target);

/// `turn` with its part across limited by left or right, and its part upwards by up or down, each as
/// limited_turn() does, so that a part that is not limited stays as it is. A limit of 0 is a wall: the turn
/// has a corner there.
[[nodiscard]] GazeStep side_limited_turn(const glm::dvec2& from, const glm::dvec2& turn,
                                         const SideLimits& sides, const glm::dvec2& target);

/// The end of the whole turn that starts at the animated gaze: the target, or nearer by weight and clamp.
/// `by` is that place in the chart.
[[nodiscard]] GazeStep gaze_goal(const glm::dvec2& animated, const glm::dvec2& target,
                                 const GazeSettings& settings);

/// The weight and the limits of one part: body, head or eye.
struct GazePart {
    double weight = 1.0;
    double limit = std::numbers::pi;
    SideLimits sides{};
};

/// The step from the present gaze that one part takes.
[[nodiscard]] GazeStep gaze_share(const glm::dvec2& present, const GazeStep& goal, const glm::dvec2& target,
                                  const GazePart& part);

inline constexpr double reached_angle = 1e-6;  ///< rad; a smaller angle between gaze and target counts as 0

/// Rotations in the space of the chart, each on top of the one before.
struct Turns {
    glm::dquat body{1.0, 0.0, 0.0, 0.0};
    glm::dquat head{1.0, 0.0, 0.0, 0.0};
    glm::dquat eyes{1.0, 0.0, 0.0, 0.0};
    double residual = 0.0;            ///< angle between the turned gaze and the target, rad
    Reason reason = Reason::reached;  ///< limit: clamp or a limit keeps the gaze off; reached: nothing but
                                      ///< weights does
};

/// The shares of a turn from the animated gaze to a target far away, if it is in the same direction from
/// head and eyes, and stays so as the body turns. Unit directions. A share of no weight is exactly the
/// identity.
[[nodiscard]] Turns turns_to(const GazeChart& chart, const glm::dvec3& animated, const glm::dvec3& target,
                             const GazeSettings& settings);

}  // namespace motus::bones::look_at
