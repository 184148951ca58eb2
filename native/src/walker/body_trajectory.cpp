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
constexpr double gravity = 9.81;  ///< m/s^2, as natural_stride() has it

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

/// Checks numbers at the samples, of which there may be none.
void check_numbers(const std::vector<double>& numbers, std::size_t samples, double least, double most,
                   const char* problem) {
    require(numbers.empty() || numbers.size() == samples, problem);
    require(std::ranges::all_of(numbers, [=](double x) { return x >= least && x <= most; }), problem);
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
    require(way.transition >= 1.0 && way.transition <= 1000.0, "transition: must be from 1 to 1000");
    require(way.hip_height >= 0.0 && way.hip_height <= 1e6, "hip_height: must be from 0 to 1e6");
    check_numbers(way.strides, way.times.size(), 1e-6, 1e6,
                  "strides: must be as many as times, from 1e-6 to 1e6");
    check_numbers(way.cadences, way.times.size(), 1e-3, 1e3,
                  "cadences: must be as many as times, from 0.001 to 1000");
    check_numbers(way.duties, way.times.size(), least_duty, most_duty,
                  "duties: must be as many as times, from 0.05 to 0.95");
    require(std::ranges::is_sorted(way.changes, {}, &GaitChange::sample) &&
                (way.changes.empty() || way.changes.back().sample < way.times.size()),
            "changes: must be in the order of their samples, which are of times");
    for (const GaitChange& change : way.changes)
        require(
            change.phases.size() == way.rest.size() && are_finite(change.phases) &&
                change.duty >= least_duty && change.duty <= most_duty,
            "changes: must have finite phases, as many as the legs of rest, and a duty from 0.05 to 0.95");
}

[[nodiscard]] double fraction(double phase) {
    return phase - std::floor(phase);
}

/// The number on a circle of circumference 1 from which the farthest of all is nearest.
[[nodiscard]] double middle_of(std::vector<double> fractions) {
    std::ranges::sort(fractions);
    double widest = fractions.front() + 1.0 - fractions.back(), begin = fractions.front();
    for (std::size_t i = 1; i < fractions.size(); ++i) {
        const double gap = fractions[i] - fractions[i - 1];
        if (gap > widest) {
            widest = gap;
            begin = fractions[i];
        }
    }
    return begin + 0.5 * (1.0 - widest);
}

/// The own phases of legs and their duty, as legs go over from gait to gait.
class GaitBlend {
  public:
    explicit GaitBlend(const Way& way) : way_(way), from_(way.phases), by_(way.phases.size(), 0.0) {}

    /// Goes on to the next sample. begins: whether a stretch begins there, which begins in its gait.
    void step(std::size_t sample, double phase, bool begins) {
        const std::vector<GaitChange>& changes = way_.changes;
        for (; next_ < changes.size() && changes[next_].sample <= sample; ++next_)
            go_over(changes[next_].phases, changes[next_].duty, phase);
        phase_ = phase;
        if (!begins) return;
        const bool is_first = next_ == 0;
        from_ = is_first ? way_.phases : changes[next_ - 1].phases;
        from_duty_ = to_duty_ = is_first ? way_.duty : changes[next_ - 1].duty;
        std::ranges::fill(by_, 0.0);
        since_ = phase;
    }
    [[nodiscard]] double own(std::size_t leg) const { return from_[leg] + share(phase_) * by_[leg]; }
    [[nodiscard]] double duty() const { return from_duty_ + share(phase_) * (to_duty_ - from_duty_); }

  private:
    [[nodiscard]] double share(double phase) const {
        return std::clamp((phase - since_) / way_.transition, 0.0, 1.0);
    }
    void go_over(const std::vector<double>& phases, double to_duty, double phase) {
        phase_ = phase;
        std::vector<double> now;
        for (std::size_t leg = 0; leg < from_.size(); ++leg) now.push_back(own(leg));
        from_duty_ = duty();
        to_duty_ = to_duty;
        from_ = std::move(now);
        since_ = phase;
        for (std::size_t leg = 0; leg < from_.size(); ++leg) by_[leg] = fraction(phases[leg] - from_[leg]);
        const double middle = middle_of(by_);
        for (double& by : by_) {
            by -= middle;
            by -= std::round(by);
        }
    }

    const Way& way_;
    std::vector<double> from_, by_;
    double from_duty_ = way_.duty, to_duty_ = way_.duty;
    double since_ = 0.0, phase_ = 0.0;
    std::size_t next_ = 0;  ///< of way_.changes
};

[[nodiscard]] Way checked(Way way) {
    check(way);
    way.up = unit_vector(way.up);
    for (double& phase : way.phases) phase = fraction(phase);
    for (GaitChange& change : way.changes)
        for (double& phase : change.phases) phase = fraction(phase);
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
    GaitBlend blend(way_);
    duties_ = way_.duties;
    for (std::size_t sample = 0; sample < way_.times.size(); ++sample) {
        const bool begins = sample == 0 || jumps_to(sample);
        if (begins) starts_.push_back(sample);
        phases_.push_back(begins ? 0.0
                                 : phases_.back() + (way_.times[sample] - way_.times[sample - 1]) *
                                                        cadence_after(sample - 1));
        if (!way_.changes.empty()) {
            blend.step(sample, phases_.back(), begins);
            for (std::size_t leg = 0; leg < way_.rest.size(); ++leg) own_.push_back(blend.own(leg));
            if (way_.duties.empty()) duties_.push_back(blend.duty());
        }
        if (way_.hip_height > 0.0) strides_.push_back(natural_after(sample));
    }
}

bool BodyTrajectory::jumps_to(std::size_t sample) const {
    if (std::ranges::binary_search(way_.resets, sample)) return true;
    // The speed of a jump says nothing of the stride, and after a jump there is none before it.
    const double hip = way_.hip_height;
    const double stride =
        hip > 0.0 ? duty_at(sample - 1) * natural_stride(std::sqrt(gravity * hip), hip) : set_stride(sample);
    const double most = way_.jump.value_or(strides_of_a_jump * stride);
    return std::ranges::any_of(way_.rest, [&](const glm::dvec3& place) {
        return length_of(in_world(way_.poses[sample], place) - in_world(way_.poses[sample - 1], place)) >
               most;
    });
}

double BodyTrajectory::speed_after(std::size_t sample) const {
    const glm::dmat4 &from = way_.poses[sample], &to = way_.poses[sample + 1];
    const glm::dvec3 up = direction_or(axes(from).up + axes(to).up, axes(from).up);
    double farthest = 0.0;
    for (const glm::dvec3& place : way_.rest) {
        const glm::dvec3 moved = in_world(to, place) - in_world(from, place);
        farthest = std::max(farthest, length_of(moved - up * glm::dot(moved, up)));
    }
    return farthest / (way_.times[sample + 1] - way_.times[sample]);
}

double BodyTrajectory::natural_after(std::size_t sample) const {
    const bool stays = sample + 1 == way_.times.size() || jumps_to(sample + 1);
    const double speed = stays ? 0.0 : std::min(speed_after(sample), largest_number);
    return std::clamp(duty_at(sample) * natural_stride(speed, way_.hip_height), 1e-6, 1e6);
}

double BodyTrajectory::cadence_after(std::size_t sample) const {
    return std::max(cadence_at(sample), duty_at(sample) * speed_after(sample) / stride_at(sample));
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
    if (sample >= last) return cadence_at(last);
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

double BodyTrajectory::first_phase(std::size_t stretch, std::size_t leg) const {
    require_leg(leg);
    return own(first_sample(stretch), leg);
}

double BodyTrajectory::cycles(std::size_t stretch, std::size_t leg, double time) const {
    require_leg(leg);
    const double reached = phase(stretch, time);
    if (own_.empty()) return reached;
    const std::size_t sample = sample_before(stretch, time);
    const double from = own(sample, leg) - own(first_sample(stretch), leg);
    if (sample == last_sample(stretch) || !(time > way_.times[sample])) return reached + from;
    const double share = (time - way_.times[sample]) / (way_.times[sample + 1] - way_.times[sample]);
    return reached + (from + share * (own(sample + 1, leg) - own(sample, leg)));
}

double BodyTrajectory::time_after(std::size_t stretch, std::size_t leg, double cycles) const {
    require_leg(leg);
    if (own_.empty()) return time_at(stretch, cycles);
    const std::size_t first = first_sample(stretch), last = last_sample(stretch);
    const double begin = own(first, leg);
    const auto at = [&](std::size_t sample) { return phases_[sample] + (own(sample, leg) - begin); };
    std::size_t sample = first, end = last + 1;
    while (end - sample > 1) {
        const std::size_t middle = sample + (end - sample) / 2;
        (at(middle) <= cycles ? sample : end) = middle;
    }
    const double more = cycles - at(sample);
    if (sample == last || more < 0.0) return way_.times[sample] + more / rate(sample, last);
    const double length = way_.times[sample + 1] - way_.times[sample];
    return std::min(way_.times[sample] + more / (at(sample + 1) - at(sample)) * length,
                    way_.times[sample + 1]);
}

double BodyTrajectory::duty(std::size_t stretch, double time) const {
    require_stretch(stretch);
    return duty_at(sample_before(stretch, time));
}

double BodyTrajectory::stride(std::size_t stretch, double time) const {
    require_stretch(stretch);
    return stride_at(sample_before(stretch, time));
}

bool BodyTrajectory::starts_slowly(std::size_t stretch) const {
    require_stretch(stretch);
    const std::size_t first = first_sample(stretch);
    return first == last_sample(stretch) || cadence_after(first) == cadence_at(first);
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
    std::size_t numbers = way_.times.capacity() + way_.phases.capacity() + way_.strides.capacity() +
                          way_.cadences.capacity() + way_.duties.capacity() + phases_.capacity() +
                          own_.capacity() + duties_.capacity() + strides_.capacity();
    for (const GaitChange& change : way_.changes) numbers += change.phases.capacity();
    return numbers * sizeof(double) + way_.changes.capacity() * sizeof(GaitChange) +
           way_.poses.capacity() * sizeof(glm::dmat4) + way_.rest.capacity() * sizeof(glm::dvec3) +
           starts_.capacity() * sizeof(std::size_t);
}

}  // namespace motus::walker
