// Random lattices and what their tests share.
#pragma once
#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>

#include "motus/lattice/lattice.hpp"
#include "random.hpp"

namespace motus::lattice::checks {

inline constexpr std::array all_bases{Basis::bernstein, Basis::linear, Basis::cardinal, Basis::catmull_rom,
                                      Basis::bspline};

class Dice : public test::Random {
  public:
    using Random::Random;
    Lattice lattice(int most = 7) {
        Lattice result;
        result.origin = in_cube(3.0);
        result.axes = glm::mat3_cast(any_rotation());
        for (int axis = 0; axis < 3; ++axis) {
            result.axes[axis] *= between(0.5, 4.0);
            result.resolution[static_cast<std::size_t>(axis)] = whole(1, most);
            result.basis[static_cast<std::size_t>(axis)] = all_bases[static_cast<std::size_t>(whole(0, 4))];
        }
        result.axes[1] += 0.3 * result.axes[0];  // sheared
        return result;
    }
    /// A place within the lattice.
    glm::dvec3 place(const Lattice& lattice) {
        return lattice.origin + lattice.axes * (0.5 * in_cube() + 0.5);
    }
};

/// How far a place of these weights moves.
[[nodiscard]] inline glm::dvec3 moved_by(const Weights& weights, std::span<const glm::dvec3> displacements) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < weights.points.size(); ++i)
        sum += weights.weights[i] * displacements[weights.points[i]];
    return sum;
}

}  // namespace motus::lattice::checks
