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

namespace {

double distance_to_segment(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
    const glm::dvec3 way = b - a;
    const double square = glm::dot(way, way);
    const double share = square > 0.0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - a - share * way);
}

}  // namespace

TEST_CASE("a ball and a floor are not entered by more than a tenth of the thickness", "[strand]") {
    Link link;
    link.thickness = 0.02;
    // A ball that runs through a hanging chain at 5 m/s, and a floor onto which it is let down at 5 m/s.
    Shot shot(2.0, straight(10, 1.0, {0, 0, -1}));
    add_obstacle(shot, {Obstacle::Shape::capsule, 0.2, 0.5}, [](double t) {
        const glm::dvec3 middle(5.0 * (t - 0.4), 0.01, -0.6);
        return std::array{middle, middle};
    });
    const Motion hit = solved(chain(10, link), shot);
    double deepest = 0.0;
    for (double time = 0.0; time <= 2.0; time += 1e-3) {
        const auto now = places(hit, time);
        const glm::dvec3 middle(5.0 * (time - 0.4), 0.01, -0.6);
        for (std::size_t i = 1; i < now.size(); ++i)
            deepest = std::max(deepest, 0.22 - distance_to_segment(now[i - 1], now[i], middle));
    }
    CHECK(deepest < 0.002);

    Shot fall(3.0, straight(10, 1.0, glm::normalize(glm::dvec3(1, 0, 1))));
    for (std::size_t i = 0; i <= 10; ++i) {
        const glm::dvec3 rest = fall.poses[i];
        fall.pose(i, [&](double t) { return rest + glm::dvec3(0, 0, 2.0 - std::min(5.0 * t, 1.95)); });
    }
    add_obstacle(fall, {Obstacle::Shape::plane, 0.0, 0.5}, [](double) {
        return std::array{glm::dvec3(0), glm::dvec3(0, 0, 1)};
    });
    const Motion lying = solved(chain(10, link), fall);
    double lowest = 1.0;
    for (double time = 0.0; time <= 3.0; time += 1e-3)
        for (const glm::dvec3& place : places(lying, time)) lowest = std::min(lowest, place.z);
    CHECK(lowest > 0.018);
    // It lies there at rest.
    const auto one = places(lying, 2.9), two = places(lying, 3.0);
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(glm::length(two[i] - one[i]) / 0.1 < 1e-4);
}

TEST_CASE("a strand whose root is in a ball hangs from it", "[strand]") {
    // Between two places, as a rope; the root lies within the ball, or beside it.
    Link link;
    link.thickness = 0.012;
    link.drag = 0.5;
    constexpr std::size_t links = 24;
    for (const double aside : {0.0, 0.03, 0.08, 0.105}) {
        Shot shot(4.0, straight(links, 3.0, {1, 0, 0}));
        shot.pinned = {links};
        shot.pin_places.assign(shot.times.size(), {2.3, 0.0, 0.0});
        shot.pin_weights.assign(shot.times.size(), 1.0);
        add_obstacle(shot, {Obstacle::Shape::capsule, 0.085, 0.5}, [&](double) {
            return std::array{glm::dvec3(-0.02, aside, 0.03), glm::dvec3(-0.02, aside, 0.03)};
        });
        const Motion motion = solved(chain(links, link), shot, {.settle = 4.0});
        double mean = 0.0, fastest = 0.0;
        const auto before = places(motion, 3.9), now = places(motion, 4.0);
        for (std::size_t i = 0; i < now.size(); ++i) {
            mean += now[i].z / static_cast<double>(now.size());
            fastest = std::max(fastest, glm::length(now[i] - before[i]) / 0.1);
        }
        CAPTURE(aside, mean, fastest);
        CHECK(mean < (aside > 0.0 ? -0.4 : -0.25));  // from the middle it hangs over the ball
        CHECK(fastest < 0.5);
        if (aside <= 0.03) CHECK(glm::length(now[1] - glm::dvec3(-0.02, aside, 0.03)) > 0.085 + 0.9 * 0.012);
    }
}

TEST_CASE("friction holds on a slope, and lets go on a steeper one", "[strand]") {
    for (const double friction : {0.3, 0.7}) {
        // A free particle: its link stretches without resistance.
        const double angle = 0.5;
        const glm::dvec3 normal(-std::sin(angle), 0.0, std::cos(angle)),
            along(std::cos(angle), 0.0, std::sin(angle));
        Shot shot(1.0, {{0, 0, 1}, normal * 0.1});
        add_obstacle(shot, {Obstacle::Shape::plane, 0.0, friction}, [&](double) {
            return std::array{glm::dvec3(0), normal};
        });
        const Motion motion = solved(chain(1, {.stretch = 1e6, .thickness = 0.1}), shot);
        const double way = glm::dot(places(motion, 1.0)[1] - normal * 0.1, along);
        const double expected = -0.5 * g * std::max(std::sin(angle) - friction * std::cos(angle), 0.0);
        CAPTURE(friction, way, expected);
        CHECK(std::abs(way - expected) < 0.01 * std::abs(expected) + 1e-6);
    }
}

namespace {

/// A box around the origin, half of whose sides are `half`.
std::shared_ptr<const Surface> box(const glm::vec3& half) {
    std::vector<glm::vec3> positions;
    for (int corner = 0; corner < 8; ++corner)
        positions.emplace_back((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                               (corner & 4) != 0 ? half.z : -half.z);
    const std::vector<glm::ivec3> triangles{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                            {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return std::make_shared<const Surface>(positions, triangles);
}

glm::dmat4 moved_to(const glm::dvec3& place, double turn = 0.0) {
    glm::dmat4 matrix(1.0);
    matrix[0] = {std::cos(turn), std::sin(turn), 0.0, 0.0};
    matrix[1] = {-std::sin(turn), std::cos(turn), 0.0, 0.0};
    matrix[3] = glm::dvec4(place, 1.0);
    return matrix;
}

}  // namespace

TEST_CASE("a mesh that moves at 5 m/s is not entered by more than a tenth of the thickness", "[strand]") {
    const glm::vec3 half(0.3f, 1.0f, 0.3f);
    Shot shot(1.0, straight(20, 1.0, {0, 0, -1}));
    shot.surfaces = {{box(half)}};
    const auto middle = [](double t) { return glm::dvec3(5.0 * t - 1.5, 0.0, -0.6); };
    for (const double time : shot.times) shot.surface_matrices.push_back(moved_to(middle(time)));
    const Motion motion = solved(chain(20, {.drag = 0.5, .thickness = 0.02}), shot);
    double deepest = -1.0;
    bool is_pushed = false;
    for (double time = 0.0; time <= 1.0; time += 1e-3) {
        const auto now = places(motion, time);
        for (const glm::dvec3& place : now) {
            if (&place == &now.front()) continue;  // the root stays on the pose, here outside
            const glm::dvec3 at = glm::abs(place - middle(time)) - glm::dvec3(half);
            const double outside = glm::length(glm::max(at, glm::dvec3(0.0))),
                         inside = std::min(std::max({at.x, at.y, at.z}), 0.0);
            deepest = std::max(deepest, 0.02 - (outside + inside));
            is_pushed = is_pushed || place.x > 0.3;
        }
    }
    CHECK(deepest < 0.002);
    CHECK(is_pushed);
}

TEST_CASE("strands lie on a mesh at rest, and ride on one that turns", "[strand]") {
    const Link link{.drag = 1.0, .thickness = 0.02};
    Shot shot(4.0, straight(10, 1.0, glm::normalize(glm::dvec3(1, 0, 0.5))), 48.0);
    for (std::size_t i = 0; i <= 10; ++i)
        shot.pose(i, [rest = shot.poses[i]](double) { return rest + glm::dvec3(0, 0, 0.2); });
    shot.surfaces = {{box({3.0f, 3.0f, 0.1f}), 0.01, 0.8}};
    shot.surface_matrices.assign(shot.times.size(), moved_to({0, 0, -0.1}));
    const Motion lying = solved(chain(10, link), shot);
    // The first links hang from the root and still swing.
    const auto one = places(lying, 3.9), two = places(lying, 4.0);
    for (std::size_t i = 4; i < one.size(); ++i) {
        CHECK(glm::length(two[i] - one[i]) / 0.1 < 1e-4);
        CHECK(std::abs(one[i].z - 0.03) < 2e-3);
    }
    // Without any thickness, too.
    Shot thin(4.0, {{0, 0, 0.5}, {0.3, 0, 0.5}}, 48.0);
    thin.surfaces = {{box({3.0f, 3.0f, 0.1f})}};
    thin.surface_matrices.assign(thin.times.size(), moved_to({0, 0, -0.1}));
    const auto landed = places(solved(chain(1, {.stretch = 1e6}), thin), 4.0);
    CHECK(std::abs(landed[1].z) < 1e-3);
    // A free particle on a table that turns slowly: friction takes it along.
    Shot table(2.0, {{0, 0, 1}, {1, 0, 0.02}}, 96.0);
    table.surfaces = {{box({3.0f, 3.0f, 0.1f}), 0.0, 0.8}};
    for (const double time : table.times)
        table.surface_matrices.push_back(moved_to({0, 0, -0.1}, 0.5 * time * time * 0.3));
    const glm::dvec3 end = places(solved(chain(1, {.stretch = 1e6, .thickness = 0.02}), table), 2.0)[1];
    CHECK(std::abs(std::atan2(end.y, end.x) - 0.6) < 0.01);
    CHECK(std::abs(std::hypot(end.x, end.y) - 1.0) < 0.01);
}

namespace {

/// The least distance of two links at a time.
double distance_of_links(const std::vector<glm::dvec3>& now, std::size_t first, std::size_t second) {
    constexpr int parts = 40;
    double least = std::numeric_limits<double>::infinity();
    for (int part = 0; part <= parts; ++part) {
        const double share = static_cast<double>(part) / parts;
        const glm::dvec3 place = now[first - 1] + share * (now[first] - now[first - 1]);
        least = std::min(least, distance_to_segment(now[second - 1], now[second], place));
    }
    return least;
}

}  // namespace

TEST_CASE("a rope that is drawn across another one does not go through it", "[strand]") {
    // Links 1 to 8 hang between two pins along X; links 10 to 15 hang from a root that is drawn along Y.
    constexpr double thickness = 0.02;
    Link link;
    link.thickness = thickness;
    link.drag = 0.5;
    std::vector<Link> links = chain(8, link);
    for (const Link& one : chain(6, link)) links.push_back(one);
    for (std::size_t i = 10; i < links.size(); ++i) links[i].parent = static_cast<int>(i) - 1;
    std::vector<glm::dvec3> pose = straight(8, 1.0, {1, 0, 0});
    for (glm::dvec3& place : pose) place -= glm::dvec3(0.5, 0.0, 0.0);
    const double across = GENERATE(0.0, 0.03);
    for (const glm::dvec3& place : straight(6, 0.6, {0, 0, -1}))
        pose.push_back(place + glm::dvec3(across, -0.4, 0.3));
    Shot shot(2.0, pose);
    for (std::size_t i = 9; i < pose.size(); ++i)
        shot.pose(i, [&, i](double t) { return pose[i] + glm::dvec3(0.0, 0.6 * t, 0.0); });
    shot.pinned = {8};
    shot.pin_places.assign(shot.times.size(), {0.49, 0.0, 0.0});
    shot.pin_weights.assign(shot.times.size(), 1.0);
    for (const bool are_touching : {true, false}) {
        shot.are_touching = are_touching;
        const Motion motion = solved(links, shot);
        double least = 1.0, farthest = 0.0;
        for (double time = 0.0; time <= 2.0; time += 0.01) {
            const auto now = places(motion, time);
            for (std::size_t i = 1; i <= 8; ++i) {
                farthest = std::max(farthest, now[i].y);
                for (std::size_t k = 10; k < links.size(); ++k)
                    least = std::min(least, distance_of_links(now, i, k));
            }
        }
        if (are_touching) {
            CHECK(least > 2.0 * thickness - 0.1 * thickness);
            CHECK(least < 2.1 * thickness);
            CHECK(farthest > 0.01);
        } else {
            CHECK(least < thickness);
            CHECK(farthest == 0.0);
        }
    }
}

TEST_CASE("links that the pose has near each other are left where they are", "[strand]") {
    Link link;
    link.thickness = 0.1;
    link.frequency = 2.0;
    std::vector<Link> links = chain(6, link);
    for (const Link& one : chain(6, link)) links.push_back(one);
    for (std::size_t i = 8; i < links.size(); ++i) links[i].parent = static_cast<int>(i) - 1;
    std::vector<glm::dvec3> pose = straight(6, 0.4, {1, 0, 0});
    for (const glm::dvec3& place : straight(6, 0.4, {1, 0, 0}))
        pose.push_back(place + glm::dvec3(0.0, 0.05, 0.0));
    Shot shot(1.0, pose);
    shot.gravity.clear();
    CHECK(Motion(links, shot.inputs()).near_pairs() == 0);
    shot.are_touching = true;
    // Each with those of the other chain and of its own that it does not hang on, three of 0.067 m away.
    CHECK(Motion(links, shot.inputs()).near_pairs() > 40);
    const auto now = places(solved(links, shot), 1.0);
    for (std::size_t i = 0; i < now.size(); ++i) CHECK(glm::length(now[i] - pose[i]) < 1e-9);
}

TEST_CASE("strands that lie on each other come to rest", "[strand]") {
    // Three ropes fall crosswise on a floor.
    Link link;
    link.thickness = 0.02;
    link.drag = 1.0;
    std::vector<Link> links;
    std::vector<glm::dvec3> pose;
    for (int rope = 0; rope < 3; ++rope) {
        const double turn = 0.6 * rope;
        const glm::dvec3 along(std::cos(turn), std::sin(turn), 0.0);
        const auto first = static_cast<int>(links.size());
        for (int i = 0; i <= 8; ++i) {
            links.push_back(link);
            links.back().parent = i == 0 ? -1 : first + i - 1;
            pose.push_back(0.08 * i * along + glm::dvec3(0.0, 0.0, 0.02 + 0.04 * rope) - 0.3 * along);
        }
    }
    Shot shot(4.0, pose);
    shot.are_touching = true;
    shot.obstacles = {{Obstacle::Shape::plane, 0.0, 0.5}};
    for (std::size_t k = 0; k < shot.times.size(); ++k) {
        shot.obstacle_places.emplace_back(0.0, 0.0, 0.0);
        shot.obstacle_places.emplace_back(0.0, 0.0, 1.0);
    }
    const Motion motion = solved(links, shot);
    const auto before = places(motion, 3.9), now = places(motion, 4.0);
    double fastest = 0.0, lowest = 1.0, nearest = 1.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        fastest = std::max(fastest, glm::length(now[i] - before[i]) / 0.1);
        if (links[i].parent < 0) continue;
        lowest = std::min(lowest, now[i].z);
        for (std::size_t k = 0; k < i / 9 * 9; ++k)
            if (links[k].parent >= 0) nearest = std::min(nearest, distance_of_links(now, i, k));
    }
    CHECK(fastest < 5e-3);
    CHECK(lowest > 0.018);
    CHECK(nearest > 0.038);
    CHECK(nearest < 0.041);
}
