#include "motus/bones/chains/limited.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "chain_checks.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::chains;
using namespace motus::bones::chains::checks;
using std::numbers::pi;

namespace {

double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::conjugate(a) * b;
    return 2.0 * std::atan2(glm::length(glm::dvec3(d.x, d.y, d.z)), std::abs(d.w));
}

/// A chain that owns the arrays which Limited refers to.
struct Arm {
    std::vector<glm::dquat> rest, rotations;
    std::vector<glm::dvec3> offsets;
    std::vector<JointLimits> limits;
    double length = 0.0;

    [[nodiscard]] Limited chain() const { return {.rest = rest, .offsets = offsets, .limits = limits}; }
    [[nodiscard]] Joints joints(const std::vector<glm::dquat>& turned) const {
        Joints result(offsets.size() + 1);
        joints_of(chain(), turned, result);
        return result;
    }
    [[nodiscard]] glm::dvec3 tip(const std::vector<glm::dquat>& turned) const {
        return joints(turned).back();
    }
    [[nodiscard]] glm::dquat last_frame(const std::vector<glm::dquat>& turned) const {
        glm::dquat frame(1.0, 0.0, 0.0, 0.0);
        for (std::size_t i = 0; i < turned.size(); ++i) frame = frame * rest[i] * turned[i];
        return frame;
    }
};

/// Hinges, ball joints, wrists and necks.
JointLimits random_limits(Random& random) {
    const auto up_to = [&](double most) { return random.between(0.2, 1.0) * most; };
    switch (static_cast<int>(random.between(0.0, 4.0))) {
        case 0:
            return {{0.0, 0.0, 0.0}, {up_to(2.5), 0.0, 0.0}};
        case 1:
            return {{-up_to(1.5), -up_to(1.5), -up_to(1.5)}, {up_to(1.5), up_to(1.5), up_to(1.5)}};
        case 2:
            return {{-up_to(1.0), 0.0, -up_to(1.0)}, {up_to(1.0), 0.0, up_to(1.0)}};
        default:
            return {{-up_to(0.7), -up_to(0.5), -up_to(0.7)}, {up_to(2.0), up_to(0.5), up_to(0.7)}};
    }
}

Arm random_arm(Random& random, std::size_t bones) {
    Arm arm;
    for (std::size_t i = 0; i < bones; ++i) {
        arm.rest.push_back(random.rotation(i == 0 ? pi : 0.5));
        arm.offsets.emplace_back(0.0, random.between(0.5, 1.5), 0.0);
        arm.limits.push_back(random_limits(random));
        arm.rotations.push_back(clamp_rotation(random.rotation(0.8), arm.limits.back()));
        arm.length += arm.offsets.back().y;
    }
    return arm;
}

/// Any rotations within the limits.
std::vector<glm::dquat> random_rotations(Random& random, const Arm& arm) {
    std::vector<glm::dquat> rotations;
    for (const JointLimits& limits : arm.limits)
        rotations.push_back(clamp_rotation(random.rotation(pi), limits));
    return rotations;
}

Convergence solve(const Arm& arm, const glm::dvec3& target, std::vector<glm::dquat>& rotations) {
    return solve_limited(arm.chain(), target, {}, rotations);
}

void check_within(const Arm& arm, const std::vector<glm::dquat>& rotations) {
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        REQUIRE(glm::length(rotations[i]) == Approx(1.0).epsilon(1e-12));
        REQUIRE(angle_between(clamp_rotation(rotations[i], arm.limits[i]), rotations[i]) < 1e-8);
    }
}

/// The smallest distance that a search by chance alone finds: turns of one bone or all, kept if they help,
/// ever smaller while they don't.
double nearest_by_chance(Random& random, const Arm& arm, const glm::dvec3& target, int starts, int steps) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int start = 0; start < starts; ++start) {
        std::vector<glm::dquat> rotations = random_rotations(random, arm);
        double distance = glm::distance(arm.tip(rotations), target);
        double size = 1.0;
        for (int step = 0; step < steps; ++step) {
            std::vector<glm::dquat> tried = rotations;
            const std::size_t one =
                static_cast<std::size_t>(random.between(0.0, static_cast<double>(tried.size())));
            const bool all = random.chance(0.5);
            for (std::size_t i = 0; i < tried.size(); ++i) {
                if (all || i == one)
                    tried[i] =
                        clamp_rotation(glm::normalize(tried[i] * random.rotation(size)), arm.limits[i]);
            }
            const double now = glm::distance(arm.tip(tried), target);
            if (now < distance) {
                distance = now;
                rotations = tried;
                size = std::min(1.0, 1.5 * size);
            } else {
                size = std::max(1e-6, 0.93 * size);
            }
        }
        nearest = std::min(nearest, distance);
    }
    return nearest;
}

constexpr double unlimited = JointLimits::free;

}  // namespace

TEST_CASE("clamping keeps rotations within the limits, and clamping twice equals clamping once", "[limits]") {
    Random random(1);
    for (int round = 0; round < 4000; ++round) {
        JointLimits limits = random_limits(random);
        if (random.chance(0.2)) limits = {{0.2, -unlimited, -0.3}, {0.9, unlimited, 0.1}};  // leaves zero out
        if (random.chance(0.2)) limits = {{-unlimited, -0.4, -0.3}, {unlimited, 0.2, 0.5}};  // half free
        if (random.chance(0.1)) limits = {{-2.0, 3.0, -2.0}, {2.0, 3.5, 2.0}};  // twist across half a turn
        const glm::dquat any = random.rotation(pi);
        const glm::dquat kept = clamp_rotation(any, limits);
        CAPTURE(round);
        REQUIRE(glm::length(kept) == Approx(1.0).epsilon(1e-13));
        REQUIRE(angle_between(clamp_rotation(kept, limits), kept) < 1e-9);
        const glm::dquat mirrored = clamp_rotation(-any, limits);
        REQUIRE(angle_between(mirrored, kept) < 1e-9);
        // A swing and a twist well inside stay as they are, to the bit.
        const glm::dvec3 middle = 0.5 * (glm::max(limits.min, -1.0) + glm::min(limits.max, 1.0));
        if (limits.min.y < 3.0) {
            const glm::dvec3 swing(middle.x, 0.0, middle.z);
            const double angle = glm::length(swing);
            const glm::dquat inside =
                (angle > 0.0 ? glm::angleAxis(angle, swing / angle) : glm::dquat(1.0, 0.0, 0.0, 0.0)) *
                glm::angleAxis(middle.y, glm::dvec3(0.0, 1.0, 0.0));
            REQUIRE(angle_between(clamp_rotation(inside, limits), inside) < 1e-12);
        }
    }
}

TEST_CASE("clamping by known angles", "[limits]") {
    const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
    const JointLimits knee{{0.0, 0.0, 0.0}, {2.5, 0.0, 0.0}};
    REQUIRE(angle_between(clamp_rotation(glm::angleAxis(3.0, x), knee), glm::angleAxis(2.5, x)) < 1e-12);
    REQUIRE(angle_between(clamp_rotation(glm::angleAxis(-0.4, x), knee), {1.0, 0.0, 0.0, 0.0}) < 1e-12);
    REQUIRE(angle_between(clamp_rotation(glm::angleAxis(0.7, z), knee), {1.0, 0.0, 0.0, 0.0}) < 1e-12);
    // A turn of -190 degrees is one of 170: the nearer limit is the upper one.
    REQUIRE(angle_between(clamp_rotation(glm::angleAxis(-3.3, x), knee), glm::angleAxis(2.5, x)) < 1e-12);

    const JointLimits cone{{-0.5, -unlimited, -0.5}, {0.5, unlimited, 0.5}};
    const glm::dvec3 axis = glm::normalize(x + z);
    REQUIRE(angle_between(clamp_rotation(glm::angleAxis(1.2, axis), cone), glm::angleAxis(0.5, axis)) <
            1e-12);
    const glm::dquat twisted = glm::angleAxis(0.3, axis) * glm::angleAxis(2.0, y);
    REQUIRE(clamp_rotation(twisted, cone) == twisted);

    const JointLimits neck{{-1.0, -0.2, -1.0}, {1.0, 0.6, 1.0}};
    REQUIRE(angle_between(clamp_rotation(glm::angleAxis(1.0, y), neck), glm::angleAxis(0.6, y)) < 1e-12);
    REQUIRE(angle_between(clamp_rotation(glm::angleAxis(-1.0, y), neck), glm::angleAxis(-0.2, y)) < 1e-12);
    REQUIRE(angle_between(clamp_rotation(glm::angleAxis(-3.0, y), neck), glm::angleAxis(0.6, y)) < 1e-12);
}

TEST_CASE("a clamped swing is the nearest on its ellipse", "[limits]") {
    Random random(2);
    for (int round = 0; round < 300; ++round) {
        const double a = random.between(0.05, 1.5);
        const double b = random.between(0.05, 1.5);
        const JointLimits limits{{-a, 0.0, -b}, {a, 0.0, b}};
        const glm::dvec2 given{random.between(-2.0, 2.0), random.between(-2.0, 2.0)};
        if (glm::dot(given / glm::dvec2(a, b), given / glm::dvec2(a, b)) < 1.0) continue;
        const double angle = glm::length(given);
        const glm::dquat kept =
            clamp_rotation(glm::angleAxis(angle, glm::dvec3(given.x, 0.0, given.y) / angle), limits);
        const double half = std::atan2(std::hypot(kept.x, kept.z), kept.w);
        const glm::dvec2 swing = glm::dvec2(kept.x, kept.z) * (2.0 * half / std::sin(half));
        double nearest = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 20000; ++i) {
            const double t = 2.0 * pi * i / 20000.0;
            nearest = std::min(nearest, glm::distance(given, glm::dvec2(a * std::cos(t), b * std::sin(t))));
        }
        CAPTURE(round, a, b);
        REQUIRE(glm::distance(given, swing) <= nearest + 1e-9);
        REQUIRE(glm::length(swing / glm::dvec2(a, b)) == Approx(1.0).epsilon(1e-9));
    }
}

TEST_CASE("targets that the limits allow are reached", "[limited_chain]") {
    Random random(3);
    int missed = 0;
    for (int round = 0; round < 400; ++round) {
        const Arm arm = random_arm(random, 2 + round % 9);
        const glm::dvec3 target = arm.tip(random_rotations(random, arm));
        std::vector<glm::dquat> rotations = arm.rotations;
        const Convergence report = solve(arm, target, rotations);
        CAPTURE(round, report.residual);
        check_within(arm, rotations);
        REQUIRE(report.residual ==
                Approx(glm::distance(arm.tip(rotations), target)).margin(1e-12 * arm.length));
        REQUIRE((report.reason == Reason::reached) == (report.residual <= 1e-6 * arm.length));
        if (report.reason != Reason::reached) ++missed;
    }
    REQUIRE(missed <= 4);
}

TEST_CASE("nothing found by chance is nearer to the target", "[limited_chain]") {
    Random random(4);
    int worse = 0;
    for (int round = 0; round < 60; ++round) {
        const Arm arm = random_arm(random, 2 + round % 4);
        const glm::dvec3 target = arm.length * random.at_distance(0.0, 1.1);
        std::vector<glm::dquat> rotations = arm.rotations;
        const Convergence report = solve(arm, target, rotations);
        check_within(arm, rotations);
        if (report.reason == Reason::reached) continue;
        REQUIRE(report.reason != Reason::iterations);
        if (report.residual > nearest_by_chance(random, arm, target, 6, 1500) + 1e-4 * arm.length) ++worse;
    }
    REQUIRE(worse <= 1);
}

TEST_CASE("a chain without limits reaches what its lengths allow", "[limited_chain]") {
    Random random(5);
    for (const std::size_t bones : {1, 2, 3, 10, 60, 255}) {
        Arm arm = random_arm(random, bones);
        for (JointLimits& limits : arm.limits) limits = {};
        for (const double share : {0.3, 0.9, 0.999, 1.0, 1.2}) {
            if (bones == 1 && share < 1.0) continue;
            const glm::dvec3 target = share * arm.length * random.direction();
            std::vector<glm::dquat> rotations = arm.rotations;
            const Convergence report = solve(arm, target, rotations);
            CAPTURE(bones, share, report.iterations);
            // Nor does a bone that is longer than all others together let the tip come to its root.
            const double folded = inner_reach(arm.joints(arm.rotations)) / arm.length;
            const double missing = std::max({share - 1.0, folded - share, 0.0});
            REQUIRE(report.residual <= (missing + 2e-6) * arm.length);
            REQUIRE(report.residual >= (missing - 1e-12) * arm.length);
            if (share > 1.0) {
                REQUIRE(report.reason == Reason::too_far);
            } else if (share < folded) {
                REQUIRE(report.reason == Reason::too_near);
            } else if (share < 1.0) {
                REQUIRE(report.reason == Reason::reached);
            }
        }
    }
}

TEST_CASE("the last bone takes the orientation if it can", "[limited_chain]") {
    Random random(6);
    int turned = 0;
    constexpr int rounds = 100;
    for (int round = 0; round < rounds; ++round) {
        Arm arm = random_arm(random, 3 + round % 4);
        for (JointLimits& limits : arm.limits) limits = {glm::dvec3(-1.5), glm::dvec3(1.5)};
        const std::vector<glm::dquat> wanted = random_rotations(random, arm);
        const glm::dquat orientation = arm.last_frame(wanted);
        std::vector<glm::dquat> rotations = arm.rotations;
        const Convergence report = solve_limited(arm.chain(), arm.tip(wanted), {}, rotations, orientation);
        check_within(arm, rotations);
        CAPTURE(round);
        REQUIRE(report.reason == Reason::reached);
        if (angle_between(arm.last_frame(rotations), orientation) < 1e-3) ++turned;
    }
    REQUIRE(turned >= 0.95 * rounds);
}

TEST_CASE("an orientation that cannot be had does not cost the position", "[limited_chain]") {
    Random random(7);
    for (int round = 0; round < 60; ++round) {
        const Arm arm = random_arm(random, 3 + round % 4);
        std::vector<glm::dquat> without = arm.rotations;
        const glm::dvec3 target = arm.tip(random_rotations(random, arm));
        if (solve(arm, target, without).reason != Reason::reached) continue;
        std::vector<glm::dquat> rotations = arm.rotations;
        const glm::dquat wanted = random.rotation(pi);
        const Convergence report = solve_limited(arm.chain(), target, {}, rotations, wanted);
        CAPTURE(round);
        check_within(arm, rotations);
        REQUIRE(report.reason == Reason::reached);
        REQUIRE(angle_between(arm.last_frame(rotations), wanted) <=
                angle_between(arm.last_frame(without), wanted) + 1e-2);
    }
}

TEST_CASE("a pose on its target stays as it is", "[limited_chain]") {
    Random random(8);
    for (int round = 0; round < 50; ++round) {
        const Arm arm = random_arm(random, 1 + round % 8);
        std::vector<glm::dquat> rotations = arm.rotations;
        const Convergence report = solve(arm, arm.tip(arm.rotations), rotations);
        REQUIRE(report.iterations == 0);
        for (std::size_t i = 0; i < rotations.size(); ++i)
            REQUIRE(angle_between(rotations[i], arm.rotations[i]) < 1e-7);
    }
}

TEST_CASE("a limited chain gives finite results for finite arguments, the same each time",
          "[limited_chain]") {
    Random random(9);
    for (int round = 0; round < 400; ++round) {
        Arm arm = random_arm(random, 1 + round % 7);
        const double size = std::pow(10.0, random.between(-12.0, 12.0));
        for (glm::dvec3& offset : arm.offsets) offset *= random.chance(0.15) ? 0.0 : size;
        if (random.chance(0.2)) {
            for (JointLimits& limits : arm.limits) limits = {glm::dvec3(0.0), glm::dvec3(0.0)};
        }
        if (random.chance(0.2)) arm.limits[0] = {glm::dvec3(0.3), glm::dvec3(0.4)};
        for (glm::dquat& rotation : arm.rotations) rotation = random.rotation(pi);
        glm::dvec3 target = size * random.at_distance(0.0, 10.0);
        if (random.chance(0.1)) target = glm::dvec3(0.0);
        SolverSettings settings;
        if (random.chance(0.3)) settings.pole = size * random.direction();
        std::optional<glm::dquat> orientation;
        if (random.chance(0.3)) orientation = random.rotation(pi);
        std::vector<glm::dquat> rotations = arm.rotations;
        const Convergence report = solve_limited(arm.chain(), target, settings, rotations, orientation);
        CAPTURE(round, size);
        check_within(arm, rotations);
        REQUIRE(std::isfinite(report.residual));
        REQUIRE(report.residual == Approx(glm::distance(arm.tip(rotations), target)).margin(1e-11 * size));
        std::vector<glm::dquat> again = arm.rotations;
        const Convergence second = solve_limited(arm.chain(), target, settings, again, orientation);
        REQUIRE(again == rotations);
        REQUIRE(second.iterations == report.iterations);
    }
}

TEST_CASE("targets any number of times farther away than the chain is long", "[limited_chain]") {
    const std::vector<glm::dquat> rest(2, {1.0, 0.0, 0.0, 0.0});
    const std::vector<JointLimits> limits(2, {glm::dvec3(-1.0), glm::dvec3(1.0)});
    const auto solved = [&](double length, double distance) {
        const std::vector<glm::dvec3> offsets(2, {0.0, length, 0.0});
        const Limited chain{.rest = rest, .offsets = offsets, .limits = limits};
        SolverSettings settings;
        settings.pole = glm::dvec3(0.0, 0.0, distance);
        std::vector<glm::dquat> rotations = rest;
        const Convergence report = solve_limited(chain, {distance, 0.0, 0.0}, settings, rotations);
        CAPTURE(length, distance);
        REQUIRE(std::isfinite(report.residual));
        if (distance > 2.1 * length) REQUIRE(report.reason == Reason::too_far);
        return rotations;
    };
    const std::vector<glm::dquat> far = solved(1.0, 1e9);
    for (const double length : {1e-308, 1e-300, 1e-160, 1e-150, 1.0, 1e150, 1e300}) {
        for (const double distance : {1e-300, 1e-150, 10.0, 1e200, 1e300}) {
            const std::vector<glm::dquat> rotations = solved(length, distance);
            CAPTURE(length, distance);
            for (std::size_t i = 0; i < rotations.size(); ++i) {
                REQUIRE(glm::length(rotations[i]) == Approx(1.0).epsilon(1e-12));
                if (0.5e-6 * distance > length) REQUIRE(angle_between(rotations[i], far[i]) < 1e-9);
            }
        }
    }
}

TEST_CASE("limits, not lengths, keep a chain from a target at the very end of its reach", "[limited_chain]") {
    const std::vector<glm::dquat> rest(2, {1.0, 0.0, 0.0, 0.0});
    const std::vector<JointLimits> limits(2, {glm::dvec3(-0.1), glm::dvec3(0.1)});
    const auto reason = [&](const std::vector<glm::dvec3>& offsets, const glm::dvec3& target) {
        const std::span<const glm::dquat> own(rest.data(), offsets.size());
        const Limited chain{.rest = own, .offsets = offsets, .limits = {limits.data(), offsets.size()}};
        std::vector<glm::dquat> rotations(own.begin(), own.end());
        return solve_limited(chain, target, {}, rotations).reason;
    };
    const glm::dvec3 one(0.0, 1.0, 0.0), two(0.0, 2.0, 0.0);
    for (const double x : {1.0, std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0)})
        CHECK(reason({one}, {x, 0.0, 0.0}) == Reason::limit);
    CHECK(reason({one}, {0.6, 0.8, 0.0}) == Reason::limit);
    CHECK(reason({one}, {1.1, 0.0, 0.0}) == Reason::too_far);
    CHECK(reason({one}, {0.9, 0.0, 0.0}) == Reason::too_near);
    CHECK(reason({one, one}, {2.0, 0.0, 0.0}) == Reason::limit);
    CHECK(reason({two, one}, {1.0, 0.0, 0.0}) == Reason::limit);
    CHECK(reason({two, one}, {0.9, 0.0, 0.0}) == Reason::too_near);
}

TEST_CASE("a limited chain refuses arrays of different sizes", "[limited_chain]") {
    Random random(10);
    Arm arm = random_arm(random, 3);
    std::vector<glm::dquat> rotations = arm.rotations;
    arm.limits.pop_back();
    REQUIRE_THROWS_AS(solve(arm, {}, rotations), std::invalid_argument);
    arm.limits.clear();
    arm.offsets.clear();
    arm.rest.clear();
    rotations.clear();
    REQUIRE_THROWS_AS(solve(arm, {}, rotations), std::invalid_argument);
}

TEST_CASE("joints and frames of a chain refuse arrays of a different size", "[limited_chain]") {
    Random random(11);
    const Arm arm = random_arm(random, 3);
    for (const std::size_t size : {0u, 3u, 5u}) {
        Joints joints(size);
        CHECK_THROWS_AS(joints_of(arm.chain(), arm.rotations, joints), std::invalid_argument);
    }
    Joints joints(4);
    const std::vector<glm::dquat> few(2, glm::dquat(1.0, 0.0, 0.0, 0.0));
    CHECK_THROWS_AS(joints_of(arm.chain(), few, joints), std::invalid_argument);
    Limited chain = arm.chain();
    chain.rest = few;
    CHECK_THROWS_AS(joints_of(chain, arm.rotations, joints), std::invalid_argument);
    for (const std::size_t size : {0u, 2u, 4u}) {
        std::vector<glm::dquat> frames(size);
        CHECK_THROWS_AS(bone_frames(joints, frames), std::invalid_argument);
    }
}
