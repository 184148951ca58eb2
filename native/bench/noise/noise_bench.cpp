// Noise at many places by each instruction set, against GLM's own noise, place by place.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <glm/gtc/noise.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <type_traits>
#include <vector>

#include "motus/noise/noise.hpp"
#include "random.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;

namespace {

constexpr std::size_t count = 1 << 17;

/// Nanoseconds a place.
template <class Work>
double measure(Work&& work) {
    return bench::nanoseconds(work, 15) / static_cast<double>(count);
}

template <class Place>
void compare(const bench::Table& table, const char* what, const std::vector<Place>& places) {
    std::vector<float> found(count);
    const double many = measure([&] {
        noise::values(std::span<const Place>(places), 3, found);
        bench::keep(found);
    });
    const double single = measure([&] {
        for (std::size_t i = 0; i < count; ++i) {
            if constexpr (std::is_same_v<Place, float>)
                found[i] = noise::value(static_cast<double>(places[i]), 3);
            else
                found[i] = noise::value(glm::vec<Place::length(), double>(places[i]), 3);
        }
        bench::keep(found);
    });
    bench::Cell naive, faster;
    if constexpr (!std::is_same_v<Place, float>) {
        naive = measure([&] {
            for (std::size_t i = 0; i < count; ++i) found[i] = glm::perlin(places[i]);
            bench::keep(found);
        });
        faster = *naive / many;
    }
    table.row(what, {many, single, naive, faster});
}

}  // namespace

int main() {
    test::Random random(1);
    std::vector<float> one(count);
    std::vector<glm::vec2> two(count);
    std::vector<glm::vec3> three(count);
    for (std::size_t i = 0; i < count; ++i) {
        three[i] = random.in_cube(100.0F);
        two[i] = three[i];
        one[i] = three[i].x;
    }
    const bench::Table table(
        "Noise at " + std::to_string(count) + " places; each, one thread, best of 15",
        {{"all", "ns"}, {"one by one", "ns"}, {"glm::perlin", "ns"}, {"faster by", "x", 1}}, 8);
    compare(table, "1D", one);
    compare(table, "2D", two);
    compare(table, "3D", three);
    return 0;
}
