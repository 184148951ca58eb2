// Keeps strands out of obstacles. Private to the library.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/strand/strand.hpp"
#include "state.hpp"

namespace motus::strand {

class Contacts {
  public:
    Contacts(std::span<const Link> links, std::span<const Obstacle> obstacles);

    /// Puts particles and links that have entered an obstacle onto it, takes away the speed at which they
    /// enter it, and as much of their sliding as friction does. before, now: two places of each obstacle at
    /// the step's beginning and end. duration: of the step, s.
    void keep_out(const Stepped& step, std::span<const glm::dvec3> before, std::span<const glm::dvec3> now,
                  double duration) const;

  private:
    struct Body {
        int parent = -1;
        double thickness = 0.0;
    };
    std::vector<Body> bodies_;
    std::vector<Obstacle> obstacles_;
};

}  // namespace motus::strand
