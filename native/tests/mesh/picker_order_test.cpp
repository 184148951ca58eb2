#include "picker_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <utility>

#include "picker_meshes.hpp"

using namespace motus;
using namespace motus::mesh;
using namespace motus::mesh::checks;

TEST_CASE("cells that follow each other on the Hilbert curve share a side", "[picker]") {
    constexpr std::uint32_t side = 32;
    std::vector<std::pair<std::uint64_t, glm::ivec3>> cells;
    for (std::uint32_t z = 0; z < side; ++z)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x)
                cells.emplace_back(hilbert_place(x, y, z), glm::ivec3(x, y, z));
    std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        wrong += cells[i].first == i ? 0 : 1;
        if (i == 0) continue;
        const glm::ivec3 step = glm::abs(cells[i].second - cells[i - 1].second);
        wrong += step.x + step.y + step.z == 1 ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(hilbert_place((1u << hilbert_bits) - 1, 0, (1u << hilbert_bits) - 1) >> 3 * hilbert_bits == 0);
}

TEST_CASE("the sort of keys is stable", "[picker]") {
    Dice dice(1);
    for (const std::size_t count : {0, 1, 5, 1000, 50000}) {
        for (const int bits : {1, 7, 10, 17, 31}) {
            Array<Keyed> items(count);
            for (std::size_t i = 0; i < count; ++i)
                items[i] = (static_cast<Keyed>(dice.index(1u << 31)) & ((Keyed{1} << bits) - 1)) << 32 | i;
            std::vector<Keyed> expected(items.begin(), items.end());
            std::sort(expected.begin(), expected.end());
            sort_by_key(items, bits, 3);
            CAPTURE(count, bits);
            CHECK(std::equal(items.begin(), items.end(), expected.begin(), expected.end()));
        }
    }
}

TEST_CASE("the order along the curve has every vertex once, whatever the threads", "[picker]") {
    std::vector<Mesh> meshes = troubling_meshes();
    meshes.push_back(sphere(150, 200));
    for (const Mesh& mesh : meshes) {
        INFO(mesh.name);
        const Array<std::uint32_t> order = hilbert_order(mesh.positions, 1);
        CHECK(order == hilbert_order(mesh.positions, 6));
        std::vector<std::uint32_t> sorted(order.begin(), order.end()), all(mesh.positions.size());
        std::sort(sorted.begin(), sorted.end());
        std::iota(all.begin(), all.end(), 0u);
        CHECK(sorted == all);
    }
}

TEST_CASE("the order depends on more than the coarse cells", "[picker]") {
    // Two vertices far apart leave all others one coarse cell, in which they lie along the curve all the
    // same.
    Dice dice(2);
    std::vector<glm::vec3> points{glm::vec3(-1e4f), glm::vec3(1e4f)};
    for (int i = 0; i < 4000; ++i) points.push_back(dice.in_cube(4.0f));
    const Array<std::uint32_t> order = hilbert_order(points, 2);
    double along = 0.0, as_given = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (std::min(order[i], order[i - 1]) >= 2)
            along += glm::distance(points[order[i]], points[order[i - 1]]);
        if (i > 2) as_given += glm::distance(points[i], points[i - 1]);
    }
    CHECK(along < 0.2 * as_given);
}
