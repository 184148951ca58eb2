// Vertices that lie so near to each other that they count as one: the corners of a scan's loose triangles.
//
// Costs: O(n log n) in a mesh whose vertices lie further apart than the distance, of which few have many
// neighbours. Allocates the result and some memory for its work. Any number of threads at once.
#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"

namespace motus::mesh {

/// The leader of each vertex. In the order of their indices, vertices without a leader lead themselves, and
/// all vertices without a leader with |metric (p - q)| <= distance, where q is the leader's position. So a
/// leader has the lowest index of its group, and no vertex lies further than the distance from its leader,
/// however long a row of near vertices is. A vertex with a coordinate that is not finite leads itself alone.
/// Throws std::invalid_argument if the distance is negative or not finite, or there are 2^32 - 1 or more
/// vertices.
[[nodiscard]] std::vector<std::uint32_t> weld(std::span<const glm::vec3> positions, float distance,
                                              const glm::mat3& metric = glm::mat3(1.0f),
                                              const Executor& executor = {});

}  // namespace motus::mesh
