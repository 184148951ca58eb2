#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "motus/core/numeric.hpp"
#include "motus/mesh/picker.hpp"
#include "picker_meshes.hpp"

using namespace motus;
using namespace motus::mesh;
using namespace motus::mesh::checks;

namespace {

double distance_to_segment(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& point) {
    const glm::dvec3 way = b - a;
    const double square = glm::dot(way, way);
    const double share = square > 0.0 ? std::clamp(glm::dot(point - a, way) / square, 0.0, 1.0) : 0.0;
    return glm::length(point - a - share * way);
}

/// The distance to the plane if the foot is inside, else that to the nearest side.
double distance_to_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                            const glm::dvec3& point) {
    const double sides = std::min({distance_to_segment(a, b, point), distance_to_segment(b, c, point),
                                   distance_to_segment(c, a, point)});
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double area = glm::length(across);
    if (!(area > 0.0)) return sides;
    const auto is_inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, point - from), across) >= 0.0;
    };
    if (!is_inside(a, b) || !is_inside(b, c) || !is_inside(c, a)) return sides;
    return std::min(sides, std::abs(glm::dot(point - a, across)) / area);
}

}  // namespace

TEST_CASE("no place of the surface is nearer than the one that is found, which is there", "[picker]") {
    Dice dice(11);
    constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
    std::vector<Mesh> meshes = troubling_meshes();
    meshes.push_back(
        {"a triangle with a corner nowhere", {{0, 0, 0}, {1, 0, 0}, {0, nowhere, 0}}, {{0, 1, 2}}});
    meshes.push_back({"a triangle that is a segment", {{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}}});
    meshes.push_back({"a triangle in a line", {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}}, {{0, 2, 1}}});
    for (const Mesh& mesh : meshes) {
        const Picker picker(mesh.positions, mesh.triangles, 1);
        const auto [centre, size] = extent(mesh);
        for (int round = 0; round < 40; ++round) {
            const glm::dvec3 point(
                round == 0 ? centre : centre + dice.in_cube(round < 5 ? 50.0f * size : 1.5f * size));
            double nearest = std::numeric_limits<double>::infinity();
            const auto corner = [&](int vertex) { return mesh.positions[static_cast<std::size_t>(vertex)]; };
            for (const glm::ivec3& t : mesh.triangles)
                if (is_finite(corner(t.x)) && is_finite(corner(t.y)) && is_finite(corner(t.z)))
                    nearest =
                        std::min(nearest, distance_to_triangle(corner(t.x), corner(t.y), corner(t.z), point));
            const auto found = picker.nearest_on_surface(point);
            CAPTURE(mesh.name, round, nearest);
            REQUIRE(found.has_value() == std::isfinite(nearest));
            if (!found) continue;
            const double rounding = 1e-7 * (nearest + static_cast<double>(size));
            CHECK(std::abs(found->distance - nearest) <= rounding);
            CHECK(std::abs(glm::length(found->point - point) - found->distance) <= rounding);
            const auto vertex = [&](std::size_t which) {
                return glm::dvec3(mesh.positions[found->corners[which]]);
            };
            CHECK(distance_to_triangle(vertex(0), vertex(1), vertex(2), found->point) <= rounding);
            CHECK(picker.nearest_on_surface(point, found->distance * (1.0 + 1e-12) + 1e-300)->triangle ==
                  found->triangle);
            if (found->distance > rounding) CHECK(!picker.nearest_on_surface(point, 0.999 * found->distance));
        }
    }
}

TEST_CASE("of triangles as near the first one is found, and nothing for what is no point", "[picker]") {
    const Mesh flat = sheet(5);
    const Picker picker(flat.positions, flat.triangles, 1);
    for (const glm::dvec3& above : {glm::dvec3(2, 2, 1), glm::dvec3(1.5, 1.5, -3)}) {
        std::uint32_t first = 100;
        for (std::uint32_t i = 0; i < flat.triangles.size(); ++i) {
            const glm::ivec3 t = flat.triangles[i];
            const auto corner = [&](int vertex) {
                return glm::dvec3(flat.positions[static_cast<std::size_t>(vertex)]);
            };
            if (distance_to_triangle(corner(t.x), corner(t.y), corner(t.z), above) <= std::abs(above.z))
                first = std::min(first, i);
        }
        CHECK(picker.nearest_on_surface(above)->triangle == first);
    }
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(!picker.nearest_on_surface({nan, 0.0, 0.0}));
    CHECK(!picker.nearest_on_surface({0.0, std::numeric_limits<double>::infinity(), 0.0}));
    CHECK(!picker.nearest_on_surface({1.0, 1.0, 1.0}, nan));
    CHECK(!picker.nearest_on_surface({1.0, 1.0, 1.0}, -1.0));
}
