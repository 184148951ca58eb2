#include "motus/stereo/scene_depth.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus::stereo;
using motus::test::Random;

TEST_CASE("near and far are quantiles, whatever the order", "[stereo]") {
    Random random(1);
    std::vector<double> depths;
    for (int i = 0; i <= 100; ++i) depths.push_back(1.0 + i);
    for (std::size_t i = depths.size(); i > 1; --i) std::swap(depths[i - 1], depths[random.below(i)]);
    const auto found = depth_range(depths, 0.05, 0.955);
    REQUIRE(found);
    CHECK(found->near == Approx(6.0));
    CHECK(found->far == Approx(96.5));
    const auto all = depth_range(depths, 0.0, 1.0);
    REQUIRE(all);
    CHECK(all->near == 1.0);
    CHECK(all->far == 101.0);
}

TEST_CASE("only depths in front of the camera count", "[stereo]") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> depths{0.0, -3.0, infinity, std::nan(""), 4.0};
    const auto found = depth_range(depths, 0.0, 1.0);
    REQUIRE(found);
    CHECK(found->near == 4.0);
    CHECK(found->far == 4.0);
    CHECK_FALSE(depth_range(std::vector<double>{infinity, 0.0}, 0.0, 1.0));
    CHECK_FALSE(depth_range({}, 0.0, 1.0));
    CHECK_THROWS_AS(depth_range(depths, 0.5, 0.5), std::invalid_argument);
    CHECK_THROWS_AS(depth_range(depths, -0.1, 0.5), std::invalid_argument);
}

TEST_CASE("the window is violated if one eye alone sees something in front of the screen", "[stereo]") {
    const Eyes eyes{0.1, 50.0, 36.0, 4.0};
    const double near = -parallax(eyes, 2.0);
    const auto at = [&](double x, double depth) {
        const Sample sample{x, depth};
        return window_violations(eyes, {&sample, 1}, 1e-3);
    };
    CHECK(at(-0.5, 2.0).left == Approx(near));
    CHECK(at(-0.5, 2.0).right == 0.0);
    CHECK(at(0.5, 2.0).right == Approx(near));
    CHECK(at(0.5, 2.0).left == 0.0);
    CHECK(at(-0.5, 8.0).left == 0.0);
    CHECK(at(0.5 - 0.51 * near, 2.0).right == 0.0);
    CHECK(at(0.5 - 0.49 * near, 2.0).right == Approx(near));
    CHECK(at(0.5, 3.999).right == 0.0);  // less than the tolerance
    CHECK(at(0.5, -1.0).right == 0.0);
    // The eyes' own images agree.
    const double to_edge = 0.5 * 36.0 / 50.0 * 2.0;
    const Pair pair = project(eyes, {to_edge, 0.0, 2.0});
    CHECK(pair.left.x > 0.5);
    CHECK(pair.right.x < 0.5);
}

TEST_CASE("smooth curves stay on their side, and constant ones are not changed", "[stereo]") {
    Random random(2);
    for (const std::size_t ahead : {std::size_t{0}, std::size_t{1}, std::size_t{12}, std::size_t{500}}) {
        std::vector<double> values(120), out(120);
        for (double& value : values) value = random.between(1.0, 20.0);
        smooth(values, ahead, Side::below, out);
        for (std::size_t i = 0; i < values.size(); ++i) CHECK(out[i] <= values[i] + 1e-12);
        smooth(values, ahead, Side::above, out);
        for (std::size_t i = 0; i < values.size(); ++i) CHECK(out[i] >= values[i] - 1e-12);
        std::ranges::fill(values, 3.7);
        smooth(values, ahead, Side::either, out);
        CHECK(out == values);
    }
}

TEST_CASE("a smooth curve leads as much as it lags", "[stereo]") {
    std::vector<double> step(101), out(101), mirrored(101);
    for (std::size_t i = 0; i < step.size(); ++i) step[i] = i < 50 ? 0.0 : i > 50 ? 1.0 : 0.5;
    smooth(step, 10, Side::either, out);
    CHECK(out[50] == Approx(0.5));
    CHECK(out[39] == 0.0);
    CHECK(out[61] == Approx(1.0));
    CHECK(out[45] + out[55] == Approx(1.0));
    for (std::size_t i = 1; i < out.size(); ++i) CHECK(out[i] >= out[i - 1] - 1e-15);
    smooth(step, 0, Side::either, out);
    CHECK(out == step);
    CHECK_THROWS_AS(smooth(step, 1, Side::either, std::span(out).first(3)), std::invalid_argument);
    smooth({}, 5, Side::below, {});
}

TEST_CASE("a smooth curve looks ahead no further than its work is bounded", "[stereo]") {
    const std::vector<double> values{1.0, 2.0, 3.0};
    std::vector<double> out(3);
    smooth(values, most_ahead, Side::below, out);
    CHECK(out == std::vector<double>(3, 1.0));
    for (const Side side : {Side::either, Side::below, Side::above})
        CHECK_THROWS_WITH(smooth(values, most_ahead + 1, side, out), Catch::Matchers::StartsWith("ahead: "));
}
