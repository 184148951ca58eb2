#include "motus/walker/walker.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "plan.hpp"
#include "sole.hpp"

namespace motus::walker {
namespace {

constexpr double largest_number = 1e12;

[[nodiscard]] bool is_length(double value) {
    return value >= 0.0 && value <= largest_number;
}
[[nodiscard]] bool is_share(double value) {
    return value >= 0.0 && value <= 1.0;
}

[[nodiscard]] bool is_pitch(double value) {
    constexpr double upright = 1.5707963267948966;
    return value >= 0.0 && value <= upright;
}

[[nodiscard]] bool is_place(const glm::dvec3& place) {
    return is_finite(place) && is_length(length_of(place));
}

void check(const Soles& soles) {
    require(is_finite(soles.forward), "forward: must be finite");
    require(is_length(soles.ankle), "ankle: must be from 0 to 1e12");
    require(is_length(soles.heel), "heel: must be from 0 to 1e12");
    require(is_length(soles.toe), "toe: must be from 0 to 1e12");
    require(is_pitch(soles.strike), "strike: must be from 0 to pi/2");
    require(is_pitch(soles.push), "push: must be from 0 to pi/2");
}

/// Checks a step that is chosen, and makes its turn one of unit length.
void check(ChosenStep& step, std::size_t legs) {
    require(step.leg < legs, "chosen: must have legs of rest");
    require(std::isfinite(step.time) && std::isfinite(step.touch.value_or(0.0)) &&
                std::isfinite(step.until.value_or(0.0)),
            "chosen: must have finite times");
    require(is_place(step.offset), "chosen: must have finite offsets, 1e12 at most");
    require(is_length(std::abs(step.turn)), "chosen: must have finite turns, 1e12 at most");
    if (!step.fixed) return;
    require(is_place(step.fixed->place), "chosen: must have finite places, 1e12 at most");
    glm::dquat& turn = step.fixed->turn;
    const double size = std::max({std::abs(turn.w), std::abs(turn.x), std::abs(turn.y), std::abs(turn.z)});
    require(is_finite(turn) && size > 0.0, "chosen: must have finite rotations that are not 0");
    turn = glm::normalize(glm::dquat(turn.w / size, turn.x / size, turn.y / size, turn.z / size));
}

[[nodiscard]] WalkSettings checked(WalkSettings settings, const Way& way) {
    const std::size_t legs = way.rest.size(), samples = way.times.size();
    check(settings.soles);
    require(is_length(settings.clearance), "clearance: must be from 0 to 1e12");
    require(is_length(settings.reach_up), "reach_up: must be from 0 to 1e12");
    require(is_length(settings.reach_down), "reach_down: must be from 0 to 1e12");
    require(is_length(settings.minimum_step), "minimum_step: must be from 0 to 1e12");
    require(is_share(settings.height), "height: must be from 0 to 1");
    require(is_share(settings.tilt), "tilt: must be from 0 to 1");
    require(settings.hips.empty() || settings.hips.size() == legs,
            "hips: must be as many as the legs of rest");
    require(settings.lengths.size() == settings.hips.size(), "lengths: must be as many as hips");
    for (const glm::dvec3& hip : settings.hips)
        require(is_place(hip), "hips: must be finite, and 1e12 at most");
    require(settings.bodies.empty() || settings.bodies.size() == samples,
            "bodies: must be as many as the samples of poses");
    for (const glm::dmat4& body : settings.bodies)
        for (glm::length_t column = 0; column < 4; ++column)
            require(is_place(glm::dvec3(body[column])), "bodies: must be finite, and 1e12 at most");
    for (const double length : settings.lengths)
        require(is_length(length), "lengths: must be from 0 to 1e12");
    for (ChosenStep& step : settings.chosen) check(step, legs);
    return settings;
}

}  // namespace

Walker::Walker(Way way, WalkSettings settings, const Ground* ground, const Executor& executor)
    : trajectory_(in_ieee_floats([&] { return BodyTrajectory(std::move(way)); })),
      settings_(checked(std::move(settings), trajectory_.way())) {
    WalkPlan plan = in_ieee_floats([&] { return Planner(settings_, trajectory_, ground, executor).plan(); });
    steps_ = std::move(plan.steps);
    leans_ = std::move(plan.leans);
    problems_ = std::move(plan.problems);
    settled_ = plan.settled;
}

Foot Walker::foot(std::size_t leg, double time) const {
    require(leg < leg_count(), "leg: must be one of the walker's");
    require(std::isfinite(time), "time: must be finite");
    return in_ieee_floats([&] {
        const std::size_t row = leg * trajectory_.stretch_count() + trajectory_.stretch_at(time);
        const std::span<const Footstep> steps = steps_.of(row);
        const Footstep& step = step_at(steps, time);
        const bool is_last = &step == &steps.back();
        const SolePose sole =
            SoleFrame(settings_.soles, trajectory_.way().up).at(step, is_last ? nullptr : &step + 1, time);
        const double through = step.through(time);
        if (through >= 1.0) return Foot{sole.position, step.end_normal, 0.0, sole.turn};
        const double share = step.share(through);
        const glm::dvec3 normal = step.start_normal + share * (step.end_normal - step.start_normal);
        return Foot{sole.position, direction_or(normal, step.end_normal), through, sole.turn};
    });
}

Correction Walker::body(double time) const {
    require(std::isfinite(time), "time: must be finite");
    return in_ieee_floats([&] {
        glm::dvec3 lean(0.0);
        leans_->evaluate(time, {&lean[0], 3});
        return corrected(settings_, lean,
                         trajectory_.axes(trajectory_.pose(trajectory_.stretch_at(time), time)));
    });
}

double Walker::phase(double time) const {
    require(std::isfinite(time), "time: must be finite");
    return trajectory_.phase(trajectory_.stretch_at(time), time);
}

std::span<const Footstep> Walker::steps(std::size_t leg) const {
    require(leg < leg_count(), "leg: must be one of the walker's");
    const std::size_t stretches = trajectory_.stretch_count();
    return steps_.between(leg * stretches, (leg + 1) * stretches);
}

std::size_t Walker::bytes() const noexcept {
    return trajectory_.bytes() + steps_.bytes() + problems_.capacity() * sizeof(Problem) + leans_->bytes() +
           settings_.hips.capacity() * sizeof(glm::dvec3) + settings_.bodies.capacity() * sizeof(glm::dmat4) +
           settings_.lengths.capacity() * sizeof(double) + settings_.chosen.capacity() * sizeof(ChosenStep);
}

}  // namespace motus::walker
