#include "motus/snow/snow.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "flakes.hpp"

using namespace motus;
using namespace motus::snow;

TEST_CASE("any frame is the same in any order and by any threads", "[snow]") {
    for (const SnowSettings& settings : kinds(30000.0)) {
        const Snow snow(settings);
        const Flakes first = flakes_at(snow, 3.3);
        CHECK(first.age.size() > 1000);
        static_cast<void>(flakes_at(snow, 0.9));
        for (const std::size_t threads : {1, 2, 3, 8})
            CHECK(are_same(flakes_at(Snow(settings), 3.3, threads), first));
    }
}

TEST_CASE("flakes live from their birth to their lifetime, in the order of numbers", "[snow]") {
    for (const SnowSettings& settings : kinds(701.0)) {
        const Snow snow(settings);
        for (const double time : {-1.0, 0.0, 0.3, 0.31, 0.8, 2.0, 2.8, 4.0, 1000.0}) {
            const Flakes now = flakes_at(snow, time);
            CHECK(std::ranges::is_sorted(now.id));
            CHECK(std::ranges::adjacent_find(now.id) == now.id.end());
            for (std::size_t i = 0; i < now.age.size(); ++i) {
                CHECK(now.age[i] >= 0.0F);
                CHECK(now.age[i] < static_cast<float>(settings.lifetime + 1.0));
            }
            // A flake that lives now and lived then is so much older, and keeps what it was given.
            const Flakes then = flakes_at(snow, time + 0.25);
            std::size_t both = 0;
            for (std::size_t i = 0, j = 0; i < now.id.size() && j < then.id.size();) {
                if (now.id[i] == then.id[j]) {
                    CHECK(then.age[j] - now.age[i] == Approx(0.25F).margin(1e-5));
                    CHECK(now.size[i] == then.size[j]);
                    CHECK(now.color[i] == then.color[j]);
                    ++both, ++i, ++j;
                } else {
                    now.id[i] < then.id[j] ? ++i : ++j;
                }
            }
            if (time > 2.0) CHECK(both > 100);
        }
    }
}

TEST_CASE("looping has no end, and the flow no seam", "[snow]") {
    SnowSettings settings;
    settings.rate = 50.0;
    settings.duration = 3.0;
    const auto count = [&](double time) { return Snow(settings).living(time).count(); };
    for (const double time : {2.5, 3.0, 3.5, 6.0, 9000.0}) CHECK(count(time) == 100);
    settings.looping = false;
    CHECK(count(3.0) == 100);
    CHECK(count(4.0) == 50);
    CHECK(count(5.0) == 0);
}

TEST_CASE("a keyed rate lets flakes be born by its integral, at any time and by any threads", "[snow]") {
    SnowSettings settings = rich(0.0);
    settings.rate_keys = {{0.0, 1.0, 2.0, 4.0}, {0.0, 900.0, 0.0, 300.0}};
    settings.random_lifetime = false;
    const Snow snow(settings);
    const Flakes late = flakes_at(snow, 3.5, 3);
    for (const double time : {0.4, 4.0, 1.1, 3.5}) {
        const Flakes now = flakes_at(snow, time);
        const Births births(0.0, settings.delay, 0.0, true, settings.bursts, settings.rate_keys);
        CHECK(now.id.size() == births.count(time) - births.count_older(time, settings.lifetime));
        for (std::size_t i = 1; i < now.age.size(); ++i) CHECK(now.age[i] <= now.age[i - 1]);
    }
    CHECK(are_same(flakes_at(snow, 3.5), late));
    settings.rate_keys.values = {0.0, 1e9, 0.0, 0.0};
    CHECK_THROWS_WITH(Snow(settings), Catch::StartsWith("rate"));
}

TEST_CASE("late times are as good as early ones", "[snow]") {
    SnowSettings settings;
    settings.rate = 1024.0;
    settings.snow = true;
    const Snow snow(settings);
    const Flakes early = flakes_at(snow, 4.25), late = flakes_at(snow, 1048576.25);
    REQUIRE(early.age.size() == late.age.size());
    CHECK(same_bits(early.age, late.age));
    CHECK(same_bits(early.velocity, late.velocity));
    CHECK(late.id.front() > 1000000000);
    CHECK(flakes_at(snow, 1e300).age.empty());
    CHECK_THROWS_AS(snow.living(std::numeric_limits<double>::infinity()), std::invalid_argument);
}

TEST_CASE("bad settings are refused with a sentence", "[snow]") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refuses = [](const char* name, const auto& change) {
        SnowSettings settings;
        change(settings);
        CHECK_THROWS_WITH(Snow(settings), Catch::StartsWith(name));
    };
    refuses("rate_values", [&](SnowSettings& s) { s.rate_keys = {{0.0}, {nan}}; });
    refuses("inherited", [&](SnowSettings& s) { s.inherited = nan; });
    for (const double bad : {-1.0, nan}) {
        refuses("period", [&](SnowSettings& s) { s.period = bad; });
        refuses("rate", [&](SnowSettings& s) { s.rate = bad; });
        refuses("lifetime", [&](SnowSettings& s) { s.lifetime = bad; });
        refuses("delay", [&](SnowSettings& s) { s.delay = bad; });
        refuses("duration", [&](SnowSettings& s) { s.duration = bad; });
        refuses("cone_angle", [&](SnowSettings& s) { s.cone_angle = bad; });
        refuses("cone_radius", [&](SnowSettings& s) { s.cone_radius = bad; });
        refuses("drag", [&](SnowSettings& s) { s.drag = bad; });
        refuses("frustum_angles", [&](SnowSettings& s) { s.frustum_angles.y = bad; });
        refuses("frustum_near", [&](SnowSettings& s) { s.frustum_near = bad; });
        refuses("frustum_far", [&](SnowSettings& s) { s.frustum_far = bad; });
        refuses("gusts", [&](SnowSettings& s) { s.gusts = bad; });
        refuses("gust_frequency", [&](SnowSettings& s) { s.gust_frequency = bad; });
        refuses("snow_frequency", [&](SnowSettings& s) { s.snow_frequency = bad; });
        refuses("turbulence: must", [&](SnowSettings& s) { s.turbulence = bad; });
        refuses("turbulence_size", [&](SnowSettings& s) { s.turbulence_size = bad; });
        refuses("tumble", [&](SnowSettings& s) { s.tumble = bad; });
    }
    refuses("start_speed", [&](SnowSettings& s) { s.start_speed = nan; });
    refuses("start_size", [&](SnowSettings& s) { s.start_size = 1e300; });
    refuses("max_angle", [&](SnowSettings& s) { s.max_angle = nan; });
    refuses("wind", [&](SnowSettings& s) { s.wind.y = nan; });
    refuses("wind_values", [&](SnowSettings& s) { s.wind_times = {1.0}; });
    refuses("wind_values", [&](SnowSettings& s) { s.wind_times = {1.0}, s.wind_values = {{nan, 0.0, 0.0}}; });
    refuses("wind_times", [&](SnowSettings& s) { s.wind_times = {nan}, s.wind_values = {{}}; });
    refuses("wind_times: must rise", [&](SnowSettings& s) {
        s.wind_times = {1.0, 1.0}, s.wind_values = {{}, {}};
    });
    refuses("start_color", [&](SnowSettings& s) { s.start_color.clear(); });
    refuses("start_color", [&](SnowSettings& s) { s.start_color = {{1.0F, {}}, {0.0F, {}}}; });
    refuses("emitter_matrices", [&](SnowSettings& s) { s.emitter_times = {0.0}; });
    refuses("surface_triangles: must have an area", [&](SnowSettings& s) { s.shape = Shape::surface; });
    refuses("surface_triangles: must name", [&](SnowSettings& s) {
        s.shape = Shape::surface;
        s.surface_triangles = {{0, 1, 2}};
    });
    refuses("surface_positions", [&](SnowSettings& s) {
        s.shape = Shape::surface;
        s.surface_positions = {glm::vec3(std::numeric_limits<float>::infinity())};
    });
    refuses("rate: must be lower: up to 2e+12 flakes", [&](SnowSettings& s) { s.rate = 1e12; });
    refuses("rate: must be lower", [&](SnowSettings& s) { s.lifetime = 1e12; });
    refuses("rate: must be lower", [&](SnowSettings& s) { s.bursts = {{1.0, 1000000000000U}}; });
    refuses("lifetime: must be shorter",
            [&](SnowSettings& s) { s.rate = 0.1, s.lifetime = 1e6, s.snow = true; });

    SnowSettings none;
    none.rate = 0.0;
    CHECK(flakes_at(Snow(none), 5.0).age.empty());
    none.rate = 100.0;
    none.lifetime = 0.0;
    CHECK(flakes_at(Snow(none), 5.0).age.empty());
    const Snow snow{SnowSettings{}};
    const Living living = snow.living(1.0);
    std::vector<float> few(living.count() - 1);
    CHECK_THROWS_AS(snow.evaluate(living, {.age = few}), std::invalid_argument);
}

TEST_CASE("only what is wanted is filled, and it is the same", "[snow]") {
    const Snow snow(rich(1000.0));
    const Living living = snow.living(3.0);
    Flakes all(living.count()), some(living.count());
    snow.evaluate(living, all.fields());
    snow.evaluate(living, {.position = some.position});
    snow.evaluate(living, {.rotation = some.rotation});
    snow.evaluate(living, {.color = some.color});
    snow.evaluate(living, {.size = some.size, .id = some.id});
    snow.evaluate(living, {.velocity = some.velocity, .age = some.age});
    CHECK(are_same(all, some));
}

TEST_CASE("what is kept of one snow's landings is no other's", "[snow]") {
    SnowSettings settings;
    settings.rate = 300.0;
    settings.gravity = true;
    settings.emitter_times = {0.0};
    settings.emitter_matrices = {glm::dmat4(-1.0)};
    std::vector<Snow> snows;
    for (const double height : {-1.0, -2.0, -3.0}) {
        settings.ground = height;
        snows.emplace_back(settings);
    }
    for (int round = 0; round < 2; ++round)
        for (std::size_t i = 0; i < snows.size(); ++i) {
            float lowest = 0.0F;
            const Flakes flakes = flakes_at(snows[i], 2.0);
            for (const glm::vec3& place : flakes.position) lowest = std::min(lowest, place.z);
            CHECK(lowest == Approx(-1.0 - static_cast<double>(i)).margin(1e-4));
        }
}

TEST_CASE("a snow that was moved from is still the snow", "[snow]") {
    for (const SnowSettings& settings : kinds(701.0)) {
        const Flakes wanted = flakes_at(Snow(settings), 2.3);
        Snow snow(settings);
        Snow moved = std::move(snow);
        CHECK(are_same(flakes_at(moved, 2.3), wanted));
        // NOLINTBEGIN(bugprone-use-after-move): that is what it is about
        CHECK(are_same(flakes_at(snow, 2.3), wanted));
        Snow other{SnowSettings{}};
        other = std::move(moved);
        CHECK(are_same(flakes_at(other, 2.3), wanted));
        CHECK(are_same(flakes_at(moved, 2.3), wanted));
        CHECK(moved.acceleration() == settings.acceleration);
        // NOLINTEND(bugprone-use-after-move)
    }
}
