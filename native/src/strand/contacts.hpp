// Keeps strands out of obstacles. Private to the library.
#pragma once
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "contact.hpp"
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
    void resolve_obstacles(const Stepped& step, std::span<const glm::dvec3> before,
                           std::span<const glm::dvec3> now, double duration);

    /// The same for surfaces. before, now: their matrices at the step's beginning and end.
    void resolve_surfaces(const Stepped& step, std::span<const glm::dmat4> before,
                          std::span<const glm::dmat4> now, double duration);

  private:
    struct Body {
        int parent = -1;
        double thickness = 0.0;
    };
    std::vector<Body> bodies_;
    /// Of each obstacle with each link; then of each surface with each end, and with each middle.
    std::vector<Friction> frictions_;
    std::vector<Obstacle> obstacles_;
    std::vector<PlacedSurface> surfaces_;
};

}  // namespace motus::strand
