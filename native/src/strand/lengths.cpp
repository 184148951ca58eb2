#include "lengths.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

constexpr double standard_gravity = 9.80665;  // m/s^2
/// Strain of a rigid link under the weight of its whole strand. Above 0, so that a pin out of reach stretches
/// all links alike.
constexpr double least_stretch = 1e-7;
constexpr double lost = 0.01;          // of a length that is wrong by more whatever is done
constexpr double least_length = 1e-9;  // m, by which errors of links without a length are measured

}  // namespace

Lengths::Lengths(std::span<const Link> links, std::span<const double> masses)
    : order_(interleaved(links)),
      roots_(roots_of(links)),
      branches_(links.size()),
      rows_(links.size()),
      displacements_(links.size()),
      impulses_(links.size()),
      corrections_(links.size()),
      mobilities_(links.size()),
      stiffnesses_(links.size()),
      is_stiff_(links.size()),
      is_along_now_(links.size()),
      is_open_(links.size()),
      is_between_(links.size()),
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
    links_at_most_ = 1.0 + (children.empty() ? 0 : *std::ranges::max_element(children));
    std::vector<double> weights(links.size(), 0.0);  // of whole strands, by their roots
    for (std::size_t i = 0; i < links.size(); ++i) weights[roots_[i]] += masses[i];
    for (std::size_t i = 0; i < links.size(); ++i) {
        parents_.push_back(links[i].parent);
        is_rigid_.push_back(links[i].stretch > 0.0 ? 0 : 1);
        compliances_.push_back(std::max(links[i].stretch / masses[i], least_stretch / weights[roots_[i]]) /
                               standard_gravity);
    }
}

void Lengths::hold(const Stepped& step, std::span<const double> lengths, double duration) {
    constexpr int most = 12;  // one is enough but for links that turn fast
    // Rounds along the links' former directions (SHAKE); later rounds use the present directions, which
    // converge after large turns.
    constexpr int along_before = 4;
    constexpr double close = 1e-6;  // of the length
    std::fill(impulses_.begin(), impulses_.end(), 0.0);
    std::fill(is_along_now_.begin(), is_along_now_.end(), 0);
    std::fill(is_open_.begin(), is_open_.end(), 1);
    for (std::size_t i = 0; i < mobilities_.size(); ++i) mobilities_[i] = step.mobilities[i].displacement;
    bool is_open = true;
    for (int round = 0; round < most; ++round) {
        if (round > 0) is_open = find_open(step, lengths, duration, close);
        if (!is_open) break;
        if (round == along_before) std::fill(is_along_now_.begin(), is_along_now_.end(), 1);
        eliminate(step, lengths, duration);
        substitute();
        if (round == 0 && add_geometric_stiffness(lengths)) {
            eliminate(step, lengths, duration);
            substitute();
        }
        apply(step);
    }
    if (is_open || is_far_off_) project_lost(step, lengths, duration);
}

/// Finds strands whose lengths are wrong by more than `most` of them: of the others nothing changes any more.
bool Lengths::find_open(const Stepped& step, std::span<const double> lengths, double duration, double most) {
    std::fill(is_open_.begin(), is_open_.end(), 0);
    bool has = false;
    is_far_off_ = false;
    const double frequency = 1.0 / duration;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        const Error error = length_error(i, step, lengths, frequency);
        const double unit = std::max(lengths[i], least_length);
        is_far_off_ = is_far_off_ || !(std::abs(error.whole) <= lost * unit);
        if (std::abs(error.unexplained) <= most * unit) continue;
        is_open_[roots_[i]] = 1;
        has = true;
    }
    return has;
}

/// Lays the links of strands that no impulses bring together along where they point, from the roots to the
/// tips.
void Lengths::project_lost(const Stepped& step, std::span<const double> lengths, double duration) {
    constexpr double lost_between =
        10.0;  // of strands between two places that may be too far from each other
    std::fill(is_lost_.begin(), is_lost_.end(), 0);
    std::fill(is_between_.begin(), is_between_.end(), 0);
    for (std::size_t i = 0; i < parents_.size(); ++i)
        if (parents_[i] >= 0 && !(step.mobilities[i].displacement > 0.0)) is_between_[roots_[i]] = 1;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        const bool is_free = is_between_[roots_[i]] == 0;
        // A rigid link must have its length itself: under a large compression even the least compliance would
        // excuse a wrong one.
        const Error error = length_error(i, step, lengths, 1.0 / duration);
        const double counted = is_free && is_rigid_[i] != 0 ? error.whole : error.unexplained;
        const double most = (is_free ? lost : lost_between) * std::max(lengths[i], least_length);
        if (!(std::abs(counted) < most)) is_lost_[roots_[i]] = 1;
    }
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (is_lost_[roots_[i]] == 0 || parents_[i] < 0 || !(step.mobilities[i].displacement > 0.0)) continue;
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
bool Lengths::add_geometric_stiffness(std::span<const double> lengths) {
    constexpr double resolved = 1.0;  // square of the angle of such a swing within a step
    // If no link does its part of that, no particle has it together.
    bool has_taut = false;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (parents_[i] < 0) continue;
        const double mobility = std::max(mobilities_[i], mobilities_[static_cast<std::size_t>(parents_[i])]);
        has_taut = has_taut || -2.0 * links_at_most_ * corrections_[i] * mobility > resolved * lengths[i];
    }
    if (!has_taut) return false;
    std::fill(stiffnesses_.begin(), stiffnesses_.end(), 0.0);
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (parents_[i] < 0 || !(corrections_[i] < 0.0)) continue;
        const double stiffness = -2.0 * corrections_[i] / std::max(lengths[i], least_length);
        stiffnesses_[i] += stiffness;
        stiffnesses_[static_cast<std::size_t>(parents_[i])] += stiffness;
    }
    std::fill(is_stiff_.begin(), is_stiff_.end(), 0);
    bool has = false;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        const double square = mobilities_[i] * stiffnesses_[i];
        if (!(square > resolved)) continue;
        mobilities_[i] /= 1.0 + square;
        is_stiff_[i] = 1;
        has = true;
    }
    for (std::size_t i = 0; has && i < parents_.size(); ++i)
        if (parents_[i] >= 0 && (is_stiff_[i] != 0 || is_stiff_[static_cast<std::size_t>(parents_[i])] != 0))
            is_along_now_[i] = 1;
    return has;
}

/// frequency: 1 / duration of the step, 1/s.
Lengths::Error Lengths::length_error(std::size_t i, const Stepped& step, std::span<const double> lengths,
                                     double frequency) const {
    if (parents_[i] < 0) return {};
    const auto parent = static_cast<std::size_t>(parents_[i]);
    if (!(step.mobilities[i].displacement + step.mobilities[parent].displacement > 0.0)) return {};
    const double whole = glm::length(step.state.places[i] - step.state.places[parent]) - lengths[i];
    return {whole, whole + compliances_[i] * lengths[i] * frequency * impulses_[i]};
}

/// The displacement of a particle by an impulse on it, with all links beyond.
glm::dvec3 Lengths::answer(const Branch& branch, const glm::dvec3& impulse) const {
    if (branch.matrix >= 0) return matrices_[static_cast<std::size_t>(branch.matrix)] * impulse;
    return branch.mobility * (impulse - branch.before * (branch.share * glm::dot(branch.now, impulse)));
}

/// Hangs a link on a particle, with all that is beyond it (Sherman and Morrison's formula).
void Lengths::join(Branch& branch, const Row& row) {
    const glm::dvec3 way = answer(branch, row.before);
    const double divisor = row.divisor + glm::dot(row.now, way);
    if (!(divisor > 0.0)) return;
    branch.displacement += way * ((row.excess - glm::dot(row.now, branch.displacement)) / divisor);
    if (branch.matrix < 0) {
        branch.before = row.before;
        branch.now = row.now;
        branch.share = branch.mobility / divisor;
        return;
    }
    glm::dmat3& matrix = matrices_[static_cast<std::size_t>(branch.matrix)];
    matrix -= glm::outerProduct(way / divisor, row.now * matrix);
}

void Lengths::eliminate(const Stepped& step, std::span<const double> lengths, double duration) {
    for (std::size_t i = 0; i < branches_.size(); ++i) {
        if (is_open_[roots_[i]] == 0) continue;
        Branch& branch = branches_[i];
        branch.mobility = mobilities_[i];
        branch.share = 0.0;
        branch.displacement = glm::dvec3(0.0);
        branch.matrix = meetings_[i];
        if (branch.matrix >= 0)
            matrices_[static_cast<std::size_t>(branch.matrix)] = glm::dmat3(mobilities_[i]);
    }
    for (std::size_t k = order_.size(); k-- > 0;) {
        const std::size_t i = order_[k];
        if (parents_[i] < 0 || is_open_[roots_[i]] == 0) continue;
        const auto parent = static_cast<std::size_t>(parents_[i]);
        Row& row = rows_[i];
        const glm::dvec3 link = step.state.places[i] - step.state.places[parent];
        const double length = glm::length(link);
        row.before = direction_or(step.before[i] - step.before[parent], glm::dvec3(0.0));
        row.now = length > 0.0 ? link * (1.0 / length) : row.before;
        // A link that turns by more than a third of half a turn within a step is taken as it is at the end.
        if (is_along_now_[i] != 0 || !(glm::dot(row.before, row.now) > 0.5)) row.before = row.now;
        row.answer = answer(branches_[i], row.before);
        row.displacement = branches_[i].displacement;
        const double compliance = compliances_[i] * lengths[i] / duration;
        row.divisor = std::max(glm::dot(row.now, row.answer), 0.0) + compliance;
        row.excess = length - lengths[i] + compliance * impulses_[i] + glm::dot(row.now, row.displacement);
        join(branches_[parent], row);
    }
}

void Lengths::substitute() {
    for (const std::size_t i : order_) {
        if (is_open_[roots_[i]] == 0) continue;
        const Row& row = rows_[i];
        corrections_[i] = 0.0;
        displacements_[i] = branches_[i].displacement;
        if (parents_[i] < 0 || !(row.divisor > 0.0)) continue;
        corrections_[i] =
            (glm::dot(row.now, displacements_[static_cast<std::size_t>(parents_[i])]) - row.excess) /
            row.divisor;
        displacements_[i] = row.displacement + row.answer * corrections_[i];
    }
}

void Lengths::apply(const Stepped& step) {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (is_open_[roots_[i]] == 0) continue;
        impulses_[i] += corrections_[i];
        if (step.mobilities[i].displacement > 0.0) step.kick(i, displacements_[i]);
    }
}

}  // namespace motus::strand
