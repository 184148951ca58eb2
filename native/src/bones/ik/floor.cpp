#include "motus/bones/ik/floor.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "motus/core/numeric.hpp"

namespace motus::bones::ik {
namespace {

/// From 0 up to -margin on to `height` itself from `margin` on.
double lifted(double height, double margin) {
    if (height >= margin) return height;
    if (height <= -margin) return 0.0;
    const double into = height + margin;
    return into * into / (4.0 * margin);
}

}  // namespace

glm::dvec3 above_floor(const glm::dvec3& target, const Floor& floor) {
    const std::optional<glm::dvec3> up = direction_of(floor.up);
    if (!up || !are_finite(floor.height, floor.margin)) return target;
    const double height = glm::dot(target - floor.place, *up) - floor.height;
    const glm::dvec3 result = target + (lifted(height, std::max(floor.margin, 0.0)) - height) * *up;
    return is_finite(result) ? result : target;
}

}  // namespace motus::bones::ik
