#include "gauss.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "motion.hpp"
#include "motion_table.hpp"
#include "motus/core/sine.hpp"

using namespace motus;
using namespace motus::dynamics;

TEST_CASE("Gauss's table integrates polynomials exactly", "[gauss]") {
    for (int degree = 0; degree < 2 * stages; ++degree) {
        double sum = 0.0;
        for (std::size_t j = 0; j < stages; ++j) sum += gauss.weights[j] * std::pow(gauss.nodes[j], degree);
        CHECK(sum == Approx(1.0 / (degree + 1)).epsilon(1e-14));
    }
    for (int degree = 0; degree < stages; ++degree) {
        for (std::size_t i = 0; i < stages; ++i) {
            double integral = 0.0;
            double next = 0.0;
            for (std::size_t j = 0; j < stages; ++j) {
                integral += gauss.integrals[j][i] * std::pow(gauss.nodes[j], degree);
                next += gauss.next[j][i] * std::pow(gauss.nodes[j], degree);
            }
            CHECK(integral == Approx(std::pow(gauss.nodes[i], degree + 1) / (degree + 1)).margin(1e-15));
            CHECK(next == Approx(std::pow(1.0 + gauss.nodes[i], degree)).epsilon(1e-9));
        }
    }
    // Symplectic: b_i a_ij + b_j a_ji = b_i b_j.
    for (std::size_t i = 0; i < stages; ++i) {
        for (std::size_t j = 0; j < stages; ++j) {
            const double sum =
                gauss.weights[i] * gauss.integrals[j][i] + gauss.weights[j] * gauss.integrals[i][j];
            CHECK(sum == Approx(gauss.weights[i] * gauss.weights[j]).margin(1e-17));
        }
    }
}

TEST_CASE("sine and cosine are right to the last digits", "[gauss]") {
    for (int i = -200000; i <= 200000; i += 7) {
        const double angle = i * 0.00731;
        const SineCosine<double> found = sine_cosine(angle), back = sine_cosine(-angle);
        CHECK(std::abs(found.sine - std::sin(angle)) < 2.5e-16);
        CHECK(std::abs(found.cosine - std::cos(angle)) < 2.5e-16);
        CHECK(back.sine == -found.sine);
        CHECK(back.cosine == found.cosine);
    }
}

TEST_CASE("Gauss steps by pairs, quads and octets give the same bits", "[gauss]") {
    constexpr std::size_t count = 9;
    for (const StepKernel& kernel : step_kernels()) {
        DYNAMIC_SECTION(kernel.name) {
            DoubleSystem system;
            system.mass = 0.3;
            system.other = 0.7;
            system.damping = 0.01;
            std::array<std::array<double, 4>, count> states{}, alone{};
            std::array<Derivatives<4>, count> derivatives{}, own{};
            for (std::size_t i = 0; i < count; ++i)
                states[i] = alone[i] = {2.0, 0.3 * static_cast<double>(i), 0.5, -1.0};
            for (int round = 0; round < 200; ++round) {
                std::array<GaussStep<DoubleSystem>, count> steps, others;
                const Drive<2> drive{{0.1, -0.2}, {0.3, 0.1 * round}};
                for (std::size_t i = 0; i < count; ++i) {
                    steps[i] = {&system, &states[i], &derivatives[i], 0.06, drive};
                    others[i] = {&system, &alone[i], &own[i], 0.06, drive};
                }
                kernel.pair(steps);
                for (GaussStep<DoubleSystem>& step : others) step_kernels().front().pair({&step, 1});
                for (std::size_t i = 0; i < count; ++i) {
                    REQUIRE(steps[i].converged == others[i].converged);
                    REQUIRE(states[i] == alone[i]);
                    REQUIRE(steps[i].tail == others[i].tail);
                }
            }
        }
    }
}

TEST_CASE("a table that cannot grow leaves those that grow with it as they are alone", "[gauss]") {
    // Backwards in time damping drives it on.
    const auto table = [](double start) {
        MotionSettings<DoubleSystem> settings;
        settings.system.damping = 1.0;
        settings.start = {start, start, 0.5, 0.0};
        settings.interval = -0.5;
        return MotionTable<DoubleSystem>(settings);
    };
    constexpr double near = -0.7, far = -300.0;
    for (const double start : {0.3, 0.8, 1.3, 1.9}) {
        const MotionTable<DoubleSystem> fails = table(2.5), other = table(start), alone = table(start);
        const std::array<const MotionTable<DoubleSystem>*, 2> both{&fails, &other};
        std::array<std::array<double, 4>, 2> states{};
        for (int round = 0; round < 2; ++round)
            CHECK_THROWS_AS(MotionTable<DoubleSystem>::at(both, far, states), std::invalid_argument);
        CHECK_THROWS_AS(other.at(far), std::invalid_argument);
        for (double time = near; time > -12.0; time -= 0.1) {
            std::array<double, 4> expected{};
            try {
                expected = alone.at(time);
            } catch (const std::invalid_argument&) {
                CHECK_THROWS_AS(other.at(time), std::invalid_argument);
                continue;
            }
            CHECK(other.at(time) == expected);
        }
    }
}
