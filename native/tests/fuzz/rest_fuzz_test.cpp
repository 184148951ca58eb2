// Lattices, pulls, stereo, screens and walkers with numbers that nobody expects.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "extremes.hpp"
#include "motus/colour/screen.hpp"
#include "motus/core/numeric.hpp"
#include "motus/lattice/lattice.hpp"
#include "motus/sculpt/pull.hpp"
#include "motus/stereo/scene_depth.hpp"
#include "motus/stereo/screen.hpp"
#include "motus/walker/walker.hpp"

using namespace motus;
using namespace motus::test;

TEST_CASE("a lattice that cannot be pulled stays as it was", "[fuzz]") {
    const lattice::Lattice lattice{.resolution = {16, 16, 16}};
    const std::size_t count = lattice::max_pulls + 1;
    Dice dice(51, 0.0);
    std::vector<lattice::Part> parts;
    for (std::size_t i = 0; i < count; ++i) parts.push_back({.pull = i, .place = 0.5 + 0.16 * dice.place()});
    const std::vector<glm::dvec3> wanted(count, glm::dvec3(0.1));
    const std::vector<glm::dvec3> before(4096, glm::dvec3(7.0));
    std::vector<glm::dvec3> out = before;
    CHECK(is_refused([&] { lattice::pull_lattice(lattice, parts, wanted, {}, out); }, "displacements"));
    CHECK(out == before);
    parts.back().pull = count;
    CHECK(is_refused([&] { lattice::pull_lattice(lattice, parts, wanted, {}, out); }, "parts"));
    CHECK(out == before);
}

TEST_CASE("lattices of arbitrary numbers are refused or give finite results", "[fuzz]") {
    Dice dice(52, 0.08);
    for (int round = 0; round < 300; ++round) {
        lattice::Lattice lattice{.origin = dice.place(), .axes = glm::dmat3(dice.matrix())};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lattice.resolution[axis] = dice.chance(0.05) ? dice.whole(-1, 70) : dice.whole(1, 4);
            lattice.basis[axis] = static_cast<lattice::Basis>(dice.whole(0, 4));
        }
        std::size_t points = 1;
        returns([&] { points = std::min<std::size_t>(lattice::point_count(lattice), 1000); });
        returns([&] { (void)lattice::rest_points(lattice); });
        returns([&] {
            const lattice::Weights weights = lattice::weights_at(lattice, dice.place());
            for (const double weight : weights.weights) CHECK(std::isfinite(weight));
        });
        std::vector<glm::vec3> positions = dice.single_places(5), moves = dice.single_places(points);
        returns([&] { lattice::deform(lattice, moves, {}, positions, positions); });
        std::vector<glm::dvec3> out(points);
        const std::vector<lattice::Part> parts{{dice.below(3), dice.place(), dice.number(), dice.number()},
                                               {0, dice.place()}};
        returns([&] {
            const auto left = lattice::pull_lattice(lattice, parts, dice.places(2),
                                                    {dice.number(1.0, 40.0), dice.chance(0.3), {}}, out);
            CHECK(left.size() == 2);
        });
        returns([&] { (void)lattice::small_box(dice.single_places(6), glm::dmat3(dice.matrix())); });
    }
}

TEST_CASE("pulls of arbitrary numbers are refused or give finite results", "[fuzz]") {
    Dice dice(53, 0.06);
    for (int round = 0; round < 500; ++round) {
        const std::vector<float> curve{dice.single(), dice.single(), dice.single()};
        sculpt::Dab dab{.root = dice.single_place(), .displacement = dice.single_place()};
        dab.radius = dice.single(0.1, 3.0);
        dab.profile = {static_cast<sculpt::Falloff>(dice.whole(0, 8)), dice.single(), curve};
        if (dice.chance(0.3)) dab.metric = glm::mat3(glm::dmat3(dice.matrix()));
        if (dice.chance(0.3)) dab.minimum = dice.single();
        dab.clamp_axis = dice.chance(0.95) ? dice.whole(0, 2) : dice.whole(-1, 4);
        dab.mirror = static_cast<unsigned>(dice.below(dice.chance(0.95) ? 8 : 12));
        std::vector<glm::vec3> positions(9), out(9);
        for (glm::vec3& place : positions) place = dice.in_cube(2.0F);
        std::vector<float> weights(dice.chance(0.5) ? 0 : 9);
        for (float& weight : weights) weight = dice.single(0.0, 1.0);
        returns([&] { sculpt::pull(positions, dab, weights, out); });
        const std::vector<std::uint32_t> some{0, 4, dice.chance(0.9) ? 8U : 9U};
        returns([&] { sculpt::pull_among(positions, dab, some, weights, out); });
        std::vector<float> distances(5), found(5);
        for (float& distance : distances) distance = dice.single(0.0, 3.0);
        returns([&] {
            sculpt::forces(dab.profile, dab.radius, distances, found);
            (void)sculpt::reach_of(dab.profile, dab.radius);
        });
    }
}

TEST_CASE("eyes and screens of any numbers are refused, and nothing that is no number is comfortable",
          "[fuzz]") {
    Dice dice(54, 0.15);
    for (int round = 0; round < 1500; ++round) {
        const stereo::Eyes eyes{dice.number(0.0, 0.1), dice.number(10.0, 99.0), dice.number(10.0, 40.0),
                                dice.number(0.1, 9.0),
                                static_cast<stereo::ConvergenceMode>(dice.whole(0, 2))};
        const stereo::Screen screen{dice.number(0.1, 12.0), dice.number(0.1, 15.0), dice.number(0.01, 0.1)};
        const stereo::Limits limits{dice.number(0.0, 0.1), dice.number(0.0, 0.1)};
        returns([&] { (void)stereo::parallax(eyes, dice.number(0.1, 9.0)); });
        returns([&] { (void)stereo::project(eyes, dice.place()); });
        returns([&] { (void)stereo::vertical_parallax(eyes, dice.number(0.1, 9.0), dice.number(0.5, 2.0)); });
        returns([&] { (void)stereo::depths_within(eyes, limits); });
        returns([&] {
            (void)stereo::fit_budget(eyes, {dice.number(0.1, 1.0), dice.number(1.0, 9.0)}, limits);
        });
        returns([&] { (void)stereo::comfort(screen, dice.number(), dice.number(0.0, 0.1)); });
        returns([&] { (void)stereo::roundness(screen, eyes, dice.number(0.1, 9.0)); });
        const std::vector<double> depths = dice.numbers(5);
        returns([&] { (void)stereo::depth_range(depths, dice.number(0.0, 0.4), dice.number(0.5, 1.0)); });
        const std::vector<stereo::Sample> samples{{dice.number(), dice.number()},
                                                  {dice.number(), dice.number()}};
        returns([&] { (void)stereo::window_violations(eyes, samples, dice.number(0.0, 0.1)); });
        std::vector<double> out(5);
        returns(
            [&] { stereo::smooth(depths, dice.below(4), static_cast<stereo::Side>(dice.whole(0, 2)), out); });
    }
    CHECK(is_refused([] { (void)stereo::comfort({}, not_a_number); }, "parallax"));
    CHECK(is_refused([] { (void)stereo::vergence({}, not_a_number); }, "parallax"));
    CHECK(is_refused([] { (void)stereo::seen_distance({}, not_a_number); }, "parallax"));
    std::vector<double> out(2);
    CHECK(is_refused(
        [&] {
            stereo::smooth(std::array{0.0, not_a_number}, 1, stereo::Side::either, out);
        },
        "values"));
}

TEST_CASE("pictures that are empty, of a wrong size or not finite are refused", "[fuzz]") {
    const std::vector<glm::vec4> pixels(6, {0.1F, 0.8F, 0.1F, 1.0F});
    const glm::dvec3 green{0.1, 0.8, 0.1};
    CHECK(colour::screen_color({pixels, 3}));
    std::vector<glm::vec4> broken = pixels;
    broken[2].y = std::numeric_limits<float>::quiet_NaN();
    for (const colour::Picture& picture : {colour::Picture{pixels, 0}, colour::Picture{pixels, 4},
                                           colour::Picture{{}, 1}, colour::Picture{broken, 3}}) {
        CHECK(is_refused([&] { (void)colour::screen_color(picture); }, "picture"));
        CHECK(is_refused([&] { (void)colour::judge_screen(picture, green); }, "picture"));
    }
    Dice dice(55, 0.3);
    for (int round = 0; round < 300; ++round) {
        std::vector<glm::vec4> any(6);
        for (glm::vec4& pixel : any) pixel = {dice.single_place(), dice.single(0.0, 1.0)};
        returns([&] { (void)colour::screen_color({any, 2}); });
        const glm::dvec3 color = dice.place();
        returns([&] { (void)colour::judge_screen({any, 2}, color); });
    }
}

TEST_CASE("walkers of arbitrary numbers are refused or give finite results", "[fuzz]") {
    Dice dice(56, 0.004), wild(57, 0.3);
    for (int round = 0; round < 150; ++round) {
        walker::Way way;
        way.times = dice.rising(6);
        for (std::size_t i = 0; i < way.times.size(); ++i) {
            glm::dmat4 pose = dice.matrix();
            pose[3] = glm::dvec4(0.2 * static_cast<double>(i), 0.0, dice.number(0.0, 0.2), 1.0);
            way.poses.push_back(pose);
        }
        way.rest = dice.places(3);
        way.phases = dice.numbers(3);
        way.duty = dice.number(0.1, 0.9);
        way.stride = dice.number(0.2, 1.0);
        way.up = dice.place();
        walker::WalkSettings settings;
        settings.clearance = dice.number(0.0, 0.2);
        settings.minimum_step = dice.number(0.0, 0.1);
        settings.tilt = dice.number(0.0, 1.0);
        walker::Soles& soles = settings.soles;
        soles.forward = dice.place();
        for (double* length : {&soles.ankle, &soles.heel, &soles.toe}) *length = dice.number(0.0, 0.3);
        for (double* pitch : {&soles.strike, &soles.push}) *pitch = dice.number(0.0, 1.5);
        std::optional<walker::Plane> plane;
        returns([&] {
            plane = walker::Plane{wild.chance(0.9) ? glm::dvec3(0.0) : wild.place(), dice.place()};
            const walker::Ground ground({}, {}, plane, 1);
            const double far = wild.number();
            (void)ground.ray(wild.place(), wild.place(), far);
            const walker::Walker walker(way, settings, &ground, 1);
            const double time = wild.number();
            returns([&] {
                for (std::size_t leg = 0; leg < 4; ++leg) {
                    const walker::Foot foot = walker.foot(leg, time);
                    CHECK((is_finite(foot.position) && is_finite(foot.turn)));
                }
            });
            returns([&] {
                const walker::Correction body = walker.body(time);
                CHECK((is_finite(body.offset) && is_finite(body.rotation)));
            });
            returns([&] {
                const double phase = walker.phase(time);
                CHECK(!std::isnan(phase));
            });
        });
        returns([&] {
            (void)walker::pattern_of(static_cast<walker::Gait>(wild.whole(0, 5)), wild.places(wild.below(5)),
                                     wild.place(), wild.place());
        });
    }
}

TEST_CASE("a moved-from ground still answers, and a moved-from walker refuses", "[fuzz]") {
    walker::Way way;
    way.times = {0.0, 1.0};
    way.poses = {glm::dmat4(1.0), glm::dmat4(1.0)};
    way.rest = {{0.3, 0.3, 0.0}, {-0.3, 0.3, 0.0}};
    way.phases = {0.0, 0.5};
    const std::vector<glm::vec3> corners{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    const std::vector<glm::ivec3> triangles{{0, 1, 2}};
    walker::Ground ground(corners, triangles, std::nullopt);
    const walker::Ground taken = std::move(ground);
    // NOLINTBEGIN(bugprone-use-after-move): what this is about
    CHECK(ground.vertex_count() == 3);
    CHECK(ground.ray({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 2.0));
    walker::Walker walker(way, {}, &taken);
    const walker::Walker moved = std::move(walker);
    CHECK(moved.phase(0.5) == Approx(0.5));
    CHECK(is_refused([&] { (void)walker.phase(0.5); }, "stretch"));
    CHECK(is_refused([&] { (void)walker.foot(0, 0.5); }, "leg"));
    CHECK(returns([&] { (void)walker.body(0.5); }) == false);
    // NOLINTEND(bugprone-use-after-move)
    const walker::BodyTrajectory trajectory(way);
    CHECK(is_refused([&] { (void)trajectory.pose(1, 0.0); }, "stretch"));
    CHECK(is_refused([&] { (void)trajectory.last_sample(1); }, "stretch"));
    CHECK(is_refused([] { (void)walker::step_at({}, 0.0); }, "steps"));
    CHECK(is_refused([] { (void)walker::Footsteps().of(0); }, "row"));
}
