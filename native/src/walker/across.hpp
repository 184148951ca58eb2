// Vectors across others. Private to the library.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "motus/core/numeric.hpp"

namespace motus::walker {

/// The coordinate axis that is most nearly across a vector.
[[nodiscard]] inline glm::dvec3 axis_across(const glm::dvec3& v) {
    return std::abs(v.x) <= std::abs(v.y) && std::abs(v.x) <= std::abs(v.z) ? glm::dvec3(1.0, 0.0, 0.0)
           : std::abs(v.y) <= std::abs(v.z)                                 ? glm::dvec3(0.0, 1.0, 0.0)
                                                                            : glm::dvec3(0.0, 0.0, 1.0);
}

/// The part of `v` across a unit vector, unit; a fixed choice if v has no such part.
[[nodiscard]] inline glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& up) {
    const glm::dvec3 otherwise = unit_vector(glm::cross(axis_across(up), up));
    return direction_or(v - up * glm::dot(v, up), otherwise);
}

}  // namespace motus::walker
