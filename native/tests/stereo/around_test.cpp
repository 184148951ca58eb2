#include "motus/stereo/around.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "random.hpp"

using namespace motus::stereo;
using motus::test::Random;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degree = std::numbers::pi / 180.0;

}  // namespace

TEST_CASE("parallax at the horizon is the difference of two arcsines", "[stereo]") {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const double interaxial = random.between(0.01, 0.3);
        const double convergence = random.between(0.5, 20.0);
        const double distance = random.between(0.3, 50.0);
        const EyesAround eyes{interaxial, convergence};
        const double ray = 0.5 * interaxial * std::cos(std::atan2(0.5 * interaxial, convergence));
        const double wanted = 2.0 * (std::asin(ray / convergence) - std::asin(ray / distance));
        CHECK(parallax(eyes, distance) == Approx(wanted).margin(1e-14));
        CHECK(parallax(EyesAround{interaxial, infinity}, distance) ==
              Approx(-2.0 * std::asin(0.5 * interaxial / distance)).margin(1e-14));
    }
    CHECK(parallax({0.065, 2.0}, infinity) == Approx(2.0 * std::atan(0.0325 / 2.0)).margin(1e-15));
    CHECK(parallax({0.065, 2.0}, 1e30) == Approx(parallax({0.065, 2.0}, infinity)).margin(1e-15));
    CHECK(parallax({0.065, infinity}, infinity) == 0.0);
}

TEST_CASE("points on the rays of both eyes have this parallax at any elevation", "[stereo]") {
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const double elevation = random.between(-85.0, 85.0) * degree;
        const EyesAround eyes{random.between(0.01, 0.3), random.between(0.5, 20.0), 60.0 * degree,
                              75.0 * degree};
        const double aside = 0.5 * interaxial_at(eyes, elevation);
        // Forward is y: the ray of the right eye, at some distance along it.
        const glm::dvec3 start(aside, 0.0, 0.0);
        const glm::dvec3 on_sphere =
            eyes.convergence * glm::dvec3(0.0, std::cos(elevation), std::sin(elevation));
        const glm::dvec3 point = start + random.between(0.3, 30.0) * glm::normalize(on_sphere - start);
        const double azimuth = std::atan2(point.x, point.y);
        CHECK(parallax(eyes, glm::length(point), elevation) == Approx(-2.0 * azimuth).margin(1e-12));
    }
}

TEST_CASE("eyes approach between two elevations, and are one at the pole", "[stereo]") {
    const EyesAround eyes{0.1, 2.0, 60.0 * degree, 80.0 * degree};
    CHECK(interaxial_at(eyes, 0.0) == 0.1);
    CHECK(interaxial_at(eyes, -60.0 * degree) == 0.1);
    CHECK(interaxial_at(eyes, 70.0 * degree) == Approx(0.1 * std::cos(45.0 * degree)));
    CHECK(interaxial_at(eyes, 80.0 * degree) == Approx(0.0).margin(1e-12));
    CHECK(interaxial_at(eyes, -90.0 * degree) == 0.0);
    CHECK(parallax(eyes, 5.0, 85.0 * degree) == 0.0);
    CHECK(interaxial_at({0.1, 2.0}, 90.0 * degree) == 0.1);
    CHECK(interaxial_at({0.1, 2.0, 0.5, 0.5}, 0.5) == 0.1);
    CHECK(interaxial_at({0.1, 2.0, 0.5, 0.5}, 0.51) == 0.0);
}

TEST_CASE("eyes around refuse what is outside their domain", "[stereo]") {
    CHECK_THROWS_AS(check(EyesAround{-0.1, 2.0}), std::invalid_argument);
    CHECK_THROWS_AS(check(EyesAround{0.1, 0.0}), std::invalid_argument);
    CHECK_THROWS_AS(check(EyesAround{0.1, 2.0, 1.0, 0.9}), std::invalid_argument);
    CHECK_THROWS_AS(check(EyesAround{0.1, 2.0, 1.0, 1.6}), std::invalid_argument);
    CHECK_THROWS_AS(interaxial_at({0.1, 2.0}, 1.6), std::invalid_argument);
    CHECK_THROWS_AS(parallax(EyesAround{0.1, 2.0}, 0.049), std::invalid_argument);
    CHECK_NOTHROW(parallax(EyesAround{0.1, 2.0}, 0.05));
}
