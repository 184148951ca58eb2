#include "touching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

/// A link between two of its ends' places.
struct Segment {
    glm::dvec3 start{0.0}, way{0.0};
    [[nodiscard]] glm::dvec3 at(double share) const { return start + share * way; }
};

[[nodiscard]] Segment segment(std::span<const glm::dvec3> places, std::size_t parent, std::size_t particle) {
    return {places[parent], places[particle] - places[parent]};
}

}  // namespace

Touching::Touching(std::span<const Link> links, std::span<const glm::dvec3> pose, bool is_on, double friction)
    : friction_(friction) {
    if (is_on) pose_.assign(pose.begin(), pose.end());
    for (std::size_t i = 0; is_on && i < links.size(); ++i)
        if (links[i].parent >= 0 && links[i].thickness > 0.0)
            bodies_.push_back({static_cast<std::size_t>(links[i].parent), i, links[i].thickness});
}

/// Links that hang on each other, or on the same particle, touch always.
bool Touching::are_joined(const Body& first, const Body& second) {
    return first.parent == second.parent || first.parent == second.particle ||
           first.particle == second.parent;
}

/// Boxes are sorted along the axis on which they are spread farthest, and each is compared with those that
/// begin before it ends (sweep and prune: Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies",
/// 1992).
void Touching::begin(const Stepped& step) {
    pairs_.clear();
    if (bodies_.size() < 2) return;
    constexpr int most_pairs = 64;  // of a link: where all are within all others, no more would help
    constexpr double roomy = 2.0;   // of the thickness: what holds lengths moves links once more
    boxes_.clear();
    counts_.assign(bodies_.size(), 0);
    glm::dvec3 lowest(std::numeric_limits<double>::infinity()), highest = -lowest;
    for (std::size_t body = 0; body < bodies_.size(); ++body) {
        const auto [parent, particle, thickness] = bodies_[body];
        const auto& now = step.state.places;
        const glm::dvec3 room(roomy * thickness);
        const glm::dvec3 low = glm::min(glm::min(now[parent], now[particle]),
                                        glm::min(step.before[parent], step.before[particle])) -
                               room;
        const glm::dvec3 high = glm::max(glm::max(now[parent], now[particle]),
                                         glm::max(step.before[parent], step.before[particle])) +
                                room;
        boxes_.push_back({low, high, body});
        lowest = glm::min(lowest, low);
        highest = glm::max(highest, low);
    }
    const glm::dvec3 spread = highest - lowest;
    const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
    std::ranges::sort(boxes_, {}, [axis](const Box& box) { return std::tuple(box.low[axis], box.body); });
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes_.size() && boxes_[j].low[axis] <= boxes_[i].high[axis]; ++j) {
            const auto overlap = [&](int other) {
                return boxes_[i].low[other] <= boxes_[j].high[other] &&
                       boxes_[j].low[other] <= boxes_[i].high[other];
            };
            if (!overlap((axis + 1) % 3) || !overlap((axis + 2) % 3)) continue;
            const std::size_t first = std::min(boxes_[i].body, boxes_[j].body);
            const std::size_t second = std::max(boxes_[i].body, boxes_[j].body);
            const Body &body1 = bodies_[first], &body2 = bodies_[second];
            if (are_joined(body1, body2) || counts_[first] == most_pairs || counts_[second] == most_pairs)
                continue;
            ++counts_[first];
            ++counts_[second];
            // Where the first pose has them nearer, they may be as near.
            const Segment pose1 = segment(pose_, body1.parent, body1.particle);
            const Segment pose2 = segment(pose_, body2.parent, body2.particle);
            const Shares shares = nearest(pose1.start, pose1.way, pose2.start, pose2.way);
            const double apart = glm::length(pose1.at(shares.first) - pose2.at(shares.second));
            pairs_.push_back({first, second, std::min(body1.thickness + body2.thickness, apart), {}});
        }
    }
}

void Touching::resolve_pairs(const Stepped& step, double duration) {
    for (Pair& pair : pairs_) {
        const Body &body1 = bodies_[pair.first], &body2 = bodies_[pair.second];
        const Segment link1 = segment(step.state.places, body1.parent, body1.particle);
        const Segment link2 = segment(step.state.places, body2.parent, body2.particle);
        const Shares shares = nearest(link1.start, link1.way, link2.start, link2.way);
        const glm::dvec3 apart = link1.at(shares.first) - link2.at(shares.second);
        const glm::dvec3 apart_before = segment(step.before, body1.parent, body1.particle).at(shares.first) -
                                        segment(step.before, body2.parent, body2.particle).at(shares.second);
        // Links that have gone through each other in this step go back to the side that they came from.
        const bool is_through = glm::dot(apart, apart_before) < 0.0;
        const double distance = is_through ? -glm::length(apart) : glm::length(apart);
        const double depth = pair.reach - distance;
        if (!(depth > -pair.friction.pushed)) continue;
        // Near ends that are held on both sides no turn brings them apart.
        constexpr double near_end = 0.1;
        const auto is_stuck = [&](const Body& body, double share) {
            const auto is_held = [&](std::size_t particle) {
                return !(step.mobilities[particle].displacement > 0.0);
            };
            return (share < near_end && is_held(body.parent)) ||
                   (share > 1.0 - near_end && is_held(body.particle));
        };
        if (is_stuck(body1, shares.first) && is_stuck(body2, shares.second)) continue;
        const glm::dvec3 across = direction_or(glm::cross(link1.way, link2.way), glm::dvec3(0.0, 0.0, 1.0));
        const glm::dvec3 away = direction_or(is_through ? -apart : apart, direction_or(apart_before, across));
        resolve({{{{body1.parent, 1.0 - shares.first},
                   {body1.particle, shares.first},
                   {body2.parent, shares.second - 1.0},
                   {body2.particle, -shares.second}}},
                 4,
                 away,
                 depth,
                 glm::dvec3(0.0)},
                friction_, duration, step, pair.friction);
    }
}

}  // namespace motus::strand
