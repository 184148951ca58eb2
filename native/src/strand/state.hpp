// The moving numbers of strands, and what the parts of a step share. Private to the library.
#pragma once
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "flow.hpp"
#include "motus/strand/strand.hpp"

namespace motus::strand {

/// Of each link, the root of its strand.
[[nodiscard]] inline std::vector<std::size_t> roots_of(std::span<const Link> links) {
    std::vector<std::size_t> roots(links.size());
    for (std::size_t i = 0; i < links.size(); ++i)
        roots[i] = links[i].parent < 0 ? i : roots[static_cast<std::size_t>(links[i].parent)];
    return roots;
}

/// Links in an order in which parents come first and neighbours are of different strands, some at a time:
/// while a link waits for its parent's result, the processor goes on with others.
[[nodiscard]] std::vector<std::size_t> interleaved(std::span<const Link> links);

/// Of each particle.
struct State {
    std::vector<glm::dvec3> places;
    std::vector<glm::dvec3> velocities;
};

/// How a particle answers to an impulse at the beginning of a step. At the end of the step the particle is
/// displaced by `displacement * impulse`, and its velocity is changed by `speed` times the displacement. Both
/// are 0 for a particle that is held.
struct Mobility {
    double displacement = 0.0;  ///< s/kg
    double speed = 0.0;         ///< 1/s
};

/// One step of all particles. `before` are places at its beginning, `state` those at its end as far as they
/// are known.
struct Stepped {
    std::span<const glm::dvec3> before;
    std::span<const Mobility> mobilities;
    State& state;

    /// Moves a particle and gives it the velocity of that.
    void kick(std::size_t particle, const glm::dvec3& way) const {
        state.places[particle] += way;
        state.velocities[particle] += mobilities[particle].speed * way;
    }
};

}  // namespace motus::strand
