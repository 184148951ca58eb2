// Checks of numbers, unit vectors, and other small computations that several topics share.
//
// Costs: O(1), or O(n) of a span. Allocates nothing. Any number of threads at once.
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <stdexcept>

#include "motus/config.hpp"

namespace motus {

/// Throws std::invalid_argument with the problem if the condition does not hold.
inline void require(bool holds, const char* problem) {
    if (!holds) throw std::invalid_argument(problem);
}

/// Whether no number is infinite or NaN.
template <std::floating_point... Number>
[[nodiscard]] inline bool are_finite(Number... values) {
    return (std::isfinite(values) && ...);
}
[[nodiscard]] inline bool are_finite(std::span<const float> values) {
    return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}
[[nodiscard]] inline bool are_finite(std::span<const double> values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Whether no number in a vector, a quaternion or a matrix is infinite or NaN.
template <glm::length_t size, class Number, glm::qualifier qualifier>
[[nodiscard]] inline bool is_finite(const glm::vec<size, Number, qualifier>& v) {
    return are_finite(std::span<const Number>(&v[0], static_cast<std::size_t>(size)));
}
template <class Number, glm::qualifier qualifier>
[[nodiscard]] inline bool is_finite(const glm::qua<Number, qualifier>& q) {
    return are_finite(q.w, q.x, q.y, q.z);
}
template <glm::length_t columns, glm::length_t rows, class Number, glm::qualifier qualifier>
[[nodiscard]] inline bool is_finite(const glm::mat<columns, rows, Number, qualifier>& matrix) {
    for (glm::length_t column = 0; column < columns; ++column)
        if (!is_finite(matrix[column])) return false;
    return true;
}

/// v at unit length whatever its size, zero for zero.
[[nodiscard]] glm::dvec3 unit_vector(glm::dvec3 v);

/// v at unit length; none for a vector without length, or with a number that is not finite.
[[nodiscard]] std::optional<glm::dvec3> direction_of(const glm::dvec3& v);

/// v, up to 1e150 in size, at unit length, in fewer steps than direction_of(); `otherwise` for lengths below
/// 1e-140 (normalize-or). NaN for NaN.
[[nodiscard]] inline glm::dvec3 direction_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double square = glm::dot(v, v);
    constexpr double vanished = 1e-280;
    return square <= vanished ? otherwise : v * (1.0 / std::sqrt(square));
}

/// Length of a vector of any size. (std::hypot of three overflows in some standard libraries.)
[[nodiscard]] double length_of(const glm::dvec3& v);

/// 0 up to x = 0, 1 from x = 1 on, 3x^2 - 2x^3 between.
[[nodiscard]] inline double smooth_step(double x) {
    const double u = std::clamp(x, 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}

}  // namespace motus
