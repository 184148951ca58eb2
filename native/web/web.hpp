// What functions of the module for browsers have in common. They take numbers, and arrays of numbers as a
// place in the module's memory and a count; results go to `out`, as many as the comment beside each function
// says. docs/site/figures/figures.js calls them.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

/// A function that JavaScript calls by this name.
#define MOTUS_WEB(name) extern "C" __attribute__((export_name(#name))) void name

namespace motus::web {

/// Vectors of three numbers each.
inline std::vector<glm::dvec3> points_of(const double* numbers, std::size_t count) {
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i + 2 < count; i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

/// Writes a vector's three numbers; returns the place after them.
inline double* write(double* out, const glm::dvec3& vector) {
    for (int axis = 0; axis < 3; ++axis) *out++ = vector[axis];
    return out;
}

}  // namespace motus::web
