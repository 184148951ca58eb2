#include "contacts.hpp"

#include <algorithm>
#include <cmath>

#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

/// A place on a link that has entered an obstacle.
struct Contact {
    std::size_t first = 0, second = 0;  ///< the link's ends
    double share = 0.0;                 ///< from the first to the second
    glm::dvec3 normal{0.0};             ///< outwards
    double depth = 0.0;                 ///< m, > 0
    glm::dvec3 carried{0.0};            ///< how the obstacle moves there within the step
};

/// Puts the place onto the obstacle, without any speed by that: what begins inside is not thrown out.
void resolve(const Contact& contact, double friction, double duration, const Stepped& step) {
    const double share1 = 1.0 - contact.share, share2 = contact.share;
    const double way1 = step.yieldings[contact.first].way, way2 = step.yieldings[contact.second].way;
    const double yielding = way1 * share1 * share1 + way2 * share2 * share2;
    if (!(yielding > 0.0)) return;
    auto& places = step.state.places;
    auto& velocities = step.state.velocities;
    const auto mixed = [&](const auto& of) {
        return share1 * of[contact.first] + share2 * of[contact.second];
    };
    const auto along_surface = [&](const glm::dvec3& v) {
        return v - contact.normal * glm::dot(v, contact.normal);
    };
    // What friction takes away of a way or velocity along the surface, if `push` is that against it.
    const auto held = [&](const glm::dvec3& sliding, double push) {
        const double size = glm::length(sliding);
        return size > friction * push ? sliding * (friction * push / size) : sliding;
    };
    const glm::dvec3 way = mixed(places) - mixed(step.before) - contact.carried;
    const glm::dvec3 velocity = mixed(velocities) - contact.carried / duration;
    const double entering = std::max(-glm::dot(velocity, contact.normal), 0.0);
    const glm::dvec3 push =
        (contact.normal * contact.depth - held(along_surface(way), contact.depth)) / yielding;
    const glm::dvec3 brake = (contact.normal * entering - held(along_surface(velocity), entering)) / yielding;
    places[contact.first] += way1 * share1 * push;
    places[contact.second] += way2 * share2 * push;
    velocities[contact.first] += way1 * share1 * brake;
    velocities[contact.second] += way2 * share2 * brake;
}

struct Shares {
    double first = 0.0, second = 0.0;
};

/// Where two segments are nearest, as shares of both: Ericson, "Real-Time Collision Detection" (2005), 5.1.9.
[[nodiscard]] Shares nearest(const glm::dvec3& start1, const glm::dvec3& way1, const glm::dvec3& start2,
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

}  // namespace

Contacts::Contacts(std::span<const Link> links, std::span<const Obstacle> obstacles)
    : obstacles_(obstacles.begin(), obstacles.end()) {
    for (const Link& link : links) bodies_.push_back({link.parent, link.thickness});
}

void Contacts::keep_out(const Stepped& step, std::span<const glm::dvec3> before,
                        std::span<const glm::dvec3> now, double duration) const {
    for (std::size_t k = 0; k < obstacles_.size(); ++k) {
        const Obstacle& obstacle = obstacles_[k];
        const glm::dvec3 start = now[2 * k], axis = now[2 * k + 1] - start;
        const glm::dvec3 carried1 = start - before[2 * k], carried2 = now[2 * k + 1] - before[2 * k + 1];
        if (obstacle.shape == Obstacle::Shape::plane) {
            const glm::dvec3 normal = direction_or(axis, glm::dvec3(0.0));
            if (normal == glm::dvec3(0.0)) continue;
            for (std::size_t i = 0; i < bodies_.size(); ++i) {
                const double depth =
                    obstacle.radius + bodies_[i].thickness - glm::dot(step.state.places[i] - start, normal);
                if (depth > 0.0)
                    resolve({i, i, 0.0, normal, depth, carried1}, obstacle.friction, duration, step);
            }
            continue;
        }
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (bodies_[i].parent < 0) continue;
            const auto parent = static_cast<std::size_t>(bodies_[i].parent);
            const glm::dvec3 root = step.state.places[parent];
            const glm::dvec3 link = step.state.places[i] - root;
            const double reach = obstacle.radius + bodies_[i].thickness;
            const Shares shares = nearest(root, link, start, axis);
            const glm::dvec3 apart = root + shares.first * link - (start + shares.second * axis);
            const double square = glm::dot(apart, apart);
            if (!(square < reach * reach)) continue;
            const double distance = std::sqrt(square);
            // From the very middle the way out is any.
            const glm::dvec3 normal = direction_or(apart, glm::dvec3(0.0, 0.0, 1.0));
            resolve({parent, i, shares.first, normal, reach - distance,
                     carried1 + shares.second * (carried2 - carried1)},
                    obstacle.friction, duration, step);
        }
    }
}

}  // namespace motus::strand
