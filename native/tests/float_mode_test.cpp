// Programs let their threads take the smallest numbers for 0: results are the same all the same.
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "motus/core/ieee_floats.hpp"
#include "motus/lattice/lattice.hpp"
#include "motus/mesh/neighbours.hpp"
#include "motus/mesh/surface_distance.hpp"
#include "motus/sculpt/falloff.hpp"
#include "motus/sculpt/pull.hpp"
#include "sculpt/checks.hpp"
#include "walker/walkers.hpp"

using namespace motus;
using namespace motus::lattice;
using namespace motus::mesh;
using namespace motus::sculpt;
using namespace motus::sculpt::checks;

namespace {

/// The mode that some host programs set: numbers too small for a full mantissa are written and read as 0.
class Flushing {
  public:
    Flushing() { FloatMode::write(was_ | FloatMode::flushing); }
    ~Flushing() { FloatMode::write(was_); }
    Flushing(const Flushing&) = delete;
    Flushing& operator=(const Flushing&) = delete;
    Flushing(Flushing&&) = delete;
    Flushing& operator=(Flushing&&) = delete;

  private:
    FloatMode::Bits was_ = FloatMode::read();
};

template <class Work>
auto flushed(const Work& work) {
    const Flushing mode;
    return work();
}

std::vector<std::uint32_t> bits_of(std::span<const glm::vec3> points) {
    std::vector<std::uint32_t> bits;
    for (const glm::vec3& p : points)
        for (int axis = 0; axis < 3; ++axis) bits.push_back(std::bit_cast<std::uint32_t>(p[axis]));
    return bits;
}

std::vector<std::uint32_t> bits_of(std::span<const float> values) {
    std::vector<std::uint32_t> bits;
    for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
    return bits;
}

constexpr float tiny_sizes[] = {1e-44f, 3e-39f, 1e-30f, 4e-23f, 1e-20f, 2e-19f};
const std::vector<float> hill{0.0f, 0.3f, -0.2f, 1.0f, 0.5f};
constexpr Falloff all_falloffs[] = {Falloff::classic,  Falloff::smooth,   Falloff::sphere,
                                    Falloff::root,     Falloff::linear,   Falloff::sharp,
                                    Falloff::constant, Falloff::gaussian, Falloff::curve};

}  // namespace

TEST_CASE("forces of the smallest radii do not depend on the thread's float mode", "[float_mode]") {
    for (const Falloff falloff : all_falloffs) {
        for (const float radius : tiny_sizes) {
            std::vector<float> distances;
            for (int i = 0; i < 16; ++i) distances.push_back(radius * 0.08f * static_cast<float>(i));
            const auto found = [&] {
                std::vector<float> result(distances.size());
                forces({falloff, 1.0f, hill}, radius, distances, result);
                return bits_of(std::span<const float>(result));
            };
            INFO("falloff " << static_cast<int>(falloff) << ", radius " << radius);
            CHECK(flushed(found) == found());
        }
    }
}

TEST_CASE("pulls of the smallest sizes do not depend on the thread's float mode", "[float_mode]") {
    const std::vector<glm::vec3> large = cloud(200000);  // for several threads
    for (const float size : tiny_sizes) {
        std::vector<glm::vec3> points = large;
        for (glm::vec3& p : points) p *= size;
        Dab dab = sample_dab();
        dab.root *= size;
        dab.displacement *= size;
        dab.radius *= size;
        for (const Falloff falloff : {Falloff::gaussian, Falloff::smooth, Falloff::sphere}) {
            dab.profile.falloff = falloff;
            const auto whole = [&] {
                std::vector<glm::vec3> out(points.size());
                pull(points, dab, {}, out);
                return bits_of(out);
            };
            INFO("size " << size << ", falloff " << static_cast<int>(falloff));
            CHECK(flushed(whole) == whole());
        }
        const std::vector<Reach> reaches(images_of(dab).size(), Reach{{0, 1, 2}, {0.0f, 0.4f * size, size}});
        const auto along = [&] {
            std::vector<glm::vec3> out(points.size());
            pull_along(points, dab, reaches, {}, out);
            return bits_of(out);
        };
        CHECK(flushed(along) == along());
    }
}

TEST_CASE("surfaces and lattices of the smallest sizes do not depend on the thread's float mode",
          "[float_mode]") {
    for (const float size : tiny_sizes) {
        std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
        for (glm::vec3& p : points) p *= size;
        const std::vector<glm::ivec3> triangles{{0, 1, 2}, {1, 3, 2}};
        const auto neighbours = Neighbours::of_triangles(points.size(), triangles);
        const float radius = 1.2f * size;  // here: in the other mode the product is 0
        const auto reach = [&] { return surface_reach(points, neighbours, 0, radius); };
        const Reach usual = reach(), other = flushed(reach);
        INFO("size " << size);
        CHECK(other.vertices == usual.vertices);
        CHECK(bits_of(std::span(other.distances)) == bits_of(std::span(usual.distances)));

        const Lattice lattice;
        const std::vector<glm::vec3> moves(point_count(lattice), glm::vec3(0.3f * size));
        const auto deformed = [&] {
            std::vector<glm::vec3> out(points.size());
            deform(lattice, moves, {}, points, out);
            return bits_of(out);
        };
        CHECK(flushed(deformed) == deformed());
    }
}

TEST_CASE("a foot that has hardly begun its step does not depend on the thread's float mode",
          "[float_mode]") {
    const auto sets_off = [](double time) {
        return walker::moved({0.0, -0.9, 0.0}) * walker::there(time + 1.0);
    };
    const walker::Way way = walker::way_along(4.0, sets_off, walker::Gait::tripod);
    const auto moved = [&] { return walker::Walker(way, {}).foot(0, 1e-105).position.y; };
    CHECK(moved() > 0.0);
    CHECK(std::bit_cast<std::uint64_t>(flushed(moved)) == std::bit_cast<std::uint64_t>(moved()));
}

TEST_CASE("the thread's float mode is as it was afterwards", "[float_mode]") {
    const Flushing mode;
    const FloatMode::Bits before = FloatMode::read() & ~FloatMode::flags;
    std::vector<glm::vec3> points = cloud(100);
    pull(points, sample_dab(), {}, points);
    CHECK((FloatMode::read() & ~FloatMode::flags) == before);
    Dab wrong = sample_dab();
    wrong.radius = -1.0f;
    CHECK_THROWS_AS(pull(points, wrong, {}, points), std::invalid_argument);
    CHECK((FloatMode::read() & ~FloatMode::flags) == before);
}
