#include "limited_lead.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "limited_step.hpp"
#include "motus/bones/chains/bend_plane.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::chains {
namespace {

constexpr double closed = 1e-9;  // a tip nearer to the root shows no direction

struct Line {
    glm::dvec3 along{0.0, 1.0, 0.0};
    double length = 0.0;
};

Line line_of(const LimitedPose& pose) {
    const double length = glm::length(pose.tip());
    const glm::dvec3 shown = unit_vector(length > closed ? pose.tip() : pose.joint(1));
    return {shown != glm::dvec3(0.0) ? shown : glm::dvec3(0.0, 1.0, 0.0), length};
}

/// Sum of the cross products of all pairs of bones: the normal of the plane that the pose bends in.
glm::dvec3 area_of(const LimitedPose& pose) {
    glm::dvec3 area(0.0);
    for (std::size_t i = 1; i < pose.count(); ++i)
        area += glm::cross(pose.joint(i + 1) - pose.joint(i), pose.joint(i));
    return area;
}

/// Angle between two equal bones whose ends are at this distance, a share of their summed length.
double bend_at(double distance) {
    return std::sqrt(8.0 * std::max(0.0, 1.0 - distance));
}

bool is_free(const JointLimits& limits) {
    return std::isinf(limits.min.x) && std::isinf(limits.max.x) && std::isinf(limits.min.z) &&
           std::isinf(limits.max.z) && limits.max.y - limits.min.y >= 6.28;
}

/// Approximate change of a joint's swing by a turn about `axis`, in the chain's space.
glm::dvec2 swing_about(const LimitedPose& pose, std::size_t bone, const glm::dvec3& axis) {
    const glm::dvec3 seen = glm::conjugate(pose.socket(bone)) * axis;
    return {seen.x, seen.z};
}

/// How far the joints can turn about `axis` within their limits, up to a radian for each joint; summed.
double room_about(const LimitedPose& pose, const glm::dvec3& axis) {
    double room = 0.0;
    for (std::size_t i = 1; i < pose.count(); ++i) {
        const glm::dvec2 swing = pose.angles()[i].swing;
        room += glm::distance(clamp_swing(swing + swing_about(pose, i, axis), pose.limits(i)), swing);
    }
    return room;
}

/// The direction of swing in which a hinge has the most room within its limits.
glm::dvec2 widest_way(const glm::dvec2& swing, const JointLimits& limits) {
    glm::dvec2 best(0.0);
    for (const glm::dvec2 way : {glm::dvec2(1.0, 0.0), {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
        const glm::dvec2 moved = clamp_swing(swing + way, limits) - swing;
        if (glm::length(moved) > glm::length(best) + 1e-9) best = moved;
    }
    return best;
}

/// Bends a pose by `angle` in all towards the side of the normal, or to the opposite side if the limits leave
/// far more room there. Hinges that lie across the normal bend as they can.
void bend(LimitedPose& pose, const LimitedTuning& tuning, const glm::dvec3& normal, double angle) {
    const double room = room_about(pose, -normal);
    const double other_room = room_about(pose, normal);
    const double inner = static_cast<double>(pose.count() - 1);
    const bool is_across = std::max(room, other_room) < tuning.least_room * inner;
    const glm::dvec3 axis = room < tuning.other_side_room * other_room ? normal : -normal;
    Angles bent;
    bent[0] = pose.angles()[0];
    for (std::size_t i = 1; i < pose.count(); ++i) {
        bent[i] = pose.angles()[i];
        const glm::dvec2 way =
            is_across ? widest_way(bent[i].swing, pose.limits(i)) : swing_about(pose, i, axis);
        bent[i].swing = clamp_swing(bent[i].swing + angle / inner * way, pose.limits(i));
    }
    pose.set(bent);
}

/// Turns the root, as far as its limits allow.
void turn_root(LimitedPose& pose, const glm::dquat& turn) {
    const glm::dquat& socket = pose.socket(0);
    const glm::dquat rotation = glm::normalize(glm::conjugate(socket) * turn * pose.frame(0));
    Angles turned;
    std::copy_n(pose.angles().begin(), pose.count(), turned.begin());
    turned[0] = swing_twist_of(clamp_rotation(rotation, pose.limits(0)));
    turned[0] = {clamp_swing(turned[0].swing, pose.limits(0)), clamp_twist(turned[0].twist, pose.limits(0))};
    pose.set(turned);
}

/// Detects that further steps do not pay, because the target is out of the reach that the limits allow.
class Progress {
  public:
    explicit Progress(const LimitedTuning& tuning) : tuning_(tuning) {}

    [[nodiscard]] bool ends_at(double miss) {
        if (miss < tuning_.paying * best_) {
            best_ = miss;
            idle_ = 0;
        }
        return ++idle_ > tuning_.idle_steps;
    }

  private:
    const LimitedTuning& tuning_;
    double best_ = std::numeric_limits<double>::infinity();
    int idle_ = 0;
};

class Lead {
  public:
    Lead(LimitedPose& pose, const LeadGoal& goal, const LimitedTuning& tuning, int max_steps)
        : pose_(pose),
          goal_(goal),
          tuning_(tuning),
          from_(line_of(pose)),
          distance_(glm::length(goal.target)),
          left_(max_steps) {
        const glm::dvec3 shown = unit_vector(goal.target);
        to_ = shown != glm::dvec3(0.0) ? shown : from_.along;
    }

    int run() {
        const int most = left_;
        if (!goal_.side && is_at(goal_.target)) return 0;
        const glm::dvec3 normal = find_normal();
        turn_ = smallest_turn(from_.along, to_, normal);
        const double angle = goal_.side ? angle_to_side(turn_ * normal) : 0.0;
        start_bending();
        stretch(std::min(most, tuning_.most_stretches));
        const Line now = line_of(pose_);
        back_ = smallest_turn(now.along, from_.along, normal);
        if (is_free(pose_.limits(0))) {
            turn_root(pose_, place(angle, 1.0));
        } else {
            turn_with_limits(angle);
        }
        pull(goal_.target, most);
        return most - left_;
    }

  private:
    [[nodiscard]] bool is_at(const glm::dvec3& place) const {
        return glm::distance(pose_.tip(), place) <= goal_.tolerance;
    }

    /// How straight the pose is: 1 if it bends by at most 1 degree, 0 if it bends by 8 degrees or more.
    [[nodiscard]] double straightness() const {
        return 1.0 - certainty_of_bend(std::sin(std::min(bend_at(from_.length), 0.5 * std::numbers::pi)));
    }

    /// Normal of the plane in which the bent pose will lie.
    glm::dvec3 find_normal() {
        straight_ = pose_.count() > 1 ? straightness() : 0.0;
        const glm::dvec3 given = normal_across(from_.along, goal_.normal);
        bend_normal_ = given;
        if (straight_ >= 1.0 && !goal_.side) return given;
        if (straight_ > 0.0) {
            Angles before;
            std::copy_n(pose_.angles().begin(), pose_.count(), before.begin());
            bend(pose_, tuning_, given, tuning_.shown_bend);
            const glm::dvec3 area = area_of(pose_);
            pose_.set(before);
            return normal_across(from_.along, glm::mix(area_of(pose_), area, straight_));
        }
        return normal_across(from_.along, area_of(pose_));
    }

    /// Angle by which the bend has to turn about the line to the target to be on the wanted side.
    [[nodiscard]] double angle_to_side(const glm::dvec3& normal) const {
        const glm::dvec3 side = glm::cross(normal, to_);
        const glm::dvec3 wanted = blended_normal(side, *goal_.side, to_, goal_.certainty);
        return std::atan2(glm::dot(glm::cross(side, wanted), to_), glm::dot(side, wanted));
    }

    /// Bends a straight pose a little, since such a pose shows no side to bend to.
    void start_bending() {
        const double missing = bend_at(distance_) - bend_at(from_.length);
        if (straight_ > 0.0 && missing > 0.0)
            bend(pose_, tuning_, bend_normal_, straight_ * std::min(missing, tuning_.most_first_bend));
    }

    /// Bends the joints after the root until the tip is as far away as the target.
    void stretch(int most) {
        const double near = 1e-3 * goal_.tolerance;
        Progress progress(tuning_);
        for (int i = 0; i < most && left_ > 0; ++i, --left_) {
            const Line now = line_of(pose_);
            const double error = distance_ - now.length;
            const double miss = std::abs(error);
            if (miss <= near || progress.ends_at(miss) || !step_along(pose_, tuning_, now.along, error))
                return;
        }
    }

    void pull(const glm::dvec3& place, int most) {
        const double near = 1e-3 * goal_.tolerance;
        Progress progress(tuning_);
        for (int i = 0; i < most && left_ > 0; ++i, --left_) {
            const glm::dvec3 error = place - pose_.tip();
            const double miss = glm::length(error);
            if (miss <= near || progress.ends_at(miss) || !step_towards(pose_, tuning_, error)) return;
        }
    }

    [[nodiscard]] glm::dquat place(double angle, double share) const {
        const glm::dquat swing = share_of_turn(turn_, share);
        const glm::dquat whole = swing * share_of_turn(back_, share);
        if (angle == 0.0) return whole;
        return glm::angleAxis(share * angle, swing * from_.along) * whole;
    }

    void turn_with_limits(double angle) {
        glm::dquat before = no_turn;
        const glm::dvec3 start = line_of(pose_).along;
        for (int i = 1; i <= tuning_.turn_steps; ++i) {
            const glm::dquat now = place(angle, static_cast<double>(i) / tuning_.turn_steps);
            turn_root(pose_, now * glm::conjugate(before));
            before = now;
            pull(distance_ * (now * start), 1);
        }
    }

    LimitedPose& pose_;
    const LeadGoal& goal_;
    const LimitedTuning& tuning_;
    Line from_;
    glm::dvec3 to_{0.0};
    double distance_;
    int left_;
    double straight_ = 0.0;
    glm::dvec3 bend_normal_{0.0};
    glm::dquat turn_ = no_turn;  // of the line, to the target
    glm::dquat back_ = no_turn;  // of the bent pose's line, to where it was
};

}  // namespace

int lead(LimitedPose& pose, const LeadGoal& goal, const LimitedTuning& tuning, int max_steps) {
    return Lead(pose, goal, tuning, max_steps).run();
}

}  // namespace motus::bones::chains
