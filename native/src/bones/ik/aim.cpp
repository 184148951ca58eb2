#include "aim.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motus/bones/chains/bend_plane.hpp"
#include "motus/bones/chains/chain.hpp"
#include "motus/bones/chains/triangle-inl.hpp"
#include "motus/bones/chains/two_bone.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::ik {
namespace {

/// The elbow of a chain that is almost straight in its pose, and therefore bends about a hinge rather than in
/// the plane of that small bend. If the solution bends no more than the pose, the elbow lies in the pose's
/// plane nevertheless, so that a target at the pose's tip changes nothing; with three times the bend it lies
/// in the plane that was asked for. elbow_of_pose: relative to the root, turned to the chord.
glm::dvec3 elbow_near_pose(const glm::dvec3& elbow, const glm::dvec3& root, const glm::dvec3& elbow_of_pose,
                           const Chord& chord) {
    const glm::dvec3& along = chord.along;
    const glm::dvec3 across = elbow_of_pose - glm::dot(elbow_of_pose, along) * along;
    const glm::dvec3 side = glm::cross(chord.normal, along);
    const double bend = glm::dot(elbow - root, side);
    const double square = glm::dot(across, across);
    constexpr double gone = 3.0;
    if (square == 0.0 || bend >= gone * std::sqrt(square)) return elbow;
    const double bend_of_pose = std::sqrt(square);
    const glm::dvec3 normal = glm::cross(along, across) / bend_of_pose;
    constexpr double alike = 1e-24;
    const glm::dvec3 between = normal - chord.normal;
    if (glm::dot(between, between) < alike) return elbow;
    const double weight = smooth_step((bend / bend_of_pose - 1.0) / (gone - 1.0));
    const glm::dvec3 blend = chains::blended_normal(normal, chord.normal, along, weight);
    return elbow + bend * (glm::cross(blend, along) - side);
}

/// The place to which the tip is brought: the target, or the place that softness allows.
glm::dvec3 end_of(const Pose& pose, const AimGoal& goal, const Chord& chord, const AimReport& report) {
    const bool is_soft = goal.softness > 0.0 && report.end < report.distance;
    return is_soft ? pose.root() + report.end * chord.along : goal.target;
}

/// Whether the lengths of bones depend on their directions, because spaces are sheared.
bool is_sheared(const Pose& pose, std::size_t count) {
    constexpr double alike = 1e-4;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dmat3& axes = pose.posed(i).space.axes;
        const glm::dmat3 square = glm::transpose(axes) * axes;
        const double size = (square[0][0] + square[1][1] + square[2][2]) / 3.0;
        for (int column = 0; column < 3; ++column) {
            for (int row = 0; row < 3; ++row) {
                const double even = column == row ? size : 0.0;
                if (std::abs(square[column][row] - even) > alike * size) return true;
            }
        }
    }
    return false;
}

}  // namespace

glm::dquat seen_from(const glm::dmat3& to_space, const glm::dquat& turn) {
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const glm::dvec3 seen = to_space * axis;
    const double square = glm::dot(seen, seen);
    constexpr double vanished = 1e-280;
    if (!(square > vanished)) return {turn.w, 0.0, 0.0, 0.0};
    const double size = std::sqrt(glm::dot(axis, axis) / square);
    const glm::dvec3 part = handedness(to_space) * size * seen;
    return {turn.w, part.x, part.y, part.z};
}

Aim::Aim(std::size_t longest)
    : lengths_(longest),
      joints_(longest + 1),
      to_spaces_(longest),
      best_(longest),
      nearest_(longest),
      slopes_(longest),
      rest_(longest),
      offsets_(longest),
      rotations_(longest) {}

Aim::Line Aim::line_to_target(const Pose& pose, const AimGoal& goal, double length) {
    const Chord from = chord_of(pose, goal.count, goal.hinge_angle);
    const glm::dvec3 to = goal.target - pose.root();
    constexpr double coincident = 1e-12;
    const bool is_at_root = glm::dot(to, to) <= coincident * coincident * length * length;
    Line line;
    line.chord.along = is_at_root ? from.along : direction_or(to, from.along);
    const glm::dquat swing = smallest_turn(from.along, line.chord.along, from.normal);
    const glm::dvec3 carried = swing * from.normal;
    line.chord.normal = carried;
    line.carried = carried;
    line.turn = swing;
    // A single bone has no bend that could turn.
    if (goal.count == 1 || (!goal.pole && goal.pole_angle == 0.0)) return line;

    glm::dvec3 wanted = carried;
    if (goal.pole) {
        const glm::dvec3 to_pole = *goal.pole - pose.root();
        wanted = chains::bend_normal(
            {line.chord.along, to_pole, carried, length, chains::pole_band, static_cast<double>(goal.bend)});
    }
    if (goal.pole_angle != 0.0)
        wanted = std::cos(goal.pole_angle) * wanted +
                 std::sin(goal.pole_angle) * glm::cross(line.chord.along, wanted);
    line.chord.normal = wanted;
    line.turn = smallest_turn(carried, wanted, line.chord.along) * swing;
    return line;
}

void Aim::measure(const Pose& pose, std::size_t count, AimReport& report, const AimGoal& goal) {
    const std::span<const glm::dvec3> joints = pose.joints();
    report.reach = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        lengths_[i] = glm::distance(joints[i], joints[i + 1]);
        report.reach += lengths_[i];
    }
    // Softness does not apply to a single bone, whose length is fixed.
    report.end = count == 1 ? std::min(report.distance, report.reach)
                            : chains::soft_reach(report.distance, report.reach, goal.softness * report.reach);
}

void Aim::find_joints(const Pose& pose, const AimGoal& goal, const Line& line, AimReport& report) {
    const glm::dvec3& root = pose.root();
    const glm::dvec3& along = line.chord.along;
    const bool is_whole = report.end == report.distance;
    const glm::dvec3 end = is_whole ? goal.target : root + report.end * along;
    joints_[0] = root;
    if (goal.count == 1) {
        joints_[1] = root + lengths_[0] * along;
        const double short_of = report.distance - lengths_[0];
        const bool is_reached = std::abs(short_of) <= goal.tolerance * lengths_[0];
        report.reason = is_reached ? Reason::reached : short_of > 0.0 ? Reason::too_far : Reason::too_near;
    } else if (goal.count == 2) {
        const double shortest = std::abs(lengths_[0] - lengths_[1]);
        const chains::HWY_NAMESPACE::Direction<double> bone =
            chains::HWY_NAMESPACE::shoulder(lengths_[0], lengths_[1], report.reach, shortest, report.end);
        const glm::dvec3 elbow = root + (lengths_[0] * bone.cosine) * along +
                                 (lengths_[0] * bone.sine) * glm::cross(line.chord.normal, along);
        joints_[1] = elbow_near_pose(elbow, root, line.turn * (pose.joints()[1] - root), line.chord);
        const bool is_near = report.end < shortest;
        joints_[2] = is_near ? root + shortest * along : end;
        report.reason = is_near ? Reason::too_near : Reason::reached;
    } else {
        for (std::size_t i = 1; i <= goal.count; ++i)
            joints_[i] = root + line.turn * (pose.joints()[i] - root);
        chains::SolverSettings settings;
        settings.tolerance = goal.tolerance;
        settings.max_iterations = goal.max_iterations;
        settings.plane = line.chord.normal;
        const chains::Convergence found = chains::solve({joints_.data(), goal.count + 1}, end, settings);
        report.reason = found.reason;
        report.iterations += found.iterations;
    }
}

void Aim::turn_bones(Pose& pose, std::size_t count, const Line& line) {
    glm::dquat carries = line.turn;  // turn of the bone before, in the pose
    for (std::size_t i = 0; i < count; ++i) {
        const bool next_stays = i + 1 < count && !pose.bone(i + 1).offset->inherit_rotation;
        const glm::dquat frame_before = next_stays ? pose.frame(i) : no_turn;
        const bool is_carried = i > 0 && pose.bone(i).offset->inherit_rotation;
        pose.enter(i);
        to_spaces_[i] = inverse_axes(pose.posed(i).space.axes);
        const glm::dmat3& to_space = to_spaces_[i];
        glm::dquat rotation = pose.posed(i).rotation;
        if (!is_carried) rotation = seen_from(to_space, carries) * rotation;

        const glm::dquat turn = smallest_turn_between(
            rotation * pose.reach_of(i, 1.0), to_space * (joints_[i + 1] - joints_[i]),
            [&] { return direction_or(to_space * line.chord.normal, glm::dvec3(1.0, 0.0, 0.0)); });
        pose.place(i, normalized_product(turn * rotation), 1.0);
        if (next_stays) carries = pose.frame(i) * glm::conjugate(frame_before);
    }
}

void Aim::keep(const Pose& pose, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) best_[i] = pose.posed(i).rotation;
}

AimReport Aim::turn(Pose& pose, const AimGoal& goal) {
    AimReport report;
    report.distance = glm::distance(pose.root(), goal.target);
    measure(pose, goal.count, report, goal);
    const Line first = line_to_target(pose, goal, report.reach);
    Line line = first;

    // In sheared spaces lengths depend on the direction, and those of the round before are used. One round is
    // enough for a rigid chain, apart from the rounding of single precision, for which a nudge suffices.
    constexpr int most_rounds = 50;
    constexpr double exact = 1e-11;
    double best = 0.0;
    for (int round = 0; round < most_rounds; ++round) {
        AimReport now = report;
        if (goal.limits.empty()) {
            find_joints(pose, goal, line, now);
            turn_bones(pose, goal.count, line);
        } else {
            find_rotations(pose, goal, line, now);
            for (std::size_t i = 0; i < goal.count; ++i) pose.put(i, rotations_[i], 1.0);
        }
        const double miss = glm::distance(pose.joints()[goal.count], joints_[goal.count]);
        const double enough = (goal.limits.empty() ? exact : 0.1 * goal.tolerance) * now.reach;
        report.iterations = now.iterations;
        if (round == 0 || miss < best) {
            best = miss;
            report = now;
            if (miss > enough) keep(pose, goal.count);
        }
        if (miss <= enough) break;
        if (round == 0 && goal.limits.empty() && nudge(pose, goal.count) &&
            glm::distance(pose.joints()[goal.count], joints_[goal.count]) <= enough)
            break;
        if (round + 1 < most_rounds) {
            measure(pose, goal.count, report, goal);
            const glm::dvec3 reached =
                direction_or(pose.joints()[goal.count] - pose.root(), line.chord.along);
            line.turn = smallest_turn(reached, line.chord.along, line.chord.normal);
        } else if (!goal.limits.empty()) {
            for (std::size_t i = 0; i < goal.count; ++i) pose.put(i, best_[i], 1.0);
        } else {
            report.iterations += finish(pose, goal, end_of(pose, goal, line.chord, report), report.reach);
        }
    }
    if (goal.limits.empty()) {
        constexpr std::size_t most_folded = 12;  // bones: the work grows with their square
        const glm::dvec3 end = end_of(pose, goal, line.chord, report);
        const bool can_fold = goal.count > 1 && goal.count <= most_folded && is_sheared(pose, goal.count);
        if (can_fold && fold(pose, goal, first, end, report)) measure(pose, goal.count, report, goal);
        const double miss = glm::distance(pose.joints()[goal.count], goal.target);
        if (miss <= goal.tolerance * report.reach) report.reason = Reason::reached;
    }
    return report;
}

}  // namespace motus::bones::ik
