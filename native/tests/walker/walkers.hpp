// Bodies on their ways, and ground to walk on, for the tests.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "motus/walker/walker.hpp"

namespace motus::walker {

/// Eight, in pairs from the front: L1 R1 L2 R2 ...
[[nodiscard]] inline std::vector<glm::dvec3> eight_feet() {
    std::vector<glm::dvec3> rest;
    for (const double y : {0.9, 0.3, -0.3, -0.9})
        for (const double x : {-1.0, 1.0}) rest.emplace_back(x * (1.2 - 0.3 * std::abs(y)), y, 0.0);
    return rest;
}

/// 24 samples a second.
[[nodiscard]] inline Way way_along(double seconds, const std::function<glm::dmat4(double)>& pose,
                                   Gait gait = Gait::tetrapod) {
    Way way;
    const auto frames = static_cast<int>(std::lround(24.0 * seconds));
    for (int frame = 0; frame <= frames; ++frame) {
        way.times.push_back(frame / 24.0);
        way.poses.push_back(pose(way.times.back()));
    }
    way.rest = eight_feet();
    const Pattern pattern = pattern_of(gait, way.rest, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
    way.phases = pattern.phases;
    way.duty = pattern.duty;
    return way;
}

[[nodiscard]] inline glm::dmat4 moved(const glm::dvec3& by) {
    return glm::translate(glm::dmat4(1.0), by);
}

/// Rests for a second, goes 4 m ahead in 3 s with soft ends, and rests again.
[[nodiscard]] inline glm::dmat4 there(double time) {
    const double u = std::clamp((time - 1.0) / 3.0, 0.0, 1.0);
    return moved({0.0, 4.0 * u * u * (3.0 - 2.0 * u), 0.0});
}

/// A curve at 1 m/s that turns, with a body that sways.
[[nodiscard]] inline glm::dmat4 around(double time) {
    const double turned = 0.5 * time;
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), turned, {0.0, 0.0, 1.0});
    const glm::dmat4 place =
        moved({2.0 * std::cos(turned), 2.0 * std::sin(turned), 0.1 * std::sin(5.0 * time)});
    return place * turn * glm::rotate(glm::dmat4(1.0), 0.05 * std::sin(3.0 * time), {1.0, 0.0, 0.0});
}

/// A square of half width r around the origin, in cells, with z = height(x, y).
struct Land {
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
};
[[nodiscard]] inline Land land(double r, int cells, const std::function<double(double, double)>& height) {
    Land land;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const double x = r * (2.0 * column / cells - 1.0), y = r * (2.0 * row / cells - 1.0);
            land.positions.emplace_back(glm::dvec3(x, y, height(x, y)));
        }
    }
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const int at = row * (cells + 1) + column;
            land.triangles.emplace_back(at, at + 1, at + cells + 2);
            land.triangles.emplace_back(at, at + cells + 2, at + cells + 1);
        }
    }
    return land;
}
[[nodiscard]] inline double hills(double x, double y) {
    return 0.15 * std::sin(1.7 * x) * std::cos(1.3 * y) + 0.05 * std::sin(5.0 * x + 1.0) * std::sin(4.0 * y);
}
[[nodiscard]] inline Ground ground_of(const Land& land) {
    return {land.positions, land.triangles, std::nullopt};
}
[[nodiscard]] inline Ground hilly_ground() {
    return ground_of(land(8.0, 80, hills));
}
[[nodiscard]] inline Ground plane(double height = 0.0) {
    return {{}, {}, Plane{{0.0, 0.0, height}, {0.0, 0.0, 1.0}}};
}

/// A box from low to high, open nowhere; its faces look outwards.
[[nodiscard]] inline Land box(const glm::vec3& low, const glm::vec3& high) {
    Land box;
    for (int corner = 0; corner < 8; ++corner)
        box.positions.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                   (corner & 4) != 0 ? high.z : low.z);
    box.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 7, 3}, {2, 6, 7}, {0, 6, 2}, {0, 4, 6}, {1, 3, 7}, {1, 7, 5}};
    return box;
}

/// Both in one.
[[nodiscard]] inline Land joined(Land one, const Land& other) {
    const auto first = static_cast<int>(one.positions.size());
    one.positions.insert(one.positions.end(), other.positions.begin(), other.positions.end());
    for (const glm::ivec3& triangle : other.triangles) one.triangles.push_back(triangle + first);
    return one;
}

}  // namespace motus::walker
