// Strands under gravity, wind, springs towards an animated pose, limits and contacts: solved once from the
// start, then read at any time.
//
// Position-based dynamics with small steps (Macklin et al., "Small Steps in Physics Simulation", 2019) of a
// length fixed in seconds, so that the frame rate does not matter. Springs, gravity and drag of each particle
// are integrated exactly. Lengths are held by one linear solve for all links of a strand, along the links'
// former directions (SHAKE: Ryckaert, Ciccotti, Berendsen, "Numerical integration of the Cartesian equations
// of motion of a system with constraints", 1977), which makes swings of second order in the step, without
// loss of energy.
//
// Costs: solve() takes O(links * steps): some 60 ns for a link and a step, more with limits, obstacles and
// surfaces. places() takes at most `Motion::knot` + 1 steps, and allocates memory for them. A motion keeps a
// copy of its inputs, and 48 bytes for each link and each `knot` steps. solve() must have the motion for
// itself; any number of threads may call places() at once.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "motus/config.hpp"
#include "motus/strand/strand.hpp"

namespace motus::strand {

/// How a motion begins, and how it is computed.
struct Solving {
    double rate = 480.0;  ///< steps a second, [60, 1e5]
    /// s, [0, 1000]: longest simulated time for strands to come to rest in the pose, before the first time
    /// and at each reset.
    double settle = 0.0;
    bool is_loop = false;  ///< the times are one cycle of an endless motion, whose last pose is the first one
    int cycles = 40;       ///< of a loop, [1, 1000]: most simulated cycles until the end meets the beginning
};

class Motion {
  public:
    static constexpr std::size_t knot = 32;         ///< steps from one kept state to the next
    static constexpr double most_work = 4e10;       ///< links times steps, and times obstacles
    static constexpr double most_numbers = 1.25e8;  ///< doubles in kept states: 1 GB

    /// Throws std::invalid_argument, naming the argument, if a size does not fit, a number is outside its
    /// domain, or there would be more to do or to keep than most_work and most_numbers. A loop may have no
    /// resets. What the spans show is copied.
    Motion(std::span<const Link> links, const Inputs& inputs, const Solving& solving = {});
    ~Motion();
    // What is moved from has no links, and is solved.
    Motion(Motion&& other) noexcept;
    Motion& operator=(Motion&& other) noexcept;
    Motion(const Motion&) = delete;
    Motion& operator=(const Motion&) = delete;

    [[nodiscard]] std::size_t size() const noexcept;  ///< number of links

    /// Goes on for about so many steps; returns whether all is solved.
    bool solve(std::size_t steps);
    [[nodiscard]] bool is_solved() const noexcept;
    /// The last time if all is solved. Until then the latest solved time; in a loop, the first time.
    [[nodiscard]] double solved_until() const noexcept;
    /// Of a loop, the largest distance of a particle at the end of its last cycle from where that began, or
    /// the way by which their velocities differ within a step, if that is more; 0 otherwise.
    [[nodiscard]] double gap() const noexcept;

    /// Positions of the particles. Times after solved_until() count as solved_until(). Times before the first
    /// one count as the first one; a solved loop repeats in both directions instead. Throws
    /// std::invalid_argument if the time is not finite, or `out` has another size than there are links.
    void places(double time, std::span<glm::dvec3> out) const;
    /// The number of pairs of links that are so near each other in the first pose that they may touch.
    [[nodiscard]] std::size_t near_pairs() const;
    /// Size of the memory in use.
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    struct Solver;
    std::unique_ptr<Solver> solver_;
};

}  // namespace motus::strand
