// The mesh behind Picker and pull(): tree, positions and neighbours, and the reaches measured on them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <span>
#include <vector>

#include "core/arrays.hpp"
#include "motus/mesh/neighbours.hpp"
#include "motus/mesh/picker.hpp"
#include "motus/mesh/reach.hpp"
#include "motus/sculpt/pull.hpp"

namespace motus::bindings {

/// The triangle that a ray meets, and the vertex that it picks.
struct Pick {
    mesh::Hit hit;
    std::uint32_t vertex = 0;
};

enum class Distance { straight, surface, edges };

[[nodiscard]] Distance distance_argument(py::handle object);

/// Letters of "xyz" as the bits of Dab::mirror.
[[nodiscard]] unsigned mirror_argument(py::handle object);

/// Where a pull is rooted: a vertex, or for straight distances any point.
struct Root {
    glm::vec3 point{0.0f};
    std::optional<std::uint32_t> vertex;
};

/// The index of a vertex, below `count`, whose point the caller fills in; or (3,).
[[nodiscard]] Root root_argument(py::handle object, std::size_t count);

/// A mesh that is picked from. Any number of threads may ask; who refits waits for them. Nothing here calls
/// Python.
class PickedMesh {
  public:
    PickedMesh(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
               std::optional<std::span<const glm::ivec2>> edges);

    [[nodiscard]] std::size_t vertex_count() const noexcept { return tree_.vertex_count(); }
    [[nodiscard]] std::size_t triangle_count() const noexcept { return tree_.triangle_count(); }

    [[nodiscard]] std::optional<mesh::Hit> ray(const glm::dvec3& origin, const glm::dvec3& direction) const;
    [[nodiscard]] std::optional<mesh::Hit> ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                               std::span<const glm::vec3> positions, float slack) const;
    /// The hit and its nearest vertex that is seen; of another shape if there is a slack.
    [[nodiscard]] std::optional<Pick> pick(const glm::dvec3& origin, const glm::dvec3& direction,
                                           std::span<const std::uint8_t> hidden, const glm::mat3& metric,
                                           std::span<const glm::vec3> positions,
                                           std::optional<float> slack) const;
    [[nodiscard]] std::optional<std::uint32_t> nearest(const glm::vec3& point) const;
    [[nodiscard]] std::vector<std::uint32_t> within(const glm::vec3& point, float radius,
                                                    const glm::mat3& metric) const;
    [[nodiscard]] glm::vec3 position(std::uint32_t vertex) const;
    /// One for each of the dab's images, on the shape of the last refit; its radius counts, inclusively.
    /// The image of a vertex is the vertex nearest to its mirrored position.
    [[nodiscard]] std::vector<mesh::Reach> reaches(const sculpt::Dab& dab, const Root& root,
                                                   Distance distance) const;

    void refit(std::span<const glm::vec3> positions);
    void refit(std::span<const glm::vec3> positions, std::span<const std::uint32_t> moved);

    /// Built when asked for first.
    [[nodiscard]] const mesh::Neighbours& neighbours() const;
    /// The largest side of the box around all vertices, measured by the metric. Never too small; too large
    /// if parts of the mesh were refitted.
    [[nodiscard]] float extent(const glm::mat3& metric) const;

  private:
    mutable std::shared_mutex mutex_;  ///< of the tree, the positions and the box
    mesh::Picker tree_;
    std::vector<glm::vec3> positions_;
    glm::vec3 low_{0.0f}, high_{0.0f};
    mutable std::once_flag neighbours_made_;
    mutable std::optional<mesh::Neighbours> neighbours_;
    mutable std::vector<glm::ivec3> triangles_;  ///< until the neighbours are made
    mutable std::vector<glm::ivec2> edges_;      ///< as above
    bool has_edges_ = false;
};

/// The reach of a root on a mesh with these neighbours: along the surface, or by edges.
[[nodiscard]] mesh::Reach reach_along(std::span<const glm::vec3> positions,
                                      const mesh::Neighbours& neighbours, std::uint32_t root, float radius,
                                      Distance distance, const glm::mat3& metric);

}  // namespace motus::bindings
