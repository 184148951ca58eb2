// What a ray meets on a triangle mesh, and which vertices are near a point, by a tree that follows the mesh
// as it is deformed.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "motus/core/parallel.hpp"

namespace motus::mesh {

/// Where a ray meets the mesh.
struct Hit {
    std::uint32_t triangle = 0;
    glm::dvec3 point{0.0};
    double distance = 0.0;                   ///< from the ray's origin, in the positions' own units, >= 0
    std::array<std::uint32_t, 3> corners{};  ///< vertices of the triangle
};

/// A picking tree over the triangles and all vertices of a mesh, loose ones too. It keeps a copy of the
/// positions: answers are for the shape of the last refit. Answers depend on the positions and triangles
/// alone, neither on the number of threads nor on whether the tree was built or refitted. Several threads may
/// ask at once; refits need the tree alone.
///
/// Any input will do: coincident vertices, triangles without area (which no ray meets), repeated triangles,
/// edges of any number of triangles, no triangles at all. What has a coordinate that is not finite is never
/// found.
class Picker {
  public:
    /// Throws std::invalid_argument where a triangle names a vertex that there is not, or there are 2^32 - 1
    /// or more vertices or triangles. `threads` as in in_parts, for the refits too.
    Picker(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
           std::size_t threads = thread_count());
    ~Picker();
    // What is moved from is a picker of no mesh.
    Picker(Picker&& other) noexcept;
    Picker& operator=(Picker&& other) noexcept;
    Picker(const Picker&) = delete;
    Picker& operator=(const Picker&) = delete;

    [[nodiscard]] std::size_t vertex_count() const noexcept;
    [[nodiscard]] std::size_t triangle_count() const noexcept;

    /// The first triangle, from either side, that the ray from `origin` along `direction` (of any length)
    /// meets; the lowest index where several are met at the same distance. A ray through an edge or a vertex
    /// that triangles share meets one of them. Nothing where the direction is zero or a number is not finite,
    /// or where all that it meets lies farther away than `farthest`.
    [[nodiscard]] std::optional<Hit> ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                         double farthest = std::numeric_limits<double>::infinity()) const;

    /// The same for another shape of the mesh, of which no vertex lies further than `slack` from where it was
    /// at the last refit (triangles with one that does may be missed): for single rays that takes far less
    /// time than a refit, where the slack is small beside the mesh. Throws std::invalid_argument where there
    /// are more or fewer positions, or the slack is negative or not finite.
    [[nodiscard]] std::optional<Hit> ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                         std::span<const glm::vec3> positions, float slack) const;

    /// The vertex nearest to a hit of the ray with this direction, |metric (p - point)| counting, on the
    /// surface that was hit: of its triangle, and of those that hang together with it by edges which are
    /// nearer than the vertex, as far as they are seen from the same side; of 256 triangles at most. So it
    /// may belong to another triangle, where they are thin, but never to the far side of a wall or to another
    /// sheet. Those whose `hidden` (nothing, or one for each vertex) is not 0 are left out, unless all around
    /// are: then it is the triangle's nearest corner. The lowest index where several are as near. Throws
    /// std::invalid_argument where there are more or fewer of `hidden`.
    [[nodiscard]] std::uint32_t nearest_seen(const Hit& hit, const glm::dvec3& direction,
                                             std::span<const std::uint8_t> hidden = {},
                                             const glm::mat3& metric = glm::mat3(1.0f)) const;

    /// The same for another shape of the mesh, with the arguments of ray().
    [[nodiscard]] std::uint32_t nearest_seen(const Hit& hit, const glm::dvec3& direction,
                                             std::span<const glm::vec3> positions, float slack,
                                             std::span<const std::uint8_t> hidden = {},
                                             const glm::mat3& metric = glm::mat3(1.0f)) const;

    /// The vertex nearest to the point, the lowest index where several are as near. Nothing where there is
    /// none.
    [[nodiscard]] std::optional<std::uint32_t> nearest(const glm::vec3& point) const;

    /// The vertices with |metric (p - point)| <= radius, ascending. The metric lets distances be measured in
    /// another space than the positions'. Empty for a negative radius.
    [[nodiscard]] std::vector<std::uint32_t> within(const glm::vec3& point, float radius,
                                                    const glm::mat3& metric = glm::mat3(1.0f)) const;

    /// Follows the mesh to new positions of the same vertices. Throws std::invalid_argument where there are
    /// more or fewer.
    void refit(std::span<const glm::vec3> positions);

    /// The same where only the vertices `moved` (in any order, repeated or not) have other positions than at
    /// the last refit; what `positions` holds of the others is not read. Throws std::invalid_argument as
    /// above, and where an index is out of range.
    void refit(std::span<const glm::vec3> positions, std::span<const std::uint32_t> moved);

  private:
    struct Tree;
    /// The one to ask: of nothing, where tree_ has been moved away.
    [[nodiscard]] const Tree& tree() const noexcept;

    std::unique_ptr<Tree> tree_;
};

}  // namespace motus::mesh
