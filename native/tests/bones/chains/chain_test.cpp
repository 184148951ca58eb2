#include "motus/bones/chains/chain.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "chain_checks.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::chains;
using namespace motus::bones::chains::checks;

namespace {

struct Solved {
    Joints joints;
    Convergence report;
};

Solved solve(Joints joints, const glm::dvec3& target, const SolverSettings& settings = {}) {
    const Convergence report = chains::solve(joints, target, settings);
    return {std::move(joints), report};
}

/// Checks that root and lengths are kept and that the report is true.
void check_kept(const Joints& before, const Solved& after, const glm::dvec3& target) {
    const double length = length_of(before);
    REQUIRE(after.joints.size() == before.size());
    REQUIRE(after.joints[0] == before[0]);
    for (std::size_t i = 1; i < before.size(); ++i) {
        const double kept = glm::distance(after.joints[i - 1], after.joints[i]);
        REQUIRE(std::abs(kept - glm::distance(before[i - 1], before[i])) <= 1e-12 * length);
    }
    REQUIRE(after.report.residual ==
            Approx(glm::distance(after.joints.back(), target)).epsilon(1e-12).margin(1e-15 * length));
}

/// Mean offset of the chain from the line between root and tip.
glm::dvec3 bulge_of(const Joints& joints) {
    const glm::dvec3 along = glm::normalize(joints.back() - joints[0]);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
        const double weight =
            0.5 * (glm::distance(joints[i - 1], joints[i]) + glm::distance(joints[i], joints[i + 1]));
        const glm::dvec3 away = joints[i] - joints[0];
        sum += weight * (away - glm::dot(away, along) * along);
    }
    return sum / length_of(joints);
}

}  // namespace

TEST_CASE("every target within reach is reached from every pose", "[chain]") {
    Random random(1);
    for (const std::size_t bones : {1, 2, 3, 4, 5, 8, 20, 100, 255}) {
        for (const Shape shape : all_shapes) {
            for (int round = 0; round < 60; ++round) {
                const double longest = round % 3 == 0 ? 1.5 * static_cast<double>(bones) : 1.0;
                const Joints joints = random_joints(random, shape, bones, longest);
                const double inner = inner_reach(joints);
                const double shares[] = {random.between(0.0, 1.0), 0.0, 1.0, 0.999, 1e-3, 1e-9, 1.0 - 1e-9};
                const double share = shares[round % 7];
                const double distance = inner + share * (length_of(joints) - inner);
                const glm::dvec3 target = joints[0] + distance * random.direction();
                const Solved solved = solve(joints, target);
                CAPTURE(bones, static_cast<int>(shape), round, share, solved.report.residual,
                        solved.report.iterations);
                check_kept(joints, solved, target);
                REQUIRE(solved.report.residual <= 1e-6 * length_of(joints));
                REQUIRE(solved.report.reason == Reason::reached);
                REQUIRE(solved.report.iterations <= 40);
            }
        }
    }
}

TEST_CASE("a tolerance near rounding is met", "[chain]") {
    Random random(2);
    SolverSettings settings;
    settings.tolerance = 1e-13;
    for (int round = 0; round < 300; ++round) {
        Joints joints =
            random_joints(random, all_shapes[round % 5], 3 + static_cast<std::size_t>(round % 10));
        for (glm::dvec3& joint : joints) joint -= joints[0];
        const double inner = inner_reach(joints);
        const double distance = inner + random.between(0.01, 0.99) * (length_of(joints) - inner);
        const Solved solved = solve(joints, joints[0] + distance * random.direction(), settings);
        CAPTURE(round, solved.report.residual);
        REQUIRE(solved.report.reason == Reason::reached);
    }
}

TEST_CASE("bones folded on one line do not creep to a target beside it", "[chain]") {
    Random random(21);
    for (const double noise : {0.0, 1e-9, 1e-6, 1e-3}) {
        for (const double distance : {1e-4, 0.01, 0.05, 0.1, 0.2, 0.3, 1.0}) {
            const Joints joints{{0, 0, 0}, {0, 1, 0}, {0, -1, 0}, noise * random.direction()};
            const glm::dvec3 target(distance, 0.0, 0.0);
            if (distance <= inner_reach(joints)) continue;
            const Solved solved = solve(joints, target);
            CAPTURE(noise, distance, solved.report.iterations);
            check_kept(joints, solved, target);
            REQUIRE(solved.report.reason == Reason::reached);
        }
    }
}

TEST_CASE("lengths are kept whatever the tolerance", "[chain]") {
    Random random(22);
    for (int round = 0; round < 4000; ++round) {
        const std::size_t bones = 3 + static_cast<std::size_t>(round % 3);
        const glm::dvec3 line = random.direction();
        Joints joints{glm::dvec3(0.0)};
        for (std::size_t i = 0; i < bones; ++i) {
            const double length = random.between(0.1, 1.0);
            joints.push_back(joints.back() + length * (random.chance(0.5) ? line : -line));
        }
        SolverSettings settings;
        settings.tolerance = std::pow(10.0, random.between(-9.0, 0.0));
        if (round % 2 == 0) settings.pole = joints[0] + 3.0 * random.direction();
        const double share = round % 4 < 2 ? 1.0 - std::pow(10.0, random.between(-13.0, -1.0)) : 0.5;
        const glm::dvec3 target = joints[0] + share * length_of(joints) * random.direction();
        check_kept(joints, solve(joints, target, settings), target);
    }
}

TEST_CASE("a target out of reach gives the straight chain towards it", "[chain]") {
    Random random(3);
    for (const Shape shape : all_shapes) {
        for (const double times : {1.0, 1.0 + 1e-9, 1.5, 1e6}) {
            const Joints joints = random_joints(random, shape, 7);
            const double length = length_of(joints);
            const glm::dvec3 along = random.direction();
            const glm::dvec3 target = joints[0] + times * length * along;
            const Solved solved = solve(joints, target);
            check_kept(joints, solved, target);
            REQUIRE(solved.report.reason == ((times - 1.0) > 1e-6 ? Reason::too_far : Reason::reached));
            double travelled = 0.0;
            for (std::size_t i = 1; i < joints.size(); ++i) {
                travelled += glm::distance(joints[i - 1], joints[i]);
                REQUIRE(glm::distance(solved.joints[i], joints[0] + travelled * along) <=
                        1e-14 * (length + 5.0));
            }
        }
    }
}

TEST_CASE("a target too near gives the folded chain", "[chain]") {
    Random random(4);
    for (const Shape shape : all_shapes) {
        for (const double times : {1.0, 1.0 - 1e-9, 0.5, 0.0}) {
            Joints joints = random_joints(random, shape, 5, 1.0);
            const std::size_t odd = 2;
            const glm::dvec3 more = 8.0 * glm::normalize(joints[odd + 1] - joints[odd]);
            for (std::size_t i = odd + 1; i < joints.size(); ++i) joints[i] += more;
            const double inner = inner_reach(joints);
            REQUIRE(inner > 0.0);
            const glm::dvec3 along = random.direction();
            const glm::dvec3 target = joints[0] + times * inner * along;
            const Solved solved = solve(joints, target);
            check_kept(joints, solved, target);
            REQUIRE(glm::distance(solved.joints.back(), joints[0]) == Approx(inner).epsilon(1e-13));
            const glm::dvec3 towards = glm::normalize(solved.joints.back() - joints[0]);
            for (std::size_t i = 1; i < joints.size(); ++i) {
                const glm::dvec3 bone = glm::normalize(solved.joints[i] - solved.joints[i - 1]);
                REQUIRE(glm::dot(bone, towards) == Approx(i == odd + 1 ? 1.0 : -1.0).epsilon(1e-13));
            }
            if (times > 0.0) REQUIRE(glm::distance(towards, along) < 1e-12);
            REQUIRE(solved.report.reason == (times < 0.9 ? Reason::too_near : Reason::reached));
        }
    }
}

TEST_CASE("a straight chain bends into an arc on the side of the plane", "[chain]") {
    Random random(5);
    for (const std::size_t bones : {2, 3, 6, 40}) {
        for (int round = 0; round < 20; ++round) {
            const Joints joints = random_joints(random, Shape::straight, bones);
            const double inner = inner_reach(joints);
            const double distance = inner + random.between(0.05, 0.98) * (length_of(joints) - inner);
            const glm::dvec3 along = random.direction();
            SolverSettings settings;
            settings.plane = glm::normalize(glm::cross(along, random.direction()));
            const Solved solved = solve(joints, joints[0] + distance * along, settings);
            CAPTURE(bones, round);
            REQUIRE(solved.report.residual < 1e-6 * length_of(joints));
            // In the plane, and its bulge on the stated side.
            for (const glm::dvec3& joint : solved.joints)
                REQUIRE(std::abs(glm::dot(joint - joints[0], settings.plane)) < 1e-12 * length_of(joints));
            REQUIRE(glm::dot(bulge_of(solved.joints), glm::cross(settings.plane, along)) > 0.0);
            // On a circle: the centre seen from the first three joints is as far from all others.
            const glm::dvec3 a = solved.joints[1] - solved.joints[0];
            const glm::dvec3 b = solved.joints[2] - solved.joints[0];
            const glm::dvec3 n = glm::cross(a, b);
            const glm::dvec3 centre =
                solved.joints[0] + (glm::dot(a, a) * glm::cross(b, n) - glm::dot(b, b) * glm::cross(a, n)) /
                                       (2.0 * glm::dot(n, n));
            const double radius = glm::length(solved.joints[0] - centre);
            for (const glm::dvec3& joint : solved.joints)
                REQUIRE(glm::distance(joint, centre) == Approx(radius).epsilon(1e-6));
        }
    }
}

TEST_CASE("a chain whose tip is on the target stays as it is", "[chain]") {
    Random random(6);
    for (const Shape shape : all_shapes) {
        for (int round = 0; round < 30; ++round) {
            const Joints joints = random_joints(random, shape, 2 + round);
            const Solved solved = solve(joints, joints.back());
            CAPTURE(static_cast<int>(shape), round);
            REQUIRE(largest_move(joints, solved.joints) < 1e-9 * length_of(joints));
        }
    }
}

TEST_CASE("a target moved a little moves the chain a little", "[chain]") {
    Random random(7);
    for (int round = 0; round < 200; ++round) {
        const Joints joints = random_joints(random, Shape::bent, 3 + round % 20);
        const double length = length_of(joints);
        const Solved solved = solve(joints, joints.back() + 1e-3 * length * random.direction());
        REQUIRE(largest_move(joints, solved.joints) < 1e-2 * length);
    }
}

TEST_CASE("the bend is on the pole's side", "[chain]") {
    Random random(8);
    for (const Shape shape : all_shapes) {
        for (int round = 0; round < 40; ++round) {
            const Joints joints = random_joints(random, shape, 3 + round % 5);
            const double inner = inner_reach(joints);
            const double distance = inner + random.between(0.2, 0.9) * (length_of(joints) - inner);
            const glm::dvec3 along = random.direction();
            const glm::dvec3 target = joints[0] + distance * along;
            SolverSettings settings;
            settings.tolerance = 1e-12;
            settings.pole = joints[0] + 3.0 * random.direction();
            const Solved solved = solve(joints, target, settings);
            const Solved without = solve(joints, target);
            check_kept(joints, solved, target);
            REQUIRE(solved.report.reason == Reason::reached);
            const glm::dvec3 away = *settings.pole - joints[0];
            const glm::dvec3 side = away - glm::dot(away, along) * along;
            const double sine = glm::length(side) / glm::length(away);
            const glm::dvec3 bulge = bulge_of(solved.joints);
            CAPTURE(static_cast<int>(shape), round, sine);
            REQUIRE(glm::length(bulge) == Approx(glm::length(bulge_of(without.joints))).margin(1e-5));
            if (sine > 0.1 && glm::length(bulge) > 0.1 * length_of(joints))
                REQUIRE(glm::dot(glm::normalize(bulge), glm::normalize(side)) == Approx(1.0).epsilon(1e-6));
        }
    }
}

TEST_CASE("a pole on the line from root to target does nothing, and comes in smoothly", "[chain]") {
    Random random(9);
    const Joints joints = random_joints(random, Shape::bent, 6);
    const glm::dvec3 along = random.direction();
    const glm::dvec3 target = joints[0] + 0.6 * length_of(joints) * along;
    const glm::dvec3 side = glm::normalize(glm::cross(along, random.direction()));
    SolverSettings settings;
    settings.tolerance = 1e-12;
    const Joints without = solve(joints, target, settings).joints;
    const auto with_pole = [&](double away) {
        settings.pole = joints[0] + along + away * side;
        return solve(joints, target, settings).joints;
    };
    REQUIRE(largest_move(with_pole(0.0), without) < 1e-12);
    REQUIRE(largest_jump([&](double u) { return with_pole(0.2 * u); }) < 1e-6);
    settings.pole = joints[0];
    REQUIRE(largest_move(solve(joints, target, settings).joints, without) < 1e-12);
}

TEST_CASE("the solution is continuous in the target", "[chain]") {
    Random random(10);
    SolverSettings settings;
    settings.tolerance = 1e-12;
    for (const Shape shape : {Shape::straight, Shape::bent, Shape::crooked}) {
        for (int round = 0; round < 12; ++round) {
            const Joints joints =
                random_joints(random, shape, 3 + 4 * (round % 3), round % 4 == 3 ? 6.0 : 1.0);
            const double length = length_of(joints);
            const glm::dvec3 ahead = glm::normalize(joints.back() - joints[0]);
            const glm::dvec3 side = glm::normalize(glm::cross(ahead, random.direction()));
            // From beyond reach past the root, near it, and out of reach again.
            const auto solved_at = [&](double u) {
                const glm::dvec3 away = (1.3 - 2.4 * u) * ahead + 0.05 * side;
                return solve(joints, joints[0] + length * away, settings).joints;
            };
            CAPTURE(static_cast<int>(shape), round);
            REQUIRE(largest_jump(solved_at) < 1e-5 * length);
        }
    }
}

TEST_CASE("the solution is continuous in the pose", "[chain]") {
    Random random(11);
    SolverSettings settings;
    settings.tolerance = 1e-12;
    for (int round = 0; round < 24; ++round) {
        const std::size_t bones = 3 + static_cast<std::size_t>(round % 4);
        // A chain that bends from straight on: each bone turned by its own axis, more and more.
        std::vector<glm::dvec3> axes;
        const glm::dvec3 hinge = random.direction();
        const glm::dvec3 first = glm::normalize(glm::cross(hinge, random.direction()));
        for (std::size_t i = 0; i < bones; ++i)
            axes.push_back(glm::normalize(hinge + 0.3 * random.direction()));
        const double distance = random.between(0.2, 0.9) * static_cast<double>(bones);
        const glm::dvec3 target = distance * glm::normalize(first + 0.7 * random.direction());
        settings.plane = round % 2 == 0 ? hinge : glm::dvec3(0.0);
        const auto solved_at = [&](double u) {
            Joints joints{glm::dvec3(0.0)};
            glm::dquat turn(1.0, 0.0, 0.0, 0.0);
            for (const glm::dvec3& axis : axes) {
                turn = turn * glm::angleAxis(0.8 * (u - 0.2), axis);
                joints.push_back(joints.back() + turn * first);
            }
            return solve(joints, target, settings).joints;
        };
        CAPTURE(round);
        // Without a plane nothing says where a straight chain bends.
        if (round % 2 == 0) {
            REQUIRE(largest_jump(solved_at) < 1e-5);
        } else {
            REQUIRE(largest_jump([&](double u) { return solved_at(0.3 + 0.7 * u); }) < 1e-5);
        }
    }
}

TEST_CASE("degenerate chains are defined at every size", "[chain]") {
    Random random(12);
    for (int round = 0; round < 4000; ++round) {
        const std::size_t bones = 1 + static_cast<std::size_t>(round % 9);
        const double size = std::pow(10.0, random.between(-250.0, 250.0));
        Joints joints = random_joints(random, all_shapes[round % 5], bones);
        if (random.chance(0.5)) {  // bones without length
            for (std::size_t i = 1; i < joints.size(); ++i) {
                if (random.chance(0.4)) joints[i] = joints[i - 1];
            }
        }
        glm::dvec3 target = joints[0] + length_of(joints) * random.at_distance(0.0, 1.2);
        if (random.chance(0.1)) target = joints[0];
        for (glm::dvec3& joint : joints) joint *= size;
        target *= size;
        const glm::dvec3 root = joints[0];
        if (random.chance(0.1)) {
            const double distance = std::pow(10.0, random.between(-250.0, 250.0));
            target = distance * random.direction();
        }
        SolverSettings settings;
        if (random.chance(0.3)) settings.pole = random.chance(0.2) ? root : size * random.direction();
        if (random.chance(0.3)) settings.plane = size * random.direction();
        const Joints before = joints;
        const Solved solved = solve(joints, target, settings);
        CAPTURE(round, bones, size);
        REQUIRE(std::isfinite(solved.report.residual));
        for (const glm::dvec3& joint : solved.joints)
            REQUIRE((std::isfinite(joint.x) && std::isfinite(joint.y) && std::isfinite(joint.z)));
        for (std::size_t i = 1; i < before.size(); ++i) {
            const double kept = glm::length((solved.joints[i] - solved.joints[i - 1]) / size);
            const double given = glm::length((before[i] - before[i - 1]) / size);
            REQUIRE(kept == Approx(given).margin(1e-11));
        }
        REQUIRE(solved.report.reason != Reason::iterations);
    }
}

TEST_CASE("a chain without any length stays where it is", "[chain]") {
    const Joints joints(4, glm::dvec3(1.0, 2.0, 3.0));
    const Solved away = solve(joints, {1.0, 2.0, 5.0});
    REQUIRE(away.joints == joints);
    REQUIRE(away.report.residual == 2.0);
    REQUIRE(away.report.reason == Reason::too_far);
    REQUIRE(solve(joints, joints[0]).report.reason == Reason::reached);
}

TEST_CASE("iterations are limited and counted", "[chain]") {
    Random random(13);
    SolverSettings none;
    none.max_iterations = 0;
    int stopped = 0;
    for (int round = 0; round < 100; ++round) {
        const Joints joints = random_joints(random, Shape::knotted, 6);
        const glm::dvec3 target = joints[0] + 0.5 * length_of(joints) * random.direction();
        const Solved solved = solve(joints, target, none);
        check_kept(joints, solved, target);
        REQUIRE(solved.report.iterations == 0);
        if (solved.report.reason == Reason::iterations) ++stopped;
        REQUIRE((solved.report.reason == Reason::iterations) ==
                (solved.report.residual > 1e-6 * length_of(joints)));
        REQUIRE(solve(joints, target).report.iterations > 0);
    }
    REQUIRE(stopped > 50);
}

TEST_CASE("a chain has the same solution each time and at every scale", "[chain]") {
    Random random(14);
    for (int round = 0; round < 100; ++round) {
        const Joints joints = random_joints(random, all_shapes[round % 5], 2 + round % 12);
        const glm::dvec3 target = joints[0] + length_of(joints) * random.at_distance(0.0, 1.1);
        const Solved once = solve(joints, target);
        REQUIRE(solve(joints, target).joints == once.joints);
        Joints larger = joints;
        for (glm::dvec3& joint : larger) joint *= 1024.0;
        const Solved scaled = solve(larger, 1024.0 * target);
        for (std::size_t i = 0; i < joints.size(); ++i) REQUIRE(scaled.joints[i] == 1024.0 * once.joints[i]);
        REQUIRE(scaled.report.iterations == once.report.iterations);
    }
}

TEST_CASE("a chain has 1 to 255 bones", "[chain]") {
    Joints joints(1);
    REQUIRE_THROWS_AS(chains::solve(joints, {}, {}), std::invalid_argument);
    joints.resize(257);
    REQUIRE_THROWS_AS(chains::solve(joints, {}, {}), std::invalid_argument);
}
