// Which triangles and edges meet at each vertex of a mesh: its one-ring, as compressed sparse rows.
//
// Costs: O(n) to make, which allocates it; O(1) to ask. Immutable: any number of threads may share one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"

namespace motus::mesh {

/// The triangles and edges around each vertex, packed one vertex after the other. They depend on the mesh's
/// connections alone, not on positions.
class Neighbours {
  public:
    Neighbours() = default;

    /// `edges` are those of the mesh: the triangles of a quad have a diagonal that is no edge. Edges
    /// without a triangle (wires) count as a surface of width 0. Triangles and edges with the same vertex
    /// twice are left out. Throws std::invalid_argument if an index is not of [0, vertex_count).
    Neighbours(std::size_t vertex_count, std::span<const glm::ivec3> triangles,
               std::span<const glm::ivec2> edges, const Executor& executor = {});
    /// Every side of a triangle is an edge, and there are no others. Throws as the constructor does.
    [[nodiscard]] static Neighbours of_triangles(std::size_t vertex_count,
                                                 std::span<const glm::ivec3> triangles,
                                                 const Executor& executor = {});

    [[nodiscard]] std::size_t vertex_count() const noexcept {
        return fan_starts_.empty() ? 0 : fan_starts_.size() - 1;
    }
    /// The other two vertices of each triangle at `vertex`, in the triangles' order; then the far end of each
    /// wire, listed twice.
    [[nodiscard]] std::span<const glm::uvec2> fan(std::uint32_t vertex) const noexcept {
        return std::span(fans_).subspan(fan_starts_[vertex], fan_starts_[vertex + 1] - fan_starts_[vertex]);
    }
    /// The far end of each edge at `vertex`, in the edges' order (sides of triangles: ascending).
    [[nodiscard]] std::span<const std::uint32_t> edge_ends(std::uint32_t vertex) const noexcept {
        return std::span(ends_).subspan(end_starts_[vertex], end_starts_[vertex + 1] - end_starts_[vertex]);
    }

  private:
    std::vector<std::uint32_t> fan_starts_;  ///< vertex_count + 1
    std::vector<glm::uvec2> fans_;
    std::vector<std::uint32_t> end_starts_;  ///< vertex_count + 1
    std::vector<std::uint32_t> ends_;
};

}  // namespace motus::mesh
