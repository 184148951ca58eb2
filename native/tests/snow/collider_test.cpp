#include "motus/snow/collider.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "flakes.hpp"
#include "kernel.hpp"
#include "landings.hpp"
#include "sheets.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

/// Of all kinds, over a slanted sheet and the ground.
[[nodiscard]] SnowSettings rich_over(Collision collision) {
    SnowSettings s = rich(4000.0);
    s.ground = -2.0;
    s.collider = sheet(1.0F, 1.0F, 0.3F, 8);
    s.collision = collision;
    s.melt_time = 0.4;
    s.rest_time = 0.7;
    return s;
}

}  // namespace

TEST_CASE("flakes land on a plane when their closed form says", "[snow]") {
    SnowSettings settings = falling(2000.0);
    settings.gravity = true;
    // z = 3 - 1.5 t - 9.81 t^2 / 2.
    const auto fall_to = [](double z) {
        return (-1.5 + std::sqrt(1.5 * 1.5 + 2.0 * 9.81 * (3.0 - z))) / 9.81;
    };
    for (const bool is_mesh : {false, true}) {
        settings.ground = is_mesh ? std::nullopt : std::optional(0.25);
        settings.collider = is_mesh ? sheet(2.5F, 0.25F, 0.2F, 7) : nullptr;
        const Snow snow(settings);
        const std::vector<Touchdown> found = snow.touchdowns(4.0);
        CHECK(found.size() == Approx(2000.0 * (4.0 - fall_to(0.25))).epsilon(0.05));
        CHECK(std::ranges::is_sorted(found, {}, &Touchdown::time));
        for (const Touchdown& one : found) {
            const double height = is_mesh ? 0.25 + 0.2 * static_cast<double>(one.point.x) : 0.25;
            const double birth = static_cast<double>(one.id + 1) / 2000.0;
            CHECK(std::abs(static_cast<double>(one.point.z) - height) < 1e-6);
            CHECK(std::abs(one.time - birth - fall_to(height)) < 1e-6);
            CHECK((one.triangle == -1) != is_mesh);
        }
    }
}

TEST_CASE("a flake is where it landed until it is gone", "[snow]") {
    SnowSettings settings = rich_over(Collision::stay);
    settings.rest_time = std::numeric_limits<double>::infinity();
    const std::vector<Touchdown> downs = Snow(settings).touchdowns(4.0);
    REQUIRE(downs.size() > 2000);
    CHECK(std::ranges::any_of(downs, [](const Touchdown& one) { return one.triangle >= 0; }));
    CHECK(std::ranges::any_of(downs, [](const Touchdown& one) { return one.triangle < 0; }));
    SnowSettings free = settings;
    free.ground.reset();
    free.collider.reset();
    const auto row_of = [](const Flakes& flakes, std::uint64_t id) {
        return static_cast<std::size_t>(std::ranges::lower_bound(flakes.id, static_cast<std::int64_t>(id)) -
                                        flakes.id.begin());
    };
    const Snow snow(settings), air(free);
    // Nothing else about the flakes has changed.
    for (const double time : {0.9, 2.2, 4.0}) {
        const Flakes now = flakes_at(snow, time), flying = flakes_at(air, time);
        CHECK(now.id == flying.id);
        CHECK(same_bits(now.age, flying.age));
        CHECK(same_bits(now.size, flying.size));
        std::vector<bool> down(now.id.size());
        for (const Touchdown& one : downs) {
            const std::size_t row = row_of(now, one.id);
            if (one.time > time || row == now.id.size() || now.id[row] != static_cast<std::int64_t>(one.id))
                continue;
            down[row] = true;
            CHECK(now.position[row] == one.point);
            CHECK(now.velocity[row] == glm::vec3(0.0F));
        }
        for (std::size_t i = 0; i < down.size(); ++i)
            if (!down[i]) CHECK(now.position[i] == flying.position[i]);
    }
    // It comes there without a jump.
    for (std::size_t i = 0; i < downs.size(); i += 300) {
        const Flakes flying = flakes_at(air, downs[i].time);
        const std::size_t row = row_of(flying, downs[i].id);
        REQUIRE(row < flying.id.size());
        CHECK(glm::length(flying.position[row] - downs[i].point) < 1e-5F);
    }
}

TEST_CASE("landed flakes are the same whatever was asked for before", "[snow]") {
    for (const Collision collision : {Collision::stay, Collision::slide, Collision::melt}) {
        const SnowSettings settings = rich_over(collision);
        const Flakes wanted = flakes_at(Snow(settings), 2.9);
        CHECK(wanted.id.size() > 1000);
        const Snow other(settings);
        for (const double time : {4.1, 0.6, 2.0, 3.3}) static_cast<void>(flakes_at(other, time, 2));
        CHECK(are_same(flakes_at(other, 2.9), wanted));
        for (const std::size_t threads : {2, 3, 8})
            CHECK(are_same(flakes_at(Snow(settings), 2.9, threads), wanted));
    }
}

TEST_CASE("landings are found block by block, and the flakes known then are those that there are", "[snow]") {
    for (const Collision collision : {Collision::stay, Collision::melt}) {
        SnowSettings settings = falling(1000.0);
        settings.ground = 0.0;
        settings.collision = collision;
        settings.melt_time = 5.0;
        settings.random_lifetime = true;
        const Snow whole(settings), snow(settings);
        const double time = 5.5;
        const Flakes all = flakes_at(whole, time);
        CHECK(snow.known(time).count() == 0);
        const std::size_t blocks = snow.find_landings(time, 0);
        REQUIRE(blocks > 15);
        CHECK(snow.find_landings(time, 4, 2) == blocks - 4);
        const Living living = snow.known(time);
        Flakes some(living.count());
        // What is found in between is no part of it.
        CHECK(snow.find_landings(time, 3) == blocks - 7);
        snow.evaluate(living, some.fields());
        CHECK(some.id.size() > 500);
        for (std::size_t i = 0; i < some.id.size(); ++i) {
            CHECK(some.id[i] == all.id[i]);
            CHECK(some.position[i] == all.position[i]);
            CHECK(some.size[i] == all.size[i]);
        }
        CHECK(snow.find_landings(time, 1000) == 0);
        CHECK(snow.known(time).count() == all.id.size());
        CHECK(are_same(flakes_at(snow, time), all));
    }
    CHECK(Snow(falling(100.0)).find_landings(3.0, 1) == 0);
    CHECK(Snow(falling(100.0)).known(3.0).count() == 300);
}

TEST_CASE("all instruction sets find the same landings", "[snow]") {
    for (const bool has_offsets : {false, true}) {
        SnowSettings settings = rich_over(Collision::slide);
        settings.snow_offsets = has_offsets;
        FlightModel model(settings);
        const Landings landings(model, settings);
        for (const std::uint64_t block : {0U, 9U, 30U}) {
            model.kernel = &kernels().front();
            const auto wanted = landings.find(block);
            for (const Kernel& kernel : kernels()) {
                CAPTURE(kernel.name);
                model.kernel = &kernel;
                const auto found = landings.find(block);
                CHECK(found->times == wanted->times);
                CHECK(found->slides.size() == wanted->slides.size());
                for (std::size_t i = 0; i < block_size; ++i) {
                    CHECK(found->landings.at(i).point == wanted->landings.at(i).point);
                    CHECK(found->landings.at(i).rotation == wanted->landings.at(i).rotation);
                    CHECK(found->landings.at(i).triangle == wanted->landings.at(i).triangle);
                }
            }
        }
    }
}

TEST_CASE("flakes rest for their time, and melt", "[snow]") {
    SnowSettings settings = falling(500.0);
    settings.ground = 0.0;  // after 2 s
    settings.rest_time = 1.0;
    CHECK(flakes_at(Snow(settings), 20.0).id.size() == Approx(1500).margin(1));
    settings.rest_time = 100.0;
    CHECK(flakes_at(Snow(settings), 20.0).id.size() == 3000);
    settings.collision = Collision::melt;
    settings.melt_time = 2.0;
    settings.random_size = true;
    const Flakes now = flakes_at(Snow(settings), 20.0);
    CHECK(now.id.size() == Approx(2000).margin(1));
    settings.ground.reset();
    const Flakes whole = flakes_at(Snow(settings), 20.0);
    for (std::size_t i = 0, j = 0; i < now.id.size(); ++i) {
        while (whole.id[j] != now.id[i]) ++j;
        const float left = std::min(1.0F, 1.0F - 0.5F * (now.age[i] - 2.0F));
        CHECK(now.size[i] == Approx(left * whole.size[j]).margin(1e-5));
    }
    settings.ground = 0.0;
    settings.melt_time = 0.0;
    CHECK(flakes_at(Snow(settings), 20.0).id.size() == Approx(1000).margin(1));
}

TEST_CASE("flakes slide down to the edge as friction lets them", "[snow]") {
    SnowSettings settings = falling(200.0);
    settings.start_speed = -3.0;
    settings.lifetime = 20.0;
    settings.collision = Collision::slide;
    constexpr double slope = 0.5;
    const glm::dvec3 down = glm::normalize(glm::dvec3(-1.0, 0.0, -slope));
    const double steep = 9.81 * slope / std::sqrt(1.0 + slope * slope), weight = steep / slope;
    for (const double friction : {0.2, 0.49, 2.0}) {
        for (const int cells : {1, 9}) {
            settings.friction = friction;
            settings.collider = sheet(2.0F, 0.0F, static_cast<float>(slope), cells);
            const Snow snow(settings);
            const std::vector<Touchdown> downs = snow.touchdowns(1.5);
            REQUIRE(downs.size() > 20);
            const double time = 1.9;
            const Flakes now = flakes_at(snow, time);
            for (const Touchdown& one : downs) {
                const double since = time - one.time, acceleration = steep - friction * weight;
                const double first = -3.0 * down.z;
                double stop = acceleration < 0.0 ? first / -acceleration : 1e9;
                const double edge = (static_cast<double>(one.point.x) + 2.0) / -down.x;
                const double speed = std::sqrt(std::max(0.0, first * first + 2.0 * acceleration * edge));
                if (first * first + 2.0 * acceleration * edge > 0.0)
                    stop = std::min(stop, 2.0 * edge / (first + speed));
                const double t = std::min(since, stop);
                const glm::dvec3 wanted =
                    glm::dvec3(one.point) + down * (t * (first + 0.5 * acceleration * t));
                CAPTURE(friction, cells, since, stop);
                CHECK(glm::length(glm::dvec3(now.position.at(one.id)) - wanted) < 1e-4);
                if (std::abs(since - stop) < 1e-3) continue;
                const glm::dvec3 velocity =
                    since < stop ? down * (first + acceleration * t) : glm::dvec3(0.0);
                CHECK(glm::length(glm::dvec3(now.velocity.at(one.id)) - velocity) < 1e-3);
            }
        }
    }
}

TEST_CASE("what leads down to one edge from both sides ends there", "[snow]") {
    // A gutter along Y.
    const Points positions{{-1, -1, 1}, {-1, 1, 1}, {0, -1, 0}, {0, 1, 0}, {1, -1, 1}, {1, 1, 1}};
    const Triangles triangles{{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}};
    const Collider collider(positions, triangles);
    for (const double friction : {0.0, 0.5}) {
        std::vector<Slide> slides;
        const Collider::Rest rest =
            collider.slide({3, false, {0.8, 0.3, 0.8}}, {}, {0.0, 0.0, -9.81}, friction, slides);
        CHECK(glm::length(rest.place.point - glm::dvec3(0.0, 0.3, 0.0)) < 1e-9);
        CHECK_FALSE(rest.over.has_value());
        REQUIRE(slides.size() >= 2);
        CHECK(slides.back().velocity(slides.back().start + 1.0) == glm::dvec3(0.0));
        for (std::size_t i = 1; i < slides.size(); ++i)
            CHECK(glm::length(slides[i - 1].position(slides[i].start) - slides[i].from) < 1e-9);
    }
    std::vector<Slide> slides;
    const Collider::Rest still =
        collider.slide({3, false, {0.8, 0.3, 0.8}}, {}, {0.0, 0.0, -9.81}, 1.01, slides);
    CHECK(still.place.point == glm::dvec3(0.8, 0.3, 0.8));
}

TEST_CASE("nothing passes a closed surface, and nothing lands on what it leaves", "[snow]") {
    // A box around all of it.
    Points positions;
    for (int i = 0; i < 8; ++i)
        positions.emplace_back((i & 1) != 0 ? 3.0F : -3.0F, (i & 2) != 0 ? 3.0F : -3.0F,
                               (i & 4) != 0 ? 3.0F : -3.0F);
    const Triangles triangles{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    SnowSettings settings = rich(2000.0);
    settings.emitter_times.clear();
    settings.emitter_matrices.clear();
    settings.start_speed = 4.0;
    settings.lifetime = 20.0;
    settings.collider = std::make_shared<const Collider>(positions, triangles);
    const Snow snow(settings);
    for (const double time : {1.0, 3.0, 9.0})
        for (const glm::vec3& at : flakes_at(snow, time).position)
            CHECK(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < 3.005F);  // between two looks

    SnowSettings leaving;
    leaving.rate = 5000.0;
    leaving.shape = Shape::surface;
    leaving.surface_positions = positions;
    leaving.surface_triangles = triangles;
    leaving.collider = settings.collider;
    leaving.start_speed = 1.0;
    leaving.lifetime = 2.0;
    CHECK(Snow(leaving).touchdowns(3.0).empty());
}

TEST_CASE("bad colliders are refused with a sentence", "[snow]") {
    const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    CHECK_THROWS_WITH(Collider(points, Triangles{{0, 1, 3}}), Catch::StartsWith("collider_triangles"));
    CHECK_THROWS_WITH(Collider(points, Triangles{{0, -1, 2}}), Catch::StartsWith("collider_triangles"));
    CHECK_THROWS_WITH(Collider(Points{{std::numeric_limits<float>::quiet_NaN(), 0, 0}}, Triangles{}),
                      Catch::StartsWith("collider_positions"));
    SnowSettings settings = falling(10.0);
    settings.collider = std::make_shared<const Collider>(points, Triangles{{0, 1, 1}});
    CHECK(Snow(settings).touchdowns(5.0).empty());
    settings.collider = std::make_shared<const Collider>(Points{}, Triangles{});
    CHECK(Snow(settings).touchdowns(5.0).empty());
    const auto refuses = [](const char* name, const auto& change) {
        SnowSettings bad;
        change(bad);
        CHECK_THROWS_WITH(Snow(bad), Catch::StartsWith(name));
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    refuses("ground", [&](SnowSettings& s) { s.ground = nan; });
    refuses("rest_time", [&](SnowSettings& s) { s.rest_time = -1.0; });
    refuses("melt_time", [&](SnowSettings& s) { s.melt_time = nan; });
    refuses("friction", [&](SnowSettings& s) { s.friction = -1.0; });
    settings.ground = 0.0;
    settings.rate = 1e7;
    settings.lifetime = 1.0;
    const Snow many(settings);
    CHECK_THROWS_WITH(many.touchdowns(100.0), Catch::StartsWith("end"));
    CHECK_THROWS_WITH(many.touchdowns(nan), Catch::StartsWith("end"));
    // Births where times have no digits left for the way.
    settings.rate = 1e-300;
    CHECK(Snow(settings).touchdowns(1e301).empty());
}
