#include "motus/bones/chains/two_bone.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "two_bone_checks.hpp"
#include "two_bone_lanes.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::chains;
using namespace motus::bones::chains::checks;
using std::numbers::pi;

TEST_CASE("a triangle of sides 3, 4 and 5", "[two_bone]") {
    TwoBone chain{.root = {1, 1, 1}, .target = {6, 1, 1}, .pole = {3, 1, 9}, .length1 = 3.0, .length2 = 4.0};
    TwoBoneSolution at = solve_two_bone(chain);
    CHECK(glm::distance(at.elbow, glm::dvec3(2.8, 1.0, 3.4)) < 1e-15);
    CHECK(at.tip == chain.target);
    CHECK(glm::distance(at.normal, glm::dvec3(0, -1, 0)) < 1e-15);
    CHECK(at.scale == 1.0);
    CHECK(at.residual == 0.0);
    CHECK(at.reason == Reason::reached);
    chain.bend = -1;
    at = solve_two_bone(chain);
    CHECK(glm::distance(at.elbow, glm::dvec3(2.8, 1.0, -1.4)) < 1e-15);
    CHECK(glm::distance(at.normal, glm::dvec3(0, 1, 0)) < 1e-15);
}

TEST_CASE("in a plane the angles are those of the textbook", "[two_bone]") {
    RandomTwoBones random(1);
    for (int i = 0; i < 1000; ++i) {
        const double l1 = random.between(0.2, 2.0);
        const double l2 = random.between(0.2, 2.0);
        const double distance = random.between(1.01 * std::abs(l1 - l2) + 1e-3, 0.99 * (l1 + l2));
        const double turn = random.between(-pi, pi);
        const double x = distance * std::cos(turn);
        const double y = distance * std::sin(turn);
        // In more digits: close to the root the textbook's cosines cancel.
        using Long = long double;
        const Long a = l1, b = l2, along = x, across = y;
        const Long th2 = std::acos((along * along + across * across - a * a - b * b) / (2.0L * a * b));
        const Long th1 = std::atan2(-(b * std::sin(th2)) * along + (a + b * std::cos(th2)) * across,
                                    (b * std::sin(th2)) * across + (a + b * std::cos(th2)) * along);
        // th2 > 0 turns left at the elbow, which is therefore on the right of the line to the target.
        const TwoBone chain{
            .root = {0, 0, 0}, .target = {x, y, 0}, .pole = {y, -x, 0}, .length1 = l1, .length2 = l2};
        const glm::dvec3 elbow(static_cast<double>(a * std::cos(th1)), static_cast<double>(a * std::sin(th1)),
                               0.0);
        CHECK(glm::distance(solve_two_bone(chain).elbow, elbow) < 1e-12);
    }
}

TEST_CASE("random chains reach, keep their lengths and bend to the pole's side", "[two_bone]") {
    RandomTwoBones random(2);
    for (int i = 0; i < 20000; ++i) {
        TwoBone chain = random.reachable();
        const double length = chain.length1 + chain.length2;
        for (const int bend : {1, -1}) {
            chain.bend = bend;
            const TwoBoneSolution at = solve_two_bone(chain);
            REQUIRE(at.reason == Reason::reached);
            REQUIRE(at.residual == 0.0);
            REQUIRE(at.tip == chain.target);
            REQUIRE(length_error(chain, at) <= 2e-15 * length);
            REQUIRE(std::abs(glm::length(at.normal) - 1.0) < 1e-15);

            const glm::dvec3 line = glm::normalize(chain.target - chain.root);
            const glm::dvec3 to_pole = across(chain.pole - chain.root, line);
            const glm::dvec3 to_elbow = across(at.elbow - chain.root, line);
            if (glm::length(to_pole) <
                1.1 * pole_band_no_plane * std::max(glm::length(chain.pole - chain.root), length))
                continue;
            REQUIRE(bend * glm::dot(to_elbow, to_pole) >= 0.0);
            REQUIRE(glm::length(glm::cross(to_elbow, glm::normalize(to_pole))) < 1e-12 * length);
            REQUIRE(glm::dot(glm::cross(at.normal, line), to_elbow) >= 0.0);
        }
    }
}

TEST_CASE("without a pole the two bend directions are mirror images", "[two_bone]") {
    RandomTwoBones random(3);
    for (int i = 0; i < 2000; ++i) {
        TwoBone chain = random.reachable();
        const glm::dvec3 line = glm::normalize(chain.target - chain.root);
        if (i % 2 == 0) chain.pole = chain.root + 3.0 * line + random.at_distance(0.0, 1e-3);
        chain.bend = 1;
        const glm::dvec3 towards = solve_two_bone(chain).elbow - chain.root;
        chain.bend = -1;
        const glm::dvec3 away = solve_two_bone(chain).elbow - chain.root;
        CHECK(glm::distance(across(towards, line), -across(away, line)) < 1e-13);
        CHECK(glm::dot(towards, line) == Approx(glm::dot(away, line)).margin(1e-13));
    }
}

TEST_CASE("out of reach the chain is exactly straight or folded", "[two_bone]") {
    RandomTwoBones random(4);
    for (int i = 0; i < 2000; ++i) {
        TwoBone chain = random.reachable();
        chain.root = {0, 0, 0};
        const glm::dvec3 line = random.direction();
        const double longest = chain.length1 + chain.length2;
        const double shortest = std::abs(chain.length1 - chain.length2);

        chain.target = line * longest * random.between(1.001, 100.0);
        TwoBoneSolution at = solve_two_bone(chain);
        CHECK(at.reason == Reason::too_far);
        CHECK(at.residual == Approx(glm::length(chain.target) - longest).epsilon(1e-12));
        CHECK(glm::distance(at.tip, longest * line) < 1e-15 * longest);
        CHECK(glm::distance(at.elbow, chain.length1 * line) < 1e-15 * longest);

        if (shortest < 0.01) continue;
        chain.target = line * shortest * random.between(0.001, 0.999);
        at = solve_two_bone(chain);
        CHECK(at.reason == Reason::too_near);
        CHECK(at.residual == Approx(shortest - glm::length(chain.target)).epsilon(1e-12));
        CHECK(glm::distance(at.tip, shortest * line) < 1e-15 * longest);
        const double side = chain.length1 > chain.length2 ? 1.0 : -1.0;
        CHECK(glm::distance(at.elbow, side * chain.length1 * line) < 1e-15 * longest);
        CHECK(length_error(chain, at) < 2e-15 * longest);
    }
}

TEST_CASE("needles keep the precision of their angles", "[two_bone]") {
    // Straight but for a hair.
    for (const double about : {1e-6, 1e-9, 1e-12, 1e-15}) {
        const TwoBone chain{.root = {0, 0, 0}, .target = {2.0 - about, 0, 0}, .pole = {0, 1, 0}};
        const double hair = 2.0 - chain.target.x;
        CHECK(solve_two_bone(chain).elbow.y == Approx(std::sqrt(hair - 0.25 * hair * hair)).epsilon(1e-15));
    }
    // A short upper arm: its direction is not lost beside the long one.
    const double l1 = 1e-9;
    const TwoBone chain{
        .root = {0, 0, 0}, .target = {1, 0, 0}, .pole = {0, 1, 0}, .length1 = l1, .length2 = 1.0};
    const TwoBoneSolution at = solve_two_bone(chain);
    CHECK(at.elbow.x == Approx(0.5 * l1 * l1).epsilon(1e-6).margin(1e-24));
    CHECK(at.elbow.y == Approx(l1).epsilon(1e-15));
}

TEST_CASE("triangle_angle is exact for flat, tiny and huge triangles", "[two_bone]") {
    CHECK(triangle_angle(3.0, 4.0, 5.0) == Approx(0.5 * pi).epsilon(1e-15));
    CHECK(triangle_angle(1.0, 1.0, 1.0) == Approx(pi / 3.0).epsilon(1e-15));
    CHECK(triangle_angle(2.0, 1.0, 0.5) == 0.0);
    CHECK(triangle_angle(2.0, 1.0, 3.5) == pi);
    CHECK(triangle_angle(1.0, 1.0, 1e-9) == Approx(1e-9).epsilon(1e-15));
    CHECK(triangle_angle(1e-310, 1e-310, 1e-310) == Approx(pi / 3.0).epsilon(1e-12));
    CHECK(triangle_angle(1e308, 1e308, 1e308) == Approx(pi / 3.0).epsilon(1e-15));
    CHECK(triangle_angle(0.0, 1.0, 1.0) == 0.5 * pi);
    CHECK(triangle_angle(0.0, 0.0, 0.0) == 0.5 * pi);
    // The textbook's formula is wrong in the fourth digit here.
    CHECK(triangle_angle(1.0, 1.0 + 1e-12, 1.1e-12) == Approx(std::sqrt(0.21) * 1e-12).epsilon(1e-3));
}

TEST_CASE("soft_reach agrees with its formula", "[two_bone]") {
    const double reach = 2.0;
    for (const double soft : {0.01, 0.5, 2.0}) {
        CAPTURE(soft);
        const double start = reach - soft;
        const double end = reach + 2.0 * soft;
        CHECK(soft_reach(0.5 * start, reach, soft) == 0.5 * start);
        CHECK(soft_reach(start, reach, soft) == start);
        CHECK(soft_reach(end, reach, soft) == reach);
        CHECK(soft_reach(end * (1.0 - 1e-9), reach, soft) <= reach);
        CHECK(soft_reach(1e300, reach, soft) == reach);
        const double h = 1e-5 * soft;
        const auto slope = [&](double d) {
            return (soft_reach(d + h, reach, soft) - soft_reach(d - h, reach, soft)) / (2.0 * h);
        };
        const auto bend = [&](double d) { return (slope(d + h) - slope(d - h)) / (2.0 * h); };
        CHECK(slope(start + h) == Approx(1.0).epsilon(2e-5));
        CHECK(slope(end - h) == Approx(0.0).margin(1e-8));
        CHECK(bend(start + 3.0 * h) * soft == Approx(-2.0 / 3.0).epsilon(1e-3));
        CHECK(bend(end - 3.0 * h) * soft == Approx(0.0).margin(1e-3));
        double last = 0.0;
        for (double d = 0.0; d < end + 1.0; d += 1e-3 * soft) {
            const double r = soft_reach(d, reach, soft);
            const double t = std::clamp((d - start) / (3.0 * soft), 0.0, 1.0);
            const double wanted = d < start ? d : reach - soft * std::pow(1.0 - t, 3.0);
            REQUIRE(r == Approx(wanted).epsilon(1e-14).margin(1e-15));
            REQUIRE(r >= last);
            REQUIRE(r <= std::min(d, reach));
            last = r;
        }
    }
    CHECK(soft_reach(1.9, reach, 0.0) == 1.9);
    CHECK(soft_reach(2.1, reach, 0.0) == reach);
    CHECK(soft_reach(1e-200, reach, reach) == 1e-200);
    CHECK(soft_reach(2.0, reach, 7.0) == soft_reach(2.0, reach, reach));
    CHECK(soft_reach(1.0, 0.0, 0.0) == 0.0);
}

TEST_CASE("a soft arm slows before it is straight", "[two_bone]") {
    TwoBone chain{.root = {0, 0, 0}, .target = {1.7, 0, 0}, .pole = {0, 1, 0}, .softness = 0.25};
    CHECK(solve_two_bone(chain).residual == 0.0);
    chain.target.x = 1.9;
    TwoBoneSolution at = solve_two_bone(chain);
    CHECK(at.reason == Reason::too_far);
    CHECK(at.tip.x == Approx(soft_reach(1.9, 2.0, 0.25)).epsilon(1e-15));
    CHECK(at.residual == Approx(1.9 - at.tip.x).epsilon(1e-12));
    CHECK(length_error(chain, at) < 1e-15);
    chain.target.x = 2.5;
    at = solve_two_bone(chain);
    CHECK(at.elbow == glm::dvec3(1, 0, 0));
    CHECK(at.tip == glm::dvec3(2, 0, 0));

    // The angle of the knee: no jump in it or in its velocity on the way through the soft zone.
    double last_angle = 0.0, last_velocity = 0.0;
    const double step = 1e-4;
    for (double d = 1.5; d < 2.8; d += step) {
        chain.target.x = d;
        at = solve_two_bone(chain);
        const double angle = std::atan2(at.elbow.y, at.elbow.x);
        const double velocity = (angle - last_angle) / step;
        if (d > 1.5 + 1.5 * step) {
            REQUIRE(std::abs(velocity) < 1.5);
            REQUIRE(std::abs(velocity - last_velocity) < 0.03);
        }
        last_angle = angle;
        last_velocity = d > 1.5 ? velocity : -0.76;
    }
}

TEST_CASE("stretch lengthens a chain by its share of the missing length", "[two_bone]") {
    RandomTwoBones random(5);
    for (int i = 0; i < 2000; ++i) {
        TwoBone chain = random.reachable();
        const double longest = chain.length1 + chain.length2;
        const glm::dvec3 line = random.direction();
        const double distance = longest * random.between(0.9, 3.0);
        chain.target = chain.root + distance * line;
        chain.softness = i % 2 == 0 ? 0.0 : 0.3 * longest;
        chain.stretch = i % 3 == 0 ? 1.0 : random.between(0.0, 1.0);
        const TwoBoneSolution at = solve_two_bone(chain);
        const double reach =
            std::max(soft_reach(distance, longest, chain.softness), std::abs(chain.length1 - chain.length2));
        const double wanted = 1.0 + chain.stretch * std::max(distance / reach - 1.0, 0.0);
        CHECK(at.scale == Approx(wanted).epsilon(1e-13));
        CHECK(glm::distance(at.tip, chain.root + reach * wanted * line) < 1e-13);
        CHECK(length_error(chain, at) < 1e-14 * longest * at.scale);
        CHECK(at.residual == Approx(glm::distance(at.tip, chain.target)).margin(1e-13));
        if (chain.stretch == 1.0) CHECK(at.reason == Reason::reached);
        if (chain.stretch < 0.99 && distance > 1.01 * reach) CHECK(at.reason == Reason::too_far);
    }
    const TwoBone nothing{.length1 = 0.0, .length2 = 0.0, .stretch = 1.0};
    CHECK(solve_two_bone(nothing).tip == nothing.root);
    CHECK(solve_two_bone(nothing).reason == Reason::too_far);
}

TEST_CASE("many chains are solved as one is", "[two_bone]") {
    RandomTwoBones random(6);
    std::vector<TwoBone> chains;
    // Beside each kind every other one, and an odd number of them.
    const auto any_kind = [&] {
        const double kind = random.between(0.0, 5.0);
        TwoBone chain = kind < 1.0 ? random.wild() : random.reachable();
        if (kind > 2.0) chain.plane = random.direction();
        if (kind > 3.0) chain.pole = chain.target + 0.05 * random.direction();
        if (kind > 4.0) chain.target = chain.root + random.between(0.0, 2.0) * (chain.target - chain.root);
        if (kind > 4.5) chain.softness = chain.stretch = random.between(0.0, 1.0);
        return chain;
    };
    for (int i = 0; i < 20001; ++i) chains.push_back(any_kind());
    std::vector<TwoBoneSolution> solutions(chains.size());
    std::vector<TwoBoneKernel> kernels(two_bone_kernels().begin(), two_bone_kernels().end());
    kernels.push_back({"public", &solve_two_bones});
    for (const TwoBoneKernel& kernel : kernels) {
        INFO(kernel.name);
        solutions.assign(chains.size(), {});
        kernel.solve(chains, solutions);
        for (std::size_t i = 0; i < chains.size(); ++i)
            REQUIRE(same_bits(solutions[i], solve_two_bone(chains[i])));
    }
    CHECK_NOTHROW(solve_two_bones({}, {}));
    CHECK_THROWS_AS(solve_two_bones(chains, std::span(solutions).first(7)), std::invalid_argument);
}
