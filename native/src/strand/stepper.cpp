#include "stepper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double pin_frequency = 4.0;  // Hz, of a pin at half weight
constexpr double lightest = 1e-3;      // of the heaviest particle of a strand

/// Makes a matrix between two others, number by number, one that turns and scales evenly as they do.
void make_even(const glm::dmat4& first, const glm::dmat4& second, double share, glm::dmat4& between) {
    const double scale1 = glm::length(glm::dvec3(first[0])), scale2 = glm::length(glm::dvec3(second[0]));
    const double scale = scale1 + share * (scale2 - scale1);
    const glm::dvec3 x = direction_or(between[0], glm::dvec3(0.0));
    const glm::dvec3 y =
        direction_or(glm::dvec3(between[1]) - x * glm::dot(x, glm::dvec3(between[1])), glm::dvec3(0.0));
    const glm::dvec3 z = glm::cross(x, y);
    const double side =
        glm::dot(glm::cross(glm::dvec3(first[0]), glm::dvec3(first[1])), glm::dvec3(first[2]));
    constexpr double turned =
        0.5;  // of the scale: of axes that turn by more than some 120 degrees, less is left
    const auto is_short = [&](int axis) { return glm::length(glm::dvec3(between[axis])) < turned * scale; };
    if (is_short(0) || is_short(1) || is_short(2)) {
        between = share < 0.5 ? first : second;
        return;
    }
    between[0] = glm::dvec4(scale * x, 0.0);
    between[1] = glm::dvec4(scale * y, 0.0);
    between[2] = glm::dvec4(scale * (side < 0.0 ? -z : z), 0.0);
}

}  // namespace

Stepper::Stepper(std::span<const Link> links, const Inputs& inputs, const Solving& solving)
    : links_(links.begin(), links.end()),
      roots_(roots_of(links)),
      obstacles_(inputs.obstacles.begin(), inputs.obstacles.end()),
      surfaces_(inputs.surfaces.begin(), inputs.surfaces.end()),
      pinned_(inputs.pinned.begin(), inputs.pinned.end()),
      pins_(links.size(), -1),
      times_(inputs.times),
      poses_(inputs.poses, links.size()),
      sides_(inputs.sides, inputs.sides.empty() ? 0 : links.size()),
      gravity_(inputs.gravity, 1),
      air_(inputs.air, 1),
      obstacle_places_(inputs.obstacle_places, 2 * inputs.obstacles.size()),
      pin_places_(inputs.pin_places, inputs.pinned.size()),
      surface_matrices_(inputs.surface_matrices, inputs.surfaces.size()),
      pin_weights_(inputs.pin_weights, inputs.pinned.size()),
      are_touching_(inputs.are_touching),
      friction_(inputs.friction),
      stiffest_(turn * solving.rate / 8.0) {
    springs_.reserve(links.size());
    for (const Link& link : links) {
        const double rate = turn * link.frequency;
        springs_.push_back({rate * rate, link.response * link.damping * rate,
                            2.0 * link.damping * rate + link.drag, link.drag, link.gravity_factor});
    }
    // A chain between much heavier particles is as good as without mass, but its swings across would take
    // steps that are a thousand times shorter.
    std::vector<double> heaviest(links.size(), 0.0);
    for (std::size_t i = 0; i < links.size(); ++i)
        heaviest[roots_[i]] = std::max(heaviest[roots_[i]], links[i].mass);
    for (std::size_t i = 0; i < links.size(); ++i)
        masses_.push_back(std::max(links[i].mass, lightest * heaviest[roots_[i]]));
    for (std::size_t row = 0; row < pinned_.size(); ++row) pins_[pinned_[row]] = static_cast<int>(row);
}

Stepper::Work::Work(const Stepper& stepper)
    : lengths_(stepper.links_, stepper.masses_),
      straightening_(stepper.links_, stepper.masses_),
      bends_(stepper.links_),
      contacts_(stepper.links_, stepper.obstacles_, stepper.surfaces_),
      touching_(stepper.links_, stepper.poses_.row(0), stepper.are_touching_, stepper.friction_),
      flows_(stepper.size()),
      pin_flows_(stepper.pinned_.size()),
      mobilities_(stepper.size()),
      before_(stepper.size()),
      wanted_lengths_(stepper.size()) {}

std::size_t Stepper::bytes() const noexcept {
    return links_.size() * (sizeof(Link) + sizeof(Spring) + sizeof(double)) + times_.size() * sizeof(double) +
           poses_.bytes() + sides_.bytes() + gravity_.bytes() + air_.bytes() + obstacle_places_.bytes() +
           surface_matrices_.bytes() + pin_places_.bytes() + pin_weights_.bytes();
}

void Stepper::read(double time, std::size_t first, std::size_t last, Driven& out) const {
    const Between place = times_.at(time, first, last);
    out.pose.resize(links_.size());
    out.sides.resize(sides_.width());
    out.obstacles.resize(obstacle_places_.width());
    out.surfaces.resize(surfaces_.size());
    out.pins.resize(pinned_.size());
    out.pin_weights.resize(pinned_.size());
    poses_.at(place, out.pose);
    sides_.at(place, out.sides);
    obstacle_places_.at(place, out.obstacles);
    surface_matrices_.at(place, out.surfaces);
    if (place.share > 0.0 && !surface_matrices_.is_still())
        for (std::size_t k = 0; k < surfaces_.size(); ++k)
            make_even(surface_matrices_.row(place.sample)[k], surface_matrices_.row(place.after)[k],
                      place.share, out.surfaces[k]);
    pin_places_.at(place, out.pins);
    pin_weights_.at(place, out.pin_weights);
    gravity_.at(place, {&out.gravity, 1});
    air_.at(place, {&out.air, 1});
}

/// Where a particle must be: a pinned one with the weight 1 at the pin, a root on the pose, or between.
std::optional<glm::dvec3> Stepper::held_place(std::size_t particle, const Driven& driven) const {
    const glm::dvec3& pose = driven.pose[particle];
    if (pins_[particle] < 0) return links_[particle].parent < 0 ? std::optional(pose) : std::nullopt;
    const auto row = static_cast<std::size_t>(pins_[particle]);
    const double weight = driven.pin_weights[row];
    if (weight >= 1.0) return driven.pins[row];
    if (links_[particle].parent >= 0) return std::nullopt;
    return pose + weight * (driven.pins[row] - pose);
}

void Stepper::start(const Driven& driven, State& state) const {
    state.places = driven.pose;
    for (std::size_t i = 0; i < links_.size(); ++i)
        if (const auto place = held_place(i, driven)) state.places[i] = *place;
    state.velocities.assign(links_.size(), glm::dvec3(0.0));
}

/// The way is the parabola through the three steps. After a push, such as that of a contact, the parabola
/// would go beyond what pushed; there all of a strand goes straight, so that its links stay what they are to
/// each other. Links get the lengths between those that they have at both steps: what turns fast would be
/// shorter.
void Stepper::between(const Near& near, double share, const Driven& driven, std::span<glm::dvec3> out) const {
    constexpr double smooth = 0.1;  // largest part of the way by which it bends
    const auto way = [&](std::size_t i) { return near.after[i] - near.before[i]; };
    const auto bend = [&](std::size_t i) {
        return near.earlier.empty() ? glm::dvec3(0.0) : 0.5 * (way(i) - (near.before[i] - near.earlier[i]));
    };
    std::vector<char> is_pushed(out.size(), 0);  // by roots
    for (std::size_t i = 0; i < out.size(); ++i)
        if (glm::length(bend(i)) > smooth * glm::length(way(i))) is_pushed[roots_[i]] = 1;
    std::vector<glm::dvec3> unchanged(out.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        unchanged[i] = near.before[i] + share * way(i);
        if (is_pushed[roots_[i]] == 0) unchanged[i] -= share * (1.0 - share) * bend(i);
        out[i] = unchanged[i];
        if (const auto held = held_place(i, driven)) {
            out[i] = unchanged[i] = *held;
        } else if (links_[i].parent >= 0) {
            const auto parent = static_cast<std::size_t>(links_[i].parent);
            const double length1 = glm::length(near.before[i] - near.before[parent]);
            const double length2 = glm::length(near.after[i] - near.after[parent]);
            const glm::dvec3 along = direction_or(unchanged[i] - unchanged[parent], glm::dvec3(0.0));
            out[i] = out[parent] + along * (length1 + share * (length2 - length1));
        }
    }
}

std::size_t Stepper::near_pairs() const {
    Work work(*this);
    State state;
    state.places.assign(poses_.row(0).begin(), poses_.row(0).end());
    work.touching_.begin({poses_.row(0), work.mobilities_, state});
    return work.touching_.pairs();
}

void Stepper::step(State& state, const Driven& before, const Driven& now, double duration, Work& work) const {
    flow(state, before, now, duration, work);
    hold(state, before, now, duration, work);
}

/// Moves each particle as if it were alone.
void Stepper::flow(State& state, const Driven& before, const Driven& now, double duration, Work& work) const {
    if (work.duration_ != duration) {
        for (std::size_t i = 0; i < links_.size(); ++i)
            work.flows_[i] = make_flow(springs_[i].pull, springs_[i].resistance, duration);
        for (Work::PinFlow& pin : work.pin_flows_) pin.weight = -1.0;
        work.duration_ = duration;
    }
    std::copy(state.places.begin(), state.places.end(), work.before_.begin());
    const double frequency = 1.0 / duration;
    const glm::dvec3 gravity = 0.5 * (before.gravity + now.gravity), air = 0.5 * (before.air + now.air);
    for (std::size_t i = 0; i < links_.size(); ++i) {
        glm::dvec3& place = state.places[i];
        glm::dvec3& velocity = state.velocities[i];
        if (const auto held = held_place(i, now)) {
            velocity = (*held - place) * frequency;
            place = *held;
            work.mobilities_[i] = {};
            continue;
        }
        const Spring& spring = springs_[i];
        const glm::dvec3 pose_velocity = (now.pose[i] - before.pose[i]) * frequency;
        glm::dvec3 force = spring.pull * (before.pose[i] - place) + spring.lead * pose_velocity +
                           gravity * spring.gravity + spring.drag * air;
        glm::dvec3 ramp = spring.pull * pose_velocity;
        const Flow* by = &work.flows_[i];
        if (pins_[i] >= 0) {
            const auto row = static_cast<std::size_t>(pins_[i]);
            const double weight = now.pin_weights[row];
            Work::PinFlow& pin = work.pin_flows_[row];
            if (pin.weight != weight) {
                const double rate = std::min(turn * pin_frequency * weight / (1.0 - weight), stiffest_);
                pin.weight = weight;
                pin.pull = rate * rate;
                pin.resistance = 2.0 * rate;
                pin.flow = make_flow(spring.pull + pin.pull, spring.resistance + pin.resistance, duration);
            }
            const glm::dvec3 pin_velocity = (now.pins[row] - before.pins[row]) * frequency;
            force += pin.pull * (before.pins[row] - place) + pin.resistance * pin_velocity;
            ramp += pin.pull * pin_velocity;
            by = &pin.flow;
        }
        place += velocity * by->place_of_speed + force * by->place_of_force + ramp * by->place_of_ramp;
        velocity = velocity * by->speed_of_speed + force * by->place_of_speed + ramp * by->place_of_force;
        work.mobilities_[i] = {by->place_of_speed / masses_[i], by->speed_of_speed / by->place_of_speed};
    }
}

/// Resolves contacts, springs between links, lengths and limits of bending, in this order, and contacts once
/// more.
void Stepper::hold(State& state, const Driven& before, const Driven& now, double duration, Work& work) const {
    const Stepped stepped{work.before_, work.mobilities_, state};
    for (std::size_t i = 0; i < links_.size(); ++i) {
        if (links_[i].parent < 0) continue;
        work.wanted_lengths_[i] =
            glm::length(now.pose[i] - now.pose[static_cast<std::size_t>(links_[i].parent)]);
    }
    const auto keep_away = [&] {
        work.contacts_.resolve_obstacles(stepped, before.obstacles, now.obstacles, duration);
        work.contacts_.resolve_surfaces(stepped, before.surfaces, now.surfaces, duration);
        work.touching_.resolve_pairs(stepped, duration);
    };
    work.contacts_.begin();
    work.touching_.begin(stepped);
    keep_away();
    work.straightening_.hold(stepped, now.pose, work.wanted_lengths_, duration);
    work.lengths_.hold(stepped, work.wanted_lengths_, duration);
    work.bends_.hold(stepped, now.pose, now.sides);
    keep_away();
}

}  // namespace motus::strand
