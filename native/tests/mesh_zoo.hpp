// Meshes as they come out of files: whatever takes a mesh is run over all of them.
#pragma once
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

namespace motus::test {

struct ZooMesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
    bool is_finite = true;    ///< whether all positions are
    bool has_area = true;     ///< whether any triangle has one
    bool are_indices = true;  ///< whether triangles name vertices that there are
};

/// A slope down to a floor, of cells x cells quads each, in z from `height` to 0.
[[nodiscard]] inline ZooMesh slope_and_floor(int cells, float height) {
    ZooMesh mesh{"slope and floor", {}, {}};
    const int columns = 2 * cells;
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= columns; ++column) {
            const float x = 2.0F * static_cast<float>(column) / static_cast<float>(cells) - 2.0F;
            const float y = 2.0F * static_cast<float>(row) / static_cast<float>(cells) - 1.0F;
            mesh.positions.emplace_back(x, y, x < 0.0F ? -0.5F * height * x : 0.0F);
        }
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < columns; ++column) {
            const int at = row * (columns + 1) + column, above = at + columns + 1;
            mesh.triangles.emplace_back(at, at + 1, above + 1);
            mesh.triangles.emplace_back(at, above + 1, above);
        }
    return mesh;
}

/// Slope and floor that hang together by triangles without area: between both rows of vertices at the foot,
/// which lie in one place, or on one line.
[[nodiscard]] inline ZooMesh flat_at_the_foot(float apart, float height = 4.0F) {
    ZooMesh mesh{"triangles without area at the foot of a slope", {}, {}};
    constexpr int cells = 4;
    const auto column = [&](float x, float z, float shift) {
        for (int row = 0; row <= cells; ++row)
            mesh.positions.emplace_back(x, 0.5F * static_cast<float>(row) - 1.0F + shift, z);
    };
    column(-2.0F, height, 0.0F);
    column(0.0F, 0.0F, 0.0F);
    column(0.0F, 0.0F, apart);  // on the line of those before
    column(2.0F, 0.0F, 0.0F);
    for (int strip = 0; strip < 3; ++strip)
        for (int row = 0; row < cells; ++row) {
            const int at = strip * (cells + 1) + row, next = at + cells + 1;
            mesh.triangles.emplace_back(at, next, next + 1);
            mesh.triangles.emplace_back(at, next + 1, at + 1);
        }
    return mesh;
}

[[nodiscard]] inline std::vector<ZooMesh> mesh_zoo() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    inf = std::numeric_limits<float>::infinity();
    std::vector<ZooMesh> zoo;
    zoo.push_back({"nothing", {}, {}, true, false});
    zoo.push_back({"a vertex", {{1.0F, 2.0F, 3.0F}}, {}, true, false});
    zoo.push_back({"a triangle", {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    zoo.push_back({"a triangle of one vertex", {{0, 0, 0}, {1, 0, 0}}, {{1, 1, 1}, {0, 1, 0}}, true, false});
    zoo.push_back({"a triangle on a line", {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}, true, false});
    zoo.push_back({"all in one place", {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}, true, false});
    zoo.push_back(slope_and_floor(4, 1.0F));
    zoo.push_back(flat_at_the_foot(0.0F));
    zoo.push_back(flat_at_the_foot(0.25F));
    zoo.back().name += ", one beside the other";

    ZooMesh needles = slope_and_floor(4, 0.0F);
    needles.name = "needles";
    for (glm::vec3& p : needles.positions) p.y *= 1e-6F;
    zoo.push_back(needles);

    ZooMesh doubled = slope_and_floor(3, 1.0F);
    doubled.name = "every triangle twice, and once turned";
    for (std::size_t i = 0, count = doubled.triangles.size(); i < count; ++i) {
        const glm::ivec3 t = doubled.triangles[i];
        doubled.triangles.push_back(t);
        doubled.triangles.emplace_back(t.z, t.y, t.x);
    }
    zoo.push_back(doubled);

    ZooMesh stacked = slope_and_floor(3, 1.0F);
    stacked.name = "all vertices twice, in one place";
    const auto first = static_cast<int>(stacked.positions.size());
    for (int i = 0; i < first; ++i)
        stacked.positions.push_back(stacked.positions[static_cast<std::size_t>(i)]);
    for (std::size_t i = 0, count = stacked.triangles.size(); i < count; ++i)
        stacked.triangles.push_back(stacked.triangles[i] + first);
    zoo.push_back(stacked);

    ZooMesh book{"pages on one edge", {{-1, 0, 0}, {1, 0, 0}}, {}};
    for (int page = 0; page < 7; ++page) {
        const float angle = 0.9F * static_cast<float>(page);
        book.positions.emplace_back(0.0F, std::cos(angle), std::sin(angle));
        book.triangles.emplace_back(0, 1, page + 2);
    }
    zoo.push_back(book);

    ZooMesh bow{
        "two triangles on one vertex", {{0, 0, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0}}, {}};
    bow.triangles = {{0, 1, 2}, {0, 3, 4}};
    zoo.push_back(bow);

    ZooMesh turned = slope_and_floor(3, 1.0F);
    turned.name = "every other triangle turned";
    for (std::size_t i = 0; i < turned.triangles.size(); i += 2)
        std::swap(turned.triangles[i].x, turned.triangles[i].y);
    zoo.push_back(turned);

    ZooMesh loose = slope_and_floor(3, 1.0F);
    loose.name = "loose vertices, and triangles that share nothing";
    for (int i = 0; i < 9; ++i) loose.positions.emplace_back(0.3F * static_cast<float>(i), 5.0F, 1.0F);
    loose.triangles.emplace_back(first, first + 1, first + 2);
    loose.positions.emplace_back(-0.5F, 0.0F, 2.0F);
    loose.positions.emplace_back(0.5F, 0.0F, 2.0F);
    loose.positions.emplace_back(0.0F, 0.5F, 2.0F);
    const auto last = static_cast<int>(loose.positions.size());
    loose.triangles.emplace_back(last - 3, last - 2, last - 1);
    zoo.push_back(loose);

    for (const float scale : {1e-42F, 1e-30F, 1e-12F, 1e12F, 1e19F, 1e30F, 8e37F}) {
        ZooMesh sized = slope_and_floor(2, 1.0F);
        sized.name = "slope and floor times " + std::to_string(std::log10(scale));
        for (glm::vec3& p : sized.positions) p *= scale;
        zoo.push_back(sized);
    }
    ZooMesh far = slope_and_floor(2, 1.0F);
    far.name = "far from the origin, where vertices fall together";
    for (glm::vec3& p : far.positions) p += 3e7F;
    far.has_area = false;
    zoo.push_back(far);

    for (const float bad : {nan, inf, -inf}) {
        ZooMesh broken = slope_and_floor(3, 1.0F);
        broken.name = "a coordinate that is " + std::to_string(bad);
        broken.positions[5].y = bad;
        broken.is_finite = false;
        zoo.push_back(broken);
    }
    for (const int bad : {-1, std::numeric_limits<int>::min(), 28, std::numeric_limits<int>::max()}) {
        ZooMesh broken = slope_and_floor(3, 1.0F);
        broken.name = "a triangle that names vertex " + std::to_string(bad);
        broken.triangles[4].z = bad;
        broken.are_indices = false;
        zoo.push_back(broken);
    }
    return zoo;
}

}  // namespace motus::test
