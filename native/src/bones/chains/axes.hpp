// Which way a chain points and bends. Private to the library.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace motus::bones::chains {

/// The part of v that is perpendicular to the unit vector `along`.
[[nodiscard]] inline glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& along) {
    return v - glm::dot(v, along) * along;
}

/// Right-handed unit axes of a chain: along from root to tip, side to where it bends, normal = along x side.
struct Axes {
    glm::dvec3 along{0.0, 1.0, 0.0};
    glm::dvec3 side{0.0, 0.0, 1.0};
    glm::dvec3 normal{1.0, 0.0, 0.0};

    /// normal: unit vector perpendicular to the unit vector `along`.
    [[nodiscard]] static Axes of(const glm::dvec3& along, const glm::dvec3& normal) {
        return {along, glm::cross(normal, along), normal};
    }
    [[nodiscard]] glm::dvec3 to_local(const glm::dvec3& v) const {
        return {glm::dot(v, along), glm::dot(v, side), glm::dot(v, normal)};
    }
    [[nodiscard]] glm::dvec3 to_world(const glm::dvec3& v) const {
        return v.x * along + v.y * side + v.z * normal;
    }
};

/// The smallest rotation that takes the unit vector `from` to `to`; if they are opposite, half a turn
/// about `normal`, a unit vector across both.
class Swing {
  public:
    Swing(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& normal)
        : from_(from), half_(from + to), normal_(normal), square_(glm::dot(half_, half_)) {}

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& v) const {
        if (square_ < 1e-24) return 2.0 * glm::dot(normal_, v) * normal_ - v;
        // The rotation is two reflections: in the plane perpendicular to `from`, and in the one perpendicular
        // to the direction half-way.
        const glm::dvec3 mirrored = v - 2.0 * glm::dot(v, from_) * from_;
        return mirrored - 2.0 * (glm::dot(mirrored, half_) / square_) * half_;
    }

  private:
    glm::dvec3 from_, half_, normal_;
    double square_;
};

}  // namespace motus::bones::chains
