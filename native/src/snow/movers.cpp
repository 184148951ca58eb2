#include "movers.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <utility>

#include "motus/core/numeric.hpp"

namespace motus::snow {

Movers::Movers(std::vector<Mover> movers) : movers_(std::move(movers)) {
    for (const Mover& mover : movers_) {
        require(mover.collider != nullptr, "movers: must have colliders");
        require(!mover.times.empty() && mover.matrices.size() == mover.times.size(),
                "movers: must have a matrix for each time, and at least one");
        require(are_finite(mover.times), "movers: must have finite times");
        require(std::ranges::adjacent_find(mover.times, std::ranges::greater_equal{}) == mover.times.end(),
                "movers: must have rising times");
        for (const glm::dmat4& matrix : mover.matrices)
            require(is_finite(matrix), "movers: must have finite matrices");
    }
}

Movers::Part Movers::part_at(std::size_t mover, double time) const {
    const std::vector<double>& times = movers_[mover].times;
    const auto next = std::ranges::upper_bound(times, time);
    if (next == times.begin()) return {};
    const auto sample = static_cast<std::size_t>(next - times.begin()) - 1;
    if (next == times.end()) return {sample, 0.0, 0.0};
    const double length = *next - times[sample];
    return {sample, (time - times[sample]) / length, length};
}

glm::dmat4 Movers::matrix(std::size_t mover, double time) const {
    const Part part = part_at(mover, time);
    const std::vector<glm::dmat4>& all = movers_[mover].matrices;
    const glm::dmat4& from = all[part.sample];
    return part.length > 0.0 ? from + part.share * (all[part.sample + 1] - from) : from;
}

glm::dmat4 Movers::rate(std::size_t mover, double time) const {
    const Part part = part_at(mover, time);
    const std::vector<glm::dmat4>& all = movers_[mover].matrices;
    return part.length > 0.0 ? (all[part.sample + 1] - all[part.sample]) / part.length : glm::dmat4(0.0);
}

glm::dquat Movers::rotation(std::size_t mover, double time) const {
    const glm::dmat4 all = matrix(mover, time);
    glm::dmat3 axes(1.0);
    for (int axis = 0; axis < 3; ++axis) axes[axis] = direction_or(glm::dvec3(all[axis]), axes[axis]);
    return glm::normalize(glm::quat_cast(axes));
}

void Movers::Spaces::set(const Movers& movers, double time) {
    inverses_.resize(movers.movers_.size());
    for (std::size_t i = 0; i < inverses_.size(); ++i) inverses_[i] = glm::inverse(movers.matrix(i, time));
}

std::optional<Movers::Hit> Movers::first_hit(const glm::dvec3& start, const Spaces& at_start,
                                             const glm::dvec3& end, const Spaces& at_end) const {
    std::optional<Hit> first;
    for (std::size_t i = 0; i < movers_.size(); ++i) {
        const Collider& collider = *movers_[i].collider;
        const glm::dvec3 from = at_start.local(i, start), to = at_end.local(i, end);
        // What is flat has no inside to be in.
        if (!is_finite(from) || !is_finite(to)) continue;
        const std::optional<Collider::Hit> hit = collider.first_hit(from, to);
        if (hit && !(first && first->part <= hit->part))
            first = {i, hit->part, hit->point, collider.normal(hit->triangle)};
    }
    return first;
}

}  // namespace motus::snow
