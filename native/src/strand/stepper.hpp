// One step of strands: free motion, lengths, limits, contacts. Private to the library.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bends.hpp"
#include "contacts.hpp"
#include "flow.hpp"
#include "lengths.hpp"
#include "motus/strand/motion.hpp"
#include "motus/strand/strand.hpp"
#include "samples.hpp"
#include "state.hpp"
#include "straightening.hpp"
#include "touching.hpp"

namespace motus::strand {

/// What moves strands at one time.
struct Driven {
    std::vector<glm::dvec3> pose;
    std::vector<glm::dvec3> sides;  ///< none, if nothing is limited by them
    std::vector<glm::dvec3> obstacles;
    std::vector<glm::dmat4> surfaces;
    std::vector<glm::dvec3> pins;
    std::vector<double> pin_weights;
    glm::dvec3 gravity{0.0}, air{0.0};
};

/// Knows links and inputs, of which it has copies, and steps states from one time to the next. Immutable.
class Stepper {
  public:
    /// What a step works on; belongs to one thread.
    class Work;

    Stepper(std::span<const Link> links, const Inputs& inputs, const Solving& solving);

    [[nodiscard]] const Times& times() const noexcept { return times_; }
    [[nodiscard]] std::size_t size() const noexcept { return links_.size(); }
    /// Of a link, the root of its strand.
    [[nodiscard]] std::size_t root(std::size_t link) const { return roots_[link]; }
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// Everything over time at `time`, of samples from `first` to `last`.
    void read(double time, std::size_t first, std::size_t last, Driven& out) const;
    /// The state at rest in a pose.
    void start(const Driven& driven, State& state) const;
    /// Positions at two steps that follow each other, and at the one before them, if there is one.
    struct Near {
        std::span<const glm::dvec3> earlier, before, after;
    };
    /// Positions at the fraction `share` of the step from `near.before` to `near.after`. driven: at that
    /// time.
    void between(const Near& near, double share, const Driven& driven, std::span<glm::dvec3> out) const;
    /// From the driven at its beginning to that at its end, `duration` later.
    void step(State& state, const Driven& before, const Driven& now, double duration, Work& work) const;
    /// The number of pairs of links that are near each other in the first pose.
    [[nodiscard]] std::size_t near_pairs() const;

  private:
    friend class Work;
    /// Of one particle: how its spring takes part in what pulls it.
    struct Spring {
        double pull = 0.0;        ///< 1/s^2
        double lead = 0.0;        ///< 1/s, times the velocity of the pose
        double resistance = 0.0;  ///< 1/s, with the drag
        double drag = 0.0;        ///< 1/s
        double gravity = 1.0;     ///< how many times it counts
    };
    [[nodiscard]] std::optional<glm::dvec3> held_place(std::size_t particle, const Driven& driven) const;
    void flow(State& state, const Driven& before, const Driven& now, double duration, Work& work) const;
    void hold(State& state, const Driven& before, const Driven& now, double duration, Work& work) const;

    std::vector<Link> links_;
    std::vector<std::size_t> roots_;  ///< of each link, that of its strand
    std::vector<Spring> springs_;
    std::vector<double> masses_;  ///< as they count, kg
    std::vector<Obstacle> obstacles_;
    std::vector<PlacedSurface> surfaces_;
    std::vector<std::size_t> pinned_;
    std::vector<int> pins_;  ///< of each particle: its row in pinned_, or -1
    Times times_;
    Rows<glm::dvec3> poses_, sides_, gravity_, air_, obstacle_places_, pin_places_;
    Rows<glm::dmat4> surface_matrices_;
    Rows<double> pin_weights_;
    bool are_touching_;
    double friction_;
    double stiffest_;  ///< rad/s, of a spring that a step resolves
};

class Stepper::Work {
  public:
    explicit Work(const Stepper& stepper);

  private:
    friend class Stepper;
    /// The flow of a particle that is pinned, of the weight that it was made for.
    struct PinFlow {
        double weight = -1.0;
        double pull = 0.0, resistance = 0.0;  ///< of the pin alone
        Flow flow;
    };

    Lengths lengths_;
    Straightening straightening_;
    Bends bends_;
    Contacts contacts_;
    Touching touching_;
    double duration_ = 0.0;  ///< that flows_ are made for
    std::vector<Flow> flows_;
    std::vector<PinFlow> pin_flows_;
    std::vector<Mobility> mobilities_;
    std::vector<glm::dvec3> before_;
    std::vector<double> wanted_lengths_;
};

}  // namespace motus::strand
