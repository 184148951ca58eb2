#include "straightening.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

/// A vector turned by the smallest turn that takes one direction to another, both of length 1 (Rodrigues'
/// formula); unchanged if they are opposite.
[[nodiscard]] glm::dvec3 turned(const glm::dvec3& vector, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 axis = glm::cross(from, to);
    const double beside = 1.0 + glm::dot(from, to);
    constexpr double opposite = 1e-9;
    if (beside < opposite) return vector;
    const glm::dvec3 across = glm::cross(axis, vector);
    return vector + across + glm::cross(axis, across) / beside;
}

}  // namespace

Straightening::Straightening(std::span<const Link> links, std::span<const double> masses) {
    for (const std::size_t i : interleaved(links)) {
        if (!(links[i].bend_frequency > 0.0) || links[i].parent < 0) continue;
        const auto parent = static_cast<std::size_t>(links[i].parent);
        if (links[parent].parent < 0) continue;
        const double rate = 2.0 * std::numbers::pi * links[i].bend_frequency;
        joints_.push_back({i, parent, static_cast<std::size_t>(links[parent].parent), masses[i] * rate * rate,
                           2.0 * links[i].damping * masses[i] * rate});
    }
}

void Straightening::hold(const Stepped& step, std::span<const glm::dvec3> pose,
                         std::span<const double> lengths, double duration) const {
    for (const auto& [particle, parent, above, stiffness, resistance] : joints_) {
        const glm::dvec3 rest_arm = pose[parent] - pose[above], rest_link = pose[particle] - pose[parent];
        const glm::dvec3 arm = step.state.places[parent] - step.state.places[above];
        const double rest_length = lengths[parent], square = glm::dot(arm, arm);
        if (!(rest_length > 0.0) || !(square > 0.0)) continue;
        const double back = 1.0 / rest_length;
        const glm::dvec3 straight = turned(rest_link, rest_arm * back, arm * (1.0 / std::sqrt(square)));
        const glm::dvec3 off = step.state.places[particle] - step.state.places[parent] - straight;
        // The link's end moves with it, and by `lever` the other way with the parent's link.
        const double lever = lengths[particle] * back;
        const auto& velocities = step.state.velocities;
        const glm::dvec3 speed =
            velocities[particle] - (1.0 + lever) * velocities[parent] + lever * velocities[above];
        const double mobility = step.mobilities[particle].displacement +
                                (1.0 + lever) * (1.0 + lever) * step.mobilities[parent].displacement +
                                lever * lever * step.mobilities[above].displacement;
        // Spring and damper as they are at the step's end, so that no stiffness is too much for the step.
        const glm::dvec3 impulse = (off * stiffness + speed * resistance) *
                                   (-duration / (1.0 + mobility * (stiffness * duration + resistance)));
        step.kick(particle, step.mobilities[particle].displacement * impulse);
        step.kick(parent, -(1.0 + lever) * step.mobilities[parent].displacement * impulse);
        step.kick(above, lever * step.mobilities[above].displacement * impulse);
    }
}

}  // namespace motus::strand
