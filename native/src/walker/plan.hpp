// Makes the plan of a shot. Private to the library.
#pragma once
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "footing.hpp"
#include "motus/core/executor.hpp"
#include "motus/walker/walker.hpp"
#include "sole.hpp"
#include "timing.hpp"

namespace motus::walker {

struct WalkPlan {
    Footsteps steps;
    dynamics::Track leans;
    std::vector<Problem> problems;
    double settled = 0.0;
};

/// How a body with a pose of its own follows its feet: by the shares of height and tilt in `settings`.
[[nodiscard]] Correction corrected(const WalkSettings& settings, const glm::dvec3& lean, const Axes& axes);

/// Throws std::invalid_argument, naming the argument, if more than most_steps would be planned.
class Planner {
  public:
    Planner(const WalkSettings& settings, const BodyTrajectory& trajectory, const Ground* ground,
            Executor executor);
    [[nodiscard]] WalkPlan plan();

  private:
    /// A foot's stand in one cycle, and its swing before.
    struct Footfall {
        double lift_cycles = 0.0;   ///< BodyTrajectory::cycles() when it is planned to lift
        double touch_cycles = 0.0;  ///< and to touch down
        double lift = 0.0;          ///< s
        double touch = 0.0;         ///< s
        double until = 0.0;         ///< when the next cycle's swing begins, s
        Search search;
        Contact place;
        bool is_grounded = true;
        double middle = 0.0;                  ///< of the stand, s
        double planned = 0.0;                 ///< `middle` if no step were timed, s
        Pace pace;                            ///< of the gait when the foot lifts
        glm::dmat4 pose{1.0};                 ///< of the body then
        std::optional<std::size_t> chosen{};  ///< index in WalkSettings::chosen
    };
    /// Footfalls of a leg on one stretch; at the first one the foot is put.
    using Footfalls = std::vector<Footfall>;
    /// A stand that is chosen: footfalls from `first` on, before `end`.
    struct ChosenStand {
        std::size_t chosen = 0;  ///< index in WalkSettings::chosen
        std::size_t first = 0, end = 0;
    };
    /// The moments of a timed step, s, without those that are refused.
    struct Moments {
        std::optional<double> touch, until;
    };
    /// A moment of a footfall that is set.
    struct SetMoment {
        std::size_t fall = 0;                ///< index of the footfall
        double Footfall::*moment = nullptr;  ///< lift or touch
        double planned = 0.0;                ///< cycles
        double time = 0.0;                   ///< s
    };
    /// What footfalls timed stands take.
    struct Room {
        std::vector<ChosenStand> stands;
        std::vector<SetMoment> moments;  ///< by time
        std::vector<char> is_left_out;   ///< of the footfalls, those that are passed over
    };

    /// Calls work(leg) for all legs, on several threads if that pays.
    template <class Work>
    void for_legs(const Work& work) const;
    [[nodiscard]] std::size_t row(std::size_t leg, std::size_t stretch) const {
        return leg * trajectory_.stretch_count() + stretch;
    }
    [[nodiscard]] Footfalls footfalls(std::size_t leg, std::size_t stretch) const;
    /// Adds to the rising cycles in which a timed leg has footfalls some after the last one: the next ones,
    /// and those that are nearest to moments long after the body has come to rest.
    void add_spare(std::size_t leg, std::size_t stretch, std::vector<double>& cycles) const;
    void find_place(Footfall& fall) const;
    /// Where a footfall is whose stand has its middle at a time, s.
    void stand_at(std::size_t leg, std::size_t stretch, double middle, Footfall& fall) const;
    /// Steps between nearer places are left out, m.
    [[nodiscard]] double least_step(const Footfall& fall) const;
    /// Makes the footfalls of a leg on a stretch, with the moments of timed steps that are left in moments_.
    void place(std::size_t leg, std::size_t stretch);
    /// Gives each row its chosen steps, and their moments in its stretch.
    void sort_chosen();
    /// Whether a chosen step, or one of a row, has a moment that is not refused.
    [[nodiscard]] bool has_moments(std::size_t chosen) const {
        return moments_[chosen].touch.has_value() || moments_[chosen].until.has_value();
    }
    [[nodiscard]] bool is_timed(std::size_t of_row) const;
    /// How many footfalls of a stretch lift before the body jumps to the next one, one at least.
    [[nodiscard]] std::size_t happening(std::size_t stretch, const Footfalls& falls) const;
    /// The stands of a leg that are chosen, by time.
    [[nodiscard]] std::vector<ChosenStand> chosen_stands(std::size_t leg, std::size_t stretch,
                                                         const Footfalls& falls) const;
    /// Puts footfalls where, and when, they are chosen to be. Returns the indices in WalkSettings::chosen of
    /// timed stands, and of those that have no step because a timed one lasts beyond them.
    std::vector<std::size_t> choose(std::size_t leg, std::size_t stretch, Footfalls& falls) const;
    /// Gives timed stands the footfalls that are nearest to their moments. The stands are then of one
    /// footfall each, without those that have none left.
    [[nodiscard]] Room room_for(std::size_t leg, std::size_t stretch, Footfalls& falls,
                                const std::vector<ChosenStand>& stands) const;
    /// Sets the moments, and has the footfalls around make room. Returns by how much moments were moved.
    [[nodiscard]] Timing set_moments(std::size_t leg, std::size_t stretch, Footfalls& falls,
                                     const Room& room) const;
    /// Leaves out footfalls that are passed over, and has stands whose times have changed find their places.
    void close_up(std::size_t leg, std::size_t stretch, Footfalls& falls, Room& room,
                  const Timing& timing) const;
    /// Refuses moments at which the footfalls of a row do not touch down or lift. Returns whether there were
    /// any: the row is then to be made without them.
    [[nodiscard]] bool refuse_missed(std::size_t of_row);
    /// Adds a problem for each moment at which a timed step does not touch down or lift, and for each chosen
    /// step that is left out.
    void add_mistimed(std::size_t of_row, std::span<const Footstep> steps, std::vector<Problem>& found) const;
    /// Turn of the flat sole, from the body's space to the world.
    [[nodiscard]] glm::dquat turn_of(const Footfall& fall) const;
    /// Where a foot is that stands on the ground that is found, its ankle above the sole.
    [[nodiscard]] std::optional<Contact> foothold(const Search& search) const;
    /// Moves footholds that are out of reach nearer to the hip. Returns whether there were any that could be
    /// moved.
    [[nodiscard]] bool move_nearer(std::size_t leg, std::size_t stretch, Footfalls& falls) const;
    [[nodiscard]] std::vector<Footstep> steps_of(const Footfalls& falls, bool looks_for_obstacles) const;
    [[nodiscard]] Footsteps all_steps(bool looks_for_obstacles) const;
    [[nodiscard]] dynamics::Track leans_of(const Footsteps& steps) const;
    void correct(const dynamics::Track& leans);
    [[nodiscard]] std::vector<Problem> problems(std::size_t leg, std::size_t stretch,
                                                std::span<const Footstep> steps) const;

    [[nodiscard]] bool has_reach(std::size_t leg) const {
        return !settings_.lengths.empty() && settings_.lengths[leg] > 0.0;
    }
    /// Position of a leg's hip when the body follows its feet, at a sample, or at a time between two samples.
    [[nodiscard]] glm::dvec3 hip_at(std::size_t leg, std::size_t sample) const;
    [[nodiscard]] glm::dvec3 hip_after(std::size_t leg, std::size_t sample, double time) const;
    [[nodiscard]] double longest_reach(std::size_t leg) const;
    /// Whether a place is out of the hip's reach at any time within these times of a stretch.
    [[nodiscard]] bool is_missed(std::size_t leg, std::size_t stretch, const glm::dvec3& place, double from,
                                 double until) const;
    /// Adds a problem for each run of samples, within these times, at which a place is out of the hip's
    /// reach. Times between samples are not examined.
    void add_missed(std::size_t leg, std::size_t stretch, const glm::dvec3& place, double from, double until,
                    std::vector<Problem>& found) const;

    const WalkSettings& settings_;
    const BodyTrajectory& trajectory_;
    const Ground* ground_;  ///< none if it is empty
    Reach reach_;
    SoleFrame soles_;
    Executor executor_;
    std::vector<glm::dvec3> hips_;                  ///< the settings', or the middle of all feet for each leg
    std::vector<Footfalls> falls_;                  ///< by row()
    std::vector<std::vector<std::size_t>> chosen_;  ///< by row(): indices in WalkSettings::chosen, rising
    std::vector<Moments> moments_;                  ///< of each of WalkSettings::chosen
    std::vector<std::vector<std::size_t>> uncertain_;  ///< by row(): what choose() has returned
    std::vector<Correction> corrections_{};            ///< at samples
};

}  // namespace motus::walker
