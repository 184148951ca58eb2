#include "motus/dynamics/wave.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "random.hpp"

using namespace motus;
using namespace motus::dynamics;

TEST_CASE("waves have the values of their formulas", "[wave]") {
    test::Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const double place = random.between(-50.0, 50.0);
        const double angle = 2.0 * std::numbers::pi * place;
        CHECK(wave(Wave::sine, place) == Approx(std::sin(angle)).margin(1e-12));
        CHECK(wave(Wave::triangle, place) ==
              Approx(std::asin(std::sin(angle)) * 2.0 / std::numbers::pi).margin(1e-6));
        CHECK(wave(Wave::saw, place) == Approx(2.0 * (place - std::floor(place)) - 1.0).margin(1e-12));
        CHECK(wave(Wave::square, place) == (std::sin(angle) >= 0.0 ? 1.0 : -1.0));
    }
    CHECK(wave(Wave::square, 7.19, 0.2) == 1.0);
    CHECK(wave(Wave::square, -0.79, 0.2) == -1.0);
    CHECK(wave(Wave::square, 3.0, 0.0) == -1.0);
    CHECK(wave(Wave::square, 3.999, 1.0) == 1.0);
}

TEST_CASE("a wave is the same bits a whole number of waves later", "[wave]") {
    for (const Wave shape : {Wave::sine, Wave::triangle, Wave::saw, Wave::square})
        for (int i = 0; i < 64; ++i) {
            const double place = i / 64.0;
            CHECK(wave(shape, place, 0.3) == wave(shape, place + 1000.0, 0.3));
            CHECK(wave(shape, place, 0.3) == wave(shape, place - 1000.0, 0.3));
        }
}

TEST_CASE("a wave of no number is no number, and a share beyond the wave is refused", "[wave]") {
    constexpr double endless = std::numeric_limits<double>::infinity();
    for (const Wave shape : {Wave::sine, Wave::triangle, Wave::saw, Wave::square})
        for (const double place : {endless, -endless, std::nan("")}) CHECK(std::isnan(wave(shape, place)));
    CHECK_THROWS_WITH(wave(Wave::square, 0.0, 1.5), "share: must be from 0 to 1");
    CHECK_THROWS_WITH(wave(Wave::square, 0.0, std::nan("")), "share: must be from 0 to 1");
}
