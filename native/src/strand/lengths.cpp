#include "lengths.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

constexpr double standard_gravity = 9.80665;  // m/s^2
constexpr double least_stretch = 1e-7;        // under the weight of all; links to pins that are out of reach are equally long by that

}  // namespace

Lengths::Lengths(std::span<const Link> links)
    : branches_(links.size()), rows_(links.size()), ways_(links.size()), impulses_(links.size()), more_(links.size()), yieldings_(links.size()), stiffnesses_(links.size()), is_braced_(links.size()), is_along_now_(links.size()) {
    parents_.reserve(links.size());
    compliances_.reserve(links.size());
    const std::vector<std::size_t> roots = roots_of(links);
    std::vector<double> weights(links.size(), 0.0);  // of whole strands, by their roots
    for (std::size_t i = 0; i < links.size(); ++i) weights[roots[i]] += links[i].mass;
    for (std::size_t i = 0; i < links.size(); ++i) {
        parents_.push_back(links[i].parent);
        compliances_.push_back(std::max(links[i].stretch / links[i].mass, least_stretch / weights[roots[i]]) / standard_gravity);
    }
}

void Lengths::hold(const Stepped& step, std::span<const double> lengths, double duration) {
    constexpr int most = 12;         // one is enough but for links that turn fast
    constexpr int along_before = 4;  // then impulses along the links as they are, which are sure to close in
    constexpr double close = 1e-6;   // of the length
    constexpr double lost = 0.5;
    std::fill(impulses_.begin(), impulses_.end(), 0.0);
    std::fill(is_along_now_.begin(), is_along_now_.end(), 0);
    for (std::size_t i = 0; i < yieldings_.size(); ++i) yieldings_[i] = step.yieldings[i].way;
    for (int round = 0; round < most; ++round) {
        if (round > 0 && !(farthest_off(step, lengths, duration) > close)) return;
        if (round == along_before) std::fill(is_along_now_.begin(), is_along_now_.end(), 1);
        gather(step, lengths, duration);
        scatter();
        if (round == 0 && brace(lengths)) {
            gather(step, lengths, duration);
            scatter();
        }
        apply(step);
    }
    if (!(farthest_off(step, lengths, duration) < lost)) lay(step, lengths, duration);
}

/// Lays links that no impulses bring together along where they point, from the roots to the tips.
void Lengths::lay(const Stepped& step, std::span<const double> lengths, double duration) const {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (parents_[i] < 0 || !(step.yieldings[i].way > 0.0)) continue;
        const auto parent = static_cast<std::size_t>(parents_[i]);
        const glm::dvec3& root = step.state.places[parent];
        const glm::dvec3 before = step.before[i] - step.before[parent];
        const glm::dvec3 now = step.state.places[i] - root;
        const glm::dvec3 along = is_finite(now) ? direction_of(now).value_or(direction_or(before, glm::dvec3(0.0))) : direction_or(before, glm::dvec3(0.0));
        step.state.places[i] = root + along * lengths[i];
        step.state.velocities[i] = (step.state.places[i] - step.before[i]) / duration;
    }
}

/// Between taut links a light particle swings across faster than steps resolve: there it counts as heavier, so
/// that it follows its links instead (geometric stiffness, put on the diagonal: Andrews, Teichmann, Kry,
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
        if (parents_[i] >= 0 && (is_braced_[i] != 0 || is_braced_[static_cast<std::size_t>(parents_[i])] != 0)) is_along_now_[i] = 1;
    return has;
}

/// The largest part of its length by which a link is too long or too short.
double Lengths::farthest_off(const Stepped& step, std::span<const double> lengths, double duration) const {
    double farthest = 0.0;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (parents_[i] < 0) continue;
        const auto parent = static_cast<std::size_t>(parents_[i]);
        if (!(step.yieldings[i].way + step.yieldings[parent].way > 0.0)) continue;
        const double length = glm::length(step.state.places[i] - step.state.places[parent]);
        const double yielded = compliances_[i] * lengths[i] / duration * impulses_[i];
        farthest = std::max(farthest, std::abs(length + yielded - lengths[i]) / lengths[i]);
    }
    return farthest;
}

void Lengths::gather(const Stepped& step, std::span<const double> lengths, double duration) {
    for (std::size_t i = 0; i < branches_.size(); ++i)
        branches_[i] = {glm::dmat3(yieldings_[i]), glm::dvec3(0.0)};
    for (std::size_t i = branches_.size(); i-- > 0;) {
        if (parents_[i] < 0) continue;
        const auto parent = static_cast<std::size_t>(parents_[i]);
        Row& row = rows_[i];
        const glm::dvec3 now = step.state.places[i] - step.state.places[parent];
        row.before = direction_or(step.before[i] - step.before[parent], glm::dvec3(0.0));
        row.now = direction_or(now, row.before);
        // A link that turns by more than a third of half a turn within a step is taken as it is at the end.
        if (is_along_now_[i] != 0 || !(glm::dot(row.before, row.now) > 0.5)) row.before = row.now;
        Branch& branch = branches_[i];
        row.answer = branch.answer * row.before;
        row.way = branch.way;
        const double compliance = compliances_[i] * lengths[i] / duration;
        row.divisor = std::max(glm::dot(row.now, row.answer), 0.0) + compliance;
        row.excess = glm::length(now) - lengths[i] + compliance * impulses_[i] + glm::dot(row.now, row.way);

        Branch& above = branches_[parent];
        const glm::dvec3 answer = above.answer * row.before;
        const double divisor = row.divisor + glm::dot(row.now, answer);
        if (!(divisor > 0.0)) continue;
        above.way += answer * ((row.excess - glm::dot(row.now, above.way)) / divisor);
        above.answer -= glm::outerProduct(answer / divisor, row.now * above.answer);
    }
}

void Lengths::scatter() {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        const Row& row = rows_[i];
        more_[i] = 0.0;
        ways_[i] = branches_[i].way;
        if (parents_[i] < 0 || !(row.divisor > 0.0)) continue;
        more_[i] = (glm::dot(row.now, ways_[static_cast<std::size_t>(parents_[i])]) - row.excess) / row.divisor;
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
