// How one contact is resolved, of a link with a solid or with another link. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "state.hpp"

namespace motus::strand {

/// Coulomb friction of a contact during one step. Bounds: the coefficient times `pushed` (m) for
/// displacements and times `stopped` (m/s) for velocities. `held` and `braked`: the parts used so far.
struct Friction {
    double pushed = 0.0, held = 0.0;
    double stopped = 0.0, braked = 0.0;
};

/// A place that has come too near to a solid, or to a place of another link. It moves as the sum of
/// particles' moves with these weights, relative to what is `carried`.
struct Contact {
    struct Term {
        std::size_t particle = 0;
        double weight = 0.0;
    };
    std::array<Term, 4> terms{};
    std::size_t count = 0;    ///< of terms
    glm::dvec3 normal{0.0};   ///< away from the solid, or from the other link
    double depth = 0.0;       ///< m; below 0 it is far enough again within the step
    glm::dvec3 carried{0.0};  ///< how the solid moves there within the step
};

/// The share of a link from its first end to its second one.
[[nodiscard]] Contact contact_on_link(std::size_t first, std::size_t second, double share);

/// Moves the contact apart, takes away the speed at which it goes deeper, and as much of its sliding as
/// friction does. The move adds no velocity, so that strands that begin inside are not thrown out.
void resolve(const Contact& contact, double coefficient, double duration, const Stepped& step,
             Friction& friction);

struct Shares {
    double first = 0.0, second = 0.0;
};

/// Where two segments are nearest, as shares of both: Ericson, "Real-Time Collision Detection" (2005), 5.1.9.
[[nodiscard]] Shares nearest(const glm::dvec3& start1, const glm::dvec3& way1, const glm::dvec3& start2,
                             const glm::dvec3& way2);

}  // namespace motus::strand
