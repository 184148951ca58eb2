#include "motus/mesh/refine.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "random.hpp"

using namespace motus;
using mesh::refine;
using mesh::Refined;

namespace {

constexpr std::size_t most = 100'000;

[[nodiscard]] glm::dvec3 place(const Refined& one, int at) {
    return {one.positions[static_cast<std::size_t>(at)]};
}
[[nodiscard]] glm::dvec3 area(const Refined& one, const glm::ivec3& t) {
    return 0.5 * glm::cross(place(one, t.y) - place(one, t.x), place(one, t.z) - place(one, t.x));
}
[[nodiscard]] double longest_of(const Refined& one) {
    double longest = 0.0;
    for (const glm::ivec3& t : one.triangles)
        for (int i = 0; i < 3; ++i)
            longest = std::max(longest, glm::distance(place(one, t[i]), place(one, t[(i + 1) % 3])));
    return longest;
}
/// How often each directed side is there.
[[nodiscard]] std::map<std::pair<int, int>, int> sides_of(const Refined& one) {
    std::map<std::pair<int, int>, int> sides;
    for (const glm::ivec3& t : one.triangles)
        for (int i = 0; i < 3; ++i) ++sides[{t[i], t[(i + 1) % 3]}];
    return sides;
}

}  // namespace

TEST_CASE("edges between whose ends there is no position stay as they are", "[mesh]") {
    // Single precision counts in steps of 8 there: no edge becomes as short as asked for.
    constexpr float far = 1e8F, step = 8.0F;
    for (const float size : {1.0F, 2.0F, 13.0F}) {
        const std::vector<glm::vec3> positions{
            {far, far, 0.0F}, {far + size * step, far, 0.0F}, {far, far + size * step, 0.0F}};
        const std::vector<glm::ivec3> triangles{{0, 1, 2}};
        const Refined found = refine(positions, triangles, 1.0, 1000);
        CHECK(longest_of(found) <= std::sqrt(2.0) * static_cast<double>(step));
        // Within the rounding of a middle they lie in the triangle.
        for (const glm::vec3& one : found.positions) {
            CHECK(one.x >= far);
            CHECK(one.y >= far);
            CHECK(glm::dvec3(one).x + glm::dvec3(one).y <= 2.0 * far + (size + 1.0) * step);
            CHECK(one.z == 0.0F);
        }
    }
    // The middle of an edge whose ends' sum is beyond single precision.
    constexpr float largest = std::numeric_limits<float>::max();
    const Refined found =
        refine(std::vector<glm::vec3>{{largest, 0.0F, 0.0F}, {largest, 1.0F, 0.0F}, {largest, 0.0F, 1.0F}},
               std::vector<glm::ivec3>{{0, 1, 2}}, 0.9, most);
    CHECK(longest_of(found) <= 0.9);
}

TEST_CASE("a refined mesh has short edges, the same surface and no gaps", "[mesh]") {
    test::Random random(3);
    for (int round = 0; round < 20; ++round) {
        std::vector<glm::vec3> positions;
        for (int i = 0; i < 4; ++i) {
            const float x = random.between(-2.0F, 2.0F), y = random.between(-2.0F, 2.0F);
            positions.emplace_back(x, y, random.between(-2.0F, 2.0F));
        }
        // Closed: a tetrahedron.
        const std::vector<glm::ivec3> triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}};
        const Refined given{positions, triangles};
        const Refined found = refine(positions, triangles, 0.3, most);
        CHECK(longest_of(found) <= 0.3);
        CHECK(std::equal(positions.begin(), positions.end(), found.positions.begin()));
        for (const auto& [side, count] : sides_of(found)) {
            CHECK(count == 1);
            CHECK(sides_of(found).at({side.second, side.first}) == 1);
            if (round > 0) break;  // all of them once
        }
        double before = 0.0, after = 0.0;
        for (const glm::ivec3& t : triangles) before += glm::length(area(given, t));
        for (const glm::ivec3& t : found.triangles) after += glm::length(area(found, t));
        CHECK(after == Approx(before).epsilon(1e-5));
        REQUIRE(found.ends.size() == found.positions.size() - positions.size());
        for (std::size_t i = 0; i < found.ends.size(); ++i) {
            const auto at = static_cast<int>(positions.size() + i);
            const auto [low, high] = std::pair(found.ends[i].x, found.ends[i].y);
            CHECK((low < at && high < at));
            CHECK(glm::length(place(found, at) - 0.5 * (place(found, low) + place(found, high))) < 1e-6);
        }
    }
}

TEST_CASE("a refined triangle keeps its orientation", "[mesh]") {
    const Refined found = refine(std::vector<glm::vec3>{{0, 0, 0}, {5, 0, 0}, {0, 1, 0}},
                                 std::vector<glm::ivec3>{{0, 1, 2}}, 0.7, most);
    for (const glm::ivec3& t : found.triangles) CHECK(area(found, t).z > 0.0);
}

TEST_CASE("refining leaves edges that are short enough as they are", "[mesh]") {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}};
    const std::vector<glm::ivec3> triangles{{0, 1, 2}, {2, 2, 1}};
    const Refined found = refine(positions, triangles, 1.5, most);
    CHECK(found.positions == positions);
    CHECK(found.triangles == triangles);
    CHECK(refine({}, {}, 1.0, most).positions.empty());
}

TEST_CASE("refining refuses invalid arguments by their names", "[mesh]") {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<glm::ivec3> triangles{{0, 1, 2}};
    CHECK_THROWS_WITH(refine(positions, triangles, 0.0, most), Catch::Contains("longest_edge"));
    CHECK_THROWS_WITH(refine(positions, triangles, std::nan(""), most), Catch::Contains("longest_edge"));
    CHECK_THROWS_WITH(refine(positions, triangles, 1e-3, 5000), Catch::Contains("longest_edge"));
    CHECK_THROWS_WITH(refine(positions, std::vector<glm::ivec3>{{0, 1, 3}}, 1.0, most),
                      Catch::Contains("triangles"));
    CHECK_THROWS_WITH(
        refine(std::vector<glm::vec3>{glm::vec3(std::numeric_limits<float>::infinity())}, {}, 1.0, most),
        Catch::Contains("positions"));
}
