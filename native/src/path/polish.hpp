// Unit length without a square root. Private to the library.
#pragma once
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace motus::path {

/// A vector or quaternion that is a unit one but for rounding, made one to the last digit: one step of
/// Newton's method for 1 / sqrt, which squares the error.
template <class Unit>
[[nodiscard]] inline Unit polished(const Unit& v) {
    return v * (1.5 - 0.5 * glm::dot(v, v));
}

}  // namespace motus::path
