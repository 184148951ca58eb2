#include "motus/walker/ground.hpp"

#include <glm/geometric.hpp>
#include <limits>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"

namespace motus::walker {
namespace {

[[nodiscard]] mesh::Picker picker_of(std::span<const glm::vec3> positions,
                                     std::span<const glm::ivec3> triangles, const Executor& executor) {
    constexpr std::size_t most = std::numeric_limits<int>::max();
    require(positions.size() < most, "positions: must be fewer");
    require(triangles.size() < most, "triangles: must be fewer");
    for (const glm::ivec3& triangle : triangles)
        for (int corner = 0; corner < 3; ++corner)
            require(triangle[corner] >= 0 && static_cast<std::size_t>(triangle[corner]) < positions.size(),
                    "triangles: must name vertices of positions");
    return in_ieee_floats([&] { return mesh::Picker(positions, triangles, executor); });
}

[[nodiscard]] std::optional<Plane> checked(const std::optional<Plane>& plane) {
    if (!plane) return std::nullopt;
    require(is_finite(plane->point), "plane: must be finite");
    const std::optional<glm::dvec3> normal = direction_of(plane->normal);
    require(normal.has_value(), "plane: must have a normal that is not zero");
    return Plane{plane->point, *normal};
}

[[nodiscard]] glm::dvec3 facing(const glm::dvec3& normal, const glm::dvec3& direction) {
    return glm::dot(normal, direction) > 0.0 ? -normal : normal;
}

}  // namespace

Ground::Ground(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
               const std::optional<Plane>& plane, const Executor& executor)
    : mesh_(std::make_shared<const Mesh>(
          Mesh{picker_of(positions, triangles, executor), {positions.begin(), positions.end()}})),
      plane_(checked(plane)) {}

Ground Ground::with_plane(const std::optional<Plane>& plane) const {
    Ground made = *this;
    made.plane_ = checked(plane);
    return made;
}

std::size_t Ground::bytes() const noexcept {
    // The tree has the positions too, in its order, the triangles and a box for a few of them.
    return 2 * vertex_count() * sizeof(glm::vec3) + 4 * triangle_count() * sizeof(glm::ivec3);
}

std::optional<Contact> Ground::on_plane(const glm::dvec3& origin, const glm::dvec3& direction,
                                        double farthest) const {
    if (!plane_) return std::nullopt;
    const double rate = glm::dot(direction, plane_->normal);
    if (rate == 0.0) return std::nullopt;
    const double distance = glm::dot(plane_->point - origin, plane_->normal) / rate;
    if (!(distance >= 0.0 && distance <= farthest)) return std::nullopt;
    return Contact{origin + distance * direction, facing(plane_->normal, direction), distance, rate > 0.0};
}

std::optional<Contact> Ground::ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                   double farthest) const {
    if (!is_finite(origin) || !is_finite(direction) || std::isnan(farthest)) return std::nullopt;
    const std::optional<Contact> plane = on_plane(origin, direction, farthest);
    const std::optional<mesh::Hit> hit =
        mesh_->picker.ray(origin, direction, plane ? plane->distance : farthest);
    if (!hit) return plane;
    const std::vector<glm::vec3>& positions = mesh_->positions;
    const glm::dvec3 a(positions[hit->corners[0]]), b(positions[hit->corners[1]]),
        c(positions[hit->corners[2]]);
    const glm::dvec3 normal = unit_vector(glm::cross(b - a, c - a));
    return Contact{hit->point, facing(normal, direction), hit->distance, glm::dot(normal, direction) > 0.0};
}

}  // namespace motus::walker
