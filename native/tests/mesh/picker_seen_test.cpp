#include <catch2/catch.hpp>
#include <numeric>
#include <stdexcept>

#include "motus/mesh/picker.hpp"
#include "picker_meshes.hpp"

using namespace motus;
using namespace motus::mesh;
using namespace motus::mesh::checks;

namespace {

const glm::dvec3 down(0.0, 0.0, -1.0);

/// The vertex picked by a ray straight down at x, y.
std::uint32_t picked(const Picker& picker, double x, double y, std::span<const std::uint8_t> hidden = {},
                     const glm::mat3& metric = glm::mat3(1.0f)) {
    const auto hit = picker.ray({x, y, 50.0}, down);
    REQUIRE(hit);
    return picker.nearest_seen(*hit, down, hidden, metric);
}

/// A sheet whose rows are `squeeze` times as near to each other, with sides of triangles either way round.
Mesh slivers(float squeeze) {
    Mesh mesh = sheet(12);
    for (glm::vec3& p : mesh.positions) p = {p.x + squeeze * p.y * 3.0f, p.y * squeeze, 0.0f};
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        std::swap(mesh.triangles[i].x, mesh.triangles[i].y);
    return mesh;
}

/// Two sheets, the lower one facing down, that hang together at their rims.
Mesh wall(int side, float thickness) {
    Mesh mesh = sheet(side);
    const int count = side * side;
    for (int i = 0; i < count; ++i)
        mesh.positions.push_back(mesh.positions[static_cast<std::size_t>(i)] - glm::vec3(0, 0, thickness));
    for (std::size_t i = 0, end = mesh.triangles.size(); i < end; ++i) {
        const glm::ivec3& t = mesh.triangles[i];
        mesh.triangles.emplace_back(t.x + count, t.z + count, t.y + count);
    }
    for (int i = 0; i + 1 < side; ++i) {
        for (const int step : {1, side}) {
            for (const int start : {0, step == 1 ? count - side : side - 1}) {
                const int a = start + i * step, b = a + step;
                mesh.triangles.emplace_back(a, b, a + count);
                mesh.triangles.emplace_back(b, b + count, a + count);
            }
        }
    }
    return mesh;
}

}  // namespace

TEST_CASE("a hit on thin triangles finds the nearest vertex of all around", "[picker]") {
    const glm::mat3 metric(0.5f, 0, 0, 0, 3.0f, 0, 0, 0, 1);
    std::size_t beyond = 0;
    for (const float squeeze : {1.0f, 0.3f, 0.1f, 0.03f}) {
        const Mesh mesh = slivers(squeeze);
        const Picker picker(mesh.positions, mesh.triangles);
        Dice dice(20);
        for (int trial = 0; trial < 300; ++trial) {
            const float y = dice.between(0.0f, 11.0f) * squeeze, x = dice.between(0.0f, 11.0f) + 3.0f * y;
            const auto hit = picker.ray({x, y, 1}, down);
            if (!hit) continue;
            for (const glm::mat3& by : {glm::mat3(1.0f), metric}) {
                double least = std::numeric_limits<double>::infinity();
                for (std::size_t i = 0; i < mesh.positions.size(); ++i)
                    least = std::min(least, distance_to(mesh, i, {x, y, 0}, by));
                const std::uint32_t found = picker.nearest_seen(*hit, down, {}, by);
                CHECK(distance_to(mesh, found, {x, y, 0}, by) <= least + 1e-5);
                beyond += std::ranges::find(hit->corners, found) == hit->corners.end() ? 1 : 0;
            }
        }
    }
    CHECK(beyond > 100);  // else nothing was tested
}

TEST_CASE("the vertex nearest to a hit is neither on the far side of a wall nor on another sheet",
          "[picker]") {
    // The coarse front has finer sheets behind it, one facing each way.
    Mesh mesh = sheet(5);
    for (glm::vec3& p : mesh.positions) p *= 4.0f;
    for (const bool is_turned : {false, true}) {
        const auto first = static_cast<int>(mesh.positions.size());
        const Mesh behind = sheet(17);
        for (const glm::vec3& p : behind.positions)
            mesh.positions.push_back(p - glm::vec3(0, 0, is_turned ? 0.02f : 0.01f));
        for (const glm::ivec3& t : behind.triangles)
            mesh.triangles.push_back(first + (is_turned ? glm::ivec3(t.y, t.x, t.z) : t));
    }
    const Picker picker(mesh.positions, mesh.triangles);
    Dice dice(21);
    for (int trial = 0; trial < 200; ++trial) {
        const float x = dice.between(0.1f, 15.9f);
        CHECK(picked(picker, x, dice.between(0.1f, 15.9f)) < 25);
    }

    const Mesh thin = wall(6, 0.01f);
    Mesh dented = thin;  // so that across the rim a vertex of the far side is the nearest by far
    dented.positions[36 + 7] = {0.5f, 0.2f, -0.01f};
    for (const bool is_flipped : {false, true}) {
        const Picker around(dented.positions, dented.triangles);
        CHECK(around.nearest({0.5f, 0.2f, 0.0f}) == 36 + 7);
        for (int trial = 0; trial < 200; ++trial) {
            const float x = dice.between(0.01f, 4.99f);
            CHECK(picked(around, x, dice.between(0.01f, 4.99f)) < 36);
        }
        // The order of the corners does not matter.
        if (!is_flipped)
            for (glm::ivec3& t : dented.triangles) t = {t.y, t.x, t.z};
    }
    const auto from_below = Picker(thin.positions, thin.triangles).ray({0.6, 0.7, -9}, -down);
    REQUIRE(from_below);
    CHECK(Picker(thin.positions, thin.triangles).nearest_seen(*from_below, -down) == 36 + 7);
}

TEST_CASE("hidden vertices are not found if others are", "[picker]") {
    const Mesh mesh = sheet(9);
    const Picker picker(mesh.positions, mesh.triangles);
    std::vector<std::uint8_t> hidden(mesh.positions.size(), 0);
    CHECK(picked(picker, 4.2, 4.1, hidden) == 40);
    hidden[40] = 1;
    CHECK(picked(picker, 4.2, 4.1, hidden) == 41);
    // A whole patch, all corners of the triangle among them.
    for (int y = 3; y <= 6; ++y)
        for (int x = 2; x <= 6; ++x) hidden[static_cast<std::size_t>(9 * y + x)] = 1;
    CHECK(picked(picker, 4.2, 3.9, hidden) == 9 * 2 + 4);
    std::fill(hidden.begin(), hidden.end(), std::uint8_t{1});
    CHECK(picked(picker, 4.2, 4.1, hidden) == 40);
    hidden.pop_back();
    CHECK_THROWS_AS(picked(picker, 4.2, 4.1, hidden), std::invalid_argument);
}

TEST_CASE("the nearest vertex does not depend on how the tree was built", "[picker]") {
    std::size_t found = 0;
    for (const Mesh& mesh : troubling_meshes()) {
        if (mesh.positions.empty()) continue;
        INFO(mesh.name);
        const auto [centre, size] = extent(mesh);
        Dice dice(22);
        Mesh bent = mesh;
        const glm::vec3 wave = 4.0f * dice.in_cube(1.0f) / size, along = 0.05f * dice.in_cube(size);
        for (glm::vec3& p : bent.positions) p += std::sin(glm::dot(wave, p - centre)) * along;
        const Picker old(mesh.positions, mesh.triangles), fresh(bent.positions, bent.triangles);
        Picker refitted(mesh.positions, mesh.triangles);
        refitted.refit(bent.positions);
        for (int trial = 0; trial < 60; ++trial) {
            const glm::dvec3 from(centre + dice.in_cube(2.0f * size));
            const glm::dvec3 towards = glm::dvec3(centre + dice.in_cube(0.7f * size)) - from;
            const auto hit = fresh.ray(from, towards);
            if (!hit) continue;
            ++found;
            const std::uint32_t vertex = fresh.nearest_seen(*hit, towards);
            CHECK(refitted.nearest_seen(*hit, towards) == vertex);
            CHECK(old.nearest_seen(*hit, towards, bent.positions, 0.1f * size) == vertex);
            const glm::vec3 point(hit->point);
            for (const std::uint32_t corner : hit->corners)
                CHECK(distance_to(bent, vertex, point) <=
                      distance_to(bent, corner, point) * (1.0 + 1e-5) + 1e-6 * double(size));
        }
    }
    CHECK(found > 200);
}

TEST_CASE("a hit between a thousand long triangles finds a vertex at their ends", "[picker]") {
    Mesh tube{"tube", {}, {}};
    constexpr int around = 2000;
    for (int i = 0; i < around; ++i) {
        const float turn = 2.0f * 3.14159265f * static_cast<float>(i) / around;
        for (const float y : {-3.0f, 3.0f}) tube.positions.emplace_back(std::cos(turn), y, std::sin(turn));
        const int a = 2 * i, b = 2 * ((i + 1) % around);
        tube.triangles.emplace_back(a, b, a + 1);
        tube.triangles.emplace_back(b, b + 1, a + 1);
    }
    const Picker picker(tube.positions, tube.triangles);
    const std::uint32_t vertex = picked(picker, 0.001, 0.5);
    CHECK(tube.positions[vertex].y == 3.0f);
    CHECK(tube.positions[vertex].z > 0.99f);
}
