// Places on triangles, each with a chance by its area. Private to the library.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "kernel.hpp"

namespace motus::snow {

/// Facets of the triangles, for Kind::facets. Throws std::invalid_argument where a triangle names a vertex
/// that there is not, a position is not finite, or no triangle has an area.
[[nodiscard]] std::vector<Facet> facets_of(std::span<const glm::vec3> positions,
                                           std::span<const glm::ivec3> triangles);

}  // namespace motus::snow
