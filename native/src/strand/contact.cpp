#include "contact.hpp"

#include <algorithm>
#include <cmath>

namespace motus::strand {
namespace {

/// What is left of a way or velocity along a surface that friction may take away.
[[nodiscard]] glm::dvec3 held(const glm::dvec3& sliding, double most, double& used) {
    const double size = glm::length(sliding), left = std::max(most - used, 0.0);
    if (size <= left) {
        used += size;
        return sliding;
    }
    used += left;
    return sliding * (left / size);
}

}  // namespace

Contact contact_on_link(std::size_t first, std::size_t second, double share) {
    return {.terms = {{{first, 1.0 - share}, {second, share}}}, .count = 2};
}

void resolve(const Contact& contact, double coefficient, double duration, const Stepped& step,
             Friction& friction) {
    const std::span terms(contact.terms.data(), contact.count);
    double mobility = 0.0;
    glm::dvec3 way(0.0), velocity(0.0), before(0.0);
    for (const Contact::Term& term : terms) {
        mobility += step.mobilities[term.particle].displacement * term.weight * term.weight;
        way += term.weight * step.state.places[term.particle];
        before += term.weight * step.before[term.particle];
        velocity += term.weight * step.state.velocities[term.particle];
    }
    if (!(mobility > 0.0)) return;
    way -= before;
    way -= contact.carried;
    velocity -= contact.carried / duration;
    const auto along_surface = [&](const glm::dvec3& v) {
        return v - contact.normal * glm::dot(v, contact.normal);
    };
    const double out = std::max(contact.depth, 0.0);
    const double entering = std::max(-glm::dot(velocity, contact.normal), 0.0);
    friction.pushed += out;
    friction.stopped += entering;
    const glm::dvec3 still = held(along_surface(way), coefficient * friction.pushed, friction.held);
    const glm::dvec3 slower = held(along_surface(velocity), coefficient * friction.stopped, friction.braked);
    const glm::dvec3 push = (contact.normal * out - still) / mobility;
    const glm::dvec3 brake = (contact.normal * entering - slower) / mobility;
    for (const Contact::Term& term : terms) {
        const double moved = step.mobilities[term.particle].displacement * term.weight;
        step.state.places[term.particle] += moved * push;
        step.state.velocities[term.particle] += moved * brake;
    }
}

Shares nearest(const glm::dvec3& start1, const glm::dvec3& way1, const glm::dvec3& start2,
               const glm::dvec3& way2) {
    const glm::dvec3 between = start1 - start2;
    const double square1 = glm::dot(way1, way1), square2 = glm::dot(way2, way2);
    const double f = glm::dot(way2, between);
    if (!(square1 > 0.0)) return {1.0, square2 > 0.0 ? std::clamp(f / square2, 0.0, 1.0) : 0.0};
    const double c = glm::dot(way1, between);
    if (!(square2 > 0.0)) return {std::clamp(-c / square1, 0.0, 1.0), 0.0};
    const double b = glm::dot(way1, way2);
    const double divisor = square1 * square2 - b * b;
    double s = divisor > 0.0 ? std::clamp((b * f - c * square2) / divisor, 0.0, 1.0) : 1.0;
    double t = (b * s + f) / square2;
    if (t < 0.0 || t > 1.0) {
        t = std::clamp(t, 0.0, 1.0);
        s = std::clamp((b * t - c) / square1, 0.0, 1.0);
    }
    return {s, t};
}

}  // namespace motus::strand
