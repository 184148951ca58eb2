#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "strand/shots.hpp"

using namespace motus::strand;
using namespace motus::test;

TEST_CASE("bends stay within their limits", "[strand]") {
    Link link;
    link.bend = 0.3;
    Shot shot(3.0, straight(10, 1.0, {1, 0, 0}));
    const Motion motion = solved(chain(10, link), shot);
    double most = 0.0, longest = 0.0;
    for (double time = 0.0; time <= 3.0; time += 0.01) {
        const auto now = places(motion, time);
        glm::dvec3 before(1, 0, 0);
        for (std::size_t i = 1; i < now.size(); ++i) {
            const glm::dvec3 along = now[i] - now[i - 1];
            longest = std::max(longest, std::abs(glm::length(along) - 0.1));
            most =
                std::max(most, std::atan2(glm::length(glm::cross(before, along)), glm::dot(before, along)));
            before = along;
        }
    }
    CHECK((most - 0.3) * 180.0 / std::numbers::pi < 0.1);
    CHECK(longest < 1e-4);
    CHECK(most > 0.299);
}

TEST_CASE("springs between links keep the bend of the pose", "[strand]") {
    // A chain that is pulled along itself while its end lags behind folds, unless its links hold against
    // that.
    const auto largest_bend = [](double bend_frequency) {
        std::vector<Link> links = chain(8, {.damping = 0.8, .drag = 3.0, .bend_frequency = bend_frequency});
        for (std::size_t i = 0; i < links.size(); ++i)
            links[i].frequency = 3.0 / (1.0 + static_cast<double>(i));
        Shot shot(2.0, straight(8, 1.0, {1, 0, 0}));
        shot.gravity = {{0.0, 0.0, -1.0}};
        for (std::size_t i = 0; i <= 8; ++i)
            shot.pose(i, [rest = shot.poses[i]](double t) {
                return rest + glm::dvec3(0, 0, std::clamp(8.0 * (t - 0.5), 0.0, 0.8));
            });
        const Motion motion = solved(links, shot);
        double most = 0.0;
        for (double time = 0.0; time <= 2.0; time += 0.02) {
            const auto now = places(motion, time);
            for (std::size_t i = 2; i < now.size(); ++i) {
                const glm::dvec3 before = now[i - 1] - now[i - 2], along = now[i] - now[i - 1];
                most = std::max(most,
                                std::atan2(glm::length(glm::cross(before, along)), glm::dot(before, along)));
            }
        }
        return most;
    };
    CHECK(largest_bend(12.0) < 0.4 * largest_bend(0.0));
    // Two links of one mass, free in space: they swing against each other with the frequency, as they are
    // straight.
    Shot free(2.0, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0.05, 0}});
    std::vector<Link> links = chain(3, {.damping = 0.0, .bend_frequency = 1.0});
    free.gravity.clear();
    for (std::size_t k = 0; k < free.times.size(); ++k)
        if (k > 0) free.poses[4 * k + 3] = {3.0, 0.0, 0.0};
    free.pinned = {1, 2};
    for (std::size_t k = 0; k < free.times.size(); ++k)
        free.pin_places.insert(free.pin_places.end(), {{1, 0, 0}, {2, 0, 0}});
    free.pin_weights.assign(2 * free.times.size(), 1.0);
    const Motion swinging = solved(links, free);
    for (const double time : {0.25, 0.5, 1.0, 1.5}) {
        const double expected = 0.05 * std::cos(2.0 * std::numbers::pi * time);
        CAPTURE(time, places(swinging, time)[3].y, expected);
        CHECK(std::abs(places(swinging, time)[3].y - expected) < 0.15 * 0.05);
    }
}

TEST_CASE("a link that points backwards is turned within its limit", "[strand]") {
    // The pose folds within a step; the particle is where it was.
    Shot shot(0.2, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 480.0);
    shot.gravity.clear();
    shot.pose(2, [](double t) { return glm::dvec3(t < 0.05 ? 2.0 : 0.0, 0, 0); });
    const auto now = places(solved(chain(2, {.bend = 0.5}), shot), 0.2);
    const glm::dvec3 straight_on = glm::normalize(now[0] - now[1]), link = glm::normalize(now[2] - now[1]);
    CHECK(glm::dot(straight_on, link) > std::cos(0.5 + 0.01));
    CHECK(std::abs(glm::length(now[2] - now[1]) - 1.0) < 1e-3);
}

TEST_CASE("bends towards the side stay within an ellipse", "[strand]") {
    // The first link is thrown about by its root, and the second one has a hinge that goes farther than its
    // sides.
    constexpr double bend = 0.8, side_bend = 0.2;
    std::vector<Link> links = chain(2);
    links[2].bend = bend;
    links[2].side_bend = side_bend;
    Shot shot(4.0, straight(2, 0.6, {0, 0, -1}));
    for (std::size_t i = 0; i < 3; ++i)
        shot.pose(i, [&](double t) {
            return glm::dvec3(0.3 * std::sin(9.0 * t), 0.5 * std::sin(7.0 * t + 1.0),
                              -0.3 * static_cast<double>(i));
        });
    shot.sides.assign(shot.poses.size(), glm::dvec3(2.0, 0.0, 0.5));
    const Motion motion = solved(links, shot);
    double most_towards = 0.0, most_about = 0.0, most_of_ellipse = 0.0;
    for (double time = 0.0; time <= 4.0; time += 1.0 / 96.0) {
        const auto now = places(motion, time);
        const glm::dvec3 along = glm::normalize(now[1] - now[0]), link = glm::normalize(now[2] - now[1]);
        // The side is carried along by the smallest turn from the pose to the first link.
        const glm::dvec3 down_in_pose(0, 0, -1), axis = glm::cross(down_in_pose, along);
        const double cosine = glm::dot(down_in_pose, along);
        const glm::dvec3 side_in_pose(1, 0, 0);
        const glm::dvec3 side = side_in_pose * cosine + glm::cross(axis, side_in_pose) +
                                axis * (glm::dot(axis, side_in_pose) / (1.0 + cosine));
        const glm::dvec3 swing = glm::cross(along, link);
        const double angle = std::atan2(glm::length(swing), glm::dot(along, link));
        if (angle < 1e-6) continue;
        const glm::dvec3 about = swing * (angle / glm::length(swing));
        const double hinge = glm::dot(about, side), sideways = glm::dot(about, glm::cross(along, side));
        most_about = std::max(most_about, std::abs(hinge));
        most_towards = std::max(most_towards, std::abs(sideways));
        const double size = std::hypot(hinge / bend, sideways / side_bend);
        if (size > 0.0) most_of_ellipse = std::max(most_of_ellipse, angle - angle / size);
    }
    CHECK(most_of_ellipse * 180.0 / std::numbers::pi < 0.1);
    CHECK(most_about > 0.5);
    CHECK(most_towards > 0.19);
    CHECK(most_towards < side_bend + 0.002);
}
