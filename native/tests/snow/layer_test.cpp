#include "motus/snow/layer.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "motus/core/numeric.hpp"
#include "random.hpp"
#include "sheets.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);
constexpr float thin = 0.01F;
constexpr float any_slope = std::numeric_limits<float>::infinity();

/// Every side of a triangle is an edge, which is there once; how often each directed side is there.
[[nodiscard]] std::map<std::pair<int, int>, int> checked_sides(const SnowLayer::Mesh& mesh) {
    REQUIRE(mesh.sides.size() == mesh.triangles.size());
    REQUIRE(mesh.depths.size() == mesh.positions.size());
    std::map<std::pair<int, int>, int> edges, sides;
    for (const glm::ivec2& edge : mesh.edges) {
        CHECK(edge.x != edge.y);
        CHECK(++edges[std::minmax(edge.x, edge.y)] == 1);
    }
    std::map<std::pair<int, int>, int> used;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const int a = mesh.triangles[i][corner], b = mesh.triangles[i][(corner + 1) % 3];
            const glm::ivec2 edge = mesh.edges.at(static_cast<std::size_t>(mesh.sides[i][corner]));
            CHECK(std::minmax(a, b) == std::minmax(edge.x, edge.y));
            used[std::minmax(a, b)] = 1;
            CHECK(++sides[{a, b}] == 1);
        }
    }
    CHECK(used.size() == edges.size());
    return sides;
}

/// m^3 between a layer without holes and the sheet z = 0.
[[nodiscard]] double volume(const SnowLayer::Mesh& mesh) {
    double sum = 0.0;
    for (const glm::ivec3& t : mesh.triangles) {
        const auto at = [&](int i) { return glm::dvec3(mesh.positions[static_cast<std::size_t>(t[i])]); };
        sum += glm::cross(at(1) - at(0), at(2) - at(0)).z * (at(0).z + at(1).z + at(2).z) / 6.0;
    }
    return sum;
}

/// The depths of an open layer after heaps have fallen, edge after edge by the numbers of their ends.
[[nodiscard]] std::vector<float> fallen(const Points& positions, const Triangles& triangles,
                                        std::vector<float> depths, float steepest) {
    const auto at = [](int vertex) { return static_cast<std::size_t>(vertex); };
    const auto place = [&](int vertex) { return glm::dvec3(positions[at(vertex)]); };
    std::set<std::pair<int, int>> sides;
    std::vector<double> areas(positions.size());
    for (const glm::ivec3& t : triangles) {
        const double third = glm::length(glm::cross(place(t.y) - place(t.x), place(t.z) - place(t.x))) / 6.0;
        for (int i = 0; i < 3; ++i) {
            sides.insert(std::minmax(t[i], t[(i + 1) % 3]));
            areas[at(t[i])] += third;
        }
    }
    std::vector<std::pair<int, int>> edges(sides.begin(), sides.end());
    for (const bool is_last : {false, true}) {
        for (int round = 0; round < 8; ++round, std::ranges::reverse(edges)) {
            for (const auto& [x, y] : edges) {
                const int high = depths[at(x)] > depths[at(y)] ? x : y, low = high == x ? y : x;
                const auto length = static_cast<float>(glm::length(place(y) - place(x)));
                if (!(depths[at(high)] - depths[at(low)] > steepest * length)) continue;
                if (is_last) {
                    depths[at(high)] = depths[at(low)] + steepest * length;
                    continue;
                }
                const auto here = static_cast<float>(areas[at(high)]),
                           there = static_cast<float>(areas[at(low)]);
                const float over = depths[at(high)] - depths[at(low)] - 0.98F * steepest * length;
                const float moved = over / (here + there);
                depths[at(high)] -= there * moved;
                depths[at(low)] += here * moved;
            }
        }
    }
    return depths;
}

}  // namespace

TEST_CASE("the layer is as deep as its snow, and closed at loose edges", "[snow]") {
    Points positions;
    Triangles triangles;
    add_sheet(1.0F, 0.0F, 0.0F, 8, positions, triangles);
    const SnowLayer layer(positions, triangles, up);
    const SnowLayer::Mesh mesh = layer.at(std::vector<float>(positions.size(), 0.25F), thin, any_slope);
    CHECK(volume(mesh) == Approx(4.0 * 0.25).epsilon(1e-5));
    // Walls around: sides without a partner are those at their feet.
    const auto sides = checked_sides(mesh);
    for (const auto& [side, count] : sides) {
        if (sides.contains({side.second, side.first})) continue;
        for (const int end : {side.first, side.second}) {
            CHECK(mesh.positions[static_cast<std::size_t>(end)].z == Approx(-thin));
            CHECK(mesh.depths[static_cast<std::size_t>(end)] == 0.0F);
        }
    }
    CHECK(mesh.triangles.size() == triangles.size() + 2 * 4 * 8);
}

TEST_CASE("what is thin is left out, as far as a line on the surface", "[snow]") {
    test::Random random(5);
    Points positions;
    Triangles triangles;
    add_sheet(1.0F, 0.0F, 0.3F, 20, positions, triangles);
    const SnowLayer layer(positions, triangles, up);
    std::vector<float> depths(positions.size());
    for (std::size_t i = 0; i < depths.size(); ++i)
        depths[i] = positions[i].x < 0.0F ? 0.0F : random.between(0.0F, 4.0F * thin);
    const SnowLayer::Mesh mesh = layer.at(depths, thin, any_slope);
    CHECK(mesh.triangles.size() < triangles.size());
    CHECK(!mesh.triangles.empty());
    const auto sides = checked_sides(mesh);
    CHECK(sides.size() == 3 * mesh.triangles.size());
    const glm::vec3 normal = glm::normalize(glm::vec3(-0.3F, 0.0F, 1.0F));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const float off = glm::dot(mesh.positions[i], normal), depth = mesh.depths[i];
        CHECK(off >= -1.001F * thin);
        if (depth == 0.0F) CHECK(off == Approx(-thin));
        if (depth == Approx(thin)) CHECK(off == Approx(0.0).margin(1e-6));
        if (depth > 2.0F * thin) CHECK(off == Approx(depth));
        CHECK((off > 1e-6F) == (depth > thin * 1.001F));
    }
    CHECK(layer.at(std::vector<float>(positions.size(), thin), thin, any_slope).triangles.empty());
}

TEST_CASE("snow lies on the upper side, whichever way triangles face", "[snow]") {
    Points positions;
    Triangles triangles;
    add_sheet(1.0F, 0.0F, 0.0F, 3, positions, triangles);
    for (glm::ivec3& corners : triangles) std::swap(corners.x, corners.y);
    const SnowLayer layer(positions, triangles, up);
    const SnowLayer::Mesh mesh = layer.at(std::vector<float>(positions.size(), 0.5F), thin, any_slope);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        CHECK(mesh.positions[i].z == (mesh.depths[i] > 0.0F ? 0.5F : 0.0F));
}

TEST_CASE("heaps are not steeper than snow holds", "[snow]") {
    test::Random random(7);
    Points positions;
    Triangles triangles;
    add_sheet(1.0F, 0.0F, 0.0F, 20, positions, triangles);
    const SnowLayer layer(positions, triangles, up);
    std::vector<float> depths(positions.size());
    for (float& depth : depths) depth = random.chance(0.1) ? 0.0F : random.between(0.0F, 3.0F);
    depths[0] = 0.25F;
    const SnowLayer::Mesh mesh = layer.at(depths, 0.0F, 1.5F);
    CHECK(!mesh.triangles.empty());
    for (const glm::ivec2& edge : mesh.edges) {
        const auto a = static_cast<std::size_t>(edge.x), b = static_cast<std::size_t>(edge.y);
        if (mesh.depths[a] == 0.0F || mesh.depths[b] == 0.0F) continue;  // the foot of a wall
        const glm::vec3 way = mesh.positions[b] - mesh.positions[a];
        CHECK(std::abs(mesh.depths[b] - mesh.depths[a]) <= 1.5F * std::hypot(way.x, way.y) + 1e-6F);
    }
    // What is not too steep stays as it is.
    const std::vector<float> even(positions.size(), 0.5F);
    CHECK(layer.at(even, 0.0F, 1.5F).positions == layer.at(even, 0.0F, any_slope).positions);
}

TEST_CASE("what is too high for a heap lies beside it", "[snow]") {
    test::Random random(8);
    Points positions;
    Triangles triangles;
    add_sheet(1.0F, 0.0F, 0.0F, 20, positions, triangles);
    const SnowLayer layer(positions, triangles, up);
    std::vector<float> depths(positions.size());
    for (float& depth : depths) depth = random.chance(0.1) ? 1.0F : random.between(0.0F, 0.1F);
    // Upright walls add nothing to a volume above the plane z = 0.
    const auto volume = [&](float steepest) {
        const SnowLayer::Mesh mesh = layer.at(depths, 0.0F, steepest);
        double sum = 0.0;
        for (const glm::ivec3& t : mesh.triangles) {
            const auto at = [&](int i) { return glm::dvec3(mesh.positions[static_cast<std::size_t>(t[i])]); };
            sum += glm::cross(at(1) - at(0), at(2) - at(0)).z * (at(0).z + at(1).z + at(2).z) / 6.0;
        }
        return sum;
    };
    CHECK(volume(1.5F) == Approx(volume(any_slope)).epsilon(1e-3));
}

TEST_CASE("heaps fall edge after edge by the vertices' numbers, and faces stay in their order", "[snow]") {
    test::Random random(9);
    Points sorted;
    Triangles triangles;
    add_sheet(1.0F, 0.0F, 0.3F, 30, sorted, triangles);
    std::vector<int> numbers(sorted.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    for (const bool is_shuffled : {false, true}) {
        if (is_shuffled)
            for (std::size_t i = numbers.size() - 1; i > 0; --i)
                std::swap(numbers[i],
                          numbers[static_cast<std::size_t>(random.between(0.0, static_cast<double>(i)))]);
        Points positions(sorted.size());
        for (std::size_t i = 0; i < sorted.size(); ++i)
            positions[static_cast<std::size_t>(numbers[i])] = sorted[i];
        Triangles named = triangles;
        for (glm::ivec3& corners : named)
            for (int i = 0; i < 3; ++i) corners[i] = numbers[static_cast<std::size_t>(corners[i])];
        std::vector<float> depths(positions.size());
        for (float& depth : depths) depth = random.between(0.1F, 0.6F);
        const SnowLayer::Mesh mesh = SnowLayer(positions, named, up).at(depths, 0.0F, 1.2F);
        const std::vector<float> wanted = fallen(positions, named, depths, 1.2F);
        CHECK(wanted != depths);
        REQUIRE(mesh.triangles.size() >= named.size());  // and walls after them
        int last = -1;
        for (std::size_t i = 0; i < named.size(); ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const int found = mesh.triangles[i][corner];
                CHECK(found <= last + 2);  // in the order in which triangles name them
                last = std::max(last, found);
                CHECK(mesh.depths[static_cast<std::size_t>(found)] ==
                      wanted[static_cast<std::size_t>(named[i][(corner + 2) % 3])]);
            }
        }
    }
}

TEST_CASE("snow rises evenly along a slanting shadow", "[snow]") {
    // Many cells, and less than one, from the line to the whole depth on a slope that snow holds.
    for (const float depth : {0.05F, 0.4F}) {
        for (const float angle : {0.2F, 0.3F, 1.1F}) {
            Points positions, ground;
            Triangles triangles, sheet;
            constexpr int cells = 40;
            add_sheet(2.0F, 0.0F, 0.0F, cells, positions, triangles);
            ground = positions;
            sheet = triangles;
            const glm::vec3 along(-std::sin(angle), std::cos(angle), 0.0F);
            const glm::vec3 across(std::cos(angle), std::sin(angle), 0.0F);
            const int first = static_cast<int>(positions.size());
            for (const glm::vec2& corner :
                 {glm::vec2(0, -9), glm::vec2(9, -9), glm::vec2(9, 9), glm::vec2(0, 9)})
                positions.push_back(corner.x * across + corner.y * along + glm::vec3(0.0F, 0.0F, 1.0F));
            triangles.emplace_back(first, first + 1, first + 2);
            triangles.emplace_back(first, first + 2, first + 3);
            const Collider shelter(positions, triangles);
            const SnowLayer layer(ground, sheet, up, &shelter, 1.5);
            std::vector<float> depths(ground.size());
            for (std::size_t i = 0; i < depths.size(); ++i)
                depths[i] = glm::dot(ground[i], across) < 0.0F ? depth : 0.0F;
            const SnowLayer::Mesh mesh = layer.at(depths, 0.0F, 1.2F);
            CAPTURE(depth, angle);
            // Half of the sheet, of which little is left out.
            const double whole = 8.0 * static_cast<double>(depth);
            CHECK(volume(mesh) < whole);
            CHECK(volume(mesh) > 0.94 * whole);
            // In strips beside the line, and along it, in the middle of the sheet.
            constexpr float strip = 0.02F;
            std::map<int, std::pair<float, float>> between;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                const glm::vec3& at = mesh.positions[i];
                const float off = -glm::dot(at, across);
                CHECK(at.z < 1.25F * depth);
                CHECK(off > -0.01F);
                if (std::abs(glm::dot(at, along)) > 1.0F || off > 1.2F) continue;
                const auto [found, is_new] = between.try_emplace(static_cast<int>(off / strip), at.z, at.z);
                found->second.first = std::min(found->second.first, at.z);
                found->second.second = std::max(found->second.second, at.z);
            }
            CHECK(between.size() > 30);
            for (const auto& [index, ends] : between) {
                CAPTURE(index, ends.first, ends.second);
                CHECK(ends.second - ends.first < 1.2F * strip + 0.12F * depth);
            }
        }
    }
}

TEST_CASE("a layer of strange triangles", "[snow]") {
    const Points positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    const SnowLayer layer(positions, Triangles{{0, 1, 2}, {1, 1, 2}, {0, 2, 1}}, up);
    const SnowLayer::Mesh mesh = layer.at(std::vector<float>(4, 1.0F), 0.0F, any_slope);
    CHECK(mesh.triangles.size() == 2);
    for (const glm::vec3& position : mesh.positions) CHECK(std::isfinite(position.x));
    CHECK(SnowLayer({}, {}, up).at({}, 0.0F, any_slope).positions.empty());
}

TEST_CASE("a layer names what is wrong", "[snow]") {
    const Points positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const Triangles triangles{{0, 1, 2}};
    const SnowLayer layer(positions, triangles, up);
    CHECK_THROWS_WITH(SnowLayer(positions, Triangles{{0, 1, 3}}, up), Catch::Contains("layer_triangles"));
    CHECK_THROWS_WITH(SnowLayer(Points{glm::vec3(std::nanf(""))}, {}, up),
                      Catch::Contains("layer_positions"));
    CHECK_THROWS_WITH(layer.at(std::vector<float>(2), 0.0F, any_slope), Catch::Contains("depths"));
    CHECK_THROWS_WITH(layer.at(std::vector<float>(3, std::nanf("")), 0.0F, any_slope),
                      Catch::Contains("depths"));
    CHECK_THROWS_WITH(layer.at(std::vector<float>(3), -1.0F, any_slope), Catch::Contains("thinnest"));
    CHECK_THROWS_WITH(layer.at(std::vector<float>(3), 0.0F, 0.0F), Catch::Contains("steepest"));
}
