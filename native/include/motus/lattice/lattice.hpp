// Free-form deformation by a lattice, and lattices that are pulled by points of what they deform.
// Sederberg, Parry, "Free-Form Deformation of Solid Geometric Models" (1986); the bases of Blender's Lattice
// modifier; Hsu, Hughes, Kaufman, "Direct Manipulation of Free-Form Deformations" (1992).
//
// Costs: deform() takes O(n taps), 2 to 64 taps along an axis; pull_lattice() O(m^3) in the smaller of the
// numbers of pulls and of points that they move; boxes O(n). All allocate some memory for their work. Any
// number of threads at once.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"

namespace motus::lattice {

/// How many places each lattice point acts on along one axis. With n points at equal steps:
///   bernstein           all of them, the polynomials of degree n - 1 over the whole axis
///   linear              the two points around a place
///   bspline             the four around it, uniform cubic; the surface does not pass through the points
///   catmull_rom         the four around it, through the points; tangents 0.5 of the way between neighbours
///   cardinal            the four around it, through the points; tangents 0.71 of the way between neighbours
/// Beyond the ends the last point stands for the missing ones, as in Blender.
enum class Basis { bernstein, linear, cardinal, catmull_rom, bspline };

inline constexpr int max_resolution = 64;  ///< points along an axis, Blender's own limit

/// Greatest number of pulls at once, if they move as many lattice points: the work grows with the cube of the
/// smaller of the two numbers.
inline constexpr std::size_t max_pulls = 1000;

/// A lattice at rest: a grid of points in a parallelepiped. Any space, any unit of length. Points are counted
/// with u fastest, then v, then w.
struct Lattice {
    glm::dvec3 origin{0.0};  ///< of the first point
    glm::dmat3 axes{1.0};    ///< columns: from the first to the last point along u, v and w; independent
    std::array<int, 3> resolution{2, 2,
                                  2};  ///< points along u, v, w: 1 to max_resolution; 1: no change along it
    std::array<Basis, 3> basis{Basis::bspline, Basis::bspline, Basis::bspline};
};

/// Throws std::invalid_argument if the resolution is out of its domain.
[[nodiscard]] std::size_t point_count(const Lattice& lattice);

/// The points' positions at rest, point_count() of them. This and the next functions throw
/// std::invalid_argument if the resolution is out of its domain, the origin or an axis is not finite or
/// larger than 1e100, or the axes are not independent.
[[nodiscard]] std::vector<glm::dvec3> rest_points(const Lattice& lattice);

/// How much each lattice point moves a place: the place moves by the sum of weight * displacement of the
/// point. The weights' sum is 1 (to 1e-15; only cardinal and catmull_rom have negative weights).
struct Weights {
    std::vector<std::uint32_t> points;  ///< ascending, each once
    std::vector<double> weights;
};

[[nodiscard]] Weights weights_at(const Lattice& lattice, const glm::dvec3& place);

/// What a lattice does to positions beyond its points; empty spans mean 1 everywhere.
struct Influence {
    std::span<const float>
        positions;  ///< factor of each position: the modifier's strength times the vertex's weight
    std::span<const float> points;  ///< weight of each lattice point (Blender's vertex group of the lattice)
};

/// out[i] = positions[i] + f (sum of weight * displacement), f the influence. `displacements` are those of
/// the lattice points from rest, in the space of the positions. With weights of lattice points w the change
/// is faded once more by f (sum of weight * w), as in Blender. `out` may be `positions`. Positions where f is
/// 0 keep their bits. Computed in single precision on several threads; the bits do not depend on their
/// number. Throws std::invalid_argument if sizes differ. A number that is not finite makes the results that
/// it is a part of not finite.
void deform(const Lattice& lattice, std::span<const glm::vec3> displacements, const Influence& influence,
            std::span<const glm::vec3> positions, std::span<glm::vec3> out, const Executor& executor = {});

/// Part of a point that is pulled: a place with a weight, `share`, which the lattice moves with `influence`.
/// A point on a triangle has three parts, whose shares are its barycentric coordinates.
struct Part {
    std::size_t pull = 0;   ///< index of the pull
    glm::dvec3 place{0.0};  ///< before the lattice deforms it
    double share = 1.0;
    double influence = 1.0;  ///< as Influence::positions
};

struct PullOptions {
    /// Bound, > 0: the lattice points together (root of the sum of squares) move at most this many times
    /// as much as the pulls by themselves, each at full influence, would need. Pulls that need more (opposite
    /// pulls on neighbours, a vertex of nearly no weight) are not reached, continuously so.
    double max_gain = 32.0;
    /// Only the points of the outside are free; those inside follow as with Blender's "Outside".
    bool outside_only = false;
    std::span<const float> point_weights;  ///< Influence::points
};

/// The smallest displacements (by the sum of squares) of the lattice points, to be added to those they have,
/// by which each pull's point moves by displacements[pull], or as nearly as possible (least squares). Returns
/// the difference, displacement - reached, for each pull. out: point_count() values. Throws
/// std::invalid_argument if sizes differ, a part names no pull, a value is not finite, both the pulls and the
/// lattice points that they move are more than max_pulls, or the weights of all pulls' points, which are
/// kept, are more than 16 million (which no basis of Blender's needs); `out` is then as it was.
std::vector<glm::dvec3> pull_lattice(const Lattice& lattice, std::span<const Part> parts,
                                     std::span<const glm::dvec3> displacements, const PullOptions& options,
                                     std::span<glm::dvec3> out);

/// A box of any orientation.
struct OrientedBox {
    glm::dvec3 center{0.0};
    glm::dmat3 axes{1.0};  ///< columns: orthonormal and right-handed
    glm::dvec3 size{0.0};  ///< whole lengths along them, >= 0
};

/// The box along given orthonormal axes around all points; at the origin and of no size if there are none.
/// This and the next function throw std::invalid_argument if a point is not finite, or the axes are not
/// orthonormal.
[[nodiscard]] OrientedBox box_along(std::span<const glm::vec3> points, const glm::dmat3& axes);

/// A small box around all points: turning it about one of its axes does not make it smaller, and it is not
/// larger than the box along the given axes. Its axes are ordered and signed to be near the given ones.
[[nodiscard]] OrientedBox small_box(std::span<const glm::vec3> points, const glm::dmat3& axes,
                                    const Executor& executor = {});

}  // namespace motus::lattice
