// Meshes to pull, and what pulling them means, written down without any cleverness.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/sculpt/pull.hpp"
#include "random.hpp"

namespace motus::sculpt::checks {

/// A pull of no special direction.
[[nodiscard]] inline Dab sample_dab() {
    Dab dab;
    dab.root = {0.2f, -0.1f, 0.3f};
    dab.displacement = {0.1f, 0.3f, -0.2f};
    dab.radius = 0.7f;
    return dab;
}

/// Vertices anywhere in [-1, 1]^3.
[[nodiscard]] inline std::vector<glm::vec3> cloud(std::size_t count, unsigned seed = 1) {
    test::Random random(seed);
    std::vector<glm::vec3> points(count);
    for (glm::vec3& p : points) p = random.in_cube(1.0f);
    return points;
}

[[nodiscard]] inline std::vector<float> random_weights(std::size_t count) {
    test::Random random(7);
    std::vector<float> weights(count);
    for (float& w : weights) w = random.between(0.0f, 1.0f);
    return weights;
}

[[nodiscard]] inline std::vector<glm::vec3> pulled(std::span<const glm::vec3> positions, const Dab& dab,
                                                   std::span<const float> weights = {}) {
    std::vector<glm::vec3> out(positions.size());
    pull(positions, dab, weights, out);
    return out;
}

[[nodiscard]] inline bool same_bits(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

[[nodiscard]] inline float force_at(const Dab& dab, float distance) {
    forces(dab.profile, dab.radius, {&distance, 1}, {&distance, 1});
    return distance;
}

/// The new position of one vertex, by the rules of pull.hpp.
[[nodiscard]] inline glm::dvec3 by_the_rules(const glm::vec3& p, const Dab& dab, float weight = 1.0f) {
    glm::dvec3 sum(0.0);
    double total = 0.0;
    double largest = 0.0;
    for (const PullImage& image : images_of(dab)) {
        const double force = weight * force_at(dab, glm::length(dab.metric * (p - image.root)));
        sum += force * glm::dvec3(image.displacement);
        total += std::abs(force);
        largest = std::max(largest, std::abs(force));
    }
    if (total == 0.0) return p;
    glm::dvec3 moved = glm::dvec3(p) + sum * (largest / total);
    double& height = moved[dab.clamp_axis];
    height = std::clamp(height, static_cast<double>(dab.minimum), static_cast<double>(dab.maximum));
    return moved;
}

/// The largest distance of `found` from the rules.
[[nodiscard]] inline double error(std::span<const glm::vec3> positions, const Dab& dab,
                                  std::span<const glm::vec3> found, std::span<const float> weights = {}) {
    double worst = 0.0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 wanted = by_the_rules(positions[i], dab, weights.empty() ? 1.0f : weights[i]);
        worst = std::max(worst, glm::distance(wanted, glm::dvec3(found[i])));
    }
    return worst;
}

/// The vertices within reach of an image, and how far they are.
[[nodiscard]] inline mesh::Reach straight_reach(std::span<const glm::vec3> positions, const Dab& dab,
                                                const PullImage& image) {
    mesh::Reach reach;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const float distance = glm::length(dab.metric * (positions[i] - image.root));
        if (distance > reach_of(dab.profile, dab.radius)) continue;
        reach.vertices.push_back(static_cast<std::uint32_t>(i));
        reach.distances.push_back(distance);
    }
    return reach;
}

[[nodiscard]] inline std::vector<mesh::Reach> straight_reaches(std::span<const glm::vec3> positions,
                                                               const Dab& dab) {
    std::vector<mesh::Reach> reaches;
    for (const PullImage& image : images_of(dab)) reaches.push_back(straight_reach(positions, dab, image));
    return reaches;
}

}  // namespace motus::sculpt::checks
