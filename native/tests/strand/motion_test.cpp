#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "motus/dynamics/double_pendulum.hpp"
#include "motus/dynamics/pendulum.hpp"
#include "motus/dynamics/track.hpp"
#include "random.hpp"
#include "strand/shots.hpp"

using namespace motus::strand;
using namespace motus::test;

TEST_CASE("a link that stretches freely is the second-order system", "[strand]") {
    Random random(1);
    for (const double response : {0.0, 1.0, 2.0, -0.5}) {
        Link link{.frequency = random.between(0.5, 8.0),
                  .damping = random.between(0.0, 1.5),
                  .response = response,
                  .stretch = 1e6};
        Shot shot(2.0, {{0, 0, 0}, {0.5, 0, 0}});
        shot.gravity.clear();
        std::vector<double> inputs;
        shot.pose(1, [&](double t) {
            const glm::dvec3 place(0.5 + 0.3 * std::sin(5.0 * t), 0.2 * t, 0.4 * std::sin(3.0 * t * t));
            for (int d = 0; d < 3; ++d) inputs.push_back(place[d]);
            return place;
        });
        const Motion motion = solved(chain(1, link), shot);
        const motus::dynamics::Track track({link.frequency, link.damping, link.response}, shot.times, inputs,
                                           3);
        for (const double time : {0.1, 0.5, 1.0, 1.7, 2.0}) {
            glm::dvec3 expected;
            track.evaluate(time, {&expected.x, 3});
            const double error = glm::length(places(motion, time)[1] - expected);
            CAPTURE(response, time, error);
            CHECK(error < 1e-4);
        }
    }
}

TEST_CASE("a rigid link turns as the second-order system of its angle", "[strand]") {
    const Link link{.frequency = 2.0, .damping = 0.3};
    Shot shot(3.0, {{0, 0, 0}, {1, 0, 0}});
    shot.gravity.clear();
    std::vector<double> angles;
    shot.pose(1, [&](double t) {
        angles.push_back(0.02 * std::sin(4.0 * t));
        return glm::dvec3(std::cos(angles.back()), std::sin(angles.back()), 0.0);
    });
    const Motion motion = solved(chain(1, link), shot);
    const motus::dynamics::Track track({2.0, 0.3, 0.0}, shot.times, angles, 1);
    for (double time = 0.05; time < 3.0; time += 0.1) {
        double expected = 0.0;
        track.evaluate(time, {&expected, 1});
        const glm::dvec3 place = places(motion, time)[1];
        CHECK(std::abs(std::atan2(place.y, place.x) - expected) < 1e-3 * 0.02);
        CHECK(std::abs(glm::length(place) - 1.0) < 1e-7);
    }
}

TEST_CASE("small swings have the period of a pendulum", "[strand]") {
    for (const double length : {0.1, 1.0}) {
        const double amplitude = 0.02;
        const double period =
            2.0 * std::numbers::pi * std::sqrt(length / g) * (1.0 + amplitude * amplitude / 16.0);
        Shot shot(40.0 * period,
                  {{0, 0, 0}, glm::dvec3(std::sin(amplitude), 0, -std::cos(amplitude)) * length}, 10.0);
        const Motion motion = solved(chain(1), shot);
        // After many periods: where in its swing it is tells how long they were.
        const double after = 30.0 * period;
        const double x = places(motion, after)[1].x / (length * amplitude),
                     quarter = places(motion, after + 0.25 * period)[1].x / (length * amplitude);
        const double phase = std::atan2(-quarter, x) / (2.0 * std::numbers::pi);
        CAPTURE(length, x, quarter, phase);
        CHECK(std::abs(phase) / 30.0 < 1e-3);
        CHECK(std::abs(std::hypot(x, quarter) - 1.0) < 1e-3);
    }
}

TEST_CASE("two links swing as the double pendulum", "[strand]") {
    const double a1 = 0.03, a2 = -0.02;
    const glm::dvec3 first(0.5 * std::sin(a1), 0.0, -0.5 * std::cos(a1));
    const glm::dvec3 second = first + glm::dvec3(0.5 * std::sin(a2), 0.0, -0.5 * std::cos(a2));
    Shot shot(5.0, {{0, 0, 0}, first, second});
    const Motion motion = solved(chain(2), shot);
    motus::dynamics::DoublePendulum pendulum;
    pendulum.mass1 = pendulum.mass2 = 1.0;
    pendulum.length1 = pendulum.length2 = 0.5;
    pendulum.gravity = g;
    std::vector<double> times;
    for (double time = 0.1; time <= 5.0; time += 0.1) times.push_back(time);
    std::vector<motus::dynamics::DoublePendulumState> states(times.size());
    motus::dynamics::double_pendulum(pendulum, {a1, a2, 0.0, 0.0}, times, states);
    double worst = 0.0;
    for (std::size_t k = 0; k < times.size(); ++k) {
        const auto now = places(motion, times[k]);
        const double x1 = 0.5 * std::sin(states[k].theta1), x2 = x1 + 0.5 * std::sin(states[k].theta2);
        worst = std::max({worst, std::abs(now[1].x - x1), std::abs(now[2].x - x2)});
    }
    CAPTURE(worst);
    CHECK(worst < 0.01 * 0.025);
}

TEST_CASE("a hanging chain at rest is the discrete catenary", "[strand]") {
    // 20 links of equal length between two pins: the horizontal force is the same everywhere, and the slope
    // of a link is the weight below it over that force. The force is found by bisection.
    constexpr int links = 20;
    const double length = 0.1, span = 1.2;
    const auto slope = [&](int i, double force) { return (i - 0.5 * (links - 1)) / force; };
    const auto reach = [&](double force) {
        double sum = 0.0;
        for (int i = 0; i < links; ++i) sum += length / std::hypot(1.0, slope(i, force));
        return sum;
    };
    double low = 1e-6, high = 1e6;
    for (int k = 0; k < 200; ++k) (reach(std::sqrt(low * high)) < span ? low : high) = std::sqrt(low * high);
    std::vector<glm::dvec3> expected{{0, 0, 0}};
    for (int i = 0; i < links; ++i) {
        const double cosine = 1.0 / std::hypot(1.0, slope(i, low));
        expected.push_back(expected.back() +
                           glm::dvec3(length * cosine, 0.0, length * cosine * slope(i, low)));
    }
    // The pose: an arc of the right length, whose end the pin holds elsewhere.
    Shot shot(0.5, straight(links, links * length, {1, 0, 0}));
    shot.pinned = {links};
    shot.pin_places.assign(shot.times.size(), {span, 0, 0});
    shot.pin_weights.assign(shot.times.size(), 1.0);
    const Motion motion = solved(chain(links), shot, {.settle = 60.0});
    for (const double time : {0.0, 0.25, 0.5}) {
        const auto now = places(motion, time);
        double worst = 0.0;
        for (std::size_t i = 0; i < now.size(); ++i)
            worst = std::max(worst, glm::length(now[i] - expected[i]));
        CAPTURE(time, worst);
        CHECK(worst < 1e-4 * links * length);
    }
}

TEST_CASE("links without stretch keep their length", "[strand]") {
    for (const double mass : {1.0, 1e6, 1e-6}) {
        Shot shot(2.0, straight(20, 2.0, {1, 0, 0}));
        shot.gravity = {10.0 * down};
        std::vector<Link> links = chain(20);
        links.back().mass = mass;
        const Motion motion = solved(links, shot);
        double worst = 0.0;
        for (double time = 0.0; time <= 2.0; time += 0.01) {
            const auto now = places(motion, time);
            for (std::size_t i = 1; i < now.size(); ++i)
                worst = std::max(worst, std::abs(glm::length(now[i] - now[i - 1]) / 0.1 - 1.0));
        }
        CAPTURE(mass, worst);
        CHECK(worst < 1e-3);
    }
}

TEST_CASE("a pin out of reach stretches all links alike", "[strand]") {
    Shot shot(2.0, straight(10, 1.0, {1, 0, 0}));
    shot.pinned = {10};
    for (const double time : shot.times) {
        shot.pin_places.push_back({1.0 + std::min(time, 1.0), 0.0, 0.0});
        shot.pin_weights.push_back(1.0);
    }
    const Motion motion = solved(chain(10), shot);
    for (const double time : {0.5, 1.0, 1.5, 2.0}) {
        const auto now = places(motion, time);
        const double wanted = 0.1 * (1.0 + std::min(time, 1.0));
        for (std::size_t i = 1; i < now.size(); ++i) {
            CAPTURE(time, i, now[i].x, now[i].z);
            CHECK(std::abs(glm::length(now[i] - now[i - 1]) / wanted - 1.0) < 0.01);
        }
    }
}

TEST_CASE("a loop closes", "[strand]") {
    Shot shot(2.0, straight(8, 0.8, {1, 0, 0}));
    for (std::size_t i = 0; i <= 8; ++i) {
        const glm::dvec3 rest = shot.poses[i];
        shot.pose(i, [&](double t) {
            return rest +
                   glm::dvec3(0, 0.3 * std::sin(std::numbers::pi * t), 0.1 * std::cos(std::numbers::pi * t));
        });
    }
    Link link{.frequency = 1.0, .drag = 0.5};
    const Motion motion = solved(chain(8, link), shot, {.is_loop = true});
    CHECK(motion.gap() < 1e-4);
    const auto first = places(motion, 0.0), last = places(motion, 2.0 - 1e-9), later = places(motion, 20.0);
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK(glm::length(first[i] - last[i]) < 1e-4);
        CHECK(glm::length(first[i] - later[i]) < 1e-9);
    }
}

TEST_CASE("any time may be asked for first, in any order", "[strand]") {
    Shot shot(1.0, straight(5, 1.0, {1, 0, 0}));
    const Motion motion = solved(chain(5), shot), same = solved(chain(5), shot);
    std::vector<std::vector<glm::dvec3>> forth;
    for (int k = 0; k <= 100; ++k) forth.push_back(places(motion, k * 0.01));
    for (int k = 100; k >= 0; --k) CHECK(places(same, k * 0.01) == forth[static_cast<std::size_t>(k)]);
    // By steps, as by one call.
    Motion slowly(chain(5), shot.inputs());
    double until = slowly.solved_until();
    while (!slowly.solve(7)) {
        CHECK(slowly.solved_until() >= until);
        until = slowly.solved_until();
        CHECK(places(slowly, until) == places(motion, until));
        CHECK(places(slowly, 1.0) == places(motion, until));
    }
    CHECK(places(slowly, 0.777) == places(motion, 0.777));
}

TEST_CASE("the end and the sampling of a shot make no difference to what comes before", "[strand]") {
    Shot shorter(1.0, straight(5, 1.0, {1, 0, 0}), 24.0), longer(2.0, straight(5, 1.0, {1, 0, 0}), 30.0);
    const Motion one = solved(chain(5), shorter), two = solved(chain(5), longer);
    for (double time = 0.0; time <= 1.0; time += 0.037) {
        const auto a = places(one, time), b = places(two, time);
        for (std::size_t i = 0; i < a.size(); ++i) CHECK(glm::length(a[i] - b[i]) < 1e-9);
    }
}

TEST_CASE("at a reset strands start anew in the pose", "[strand]") {
    Shot shot(1.0, straight(5, 1.0, {1, 0, 0}), 10.0);
    shot.resets = {5};
    for (std::size_t i = 0; i <= 5; ++i) {
        const glm::dvec3 rest = shot.poses[i];
        shot.pose(i, [&](double t) { return t < 0.45 ? rest : rest + glm::dvec3(100, 0, 0); });
    }
    const Motion motion = solved(chain(5), shot);
    CHECK(places(motion, 0.499)[0].x == 0.0);
    for (std::size_t i = 0; i <= 5; ++i) {
        CHECK(glm::length(places(motion, 0.5)[i] - glm::dvec3(100.0 + 0.2 * static_cast<double>(i), 0, 0)) <
              1e-12);
        CHECK(glm::length(places(motion, 0.75)[i] - glm::dvec3(100, 0, 0) - places(motion, 0.25)[i]) < 1e-9);
    }
}

TEST_CASE("branches swing as chains of their own where they meet in a root", "[strand]") {
    // A trunk that rests on the pose, pinned, with two branches: each as it would be alone.
    std::vector<Link> links = chain(3);
    links.push_back({.parent = 1});
    links.push_back({.parent = 4});
    Shot both(1.0, {{0, 0, 0}, {0.3, 0, 0}, {0.6, 0, 0}, {0.9, 0, 0}, {0.3, 0.3, 0}, {0.3, 0.6, 0.1}});
    both.pinned = {1};
    both.pin_places.assign(both.times.size(), {0.3, 0, 0});
    both.pin_weights.assign(both.times.size(), 1.0);
    const Motion tree = solved(links, both);
    Shot alone(1.0, {{0.3, 0, 0}, {0.3, 0.3, 0}, {0.3, 0.6, 0.1}});
    const Motion branch = solved(chain(2), alone);
    for (double time = 0.1; time <= 1.0; time += 0.1)
        for (std::size_t i = 1; i <= 2; ++i)
            CHECK(glm::length(places(tree, time)[i + 3] - places(branch, time)[i]) < 1e-6);
    // Where they meet in a free particle, lengths hold.
    both.pinned.clear();
    both.pin_places.clear();
    both.pin_weights.clear();
    const Motion free = solved(links, both);
    for (double time = 0.0; time <= 1.0; time += 0.05) {
        const auto now = places(free, time);
        for (std::size_t i = 1; i < links.size(); ++i) {
            const auto parent = static_cast<std::size_t>(links[i].parent);
            const double wanted = glm::length(both.poses[i] - both.poses[parent]);
            CHECK(std::abs(glm::length(now[i] - now[parent]) / wanted - 1.0) < 1e-5);
        }
    }
}

TEST_CASE("the error of a swing falls with the square of the step", "[strand]") {
    const auto at = [](double rate) {
        Shot shot(1.0, straight(3, 1.0, {1, 0, 0}));
        return places(solved(chain(3), shot, {.rate = rate}), 1.0);
    };
    const auto exact = at(7680.0), coarse = at(240.0), fine = at(480.0), finer = at(960.0);
    const auto error = [&](const auto& found) {
        double worst = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i)
            worst = std::max(worst, glm::length(found[i] - exact[i]));
        return worst;
    };
    CAPTURE(error(coarse), error(fine), error(finer));
    CHECK(error(coarse) / error(fine) > 3.0);
    CHECK(error(fine) / error(finer) > 3.0);
}

TEST_CASE("a chain stays near its root, whatever is done to it", "[strand]") {
    const auto farthest = [](const std::vector<Link>& links, const Shot& shot, const Solving& solving = {}) {
        const Motion motion = solved(links, shot, solving);
        double most = 0.0;
        for (double time = 0.0; time <= shot.times.back(); time += 0.01) {
            const auto now = places(motion, time);
            for (const glm::dvec3& place : now) most = std::max(most, glm::length(place - now.front()));
        }
        return most;
    };
    const double length = 1.0, more = 1.01 * length;
    std::vector<Link> links = chain(8, {.thickness = 0.02});
    Shot fast(1.0, straight(8, length, {1, 0, 0}));
    for (std::size_t i = 0; i <= 8; ++i) {
        const glm::dvec3 rest = fast.poses[i];
        fast.pose(i, [&](double t) {
            return rest + glm::dvec3(0, 100.0 * t, 50.0 * std::sin(20.0 * t));
        });  // 100 m/s and more
    }
    CHECK(farthest(links, fast) < more);
    Shot jump(1.0, straight(8, length, {1, 0, 0}));
    for (std::size_t i = 0; i <= 8; ++i) {
        const glm::dvec3 rest = jump.poses[i];
        jump.pose(
            i, [&](double t) { return t < 0.5 ? rest : rest + glm::dvec3(1000, 0, 0); });  // without a reset
    }
    CHECK(farthest(links, jump) < more);
    Shot inside(1.0, straight(8, length, {1, 0, 0}));  // begins in a ball
    add_obstacle(inside, {Obstacle::Shape::capsule, 0.5, 0.5}, [](double) {
        return std::array{glm::dvec3(0.5, 0.01, 0), glm::dvec3(0.5, 0.01, 0)};
    });
    CHECK(farthest(links, inside) < 1.5 * length);
    std::vector<Link> heavy = links;
    heavy[8].mass = 1e6;
    heavy[3].mass = 1e-6;
    CHECK(farthest(heavy, fast) < more);
    // Long ones lie on a floor without going wild: at rest in the end.
    Shot floor(6.0, straight(40, 4.0, glm::normalize(glm::dvec3(1, 0, 0.3))), 24.0);
    add_obstacle(floor, {Obstacle::Shape::plane, 0.0, 0.5}, [](double) {
        return std::array{glm::dvec3(0, 0, -0.1), glm::dvec3(0, 0, 1)};
    });
    const Motion lying = solved(chain(40, {.thickness = 0.02}), floor);
    const auto one = places(lying, 5.9), two = places(lying, 6.0);
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(glm::length(two[i] - one[i]) / 0.1 < 1e-4);
}

TEST_CASE("a strand is what it is without the others beside it", "[strand]") {
    // Beside it one that is heavier, faster, hard to solve and long to settle, and links without a length.
    std::vector<Link> links = chain(5), all = links;
    for (Link link : links) {
        link.parent += link.parent < 0 ? 0 : 6;
        link.mass = link.parent == 8 ? 1e6 : 1000.0;
        all.push_back(link);
    }
    for (const int parent : {-1, 12, 13}) all.push_back({.parent = parent});
    const auto pose = straight(5, 1.0, {1, 0, 0});
    auto three = pose;
    for (const glm::dvec3& place : pose) three.push_back(3.0 * place + glm::dvec3(0, 3, 0));
    three.insert(three.end(), 3, glm::dvec3(0, 6, 0));
    Shot shot(1.0, three);
    for (std::size_t i = 6; i < 12; ++i)
        shot.pose(i, [rest = shot.poses[i]](double t) {
            return rest + glm::dvec3(0, 0, 3.0 * std::sin(40.0 * t));
        });
    for (const double settle : {0.0, 1.0}) {
        const Motion alone = solved(links, Shot(1.0, pose), {.settle = settle}),
                     beside = solved(all, shot, {.settle = settle});
        for (const double time : {0.0, 0.3, 0.777, 1.0}) {
            const auto now = places(beside, time);
            CHECK(std::vector(now.begin(), now.begin() + 6) == places(alone, time));
            for (std::size_t i = 12; i < 15; ++i) CHECK(glm::length(now[i] - glm::dvec3(0, 6, 0)) < 1e-6);
        }
    }
}

TEST_CASE("what is not solved yet is not shown", "[strand]") {
    Shot shot(1.0, straight(3, 1.0, {1, 0, 0}), 48.0);
    Motion motion(chain(3), shot.inputs(), {.settle = 0.1, .is_loop = true});
    const auto pose = straight(3, 1.0, {1, 0, 0});
    CHECK(places(motion, -0.1) == pose);
    motion.solve(100);
    CHECK(places(motion, -0.1) == places(motion, 0.0));
    CHECK(places(motion, 0.9) == places(motion, 0.0));
}
