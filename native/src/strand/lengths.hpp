// Holds the lengths of links: one step of Newton's method for all links of strands at once. Private to the
// library.
//
// What the links of a strand demand of each other is a matrix with the strand's own shape, a tree. It is solved
// from the tips to the roots and back (Thomas' algorithm, for trees), in O(links).
#pragma once
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/strand/strand.hpp"
#include "state.hpp"

namespace motus::strand {

class Lengths {
  public:
    explicit Lengths(std::span<const Link> links);

    /// Moves particles so that links are as long as they should be, `lengths`, at the end of the step.
    /// Impulses act at its beginning, along what the links were then.
    void hold(const Stepped& step, std::span<const double> lengths, double duration);

  private:
    /// A link as seen from its particle, once all beyond is eliminated.
    struct Row {
        glm::dvec3 before{0.0}, now{0.0};  ///< unit vectors along the link
        glm::dvec3 answer{0.0};            ///< way of the particle by an impulse of 1 along `before`
        glm::dvec3 way{0.0};               ///< of the particle without an impulse of this link
        double excess = 0.0;               ///< by how much the link is too long, by `way` alone
        double divisor = 0.0;              ///< by how much an impulse of 1 lengthens it, if the parent rests
    };
    /// What the links beyond make of a particle's yielding.
    struct Branch {
        glm::dmat3 answer{0.0};
        glm::dvec3 way{0.0};
    };

    [[nodiscard]] double farthest_off(const Stepped& step, std::span<const double> lengths,
                                      double duration) const;
    void gather(const Stepped& step, std::span<const double> lengths, double duration);
    void scatter();
    void apply(const Stepped& step);
    void lay(const Stepped& step, std::span<const double> lengths, double duration) const;
    [[nodiscard]] bool brace(std::span<const double> lengths);

    std::vector<int> parents_;
    std::vector<double> compliances_;  ///< m/N
    std::vector<Branch> branches_;     ///< of particles, as far as they are gathered
    std::vector<Row> rows_;
    std::vector<glm::dvec3> ways_;
    std::vector<double> impulses_;  ///< of the links in this step so far, N s
    std::vector<double> more_;      ///< of one round
    std::vector<double> yieldings_;    ///< of particles, as they count in this step, s/kg
    std::vector<double> stiffnesses_;  ///< of taut links against what moves a particle across them, N s/m
    std::vector<char> is_braced_;      ///< particles that count as heavier
    std::vector<char> is_along_now_;  ///< links whose impulses act along what they are at the step's end
};

}  // namespace motus::strand
