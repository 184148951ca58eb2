#include "bends.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

/// About which a link is turned from where it would be straight; any across it, if it points the other way.
[[nodiscard]] glm::dvec3 axis_of(const glm::dvec3& straight, const glm::dvec3& link) {
    const glm::dvec3 axis = direction_or(glm::cross(straight, link), glm::dvec3(0.0));
    if (axis != glm::dvec3(0.0)) return axis;
    const glm::dvec3 size = glm::abs(link);
    const glm::dvec3 across = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                              : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                                   : glm::dvec3(0.0, 0.0, 1.0);
    return direction_or(glm::cross(link, across), glm::dvec3(1.0, 0.0, 0.0));
}

}  // namespace

Bends::Bends(std::span<const Link> links)
    : turns_(links.size(), bones::no_turn),
      is_moved_(links.size()),
      lengths_(links.size()),
      order_(interleaved(links)) {
    std::size_t limited = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
        parents_.push_back(links[i].parent);
        most_.push_back(links[i].bend);
        most_sideways_.push_back(links[i].side_bend);
        if (links[i].parent >= 0 && std::min(links[i].bend, links[i].side_bend) < std::numbers::pi)
            limited = i + 1;
    }
    for (const std::size_t i : order_)
        if (i < limited) limited_.push_back(i);
}

void Bends::hold(const Stepped& step, std::span<const glm::dvec3> pose, std::span<const glm::dvec3> sides) {
    if (limited_.empty()) return;
    sides_ = sides;
    constexpr int rounds = 2;
    std::fill(is_moved_.begin(), is_moved_.end(), 0);
    for (std::size_t i = 0; i < parents_.size(); ++i)
        if (parents_[i] >= 0)
            lengths_[i] =
                glm::length(step.state.places[i] - step.state.places[static_cast<std::size_t>(parents_[i])]);
    bool has_moved = false;
    for (int round = 0; round < rounds; ++round) {
        bool has_turned = false;
        visit(step, pose, limited_, [&](std::size_t i, const glm::dvec3& straight) {
            has_turned |= straighten(step, i, straight);
        });
        if (!has_turned) break;
        has_moved = true;
    }
    if (has_moved) lay(step, pose);
}

/// Turns what is bent too far still, without the links that it hangs on, and gives links back the lengths
/// that they had.
void Bends::lay(const Stepped& step, std::span<const glm::dvec3> pose) {
    visit(step, pose, order_, [&](std::size_t i, const glm::dvec3& straight) {
        const auto parent = static_cast<std::size_t>(parents_[i]);
        const glm::dvec3 root = step.state.places[parent], link = step.state.places[i] - root;
        const double angle = bones::angle_between(straight, link);
        const glm::dvec3 axis = axis_of(straight, link);
        const double limit = most(i, straight, axis);
        const bool is_beyond = angle > limit;
        if ((!is_beyond && is_moved_[i] == 0 && is_moved_[parent] == 0) ||
            !(step.mobilities[i].displacement > 0.0))
            return;
        const glm::dvec3 along = direction_or(link, direction_or(straight, glm::dvec3(0.0)));
        const double back = is_beyond ? limit - angle : 0.0;
        step.state.places[i] =
            root + lengths_[i] * (std::cos(back) * along + std::sin(back) * glm::cross(axis, along));
        is_moved_[i] = 1;
    });
}

/// Calls visit(particle, straight) of each of these links, from the roots to the tips, `straight` being where
/// the link would point if it followed its parent's.
template <class Visit>
void Bends::visit(const Stepped& step, std::span<const glm::dvec3> pose, std::span<const std::size_t> links,
                  const Visit& visit) {
    for (const std::size_t i : links) {
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

/// How far a link may be turned about an axis across the direction in which it is straight: the radius of an
/// ellipse.
double Bends::most(std::size_t particle, const glm::dvec3& straight, const glm::dvec3& axis) const {
    const double most = most_[particle], sideways = most_sideways_[particle];
    if (sides_.empty() || !(sideways < most)) return most;
    const auto parent = static_cast<std::size_t>(parents_[particle]);
    const glm::dvec3 along = direction_or(straight, glm::dvec3(0.0));
    const glm::dvec3 side = turns_[parent] * sides_[particle];
    const glm::dvec3 across = direction_or(side - along * glm::dot(side, along), glm::dvec3(0.0));
    if (across == glm::dvec3(0.0)) return most;
    // What is turned about its side does not go towards it.
    const double about = glm::dot(axis, across), towards = glm::dot(axis, glm::cross(along, across));
    const double size = std::sqrt(about * about * sideways * sideways + towards * towards * most * most);
    return size > 0.0 ? most * sideways / size : sideways;
}

/// Returns whether it was bent too far.
bool Bends::straighten(const Stepped& step, std::size_t particle, const glm::dvec3& straight) {
    const auto parent = static_cast<std::size_t>(parents_[particle]);
    const auto& places = step.state.places;
    auto& velocities = step.state.velocities;
    const glm::dvec3 link = places[particle] - places[parent];
    const double length = glm::length(link);
    const double angle = bones::angle_between(straight, link);
    if (!(angle > std::min(most_[particle], most_sideways_[particle])) || !(length > 0.0)) return false;
    const glm::dvec3 along = link / length;
    const glm::dvec3 axis = axis_of(straight, link);
    const double limit = most(particle, straight, axis);
    if (!(angle > limit)) return false;
    // How the angle grows with each place: of the link's ends, and of the parent's link, along which it is
    // straight.
    const glm::dvec3 out = glm::cross(axis, along) / length;
    glm::dvec3 middle = -out, back(0.0);
    double mobility = step.mobilities[particle].displacement * glm::dot(out, out);
    std::size_t above = parent;
    if (parents_[parent] >= 0) {
        above = static_cast<std::size_t>(parents_[parent]);
        const glm::dvec3 arm = places[parent] - places[above];
        const double square = glm::dot(arm, arm);
        if (square > 0.0) {
            back = glm::cross(axis, arm) / square;
            middle -= back;
            mobility += step.mobilities[above].displacement * glm::dot(back, back);
        }
    }
    mobility += step.mobilities[parent].displacement * glm::dot(middle, middle);
    if (!(mobility > 0.0)) return false;
    const double speed = glm::dot(out, velocities[particle]) + glm::dot(middle, velocities[parent]) +
                         glm::dot(back, velocities[above]);
    const double turn = (limit - angle) / mobility;
    const double brake = std::min(-speed, 0.0) / mobility;
    const auto move = [&](std::size_t which, const glm::dvec3& direction) {
        const double way = step.mobilities[which].displacement;
        step.state.places[which] += turn * way * direction;
        velocities[which] += brake * way * direction;
        if (way > 0.0) is_moved_[which] = 1;
    };
    move(particle, out);
    move(parent, middle);
    move(above, back);
    return true;
}

}  // namespace motus::strand
