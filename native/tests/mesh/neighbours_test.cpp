#include "motus/mesh/neighbours.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "sample_surfaces.hpp"

using namespace motus;
using namespace motus::mesh;
using namespace motus::mesh::checks;

namespace {

[[nodiscard]] std::vector<std::uint32_t> list(std::span<const std::uint32_t> ends) {
    return {ends.begin(), ends.end()};
}

[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> list(std::span<const glm::uvec2> fan) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> made;
    for (const glm::uvec2& others : fan) made.emplace_back(others.x, others.y);
    return made;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
using Ends = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("a vertex has the other corners of its triangles around it", "[neighbours]") {
    const std::vector<glm::ivec3> triangles{{0, 1, 2}, {0, 2, 3}};
    const auto around = Neighbours::of_triangles(5, triangles);
    CHECK(around.vertex_count() == 5);
    CHECK(list(around.fan(0)) == Pairs{{1, 2}, {2, 3}});
    CHECK(list(around.fan(1)) == Pairs{{2, 0}});
    CHECK(list(around.fan(2)) == Pairs{{0, 1}, {3, 0}});
    CHECK(around.fan(4).empty());
    CHECK(list(around.edge_ends(0)) == Ends{1, 2, 3});
    CHECK(list(around.edge_ends(3)) == Ends{0, 2});
    CHECK(around.edge_ends(4).empty());
}

TEST_CASE("a mesh's own edges leave out the diagonals, and wires are neighbours too", "[neighbours]") {
    const std::vector<glm::ivec3> triangles{{0, 1, 2}, {0, 2, 3}};
    const std::vector<glm::ivec2> edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {3, 4}, {4, 5}};
    const Neighbours around(7, triangles, edges);
    CHECK(list(around.edge_ends(0)) == Ends{1, 3});
    CHECK(list(around.edge_ends(3)) == Ends{2, 0, 4});
    CHECK(list(around.fan(3)) == Pairs{{0, 2}, {4, 4}});
    CHECK(list(around.fan(4)) == Pairs{{3, 3}, {5, 5}});
    CHECK(list(around.fan(0)) == Pairs{{1, 2}, {2, 3}});
    CHECK(around.fan(6).empty());
}

TEST_CASE("edges and triangles that repeat a vertex add no neighbour", "[neighbours]") {
    const std::vector<glm::ivec3> triangles{{0, 0, 1}, {1, 2, 1}, {2, 2, 2}};
    const std::vector<glm::ivec2> edges{{0, 0}, {0, 1}};
    const Neighbours around(3, triangles, edges);
    CHECK(list(around.fan(0)) == Pairs{{1, 1}});
    CHECK(around.fan(2).empty());
    CHECK(list(around.edge_ends(0)) == Ends{1});
    CHECK(Neighbours::of_triangles(3, triangles).edge_ends(0).empty());
}

TEST_CASE("indices outside the mesh are refused", "[neighbours]") {
    const std::vector<glm::ivec3> none;
    CHECK_THROWS_AS(Neighbours::of_triangles(2, std::vector<glm::ivec3>{{0, 1, 2}}), std::invalid_argument);
    CHECK_THROWS_AS(Neighbours::of_triangles(2, std::vector<glm::ivec3>{{0, 1, -1}}), std::invalid_argument);
    CHECK_THROWS_AS(Neighbours(2, none, std::vector<glm::ivec2>{{0, 2}}), std::invalid_argument);
    CHECK(Neighbours::of_triangles(0, none).vertex_count() == 0);
    CHECK(Neighbours().vertex_count() == 0);
    CHECK(Neighbours(4, none, {}).fan(3).empty());
}

TEST_CASE("a large mesh has the neighbours that its triangles say", "[neighbours]") {
    // Large enough that several threads share the work.
    const Surface surface = sheet(300, 400, 1.0f, 1.0f, Cut::crossed);
    std::vector<Pairs> fans(surface.positions.size());
    std::vector<std::set<std::uint32_t>> ends(surface.positions.size());
    std::set<std::pair<int, int>> sides;
    for (const glm::ivec3& t : surface.triangles)
        for (int i = 0; i < 3; ++i) {
            const int at = t[i];
            const int next = t[(i + 1) % 3];
            const int last = t[(i + 2) % 3];
            fans[static_cast<std::size_t>(at)].emplace_back(next, last);
            ends[static_cast<std::size_t>(at)].insert(
                {static_cast<std::uint32_t>(next), static_cast<std::uint32_t>(last)});
            sides.insert(std::minmax(at, next));
        }
    std::vector<glm::ivec2> edges;
    for (const auto& [a, b] : sides) edges.emplace_back(a, b);

    const auto by_triangles = Neighbours::of_triangles(surface.positions.size(), surface.triangles);
    const Neighbours by_edges(surface.positions.size(), surface.triangles, edges);
    std::size_t wrong = 0;
    for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
        const Ends wanted(ends[v].begin(), ends[v].end());
        Ends given = list(by_edges.edge_ends(v));
        std::ranges::sort(given);
        if (list(by_triangles.fan(v)) != fans[v] || list(by_edges.fan(v)) != fans[v]) ++wrong;
        if (list(by_triangles.edge_ends(v)) != wanted || given != wanted) ++wrong;
    }
    CHECK(wrong == 0);
}
