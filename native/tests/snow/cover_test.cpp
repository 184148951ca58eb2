#include "motus/snow/cover.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "flakes.hpp"
#include "motus/snow/layer.hpp"
#include "sheets.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

struct Covered {
    Covered(const SnowSettings& settings, const CoverSettings& by) : snow(settings), cover(snow, by) {}

    [[nodiscard]] std::vector<float> at(double time, std::size_t threads = 1) const {
        std::vector<float> heights(cover.vertex_count());
        cover.heights(time, heights, threads);
        return heights;
    }
    /// Of the vertices from the first on, m^3.
    [[nodiscard]] double volume(double time, std::size_t first = 0) const {
        const std::vector<float> heights = at(time);
        double sum = 0.0;
        for (std::size_t i = first; i < heights.size(); ++i)
            sum += static_cast<double>(heights[i]) * cover.areas()[i];
        return sum;
    }

    Snow snow;
    Cover cover;
};

}  // namespace

TEST_CASE("all that landed lies on the cover, at any time", "[snow]") {
    for (const int smoothing : {0, 4, 50}) {
        SnowSettings settings = falling(3000.0);
        settings.random_lifetime = true;
        settings.collider = sheet(2.0F, 0.0F, 0.1F, 12);
        const Covered one(settings,
                          {.end = 6.0, .flake_volume = 1e-3, .repose = 0.8, .smoothing = smoothing});
        const std::vector<Touchdown> downs = one.snow.touchdowns(6.0);
        CHECK(downs.size() > 5000);
        std::vector<float> before(one.cover.vertex_count());
        for (const double time : {0.5, 1.9, 2.3, 2.31, 4.0, 6.0, 100.0}) {
            const auto landed =
                std::ranges::count_if(downs, [&](const Touchdown& d) { return d.time <= time; });
            CHECK(one.cover.volume(time) == Approx(1e-3 * static_cast<double>(landed)));
            CHECK(one.volume(time) == Approx(1e-3 * static_cast<double>(landed)).epsilon(1e-5));
            const std::vector<float> now = one.at(time);
            CHECK(same_bits(now, one.at(time, 3)));
            for (std::size_t i = 0; i < now.size(); ++i) CHECK(now[i] >= before[i] - 1e-6F);
            before = now;
        }
        CHECK(one.volume(-3.0) == 0.0);
    }
}

TEST_CASE("snow lies on a surface at the height of the ground", "[snow]") {
    for (const float height : {0.0F, 0.1F, -3.7F}) {
        // To rounding: what is turned, or refined, is as near.
        for (const float lower : {0.0F, 2e-7F}) {
            SnowSettings settings = falling(2000.0);
            settings.random_speed = true;
            settings.lifetime = 20.0;
            settings.collider = sheet(2.0F, height - lower, 0.0F, 7);
            const Covered alone(settings, {.end = 8.0});
            settings.ground = static_cast<double>(height);
            const Covered both(settings, {.end = 8.0});
            CAPTURE(height, 1e7F * lower);
            CHECK(both.cover.volume(8.0) > 0.5);
            CHECK(both.cover.volume(8.0) == alone.cover.volume(8.0));
            CHECK(std::ranges::none_of(both.snow.touchdowns(8.0),
                                       [](const Touchdown& down) { return down.triangle < 0; }));
            // What is clearly below the ground stays bare.
            settings.ground = static_cast<double>(height) + 1e-3;
            CHECK(Covered(settings, {.end = 8.0}).cover.volume(8.0) == 0.0);
        }
    }
}

TEST_CASE("what rises to the lower side of something falls off", "[snow]") {
    for (const float slope : {0.0F, 1e-4F, 0.3F}) {
        SnowSettings settings = falling(500.0);
        settings.start_speed = 1.5;
        settings.cone_radius = 1.5;
        Points positions;
        Triangles triangles;
        add_sheet(4.0F, 0.0F, 0.0F, 8, positions, triangles);
        const std::size_t floor = positions.size();
        add_sheet(2.0F, 4.0F, slope, 4, positions, triangles);
        settings.collider = std::make_shared<const Collider>(positions, triangles);
        const Covered one(settings, {.end = 4.0, .smoothing = 0});
        CAPTURE(slope);
        CHECK(one.cover.volume(4.0) == Approx(1e-4 * static_cast<double>(one.snow.touchdowns(4.0).size())));
        CHECK(one.volume(4.0, floor) == 0.0);
        CHECK(one.volume(4.0) == Approx(one.cover.volume(4.0)).epsilon(1e-5));
    }
}

TEST_CASE("steep snow slides off, however finely the slope is divided", "[snow]") {
    for (const int cells : {4, 150}) {
        SnowSettings settings = falling(2000.0);
        settings.collider = sheet(2.0F, 0.0F, 2.5F, cells);
        const Covered one(settings, {.end = 6.0, .flake_volume = 1e-3, .repose = 0.8});
        CHECK(one.snow.touchdowns(6.0).size() > 1000);
        CHECK(one.cover.volume(6.0) == 0.0);
    }
}

TEST_CASE("the cover is even where snow falls evenly", "[snow]") {
    SnowSettings settings = falling(40000.0);
    settings.collider = sheet(2.0F, 0.0F, 0.0F, 6);
    const Covered one(settings, {.end = 4.0, .flake_volume = 1e-5, .smoothing = 10});
    const double mean = one.cover.volume(4.0) / 16.0;
    for (const float height : one.at(4.0)) CHECK(height == Approx(mean).epsilon(0.1));
}

TEST_CASE("nothing lies under a roof", "[snow]") {
    SnowSettings settings = falling(20000.0);
    Points positions;
    Triangles triangles;
    add_sheet(2.0F, 0.0F, 0.0F, 32, positions, triangles);
    const std::size_t below = positions.size();
    add_sheet(1.0F, 1.0F, 0.0F, 4, positions, triangles);
    settings.collider = std::make_shared<const Collider>(positions, triangles);
    for (const int smoothing : {0, 30}) {
        const Covered one(settings, {.end = 4.0, .flake_volume = 1e-5, .smoothing = smoothing});
        const std::vector<float> heights = one.at(4.0);
        for (std::size_t i = 0; i < below; ++i) {
            const float aside = std::max(std::abs(positions[i].x), std::abs(positions[i].y));
            if (aside < 0.85F) CHECK(heights[i] == 0.0F);
            if (aside > 1.2F) CHECK(heights[i] > 0.0F);
        }
        // A quarter lies on the roof, though what lies below landed later.
        const double whole = one.volume(4.0);
        CHECK(one.volume(4.0, below) == Approx(0.25 * 20000.0 * (4.0 - 4.0 / 3.0) * 1e-5).epsilon(0.05));
        CHECK(whole == Approx(one.cover.volume(4.0)).epsilon(1e-5));
    }
}

TEST_CASE("snow beside a roof ends along its shadow, and is all there", "[snow]") {
    SnowSettings settings = falling(40000.0);
    constexpr float edge = 0.13F;
    constexpr int cells = 20;
    constexpr float cell = 4.0F / static_cast<float>(cells);
    Points positions, ground;
    Triangles triangles, sheet;
    add_sheet(2.0F, 0.0F, 0.0F, cells, positions, triangles);
    ground = positions;
    sheet = triangles;
    // Over all that is on one side of a slanting line.
    const auto slanting = [](float y) { return edge + 0.3F * y; };
    const int first = static_cast<int>(positions.size());
    for (const glm::vec3& corner : {glm::vec3(slanting(-3.0F), -3.0F, 1.0F), glm::vec3(5.0F, -3.0F, 1.0F),
                                    glm::vec3(5.0F, 3.0F, 1.0F), glm::vec3(slanting(3.0F), 3.0F, 1.0F)})
        positions.push_back(corner);
    triangles.emplace_back(first, first + 1, first + 2);
    triangles.emplace_back(first, first + 2, first + 3);
    settings.collider = std::make_shared<const Collider>(positions, triangles);
    const SnowLayer layer(ground, sheet, glm::dvec3(0.0, 0.0, 1.0), settings.collider.get(), 1.5);
    for (const int smoothing : {0, 30}) {
        const Covered one(settings, {.end = 4.0, .flake_volume = 1e-5, .smoothing = smoothing});
        std::vector<float> heights = one.at(4.0);
        heights.resize(ground.size());
        const SnowLayer::Mesh mesh = layer.at(heights, 0.0F, std::numeric_limits<float>::infinity());
        double shown = 0.0;
        for (const glm::ivec3& t : mesh.triangles) {
            const auto at = [&](int i) { return glm::dvec3(mesh.positions[static_cast<std::size_t>(t[i])]); };
            shown += glm::cross(at(1) - at(0), at(2) - at(0)).z * (at(0).z + at(1).z + at(2).z) / 6.0;
        }
        // What fell on the open part, a trapezium.
        const double depth = 40000.0 * (4.0 - 2.0) * 1e-5 / 16.0;
        CHECK(shown == Approx(depth * 4.0 * (2.0 + static_cast<double>(edge))).epsilon(0.01));
        std::size_t on_the_line = 0;
        for (const glm::vec3& place : mesh.positions) {
            const float aside = (place.x - slanting(place.y)) / std::sqrt(1.09F);
            CHECK(aside < 0.03F * cell);
            CHECK(place.z < 3.0F * static_cast<float>(depth));
            if (std::abs(aside) < 0.03F * cell) ++on_the_line;
        }
        CHECK(on_the_line >= static_cast<std::size_t>(cells));
    }
}

TEST_CASE("the steeper the less lies, and the rest is below", "[snow]") {
    double most = 2.0;
    // Tangent of the slope, over that of the angle of repose.
    for (const double steepness : {0.5, 0.95, 1.1, 1.25, 1.4, 1.6, 4.0}) {
        SnowSettings settings = falling(8000.0);
        Points positions;
        Triangles triangles;
        add_sheet(4.0F, -6.0F, 0.0F, 20, positions, triangles);
        const std::size_t below = positions.size();
        const double repose = 0.5;
        // A gable whose halves hang together at the ridge.
        const auto drop = static_cast<float>(steepness * std::tan(repose));
        const auto first = static_cast<int>(positions.size());
        for (const float x : {-1.0F, 0.0F, 1.0F})
            for (const float y : {-2.0F, 2.0F}) positions.emplace_back(x, y, -drop * std::abs(x));
        for (const int at : {first, first + 2}) {
            triangles.emplace_back(at, at + 2, at + 1);
            triangles.emplace_back(at + 1, at + 2, at + 3);
        }
        settings.cone_radius = 1.0;
        settings.collider = std::make_shared<const Collider>(positions, triangles);
        const Covered one(settings, {.end = 5.0, .flake_volume = 1e-5, .repose = repose, .smoothing = 0});
        const double whole = one.volume(5.0), above = one.volume(5.0, below);
        CAPTURE(steepness);
        CHECK(whole == Approx(1e-5 * static_cast<double>(one.snow.touchdowns(5.0).size())).epsilon(1e-5));
        const double expected = std::clamp(1.0 - (steepness - 1.0) / 0.5, 0.0, 1.0);
        CHECK(above / whole == Approx(expected).margin(0.03));
        CHECK(above / whole <= most);
        most = above / whole + 0.01;
        // What slid down lies at the foot of the eaves.
        if (expected > 0.0) continue;
        const std::vector<float> heights = one.at(5.0);
        for (std::size_t i = 0; i < below; ++i)
            if (std::abs(std::abs(positions[i].x) - 1.0F) > 0.5F) CHECK(heights[i] == 0.0F);
    }
}

TEST_CASE("what slides down a wall falls to the ground, and not under the house", "[snow]") {
    SnowSettings settings = falling(3000.0);
    settings.gravity = true;
    settings.drag = 2.0;
    settings.wind = {6.0, 0.0, 0.0};
    settings.lifetime = 10.0;
    Points positions;
    Triangles triangles;
    add_sheet(10.0F, 0.0F, 0.0F, 40, positions, triangles);
    const std::size_t ground = positions.size();
    for (int i = 0; i < 8; ++i)
        positions.emplace_back((i & 1) != 0 ? 6.0F : 4.0F, (i & 2) != 0 ? 2.0F : -2.0F,
                               (i & 4) != 0 ? 2.0F : -0.5F);
    const auto add = [&](int a, int b, int c) {
        const auto first = static_cast<int>(ground);
        triangles.emplace_back(first + a, first + b, first + c);
    };
    add(0, 2, 1), add(1, 2, 3), add(4, 5, 6), add(5, 7, 6), add(0, 1, 4), add(1, 5, 4);
    add(2, 6, 3), add(3, 6, 7), add(0, 4, 2), add(2, 4, 6), add(1, 3, 5), add(3, 7, 5);
    settings.collider = std::make_shared<const Collider>(positions, triangles);
    const Covered one(settings, {.end = 6.0, .flake_volume = 1e-5, .smoothing = 5});
    const std::vector<float> heights = one.at(6.0);
    const std::vector<Touchdown> downs = one.snow.touchdowns(6.0);
    // Some of them came to the wall.
    CHECK(std::ranges::count_if(downs, [](const Touchdown& down) {
              return std::abs(down.point.x - 4.0F) < 1e-4F && down.point.z < 1.99F;
          }) > 30);
    for (std::size_t i = ground; i < ground + 4; ++i) CHECK(heights[i] == 0.0F);
    for (std::size_t i = 0; i < ground; ++i)
        if (positions[i].x > 4.5F && positions[i].x < 5.5F && std::abs(positions[i].y) < 1.5F)
            CHECK(heights[i] == 0.0F);
    CHECK(one.volume(6.0) == Approx(one.cover.volume(6.0)).epsilon(1e-5));
}

TEST_CASE("covers of bad settings are refused with a sentence", "[snow]") {
    SnowSettings settings = falling(10.0);
    const CoverSettings good{.end = 3.0};
    CHECK_THROWS_WITH(Cover(Snow(settings), good), Catch::StartsWith("snow: must have a collider"));
    settings.collider = sheet(2.0F, 0.0F, 0.0F, 2);
    const Snow snow(settings);
    const auto refuses = [&](const char* name, const auto& change) {
        CoverSettings bad = good;
        change(bad);
        CHECK_THROWS_WITH(Cover(snow, bad), Catch::StartsWith(name));
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, nan})
        refuses("flake_volume", [&](CoverSettings& s) { s.flake_volume = bad; });
    for (const double bad : {-0.1, 1.6, nan}) refuses("repose", [&](CoverSettings& s) { s.repose = bad; });
    for (const int bad : {-1, 1001}) refuses("smoothing", [&](CoverSettings& s) { s.smoothing = bad; });
    refuses("end", [&](CoverSettings& s) { s.end = nan; });
    const Cover cover(snow, good);
    std::vector<float> few(cover.vertex_count() - 1), all(cover.vertex_count());
    CHECK_THROWS_WITH(cover.heights(1.0, few), Catch::StartsWith("out"));
    CHECK_THROWS_WITH(cover.heights(nan, all), Catch::StartsWith("time"));
    // A wall, on which nothing lies, and nothing at all.
    settings.collider = std::make_shared<const Collider>(Points{}, Triangles{});
    CHECK(Cover(Snow(settings), good).volume(3.0) == 0.0);
}

TEST_CASE("a cover comes back from its bytes, and answers as before", "[snow]") {
    for (const int smoothing : {0, 4}) {
        SnowSettings settings = falling(300.0);
        settings.collider = sheet(2.0F, 0.0F, 0.1F, 5);
        const Covered one(settings, {.end = 6.0, .flake_volume = 1e-3, .smoothing = smoothing});
        const Cover again = Cover::restored(one.cover.bytes());
        CHECK(again.bytes() == one.cover.bytes());
        CHECK(std::ranges::equal(again.areas(), one.cover.areas()));
        for (const double time : {0.0, 2.5, 6.0}) {
            std::vector<float> heights(again.vertex_count());
            again.heights(time, heights);
            CHECK(heights == one.at(time));
            CHECK(again.volume(time) == one.cover.volume(time));
        }
    }
}

TEST_CASE("bytes that are no cover's are refused, or give one that answers", "[snow]") {
    SnowSettings settings = falling(30.0);
    settings.collider = sheet(2.0F, 0.0F, 0.1F, 3);
    const Covered one(settings, {.end = 3.0, .smoothing = 2});
    const std::vector<std::byte> whole = one.cover.bytes();
    const auto restored = [](const std::vector<std::byte>& data) -> bool {
        try {
            const Cover cover = Cover::restored(data);
            std::vector<float> heights(cover.vertex_count());
            cover.heights(2.0, heights, 1);
            static_cast<void>(cover.volume(2.0));
            return true;
        } catch (const std::invalid_argument& problem) {
            CHECK(std::string_view(problem.what()).starts_with("data: "));
            return false;
        }
    };
    CHECK(restored(whole));
    for (std::size_t length = 0; length < whole.size(); length += 1 + length / 20)
        CHECK_FALSE(restored({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}));
    std::vector<std::byte> longer = whole;
    longer.push_back(std::byte{0});
    CHECK_FALSE(restored(longer));
    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const unsigned mask : {0x01U, 0x80U, 0xffU}) {
            std::vector<std::byte> other = whole;
            other[at] ^= static_cast<std::byte>(mask);
            refused += restored(other) ? 0 : 1;
        }
    }
    CHECK(refused > 100);
}
