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
    /// masses: of the particles as they count, kg.
    Lengths(std::span<const Link> links, std::span<const double> masses);

    /// Moves particles so that links are as long as they should be, `lengths`, at the end of the step.
    /// Impulses act at its beginning, along what the links were then.
    void hold(const Stepped& step, std::span<const double> lengths, double duration);

  private:
    /// A link as seen from its particle, once all beyond is eliminated.
    struct Row {
        glm::dvec3 before{0.0}, now{0.0};  ///< unit vectors along the link
        glm::dvec3 answer{0.0};            ///< displacement of the particle by an impulse of 1 along `before`
        glm::dvec3 displacement{0.0};      ///< of the particle without an impulse of this link
        double excess = 0.0;               ///< by how much the link is too long, by `displacement` alone
        double divisor = 0.0;              ///< by how much an impulse of 1 lengthens it, if the parent rests
    };
    /// What the links beyond make of a particle's mobility M: M (1 - share before now^T), with one link
    /// beyond; a matrix, where several meet.
    struct Branch {
        double mobility = 0.0;
        double share = 0.0;
        glm::dvec3 before{0.0}, now{0.0};  ///< of the link beyond
        glm::dvec3 displacement{0.0};
        int matrix = -1;  ///< index in matrices_, or -1: at most one link beyond
    };

    [[nodiscard]] glm::dvec3 answer(const Branch& branch, const glm::dvec3& impulse) const;
    void join(Branch& branch, const Row& row);
    /// By how much a link is too long, m: `whole`, and what of that its impulse does not explain. Both are 0
    /// if neither end can move.
    struct Error {
        double whole = 0.0, unexplained = 0.0;
    };
    [[nodiscard]] Error length_error(std::size_t i, const Stepped& step, std::span<const double> lengths,
                                     double frequency) const;
    [[nodiscard]] bool find_open(const Stepped& step, std::span<const double> lengths, double duration,
                                 double most);
    void eliminate(const Stepped& step, std::span<const double> lengths, double duration);
    void substitute();
    void apply(const Stepped& step);
    void project_lost(const Stepped& step, std::span<const double> lengths, double duration);
    [[nodiscard]] bool add_geometric_stiffness(std::span<const double> lengths);

    std::vector<int> parents_;
    std::vector<std::size_t> order_;  ///< of links, parents first
    std::vector<std::size_t> roots_;
    std::vector<char> is_rigid_;
    std::vector<double> compliances_;  ///< of links a metre long, m/N
    std::vector<Branch> branches_;     ///< of particles, as far as links beyond are eliminated
    std::vector<int> meetings_;        ///< of each particle, its row in matrices_ if several links meet in it
    std::vector<glm::dmat3> matrices_;
    std::vector<Row> rows_;
    std::vector<glm::dvec3> displacements_;  ///< of particles in one round
    std::vector<double> impulses_;           ///< of the links in this step so far, N s
    std::vector<double> corrections_;        ///< of the impulses in one round
    std::vector<double> mobilities_;         ///< of particles, as they count in this step, s/kg
    std::vector<double> stiffnesses_;  ///< of taut links against what moves a particle across them, N s/m
    std::vector<char> is_stiff_;       ///< particles that count as heavier
    std::vector<char> is_along_now_;   ///< links whose impulses act along what they are at the step's end
    std::vector<char> is_open_;        ///< by roots: strands whose lengths are not right yet
    std::vector<char> is_between_;     ///< by roots: strands that are held in more places than the root
    bool is_far_off_ = false;          ///< whether a link was wrong by more than a strand may be
    double links_at_most_ = 1.0;       ///< that meet in one particle
    std::vector<char> is_lost_;        ///< by roots: strands whose lengths no impulses make right
};

}  // namespace motus::strand
