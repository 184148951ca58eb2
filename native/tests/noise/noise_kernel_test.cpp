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
#include <limits>
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

/// Numbers in cells, on their borders and beside these, of both of the line's lattices, up to `largest`.
std::vector<float> numbers(std::size_t count, float largest) {
    test::Random random(21);
    const std::array ranges{1.0F, 300.0F, 4194303.0F, largest};
    std::vector<float> found;
    while (found.size() < count) {
        const float range = ranges[found.size() % ranges.size()];
        const float any = random.between(-range, range);
        const float half = 0.5F * std::round(2.0F * any);
        for (const float one : {any, 1e-3F * any, half, std::nextafter(half, 1e9F),
                                std::nextafter(half, -1e9F), -1e-10F * any, -0.0F})
            found.push_back(std::clamp(one, -largest, largest));
    }
    found.resize(count);
    return found;
}

float one_by_one(const float* place, std::size_t dimensions, std::uint32_t seed) {
    if (dimensions == 1) return value(static_cast<double>(place[0]), seed);
    if (dimensions == 2) return value(glm::dvec2(place[0], place[1]), seed);
    return value(glm::dvec3(place[0], place[1], place[2]), seed);
}

/// Compares noise at many places with that at each of them.
template <int dimensions>
void check_many(const std::vector<float>& numbers) {
    using Place = glm::vec<dimensions, float>;
    std::vector<Place> places(numbers.size() / dimensions);
    for (std::size_t i = 0; i < places.size(); ++i)
        for (int axis = 0; axis < dimensions; ++axis)
            places[i][axis] = numbers[dimensions * i + static_cast<std::size_t>(axis)];
    std::vector<float> found(places.size());
    values(std::span<const Place>(places), 6, found);
    std::size_t different = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
        different += bits(found[i]) != bits(one_by_one(&numbers[dimensions * i], dimensions, 6)) ? 1 : 0;
    CHECK(different == 0);
}

}  // namespace

TEST_CASE("all instruction sets give the bits of single values", "[noise]") {
    for (const NoiseKernel& kernel : noise_kernels()) {
        INFO(kernel.name);
        for (std::size_t dimensions = 1; dimensions <= 3; ++dimensions) {
            const std::vector<float> places = numbers(40 * dimensions * noise_block, near);
            std::size_t different = 0;
            for (std::size_t begin = 0; begin < places.size(); begin += dimensions * noise_block) {
                const auto seed = static_cast<std::uint32_t>(7919 * begin);
                std::array<float, noise_block> found{};
                CHECK(kernel.fill[dimensions - 1](&places[begin], seed, found.data()));
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

TEST_CASE("all instruction sets tell of each number that is not near", "[noise]") {
    constexpr float endless = std::numeric_limits<float>::infinity(),
                    nothing = std::numeric_limits<float>::quiet_NaN();
    for (const NoiseKernel& kernel : noise_kernels()) {
        INFO(kernel.name);
        for (std::size_t dimensions = 1; dimensions <= 3; ++dimensions) {
            std::vector<float> places(dimensions * noise_block, -near);
            std::array<float, noise_block> found{};
            CHECK(kernel.fill[dimensions - 1](places.data(), 4, found.data()));
            for (const float far :
                 {std::nextafter(near, 1e9F), -0x1p31F, endless, -endless, nothing, -nothing})
                for (float& place : places) {
                    place = far;
                    CHECK_FALSE(kernel.fill[dimensions - 1](places.data(), 4, found.data()));
                    place = near;
                }
        }
    }
}

TEST_CASE("noise of many places equals noise of single places that are far or no places at all", "[noise]") {
    std::vector<float> all = numbers(60 * noise_block, 0x1p31F);
    test::Random random(23);
    for (const float extreme : {std::numeric_limits<float>::infinity(),
                                -std::numeric_limits<float>::infinity(), std::nanf(""), 3e38F, -0x1p30F})
        for (int i = 0; i < 30; ++i) all[random.below(all.size())] = extreme;
    check_many<2>(all);
    check_many<3>(all);
    const std::span<const float> line(all);
    std::vector<float> found(all.size());
    values(line, 6, found);
    std::size_t different = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        different += bits(found[i]) != bits(value(static_cast<double>(all[i]), 6)) ? 1 : 0;
    CHECK(different == 0);
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
