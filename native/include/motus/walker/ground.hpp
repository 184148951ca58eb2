// The ground that feet stand on, found by casting rays.
//
// Costs: O(n log n) to make, which allocates it; O(log n) a ray, which allocates nothing. Immutable: any
// number of threads may share one.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"
#include "motus/mesh/picker.hpp"

namespace motus::walker {

/// An endless plane.
struct Plane {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< of any length but 0
};

/// The place at which a ray meets the ground.
struct Contact {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, on the side that the ray comes from
    double distance = 0.0;             ///< m, >= 0
    /// Whether the ray meets the back of a surface: corners clockwise, or the plane's normal along the ray.
    bool leaves = false;
};

/// Triangles, counter-clockwise seen from outside, a plane, or both, met from either side; they stand still.
/// World space, metres. Immutable; any number of threads may ask. A copy shares the triangles, and to move
/// one is to copy it.
class Ground {
  public:
    /// Throws std::invalid_argument, naming the argument, if a triangle names a vertex that does not exist,
    /// or the plane has a number that is not finite or no normal. Vertices that are not finite are never met.
    Ground(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
           const std::optional<Plane>& plane, const Executor& executor = {});

    ~Ground() = default;
    Ground(const Ground&) noexcept = default;
    Ground& operator=(const Ground&) noexcept = default;
    // A ground that is moved from stays the ground that it was.
    // NOLINTNEXTLINE(performance-move-constructor-init): copying is what it is for, and costs a counter
    Ground(Ground&& other) noexcept : Ground(std::as_const(other)) {}
    Ground& operator=(Ground&& other) noexcept { return *this = std::as_const(other); }

    /// A ground that shares these triangles, with this plane in place of its own. Throws as the constructor
    /// does.
    [[nodiscard]] Ground with_plane(const std::optional<Plane>& plane) const;

    [[nodiscard]] bool is_empty() const noexcept { return triangle_count() == 0 && !plane_; }
    [[nodiscard]] std::size_t vertex_count() const noexcept { return mesh_->positions.size(); }
    [[nodiscard]] std::size_t triangle_count() const noexcept { return mesh_->picker.triangle_count(); }
    /// Approximate size in memory.
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// The first hit of the ray from `origin` along `direction` (unit), not farther away than `farthest`;
    /// that of the triangle if plane and triangle are met at the same distance. Nothing if a number is NaN,
    /// or the direction is not finite.
    [[nodiscard]] std::optional<Contact> ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                             double farthest) const;

  private:
    struct Mesh {
        mesh::Picker picker;
        std::vector<glm::vec3> positions;
    };

    [[nodiscard]] std::optional<Contact> on_plane(const glm::dvec3& origin, const glm::dvec3& direction,
                                                  double farthest) const;

    std::shared_ptr<const Mesh> mesh_;  ///< never null
    std::optional<Plane> plane_;
};

}  // namespace motus::walker
