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
// Costs: solving takes O(links * steps), some 60 ns for a link and a step, more with limits and obstacles;
// places() takes at most `Motion::knot` steps. The constructor allocates it all, for each link 48 bytes
// for each `knot` steps; places() allocates some memory for its work. While solve() runs a motion must not be
// used by a different thread; else any number of threads may ask at once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "motus/config.hpp"
#include "motus/strand/strand.hpp"

namespace motus::strand {

/// How a motion begins, and how it is computed.
struct Solving {
    double rate = 480.0;  ///< steps a second, [60, 1e5]
    double settle = 0.0;  ///< s, [0, 1000]: for at most so long strands come to rest in the first pose before
                          ///< the motion begins, and in that of each reset
    bool is_loop = false;  ///< the times are one cycle of an endless motion, whose last pose is the first one
    int cycles = 40;       ///< of a loop, [1, 1000]: gone through at most until it closes
};

class Motion {
  public:
    static constexpr std::size_t knot = 32;         ///< steps from one kept state to the next
    static constexpr double most_work = 4e10;       ///< links times steps
    static constexpr double most_numbers = 1.25e8;  ///< that are kept, 1 GB

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
    /// Time up to which places are known: the last one, once all is solved; of a loop the first one before.
    [[nodiscard]] double solved_until() const noexcept;
    /// Of a loop, the largest distance of a particle at the end of its last cycle from where that began; 0
    /// otherwise.
    [[nodiscard]] double gap() const noexcept;

    /// Where the particles are, at times up to solved_until(), and as at that time later. Before the first
    /// time they are as at the first one. Throws std::invalid_argument if the time is not finite or `out` has
    /// another size than there are links.
    void places(double time, std::span<glm::dvec3> out) const;
    /// Size of the memory in use.
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    struct Solver;
    std::unique_ptr<Solver> solver_;
};

}  // namespace motus::strand
