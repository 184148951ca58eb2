#include "motus/stereo/screen.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "random.hpp"

using namespace motus::stereo;
using motus::test::Random;

TEST_CASE("eyes diverge behind 0.54 % of a cinema's screen and 10.8 % of a monitor", "[stereo]") {
    CHECK(divergence_limit({12.0, 15.0, 0.065}) == Approx(0.0054).margin(5e-5));
    CHECK(divergence_limit({0.6, 0.7, 0.065}) == Approx(0.108).margin(5e-4));
}

TEST_CASE("a point without parallax is seen on the screen", "[stereo]") {
    const Screen screen{2.0, 3.0, 0.065};
    CHECK(seen_distance(screen, 0.0) == Approx(3.0));
    CHECK(seen_distance(screen, -0.065 / 2.0) == Approx(1.5));  // the eyes' lines cross half way
    CHECK(std::isinf(seen_distance(screen, divergence_limit(screen))));
    CHECK(std::isinf(seen_distance(screen, 1.0)));
}

TEST_CASE("the limits of comfort differ by their angle from the screen", "[stereo]") {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const double width = random.between(0.05, 20.0);
        const Screen screen{width, width * random.between(0.5, 3.0), random.between(0.05, 0.07)};
        const auto [near, far] = comfortable(screen);
        CHECK(near > 0.0);
        CHECK(vergence(screen, -near) - vergence(screen, 0.0) == Approx(one_degree).epsilon(1e-9));
        CHECK(far <= divergence_limit(screen) * (1.0 + 1e-12));
        if (vergence(screen, 0.0) > one_degree)
            CHECK(vergence(screen, 0.0) - vergence(screen, far) == Approx(one_degree).epsilon(1e-9));
        CHECK(comfort(screen, 0.0) == Comfort::comfortable);
        CHECK(comfort(screen, -1.01 * near) == Comfort::strained);
        CHECK(comfort(screen, 1.01 * divergence_limit(screen)) == Comfort::diverging);
    }
}

TEST_CASE("roundness is the depth of a small ball by its width, however the eyes converge", "[stereo]") {
    Random random(2);
    const Screen cinema{12.0, 15.0, 0.065}, monitor{0.6, 0.9, 0.065};
    CHECK(roundness(cinema, {0.02, 35.0, 36.0, 4.0}, 4.0) == Approx(15.0 * 0.02 / (0.065 * 4.0)));
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const ConvergenceMode mode :
         {ConvergenceMode::off_axis, ConvergenceMode::parallel, ConvergenceMode::toe_in}) {
        for (int i = 0; i < 100; ++i) {
            const bool is_near = i % 2 == 1;  // eyes that turn by up to some ten degrees
            const Screen& screen = is_near ? monitor : cinema;
            const double nearest = is_near ? 1.5 : 3.0, farthest = is_near ? 2.5 : 5.0;
            const Eyes eyes{is_near ? 0.5 : 0.02, 35.0, 36.0,
                            i % 10 == 0 ? infinite
                            : is_near   ? 2.0
                                        : 4.0,
                            mode};
            const double depth = random.between(nearest, farthest), small = 1e-5;
            const auto seen = [&](double at) { return seen_distance(screen, parallax(eyes, at)); };
            if (std::isinf(seen(depth + small))) {
                CHECK(std::isinf(roundness(screen, eyes, depth + small)));
                continue;
            }
            const double deep = (seen(depth + small) - seen(depth - small)) / (2.0 * small);
            // Where both eyes' images of the ball's right and left side are, in their middle.
            const auto side = [&](double right) {
                const Pair images = project(eyes, {right, 0.0, depth});
                return 0.5 * (images.left.x + images.right.x);
            };
            const double magnified = screen.width * (side(small) - side(-small)) / (2.0 * small);
            const double wide = magnified * seen(depth) / screen.viewing_distance;
            CHECK(roundness(screen, eyes, depth) == Approx(deep / wide).epsilon(1e-5));
        }
    }
    CHECK(std::isinf(roundness(cinema, {0.2, 35.0, 36.0, 4.0}, 1000.0)));
}

TEST_CASE("screen settings outside their domain are refused by their names", "[stereo]") {
    CHECK_THROWS_AS(divergence_limit({0.0, 1.0, 0.065}), std::invalid_argument);
    CHECK_THROWS_AS(seen_distance({1.0, 0.0, 0.065}, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(comfortable({1.0, 1.0, 0.0}), std::invalid_argument);
    CHECK_THROWS_AS(comfortable({1.0, 1.0, 0.065}, 0.0), std::invalid_argument);
}
