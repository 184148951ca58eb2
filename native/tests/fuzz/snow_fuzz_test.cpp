// Snow with numbers that nobody expects.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "extremes.hpp"
#include "mesh_zoo.hpp"
#include "motus/core/numeric.hpp"
#include "motus/snow/cover.hpp"
#include "motus/snow/layer.hpp"
#include "motus/snow/marks.hpp"
#include "motus/snow/snow.hpp"

using namespace motus;
using namespace motus::snow;
using namespace motus::test;

namespace {

[[nodiscard]] SnowSettings settings_of(Dice& dice) {
    SnowSettings s;
    s.start_speed = dice.number();
    s.lifetime = dice.number(0.1, 4.0);
    s.start_size = dice.number();
    s.rate = dice.number(0.0, 300.0);
    s.delay = dice.number(0.0, 1.0);
    s.duration = dice.number(0.0, 5.0);
    s.looping = dice.chance(0.5);
    if (dice.chance(0.5)) s.bursts = {{dice.number(0.0, 1.0), 20}};
    s.shape = static_cast<Shape>(dice.whole(0, 6));
    s.surface_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    s.surface_triangles = {{0, 1, 2}};
    s.frustum_angles = {dice.number(0.0, 1.0), dice.number(0.0, 1.0)};
    s.frustum_near = dice.number(0.0, 1.0);
    s.frustum_far = dice.number(1.0, 9.0);
    s.cone_angle = dice.number(0.0, 3.0);
    s.cone_radius = dice.number(0.0, 3.0);
    s.random_speed = s.random_orientation = s.random_lifetime = s.random_size = dice.chance(0.5);
    s.snow = dice.chance(0.5);
    s.max_angle = dice.number();
    s.snow_frequency = dice.number(0.1, 3.0);
    s.snow_offsets = dice.chance(0.5);
    s.gravity = dice.chance(0.5);
    s.acceleration = dice.place();
    s.drag = dice.number(0.0, 3.0);
    s.wind = dice.place();
    if (dice.chance(0.3)) {
        s.wind_times = dice.rising(2);
        s.wind_values = dice.places(2);
    }
    s.gusts = dice.number(0.0, 1.0);
    s.gust_frequency = dice.number(0.1, 2.0);
    s.turbulence = dice.number(0.0, 2.0);
    s.turbulence_size = dice.number(0.1, 2.0);
    s.tumble = dice.number(0.0, 9.0);
    s.seed = dice.bits();
    s.emitter_times = dice.rising(2);
    s.emitter_matrices = {dice.matrix(), dice.matrix()};
    return s;
}

}  // namespace

TEST_CASE("a snow takes its own flakes alone", "[fuzz]") {
    SnowSettings settings;
    settings.rate = 1000.0;
    const Snow few(settings);
    settings.delay = 1.0;
    settings.rate = 3000.0;
    const Snow other(settings);
    Living living = few.living(1.0);
    std::vector<glm::vec3> places(living.count());
    CHECK(is_refused([&] { other.evaluate(living, {.position = places}); }, "living"));
    CHECK(is_refused([&] { few.evaluate({}, {.position = places}); }, "living"));
    const Snow copy = few;
    copy.evaluate(living, {.position = places});
    const Living taken = std::move(living);
    // NOLINTNEXTLINE(bugprone-use-after-move): what this is about
    CHECK(is_refused([&] { few.evaluate(living, {.position = places}); }, "living"));
    few.evaluate(taken, {.position = places});
    places.pop_back();
    CHECK(is_refused([&] { few.evaluate(taken, {.position = places}); }, "out"));
}

TEST_CASE("snow slides over triangles without area, and lies where it would without them", "[fuzz]") {
    // Slope and floor with one column of vertices at the foot, and with two, between which triangles have no
    // area.
    const auto lies = [](const ZooMesh& mesh, int smoothing) {
        SnowSettings settings;
        settings.rate = 100.0;
        settings.lifetime = 8.0;
        settings.start_speed = -2.0;
        settings.cone_radius = 0.9;
        settings.shape = Shape::square;
        settings.collider = std::make_shared<const Collider>(mesh.positions, mesh.triangles);
        settings.emitter_times = {0.0};
        settings.emitter_matrices = {glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, 0.0, 6.0))};
        const Cover cover(Snow(settings),
                          {.end = 6.0, .flake_volume = 1e-3, .repose = 0.3, .smoothing = smoothing});
        std::vector<float> heights(cover.vertex_count());
        cover.heights(6.0, heights);
        // How much lies on vertices of the floor, its border to the slope included.
        double floor = 0.0, all = 0.0;
        for (std::size_t i = 0; i < heights.size(); ++i) {
            CHECK(std::isfinite(heights[i]));
            const double part = static_cast<double>(heights[i]) * cover.areas()[i];
            all += part;
            if (mesh.positions[i].x >= 0.0F) floor += part;
        }
        CHECK(all == Approx(cover.volume(6.0)).epsilon(1e-4));
        return floor;
    };
    ZooMesh plain = flat_at_the_foot(0.0F);
    // The same without the second column.
    std::erase_if(plain.triangles, [](const glm::ivec3& t) {
        return std::min({t.x, t.y, t.z}) >= 5 && std::max({t.x, t.y, t.z}) < 15;
    });
    for (glm::ivec3& t : plain.triangles)
        for (int i = 0; i < 3; ++i)
            if (t[i] >= 10 && t[i] < 15) t[i] -= 5;
    for (const int smoothing : {0, 4}) {
        const double right = lies(plain, smoothing);
        CHECK(right > 0.1);
        CHECK(lies(flat_at_the_foot(0.0F), smoothing) == Approx(right).epsilon(0.15));
        CHECK(std::isfinite(lies(flat_at_the_foot(0.25F), smoothing)));
    }
}

TEST_CASE("flakes of any numbers are refused or at finite places", "[fuzz]") {
    for (const double share : {0.01, 0.08}) {
        Dice dice(41, share);
        for (int round = 0; round < 40; ++round) {
            const SnowSettings settings = settings_of(dice);
            // What takes long, and much memory, is left out.
            if (settings.snow && settings.lifetime > 1e3) continue;
            const double time = dice.number(0.0, 6.0);
            returns([&] {
                const Snow snow(settings);
                const Living living = snow.living(time, 1);
                if (living.count() > 5000) return;
                std::vector<glm::vec3> places(living.count()), velocities(living.count());
                std::vector<float> sizes(living.count()), ages(living.count());
                std::vector<glm::vec4> rotations(living.count());
                snow.evaluate(living,
                              {.position = places,
                               .velocity = velocities,
                               .size = sizes,
                               .age = ages,
                               .rotation = rotations},
                              1);
                for (const float age : ages) CHECK((std::isfinite(age) && age >= 0.0F));
                if (share < 0.02)
                    for (const glm::vec4& rotation : rotations)
                        CHECK(std::abs(glm::dot(rotation, rotation) - 1.0F) < 1e-3F);
            });
        }
    }
}

TEST_CASE("flakes that steer by a large angle are where they can be", "[fuzz]") {
    SnowSettings settings;
    settings.snow = settings.snow_offsets = true;
    settings.rate = 200.0;
    for (const double angle : {1e6, -1e6}) {
        settings.max_angle = angle;
        const Snow snow(settings);
        const Living living = snow.living(3.0);
        std::vector<glm::vec3> places(living.count());
        snow.evaluate(living, {.position = places});
        // No farther than the speed and the lifetime let them come.
        for (const glm::vec3& place : places)
            CHECK(length_of(glm::dvec3(place)) < 5.0 * settings.lifetime + 2.0);
    }
    settings.max_angle = 1.1e6;
    CHECK(is_refused([&] { (void)Snow(settings); }, "max_angle"));
    settings.max_angle = 1.0;
    settings.drag = 1.0;
    settings.wind = {1.0, 0.0, 0.0};
    settings.gusts = 1.0;
    settings.delay = 1e12;  // gusts at such a time are sines of as large an angle
    const Snow late(settings);
    const Living living = late.living(1e12 + 2.0);
    CHECK(living.count() > 100);
    std::vector<glm::vec3> places(living.count());
    late.evaluate(living, {.position = places});
    for (const glm::vec3& place : places) CHECK(length_of(glm::dvec3(place)) < 100.0);
}

TEST_CASE("births, covers and layers of any numbers are refused or finite", "[fuzz]") {
    Dice dice(42, 0.2);
    const ZooMesh mesh = slope_and_floor(3, 1.0F);
    SnowSettings settings;
    settings.collider = std::make_shared<const Collider>(mesh.positions, mesh.triangles);
    settings.start_speed = -2.0;
    settings.rate = 30.0;
    settings.emitter_times = {0.0};
    settings.emitter_matrices = {glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 3.0))};
    const Snow snow(settings);
    const SnowLayer layer(mesh.positions, mesh.triangles, {0.0, 0.0, 1.0});
    for (int round = 0; round < 300; ++round) {
        returns([&] {
            const Births births(dice.number(0.0, 9.0), dice.number(0.0, 1.0), dice.number(0.0, 9.0),
                                dice.chance(0.5), {{dice.number(0.0, 3.0), dice.bits() >> dice.below(64)}},
                                dice.chance(0.5) ? RateKeys{}
                                                 : RateKeys{{dice.number(-1.0, 1.0), dice.number(1.0, 3.0)},
                                                            {dice.number(0.0, 9.0), dice.number(0.0, 9.0)}});
            CHECK(births.count_older(dice.number(), dice.number()) <= Births::most_ids);
            CHECK(births.count(dice.number()) <= Births::most_ids);
            (void)births.most_within(dice.number());
        });
        returns([&] { (void)SnowLayer(mesh.positions, mesh.triangles, dice.place()); });
        std::vector<float> depths(mesh.positions.size());
        for (float& depth : depths) depth = dice.chance(0.95) ? dice.between(0.0F, 1.0F) : dice.single();
        returns([&] { (void)layer.at(depths, dice.single(0.0, 0.1), dice.single(0.1, 2.0), depths); });
        returns([&] {
            glm::dmat4 place(1.0);
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 3; ++row)
                    place[column][row] = dice.chance(0.9) ? dice.number(-1.0, 1.0) : place[column][row];
            const Mover mover{settings.collider, {0.0, 1.0}, {glm::dmat4(1.0), place}};
            std::vector<float> twice = depths;
            twice.insert(twice.end(), depths.begin(), depths.end());
            const Marks marks(layer, {mover}, std::vector{0.0, dice.number(0.5, 2.0)}, twice,
                              {dice.number(0.0, 0.1), dice.number(0.01, 1.0)}, 1);
            std::vector<float> pressed(depths.size());
            marks.press(dice.number(0.0, 2.0), depths, {}, pressed);
            for (const float gone : pressed) CHECK((std::isfinite(gone) && gone >= 0.0F));
        });
        if (round % 10 != 0) continue;
        returns([&] {
            double end = dice.number(0.0, 5.0);
            if (end > 50.0 && end < 1e7) end = 50.0;
            const Cover cover(snow, {end, dice.number(1e-5, 1e-3), dice.number(0.0, 1.5), dice.whole(-1, 3)},
                              1);
            std::vector<float> heights(cover.vertex_count());
            cover.heights(dice.number(0.0, 9.0), heights, 1);
            for (const float height : heights) CHECK(std::isfinite(height));
        });
    }
    CHECK(is_refused([&] { (void)settings.collider->normal(1000); }, "triangle"));
    std::vector<Slide> slides;
    CHECK(is_refused(
        [&] {
            settings.collider->slide({.triangle = 1000}, {}, {0.0, 0.0, -9.81}, 0.5, slides);
        },
        "first"));
}
