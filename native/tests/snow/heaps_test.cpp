#include "heaps.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "heaps_kernel.hpp"
#include "random.hpp"
#include "sheets.hpp"

using namespace motus;
using namespace motus::snow;

TEST_CASE("all instruction sets settle depths with the same bits", "[snow]") {
    test::Random random(31);
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
    add_sheet(1.0F, 0.0F, 0.3F, 24, positions, triangles);
    std::map<std::pair<int, int>, int> numbers;
    std::vector<glm::ivec2> edges;
    std::vector<glm::ivec3> sides;
    for (const glm::ivec3& t : triangles) {
        glm::ivec3& of_triangle = sides.emplace_back();
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax({t[i], t[(i + 1) % 3]});
            const auto [at, is_new] = numbers.try_emplace({low, high}, static_cast<int>(edges.size()));
            if (is_new) edges.emplace_back(low, high);
            of_triangle[i] = at->second;
        }
    }
    // Snow ends along a line that crosses the sheet.
    std::vector<float> ends(edges.size(), -1.0F);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const float from = positions[static_cast<std::size_t>(edges[i].x)].x - 0.21F;
        const float to = positions[static_cast<std::size_t>(edges[i].y)].x - 0.21F;
        if ((from < 0.0F) != (to < 0.0F)) ends[i] = from / (from - to);
    }
    std::vector<std::uint32_t> ranks(positions.size());
    std::iota(ranks.begin(), ranks.end(), 0U);
    const Heaps heaps({positions, ranks, triangles, edges, sides, ends});
    std::vector<float> depths(positions.size() + 1);
    for (std::size_t i = 0; i < positions.size(); ++i) depths[i] = random.between(0.0F, 0.6F);
    for (const float steepest : {0.3F, 1.2F}) {
        const auto settled = [&](const HeapKernel& kernel) {
            std::vector<float> changed = depths;
            kernel.settle(heaps.plan(), changed, steepest);
            return changed;
        };
        const std::vector<float> expected = settled(heap_kernels().front());
        CHECK(expected != depths);
        for (const HeapKernel& kernel : heap_kernels()) {
            INFO(kernel.name);
            CHECK(settled(kernel) == expected);
        }
    }
}
