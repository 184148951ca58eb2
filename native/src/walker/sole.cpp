#include "sole.hpp"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "across.hpp"
#include "motus/core/numeric.hpp"

namespace motus::walker {
namespace {

/// Parts of a usual stand, of 62 % of a cycle: the sole has rolled down at 12 % of the cycle, and the heel
/// rises from 31 % on.
constexpr double rolls_down = 0.2, rolls_up = 0.5;
/// Most of an actual stand that each of the two takes.
constexpr double most_of_stand = 0.5;

}  // namespace

SoleFrame::SoleFrame(const Soles& soles, const glm::dvec3& up)
    : soles_(soles),
      up_(unit_vector(up)),
      ahead_(across(unit_vector(soles.forward), up_)),
      side_(glm::cross(ahead_, up_)) {}

glm::dquat SoleFrame::flat(const glm::dmat4& pose, const glm::dvec3& normal) const {
    const glm::dvec3 ahead = unit_vector(glm::dmat3(pose) * ahead_);
    // On a wall that the body faces, its up is what is ahead of the sole.
    constexpr double facing = 1e-6;
    const bool is_faced = length_of(glm::cross(ahead, normal)) < facing;
    const glm::dvec3 along = across(is_faced ? glm::dmat3(pose) * up_ : ahead, normal);
    const glm::dmat3 world(glm::cross(along, normal), along, normal);
    return glm::normalize(glm::quat_cast(world * glm::transpose(glm::dmat3(side_, ahead_, up_))));
}

glm::dquat SoleFrame::turned(const glm::dquat& flat, double angle) const {
    return angle == 0.0 ? flat : glm::normalize(flat * glm::angleAxis(angle, up_));
}

SolePose SoleFrame::rolled(const glm::dvec3& place, const glm::dquat& flat, double pitch) const {
    if (pitch == 0.0) return {place, flat};
    const glm::dvec3 pivot = (pitch > 0.0 ? soles_.toe : -soles_.heel) * ahead_ - soles_.ankle * up_;
    const glm::dquat turn = flat * glm::angleAxis(-pitch, side_);
    return {place + flat * pivot - turn * pivot, turn};
}

void SoleFrame::add_rolls(std::vector<Footstep>& steps, std::span<const Pace> paces) const {
    for (std::size_t i = 1; i < steps.size(); ++i) {
        Footstep& step = steps[i];
        const double length = glm::dot(step.end - step.start, step.end_turn * ahead_);
        const auto [stride, duty] = paces[i];
        const double share = std::clamp(length / stride, -1.0, 1.0);
        step.push = share * soles_.push;
        step.strike = -share * soles_.strike;
        const double usual = (step.touch - step.lift) * duty / (1.0 - duty);
        const double until =
            i + 1 < steps.size() ? steps[i + 1].lift : std::numeric_limits<double>::infinity();
        step.pushing = std::min(rolls_up * usual, most_of_stand * (step.lift - steps[i - 1].touch));
        step.striking = std::min(rolls_down * usual, most_of_stand * (until - step.touch));
    }
}

SolePose SoleFrame::at(const Footstep& step, const Footstep* next, double time) const {
    const double through = step.through(time);
    if (through < 1.0) {
        const SolePose from = rolled(step.start, step.start_turn, step.push);
        const SolePose to = rolled(step.end, step.end_turn, step.strike);
        const double share = step.share(through);
        const glm::dvec3 place =
            share >= 1.0 ? to.position : from.position + share * (to.position - from.position);
        return {place + above(through) * step.rise, glm::slerp(from.turn, to.turn, along(through))};
    }
    // Before and after it rolls the sole is exactly on the stored foothold.
    double pitch = 0.0;
    if (time < step.touch + step.striking)
        pitch += step.strike * (1.0 - along((time - step.touch) / step.striking));
    if (next != nullptr && time > next->lift - next->pushing)
        pitch += next->push * along(1.0 - (next->lift - time) / next->pushing);
    return rolled(step.end, step.end_turn, pitch);
}

}  // namespace motus::walker
