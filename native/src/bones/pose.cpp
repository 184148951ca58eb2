#include "motus/bones/pose.hpp"

#include <cmath>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <stdexcept>

namespace motus::bones {
namespace {

constexpr double gimbal_lock = 16.0 * 1.1920929e-7;  // Blender's: 16 single-precision epsilons

double sum_of_magnitudes(const glm::dvec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

}  // namespace

glm::dvec3 euler_xyz(const glm::dquat& rotation) {
    const glm::dmat3 m = glm::mat3_cast(rotation);
    const double cosine_y = std::hypot(m[0][0], m[0][1]);
    if (cosine_y <= gimbal_lock) return {std::atan2(-m[2][1], m[1][1]), std::atan2(-m[0][2], cosine_y), 0.0};
    const glm::dvec3 first{std::atan2(m[1][2], m[2][2]), std::atan2(-m[0][2], cosine_y),
                           std::atan2(m[0][1], m[0][0])};
    const glm::dvec3 second{std::atan2(-m[1][2], -m[2][2]), std::atan2(-m[0][2], -cosine_y),
                            std::atan2(-m[0][1], -m[0][0])};
    return sum_of_magnitudes(first) > sum_of_magnitudes(second) ? second : first;
}

void pack_matrices(std::span<const glm::dvec3> locations, std::span<const glm::dquat> rotations,
                   std::span<float> out, std::span<const glm::dvec3> scales) {
    if (rotations.size() != locations.size())
        throw std::invalid_argument("rotations: one per location is needed");
    if (!scales.empty() && scales.size() != locations.size())
        throw std::invalid_argument("scales: one per location is needed, or none");
    if (out.size() != 16 * locations.size())
        throw std::invalid_argument("out: 16 floats per location are needed");
    float* next = out.data();
    for (std::size_t i = 0; i < locations.size(); ++i) {
        glm::dmat3 m = glm::mat3_cast(rotations[i]);
        for (int column = 0; column < 3; ++column) {
            if (!scales.empty()) m[column] *= scales[i][column];
            for (int row = 0; row < 3; ++row) *next++ = static_cast<float>(m[column][row]);
            *next++ = 0.0f;
        }
        for (int row = 0; row < 3; ++row) *next++ = static_cast<float>(locations[i][row]);
        *next++ = 1.0f;
    }
}

}  // namespace motus::bones
