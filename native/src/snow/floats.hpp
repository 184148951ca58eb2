// Vectors in single precision for the loops. Private to the library.
#pragma once
#include <array>
#include <glm/vec3.hpp>

namespace motus::snow {

[[nodiscard]] inline std::array<float, 3> floats_of(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace motus::snow
