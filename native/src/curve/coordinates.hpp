// The check of points that a curve is made of.
#pragma once
#include <cmath>
#include <glm/vec3.hpp>
#include <span>
#include <stdexcept>
#include <string>

#include "motus/curve/curve.hpp"

namespace motus::curve {

/// Throws std::invalid_argument, which begins with `name`, if a coordinate is not finite or passes
/// coordinate_limit.
inline void require_coordinates(std::span<const glm::dvec3> points, const char* name) {
    const auto fits = [](double value) { return std::abs(value) <= coordinate_limit; };  // false for NaN
    for (const glm::dvec3& p : points) {
        if (!(fits(p.x) && fits(p.y) && fits(p.z)))
            throw std::invalid_argument(std::string(name) +
                                        ": every coordinate must be finite, and at most 1e100");
    }
}

}  // namespace motus::curve
