#include "motus/bones/look_at/gaze.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "motus/bones/chains/two_bone.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::look_at {
namespace {

using std::numbers::pi;

constexpr double soft_share = 0.2;         // of a limit: where a turn begins to slow
constexpr double widest_fade = 0.25 * pi;  // before the direction behind
constexpr double leaning_from = 0.6;       // sine of the height above which level leans
constexpr double most_lean = 0.8;
constexpr double carried_from = 0.3,
                 carried_to = -0.5;  // cosines of the angle off forward: see Level::in_front

/// How much of a limited turn is left if the target lies `angle` off forward. It fades later the wider the
/// limit, and not at all for a free turn, which meets its target even behind.
double fade(double angle, double limit) {
    const double width = std::min(widest_fade, 0.5 * (pi - limit));
    return smooth_step((pi - angle) / width);
}

double share(double weight) {
    return std::clamp(weight, 0.0, 1.0);
}

/// The angle by which a step in the chart turns the gaze, judged at the start of the step: off its centre the
/// chart stretches directions around the centre.
double angle_near(const glm::dvec2& from, const glm::dvec2& step) {
    const double off = glm::length(from);
    if (off == 0.0) return glm::length(step);
    const glm::dvec2 outwards = from / off;
    const double round = (outwards.x * step.y - outwards.y * step.x) * (std::sin(off) / off);
    return glm::length(glm::dvec2(glm::dot(outwards, step), round));
}

}  // namespace

GazeChart::GazeChart(const glm::dvec3& forward, const glm::dvec3& up, Level level)
    : forward_(forward),
      left_(glm::normalize(glm::cross(up, forward))),
      up_(glm::cross(forward, left_)),
      level_(level) {}

glm::dvec2 GazeChart::place(const glm::dvec3& direction) const {
    const glm::dvec2 across(glm::dot(direction, left_), glm::dot(direction, up_));
    const double sine = glm::length(across);
    const double cosine = glm::dot(direction, forward_);
    if (sine == 0.0) return {cosine < 0.0 ? pi : 0.0, 0.0};
    return std::atan2(sine, cosine) / sine * across;
}

glm::dvec3 GazeChart::direction(const glm::dvec2& place) const {
    const double angle = glm::length(place);
    const double slope = angle > 0.0 ? std::sin(angle) / angle : 1.0;
    return std::cos(angle) * forward_ + slope * (place.x * left_ + place.y * up_);
}

glm::dvec2 GazeChart::yaw_pitch(const glm::dvec3& direction) const {
    const double left = glm::dot(direction, left_);
    const double ahead = glm::dot(direction, forward_);
    return {std::atan2(left, ahead), std::atan2(glm::dot(direction, up_), std::hypot(left, ahead))};
}

glm::dquat GazeChart::level(const glm::dvec2& place) const {
    const glm::dvec3 direction = this->direction(place);
    const double height = glm::dot(direction, up_);
    const double lean = smooth_step((std::abs(height) - leaning_from) / (1.0 - leaning_from));
    glm::dvec3 top = up_ - std::copysign(most_lean * lean, height) * forward_;
    const double ahead = glm::dot(direction, forward_);
    if (level_ == Level::in_front && ahead < carried_from && ahead > -1.0) {
        const double share_of_carried = smooth_step((carried_from - ahead) / (carried_from - carried_to));
        const glm::dvec3 carried = up_ - height / (1.0 + ahead) * (forward_ + direction);
        top = glm::mix(top, carried, share_of_carried);
    }
    const glm::dvec3 right = glm::cross(direction, top);
    const double length = glm::length(right);
    const glm::dvec3 x = length > 1e-12 ? right / length : -left_;
    return glm::quat_cast(glm::dmat3(x, direction, glm::cross(x, direction)));
}

glm::dquat GazeChart::turn(const glm::dvec2& from, const glm::dvec2& to) const {
    const glm::dquat turn = level(to) * glm::conjugate(level(from));
    return turn.w < 0.0 ? -turn : turn;
}

Level level_for(const GazeSettings& settings) {
    const double widest_side = std::max(settings.head_sides.left, settings.head_sides.right);
    const bool turns_round = settings.clamp <= 0.0 && std::min(settings.head_limit, widest_side) >= pi;
    return turns_round ? Level::all_round : Level::in_front;
}

GazeStep limited_turn(const glm::dvec2& from, const glm::dvec2& turn, double limit,
                      const glm::dvec2& target) {
    if (limit >= pi) return {turn, false};
    const double angle = angle_near(from, turn);
    if (angle == 0.0) return {turn, false};
    const double allowed = std::max(limit, 0.0);
    const double softness = std::min(soft_share * allowed, 0.25 * (pi - allowed));
    const double factor =
        chains::soft_reach(angle, allowed, softness) / angle * fade(glm::length(target), allowed);
    return {factor * turn, factor < 1.0};
}

GazeStep side_limited_turn(const glm::dvec2& from, const glm::dvec2& turn, const SideLimits& sides,
                           const glm::dvec2& target) {
    const GazeStep across =
        limited_turn(from, {turn.x, 0.0}, turn.x > 0.0 ? sides.left : sides.right, target);
    const GazeStep upwards = limited_turn(from, {0.0, turn.y}, turn.y > 0.0 ? sides.up : sides.down, target);
    return {across.by + upwards.by, across.is_limited || upwards.is_limited};
}

GazeStep gaze_goal(const glm::dvec2& animated, const glm::dvec2& target, const GazeSettings& settings) {
    const double freedom = (1.0 - share(settings.clamp)) * pi;
    const GazeStep whole = limited_turn(animated, target - animated, freedom, target);
    const double weight = share(settings.weight);
    // The target itself rather than a sum that rounds.
    if (weight == 1.0 && !whole.is_limited) return {target, false};
    return {animated + weight * whole.by, whole.is_limited && weight > 0.0};
}

GazeStep gaze_share(const glm::dvec2& present, const GazeStep& goal, const glm::dvec2& target,
                    const GazePart& part) {
    const double weight = share(part.weight);
    const GazeStep whole = limited_turn(present, weight * (goal.by - present), part.limit, target);
    const GazeStep step = side_limited_turn(present, whole.by, part.sides, target);
    return {step.by, whole.is_limited || step.is_limited || (goal.is_limited && weight > 0.0)};
}

Turns turns_to(const GazeChart& chart, const glm::dvec3& animated, const glm::dvec3& target,
               const GazeSettings& settings) {
    Turns turns;
    bool is_limited = false;
    glm::dvec2 present = chart.place(animated);
    const glm::dvec2 wanted = chart.place(target);
    const GazeStep goal = gaze_goal(present, wanted, settings);
    const auto take = [&](const GazePart& part, glm::dquat& turn) {
        const GazeStep step = gaze_share(present, goal, wanted, part);
        is_limited = is_limited || step.is_limited;
        if (step.by == glm::dvec2(0.0)) return;
        const glm::dvec2 next = present + step.by;
        turn = chart.turn(present, next);
        present = next;
    };
    take({settings.body_weight, settings.body_limit}, turns.body);
    take({settings.head_weight, settings.head_limit, settings.head_sides}, turns.head);
    take({settings.eyes_weight, settings.eyes_limit, settings.eyes_sides}, turns.eyes);
    turns.residual = angle_between(chart.direction(present), target);
    if (is_limited && turns.residual > reached_angle) turns.reason = Reason::limit;
    return turns;
}

}  // namespace motus::bones::look_at
