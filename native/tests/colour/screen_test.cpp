#include "motus/colour/screen.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "random.hpp"

using namespace motus::colour;
using motus::test::Random;

namespace {

const glm::dvec3 green{0.05, 0.45, 0.08};
const glm::dvec3 blue{0.04, 0.09, 0.5};
const glm::dvec3 skin{0.55, 0.32, 0.22};

/// A subject of a colour, a disc of a third of the height, in front of a screen that grows dark to the right.
struct Footage {
    static constexpr std::size_t width = 96, height = 64;

    Footage(const glm::dvec3& screen, const glm::dvec3& subject, double dark, double noise) {
        Random random(3);
        for (std::size_t i = 0; i < width * height; ++i) {
            const double x = static_cast<double>(i % width) - 48.0, y = static_cast<double>(i / width) - 32.0;
            const double light = 1.0 - dark * static_cast<double>(i % width) / width;
            const bool is_subject = std::hypot(x, y) < 21.0;
            const glm::dvec3 color = (is_subject ? subject : light * screen) + noise * random.around_origin();
            pixels.emplace_back(glm::vec3(color), 1.0F);
        }
    }

    [[nodiscard]] Picture picture() const { return {pixels, width}; }

    std::vector<glm::vec4> pixels;
};

}  // namespace

TEST_CASE("the screen's colour is found", "[colour]") {
    for (const glm::dvec3& screen : {green, blue}) {
        const auto found = screen_color(Footage(screen, skin, 0.0, 0.0).picture());
        REQUIRE(found);
        CHECK(glm::distance(*found, screen) < 1e-6);
        const auto uneven = screen_color(Footage(screen, skin, 0.4, 0.01).picture());
        REQUIRE(uneven);
        CHECK(glm::distance(*uneven, 0.8 * screen) < 0.03);
    }
}

TEST_CASE("a subject in the colour of another kind of screen is not taken for the screen", "[colour]") {
    const auto found = screen_color(Footage(green, blue, 0.2, 0.005).picture());
    REQUIRE(found);
    CHECK(found->y > found->z);
}

TEST_CASE("a picture without a screen gives no screen colour", "[colour]") {
    CHECK_FALSE(screen_color(Footage(skin, 0.5 * skin, 0.3, 0.01).picture()));
    CHECK_FALSE(screen_color(Footage({0.4, 0.4, 0.4}, {0.0, 0.0, 0.0}, 0.0, 0.0).picture()));
    Footage transparent(green, skin, 0.0, 0.0);
    for (glm::vec4& pixel : transparent.pixels) pixel.w = 0.0F;
    CHECK_FALSE(screen_color(transparent.picture()));
}

TEST_CASE("the screen of a picture of one pixel is found and judged", "[colour]") {
    const std::vector<glm::vec4> one{{0.1F, 0.5F, 0.1F, 1.0F}}, grey{{0.5F, 0.5F, 0.5F, 1.0F}};
    const auto found = screen_color({one, 1});
    REQUIRE(found);
    CHECK(found->y == Approx(0.5));
    CHECK_FALSE(screen_color({grey, 1}));
    const ScreenQuality report = judge_screen({one, 1}, *found);
    CHECK(report.share == 1.0);
    CHECK(report.luminance_spread == 0.0);
    CHECK(report.black == 0.0);
    CHECK(report.white == 1.0);
}

TEST_CASE("a few green pixels are no screen", "[colour]") {
    std::vector<glm::vec4> pixels(10000, {0.4F, 0.4F, 0.4F, 1.0F});
    for (std::size_t i = 4000; i < 4060; ++i) pixels[i] = {0.1F, 0.6F, 0.1F, 1.0F};
    CHECK_FALSE(screen_color({pixels, 100}));
}

TEST_CASE("the matte of mixtures of screen and grey is the share of grey", "[colour]") {
    const glm::dvec3 grey{0.3, 0.3, 0.3};
    for (const glm::dvec3& screen : {green, blue}) {
        for (double balance = 0.0; balance <= 1.0; balance += 0.25) {
            CHECK(matte(screen, screen, {balance}) == Approx(0.0).margin(1e-12));
            CHECK(matte(1.5 * screen, screen, {balance}) == 0.0);
            for (const double bright : {0.3, 0.8, 1.0, 40.0})
                for (double alpha = 0.0; alpha <= 1.0; alpha += 0.125)
                    CHECK(matte(alpha * bright * grey / 0.3 + (1.0 - alpha) * screen, screen, {balance}) ==
                          Approx(alpha).margin(1e-9));
        }
    }
    CHECK(matte(skin, green) == 1.0);
}

TEST_CASE("the balance weighs the larger channel against the smaller", "[colour]") {
    // m is 0.4 less a mixture of 0.1 and 0.3; of the screen it is 0.4 - 0.05 = 0.35.
    const glm::dvec3 screen{0.05, 0.4, 0.05};
    for (const glm::dvec3& pixel : {glm::dvec3(0.1, 0.4, 0.3), glm::dvec3(0.3, 0.4, 0.1)}) {
        CHECK(matte(pixel, screen, {0.0}) == Approx(1.0 - 0.1 / 0.35));
        CHECK(matte(pixel, screen, {0.5}) == Approx(1.0 - 0.2 / 0.35));
        CHECK(matte(pixel, screen, {1.0}) == Approx(1.0 - 0.3 / 0.35));
        CHECK(matte(pixel, screen, {0.0, 2.0}) == Approx(1.0 - 0.2 / 0.35));
    }
    // Yellow and cyan hold as much red or blue as green.
    CHECK(matte({0.9, 0.8, 0.1}, screen) == 1.0);
    CHECK(matte({0.1, 0.8, 0.9}, screen) == 1.0);
}

TEST_CASE("the report tells an even screen from an uneven one", "[colour]") {
    const ScreenQuality even = judge_screen(Footage(green, skin, 0.0, 0.0).picture(), green);
    CHECK(even.share == Approx(1.0 - 3.14159 * 21.0 * 21.0 / (96.0 * 64.0)).margin(0.02));
    CHECK(even.luminance_spread == Approx(0.0).margin(1e-6));
    CHECK(even.chroma_spread == Approx(0.0).margin(1e-6));
    CHECK(even.black == Approx(0.0).margin(1e-6));
    CHECK(even.white == 1.0);
    CHECK(even.spill == 0.0);

    const ScreenQuality uneven = judge_screen(Footage(green, skin, 0.4, 0.0).picture(), 0.8 * green);
    CHECK(uneven.luminance_spread == Approx(0.9 * 0.4 / 0.8).margin(0.06));
    CHECK(uneven.chroma_spread == Approx(0.0).margin(1e-6));
    CHECK(uneven.black == Approx(1.0 - 0.6 / 0.8).margin(0.03));

    const ScreenQuality noisy = judge_screen(Footage(green, skin, 0.0, 0.01).picture(), green);
    CHECK(noisy.chroma_spread > 0.01);
    CHECK(noisy.black > 0.03);
    // However strong the noise is, of the screen nearly all lies below that level.
    const Footage grainy(green, skin, 0.3, 0.03);
    const ScreenQuality found = judge_screen(grainy.picture(), 0.85 * green);
    std::size_t above = 0, count = 0;
    for (std::size_t i = 0; i < Footage::width * Footage::height; ++i) {
        const double x = static_cast<double>(i % Footage::width) - 48.0,
                     y = static_cast<double>(i / Footage::width) - 32.0;
        if (std::hypot(x, y) < 25.0) continue;
        ++count;
        above += matte(glm::dvec3(grainy.pixels[i]), 0.85 * green) > found.black ? 1U : 0U;
    }
    CHECK(static_cast<double>(above) < 0.03 * static_cast<double>(count));
    CHECK(found.share == Approx(even.share).margin(0.03));
}

TEST_CASE("the matte's levels are measured with the given balance", "[colour]") {
    // In a screen whose red varies from 0.01 to 0.13 the larger other channel goes up to 0.13, their mean to
    // 0.105.
    Footage varied({0.07, 0.42, 0.08}, {0.5, 0.33, 0.25}, 0.0, 0.0);
    for (std::size_t i = 0; i < varied.pixels.size(); ++i)
        if (varied.pixels[i].x < 0.3F) varied.pixels[i].x = 0.01F + 0.12F * static_cast<float>(i % 7) / 6.0F;
    const glm::dvec3 screen{0.07, 0.42, 0.08};
    const auto report = [&](double balance) { return judge_screen(varied.picture(), screen, {balance}); };
    CHECK(report(0.0).black == Approx(1.0 - 0.29 / 0.34).margin(1e-5));
    CHECK(report(0.5).black == Approx(1.0 - 0.315 / 0.345).margin(1e-5));
    CHECK(report(0.0).white == 1.0);
    CHECK(report(1.0).white == Approx(1.0 - 0.08 / 0.35).margin(1e-5));
}

TEST_CASE("pixels of a soft edge do not count as subject", "[colour]") {
    for (const double grey : {0.1, 0.8, 3.0}) {
        Footage soft(blue, skin, 0.0, 0.0);
        for (std::size_t i = 0; i < soft.pixels.size(); ++i) {
            const double x = static_cast<double>(i % Footage::width) - 48.0,
                         y = static_cast<double>(i / Footage::width) - 32.0;
            const double alpha = glm::clamp((22.0 - std::hypot(x, y)) / 6.0, 0.0, 1.0);
            soft.pixels[i] = glm::vec4(glm::vec3(alpha * grey + (1.0 - alpha) * blue), 1.0F);
        }
        const ScreenQuality report = judge_screen(soft.picture(), blue);
        CHECK(report.white == Approx(1.0));
        CHECK(report.black == Approx(0.0).margin(1e-6));
        CHECK(report.spill == Approx(0.0).margin(1e-6));
    }
}

TEST_CASE("colours outside the gamut give finite results", "[colour]") {
    // Parts below 0, whose sum is 0.
    const glm::dvec3 wide{-0.5, 1.0, -0.5};
    const ScreenQuality report = judge_screen(Footage(wide, skin, 0.0, 0.0).picture(), green);
    CHECK(report.share > 0.5);
    CHECK(report.chroma_spread == Approx(0.0).margin(1e-6));
    CHECK(report.luminance_spread == Approx(0.0).margin(1e-6));
}

TEST_CASE("spill is measured on the subject", "[colour]") {
    const glm::dvec3 lit{0.3, 0.3 + 0.1 * (0.45 - 0.08), 0.3};
    const ScreenQuality report = judge_screen(Footage(green, lit, 0.0, 0.0).picture(), green);
    CHECK(report.spill == Approx(0.1).margin(1e-3));
    CHECK(report.white < 1.0);
    CHECK(report.white > 0.8);
}

TEST_CASE("a colour as green as it is blue is a screen's from the balance on at which it exceeds the others",
          "[colour]") {
    for (const glm::dvec3& cyan :
         {glm::dvec3(0.0, 0.6, 0.6), glm::dvec3(0.3, 0.6, 0.6), glm::dvec3(0.0, 0.6, 0.599)}) {
        const Footage footage(cyan, skin, 0.0, 0.01);
        CHECK(screen_color(footage.picture()));  // it is a screen, whatever it can be keyed by
        CHECK_FALSE(is_screen_color(cyan));
        CHECK_THROWS_WITH(matte(skin, cyan), Catch::Matchers::StartsWith("screen: "));
        std::vector<double> out(footage.pixels.size());
        CHECK_THROWS_WITH(mattes(footage.pixels, cyan, {}, out), Catch::Matchers::StartsWith("screen: "));
        CHECK_THROWS_WITH(judge_screen(footage.picture(), cyan), Catch::Matchers::StartsWith("color: "));
        for (const double balance : {0.1, 0.5, 1.0}) {
            CHECK(is_screen_color(cyan, balance));
            CHECK(matte(cyan, cyan, {balance}) == 0.0);
            CHECK(matte(glm::dvec3(0.4), cyan, {balance}) == Approx(1.0));
            mattes(footage.pixels, cyan, {balance}, out);
            for (const double one : out) CHECK(std::isfinite(one));
            const ScreenQuality report = judge_screen(footage.picture(), cyan, {balance});
            for (const double one : {report.share, report.luminance_spread, report.chroma_spread,
                                     report.spill, report.black, report.white})
                CHECK(std::isfinite(one));
        }
    }
    // The palest greens and blues, and those next to yellow and magenta, exceed the others by enough.
    for (const double saturation : {0.11, 0.5, 1.0})
        for (const double other : {0.0, 0.2, 0.45}) {
            const double least = 0.5 * (1.0 - saturation);
            const double between = least + other * (0.5 - least);
            CHECK(is_screen_color({between, 0.5, least}));
            CHECK(is_screen_color({between, least, 0.5}));
        }
    CHECK_THROWS_WITH(is_screen_color(green, 1.5), Catch::Matchers::StartsWith("balance: "));
}

TEST_CASE("colours that cannot be a screen's are refused", "[colour]") {
    CHECK(is_screen_color(green));
    CHECK(is_screen_color(blue));
    for (const glm::dvec3& color :
         {skin, glm::dvec3(0.0), glm::dvec3(1.0), glm::dvec3(0.9, 0.95, 0.9), glm::dvec3(0.7, 0.1, 0.8),
          glm::dvec3(0.8, 0.1, 0.7), glm::dvec3(-1.0, -0.5, -1.0), glm::dvec3(0.0, std::nan(""), 0.0)})
        CHECK_FALSE(is_screen_color(color));
    CHECK_THROWS_AS(judge_screen(Footage(green, skin, 0.0, 0.0).picture(), skin), std::invalid_argument);
}
