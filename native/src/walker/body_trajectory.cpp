#include "motus/walker/body_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

#include "across.hpp"
#include "motus/core/numeric.hpp"
#include "motus/walker/gait.hpp"

namespace motus::walker {
namespace {

constexpr double strides_of_a_jump = 4.0;

/// For the order of evaluation of sums and products to be safe from overflow.
constexpr double largest_number = 1e12;

template <class Vector>
[[nodiscard]] bool is_small(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i)
        if (!(std::abs(v[i]) <= largest_number)) return false;
    return true;
}

[[nodiscard]] bool is_small(const glm::dmat4& pose) {
    return is_small(pose[0]) && is_small(pose[1]) && is_small(pose[2]) && is_small(pose[3]);
}

void check(const Way& way) {
    require(!way.times.empty() && way.times.size() <= most_samples, "times: must have 1 to 100,000 samples");
    require(std::ranges::all_of(way.times, [](double time) { return std::abs(time) <= largest_number; }),
            "times: must be finite, and 1e12 at most");
    constexpr double least = 1e-12;  // s: a nearer sample would be one of an endless speed
    require(std::ranges::adjacent_find(way.times, [](double a, double b) { return !(b - a >= least); }) ==
                way.times.end(),
            "times: must strictly rise, by at least 1e-12");
    require(way.poses.size() == way.times.size(), "poses: must be as many as times");
    require(std::ranges::all_of(way.poses, [](const glm::dmat4& pose) { return is_small(pose); }),
            "poses: must be finite, and 1e12 at most");
    require(!way.rest.empty() && way.rest.size() <= most_legs, "rest: must have 1 to 256 legs");
    require(std::ranges::all_of(way.rest, [](const glm::dvec3& place) { return is_small(place); }),
            "rest: must be finite, and 1e12 at most");
    require(way.phases.size() == way.rest.size(), "phases: must be as many as the legs of rest");
    require(are_finite(way.phases), "phases: must be finite");
    require(way.duty >= least_duty && way.duty <= most_duty, "duty: must be from 0.05 to 0.95");
    require(way.stride >= 1e-6 && way.stride <= 1e6, "stride: must be from 1e-6 to 1e6");
    require(way.cadence >= 1e-3 && way.cadence <= 1e3, "cadence: must be from 0.001 to 1000");
    require(is_small(way.up) && direction_of(way.up), "up: must be finite and not zero");
    require(std::ranges::adjacent_find(way.resets, std::ranges::greater_equal{}) == way.resets.end() &&
                (way.resets.empty() || way.resets.back() < way.times.size()),
            "resets: must rise and be indices of samples");
    require(!way.jump || *way.jump > 0.0, "jump: must be greater than 0");
}

[[nodiscard]] Way checked(Way way) {
    check(way);
    way.up = unit_vector(way.up);
    for (double& phase : way.phases) phase -= std::floor(phase);
    return way;
}

/// A column of a pose between two, `share` of the way.
[[nodiscard]] glm::dvec4 axis_between(const glm::dvec4& from, const glm::dvec4& to, double share) {
    if (from == to) return from;
    const glm::dvec3 a(from), b(to);
    const double first = length_of(a), last = length_of(b);
    return {direction_or(a + (b - a) * share, glm::dvec3(0.0)) * (first + (last - first) * share), 0.0};
}

}  // namespace

BodyTrajectory::BodyTrajectory(Way way) : way_(checked(std::move(way))), side_(axis_across(way_.up)) {
    starts_.push_back(0);
    phases_.push_back(0.0);
    for (std::size_t sample = 1; sample < way_.times.size(); ++sample) {
        if (jumps_to(sample)) {
            starts_.push_back(sample);
            phases_.push_back(0.0);
        } else {
            const double length = way_.times[sample] - way_.times[sample - 1];
            phases_.push_back(phases_.back() + length * cadence_after(sample - 1));
        }
    }
}

bool BodyTrajectory::jumps_to(std::size_t sample) const {
    if (std::ranges::binary_search(way_.resets, sample)) return true;
    const double most = way_.jump.value_or(strides_of_a_jump * way_.stride);
    return std::ranges::any_of(way_.rest, [&](const glm::dvec3& place) {
        return length_of(in_world(way_.poses[sample], place) - in_world(way_.poses[sample - 1], place)) >
               most;
    });
}

double BodyTrajectory::cadence_after(std::size_t sample) const {
    const glm::dmat4 &from = way_.poses[sample], &to = way_.poses[sample + 1];
    const glm::dvec3 up = direction_or(axes(from).up + axes(to).up, axes(from).up);
    double farthest = 0.0;
    for (const glm::dvec3& place : way_.rest) {
        const glm::dvec3 moved = in_world(to, place) - in_world(from, place);
        farthest = std::max(farthest, length_of(moved - up * glm::dot(moved, up)));
    }
    const double speed = farthest / (way_.times[sample + 1] - way_.times[sample]);
    return std::max(way_.cadence, way_.duty * speed / way_.stride);
}

std::size_t BodyTrajectory::stretch_at(double time) const {
    const auto begins = [this](std::size_t sample) { return way_.times[sample]; };
    const auto after = std::ranges::upper_bound(starts_, time, {}, begins);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - starts_.begin() - 1, 0));
}

std::size_t BodyTrajectory::sample_before(std::size_t stretch, double time) const {
    const auto first = way_.times.begin() + static_cast<std::ptrdiff_t>(first_sample(stretch));
    const auto end = way_.times.begin() + static_cast<std::ptrdiff_t>(last_sample(stretch)) + 1;
    const auto after = std::upper_bound(first, end, time);
    return first_sample(stretch) + static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - first - 1, 0));
}

double BodyTrajectory::rate(std::size_t sample, std::size_t last) const {
    if (sample >= last) return way_.cadence;
    return (phases_[sample + 1] - phases_[sample]) / (way_.times[sample + 1] - way_.times[sample]);
}

glm::dmat4 BodyTrajectory::pose(std::size_t stretch, double time) const {
    require_stretch(stretch);
    if (std::isnan(time)) return glm::dmat4(1.0) * time;  // NaN throughout: 0 times NaN is NaN
    const std::size_t last = last_sample(stretch);
    const std::size_t sample = sample_before(stretch, time);
    if (sample == last && !(time < way_.times[sample])) return way_.poses[last];
    glm::dmat4 pose = way_.poses[sample];
    if (sample == last) return pose;
    const glm::dmat4& next = way_.poses[sample + 1];
    const double share = (time - way_.times[sample]) / (way_.times[sample + 1] - way_.times[sample]);
    if (share > 0.0)
        for (int axis = 0; axis < 3; ++axis) pose[axis] = axis_between(pose[axis], next[axis], share);
    if (share > 0.0 || !starts_slowly(stretch)) pose[3] += (next[3] - pose[3]) * share;
    return pose;
}

double BodyTrajectory::phase(std::size_t stretch, double time) const {
    require_stretch(stretch);
    const std::size_t sample = sample_before(stretch, time);
    return phases_[sample] + (time - way_.times[sample]) * rate(sample, last_sample(stretch));
}

double BodyTrajectory::time_at(std::size_t stretch, double phase) const {
    require_stretch(stretch);
    const std::size_t last = last_sample(stretch);
    const auto begin = phases_.begin() + static_cast<std::ptrdiff_t>(first_sample(stretch));
    const auto end = phases_.begin() + static_cast<std::ptrdiff_t>(last) + 1;
    const auto after = std::upper_bound(begin, end, phase);
    const std::size_t sample =
        first_sample(stretch) + static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - begin - 1, 0));
    const double time = way_.times[sample] + (phase - phases_[sample]) / rate(sample, last);
    return sample < last ? std::min(time, way_.times[sample + 1]) : time;
}

bool BodyTrajectory::starts_slowly(std::size_t stretch) const {
    require_stretch(stretch);
    const std::size_t first = first_sample(stretch);
    return first == last_sample(stretch) || cadence_after(first) == way_.cadence;
}

Axes BodyTrajectory::axes(const glm::dmat4& pose) const {
    const glm::dmat3 turn(pose);
    Axes axes;
    axes.up = direction_or(turn * way_.up, {0.0, 0.0, 1.0});
    axes.side = across(turn * side_, axes.up);
    axes.ahead = glm::cross(axes.up, axes.side);
    return axes;
}

std::size_t BodyTrajectory::bytes() const noexcept {
    return (way_.times.capacity() + way_.phases.capacity() + phases_.capacity()) * sizeof(double) +
           way_.poses.capacity() * sizeof(glm::dmat4) + way_.rest.capacity() * sizeof(glm::dvec3) +
           starts_.capacity() * sizeof(std::size_t);
}

}  // namespace motus::walker
