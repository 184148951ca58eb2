// Ray hits on a triangle mesh, and vertices near a point, by a bounding volume tree that is refitted as the
// mesh is deformed.
//
// Costs: O(n log n) to make, O(n) to refit, O(log n) to ask, in a mesh that is not tangled. Making one
// allocates it; refits and questions allocate some memory for their work. Any number of threads may ask at
// once; a refit needs the picker for itself.
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

#include "motus/config.hpp"
#include "motus/core/executor.hpp"

namespace motus::mesh {

/// The place at which a ray meets the mesh.
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
/// Any input is allowed: coincident vertices, triangles without area (which no ray meets), repeated
/// triangles, edges of any number of triangles, no triangles at all. A vertex or triangle with a coordinate
/// that is not finite is never found.
class Picker {
  public:
    /// Throws std::invalid_argument if a triangle names a vertex that does not exist, or there are 2^32 - 1
    /// or more vertices or triangles. `executor` works for the refits too.
    Picker(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
           const Executor& executor = {});
    ~Picker();
    // A picker that is moved from is one of an empty mesh.
    Picker(Picker&& other) noexcept;
    Picker& operator=(Picker&& other) noexcept;
    Picker(const Picker&) = delete;
    Picker& operator=(const Picker&) = delete;

    [[nodiscard]] std::size_t vertex_count() const noexcept;
    [[nodiscard]] std::size_t triangle_count() const noexcept;

    /// The first triangle, from either side, that the ray from `origin` along `direction` (of any length)
    /// meets; the one of the lowest index if several are met at the same distance. A ray through an edge or a
    /// vertex that triangles share meets one of them. Nothing if the direction is zero or a number is not
    /// finite, or if every hit lies farther away than `farthest`.
    [[nodiscard]] std::optional<Hit> ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                         double farthest = std::numeric_limits<double>::infinity()) const;

    /// The first triangle of a different shape of the mesh that the ray meets. No vertex may lie further than
    /// `slack` from its position at the last refit (triangles of such a vertex may be missed). For single
    /// rays this takes far less time than a refit if the slack is small compared with the mesh. Throws
    /// std::invalid_argument if the number of positions differs, or the slack is negative or not finite.
    [[nodiscard]] std::optional<Hit> ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                         std::span<const glm::vec3> positions, float slack) const;

    /// The vertex nearest, by |metric (p - point)|, to a hit of the ray with this direction, on the surface
    /// that was hit. Considered are the vertices of the triangle, and of triangles that are connected with it
    /// by edges nearer than the vertex and seen from the same side; 256 triangles at most. If triangles are
    /// thin the vertex may belong to a neighbour, but never to the far side of a wall or to a different
    /// sheet. Vertices whose `hidden` (empty, or one for each vertex) is not 0 are left out; if all are
    /// hidden, the result is the triangle's nearest corner. The lowest index if several are as near. Throws
    /// std::invalid_argument if the number of `hidden` differs.
    [[nodiscard]] std::uint32_t nearest_seen(const Hit& hit, const glm::dvec3& direction,
                                             std::span<const std::uint8_t> hidden = {},
                                             const glm::mat3& metric = glm::mat3(1.0f)) const;

    /// The vertex nearest to a hit on a different shape of the mesh; arguments as those of ray().
    [[nodiscard]] std::uint32_t nearest_seen(const Hit& hit, const glm::dvec3& direction,
                                             std::span<const glm::vec3> positions, float slack,
                                             std::span<const std::uint8_t> hidden = {},
                                             const glm::mat3& metric = glm::mat3(1.0f)) const;

    /// The vertex nearest to the point, the lowest index if several are as near. Nothing if the mesh
    /// has no vertex of finite position.
    [[nodiscard]] std::optional<std::uint32_t> nearest(const glm::vec3& point) const;

    /// The place of the surface nearest to the point, in the triangle of the lowest index if several are as
    /// near; its distance is that from the point. Nothing if the distance exceeds `farthest` (at least 0, may
    /// be infinite), or a coordinate of the point is not finite or exceeds 1e100.
    [[nodiscard]] std::optional<Hit> nearest_on_surface(
        const glm::dvec3& point, double farthest = std::numeric_limits<double>::infinity()) const;

    /// The vertices with |metric (p - point)| <= radius, ascending. With a metric distances are measured in
    /// a different space than that of the positions. Empty for a negative radius.
    [[nodiscard]] std::vector<std::uint32_t> within(const glm::vec3& point, float radius,
                                                    const glm::mat3& metric = glm::mat3(1.0f)) const;

    /// Adapts the tree to new positions of the same vertices. Throws std::invalid_argument if their number
    /// differs.
    void refit(std::span<const glm::vec3> positions);

    /// Adapts the tree if only the vertices `moved` (in any order, repeated or not) have moved since the last
    /// refit; the other rows of `positions` are not read. Throws std::invalid_argument if the number of
    /// positions differs or an index is out of range.
    void refit(std::span<const glm::vec3> positions, std::span<const std::uint32_t> moved);

  private:
    struct Tree;
    /// The tree; an empty one after tree_ has been moved away.
    [[nodiscard]] const Tree& tree() const noexcept;

    std::unique_ptr<Tree> tree_;
};

}  // namespace motus::mesh
