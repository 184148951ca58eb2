// Meshes whose distances along the surface are known.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "random.hpp"

namespace motus::mesh::checks {

struct Surface {
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
};

/// Radius 1, with a pole of many thin triangles at either end.
[[nodiscard]] inline Surface uv_sphere(int segments, int rings) {
    using std::numbers::pi;
    Surface made;
    made.positions.emplace_back(0.0f, 0.0f, 1.0f);
    for (int ring = 1; ring < rings; ++ring)
        for (int segment = 0; segment < segments; ++segment) {
            const double polar = pi * ring / rings;
            const double azimuth = 2.0 * pi * segment / segments;
            made.positions.emplace_back(std::sin(polar) * std::cos(azimuth),
                                        std::sin(polar) * std::sin(azimuth), std::cos(polar));
        }
    made.positions.emplace_back(0.0f, 0.0f, -1.0f);
    const int last = static_cast<int>(made.positions.size()) - 1;
    const auto at = [&](int ring, int segment) { return 1 + (ring - 1) * segments + segment % segments; };
    for (int segment = 0; segment < segments; ++segment) {
        made.triangles.emplace_back(0, at(1, segment), at(1, segment + 1));
        for (int ring = 1; ring + 1 < rings; ++ring) {
            made.triangles.emplace_back(at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1));
            made.triangles.emplace_back(at(ring, segment), at(ring + 1, segment + 1), at(ring, segment + 1));
        }
        made.triangles.emplace_back(at(rings - 1, segment), last, at(rings - 1, segment + 1));
    }
    return made;
}

/// Every triangle into four.
[[nodiscard]] inline Surface subdivided(const Surface& surface) {
    Surface made{surface.positions, {}};
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
        const auto [found, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<int>(made.positions.size()));
        if (is_new) made.positions.push_back(0.5f * (made.positions[a] + made.positions[b]));
        return found->second;
    };
    for (const glm::ivec3& t : surface.triangles) {
        const int a = middle(t.x, t.y);
        const int b = middle(t.y, t.z);
        const int c = middle(t.z, t.x);
        made.triangles.insert(made.triangles.end(), {{t.x, a, c}, {a, t.y, b}, {c, b, t.z}, {a, b, c}});
    }
    return made;
}

/// Radius 1; from an icosahedron.
[[nodiscard]] inline Surface icosphere(int subdivisions) {
    const float g = std::numbers::phi_v<float>;
    Surface made{{{-1, g, 0},
                  {1, g, 0},
                  {-1, -g, 0},
                  {1, -g, 0},
                  {0, -1, g},
                  {0, 1, g},
                  {0, -1, -g},
                  {0, 1, -g},
                  {g, 0, -1},
                  {g, 0, 1},
                  {-g, 0, -1},
                  {-g, 0, 1}},
                 {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (int i = 0; i < subdivisions; ++i) {
        made = subdivided(made);
        for (glm::vec3& p : made.positions) p = glm::normalize(p);
    }
    for (glm::vec3& p : made.positions) p = glm::normalize(p);
    return made;
}

/// Radius 1; a cube whose sides are grids of n x n squares, welded, each square cut the same way.
[[nodiscard]] inline Surface cube_sphere(int n) {
    Surface made;
    std::map<std::tuple<int, int, int>, int> known;
    const auto at = [&](int axis, int side, int i, int j) {
        int p[3] = {};
        p[axis] = side * n;
        p[(axis + 1) % 3] = 2 * i - n;
        p[(axis + 2) % 3] = 2 * j - n;
        const auto [found, is_new] =
            known.try_emplace({p[0], p[1], p[2]}, static_cast<int>(made.positions.size()));
        if (is_new) made.positions.push_back(glm::normalize(glm::vec3(p[0], p[1], p[2])));
        return found->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const int a = at(axis, side, i, j), b = at(axis, side, i + 1, j);
                    const int c = at(axis, side, i + 1, j + 1), d = at(axis, side, i, j + 1);
                    made.triangles.emplace_back(a, b, c);
                    made.triangles.emplace_back(a, c, d);
                }
    return made;
}

/// How the squares of a sheet are cut.
enum class Cut {
    same,     ///< all along the same diagonal
    crossed,  ///< along alternating diagonals
    random,   ///< points moved within their cells, diagonals and then sides turned at random: thin and obtuse
};

/// A flat sheet from (0, 0, 0) to (width, height, 0) of columns x rows squares, row after row. With
/// Cut::random every `column_kept`-th column of points keeps its x and its sides: folds can lie there.
[[nodiscard]] inline Surface sheet(int columns, int rows, float width, float height, Cut cut = Cut::same,
                                   int column_kept = 1 << 20, unsigned seed = 1) {
    Surface made;
    test::Random random(seed);
    const auto jitter = [&random] { return random.between(-0.2f, 0.2f); };
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const bool keeps_x = cut != Cut::random || i == columns || i % column_kept == 0;
            const bool keeps_y = cut != Cut::random || j == 0 || j == rows;
            const float x = static_cast<float>(i) + (keeps_x ? 0.0f : jitter());
            const float y = static_cast<float>(j) + (keeps_y ? 0.0f : jitter());
            made.positions.emplace_back(width * x / static_cast<float>(columns),
                                        height * y / static_cast<float>(rows), 0.0f);
        }
    const auto at = [&](int i, int j) { return j * (columns + 1) + i; };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            const bool other = cut == Cut::crossed && (i + j) % 2 == 1;
            if (other) {
                made.triangles.emplace_back(a, b, d);
                made.triangles.emplace_back(b, c, d);
            } else {
                made.triangles.emplace_back(a, b, c);
                made.triangles.emplace_back(a, c, d);
            }
        }
    if (cut != Cut::random) return made;

    // Sides turned at random if the two triangles make a convex quadrilateral.
    const auto area = [&](int a, int b, int c) {
        const glm::dvec2 ab = glm::dvec2(made.positions[b]) - glm::dvec2(made.positions[a]);
        const glm::dvec2 ac = glm::dvec2(made.positions[c]) - glm::dvec2(made.positions[a]);
        return ab.x * ac.y - ab.y * ac.x;
    };
    const double least = 0.02 * width * height / (static_cast<double>(columns) * rows);
    for (int sweep = 0; sweep < 3; ++sweep) {
        std::map<std::pair<int, int>, std::pair<int, int>> at_side;  // triangle, corner before the side
        for (int t = 0; t < static_cast<int>(made.triangles.size()); ++t)
            for (int k = 0; k < 3; ++k)
                at_side[{made.triangles[t][k], made.triangles[t][(k + 1) % 3]}] = {t, k};
        std::vector<bool> is_used(made.triangles.size());
        for (const auto& [side, one] : at_side) {
            const auto other = at_side.find({side.second, side.first});
            if (side.first > side.second || other == at_side.end() || random.chance(0.5)) continue;
            const auto [t, k] = one;
            const auto [u, l] = other->second;
            if (is_used[t] || is_used[u]) continue;
            const int a = side.first, b = side.second;
            const int c = made.triangles[t][(k + 2) % 3], d = made.triangles[u][(l + 2) % 3];
            const int i = a % (columns + 1), j = b % (columns + 1);
            if (i == j && i % column_kept == 0) continue;
            if (area(a, d, c) < least || area(d, b, c) < least) continue;
            made.triangles[t] = {a, d, c};
            made.triangles[u] = {d, b, c};
            is_used[t] = is_used[u] = true;
        }
    }
    return made;
}

/// The flat sheet bent sharply about lines of constant x, every `step`, by `angle` to and fro: lengths along
/// the surface stay as they were.
[[nodiscard]] inline Surface folded(Surface flat, float step, float angle) {
    for (glm::vec3& p : flat.positions) {
        const int fold = static_cast<int>(std::floor(p.x / step + 1e-4f));
        const float along = p.x - static_cast<float>(fold) * step;
        const float rise = along * std::sin(0.5f * angle);
        p.x = p.x * std::cos(0.5f * angle);
        p.z = fold % 2 == 0 ? rise : step * std::sin(0.5f * angle) - rise;
    }
    return flat;
}

/// The mesh with its vertices in a different order; `place` has the new index of each.
[[nodiscard]] inline Surface shuffled(const Surface& surface, std::vector<std::uint32_t>& place,
                                      unsigned seed) {
    place.resize(surface.positions.size());
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<std::uint32_t>(i);
    test::Random random(seed);
    random.shuffle(std::span(place));
    Surface made = surface;
    for (std::size_t i = 0; i < place.size(); ++i) made.positions[place[i]] = surface.positions[i];
    for (glm::ivec3& t : made.triangles) t = {place[t.x], place[t.y], place[t.z]};
    random.shuffle(std::span(made.triangles));
    return made;
}

}  // namespace motus::mesh::checks
