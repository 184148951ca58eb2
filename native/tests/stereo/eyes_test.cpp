#include "motus/stereo/eyes.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "random.hpp"

using namespace motus::stereo;
using motus::test::Random;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array modes{ConvergenceMode::off_axis, ConvergenceMode::parallel, ConvergenceMode::toe_in};

[[nodiscard]] Eyes any_eyes(Random& random, ConvergenceMode mode) {
    const double interaxial = random.between(0.01, 0.2);
    const double focal_length = random.between(18.0, 85.0);
    const double sensor_width = random.between(20.0, 50.0);
    return {interaxial, focal_length, sensor_width, random.between(1.0, 8.0), mode};
}

}  // namespace

TEST_CASE("the budget of a lens of 35 mm from 2 m to 10 m is the one in the books", "[stereo]") {
    const Eyes eyes = fit_budget({0.065, 35.0, 36.0, 2.0}, {2.0, 10.0}, {0.01, 0.02});
    CHECK(eyes.interaxial == Approx(0.0771428571428571).epsilon(1e-12));
    CHECK(eyes.convergence == Approx(2.7272727272727273).epsilon(1e-12));
}

TEST_CASE("a budget is taken exactly, and gives its depths back", "[stereo]") {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const double near = random.between(0.1, 10.0);
        const Range range{near, i % 10 == 0 ? infinity : near * random.between(1.01, 100.0)};
        const Limits limits{random.between(0.0, 0.05), random.between(1e-4, 0.05)};
        const Eyes eyes = fit_budget(any_eyes(random, ConvergenceMode::off_axis), range, limits);
        CHECK(parallax(eyes, range.near) == Approx(-limits.near).margin(1e-13));
        CHECK(parallax(eyes, range.far) == Approx(limits.far).margin(1e-13));
        const Range back = depths_within(eyes, limits);
        CHECK(back.near == Approx(range.near).epsilon(1e-9));
        if (std::isfinite(range.far)) CHECK(1.0 / back.far == Approx(1.0 / range.far).margin(1e-9));
    }
}

TEST_CASE("depths within limits have just that parallax in every mode", "[stereo]") {
    Random random(2);
    for (const ConvergenceMode mode : modes) {
        for (int i = 0; i < 200; ++i) {
            const Eyes eyes = any_eyes(random, mode);
            const Limits limits{random.between(0.001, 0.02), random.between(0.001, 0.02)};
            const auto [near, far] = depths_within(eyes, limits);
            CHECK(parallax(eyes, near) == Approx(-limits.near).margin(1e-12));
            if (std::isfinite(far))
                CHECK(parallax(eyes, far) == Approx(limits.far).margin(1e-12));
            else
                CHECK(parallax(eyes, 1e9) <= limits.far);
        }
    }
}

TEST_CASE("parallax is the difference of what both eyes see", "[stereo]") {
    Random random(3);
    for (const ConvergenceMode mode : modes) {
        for (int i = 0; i < 200; ++i) {
            const Eyes eyes = any_eyes(random, mode);
            const double depth = random.between(0.5, 50.0);
            const double aside = mode == ConvergenceMode::toe_in ? 0.0 : random.between(-1.0, 1.0);
            const Pair pair = project(eyes, {aside, random.between(-1.0, 1.0), depth});
            CHECK(pair.right.x - pair.left.x == Approx(parallax(eyes, depth)).margin(1e-12));
            if (aside == 0.0) CHECK(pair.right.x == Approx(-pair.left.x).margin(1e-12));
            CHECK(pair.right.y == Approx(pair.left.y).margin(1e-12));
        }
    }
}

TEST_CASE("a point at the convergence distance lies on the screen", "[stereo]") {
    Random random(4);
    for (const ConvergenceMode mode : {ConvergenceMode::off_axis, ConvergenceMode::toe_in}) {
        const Eyes eyes = any_eyes(random, mode);
        CHECK(parallax(eyes, eyes.convergence) == Approx(0.0).margin(1e-15));
    }
    const Eyes parallel = any_eyes(random, ConvergenceMode::parallel);
    CHECK(parallax(parallel, infinity) == 0.0);
    CHECK(parallax(parallel, 3.0) < 0.0);
}

TEST_CASE("only eyes that toe in move corners up and down", "[stereo]") {
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        const Eyes eyes = any_eyes(random, ConvergenceMode::toe_in);
        CHECK(vertical_parallax(eyes, eyes.convergence, 16.0 / 9.0) > 0.0);
        Eyes parallel = eyes;
        parallel.mode = ConvergenceMode::off_axis;
        CHECK(vertical_parallax(parallel, eyes.convergence, 16.0 / 9.0) == 0.0);
        // Small angles: keystone of both images, t / dc of a corner's place right times its place up.
        Eyes slight = eyes;
        slight.interaxial = 1e-5;
        const double s_f = slight.sensor_width / slight.focal_length;
        const double expected = slight.interaxial / slight.convergence * 0.5 * s_f * 0.5 / (16.0 / 9.0);
        CHECK(vertical_parallax(slight, slight.convergence, 16.0 / 9.0) == Approx(expected).epsilon(1e-3));
    }
}

TEST_CASE("one eye sees no depth", "[stereo]") {
    const Eyes eyes{0.0, 50.0, 36.0, 2.0};
    CHECK(parallax(eyes, 5.0) == 0.0);
    const auto [near, far] = depths_within(eyes, {0.01, 0.01});
    CHECK(near == 0.0);
    CHECK(far == infinity);
}

TEST_CASE("camera settings outside their domain are refused by their names", "[stereo]") {
    const Eyes good;
    CHECK_THROWS_AS(parallax({-1.0, 50.0, 36.0, 2.0}, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(parallax({0.1, 0.0, 36.0, 2.0}, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(parallax({0.1, 50.0, 0.0, 2.0}, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(parallax({0.1, 50.0, 36.0, 0.0}, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(parallax(good, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(parallax(good, std::nan("")), std::invalid_argument);
    CHECK_THROWS_AS(project(good, {0.0, 0.0, 0.0}), std::invalid_argument);
    CHECK_THROWS_AS(fit_budget(good, {0.0, 1.0}, {0.01, 0.01}), std::invalid_argument);
    CHECK_THROWS_AS(fit_budget(good, {2.0, 2.0}, {0.01, 0.01}), std::invalid_argument);
    CHECK_THROWS_AS(fit_budget(good, {1.0, 2.0}, {0.0, 0.0}), std::invalid_argument);
    CHECK_THROWS_AS(fit_budget(good, {1.0, 2.0}, {-0.1, 0.2}), std::invalid_argument);
    CHECK_THROWS_AS(vertical_parallax(good, 1.0, 0.0), std::invalid_argument);
}
