#include "motus/dynamics/second_order.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "data/second_order.hpp"

using namespace motus::dynamics;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Largest deviation from the end after a time, by brute force.
double deviation_after(const SecondOrder& filter, double time, double until) {
    double largest = 0.0;
    for (int i = 1; i <= 20000; ++i) {
        const double at = time + (until - time) * i / 20000.0;
        largest = std::max(largest, std::abs(step_response(filter, at).value - 1.0));
    }
    return largest;
}

}  // namespace

TEST_CASE("step responses are those of the reference", "[second_order]") {
    for (const auto& known : motus::reference::step_responses) {
        const SecondOrder filter(known.frequency, known.damping, known.response);
        for (const auto& [time, value, derivative] : known.values) {
            const Response found = step_response(filter, time);
            CHECK(std::abs(found.value - value) < 1e-15);
            CHECK(std::abs(found.derivative - derivative) < 1e-12);
        }
    }
    CHECK(step_response(SecondOrder(1.0, 0.5, 2.0), -1e-9).value == 0.0);
}

TEST_CASE("a step response satisfies its equation, whatever the damping", "[second_order]") {
    // Beside critical damping too, where the formulas change over.
    for (const double damping :
         {0.0, 0.3, 1.0 - 1e-7, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1.0 + 1e-7, 3.0, 40.0}) {
        for (const double response : {-2.0, 0.0, 1.0, 3.0}) {
            const SecondOrder filter(1.3, damping, response);
            const auto [k1, k2, k3] = filter.coefficients();
            for (const double time : {0.01, 0.4, 1.7}) {
                const double h = 1e-5;
                const Response before = step_response(filter, time - h);
                const Response now = step_response(filter, time);
                const Response after = step_response(filter, time + h);
                const double second = (after.derivative - before.derivative) / (2.0 * h);
                // The input rests at 1: its derivative is 0.
                CHECK(std::abs(now.value + k1 * now.derivative + k2 * second - 1.0) <
                      1e-6 * (1.0 + damping * damping * (1.0 + std::abs(response))));
                CHECK(std::abs((after.value - before.value) / (2.0 * h) - now.derivative) <
                      1e-5 * (1.0 + damping * damping * damping * (1.0 + std::abs(response))));
            }
        }
    }
}

TEST_CASE("the three ways to set a filter agree", "[second_order]") {
    const SecondOrder filter(2.5, 0.4, -0.7);
    const double w = 2.0 * std::numbers::pi * 2.5;
    const auto [k1, k2, k3] = filter.coefficients();
    CHECK(k1 == Approx(0.4 / (std::numbers::pi * 2.5)).epsilon(1e-15));
    CHECK(k2 == Approx(1.0 / (w * w)).epsilon(1e-15));
    CHECK(k3 == Approx(-0.7 * 0.4 / w).epsilon(1e-15));
    const SecondOrder same = SecondOrder::from_coefficients({k1, k2, k3});
    CHECK(same.frequency() == Approx(2.5).epsilon(1e-14));
    CHECK(same.damping() == Approx(0.4).epsilon(1e-14));
    CHECK(same.response() == Approx(-0.7).epsilon(1e-14));

    // m y'' = k (x - y) + b (x' - y')
    const SecondOrder spring = SecondOrder::from_mass_spring(2.0, 50.0, 3.0);
    CHECK(spring.rate() == Approx(5.0).epsilon(1e-15));
    CHECK(spring.damping() == Approx(3.0 / (2.0 * std::sqrt(100.0))).epsilon(1e-15));
    CHECK(spring.response() == Approx(2.0).epsilon(1e-15));
    // Coefficients that frequency, damping and response cannot tell.
    CHECK(SecondOrder::from_coefficients({0.0, 0.1, 0.3}).coefficients().k3 == 0.3);
}

TEST_CASE("overshoot and settling time are those of the response", "[second_order]") {
    CHECK(overshoot(SecondOrder(1.0, 0.5, 0.0)) ==
          Approx(std::exp(-std::numbers::pi * 0.5 / std::sqrt(0.75))).epsilon(1e-13));
    CHECK(overshoot(SecondOrder(3.0, 0.5, 2.0)) == Approx(0.298).margin(5e-4));
    CHECK(overshoot(SecondOrder(1.0, 0.0, 0.0)) == Approx(1.0).epsilon(1e-14));
    CHECK(overshoot(SecondOrder(1.0, 1.0, 0.0)) == 0.0);
    CHECK(overshoot(SecondOrder(1.0, 5.0, 1.0)) == 0.0);
    CHECK(settling_time(SecondOrder(1.0, 0.0, 0.0)) == infinite);
    for (const double damping : {0.05, 0.3, 0.7, 0.999999, 1.0, 1.000001, 1.4, 6.0}) {
        for (const double response : {-1.5, 0.0, 0.8, 2.0, 5.0}) {
            const SecondOrder filter(1.7, damping, response);
            const double until = 40.0 / filter.rate() * std::max(damping, 1.0 / damping);
            double highest = 0.0;
            for (int i = 0; i <= 200000; ++i)
                highest = std::max(highest, step_response(filter, until * i / 200000.0).value - 1.0);
            CHECK(overshoot(filter) == Approx(highest).margin(1e-6));
            for (const double tolerance : {0.02, 0.2}) {
                const double settled = settling_time(filter, tolerance);
                CHECK(deviation_after(filter, settled, until) <= tolerance * (1.0 + 1e-9));
                const double at = std::abs(step_response(filter, settled).value - 1.0);
                CHECK(at == Approx(tolerance).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("a filter is found by its overshoot and settling time", "[second_order]") {
    for (const double response : {-1.0, 0.0, 1.0, 2.0, 3.0}) {
        for (const double wanted : {0.6, 0.9}) {
            const SecondOrder filter = SecondOrder::from_overshoot(wanted, 1.25, response, 0.05);
            CHECK(overshoot(filter) == Approx(wanted).epsilon(1e-9));
            CHECK(settling_time(filter, 0.05) == Approx(1.25).epsilon(1e-9));
            CHECK(filter.response() == Approx(response).margin(1e-12));
        }
    }
    // With r = 4 a heavily damped output still jumps by half too much.
    CHECK_THROWS_AS(SecondOrder::from_overshoot(0.3, 1.0, 4.0), std::invalid_argument);
}

TEST_CASE("invalid settings of a filter are refused by the argument's name", "[second_order]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    using Catch::Matchers::StartsWith;
    CHECK_THROWS_WITH(SecondOrder(0.0, 1.0, 0.0), StartsWith("frequency"));
    CHECK_THROWS_WITH(SecondOrder(nan, 1.0, 0.0), StartsWith("frequency"));
    CHECK_THROWS_WITH(SecondOrder(1.0, -0.1, 0.0), StartsWith("damping"));
    CHECK_THROWS_WITH(SecondOrder(1.0, 1.0, infinite), StartsWith("response"));
    CHECK_THROWS_WITH(SecondOrder::from_coefficients({-1.0, 1.0, 0.0}), StartsWith("k1"));
    CHECK_THROWS_WITH(SecondOrder::from_coefficients({1.0, 0.0, 0.0}), StartsWith("k2"));
    CHECK_THROWS_WITH(SecondOrder::from_mass_spring(0.0, 1.0, 1.0), StartsWith("mass"));
    CHECK_THROWS_WITH(SecondOrder::from_mass_spring(1.0, 1.0, nan), StartsWith("resistance"));
    CHECK_THROWS_WITH(SecondOrder::from_overshoot(1.0, 1.0), StartsWith("overshoot"));
    CHECK_THROWS_WITH(SecondOrder::from_overshoot(0.5, 0.0), StartsWith("settling"));
    CHECK_THROWS_WITH(settling_time(SecondOrder(1.0, 1.0, 0.0), 0.0), StartsWith("tolerance"));
    CHECK_THROWS_WITH(SecondOrder(1e-300, 1.0, 0.0), StartsWith("frequency"));
    CHECK_THROWS_WITH(SecondOrder(1e101, 1.0, 0.0), StartsWith("frequency"));
    CHECK_THROWS_WITH(SecondOrder(1.0, 1e101, 0.0), StartsWith("damping"));
    CHECK_THROWS_WITH(SecondOrder(1.0, 1.0, -1e101), StartsWith("response"));
    CHECK_THROWS_WITH(SecondOrder::from_coefficients({1e300, 1.0, 0.0}), StartsWith("k1"));
    CHECK_THROWS_WITH(SecondOrder::from_coefficients({1.0, 1e300, 0.0}), StartsWith("k2"));
    CHECK_THROWS_WITH(SecondOrder::from_coefficients({1.0, 1.0, 1e300}), StartsWith("k3"));
}

TEST_CASE("the most extreme filters and times give finite results", "[second_order]") {
    for (const double frequency : {1e-100, 1.0, 1e100})
        for (const double damping : {0.0, 0.5, 1.0, 1e100})
            for (const double response : {-1e100, 0.0, 1e100}) {
                const SecondOrder filter(frequency, damping, response);
                CHECK_FALSE(std::isnan(overshoot(filter)));
                CHECK_FALSE(std::isnan(settling_time(filter)));
                for (const double time : {0.0, 1e-300, 1.0, 1e300}) {
                    CHECK(std::isfinite(step_response(filter, time).value));
                    const Step step = make_step(filter, time);
                    for (const double part : {step.lag, step.ee, step.eu, step.ue, step.uu})
                        CHECK(std::isfinite(part));
                }
            }
}
