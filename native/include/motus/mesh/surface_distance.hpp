// Distances along the surface of a mesh from one of its vertices.
// Triangles are unfolded into the plane around a virtual source: Novotni, Klein, "Computing geodesic
// distances on triangular meshes" (2002); here the virtual source also accounts for the curvature of the
// surface, and vertices are corrected as long as a shorter way is found, so that obtuse and thin triangles
// need no subdivision.
//
// Costs: O(k log k) of the k vertices that are reached. Allocates the result and some memory for its work.
// Any number of threads at once.
#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/config.hpp"
#include "motus/mesh/neighbours.hpp"
#include "motus/mesh/reach.hpp"

namespace motus::mesh {

/// The vertices whose distance along the surface from vertex `root` is <= radius, the root (0) among them.
/// Distances are |metric d| summed along the way, so that a scaled object is measured in world units; radius
/// (>= 0, infinity for the whole connected surface) is in the same unit.
///
/// Relative error: 1e-5 on surfaces that unfold into a plane, 0.3 % if its triangles are needles at random;
/// on spheres of 2000 vertices and more 0.3 % to the equator, 1.5 % up to the point opposite; 2 % behind
/// holes.
///
/// The shortest way crosses triangles and wires and never leaps from sheet to sheet; unconnected parts are
/// not reached, nor are vertices whose position is not finite. Touches only what lies within the radius, and
/// takes scratch memory for it. Throws std::invalid_argument if root is not a vertex, radius is negative
/// or NaN, or the number of positions is not the neighbours' number of vertices.
[[nodiscard]] Reach surface_reach(std::span<const glm::vec3> positions, const Neighbours& neighbours,
                                  std::uint32_t root, float radius,
                                  const glm::mat3& metric = glm::mat3(1.0f));

/// The vertices that are at most `steps` edges away from vertex `root`; the distances are whole numbers of
/// edges. Throws std::invalid_argument if root is not a vertex.
[[nodiscard]] Reach edge_reach(const Neighbours& neighbours, std::uint32_t root, std::uint32_t steps);

}  // namespace motus::mesh
