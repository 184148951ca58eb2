// Holds the lengths of links: one step of Newton's method for all links of strands at once. Private to the
// library.
//
// What the links of a strand demand of each other is a matrix with the strand's own shape, a tree. It is
// solved from the tips to the roots and back (Thomas' algorithm, for trees), in O(links).
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
    /// What the links beyond make of a particle's yielding: `yielding` (1 - share now^T) along `before`, of
    /// one link; a matrix, where several meet.
    struct Branch {
        double yielding = 0.0;
        double share = 0.0;  ///< of an impulse along the link beyond that this link takes over
        glm::dvec3 before{0.0}, now{0.0};
        glm::dvec3 way{0.0};
        int matrix = -1;  ///< index in matrices_, or -1: at most one link so far
    };

    [[nodiscard]] glm::dvec3 answer(const Branch& branch, const glm::dvec3& impulse) const;
    void join(Branch& branch, const Row& row);
    [[nodiscard]] double off(std::size_t i, const Stepped& step, std::span<const double> lengths,
                             double frequency) const;
    [[nodiscard]] bool is_off(const Stepped& step, std::span<const double> lengths, double duration,
                              double most) const;
    void gather(const Stepped& step, std::span<const double> lengths, double duration);
    void scatter();
    void apply(const Stepped& step);
    void lay(const Stepped& step, std::span<const double> lengths, double duration);
    [[nodiscard]] bool brace(std::span<const double> lengths);

    std::vector<int> parents_;
    std::vector<std::size_t> roots_;
    std::vector<char> stretches_;      ///< whether a link may be longer
    std::vector<double> compliances_;  ///< 1/N, times the length
    std::vector<Branch> branches_;     ///< of particles, as far as they are gathered
    std::vector<int> meetings_;        ///< of each particle, its row in matrices_ if several links meet in it
    std::vector<glm::dmat3> matrices_;
    std::vector<Row> rows_;
    std::vector<glm::dvec3> ways_;
    std::vector<double> impulses_;     ///< of the links in this step so far, N s
    std::vector<double> more_;         ///< of one round
    std::vector<double> yieldings_;    ///< of particles, as they count in this step, s/kg
    std::vector<double> stiffnesses_;  ///< of taut links against what moves a particle across them, N s/m
    std::vector<char> is_braced_;      ///< particles that count as heavier
    std::vector<char> is_along_now_;   ///< links whose impulses act along what they are at the step's end
    std::vector<char> is_lost_;        ///< by roots
};

}  // namespace motus::strand
