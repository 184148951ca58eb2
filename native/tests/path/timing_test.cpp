#include "motus/path/timing.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::path;

namespace {

/// (distance(t + h) - distance(t - h)) / 2h, for where the distance is smooth.
double slope(const Timing& timing, double time, double h = 1e-6) {
    return (timing.distance(time + h) - timing.distance(time - h)) / (2.0 * h);
}

}  // namespace

TEST_CASE("ease follows its definition", "[timing]") {
    const double t1 = 0.2;
    const double t2 = 0.7;
    const double v0 = 1.0 / (1.0 - t1 / 2.0 - (1.0 - t2) / 2.0);
    for (double u = 0.0; u <= 1.0; u += 0.01) {
        double expected = 0.0;
        if (u < t1) {
            expected = v0 * u * u / (2.0 * t1);
        } else if (u <= t2) {
            expected = v0 * t1 / 2.0 + v0 * (u - t1);
        } else {
            expected = v0 * t1 / 2.0 + v0 * (t2 - t1) + (v0 - v0 * (u - t2) / (2.0 * (1.0 - t2))) * (u - t2);
        }
        CHECK(ease(u, t1, 1.0 - t2) == Approx(expected).margin(1e-15));
    }
}

TEST_CASE("ease begins at 0 and ends at 1 with a continuous derivative", "[timing]") {
    for (const double in : {0.0, 1e-9, 0.25, 0.5, 1.0}) {
        for (const double out : {0.0, 1e-9, 0.25, 0.5, 1.0}) {
            if (in + out > 1.0) continue;
            CAPTURE(in, out);
            CHECK(ease(0.0, in, out) == 0.0);
            CHECK(ease(1.0, in, out) == 1.0);
            CHECK(ease(-3.0, in, out) == 0.0);
            CHECK(ease(3.0, in, out) == 1.0);
            double sum = 0.0;
            constexpr int steps = 1000;
            for (int i = 0; i < steps; ++i) {
                const double u = (i + 0.5) / steps;
                sum += ease_derivative(u, in, out) / steps;
                CHECK(ease(u + 1e-10, in, out) - ease(u, in, out) == Approx(0.0).margin(3e-10));
            }
            CHECK(sum == Approx(1.0).margin(1e-5));
            for (const double knot : {in, 1.0 - out}) {
                if (knot < 0.01 || knot > 0.99) continue;
                CHECK(ease_derivative(knot - 1e-9, in, out) ==
                      Approx(ease_derivative(knot + 1e-9, in, out)).epsilon(1e-7));
            }
            CHECK(ease_derivative(0.0, in, out) == Approx(in > 0.0 ? 0.0 : 2.0 / (2.0 - out)));
            CHECK(ease_derivative(1.0, in, out) == Approx(out > 0.0 ? 0.0 : 2.0 / (2.0 - in)));
            CHECK(ease_derivative(-0.1, in, out) == 0.0);
            CHECK(ease_derivative(1.1, in, out) == 0.0);
        }
    }
}

TEST_CASE("ease accepts fractions that add up to 1 in decimals and in float", "[timing]") {
    for (int i = 0; i <= 1000; ++i) {
        const double in = static_cast<double>(static_cast<float>(i) / 1000.0f);
        CHECK(ease(0.5, in, static_cast<double>(1.0f - static_cast<float>(in))) >= 0.0);
    }
    CHECK_THROWS_AS(ease(0.5, 0.6, 0.41), std::invalid_argument);
    CHECK_THROWS_AS(ease(0.5, -0.1, 0.4), std::invalid_argument);
    CHECK_THROWS_AS(ease(0.5, 0.1, 1.4), std::invalid_argument);
    CHECK_THROWS_AS(ease(std::nan(""), 0.1, 0.4), std::invalid_argument);
}

TEST_CASE("an eased timing goes on at its last speed, or repeats", "[timing]") {
    for (const auto& [in, out] : {std::pair{0.25, 0.25}, {0.0, 0.0}, {0.3, 0.0}, {0.0, 0.4}}) {
        CAPTURE(in, out);
        const Timing once = Timing::eased(4.0, 10.0, in, out);
        const Timing on = Timing::eased(4.0, 10.0, in, out, AfterEase::go_on);
        const Timing again = Timing::eased(4.0, 10.0, in, out, AfterEase::repeat);
        const double last = once.speed(4.0);
        for (double time = -1.0; time <= 4.0; time += 0.125) {
            CHECK(on.distance(time) == once.distance(time));
            CHECK(on.speed(time) == once.speed(time));
            CHECK(again.distance(time) == once.distance(time));
            if (time < 4.0) CHECK(again.speed(time) == once.speed(time));
            if (time < 0.0) continue;
            CHECK(on.distance(4.0 + time) == Approx(10.0 + last * time));
            CHECK(on.speed(4.0 + time) == last);
            for (const double lap : {1.0, 2.0, 7.0, 1e6}) {
                CHECK(again.distance(4.0 * lap + time) == 10.0 * lap + again.distance(time));
                CHECK(again.speed(4.0 * lap + time) == again.speed(time));
            }
        }
    }
    // Laps that no number of seconds is a multiple of.
    const Timing short_laps = Timing::eased(1e-6, 2.0, 0.2, 0.3, AfterEase::repeat);
    const Timing long_laps = Timing::eased(0.7, 2.0, 0.0, 0.0, AfterEase::repeat);
    for (double time = 0.0; time < 300.0; time += 0.37) {
        CHECK(short_laps.distance(time) == Approx(2e6 * time).margin(2.0));
        CHECK(long_laps.distance(time) == Approx(time / 0.35).epsilon(1e-13));
        CHECK(long_laps.speed(time) == Approx(1.0 / 0.35));
    }
}

TEST_CASE("an eased timing covers its length and rests outside", "[timing]") {
    const Timing timing = Timing::eased(4.0, 10.0, 0.25, 0.25);
    CHECK(timing.distance(-1.0) == 0.0);
    CHECK(timing.distance(2.0) == Approx(5.0));
    CHECK(timing.distance(4.0) == 10.0);
    CHECK(timing.distance(9.0) == 10.0);
    CHECK(timing.speed(2.0) == Approx(10.0 / 3.0));
    CHECK(timing.speed(5.0) == 0.0);
    CHECK_THROWS_AS(Timing::eased(0.0, 10.0, 0.0, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(Timing::eased(1.0, std::numeric_limits<double>::infinity(), 0.0, 0.0),
                    std::invalid_argument);
}

TEST_CASE("constant speed holds for all times", "[timing]") {
    const Timing timing = Timing::constant(-2.5);
    CHECK(timing.distance(-4.0) == 10.0);
    CHECK(timing.distance(8.0) == -20.0);
    CHECK(timing.speed(-100.0) == -2.5);
}

TEST_CASE("a timing by pins passes through them and does not overshoot between them", "[timing]") {
    test::Random random(7);
    const auto gap = [&random] { return random.between(0.05, 2.0); };
    for (int round = 0; round < 50; ++round) {
        std::vector<double> times{gap()};
        std::vector<double> distances{0.0};
        for (int i = 0; i < 6; ++i) {
            times.push_back(times.back() + gap());
            distances.push_back(distances.back() + random.whole(0, 3));
        }
        const Timing timing = Timing::pins(times, distances);
        for (std::size_t i = 0; i < times.size(); ++i) CHECK(timing.distance(times[i]) == distances[i]);
        for (std::size_t i = 0; i + 1 < times.size(); ++i) {
            double last = distances[i];
            for (double u = 0.02; u < 1.0; u += 0.02) {
                const double time = times[i] + u * (times[i + 1] - times[i]);
                const double now = timing.distance(time);
                CHECK(now >= last - 1e-12);
                CHECK(now <= distances[i + 1] + 1e-12);
                if (distances[i] == distances[i + 1]) CHECK(now == distances[i]);
                CHECK(timing.speed(time) == Approx(slope(timing, time)).margin(1e-6));
                last = now;
            }
        }
        CHECK(timing.distance(times.front() - 5.0) == distances.front());
        CHECK(timing.distance(times.back() + 5.0) == distances.back());
        CHECK(timing.speed(times.back() + 5.0) == 0.0);
    }
}

TEST_CASE("a timing by pins turns back without overshoot, and is defined for one or two pins", "[timing]") {
    const std::vector<double> times{0.0, 1.0, 2.0};
    const std::vector<double> there_and_back{0.0, 4.0, 1.0};
    const Timing timing = Timing::pins(times, there_and_back);
    CHECK(timing.speed(1.0) == 0.0);
    for (double time = 0.0; time <= 2.0; time += 0.01) CHECK(timing.distance(time) <= 4.0);

    const std::vector<double> one{3.0};
    CHECK(Timing::pins(one, one).distance(-8.0) == 3.0);
    const std::vector<double> two{1.0, 3.0};
    CHECK(Timing::pins(two, two).distance(1.5) == Approx(1.5));

    CHECK_THROWS_AS(Timing::pins({}, {}), std::invalid_argument);
    CHECK_THROWS_AS(Timing::pins(times, two), std::invalid_argument);
    CHECK_THROWS_AS(Timing::pins(there_and_back, times), std::invalid_argument);
}

TEST_CASE("speeds integrate exactly in both directions of time", "[timing]") {
    const std::vector<double> times{1.0, 3.0, 4.0};
    const std::vector<double> speeds{2.0, 6.0, -2.0};
    const Timing timing = Timing::speeds(times, speeds);
    CHECK(timing.distance(0.0) == 0.0);
    CHECK(timing.distance(-2.0) == Approx(-4.0));
    CHECK(timing.distance(1.0) == Approx(2.0));
    CHECK(timing.distance(3.0) == Approx(10.0));
    CHECK(timing.distance(4.0) == Approx(12.0));
    CHECK(timing.distance(6.0) == Approx(8.0));
    CHECK(timing.speed(2.0) == Approx(4.0));
    CHECK(timing.speed(3.5) == Approx(2.0));
    CHECK(timing.speed(9.0) == -2.0);

    const std::vector<double> around_zero{-1.0, 1.0};
    const std::vector<double> growing{0.0, 2.0};
    const Timing through = Timing::speeds(around_zero, growing);
    CHECK(through.distance(0.0) == 0.0);
    CHECK(through.distance(1.0) == Approx(1.5));
    CHECK(through.distance(-1.0) == Approx(-0.5));
    CHECK_THROWS_AS(Timing::speeds(growing, std::vector<double>{1.0, std::nan("")}), std::invalid_argument);
}

TEST_CASE("speeds by distance hold at the distance they are given for", "[timing]") {
    const std::vector<double> distances{-2.0, 1.0, 4.0, 9.0};
    const std::vector<double> speeds{1.0, 4.0, 4.0, 0.5};
    const Timing timing = Timing::speeds_by_distance(distances, speeds);
    CHECK(timing.distance(0.0) == Approx(0.0).margin(1e-15));
    const auto speed_there = [&](double s) {
        if (s <= distances.front()) return speeds.front();
        for (std::size_t i = 0; i + 1 < distances.size(); ++i) {
            const double u = (s - distances[i]) / (distances[i + 1] - distances[i]);
            if (u <= 1.0) return speeds[i] + u * (speeds[i + 1] - speeds[i]);
        }
        return speeds.back();
    };
    for (double time = -5.0; time < 10.0; time += 0.0301) {
        CAPTURE(time);
        CHECK(timing.speed(time) == Approx(speed_there(timing.distance(time))).epsilon(1e-12));
        CHECK(timing.speed(time) == Approx(slope(timing, time)).epsilon(1e-4));
    }
    // The time for a piece is the integral of ds / v: 3 / 4 at constant speed.
    const std::vector<double> level{0.0, 3.0};
    const std::vector<double> four{4.0, 4.0};
    CHECK(Timing::speeds_by_distance(level, four).distance(0.75) == Approx(3.0));
    CHECK_THROWS_AS(Timing::speeds_by_distance(level, std::vector<double>{1.0, 0.0}), std::invalid_argument);
}

TEST_CASE("a path whose speed falls to almost zero takes the time that the integral says", "[timing]") {
    // v = 1 - s down to e: the time to the end is log(1 / e).
    for (const double end : {1e-6, 1e-12, 1e-17, 1e-100}) {
        CAPTURE(end);
        const std::vector<double> distances{0.0, 1.0};
        const Timing timing = Timing::speeds_by_distance(distances, std::vector<double>{1.0, end});
        const double arrival = -std::log(end) / (1.0 - end);
        CHECK(timing.distance(0.0) == 0.0);
        CHECK(timing.distance(arrival) == Approx(1.0).epsilon(1e-14));
        CHECK(timing.distance(arrival + 3.0 / end) == Approx(4.0).epsilon(1e-12));
    }
}

TEST_CASE("profiles whose numbers overflow are refused", "[timing]") {
    const std::vector<double> ends{0.0, 1.0};
    const std::vector<double> close{0.0, 1e-320};
    const std::vector<double> opposite{-1e308, 1e308};
    CHECK_THROWS_AS(Timing::pins(close, ends), std::invalid_argument);
    CHECK_THROWS_AS(Timing::pins(ends, opposite), std::invalid_argument);
    CHECK_THROWS_AS(Timing::speeds(ends, opposite), std::invalid_argument);
    CHECK_THROWS_AS(Timing::speeds_by_distance(opposite, std::vector<double>{1.0, 1e-3}),
                    std::invalid_argument);
    CHECK_THROWS_AS(Timing::eased(1e-320, 1.0, 0.0, 0.0), std::invalid_argument);
}

TEST_CASE("speeds by distance that come again each lap solve ds/dt = v(s)", "[timing]") {
    constexpr double lap = 10.0;
    const std::vector<double> places{1.0, 4.0, 8.5}, speeds{2.0, 0.5, 3.0};
    const Timing timing = Timing::speeds_by_distance(places, speeds, lap);
    const auto speed_at = [&](double s) {
        const double on_lap = s - lap * std::floor(s / lap);
        const std::vector<double> at{8.5 - lap, 1.0, 4.0, 8.5, 1.0 + lap}, values{3.0, 2.0, 0.5, 3.0, 2.0};
        std::size_t i = 0;
        while (on_lap > at[i + 1]) ++i;
        return std::lerp(values[i], values[i + 1], (on_lap - at[i]) / (at[i + 1] - at[i]));
    };
    CHECK(timing.distance(0.0) == Approx(0.0).margin(1e-12));
    for (double time = -20.0; time < 60.0; time += 0.37) {
        const double s = timing.distance(time);
        CHECK(timing.speed(time) == Approx(speed_at(s)).epsilon(1e-9));
        constexpr double h = 1e-5;
        CHECK((timing.distance(time + h) - timing.distance(time - h)) / (2.0 * h) ==
              Approx(timing.speed(time)).epsilon(1e-3));
    }
    // Samples may lie in any lap; one sample is an even speed.
    const Timing elsewhere = Timing::speeds_by_distance(std::vector{-9.0, -6.0, -1.5}, speeds, lap);
    CHECK(elsewhere.distance(7.3) == Approx(timing.distance(7.3)).epsilon(1e-12));
    CHECK(Timing::speeds_by_distance(std::vector{3.0}, std::vector{2.0}, lap).distance(17.25) ==
          Approx(34.5));
    CHECK_THROWS_AS(Timing::speeds_by_distance(places, speeds, 5.0), std::invalid_argument);
    CHECK_THROWS_AS(Timing::speeds_by_distance(places, speeds, 0.0), std::invalid_argument);
}
