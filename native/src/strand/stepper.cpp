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
      gravity_(inputs.gravity, 1),
      air_(inputs.air, 1),
      obstacle_places_(inputs.obstacle_places, 2 * inputs.obstacles.size()),
      pin_places_(inputs.pin_places, inputs.pinned.size()),
      surface_matrices_(inputs.surface_matrices, inputs.surfaces.size()),
      pin_weights_(inputs.pin_weights, inputs.pinned.size()),
      stiffest_(turn * solving.rate / 8.0) {
    springs_.reserve(links.size());
    for (const Link& link : links) {
        const double rate = turn * link.frequency;
        springs_.push_back({rate * rate, link.response * link.damping * rate,
                            2.0 * link.damping * rate + link.drag, link.drag, link.mass});
    }
    // A chain between much heavier particles is as good as without mass, but its swings across would take
    // steps that are a thousand times shorter.
    std::vector<double> heaviest(links.size(), 0.0);
    for (std::size_t i = 0; i < links.size(); ++i)
        heaviest[roots_[i]] = std::max(heaviest[roots_[i]], links[i].mass);
    for (std::size_t i = 0; i < links.size(); ++i)
        springs_[i].mass = std::max(links[i].mass, lightest * heaviest[roots_[i]]);
    for (std::size_t row = 0; row < pinned_.size(); ++row) pins_[pinned_[row]] = static_cast<int>(row);
}

Stepper::Work::Work(const Stepper& stepper)
    : lengths_(stepper.links_),
      bends_(stepper.links_),
      contacts_(stepper.links_, stepper.obstacles_, stepper.surfaces_),
      flows_(stepper.size()),
      pin_flows_(stepper.pinned_.size()),
      yieldings_(stepper.size()),
      before_(stepper.size()),
      wanted_lengths_(stepper.size()) {}

std::size_t Stepper::bytes() const noexcept {
    return links_.size() * (sizeof(Link) + sizeof(Spring)) + times_.size() * sizeof(double) + poses_.bytes() +
           gravity_.bytes() + air_.bytes() + obstacle_places_.bytes() + surface_matrices_.bytes() +
           pin_places_.bytes() + pin_weights_.bytes();
}

void Stepper::read(double time, std::size_t first, std::size_t last, Driven& out) const {
    const Between place = times_.at(time, first, last);
    out.pose.resize(links_.size());
    out.obstacles.resize(obstacle_places_.width());
    out.surfaces.resize(surfaces_.size());
    out.pins.resize(pinned_.size());
    out.pin_weights.resize(pinned_.size());
    poses_.at(place, out.pose);
    obstacle_places_.at(place, out.obstacles);
    surface_matrices_.at(place, out.surfaces);
    pin_places_.at(place, out.pins);
    pin_weights_.at(place, out.pin_weights);
    gravity_.at(place, {&out.gravity, 1});
    air_.at(place, {&out.air, 1});
}

void Stepper::start(const Driven& driven, State& state) const {
    state.places = driven.pose;
    state.velocities.assign(links_.size(), glm::dvec3(0.0));
}

/// The way is the parabola through the three steps. After a push, such as that of a contact, the parabola
/// would go beyond what pushed; there all of a strand goes straight, so that its links stay what they are to
/// each other. Links get the lengths between those that they have at both steps: what turns fast would be
/// shorter.
void Stepper::between(std::span<const glm::dvec3> earlier, std::span<const glm::dvec3> before,
                      std::span<const glm::dvec3> after, double share, std::span<glm::dvec3> out) const {
    constexpr double smooth = 0.1;  // largest part of the way by which it bends
    const bool is_first = earlier.data() == before.data();
    const auto way = [&](std::size_t i) { return after[i] - before[i]; };
    const auto bend = [&](std::size_t i) {
        return is_first ? glm::dvec3(0.0) : 0.5 * (way(i) - (before[i] - earlier[i]));
    };
    std::vector<char> is_pushed(out.size(), 0);  // by roots
    for (std::size_t i = 0; i < out.size(); ++i)
        if (glm::length(bend(i)) > smooth * glm::length(way(i))) is_pushed[roots_[i]] = 1;
    std::vector<glm::dvec3> unchanged(out.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        unchanged[i] = before[i] + share * way(i);
        if (is_pushed[roots_[i]] == 0) unchanged[i] -= share * (1.0 - share) * bend(i);
        out[i] = unchanged[i];
        if (links_[i].parent < 0) continue;
        const auto parent = static_cast<std::size_t>(links_[i].parent);
        const double length1 = glm::length(before[i] - before[parent]);
        const double length2 = glm::length(after[i] - after[parent]);
        const glm::dvec3 along = direction_or(unchanged[i] - unchanged[parent], glm::dvec3(0.0));
        out[i] = out[parent] + along * (length1 + share * (length2 - length1));
    }
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
        const auto go = [&](const glm::dvec3& where) {
            velocity = (where - place) * frequency;
            place = where;
            work.yieldings_[i] = {};
        };
        const Spring& spring = springs_[i];
        const glm::dvec3 pose_velocity = (now.pose[i] - before.pose[i]) * frequency;
        glm::dvec3 force = spring.pull * (before.pose[i] - place) + spring.lead * pose_velocity + gravity +
                           spring.drag * air;
        glm::dvec3 ramp = spring.pull * pose_velocity;
        const Flow* by = &work.flows_[i];
        if (pins_[i] >= 0) {
            const auto row = static_cast<std::size_t>(pins_[i]);
            const double weight = now.pin_weights[row];
            if (weight >= 1.0) {
                go(now.pins[row]);
                continue;
            }
            Work::PinFlow& pin = work.pin_flows_[row];
            if (pin.weight != weight) {
                const double rate = std::min(turn * pin_frequency * weight / (1.0 - weight), stiffest_);
                pin.weight = weight;
                pin.pull = rate * rate;
                pin.resistance = 2.0 * rate;
                // Both springs together are as stiff as a step resolves, at most.
                pin.flow = make_flow(std::min(spring.pull + pin.pull, 2.0 * stiffest_ * stiffest_),
                                     spring.resistance + pin.resistance, duration);
            }
            const glm::dvec3 pin_velocity = (now.pins[row] - before.pins[row]) * frequency;
            force += pin.pull * (before.pins[row] - place) + pin.resistance * pin_velocity;
            ramp += pin.pull * pin_velocity;
            by = &pin.flow;
        } else if (links_[i].parent < 0) {
            go(now.pose[i]);
            continue;
        }
        place += velocity * by->place_of_speed + force * by->place_of_force + ramp * by->place_of_ramp;
        velocity = velocity * by->speed_of_speed + force * by->place_of_speed + ramp * by->place_of_force;
        work.yieldings_[i] = {by->place_of_speed / spring.mass, by->speed_of_speed / by->place_of_speed};
    }
}

/// Puts what has moved apart together again.
void Stepper::hold(State& state, const Driven& before, const Driven& now, double duration, Work& work) const {
    const Stepped stepped{work.before_, work.yieldings_, state};
    for (std::size_t i = 0; i < links_.size(); ++i) {
        if (links_[i].parent < 0) continue;
        work.wanted_lengths_[i] =
            glm::length(now.pose[i] - now.pose[static_cast<std::size_t>(links_[i].parent)]);
    }
    const auto keep_away = [&] {
        work.contacts_.keep_out(stepped, before.obstacles, now.obstacles, duration);
        work.contacts_.keep_apart(stepped, before.surfaces, now.surfaces, duration);
    };
    work.contacts_.begin();
    keep_away();
    work.lengths_.hold(stepped, work.wanted_lengths_, duration);
    work.bends_.hold(stepped, now.pose, work.wanted_lengths_, duration);
    keep_away();
}

}  // namespace motus::strand
