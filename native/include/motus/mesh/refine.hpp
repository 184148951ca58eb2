// Meshes whose edges are short enough for what is to differ along them.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace motus::mesh {

struct Refined {
    std::vector<glm::vec3> positions;  ///< those given, and then the middles of edges
    std::vector<glm::ivec3> triangles;
};

/// Halves all edges longer than `longest`, > 0, again and again: the surface stays where it is, and has no
/// gaps that it did not have. Throws std::invalid_argument, naming the argument, where a position is not
/// finite, a triangle names a vertex that there is not, `longest` is not greater than 0, or more vertices
/// than `most_vertices`, or four times as many triangles, would be needed.
[[nodiscard]] Refined refine(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                             double longest, std::size_t most_vertices);

}  // namespace motus::mesh
