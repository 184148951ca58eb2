// Things to land on, for the tests.
#pragma once
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "motus/snow/collider.hpp"
#include "motus/snow/snow.hpp"

namespace motus::snow {

using Triangles = std::vector<glm::ivec3>;
using Points = std::vector<glm::vec3>;

/// A square of width 2 r in which z = height + slope x, of cells x cells x 2 triangles.
inline void add_sheet(float r, float height, float slope, int cells, Points& positions,
                      Triangles& triangles) {
    const auto first = static_cast<int>(positions.size());
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const float x = r * (2.0F * static_cast<float>(column) / static_cast<float>(cells) - 1.0F);
            const float y = r * (2.0F * static_cast<float>(row) / static_cast<float>(cells) - 1.0F);
            positions.emplace_back(x, y, height + slope * x);
        }
    }
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const int at = first + row * (cells + 1) + column;
            triangles.emplace_back(at, at + 1, at + cells + 2);
            triangles.emplace_back(at, at + cells + 2, at + cells + 1);
        }
    }
}
[[nodiscard]] inline std::shared_ptr<const Collider> sheet(float r, float height, float slope, int cells) {
    Points positions;
    Triangles triangles;
    add_sheet(r, height, slope, cells, positions, triangles);
    return std::make_shared<const Collider>(positions, triangles);
}

/// Flakes that fall from a square of half width 2 at a height of 3.
[[nodiscard]] inline SnowSettings falling(double rate) {
    SnowSettings s;
    s.rate = rate;
    s.lifetime = 6.0;
    s.start_speed = -1.5;
    s.cone_radius = 2.0;
    s.emitter_times = {0.0};
    s.emitter_matrices = {glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 3.0))};
    return s;
}

}  // namespace motus::snow
