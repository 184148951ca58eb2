// Chains with limits on targets that move little by little: no joint may jump.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "chain_checks.hpp"
#include "motus/bones/chains/limited.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::bones::chains;
using namespace motus::bones::chains::checks;
using std::numbers::pi;

namespace {

using Path = std::function<glm::dvec3(double)>;

/// A chain through given joints, each bone's frame with +Y along it.
struct Limb {
    std::vector<glm::dquat> rest;
    std::vector<glm::dvec3> offsets;
    std::vector<JointLimits> limits;
    glm::dvec3 root;
    double length = 0.0;

    explicit Limb(const Joints& joints) : limits(joints.size() - 1), root(joints[0]) {
        std::vector<glm::dquat> frames(limits.size());
        bone_frames(joints, frames);
        glm::dquat before(1.0, 0.0, 0.0, 0.0);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            rest.push_back(glm::conjugate(before) * frames[i]);
            offsets.emplace_back(0.0, glm::distance(joints[i], joints[i + 1]), 0.0);
            length += offsets.back().y;
            before = frames[i];
        }
    }
    [[nodiscard]] Limited chain() const {
        return {.root = root, .rest = rest, .offsets = offsets, .limits = limits};
    }
};

/// Solves for targets from u = 0 to 1, the same pose each time, and compares neighbours.
struct Sweep {
    int jumps = 0;       // steps at which a joint goes 20 times as far as the target (and the pole)
    double turn = 0.0;   // largest of a bone between two steps, rad
    double worst = 0.0;  // residual, of the length

    Sweep(const Limb& limb, const Path& path, const Path& pole = {}, int steps = 1440) {
        const std::size_t count = limb.offsets.size();
        std::vector<glm::dquat> rotations, before;
        Joints joints(count + 1), joints_before;
        glm::dvec3 pole_before(0.0);
        for (int i = 0; i <= steps; ++i) {
            const double u = static_cast<double>(i) / steps;
            rotations.assign(count, {1.0, 0.0, 0.0, 0.0});
            SolverSettings settings;
            if (pole) settings.pole = pole(u);
            const Convergence report = solve_limited(limb.chain(), path(u), settings, rotations);
            joints_of(limb.chain(), rotations, joints);
            worst = std::max(worst, report.residual / limb.length);
            if (i > 0) {
                double way = glm::distance(path(u), path(u - 1.0 / steps));
                if (pole) way += glm::distance(*settings.pole, pole_before);
                if (largest_move(joints_before, joints) > 20.0 * way + 1e-4) ++jumps;
                turn = std::max(turn, largest_turn(before, rotations));
            }
            if (pole) pole_before = *settings.pole;
            joints_before = joints;
            before = rotations;
        }
    }

  private:
    static double largest_turn(const std::vector<glm::dquat>& a, const std::vector<glm::dquat>& b) {
        double largest = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const glm::dquat d = glm::conjugate(a[i]) * b[i];
            largest =
                std::max(largest, 2.0 * std::atan2(glm::length(glm::dvec3(d.x, d.y, d.z)), std::abs(d.w)));
        }
        return largest;
    }
};

void check_smooth(const Sweep& sweep, double largest_residual = 1e-6) {
    CHECK(sweep.jumps == 0);
    CHECK(sweep.turn < 0.15);
    CHECK(sweep.worst <= largest_residual);
}

JointLimits hinge_z(double low, double high) {
    return {{0.0, 0.0, low}, {0.0, 0.0, high}};
}

JointLimits hinge_x(double low, double high) {
    return {{low, 0.0, 0.0}, {high, 0.0, 0.0}};
}

JointLimits ball(double most) {
    return {glm::dvec3(-most), glm::dvec3(most)};
}

const Joints arm_joints{{0.0, 0.0, 1.0}, {0.7, 0.15, 1.0}, {1.3, 0.0, 1.0}};

Limb arm(const JointLimits& elbow) {
    Limb limb(arm_joints);
    limb.limits[1] = elbow;
    return limb;
}

/// A chain that curves gently, all of its bones with the same limits.
Limb tail(int bones, double length, double most) {
    Joints joints{{0.0, 0.0, 0.0}};
    for (int i = 0; i < bones; ++i)
        joints.push_back(joints.back() +
                         length / bones * glm::dvec3(std::sin(0.04 * i), 0.0, std::cos(0.04 * i)));
    Limb limb(joints);
    std::fill(limb.limits.begin(), limb.limits.end(), ball(most));
    return limb;
}

/// All round the shoulder, by 0.2 past the place behind it, where no choice is continuous.
glm::dvec3 all_round(double u) {
    const double a = 2.0 * pi * u;
    return {0.75 * std::cos(a) + 0.1, 0.75 * std::sin(a), 1.2 + 0.5 * std::sin(2.0 * a)};
}

glm::dvec3 in_front(double u) {
    const double a = 2.0 * pi * u;
    return {0.7 + 0.25 * std::cos(a), -0.35 + 0.25 * std::sin(a), 1.0 + 0.25 * std::sin(2.0 * a)};
}

glm::dvec3 round_the_tail(double u) {
    const double a = 2.0 * pi * u;
    return {std::cos(a), 0.9 * std::sin(a), 0.9 + 0.3 * std::cos(2.0 * a)};
}

}  // namespace

TEST_CASE("an elbow with limits does not jump while its target moves", "[limited_sweep]") {
    const Path pole = [](double) { return glm::dvec3(0.6, 2.0, 1.0); };
    const Limb open = arm(hinge_z(-2.4, 0.1));     // bends the way it does in its pose
    const Limb opposed = arm(hinge_z(-0.1, 2.9));  // the other way
    for (const Limb* limb : {&open, &opposed}) {
        CAPTURE(limb == &open);
        check_smooth(Sweep(*limb, all_round));
        check_smooth(Sweep(*limb, in_front));
        check_smooth(Sweep(*limb, in_front, pole));
        check_smooth(Sweep(
            *limb, [](double u) { return all_round((170.0 + 10.0 * u) / 1440.0); }, {}, 500));
    }
}

TEST_CASE("an elbow with limits follows a pole that goes round", "[limited_sweep]") {
    const Limb limb = arm(hinge_z(-2.4, 0.1));
    const Path target = [](double) { return glm::dvec3(0.6, 0.3, 1.4); };
    const auto pole = [](double u) {
        const glm::dvec3 along = glm::normalize(glm::dvec3(0.6, 0.3, 0.4));
        const glm::dvec3 side = glm::normalize(glm::cross(along, glm::dvec3(0.0, 0.0, 1.0)));
        return arm_joints[0] + 3.0 * (glm::angleAxis(2.0 * pi * u, along) * side);
    };
    check_smooth(Sweep(limb, target, pole));
    for (const double u : {0.0, 0.2, 0.5, 0.9}) {
        std::vector<glm::dquat> rotations(2, {1.0, 0.0, 0.0, 0.0});
        SolverSettings settings;
        settings.pole = pole(u);
        const Convergence report = solve_limited(limb.chain(), target(u), settings, rotations);
        CHECK(report.reason == Reason::reached);
        Joints joints(3);
        joints_of(limb.chain(), rotations, joints);
        const glm::dvec3 along = glm::normalize(joints[2] - joints[0]);
        const glm::dvec3 elbow = joints[1] - joints[0];
        const glm::dvec3 side = glm::normalize(elbow - glm::dot(elbow, along) * along);
        CHECK(glm::dot(side, glm::normalize(pole(u) - joints[0])) > 1.0 - 1e-9);
    }
}

TEST_CASE("a knee with limits does not jump, nor with limits of the hip", "[limited_sweep]") {
    const Path foot = [](double u) {
        const double a = 2.0 * pi * u;
        return glm::dvec3(0.05, -0.1 + 0.3 * std::cos(a), 0.15 + 0.12 * std::sin(a));
    };
    const Path pole = [](double) { return glm::dvec3(0.0, -2.0, 0.6); };
    for (const JointLimits& knee : {hinge_x(-0.05, 2.6), hinge_x(-2.6, 0.05)}) {
        Limb leg({{0.0, 0.0, 1.0}, {0.0, -0.05, 0.5}, {0.0, 0.0, 0.0}});
        leg.limits[1] = knee;
        for (const JointLimits& hip : {JointLimits{}, JointLimits{{-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5}}}) {
            leg.limits[0] = hip;
            CAPTURE(knee.max.x, hip.max.x);
            check_smooth(Sweep(leg, foot));
            if (std::isinf(hip.max.x)) check_smooth(Sweep(leg, foot, pole));
        }
    }
}

TEST_CASE("a straight knee bends to its side and straightens again", "[limited_sweep]") {
    for (const JointLimits& knee : {hinge_x(-0.05, 2.6), hinge_x(-2.6, 0.05), hinge_z(-2.6, 0.0)}) {
        Limb leg({{0.0, 0.0, 1.0}, {0.0, 0.0, 0.5}, {0.0, 0.0, 0.0}});
        leg.limits[1] = knee;
        CAPTURE(knee.max.x);
        const Sweep sweep(leg, [](double u) { return glm::dvec3(0.02, 0.1, 0.03 + 0.6 * u); });
        check_smooth(sweep);
    }
}

TEST_CASE("tails with limits on all bones do not jump", "[limited_sweep]") {
    check_smooth(Sweep(tail(4, 1.6, 0.8), round_the_tail));
    check_smooth(Sweep(tail(5, 1.6, 0.8), round_the_tail));
    check_smooth(Sweep(tail(8, 1.6, 0.6), round_the_tail));
    check_smooth(Sweep(tail(5, 1.6, 0.8), [](double u) {
        const double a = 2.0 * pi * u;
        return glm::dvec3(0.5 * std::cos(a), 0.5 * std::sin(a), 1.1);
    }));
    Limb free_root = tail(5, 1.6, 0.6);
    free_root.limits[0] = {};
    check_smooth(Sweep(free_root, round_the_tail));
}

TEST_CASE("a chain with limits passes the end of its reach without a jump", "[limited_sweep]") {
    const Path out = [](double u) { return glm::dvec3(0.5 + 1.2 * u, 0.2, 1.1); };
    const Sweep elbow(arm(hinge_z(-2.4, 0.1)), out);
    CHECK(elbow.turn < 0.15);
    const Sweep chain(tail(5, 1.3, 0.8), [](double u) { return glm::dvec3(0.3, 0.1, 0.8 + 0.9 * u); });
    CHECK(chain.turn < 0.15);
}
