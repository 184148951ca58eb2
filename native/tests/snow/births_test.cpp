#include "motus/snow/births.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "random.hpp"

using namespace motus;
using namespace motus::snow;

namespace {

/// All times of birth in the order of numbers, by definition.
[[nodiscard]] std::vector<double> listed(double rate, double delay, double end,
                                         const std::vector<Burst>& bursts) {
    std::vector<std::pair<double, int>> births;
    for (std::uint64_t j = 0; rate > 0.0; ++j) {
        const double time = delay + static_cast<double>(j + 1) / rate;
        if (time > end) break;
        births.emplace_back(time, 0);
    }
    for (const Burst& burst : bursts)
        for (std::uint64_t i = 0; i < burst.count; ++i) births.emplace_back(delay + burst.time, 1);
    std::ranges::stable_sort(births);
    std::vector<double> times;
    for (const auto& [time, kind] : births) times.push_back(time);
    return times;
}

[[nodiscard]] std::vector<double> in_pieces(const Births& births, std::size_t most) {
    std::vector<double> times;
    std::uint64_t next = 0, streamed = 0;
    for (const Births::Piece& piece : births.pieces()) {
        CHECK(piece.first == next);
        CHECK(piece.last > piece.first);
        CHECK(piece.streamed == streamed);
        next = piece.last;
        if (!piece.is_burst) streamed += piece.last - piece.first;
        for (std::uint64_t i = piece.first; i < piece.last && times.size() < most; ++i)
            times.push_back(piece.is_burst ? piece.burst
                                           : births.streamed(piece.streamed + (i - piece.first)));
    }
    return times;
}

}  // namespace

TEST_CASE("births are those of the definition", "[snow]") {
    test::Random random(1);
    for (int round = 0; round < 60; ++round) {
        const double rate = random.chance(0.1) ? 0.0 : random.between(0.3, 40.0);
        const double delay = random.chance(0.5) ? 0.0 : random.between(0.0, 3.0);
        const double duration = random.between(0.0, 8.0);
        const bool looping = random.chance(0.5);
        std::vector<Burst> bursts(random.below(4));
        for (Burst& burst : bursts) {
            // Some at the very moment at which a flake of the stream is born.
            burst.time = rate > 0.0 && random.chance(0.5) ? 3.0 / rate : random.between(0.0, 9.0);
            burst.count = random.below(30);
        }
        const Births births(rate, delay, duration, looping, bursts);
        const std::vector<double> all = listed(rate, delay, looping ? 20.0 : delay + duration, bursts);
        const std::vector<double> found = in_pieces(births, all.size());
        REQUIRE(found == all);
        for (int i = 0; i < 50; ++i) {
            double time = random.between(-1.0, 20.0);
            if (!all.empty() && random.chance(0.5)) time = all[random.below(all.size())];
            const double age = random.chance(0.3) && !all.empty() ? time - all[random.below(all.size())]
                                                                  : random.between(0.0, 5.0);
            const auto born = std::ranges::count_if(all, [&](double birth) { return birth <= time; });
            const auto older = std::ranges::count_if(all, [&](double birth) { return time - birth >= age; });
            CHECK(births.count(time) == static_cast<std::uint64_t>(born));
            CHECK(births.count_older(time, age) == static_cast<std::uint64_t>(older));
        }
    }
}

TEST_CASE("a stream that never ends is counted at any time", "[snow]") {
    const Births births(1e6, 0.5, 0.0, true, {});
    CHECK(births.count(0.5) == 0);
    CHECK(births.count(3600.5) == 3600000000U);
    CHECK(births.count(1e300) == Births::most_ids);
    CHECK(births.count(-1e300) == 0);
    CHECK(Births(0.0, 0.0, 5.0, true, {}).count(1e300) == 0);
    CHECK(Births(5.0, 0.0, 0.0, false, {}).count(1e300) == 0);
    CHECK(births.most_within(2.0) == 2000001.0);
}

TEST_CASE("with keys flake j is born when the integral of the rate is j + 1", "[snow]") {
    // From 0 to 40 a second in 2 s, then held: t^2 10, and 40 + 40 (t - 2).
    const Births ramp(0.0, 0.0, 0.0, true, {}, {{0.0, 2.0}, {0.0, 40.0}});
    CHECK(ramp.streamed(9) == Approx(1.0).epsilon(1e-15));
    CHECK(ramp.streamed(39) == Approx(2.0).epsilon(1e-15));
    CHECK(ramp.streamed(79) == Approx(3.0).epsilon(1e-15));
    CHECK(ramp.count(1.5) == 22);
    // The rate that there was before the first key counts from the delay on, also within keys.
    CHECK(Births(9.0, 0.0, 0.0, true, {}, {{1.0, 2.0}, {10.0, 30.0}}).count(2.0) == 30);
    CHECK(Births(9.0, 1.5, 0.0, true, {}, {{1.0, 2.0}, {10.0, 30.0}}).count(2.0) == 12);
    CHECK(Births(9.0, 5.0, 1.0, false, {}, {{1.0, 2.0}, {10.0, 30.0}}).count(1e300) == 30);
    // A rate that ends lets no further flakes be born.
    const Births ends(5.0, 0.0, 0.0, true, {{3.0, 2}}, {{0.0, 1.0}, {10.0, 0.0}});
    CHECK(ends.count(1e300) == 7);
    CHECK(std::isinf(ends.streamed(5)));
    CHECK(ends.pieces().back().last == 7);
    CHECK(ends.count_older(5.0, 1.5) == 7);
    CHECK(ends.count_older(5.0, 2.5) == 5);
}

TEST_CASE("keyed births are counted, and listed, as they are one by one", "[snow]") {
    test::Random random(3);
    for (int round = 0; round < 40; ++round) {
        RateKeys keys;
        double at = random.between(-1.0, 1.0);
        for (std::size_t i = 0; i < 1 + random.below(6); ++i) {
            keys.times.push_back(at);
            keys.values.push_back(random.chance(0.3) ? 0.0 : random.between(0.0, 60.0));
            at += random.between(0.01, 1.5);
        }
        const double delay = random.chance(0.5) ? 0.0 : random.between(0.0, 3.0);
        const auto rate = [&](double time) {
            if (time <= keys.times.front()) return keys.values.front();
            if (time >= keys.times.back()) return keys.values.back();
            std::size_t i = 1;
            while (keys.times[i] < time) ++i;
            const double part = (time - keys.times[i - 1]) / (keys.times[i] - keys.times[i - 1]);
            return keys.values[i - 1] + part * (keys.values[i] - keys.values[i - 1]);
        };
        const Births births(1.0, delay, 0.0, true, {}, keys);
        constexpr double h = 1.0 / 1024.0;
        double integral = 0.0, most = 0.0;
        std::vector<double> found(50);
        births.streamed(3, found);
        for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == births.streamed(3 + i));
        for (double time = delay; time < delay + 6.0; time += h) {
            const auto counted = static_cast<double>(births.count(time));
            CHECK(counted <= integral + 0.02);
            CHECK(counted >= std::floor(integral - 0.02));
            most = std::max(most, counted - static_cast<double>(births.count(time - 0.7)));
            integral += h * rate(time + 0.5 * h);
        }
        CHECK(births.most_within(0.7) >= most);
        CHECK(births.most_within(0.7) <= 0.7 * std::ranges::max(keys.values) + 1.0 + 1e-9);
    }
    // Equal keys are one rate.
    const Births even(1.0, 0.25, 0.0, true, {}, {{1.0, 2.0, 5.0}, {8.0, 8.0, 8.0}});
    const Births plain(8.0, 0.25, 0.0, true, {});
    for (std::uint64_t j = 0; j < 200; ++j) CHECK(even.streamed(j) == plain.streamed(j));
    CHECK(even.most_within(2.0) == plain.most_within(2.0));
}

TEST_CASE("births refuse what they cannot count", "[snow]") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double bad : {-1.0, infinite, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK_THROWS_AS(Births(bad, 0.0, 5.0, true, {}), std::invalid_argument);
        CHECK_THROWS_AS(Births(1.0, bad, 5.0, true, {}), std::invalid_argument);
        CHECK_THROWS_AS(Births(1.0, 0.0, bad, true, {}), std::invalid_argument);
        CHECK_THROWS_AS(Births(1.0, 0.0, 5.0, true, {{bad, 1}}), std::invalid_argument);
        CHECK_THROWS_WITH(Births(1.0, 0.0, 5.0, true, {}, {{0.0}, {bad}}), Catch::StartsWith("rate_values"));
    }
    CHECK_THROWS_AS(Births(1.0, 0.0, 5.0, true, {{0.0, Births::most_ids}, {1.0, 1}}), std::invalid_argument);
    for (const RateKeys& bad : {RateKeys{{1.0, 1.0}, {2.0, 2.0}}, RateKeys{{infinite}, {2.0}}})
        CHECK_THROWS_WITH(Births(1.0, 0.0, 5.0, true, {}, bad), Catch::StartsWith("rate_times"));
    // Beyond double precision a second: what is born in such a ramp cannot be counted.
    for (const RateKeys& steep :
         {RateKeys{{0.0, 1e-305, 2.0}, {0.0, 5e4, 5.0}}, RateKeys{{0.0, 0.5}, {1.7e308, 0.0}}})
        CHECK_THROWS_WITH(Births(1.0, 0.0, 5.0, true, {}, steep), Catch::StartsWith("rate_times"));
    CHECK(Births(1.0, 0.0, 2.0, false, {}, {{0.0, 1e-300, 2.0}, {0.0, 5e4, 5.0}}).pieces().back().last ==
          50005);
    CHECK_THROWS_WITH(Births(1.0, 0.0, 5.0, true, {}, {{1.0}, {}}), Catch::StartsWith("rate_values"));
}
