#include "solution.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motus/bones/turns.hpp"

namespace motus::bones::ik {
namespace {

/// Factor of the bones' lengths that makes up for the share `stretch` of the missing length.
double stretch_of(const AimReport& report, double stretch) {
    const double excess = report.distance - report.end;
    const bool lacks = stretch > 0.0 && excess > 1e-12 * report.reach && report.end > 1e-9 * report.reach;
    return lacks ? 1.0 + stretch * excess / report.end : 1.0;
}

/// The stretch by which a bone reaches as far as `wanted`, a square of a length; 1 if none does. reach: where
/// the next joint is without stretch, seen from the bone. volume: as in ChainSettings.
double own_stretch(double wanted, const glm::dvec3& reach, double volume) {
    const double across = reach.x * reach.x + reach.z * reach.z;
    const double along = reach.y * reach.y;
    if (along == 0.0) return 1.0;
    constexpr double least = 1e-3, most = 1e6;
    if (volume == 0.0 || across == 0.0) {
        const double square = wanted - reach.x * reach.x - reach.z * reach.z;
        return square > 0.0 ? std::clamp(std::sqrt(square) / std::abs(reach.y), least, most) : 1.0;
    }
    // along s^2 + across s^-volume - wanted is convex: Newton's method comes down to its greater root.
    double stretch = std::sqrt(wanted / along);
    constexpr int most_steps = 100;
    for (int step = 0; step < most_steps; ++step) {
        const double thin = across * std::pow(stretch, -volume);
        const double slope = 2.0 * along * stretch - volume * thin / stretch;
        const double next = stretch - (along * stretch * stretch + thin - wanted) / slope;
        if (!(slope > 0.0) || !(next > 0.0)) return 1.0;
        if (next >= stretch) break;
        stretch = next;
    }
    return std::clamp(stretch, least, most);
}

}  // namespace

Solution::Solution(std::size_t longest)
    : pose_(longest),
      aim_(longest),
      plain_(longest),
      rotations_(longest),
      stretches_(longest),
      joints_(longest + 1) {}

AimReport Solution::solve(const ChainPlan::Chain& chain, const Task& task) {
    const ChainSettings& settings = task.settings;
    AimGoal goal;
    goal.count = pose_.size();
    goal.target = task.target;
    goal.softness = settings.softness;
    goal.hinge_angle = settings.hinge_angle;
    goal.pole = task.pole;
    goal.bend = settings.bend < 0 ? -1 : 1;
    goal.pole_angle = settings.pole_angle;
    goal.tolerance = settings.tolerance;
    goal.max_iterations = settings.max_iterations;
    goal.limits = task.limits;
    pose_.keep_volume(settings.volume);
    AimReport report = aim_.turn(pose_, goal);

    const double stretch = stretch_of(report, settings.stretch);
    double rest = stretch;
    const bool has_goal = !chain.has_free_effector && settings.rotation_weight > 0.0;
    turns_tail_ = has_goal && task.limits.empty();
    if (has_goal) {
        const AimReport whole = report;
        turn_tail(task, goal, report, stretch);
        if (turns_tail_ && pose_.size() > 1) rest = stretch * stretch_of(report, settings.stretch);
        report.distance = whole.distance;
        report.reach = whole.reach;
    }
    take_pose();
    is_stretched_ = rest != 1.0 || stretch != 1.0;
    if (is_stretched_) stretch_bones(rest, stretch, settings.volume);
    return report;
}

void Solution::stay() {
    turns_tail_ = false;
    is_stretched_ = false;
    take_pose();
}

void Solution::take_pose() {
    for (std::size_t i = 0; i < pose_.size(); ++i) {
        plain_[i] = pose_.posed(i).rotation;
        stretches_[i] = 1.0;
    }
    const std::size_t last = pose_.size() - 1;
    if (turns_tail_) plain_[last] = pose_.rotation_for(last, tail_frame_);
    std::copy_n(plain_.begin(), pose_.size(), rotations_.begin());
}

void Solution::turn_tail(const Task& task, AimGoal goal, AimReport& report, double stretch) {
    const std::size_t last = pose_.size() - 1;
    const double weight = task.settings.rotation_weight;
    tail_frame_ = pose_.frame(last);
    tail_goal_ = between(tail_frame_, task.orientation, weight);
    if (!task.limits.empty()) {
        goal.orientation = tail_goal_;
        const int before = report.iterations;
        report = aim_.turn(pose_, goal);
        report.iterations += before;
        return;
    }
    if (last == 0) {
        pose_.place(0, pose_.rotation_for(0, tail_goal_), 1.0);
        return;
    }
    // With all the weight on it the other bones are a chain of their own, from their FK pose to where the
    // turned tail bone begins, and the pole is theirs. Less weight leads over from the whole chain's solution
    // to that.
    const glm::dvec3 tip = pose_.root() + stretch * (pose_.tip() - pose_.root());
    for (std::size_t i = 0; i < last; ++i) {
        plain_[i] = pose_.posed(i).rotation;
        pose_.put(i, pose_.bone(i).rotation, 1.0);
    }
    goal.count = last;
    goal.target = task.target;
    reach_tail(task.orientation, goal, report, stretch);
    if (weight >= 1.0) return;
    for (std::size_t i = 0; i < last; ++i)
        pose_.put(i, between(plain_[i], pose_.posed(i).rotation, weight), 1.0);
    goal.softness *= weight;
    goal.pole.reset();  // it is in the pose already
    goal.pole_angle = 0.0;
    goal.target = glm::mix(tip, task.target, weight);
    reach_tail(tail_goal_, goal, report, stretch);
}

void Solution::reach_tail(const glm::dquat& frame, AimGoal goal, AimReport& report, double stretch) {
    const std::size_t last = pose_.size() - 1;
    const glm::dvec3 root = pose_.root();
    const glm::dvec3 end = goal.target;
    const auto turn_last = [&] {
        pose_.put(last, pose_.posed(last).rotation, 1.0);
        pose_.place(last, pose_.rotation_for(last, frame), 1.0);
        return pose_.tip() - pose_.joints()[last];
    };
    int iterations = report.iterations;
    glm::dvec3 tail = turn_last();
    constexpr int most_rounds = 20;  // in sheared spaces the tail's length depends on the bones before it
    for (int round = 0; round < most_rounds; ++round) {
        goal.target = root + (end - stretch * tail - root) / stretch;
        report = aim_.turn(pose_, goal);
        iterations += report.iterations;
        const glm::dvec3 before = tail;
        tail = turn_last();
        if (glm::distance(tail, before) <= 1e-11 * report.reach) break;
        goal.pole.reset();
        goal.pole_angle = 0.0;
    }
    report.iterations = iterations;
}

void Solution::stretch_bones(double rest, double last_stretch, double volume) {
    const std::size_t last = pose_.size() - 1;
    std::copy(pose_.joints().begin(), pose_.joints().end(), joints_.begin());
    for (std::size_t i = 0; i <= last; ++i) {
        const double factor = i == last ? last_stretch : rest;
        pose_.enter(i);
        // Stretch that the bone inherits counts as its own: only the missing part is added.
        const glm::dvec3 link = factor * (joints_[i + 1] - joints_[i]);
        const glm::dvec3 wanted = inverse_axes(pose_.posed(i).space.axes) * link;
        const double own = own_stretch(glm::dot(wanted, wanted), pose_.reach_of(i, 1.0), volume);
        const glm::dvec3 reach = pose_.reach_of(i, own);
        stretches_[i] = own;
        if (i == last && turns_tail_) {
            rotations_[i] = pose_.rotation_for(i, tail_frame_);
            pose_.place(i, pose_.rotation_for(i, tail_goal_), own);
            break;
        }
        const glm::dquat turn =
            smallest_turn_between(plain_[i] * reach, wanted, [] { return glm::dvec3(1.0, 0.0, 0.0); });
        rotations_[i] = normalized_product(turn * plain_[i]);
        pose_.place(i, rotations_[i], own);
    }
}

}  // namespace motus::bones::ik
