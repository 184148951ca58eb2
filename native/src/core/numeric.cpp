#include "motus/core/numeric.hpp"

namespace motus {
namespace {

[[nodiscard]] double largest_part(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

glm::dvec3 unit_vector(glm::dvec3 v) {
    const double largest = largest_part(v);
    if (largest >= 1e-100 && largest <= 1e100) return glm::normalize(v);
    if (!(largest > 0.0)) return v;
    const int exponent = std::ilogb(largest);
    return glm::normalize(
        glm::dvec3(std::scalbn(v.x, -exponent), std::scalbn(v.y, -exponent), std::scalbn(v.z, -exponent)));
}

std::optional<glm::dvec3> direction_of(const glm::dvec3& v) {
    const glm::dvec3 unit = unit_vector(v);
    if (!is_finite(unit) || unit == glm::dvec3(0.0)) return std::nullopt;
    return unit;
}

double length_of(const glm::dvec3& v) {
    const double largest = largest_part(v);
    if (largest == 0.0) return 0.0;
    const glm::dvec3 shares = v / largest;
    return largest * std::sqrt(shares.x * shares.x + shares.y * shares.y + shares.z * shares.z);
}

}  // namespace motus
