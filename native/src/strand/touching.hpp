// Keeps the links of strands away from each other. Private to the library.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "contact.hpp"
#include "motus/strand/strand.hpp"
#include "state.hpp"

namespace motus::strand {

class Touching {
  public:
    /// Without `is_on` it does nothing. pose: the first one, of all particles.
    Touching(std::span<const Link> links, std::span<const glm::dvec3> pose, bool is_on, double friction);

    /// Finds the links that may come near each other in a step, and forgets what friction has done: after
    /// particles have moved freely. Which pairs come first depends on the places alone.
    void begin(const Stepped& step);

    /// Moves links apart that are too near, and takes away the speed at which they come nearer.
    void resolve_pairs(const Stepped& step, double duration);

    /// The number of pairs found by the latest begin().
    [[nodiscard]] std::size_t pairs() const noexcept { return pairs_.size(); }

  private:
    struct Body {
        std::size_t parent = 0, particle = 0;
        double thickness = 0.0;
    };
    /// What a link may sweep in a step, with its thickness.
    struct Box {
        glm::dvec3 low{0.0}, high{0.0};
        std::size_t body = 0;
    };
    struct Pair {
        std::size_t first = 0, second = 0;  ///< bodies
        double reach = 0.0;                 ///< m, how far apart they are to be
        Friction friction;
    };
    [[nodiscard]] static bool are_joined(const Body& first, const Body& second);

    std::vector<Body> bodies_;  ///< links with a thickness
    std::vector<glm::dvec3> pose_;
    double friction_ = 0.0;
    std::vector<Box> boxes_;
    std::vector<int> counts_;  ///< of each body, its pairs
    std::vector<Pair> pairs_;
};

}  // namespace motus::strand
