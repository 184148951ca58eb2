#include "motus/noise/noise.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "random.hpp"

using namespace motus;

namespace {

template <class Place>
[[nodiscard]] Place any_place(test::Random& random);
template <>
double any_place<double>(test::Random& random) {
    return random.between(-500.0, 500.0);
}
template <>
glm::dvec2 any_place<glm::dvec2>(test::Random& random) {
    return glm::dvec2(random.in_cube(500.0));
}
template <>
glm::dvec3 any_place<glm::dvec3>(test::Random& random) {
    return random.in_cube(500.0);
}

/// The place with all coordinates moved to the same place in their cells.
[[nodiscard]] double in_cell(double place, double at) {
    return std::floor(place) + at;
}
[[nodiscard]] glm::dvec2 in_cell(const glm::dvec2& place, double at) {
    return glm::floor(place) + at;
}
[[nodiscard]] glm::dvec3 in_cell(const glm::dvec3& place, double at) {
    return glm::floor(place) + at;
}

struct Moments {
    double mean = 0.0;
    double variance = 0.0;
    double largest = 0.0;
};

template <class Draw>
[[nodiscard]] Moments moments_of(int count, const Draw& draw) {
    Moments found;
    for (int i = 0; i < count; ++i) {
        const double one = draw();
        found.mean += one / count;
        found.variance += one * one / count;
        found.largest = std::max(found.largest, std::abs(one));
    }
    return found;
}

/// Power of the samples, times a window that falls to 0 at both ends.
[[nodiscard]] double power_at(const std::vector<double>& samples, double step, double frequency) {
    std::complex<double> sum = 0.0;
    const auto count = static_cast<double>(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double at = static_cast<double>(i);
        const double window = 1.0 - std::cos(2.0 * std::numbers::pi * at / count);
        sum += window * samples[i] * std::polar(1.0, -2.0 * std::numbers::pi * frequency * step * at);
    }
    return std::norm(sum) / count * step;
}

/// Mean power at a frequency, waves a unit, along lines in a direction through the noise.
[[nodiscard]] double power_along(const glm::dvec3& direction, double frequency) {
    test::Random random(7);
    constexpr int lines = 60;
    constexpr double step = 0.1;
    double sum = 0.0;
    for (int line = 0; line < lines; ++line) {
        const glm::dvec3 start = random.in_cube(1000.0);
        std::vector<double> samples;
        for (int i = 0; i < 512; ++i)
            samples.push_back(noise::value(start + step * i * glm::normalize(direction), 3));
        sum += power_at(samples, step, frequency) / lines;
    }
    return sum;
}

}  // namespace

TEMPLATE_TEST_CASE("noise stays within -1 and 1, around 0, and reaches far", "[noise]", double, glm::dvec2,
                   glm::dvec3) {
    test::Random random(1);
    const Moments found = moments_of(400000, [&] { return noise::value(any_place<TestType>(random), 5); });
    CHECK(found.largest <= 1.0);
    CHECK(found.largest > 0.6);
    CHECK(std::abs(found.mean) < 0.005);
    CHECK(found.variance > 0.035);
}

TEMPLATE_TEST_CASE("the lattice of the noise does not show in its variance", "[noise]", double, glm::dvec2,
                   glm::dvec3) {
    test::Random random(2);
    const double everywhere =
        moments_of(200000, [&] { return noise::value(any_place<TestType>(random), 9); }).variance;
    for (const double at : {0.0, 0.125, 0.25, 0.375, 0.5}) {
        CAPTURE(at);
        const double here = moments_of(100000, [&] {
                                return noise::value(in_cell(any_place<TestType>(random), at), 9);
                            }).variance;
        CHECK(here / everywhere == Approx(1.0).margin(0.1));
    }
}

TEST_CASE("noise and its derivative are continuous, across the borders of cells too", "[noise]") {
    test::Random random(3);
    constexpr double step = 1e-4;
    for (int i = 0; i < 3000; ++i) {
        glm::dvec3 place = random.in_cube(20.0);
        // Every other place on a border, where bumps begin and end.
        if (i % 2 == 0) place.x = 0.5 * std::round(2.0 * place.x);
        if (i % 4 == 0) place.y = 0.5 * std::round(2.0 * place.y);
        const glm::vec3 slope = noise::gradient(place, 1);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 beside = place;
            beside[axis] += step;
            const double difference = noise::value(beside, 1) - noise::value(place, 1);
            CHECK(std::abs(difference / step - slope[axis]) < 5e-3);
            CHECK(std::abs(noise::gradient(beside, 1)[axis] - slope[axis]) < 20.0 * step);
        }
        const double line = place.x;
        CHECK(std::abs((noise::value(line + step, 1) - noise::value(line, 1)) / step -
                       noise::gradient(line, 1)) < 5e-3);
        const glm::dvec2 flat(place);
        CHECK(std::abs((noise::value(flat + glm::dvec2(0.0, step), 1) - noise::value(flat, 1)) / step -
                       noise::gradient(flat, 1).y) < 5e-3);
    }
}

TEST_CASE("noise has its power in slow waves", "[noise]") {
    test::Random random(4);
    constexpr double step = 0.1;
    double slow = 0.0, fast = 0.0;
    for (int line = 0; line < 100; ++line) {
        const double start = random.between(-1e4, 1e4);
        std::vector<double> samples;
        for (int i = 0; i < 1000; ++i) samples.push_back(noise::value(start + step * i, 2));
        for (double frequency = 0.05; frequency < 1.5; frequency += 0.05)
            slow += power_at(samples, step, frequency);
        for (double frequency = 1.5; frequency < 4.5; frequency += 0.05)
            fast += power_at(samples, step, frequency);
    }
    CHECK(fast < 0.01 * slow);
}

TEST_CASE("noise looks the same in every direction", "[noise]") {
    for (const double frequency : {0.3, 0.6, 0.9}) {
        CAPTURE(frequency);
        const std::array powers{power_along({1, 0, 0}, frequency), power_along({0, 0, 1}, frequency),
                                power_along({1, 1, 0}, frequency), power_along({1, 1, 1}, frequency),
                                power_along({0.6, -0.3, 0.2}, frequency)};
        const auto [least, most] = std::minmax_element(powers.begin(), powers.end());
        CHECK(*most < 2.0 * *least);
    }
}

TEST_CASE("noises of different seeds, and of one seed far apart, are not alike", "[noise]") {
    test::Random random(5);
    for (const std::uint32_t other : {1U, 2U, 256U, 0x80000000U}) {
        double product = 0.0, square = 0.0;
        for (int i = 0; i < 50000; ++i) {
            const glm::dvec3 place = random.in_cube(300.0);
            const double one = noise::value(place, 0);
            product += one * noise::value(place, other);
            square += one * one;
        }
        CHECK(std::abs(product) < 0.02 * square);
    }
    for (const double far : {256.0, 65536.0, 0x1p24}) {
        double product = 0.0, square = 0.0;
        for (int i = 0; i < 50000; ++i) {
            const double place = random.between(0.0, 20000.0);
            const double one = noise::value(place, 0);
            product += one * noise::value(place + far, 0);
            square += one * one;
        }
        CHECK(std::abs(product) < 0.05 * square);
    }
}

TEST_CASE("noise of many places is the same as place by place, and places may be anywhere", "[noise]") {
    test::Random random(6);
    std::vector<glm::vec3> places;
    for (int i = 0; i < 1000; ++i) places.push_back(random.in_cube(100.0F));
    std::vector<float> found(places.size());
    noise::values(std::span<const glm::vec3>(places), 11, found);
    for (std::size_t i = 0; i < places.size(); ++i)
        CHECK(std::bit_cast<std::uint32_t>(found[i]) ==
              std::bit_cast<std::uint32_t>(noise::value(glm::dvec3(places[i]), 11)));
    for (const double far : {0x1p31, -0x1p31, 1e30, -1e300}) {
        CHECK(std::abs(noise::value(far, 0)) <= 1.0F);
        CHECK(noise::value(far, 0) == noise::value(std::copysign(0x1p30, far), 0));
        CHECK(std::abs(noise::value(glm::dvec3(far, 0.0, -far), 0)) <= 1.0F);
    }
}

TEST_CASE("noise that is looped repeats itself, and goes on without a seam", "[noise]") {
    test::Random random(8);
    for (const std::uint32_t period : {1U, 3U, 100U, noise::longest_period}) {
        CAPTURE(period);
        for (int i = 0; i < 300; ++i) {
            const double place = std::round(256.0 * random.between(0.0, 100.0)) / 256.0;
            CHECK(noise::looped(place, period, 4) == noise::looped(place + period, period, 4));
            CHECK(noise::looped(place, period, 4) == noise::looped(place - 3.0 * period, period, 4));
        }
        // What passes the seam is the noise that has the same heights: its derivatives are continuous too.
        constexpr double step = 1e-3;
        const auto at = [&](double place) { return static_cast<double>(noise::looped(place, period, 4)); };
        const double before = (at(0.0) - at(-step)) / step, after = (at(step) - at(0.0)) / step;
        CHECK(std::abs(before - after) < 0.05);
    }
    for (int i = 0; i < 300; ++i) {
        const double place = random.between(1.0, 999.0);
        CHECK(noise::looped(place, 1000, 4) == noise::value(place, 4));
    }
}

TEST_CASE("steps hold a number a unit, which fill the range evenly", "[noise]") {
    test::Random random(9);
    double mean = 0.0, square = 0.0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        const double one = noise::steps(i - 50000.0, 0.0, 3);
        mean += one / count;
        square += one * one / count;
        if (i % 100 == 0) CHECK(one == noise::steps(i - 50000.0 + random.between(0.0, 0.999), 0.0, 3));
    }
    CHECK(std::abs(mean) < 0.01);
    CHECK(square == Approx(1.0 / 3.0).margin(0.01));
    CHECK(noise::steps(2.0, 0.0, 3) != noise::steps(2.0, 0.0, 4));
}

TEST_CASE("steps go over by a smooth step", "[noise]") {
    const double before = noise::steps(6.9, 0.0, 1), after = noise::steps(7.0, 0.0, 1);
    CHECK(noise::steps(7.0, 0.5, 1) == before);
    CHECK(noise::steps(7.1, 0.5, 1) == Approx(before + (after - before) * (3.0 * 0.04 - 2.0 * 0.008)));
    CHECK(noise::steps(7.5, 0.5, 1) == after);
    CHECK(noise::steps(7.9, 0.5, 1) == after);
    CHECK(noise::steps(7.5, 1.0, 1) == Approx(0.5 * (before + after)));
}

TEST_CASE("what loops and steps refuse", "[noise]") {
    CHECK_THROWS_WITH(noise::looped(0.5, 0, 1), "period: must be from 1 to 2^28");
    CHECK_THROWS_WITH(noise::looped(0.5, noise::longest_period + 1, 1), "period: must be from 1 to 2^28");
    CHECK_THROWS_WITH(noise::steps(0.5, -0.1, 1), "blend: must be from 0 to 1");
    CHECK_THROWS_WITH(noise::steps(0.5, std::nan(""), 1), "blend: must be from 0 to 1");
    CHECK(std::isnan(noise::looped(std::nan(""), 3, 1)));
    CHECK(std::isnan(noise::steps(std::nan(""), 0.5, 1)));
}
