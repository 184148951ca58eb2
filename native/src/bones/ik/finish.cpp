// The rest of the way to the target after a rigid solution: mostly a rounding of single precision;
// more if the bones are in sheared spaces, in which repeated rigid solutions do not converge.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "aim.hpp"
#include "motus/bones/turns.hpp"

namespace motus::bones::ik {
namespace {

/// seen_from() of a small turn. In spaces without scale that is the turn's vector in the coordinates of the
/// space.
glm::dquat small_turn_seen_from(const glm::dmat3& to_space, const glm::dvec3& half) {
    constexpr double alike = 1e-3;
    if (std::abs(glm::determinant(to_space) - 1.0) > alike)
        return seen_from(to_space, {1.0, half.x, half.y, half.z});
    const glm::dvec3 seen = to_space * half;
    return {1.0, seen.x, seen.y, seen.z};
}

glm::dquat turn_by(const glm::dvec3& vector) {
    const double angle = glm::length(vector);
    if (angle == 0.0) return {1.0, 0.0, 0.0, 0.0};
    return glm::angleAxis(angle, vector / angle);
}

}  // namespace

// J^T (J J^T)^-1 e: with r the vector from a joint to the tip, the columns of J for the turns about that
// joint are those of -[r]x, so that J J^T is the sum of |r|^2 - r r^T.
bool Aim::nudge(Pose& pose, std::size_t count) const {
    const std::span<const glm::dvec3> joints = pose.joints();
    const glm::dvec3 tip = joints[count];
    glm::dmat3 square(0.0);
    double largest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 arm = tip - joints[i];
        const double length = glm::dot(arm, arm);
        largest = std::max(largest, length);
        for (int axis = 0; axis < 3; ++axis) {
            square[axis] -= arm[axis] * arm;
            square[axis][axis] += length;
        }
    }
    const glm::dvec3 pull = glm::inverse(square) * (joints_[count] - tip);
    constexpr double small = 1e-6;                                         // rad
    if (!(glm::dot(pull, pull) * largest <= small * small)) return false;  // or no number: a straight chain
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 half = 0.5 * glm::cross(tip - joints[i], pull);
        const glm::dquat turn = small_turn_seen_from(to_spaces_[i], half);
        if (i > 0) pose.enter(i);
        pose.place(i, normalized_product(turn * pose.posed(i).rotation), 1.0);
    }
    return true;
}

// Damped least squares on the rotations themselves, with the true positions of the joints: the step is
// J^T (J J^T + d^2)^-1 e (Wampler 1986, Nakamura and Hanafusa 1986), d grows if a step does not help.
int Aim::finish(Pose& pose, const AimGoal& goal, const glm::dvec3& end, double reach) {
    constexpr int most_steps = 80;
    constexpr double difference = 1e-6;  // rad
    const std::size_t count = goal.count;
    const double enough = 0.1 * goal.tolerance * reach;
    const auto put_from = [&](std::size_t first) {
        for (std::size_t i = first; i < count; ++i) pose.put(i, best_[i], 1.0);
    };
    put_from(0);
    double damping = 1e-3;  // of the reach
    double miss = glm::distance(pose.joints()[count], end);
    int step = 0;
    for (; step < most_steps && miss > enough && damping < 1e3; ++step) {
        const glm::dvec3 tip = pose.joints()[count];
        glm::dmat3 square(0.0);  // J J^T
        for (std::size_t i = 0; i < count; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 vector(0.0);
                vector[axis] = difference;
                pose.put(i, glm::normalize(turn_by(vector) * best_[i]), 1.0);
                for (std::size_t k = i + 1; k < count; ++k) pose.put(k, best_[k], 1.0);
                const glm::dvec3 column = (pose.joints()[count] - tip) / difference;
                slopes_[i][axis] = column;
                square += glm::outerProduct(column, column);
            }
            pose.put(i, best_[i], 1.0);
        }
        const double added = damping * damping * reach * reach;
        for (int axis = 0; axis < 3; ++axis) square[axis][axis] += added;
        const glm::dvec3 pull = glm::inverse(square) * (end - tip);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 vector(glm::dot(slopes_[i][0], pull), glm::dot(slopes_[i][1], pull),
                                    glm::dot(slopes_[i][2], pull));
            rotations_[i] = glm::normalize(turn_by(vector) * best_[i]);
            pose.put(i, rotations_[i], 1.0);
        }
        const double now = glm::distance(pose.joints()[count], end);
        if (now < miss) {
            std::copy_n(rotations_.begin(), count, best_.begin());
            const bool is_stuck = miss - now < 1e-12 * reach;
            miss = now;
            damping = std::max(0.3 * damping, 1e-9);
            if (is_stuck) break;
        } else {
            damping *= 5.0;
            put_from(0);
        }
    }
    put_from(0);
    return step;
}

bool Aim::fold(Pose& pose, const AimGoal& goal, const Line& line, const glm::dvec3& end, AimReport& report) {
    const std::size_t count = goal.count;
    const double before = glm::distance(pose.joints()[count], end);
    if (before <= goal.tolerance * report.reach) return false;
    constexpr std::array<double, 4> nearer{0.8, 0.5, 0.2, 0.05};  // of the way that the chain can go
    keep(pose, count);
    std::copy_n(best_.begin(), count, nearest_.begin());
    double miss = before;
    for (const double share : nearer) {
        if (miss <= goal.tolerance * report.reach) break;
        for (std::size_t i = 0; i < count; ++i) pose.put(i, pose.bone(i).rotation, 1.0);
        AimReport near;
        near.distance = report.distance;
        measure(pose, count, near, goal);
        near.end = share * std::min(near.distance, near.reach);
        find_joints(pose, goal, line, near);
        turn_bones(pose, count, line);
        keep(pose, count);
        report.iterations += finish(pose, goal, end, report.reach);
        const double now = glm::distance(pose.joints()[count], end);
        if (now >= miss) continue;
        miss = now;
        std::copy_n(best_.begin(), count, nearest_.begin());
    }
    for (std::size_t i = 0; i < count; ++i) pose.put(i, nearest_[i], 1.0);
    return miss < before;
}

}  // namespace motus::bones::ik
