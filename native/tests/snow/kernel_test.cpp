#include "kernel.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "motus/core/numeric.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

/// Any numbers at all where the loops allow it.
struct Sample {
    explicit Sample(test::Random& random) {
        const auto any = [&] { return random.between(-2.0F, 2.0F); };
        const auto number = [&](Cubic& c) { c = {any(), any(), any(), any()}; };
        for (double& age : ages) age = random.between(3.0, 3.1);
        for (std::uint32_t& low : lows) low = static_cast<std::uint32_t>(random.bits());
        for (Node& node : nodes) {
            for (double& one : node.integral) one = random.between(-2.0, 2.0);
            for (double& one : node.slope) one = random.between(-2.0, 2.0);
            node.angle = {random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        }
        for (OwnNode& node : own_nodes) {
            for (std::int32_t& one : node.integral)
                one = static_cast<std::int32_t>(random.below(1U << 30U)) - (1 << 29);
            for (float& one : node.slope) one = any();
        }
        for (OwnAngles& angles : own_angles) angles = {{any(), any()}, {any(), any()}};
        places = {0.0F, 0.3F, 0.3F};
        scales = {1.0F / 0.3F, 1e30F, 1.0F / 0.7F};
        changes.resize(places.size());
        for (auto& change : changes) change = {any(), any(), any(), any()};

        kind.key = {static_cast<std::uint32_t>(random.bits()), static_cast<std::uint32_t>(random.bits())};
        kind.shape = static_cast<Shape>(random.below(7));
        for (Facet& facet : facets) {
            for (float& one : facet.corner) one = any();
            for (float& one : facet.edge1) one = any();
            for (float& one : facet.edge2) one = any();
            facet.normal = {0.6F, 0.0F, -0.8F};
            facet.kept = random.between(0.0F, 1.0F);
            facet.other = static_cast<std::uint32_t>(random.below(facets.size()));
        }
        kind.facets = facets;
        kind.frustum = {random.between(0.0F, 2.0F), random.between(0.0F, 2.0F), 7.0F,
                        random.chance(0.5) ? 0.0F : random.between(0.0F, 1.0F)};
        kind.turns_out = random.chance(0.5);
        kind.cone_depth = random.between(0.0F, 2.0F);
        kind.cone_turn = random.between(0.0F, 0.5F);
        kind.speed = any();
        kind.speed_range = 1.0F;
        kind.size_range = 0.1F;
        kind.random_color = random.chance(0.5);
        kind.places = places;
        kind.scales = scales;
        kind.changes = changes;
        kind.snow = random.chance(0.7);
        kind.snow_offsets = random.chance(0.5);
        kind.offset_count = static_cast<float>(own_nodes.size() - 2);
        kind.tumble = random.chance(0.5) ? 1.0F : 0.0F;

        kind.is_turbulent = random.chance(0.5);
        for (Wave& wave : kind.waves) {
            wave.vector = {any(), any(), any()};
            wave.velocity = {any(), any(), any()};
            wave.rate = random.chance(0.3) ? 0.0F : any();
        }
        run.ages = ages.data();
        run.lows = lows.data();
        run.high = 77;
        run.count = 1 + random.below(block_size);
        run.start = 3.0;
        run.step = 0.125;
        run.glide.is_moving = random.chance(0.5);
        for (Rows* rows : {&run.glide.stretch, &run.glide.stretch_change, &run.glide.rotation})
            for (float& one : *rows) one = any();
        run.glide.axis = {0.6F, 0.0F, 0.8F};
        run.glide.turn = any();
        run.glide.location = {any(), any(), any()};
        run.glide.location_change = {any(), any(), any()};
        run.glide.w_start = any();
        run.glide.w_change = any();
        number(run.way);
        number(run.way_rate);
        for (Cubic& c : run.drift) number(c);
        for (Cubic& c : run.drift_velocity) number(c);
        for (float& phase : run.phases) phase = any();
        for (float& change : run.phase_changes) change = any();
        run.node = nodes.data();
        run.own_origin = own_nodes.data();
        run.own_node = own_nodes.data() + 1;
        run.own_angles = own_angles.data();
        run.unit = 0x1p-28F;
    }

    [[nodiscard]] std::vector<float> filled(const Kernel& kernel) {
        std::vector<float> out(15 * block_size);
        Scratch scratch;
        std::vector<std::int64_t> ids(block_size);
        const auto rows = [&](std::size_t first) { return out.data() + first * block_size; };
        run.position = rows(0);
        run.velocity = rows(3);
        run.size = rows(6);
        run.color = rows(7);
        run.rotation = rows(11);
        run.id = ids.data();
        kernel.fill(kind, run, scratch);
        for (const std::int64_t id : ids) out.push_back(static_cast<float>(id % 1009));
        return out;
    }

    std::vector<double> ages = std::vector<double>(block_size);
    std::vector<std::uint32_t> lows = std::vector<std::uint32_t>(block_size);
    std::vector<Facet> facets = std::vector<Facet>(7);
    std::vector<Node> nodes = std::vector<Node>(2);
    std::vector<OwnNode> own_nodes = std::vector<OwnNode>(40);
    std::vector<OwnAngles> own_angles = std::vector<OwnAngles>(40);
    std::vector<float> places, scales;
    std::vector<std::array<float, 4>> changes;
    Kind kind;
    Run run;
};

[[nodiscard]] bool are_same(std::span<const float> a, std::span<const float> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

}  // namespace

TEST_CASE("all instruction sets give the same bits", "[snow]") {
    test::Random random(3);
    for (int round = 0; round < 400; ++round) {
        Sample sample(random);
        const std::vector<float> wanted = sample.filled(kernels().front());
        for (const Kernel& kernel : kernels()) {
            CAPTURE(round, kernel.name);
            CHECK(are_same(sample.filled(kernel), wanted));
            std::vector<float> lives(block_size);
            kernel.lives(sample.kind.key, 3, sample.lows.data(), sample.run.count, lives.data());
            for (std::size_t i = 0; i < sample.run.count; ++i) {
                const Words words =
                    philox({sample.lows[i], 3, static_cast<std::uint32_t>(Stream::life), 0}, sample.kind.key);
                CHECK(lives[i] == 2.0F * fraction(words.a) - 1.0F);
            }
            std::vector<double> ages(block_size);
            kernel.ages(1000.0, 0.25, 31.0, 12345678901U, block_size, ages.data());
            for (std::size_t i = 0; i < block_size; ++i)
                CHECK(ages[i] == 1000.0 - (0.25 + static_cast<double>(12345678902U + i) / 31.0));
        }
    }
}

TEST_CASE("angles of any size give numbers, the same in all instruction sets", "[snow]") {
    test::Random random(4);
    for (int round = 0; round < 100; ++round) {
        Sample sample(random);
        const float size = std::pow(10.0F, random.between(6.0F, 20.0F));
        for (Wave& wave : sample.kind.waves) {
            for (float& one : wave.vector) one *= size;
            wave.rate *= size;
        }
        for (Node& node : sample.nodes)
            for (double& angle : node.angle) angle *= static_cast<double>(size);
        const std::vector<float> wanted = sample.filled(kernels().front());
        CHECK(are_finite(std::span<const float>(wanted)));
        for (const Kernel& kernel : kernels()) {
            CAPTURE(round, kernel.name);
            CHECK(are_same(sample.filled(kernel), wanted));
        }
    }
}

TEST_CASE("a run fills its own rows alone", "[snow]") {
    test::Random random(4);
    Sample sample(random);
    sample.run.count = 5;
    const std::vector<float> found = sample.filled(kernels().back());
    for (const std::size_t width : {3U, 1U, 4U}) {
        const std::size_t first = width == 3 ? 0 : width == 1 ? 6 : 7;
        for (std::size_t i = 5 * width; i < width * block_size; ++i)
            CHECK(found[first * block_size + i] == 0.0F);
    }
}
