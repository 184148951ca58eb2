#include "motus/mesh/weld.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

#include "motus/mesh/neighbours.hpp"
#include "motus/mesh/surface_distance.hpp"
#include "random.hpp"

using namespace motus;
using mesh::weld;

namespace {

using Leaders = std::vector<std::uint32_t>;

/// The definition, by comparing all vertices with each other.
[[nodiscard]] Leaders by_definition(const std::vector<glm::vec3>& positions, float distance,
                                    const glm::mat3& metric) {
    const auto count = static_cast<std::uint32_t>(positions.size());
    Leaders leaders(count, count);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (leaders[i] != count) continue;
        for (std::uint32_t k = i; k < count; ++k)
            if (leaders[k] == count && glm::length(metric * (positions[k] - positions[i])) <= distance)
                leaders[k] = i;
    }
    return leaders;
}

}  // namespace

TEST_CASE("near vertices have one leader, and the leader of a row is not far away", "[mesh]") {
    // A row of steps of 1: whoever lies within 1.5 of a leader follows it.
    const std::vector<glm::vec3> row{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
    CHECK(weld(row, 1.5f) == Leaders{0, 0, 2, 2, 4});
    CHECK(weld(row, 0.5f) == Leaders{0, 1, 2, 3, 4});
    CHECK(weld(row, 9.0f) == Leaders{0, 0, 0, 0, 0});
    // The end of the distance belongs to it, and at 0 the same place alone does.
    CHECK(weld(row, 1.0f) == Leaders{0, 0, 2, 2, 4});
    CHECK(weld(std::vector<glm::vec3>{{1, 2, 3}, {1, 2, 4}, {1, 2, 3}}, 0.0f) == Leaders{0, 1, 0});
    CHECK(weld({}, 1.0f).empty());
}

TEST_CASE("a weld is what its definition says, by any metric", "[mesh]") {
    test::Random random(7);
    const glm::mat3 sheared(2.0f, 0.0f, 0.0f, 0.5f, 1.0f, 0.0f, 0.0f, 0.25f, 0.125f);
    for (const float distance : {0.0f, 0.02f, 0.1f, 0.4f}) {
        for (const glm::mat3& metric : {glm::mat3(1.0f), sheared}) {
            std::vector<glm::vec3> positions;
            for (int i = 0; i < 400; ++i) {
                // On a coarse grid, so that many lie at the same place.
                const auto x = [&] { return std::round(16.0f * float(random.between(0.0, 1.0))) / 16.0f; };
                const float a = x();
                const float b = x();
                const float c = x();
                positions.emplace_back(a, b, c);
            }
            CHECK(weld(positions, distance, metric) == by_definition(positions, distance, metric));
            CHECK(weld(positions, distance, metric, 1) == weld(positions, distance, metric, 4));
        }
    }
}

TEST_CASE("along a welded surface distances go over the gaps", "[mesh]") {
    // A strip of squares of loose triangles: each has three vertices of its own.
    constexpr int squares = 8;
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const auto first = static_cast<int>(positions.size());
        positions.insert(positions.end(), {a, b, c});
        triangles.emplace_back(first, first + 1, first + 2);
    };
    for (int i = 0; i < squares; ++i) {
        const auto x = static_cast<float>(i);
        add({x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0});
        add({x, 0, 0}, {x + 1, 1, 0}, {x, 1, 0});
    }
    const auto count = positions.size();
    const auto loose = mesh::Neighbours::of_triangles(count, triangles);
    CHECK(mesh::surface_reach(positions, loose, 0, 100.0f).vertices.size() == 3);

    const Leaders leaders = weld(positions, 1e-3f);
    for (glm::ivec3& corners : triangles)
        for (int i = 0; i < 3; ++i)
            corners[i] = static_cast<int>(leaders[static_cast<std::size_t>(corners[i])]);
    const auto joined = mesh::Neighbours::of_triangles(count, triangles);
    const mesh::Reach reach = mesh::surface_reach(positions, joined, leaders[0], 100.0f);
    CHECK(reach.vertices.size() == 2 * (squares + 1));
    for (std::size_t i = 0; i < reach.vertices.size(); ++i)
        CHECK(reach.distances[i] == Approx(glm::length(positions[reach.vertices[i]])).epsilon(1e-4));
}

TEST_CASE("a vertex at no place leads itself, and no distance is below 0", "[mesh]") {
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    constexpr float endless = std::numeric_limits<float>::infinity();
    const std::vector<glm::vec3> positions{{none, 0, 0}, {0, 0, 0}, {none, 0, 0}, {0, 0, 0}, {endless, 0, 0}};
    CHECK(weld(positions, 1.0f) == Leaders{0, 1, 2, 1, 4});
    for (const float distance : {-1.0f, none, endless})
        CHECK_THROWS_AS(weld(positions, distance), std::invalid_argument);
}
