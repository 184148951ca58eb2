#include "lengths.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

constexpr double standard_gravity = 9.80665;  // m/s^2
constexpr double least_stretch =
    1e-7;  // under the weight of all; links to pins that are out of reach are equally long by that

}  // namespace

Lengths::Lengths(std::span<const Link> links)
    : roots_(roots_of(links)),
      branches_(links.size()),
      rows_(links.size()),
      ways_(links.size()),
      impulses_(links.size()),
      more_(links.size()),
      yieldings_(links.size()),
      stiffnesses_(links.size()),
      is_braced_(links.size()),
      is_along_now_(links.size()),
      is_lost_(links.size()) {
    parents_.reserve(links.size());
    compliances_.reserve(links.size());
    std::vector<int> children(links.size(), 0);
    for (const Link& link : links)
        if (link.parent >= 0) ++children[static_cast<std::size_t>(link.parent)];
    for (const int count : children) {
        meetings_.push_back(count > 1 ? static_cast<int>(matrices_.size()) : -1);
        if (count > 1) matrices_.emplace_back();
    }
    std::vector<double> weights(links.size(), 0.0);  // of whole strands, by their roots
    for (std::size_t i = 0; i < links.size(); ++i) weights[roots_[i]] += links[i].mass;
    for (std::size_t i = 0; i < links.size(); ++i) {
        parents_.push_back(links[i].parent);
        stretches_.push_back(links[i].stretch > 0.0 ? 1 : 0);
        compliances_.push_back(
            std::max(links[i].stretch / links[i].mass, least_stretch / weights[roots_[i]]) /
            standard_gravity);
    }
}

void Lengths::hold(const Stepped& step, std::span<const double> lengths, double duration) {
    constexpr int most = 12;         // one is enough but for links that turn fast
    constexpr int along_before = 4;  // then impulses along the links as they are, which are sure to close in
    constexpr double close = 1e-6;   // of the length
    std::fill(impulses_.begin(), impulses_.end(), 0.0);
    std::fill(is_along_now_.begin(), is_along_now_.end(), 0);
    for (std::size_t i = 0; i < yieldings_.size(); ++i) yieldings_[i] = step.yieldings[i].way;
    for (int round = 0; round < most; ++round) {
        if (round > 0 && !is_off(step, lengths, duration, close)) break;
        if (round == along_before) std::fill(is_along_now_.begin(), is_along_now_.end(), 1);
        gather(step, lengths, duration);
        scatter();
        if (round == 0 && brace(lengths)) {
            gather(step, lengths, duration);
            scatter();
        }
        apply(step);
    }
    lay(step, lengths, duration);
}

/// Lays the links of strands that no impulses bring together along where they point, from the roots to the
/// tips.
void Lengths::lay(const Stepped& step, std::span<const double> lengths, double duration) {
    constexpr double lost = 0.01;  // of the length
    constexpr double lost_between =
        10.0;  // of strands between two places that may be too far from each other
    std::fill(is_lost_.begin(), is_lost_.end(), 0);
    std::vector<char>& is_between = is_braced_;
    std::fill(is_between.begin(), is_between.end(), 0);
    for (std::size_t i = 0; i < parents_.size(); ++i)
        if (parents_[i] >= 0 && !(step.yieldings[i].way > 0.0)) is_between[roots_[i]] = 1;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        const bool is_free = is_between[roots_[i]] == 0;
        // What the least stretch makes of a push without any measure is no length either.
        const double far = is_free && stretches_[i] == 0 ? off(i, step, lengths, 0.0)
                                                         : off(i, step, lengths, 1.0 / duration);
        if (!(far < (is_free ? lost : lost_between))) is_lost_[roots_[i]] = 1;
    }
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (is_lost_[roots_[i]] == 0 || parents_[i] < 0 || !(step.yieldings[i].way > 0.0)) continue;
        const auto parent = static_cast<std::size_t>(parents_[i]);
        const glm::dvec3& root = step.state.places[parent];
        const glm::dvec3 before = direction_or(step.before[i] - step.before[parent], glm::dvec3(0.0));
        const glm::dvec3 along = direction_of(step.state.places[i] - root).value_or(before);
        step.state.places[i] = root + along * lengths[i];
        // As fast as it went or as it is moved here, whichever is slower: neither is to be relied on.
        glm::dvec3& velocity = step.state.velocities[i];
        const glm::dvec3 apart = velocity - step.state.velocities[parent];
        const glm::dvec3 kept = velocity - along * glm::dot(apart, along);
        const glm::dvec3 moved = (step.state.places[i] - step.before[i]) / duration;
        velocity = glm::dot(kept, kept) < glm::dot(moved, moved) ? kept : moved;
    }
}

/// Between taut links a light particle swings across faster than steps resolve: there it counts as heavier,
/// so that it follows its links instead (geometric stiffness, put on the diagonal: Andrews, Teichmann, Kry,
/// "Geometric Stiffness for Real-time Constrained Multibody Dynamics", 2017). Returns whether there is one.
bool Lengths::brace(std::span<const double> lengths) {
    constexpr double resolved = 1.0;  // square of the angle of such a swing within a step
    std::fill(stiffnesses_.begin(), stiffnesses_.end(), 0.0);
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (parents_[i] < 0 || !(more_[i] < 0.0)) continue;
        const double stiffness = -2.0 * more_[i] / lengths[i];
        stiffnesses_[i] += stiffness;
        stiffnesses_[static_cast<std::size_t>(parents_[i])] += stiffness;
    }
    std::fill(is_braced_.begin(), is_braced_.end(), 0);
    bool has = false;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        const double square = yieldings_[i] * stiffnesses_[i];
        if (!(square > resolved)) continue;
        yieldings_[i] /= 1.0 + square;
        is_braced_[i] = 1;
        has = true;
    }
    for (std::size_t i = 0; has && i < parents_.size(); ++i)
        if (parents_[i] >= 0 &&
            (is_braced_[i] != 0 || is_braced_[static_cast<std::size_t>(parents_[i])] != 0))
            is_along_now_[i] = 1;
    return has;
}

bool Lengths::is_off(const Stepped& step, std::span<const double> lengths, double duration,
                     double most) const {
    for (std::size_t i = 0; i < parents_.size(); ++i)
        if (!(off(i, step, lengths, 1.0 / duration) <= most)) return true;
    return false;
}

/// By which part of its length a link is longer or shorter than its impulse, as a force times `frequency`,
/// makes it; 0 if nothing can be done about it.
double Lengths::off(std::size_t i, const Stepped& step, std::span<const double> lengths,
                    double frequency) const {
    if (parents_[i] < 0) return 0.0;
    const auto parent = static_cast<std::size_t>(parents_[i]);
    if (!(step.yieldings[i].way + step.yieldings[parent].way > 0.0)) return 0.0;
    const double length = glm::length(step.state.places[i] - step.state.places[parent]);
    const double yielded = compliances_[i] * lengths[i] * frequency * impulses_[i];
    return std::abs(length + yielded - lengths[i]) / lengths[i];
}

/// The way of a particle by an impulse on it, with all links beyond.
glm::dvec3 Lengths::answer(const Branch& branch, const glm::dvec3& impulse) const {
    if (branch.matrix >= 0) return matrices_[static_cast<std::size_t>(branch.matrix)] * impulse;
    return branch.yielding * (impulse - branch.before * (branch.share * glm::dot(branch.now, impulse)));
}

/// Hangs a link on a particle, with all that is beyond it (Sherman and Morrison's formula).
void Lengths::join(Branch& branch, const Row& row) {
    const glm::dvec3 way = answer(branch, row.before);
    const double divisor = row.divisor + glm::dot(row.now, way);
    if (!(divisor > 0.0)) return;
    branch.way += way * ((row.excess - glm::dot(row.now, branch.way)) / divisor);
    if (branch.matrix < 0) {
        branch.before = row.before;
        branch.now = row.now;
        branch.share = branch.yielding / divisor;
        return;
    }
    glm::dmat3& matrix = matrices_[static_cast<std::size_t>(branch.matrix)];
    matrix -= glm::outerProduct(way / divisor, row.now * matrix);
}

void Lengths::gather(const Stepped& step, std::span<const double> lengths, double duration) {
    for (std::size_t i = 0; i < branches_.size(); ++i) {
        Branch& branch = branches_[i];
        branch.yielding = yieldings_[i];
        branch.share = 0.0;
        branch.way = glm::dvec3(0.0);
        branch.matrix = meetings_[i];
        if (branch.matrix >= 0)
            matrices_[static_cast<std::size_t>(branch.matrix)] = glm::dmat3(yieldings_[i]);
    }
    for (std::size_t i = branches_.size(); i-- > 0;) {
        if (parents_[i] < 0) continue;
        const auto parent = static_cast<std::size_t>(parents_[i]);
        Row& row = rows_[i];
        const glm::dvec3 link = step.state.places[i] - step.state.places[parent];
        const double length = glm::length(link);
        row.before = direction_or(step.before[i] - step.before[parent], glm::dvec3(0.0));
        row.now = length > 0.0 ? link * (1.0 / length) : row.before;
        // A link that turns by more than a third of half a turn within a step is taken as it is at the end.
        if (is_along_now_[i] != 0 || !(glm::dot(row.before, row.now) > 0.5)) row.before = row.now;
        row.answer = answer(branches_[i], row.before);
        row.way = branches_[i].way;
        const double compliance = compliances_[i] * lengths[i] / duration;
        row.divisor = std::max(glm::dot(row.now, row.answer), 0.0) + compliance;
        row.excess = length - lengths[i] + compliance * impulses_[i] + glm::dot(row.now, row.way);
        join(branches_[parent], row);
    }
}

void Lengths::scatter() {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        const Row& row = rows_[i];
        more_[i] = 0.0;
        ways_[i] = branches_[i].way;
        if (parents_[i] < 0 || !(row.divisor > 0.0)) continue;
        more_[i] =
            (glm::dot(row.now, ways_[static_cast<std::size_t>(parents_[i])]) - row.excess) / row.divisor;
        ways_[i] = row.way + row.answer * more_[i];
    }
}

void Lengths::apply(const Stepped& step) {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        impulses_[i] += more_[i];
        if (step.yieldings[i].way > 0.0) step.kick(i, ways_[i]);
    }
}

}  // namespace motus::strand
