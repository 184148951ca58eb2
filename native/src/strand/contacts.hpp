// Keeps strands out of obstacles. Private to the library.
#pragma once
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/strand/strand.hpp"
#include "state.hpp"

namespace motus::strand {

class Contacts {
  public:
    Contacts(std::span<const Link> links, std::span<const Obstacle> obstacles,
             std::span<const PlacedSurface> surfaces);

    /// Forgets what friction has done: at the beginning of each step.
    void begin();

    /// Puts particles and links that have entered an obstacle onto it, takes away the speed at which they
    /// enter it, and as much of their sliding as friction does. before, now: two places of each obstacle at
    /// the step's beginning and end. duration: of the step, s.
    void keep_out(const Stepped& step, std::span<const glm::dvec3> before, std::span<const glm::dvec3> now,
                  double duration);

    /// The same of surfaces, whose matrices these are.
    void keep_apart(const Stepped& step, std::span<const glm::dmat4> before, std::span<const glm::dmat4> now,
                    double duration);

    /// What friction may take away in a step, which is as much as contacts push, and what it has taken. Both
    /// as ways (m) and as velocities (m/s).
    struct Friction {
        double pushed = 0.0, held = 0.0;
        double stopped = 0.0, braked = 0.0;
    };

  private:
    struct Body {
        int parent = -1;
        double thickness = 0.0;
    };
    [[nodiscard]] Friction& of_end(std::size_t link) { return frictions_[2 * link + 1]; }

    std::vector<Body> bodies_;
    std::vector<Friction> frictions_;  ///< of the middle and the end of each link
    std::vector<Obstacle> obstacles_;
    std::vector<PlacedSurface> surfaces_;
};

}  // namespace motus::strand
