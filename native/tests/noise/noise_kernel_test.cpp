#include "noise_kernel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/noise/noise.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::noise;

namespace {

std::uint32_t bits(float number) {
    return std::bit_cast<std::uint32_t>(number);
}

/// Numbers in cells, on their borders and beside these, of both of the line's lattices, and beyond the
/// farthest.
std::vector<float> numbers(std::size_t count) {
    test::Random random(21);
    const std::array ranges{1.0F, 300.0F, 4194303.0F, 0x1p31F};
    std::vector<float> found;
    while (found.size() < count) {
        const float range = ranges[found.size() % ranges.size()];
        const float any = random.between(-range, range);
        const float half = 0.5F * std::round(2.0F * any);
        for (const float one : {any, 1e-3F * any, half, std::nextafter(half, 1e9F),
                                std::nextafter(half, -1e9F), -1e-10F * any, -0.0F})
            found.push_back(one);
    }
    found.resize(count);
    return found;
}

float one_by_one(const float* place, std::size_t dimensions, std::uint32_t seed) {
    if (dimensions == 1) return value(static_cast<double>(place[0]), seed);
    if (dimensions == 2) return value(glm::dvec2(place[0], place[1]), seed);
    return value(glm::dvec3(place[0], place[1], place[2]), seed);
}

}  // namespace

TEST_CASE("all instruction sets give the bits of single values", "[noise]") {
    for (const NoiseKernel& kernel : noise_kernels()) {
        INFO(kernel.name);
        for (std::size_t dimensions = 1; dimensions <= 3; ++dimensions) {
            const std::vector<float> places = numbers(40 * dimensions * noise_block);
            std::size_t different = 0;
            for (std::size_t begin = 0; begin < places.size(); begin += dimensions * noise_block) {
                const auto seed = static_cast<std::uint32_t>(7919 * begin);
                std::array<float, noise_block> found{};
                kernel.fill[dimensions - 1](&places[begin], seed, found.data());
                for (std::size_t i = 0; i < noise_block; ++i)
                    different +=
                        bits(found[i]) != bits(one_by_one(&places[begin + dimensions * i], dimensions, seed))
                            ? 1
                            : 0;
            }
            CHECK(different == 0);
        }
    }
}

TEST_CASE("noise of many places equals noise of single places, for any count and any distance", "[noise]") {
    test::Random random(22);
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, noise_block - 1, noise_block + 1, 3 * noise_block}) {
        std::vector<glm::vec2> places(count);
        for (glm::vec2& place : places) place = {random.between(-9.0F, 9.0F), random.between(-9.0F, 9.0F)};
        if (count > 2 * noise_block) {
            places[noise_block + 3].x = 0x1p22F;
            places[noise_block + 4].y = -1e30F;
        }
        std::vector<float> found(count);
        values(std::span<const glm::vec2>(places), 5, found);
        for (std::size_t i = 0; i < count; ++i)
            CHECK(bits(found[i]) == bits(value(glm::dvec2(places[i]), 5)));
    }
}
