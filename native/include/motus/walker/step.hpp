// Steps of feet (footsteps: stance and swing), and the problems of some.
//
// Costs: O(1); step_at() O(log n). Only Footsteps::add() allocates, and it alone needs the object for
// itself.
#pragma once
#include <algorithm>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/numeric.hpp"

namespace motus::walker {

/// Fraction of the distance that a foot has covered at the fraction u of its swing, [0, 1]: starts and ends
/// without speed and acceleration, with the least jerk between (Flash, Hogan, "The coordination of arm
/// movements" (1985)).
[[nodiscard]] constexpr double along(double u) {
    return u * u * u * (u * (6.0 * u - 15.0) + 10.0);
}

/// Fraction of its rise that a foot has at the fraction u of its swing: 1 half-way, starts and ends without
/// speed and acceleration.
[[nodiscard]] constexpr double above(double u) {
    const double parabola = 4.0 * u * (1.0 - u);
    return parabola * parabola * parabola;
}

/// A foot's motion from one foothold to the next, on which it stands until its next step. World space.
struct Footstep {
    double lift = 0.0;  ///< s
    double touch =
        0.0;  ///< s; equal to `lift` if the foot is put there at once: at the first sample, after jumps
    glm::dvec3 start{0.0};
    glm::dvec3 end{0.0};
    glm::dvec3 rise{0.0};  ///< half-way, the foot is at the middle of start and end, plus this
    glm::dvec3 start_normal{0.0, 0.0, 1.0};
    glm::dvec3 end_normal{0.0, 0.0, 1.0};
    bool is_grounded = true;  ///< whether there is ground at `end`
    /// Fractions of the swing, below 1 together, for which the foot goes straight up at first, and straight
    /// down at last: 0 except beside an edge, such as that of a stair.
    double upwards = 0.0, downwards = 0.0;
    /// Of the flat sole, from the body's space to the world.
    glm::dquat start_turn{1.0, 0.0, 0.0, 0.0}, end_turn{1.0, 0.0, 0.0, 0.0};
    /// rad, pitch of the sole when the foot lifts, and when it touches down: above 0 over the toe, below 0
    /// over the heel.
    double push = 0.0, strike = 0.0;
    double pushing = 0.0, striking = 0.0;  ///< s before `lift`, and after `touch`, for which the sole rolls
    double middle = 0.0;  ///< s, of the stand, or of its first cycle while the body rests; in its stretch
    std::optional<std::size_t> chosen{};  ///< index of the ChosenStep that `end` and `end_turn` follow
    double planned = 0.0;  ///< s, `middle` if no step were timed: the time by which a ChosenStep is this one

    /// Fraction of the swing at a time: 0 before the foot lifts, 1 from the touch on.
    [[nodiscard]] double through(double time) const {
        if (time >= touch) return 1.0;
        return time < lift ? 0.0 : (time - lift) / (touch - lift);  // NaN for NaN
    }
    /// How far along the way from start to end the foot is, u of its swing, [0, 1].
    [[nodiscard]] double share(double u) const {
        return along(std::clamp((u - upwards) / (1.0 - upwards - downwards), 0.0, 1.0));
    }
};

/// Why a foothold cannot be used, or not when it is wanted.
enum class Trouble {
    no_ground,     ///< within reach above and below, or around an edge: the foot is on its rest place
    out_of_reach,  ///< too far from the hip, as are all places nearer to the hip
    no_length,     ///< the leg has no length
    no_touch,      ///< the foot cannot touch down when a ChosenStep says
    no_lift,       ///< the foot cannot lift when a ChosenStep says
    left_out,      ///< a ChosenStep has no step: a timed one of the foot lasts beyond it
};

struct Problem {
    std::size_t leg = 0;
    double first = 0.0, last = 0.0;  ///< s
    Trouble trouble = Trouble::no_ground;
};

/// Steps of all legs on all stretches, each by time; a stretch of a leg begins where the foot is put.
class Footsteps {
  public:
    /// Steps, leg by leg and stretch by stretch.
    void add(std::span<const Footstep> steps) {
        steps_.insert(steps_.end(), steps.begin(), steps.end());
        ends_.push_back(steps_.size());
    }

    /// `row`: how many were added before. std::invalid_argument if there is no such row.
    [[nodiscard]] std::span<const Footstep> of(std::size_t row) const { return between(row, row + 1); }
    [[nodiscard]] std::span<const Footstep> between(std::size_t first_row, std::size_t last_row) const {
        require(first_row <= last_row && last_row <= ends_.size(), "row: must be one that was added");
        const std::size_t first = first_row == 0 ? 0 : ends_[first_row - 1];
        const std::size_t last = last_row == 0 ? 0 : ends_[last_row - 1];
        return std::span<const Footstep>(steps_).subspan(first, last - first);
    }
    [[nodiscard]] std::size_t bytes() const noexcept {
        return steps_.capacity() * sizeof(Footstep) + ends_.capacity() * sizeof(std::size_t);
    }

  private:
    std::vector<Footstep> steps_;
    std::vector<std::size_t> ends_;
};

/// The last step that has begun at a time, or the first step if none has. std::invalid_argument if there is
/// none.
[[nodiscard]] inline const Footstep& step_at(std::span<const Footstep> steps, double time) {
    require(!steps.empty(), "steps: one at least is needed");
    const auto after = std::ranges::upper_bound(steps, time, {}, &Footstep::lift);
    return after == steps.begin() ? steps.front() : *(after - 1);
}

}  // namespace motus::walker
