#include "bends.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::strand {

Bends::Bends(std::span<const Link> links) : turns_(links.size(), bones::no_turn), is_moved_(links.size()) {
    for (std::size_t i = 0; i < links.size(); ++i) {
        parents_.push_back(links[i].parent);
        most_.push_back(links[i].bend);
        if (links[i].parent >= 0 && links[i].bend < std::numbers::pi) limited_ = i + 1;
    }
}

void Bends::hold(const Stepped& step, std::span<const glm::dvec3> pose, std::span<const double> lengths,
                 double duration) {
    constexpr int rounds = 2;
    for (int round = 0; round < rounds; ++round) {
        bool has_turned = false;
        visit(step, pose, [&](std::size_t i, const glm::dvec3& straight) {
            has_turned |= straighten(step, i, straight);
        });
        if (!has_turned) return;
    }
    // What is left is turned without the links that it hangs on.
    std::fill(is_moved_.begin(), is_moved_.end(), 0);
    visit(step, pose, [&](std::size_t i, const glm::dvec3& straight) {
        const auto parent = static_cast<std::size_t>(parents_[i]);
        const glm::dvec3 root = step.state.places[parent], link = step.state.places[i] - root;
        const double angle = bones::angle_between(straight, link);
        const bool is_beyond = angle > most_[i];
        if ((!is_beyond && is_moved_[parent] == 0) || !(step.yieldings[i].way > 0.0)) return;
        const glm::dvec3 axis = direction_or(glm::cross(straight, link), glm::dvec3(0.0));
        const glm::dvec3 along = direction_or(link, direction_or(straight, glm::dvec3(0.0)));
        const double back = is_beyond ? most_[i] - angle : 0.0;
        const glm::dvec3 place =
            root + lengths[i] * (std::cos(back) * along + std::sin(back) * glm::cross(axis, along));
        step.state.velocities[i] += (place - step.state.places[i]) / duration;
        step.state.places[i] = place;
        is_moved_[i] = 1;
    });
}

/// Calls visit(particle, straight) of each link, from the roots to the tips, `straight` being where the link
/// would point if it followed its parent's.
template <class Visit>
void Bends::visit(const Stepped& step, std::span<const glm::dvec3> pose, const Visit& visit) {
    for (std::size_t i = 0; i < limited_; ++i) {
        if (parents_[i] < 0) continue;
        const auto parent = static_cast<std::size_t>(parents_[i]);
        const glm::dvec3 straight = turns_[parent] * (pose[i] - pose[parent]);
        visit(i, straight);
        const glm::dvec3 link = step.state.places[i] - step.state.places[parent];
        const auto across = [&] { return glm::dvec3(1.0, 0.0, 0.0); };
        turns_[i] =
            bones::normalized_product(bones::smallest_turn_between(straight, link, across) * turns_[parent]);
    }
}

/// Returns whether it was bent too far.
bool Bends::straighten(const Stepped& step, std::size_t particle, const glm::dvec3& straight) const {
    const auto parent = static_cast<std::size_t>(parents_[particle]);
    const auto& places = step.state.places;
    auto& velocities = step.state.velocities;
    const glm::dvec3 link = places[particle] - places[parent];
    const double length = glm::length(link);
    const double angle = bones::angle_between(straight, link);
    if (!(angle > most_[particle]) || !(length > 0.0)) return false;
    const glm::dvec3 along = link / length;
    const glm::dvec3 axis = direction_or(glm::cross(straight, link), glm::dvec3(0.0));
    if (axis == glm::dvec3(0.0)) return false;
    // How the angle grows with each place: of the link's ends, and of the parent's link, along which it is
    // straight.
    const glm::dvec3 out = glm::cross(axis, along) / length;
    glm::dvec3 middle = -out, back(0.0);
    double yielding = step.yieldings[particle].way * glm::dot(out, out);
    std::size_t above = parent;
    if (parents_[parent] >= 0) {
        above = static_cast<std::size_t>(parents_[parent]);
        const glm::dvec3 arm = places[parent] - places[above];
        const double square = glm::dot(arm, arm);
        if (square > 0.0) {
            back = glm::cross(axis, arm) / square;
            middle -= back;
            yielding += step.yieldings[above].way * glm::dot(back, back);
        }
    }
    yielding += step.yieldings[parent].way * glm::dot(middle, middle);
    if (!(yielding > 0.0)) return false;
    const double speed = glm::dot(out, velocities[particle]) + glm::dot(middle, velocities[parent]) +
                         glm::dot(back, velocities[above]);
    const double turn = (most_[particle] - angle) / yielding;
    const double brake = std::min(-speed, 0.0) / yielding;
    const auto move = [&](std::size_t which, const glm::dvec3& direction) {
        const double way = step.yieldings[which].way;
        step.state.places[which] += turn * way * direction;
        velocities[which] += brake * way * direction;
    };
    move(particle, out);
    move(parent, middle);
    move(above, back);
    return true;
}

}  // namespace motus::strand
