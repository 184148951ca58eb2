// Legs that walk under a moving body: the steps of a whole shot, planned from the body's motion, and looked
// up at any time (footstep planning).
//
// Costs: O(steps) rays to plan, which allocates the plan; O(log steps) to ask. Immutable: any number of
// threads may share one.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"
#include "motus/dynamics/track.hpp"
#include "motus/walker/body_trajectory.hpp"
#include "motus/walker/gait.hpp"
#include "motus/walker/ground.hpp"
#include "motus/walker/step.hpp"

namespace motus::walker {

inline constexpr double most_steps = 1e6;

/// The soles of the feet: how they lie on the ground and roll over heel and toe (foot rockers).
struct Soles {
    glm::dvec3 forward{0.0, 1.0, 0.0};  ///< of the feet, in the body's space; its part across up counts
    double ankle = 0.0;                 ///< m, >= 0, height of a foot's place above the ground under its sole
    double heel = 0.0;                  ///< m, >= 0, how far behind a foot's place its sole rolls
    double toe = 0.0;                   ///< m, >= 0, how far ahead of it
    double strike = 0.0;                ///< rad, [0, pi/2], by which the toe is up when a heel touches down
    double push = 0.0;                  ///< rad, [0, pi/2], by which the heel is up when a toe lifts
};

/// Where a foot stands with its sole flat.
struct Stand {
    glm::dvec3 place{0.0};                ///< of the foot, in the world
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< of the sole, from the body's space to the world, not 0
};

/// A foothold that is chosen by hand in place of the planned one: of the stand at a time, of which the body
/// may rest for several cycles. A stand that is timed takes the places in the leg's cycles that are nearest
/// to its moments: steps between are left out, and the leg's steps before and after make room.
struct ChosenStep {
    std::size_t leg = 0;
    double time = 0.0;       ///< s, in the stand, or in the swing before it, as planned without any times
    glm::dvec3 offset{0.0};  ///< of the rest place below which ground is looked for, in the body's space
    double turn = 0.0;       ///< rad, of the sole about the ground's normal, counter-clockwise from above
    std::optional<Stand> fixed{};   ///< the foot stands there whatever body and ground do, but for `turn`
    std::optional<double> touch{};  ///< s, when the foot touches down
    std::optional<double> until{};  ///< s, when it lifts again
};

/// How feet step and the body follows them.
struct WalkSettings {
    /// m, >= 0, height of a swinging foot half-way, above the ground under it; less in steps that are shorter
    /// than a quarter of the stride.
    double clearance = 0.1;
    double reach_up = 0.5;      ///< m, >= 0, height above a foot's rest place up to which ground is searched
    double reach_down = 1.0;    ///< m, >= 0, depth below it
    double minimum_step = 0.0;  ///< m, >= 0; shorter steps are left out
    std::vector<glm::dvec3> hips;  ///< upper ends of the legs in the body's space: one for each leg, or none
    /// How the body's own animation moves the hips in the body's space, before the body follows its feet: one
    /// for each sample, or none.
    std::vector<glm::dmat4> bodies;
    std::vector<double> lengths;                  ///< of whole legs, m in the world, >= 0: one for each hip
    dynamics::SecondOrder filter{2.0, 1.0, 0.0};  ///< of the body's height and tilt
    double height = 1.0;                          ///< share of the height that the body follows, [0, 1]
    double tilt = 1.0;
    Soles soles{};
    std::vector<ChosenStep> chosen{};  ///< of several for one stand the last one counts
};

/// A foot at a time.
struct Foot {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, of the ground; in a swing from one foothold's to the next's
    double swing = 0.0;                ///< 0 while it stands, else how far through its swing, up to 1
    /// From the body's space to the world, of the sole: flat on the ground, rolled, or in a swing between.
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
};

/// How the body follows its feet, in world space: it is turned about its own origin, then moved.
struct Correction {
    glm::dvec3 offset{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
};

/// The plan of a shot. Immutable; while a sole lies flat its foot has the same bits at all times. The plan is
/// the same for any number of threads.
class Walker {
  public:
    /// ground: none, or an empty one: feet stand on their rest places. Throws std::invalid_argument, naming
    /// the argument, if sizes differ, a number is not finite or outside its domain, there are no samples
    /// or more than most_samples, no legs or more than most_legs, or more than most_steps would be planned.
    Walker(Way way, WalkSettings settings, const Ground* ground = nullptr, const Executor& executor = {});

    [[nodiscard]] std::size_t leg_count() const noexcept { return trajectory_.way().rest.size(); }
    [[nodiscard]] Foot foot(std::size_t leg, double time) const;
    [[nodiscard]] Correction body(double time) const;
    /// Cycles since the first sample, or since the last jump; negative before.
    [[nodiscard]] double phase(double time) const;

    /// The steps of one leg, ordered by time within each stretch between jumps.
    [[nodiscard]] std::span<const Footstep> steps(std::size_t leg) const;
    /// Ordered by leg, then time.
    [[nodiscard]] std::span<const Problem> problems() const noexcept { return problems_; }
    /// The time at which the last foot has come to rest, s.
    [[nodiscard]] double settled() const noexcept { return settled_; }
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    BodyTrajectory trajectory_;
    WalkSettings settings_;
    Footsteps steps_;
    std::optional<dynamics::Track> leans_;  ///< height at the origin, and slopes along BodyTrajectory::axes
    std::vector<Problem> problems_;
    double settled_ = 0.0;
};

}  // namespace motus::walker
