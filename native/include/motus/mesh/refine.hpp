// Subdivision of a mesh until its edges are short enough for values that vary along them.
//
// Costs: O(n) of the result. Allocates the result and as much again. Any number of threads at once.
#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/config.hpp"

namespace motus::mesh {

struct Refined {
    std::vector<glm::vec3> positions;  ///< the given ones, then the middles of edges
    std::vector<glm::ivec3> triangles;
    /// Of the edge that each vertex after the given ones halves: two earlier vertices.
    std::vector<glm::ivec2> ends{};
};

/// Halves all edges longer than `longest_edge`, > 0, again and again: the surface keeps its shape, and gets
/// no new gaps. An edge stays if single precision has no position between its ends. Throws
/// std::invalid_argument, naming the argument, if a position is not finite, a triangle names a vertex that
/// does not exist, `longest_edge` is not greater than 0, or more vertices than `most_vertices`, or four times
/// as many triangles, would be needed.
[[nodiscard]] Refined refine(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                             double longest_edge, std::size_t most_vertices);

}  // namespace motus::mesh
