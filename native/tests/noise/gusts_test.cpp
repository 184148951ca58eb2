#include "motus/noise/gusts.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

using namespace motus::noise;

TEST_CASE("gusts are four sine waves", "[noise][gusts]") {
    const Gusts gusts(0.3);
    double highest = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double time = 0.05 * i - 100.0, turn = 2.0 * std::numbers::pi * 0.3 * time;
        const double wanted = 0.4 * std::sin(turn) +
                              0.3 * std::sin((1.0 + std::sqrt(5.0)) / 2.0 * turn + 1.0) +
                              0.2 * std::sin((1.0 + std::sqrt(2.0)) * turn + 2.0) +
                              0.1 * std::sin((3.0 + std::sqrt(13.0)) / 2.0 * turn + 3.0);
        CHECK(gusts.value(time) == Approx(wanted).margin(1e-11));
        highest = std::max(highest, std::abs(gusts.value(time)));
    }
    CHECK(highest > 0.9);
    CHECK(highest <= 1.0);
}

TEST_CASE("gusts with a period begin again after it", "[noise][gusts]") {
    for (const double period : {0.1, 2.0, 10.4, 41.7}) {
        const Gusts gusts(0.3, period);
        for (int i = 0; i < 50; ++i) {
            const double time = 0.13 * i * period;
            CHECK(gusts.value(time + period) == Approx(gusts.value(time)).margin(1e-11));
        }
        // In a long period no wave is far from its own rate.
        for (std::size_t i = 0; i < Gusts::count && period > 10.0; ++i)
            CHECK(gusts.waves()[i].rate == Approx(Gusts(0.3).waves()[i].rate).epsilon(0.2));
    }
}

TEST_CASE("gusts at many times are those at each", "[noise][gusts]") {
    const Gusts gusts(1.7, 3.0);
    const std::vector<double> times{-4.0, 0.0, 0.5, 1e6};
    std::vector<double> found(times.size());
    values(gusts, times, found);
    for (std::size_t i = 0; i < times.size(); ++i) CHECK(found[i] == gusts.value(times[i]));
    found.pop_back();
    CHECK_THROWS_AS(values(gusts, times, found), std::invalid_argument);
}

TEST_CASE("gusts refuse what is outside of their domain", "[noise][gusts]") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, 1000.5, nan}) CHECK_THROWS_AS(Gusts(bad), std::invalid_argument);
    for (const double bad : {-1.0, 1e-7, 2e30, nan, std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(Gusts(1.0, bad), std::invalid_argument);
    CHECK(std::isnan(Gusts(1.0).value(nan)));
}
