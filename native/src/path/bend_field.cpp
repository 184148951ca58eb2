#include "bend_field.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "motus/core/numeric.hpp"

namespace motus::path {
namespace {

constexpr double ramp_share =
    0.1;  // of a stretch: the ramp at each end that leads over a jump of the curvature
constexpr double shortest_cell =
    1e-6;  // of the length: what curves more tightly than the cells above it, is a cusp
constexpr double narrowest = 1e-12;  // of the length: least width of a filter, far below a cell's width
constexpr double widest = 1e9;    // of the length: any wider filter gives the mean, to its last digit but one
constexpr double headroom = 2.0;  // of the curvature over the mean of the cell it lies in

/// Angle by which the tangent turns from one place to the next, towards where, in the frame of the first.
Across turn_between(const Place& from, const Place& to) {
    const Across across = from.across(to.tangent);
    const double sine = std::abs(across);
    const double cosine = glm::dot(from.tangent, to.tangent);
    const bool reversal = cosine < -0.999999;  // then the tangent turns about up, to no side in particular
    if (sine == 0.0 || reversal) return 0.0;
    return across / sine * std::atan2(sine, cosine);
}

}  // namespace

BendField::BendField(std::shared_ptr<const ParallelFrames> frames, double smoothing)
    : frames_(std::move(frames)) {
    measure_turning();
    find_limit();
    if (smoothing > 0.0 && frames_->length() > 0.0) {
        filter(smoothing);
    } else {
        join_stretches();
    }
}

void BendField::measure_turning() {
    const std::size_t count = frames_->distances().size();
    turning_.reserve(count);
    double total = 0.0;
    Place from = frames_->station(0);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const Place to = frames_->station(i + 1);
        turning_.push_back(turn_between(from, to));
        total += std::abs(turning_.back());
        from = to;
    }
    const bool corner_at_seam = frames_->cyclic() && frames_->seam() == Cell::corner;
    turning_.push_back(corner_at_seam ? turn_between(from, frames_->station(0)) : 0.0);
    total += std::abs(turning_.back());
    if (frames_->length() > 0.0) mean_ = total / frames_->length();
}

void BendField::find_limit() {
    const auto distances = frames_->distances();
    const double shortest = shortest_cell * frames_->length();
    for (std::size_t i = 0; i + 1 < distances.size(); ++i) {
        const double width = distances[i + 1] - distances[i];
        if (width > shortest) limit_ = std::max(limit_, headroom * std::abs(turning_[i]) / width);
    }
}

Across BendField::exact(const Place& place) const {
    const Across bend = place.across(place.bend);
    const double size = size_of(bend);
    if (size <= limit_) return bend;
    if (std::isfinite(size)) return bend * (limit_ / size);
    // On a cusp: the direction in which the curve turns next to it.
    const std::size_t cells = frames_->cells().size();
    const std::size_t cell = place.cell < cells && frames_->cells()[place.cell] == Cell::smooth
                                 ? place.cell
                                 : std::max<std::size_t>(place.cell, 1) - 1;
    const double turning = std::abs(turning_[cell]);
    return turning > 0.0 ? turning_[cell] * (limit_ / turning) : 0.0;
}

void BendField::join_stretches() {
    const auto distances = frames_->distances();
    const auto cells = frames_->cells();
    stretch_of_.reserve(distances.size());
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (i == 0 || (cells[i - 1] != Cell::smooth))
            stretches_.push_back({distances[i], distances[i], {}, {}});
        stretches_.back().end = distances[i];
        stretch_of_.push_back(static_cast<std::uint32_t>(stretches_.size() - 1));
    }
    for (std::size_t i = 0; i + 1 < distances.size(); ++i) {
        if (cells[i] != Cell::joint) continue;
        join(stretches_[stretch_of_[i]], frames_->station(i), stretches_[stretch_of_[i + 1]],
             frames_->station(i + 1), 1.0);
    }
    if (frames_->cyclic() && frames_->seam() == Cell::joint) {
        join(stretches_.back(), frames_->station(distances.size() - 1), stretches_.front(),
             frames_->station(0), frames_->closing());
    }
}

/// Turns the ends of two stretches until they meet half-way.
void BendField::join(Stretch& left, const Place& last, Stretch& right, const Place& first,
                     Across last_to_first) {
    const Across jump = exact(first) - exact(last) * last_to_first;
    right.at_begin = -0.5 * jump;
    left.at_end = 0.5 * jump * std::conj(last_to_first);
}

/// The memory after `distance` in a cell, whose turning is spread evenly over it; 0 for all of a corner.
BendField::Memory BendField::passed(const Memory& memory, std::size_t cell, double distance) const {
    const auto distances = frames_->distances();
    const double width = cell + 1 < distances.size() ? distances[cell + 1] - distances[cell] : 0.0;
    const double x = distance / width_;
    const double decay = std::exp(-x);
    Memory next{memory.plain * decay, (memory.ramped + x * memory.plain) * decay};
    if (width > 0.0) {
        const Across bend = turning_[cell] / width;
        next.plain += bend * (width_ * -std::expm1(-x));
        next.ramped += bend * (width_ * (-std::expm1(-x) - x * decay));
    } else {
        next.plain += turning_[cell];
    }
    return next;
}

/// The memory m with m = (lap's own memory) + (m, faded over a lap), in the frame after it.
BendField::Memory BendField::steady(const Memory& after_lap, Across lap_turn, double lap) const {
    const double x = lap / width_;
    const Across kept = lap_turn * std::exp(-x);
    const Across lost = (1.0 - lap_turn) - lap_turn * std::expm1(-x);  // 1 - kept, to its last digit
    const Across plain = after_lap.plain * lap_turn / lost;
    return {plain, (after_lap.ramped * lap_turn + x * plain * kept) / lost};
}

void BendField::filter(double smoothing) {
    width_ = std::clamp(smoothing, narrowest * frames_->length(), widest * frames_->length());
    const auto distances = frames_->distances();
    const std::size_t last = distances.size() - 1;
    const auto run_forth = [&](Memory memory) {
        before_.assign(distances.size(), memory);
        for (std::size_t i = 0; i < last; ++i) {
            before_[i + 1] = memory = passed(memory, i, distances[i + 1] - distances[i]);
        }
    };
    const auto run_back = [&](Memory memory) {
        behind_.assign(distances.size(), memory);
        for (std::size_t i = last; i-- > 0;) {
            behind_[i] = memory = passed(memory, i, distances[i + 1] - distances[i]);
        }
    };
    if (frames_->cyclic()) {
        const Across closing = frames_->closing();
        run_forth({});
        run_forth(
            steady({before_[last].plain + turning_[last], before_[last].ramped}, closing, frames_->length()));
        run_back({});
        run_back(steady({behind_[0].plain + turning_[last] * closing, behind_[0].ramped}, std::conj(closing),
                        frames_->length()));
    } else {
        // Beyond its ends the path is continued as it begins and ends.
        const auto held = [&](std::size_t cell) {
            const double width = distances[cell + 1] - distances[cell];
            const Across bend = width > 0.0 ? turning_[cell] / width : 0.0;
            return Memory{bend * width_, bend * width_};
        };
        run_forth(held(0));
        run_back(held(last - 1));
    }
}

Across BendField::filtered(const Place& place) const {
    const auto distances = frames_->distances();
    const std::size_t i = place.cell;
    Memory before = before_[i];
    Memory behind = behind_[i];
    if (i + 1 < distances.size() && place.s > distances[i]) {
        before = passed(before, i, place.s - distances[i]);
        behind = passed(behind_[i + 1], i, distances[i + 1] - place.s);
    }
    return (before.plain + before.ramped + behind.plain + behind.ramped) / (4.0 * width_);
}

Across BendField::at(const Place& place) const {
    if (width_ > 0.0) return filtered(place);
    const Stretch& stretch = stretches_[stretch_of_[place.cell]];
    Across bend = exact(place);
    const double ramp = ramp_share * (stretch.end - stretch.begin);
    const double from_begin = place.s - stretch.begin;
    const double to_end = stretch.end - place.s;
    if (from_begin < ramp) bend += stretch.at_begin * smooth_step(1.0 - from_begin / ramp);
    if (to_end < ramp) bend += stretch.at_end * smooth_step(1.0 - to_end / ramp);
    return bend;
}

}  // namespace motus::path
