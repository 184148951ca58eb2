#include "plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "lean.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"
#include "timing.hpp"

namespace motus::walker {
namespace {

/// Steps shorter than this part of the stride count as no steps.
constexpr double no_step = 1e-5;
/// Steps shorter than this, in strides, rise less than the clearance, in proportion to their length.
constexpr double full_step = 0.25;
/// Weight of a foot half-way through its swing for the body's height and tilt; a standing foot has 1.
constexpr double least_weight = 0.01;
/// Parts of the way from a rest place to below the hip at which ground is looked for, one after the other.
constexpr std::array nearer{0.25, 0.5, 0.75};

[[nodiscard]] Search moved_nearer(Search search, double share) {
    const glm::dvec3 way = search.hip - search.rest;
    search.rest += share * (way - search.up * glm::dot(way, search.up));
    return search;
}

/// A place above the ground that is met, if any is.
[[nodiscard]] std::optional<Contact> raised(std::optional<Contact> met, double ankle) {
    if (met && ankle > 0.0) met->point += ankle * met->normal;
    return met;
}

/// Footfalls beyond the last planned one, for a leg of which a step is timed: its last foothold may be
/// earlier.
constexpr int spare_footfalls = 2;
/// Moments that a timed step may have.
constexpr int most_moments = 2;

[[nodiscard]] double expected_steps(const BodyTrajectory& trajectory) {
    // At both ends of a stretch there may be one more than there are cycles, and one is if the foot is
    // put.
    constexpr double at_ends = 3.0;
    double cycles = 0.0;
    for (std::size_t stretch = 0; stretch < trajectory.stretch_count(); ++stretch)
        cycles += trajectory.last_phase(stretch) + at_ends;
    // Legs may go over to a gait by half a cycle.
    cycles += 0.5 * static_cast<double>(trajectory.way().changes.size());
    return cycles * static_cast<double>(trajectory.way().rest.size());
}

}  // namespace

Correction corrected(const WalkSettings& settings, const glm::dvec3& lean, const Axes& axes) {
    const Lean followed{settings.height * lean.x, settings.tilt * lean.y, settings.tilt * lean.z};
    return {followed.height * axes.up, turn_of(followed, axes)};
}

Planner::Planner(const WalkSettings& settings, const BodyTrajectory& trajectory, const Ground* ground,
                 Executor executor)
    : settings_(settings),
      trajectory_(trajectory),
      ground_(ground != nullptr && !ground->is_empty() ? ground : nullptr),
      reach_{settings.reach_up, settings.reach_down},
      soles_(settings.soles, trajectory.way().up),
      executor_(std::move(executor)),
      hips_(settings.hips) {
    const auto spare = static_cast<double>((spare_footfalls + most_moments) * settings.chosen.size());
    require(expected_steps(trajectory) + spare <= most_steps,
            "poses: must go slower, or the stride be longer, or the cadence lower: more than 1,000,000 steps "
            "would be planned");
    sort_chosen();
    if (!hips_.empty()) return;
    const std::vector<glm::dvec3>& rest = trajectory.way().rest;
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& place : rest) middle += place / static_cast<double>(rest.size());
    hips_.assign(rest.size(), middle);
}

template <class Work>
void Planner::for_legs(const Work& work) const {
    // Number of steps for which a further thread pays: each step takes some microseconds.
    constexpr double worth_it = 100.0;
    const std::size_t legs = hips_.size();
    const std::size_t grain = expected_steps(trajectory_) > worth_it ? 1 : legs;
    const auto part = [&](std::size_t first, std::size_t last) {
        for (std::size_t leg = first; leg < last; ++leg) work(leg);
    };
    in_parts(legs, grain, part, executor_);
}

std::optional<Contact> Planner::foothold(const Search& search) const {
    return raised(footing(*ground_, search, reach_), settings_.soles.ankle);
}

void Planner::find_place(Footfall& fall) const {
    fall.place = {fall.search.rest, fall.search.up, 0.0};
    if (ground_ == nullptr) return;
    std::optional<Contact> place = foothold(fall.search);
    for (const double share : nearer)
        if (!place) place = foothold(moved_nearer(fall.search, share));
    if (!place) place = raised(footing_around_edge(*ground_, fall.search, reach_), settings_.soles.ankle);
    fall.is_grounded = place.has_value();
    if (place) fall.place = *place;
}

Planner::Footfalls Planner::footfalls(std::size_t leg, std::size_t stretch) const {
    const Way& way = trajectory_.way();
    const double begin = way.times[trajectory_.first_sample(stretch)];
    const double own = trajectory_.first_phase(stretch, leg), swing = 1.0 - trajectory_.duty(stretch, begin);
    const double end = way.times[trajectory_.last_sample(stretch)];
    const bool is_slow = trajectory_.starts_slowly(stretch);
    // The stretch begins in cycle 0, maybe in its swing: of this the foot has so much before it. A body that
    // sets off has all feet on the ground: such swings begin then, or are over if little is left of them.
    const double before = (swing - own) / swing;
    constexpr double little = 0.5;
    const bool stands = before <= 0.0 || (is_slow && before < little);
    const int first = stands ? 0 : -1;
    // The first footfall whose stand is half over when the body comes to rest.
    const auto last = static_cast<int>(
        std::ceil(trajectory_.cycles(stretch, leg, end) + own - 1.0 + 0.5 * trajectory_.duty(stretch, end)));
    std::vector<double> cycles;
    for (int cycle = first; cycle <= std::max(first, last); ++cycle) cycles.push_back(cycle);
    if (is_timed(row(leg, stretch))) add_spare(leg, stretch, cycles);
    Footfalls falls;
    for (const double cycle : cycles) {
        Footfall fall;
        fall.lift_cycles = cycle - own;
        fall.lift = trajectory_.time_after(stretch, leg, fall.lift_cycles);
        fall.pace = {trajectory_.stride(stretch, fall.lift), trajectory_.duty(stretch, fall.lift)};
        fall.touch_cycles = fall.lift_cycles + (1.0 - fall.pace.duty);
        fall.touch = trajectory_.time_after(stretch, leg, fall.touch_cycles);
        fall.until = trajectory_.time_after(stretch, leg, fall.lift_cycles + 1.0);
        if (is_slow) fall.lift = std::max(fall.lift, begin);
        stand_at(leg, stretch,
                 trajectory_.time_after(stretch, leg, fall.lift_cycles + 1.0 - 0.5 * fall.pace.duty), fall);
        fall.planned = fall.middle;
        falls.push_back(fall);
    }
    const double put = falls.size() > 1 ? std::min(begin, falls[1].lift) : begin;
    falls.front().lift = falls.front().touch = put;
    falls.back().until = std::numeric_limits<double>::infinity();
    return falls;
}

void Planner::add_spare(std::size_t leg, std::size_t stretch, std::vector<double>& cycles) const {
    for (int i = 0; i < spare_footfalls; ++i) cycles.push_back(cycles.back() + 1.0);
    const auto end = static_cast<std::ptrdiff_t>(cycles.size());
    const double own = trajectory_.first_phase(stretch, leg);
    const double duty = trajectory_.duty(stretch, trajectory_.way().times[trajectory_.last_sample(stretch)]);
    const auto add_nearest = [&](const std::optional<double>& moment, double after_lift) {
        if (!moment) return;
        const double nearest = std::round(trajectory_.cycles(stretch, leg, *moment) + own - after_lift);
        if (nearest > cycles[static_cast<std::size_t>(end) - 1]) cycles.push_back(nearest);
    };
    for (const std::size_t one : chosen_[row(leg, stretch)]) {
        add_nearest(moments_[one].touch, 1.0 - duty);
        add_nearest(moments_[one].until, 0.0);
    }
    std::sort(cycles.begin() + end, cycles.end());
    cycles.erase(std::unique(cycles.begin() + end, cycles.end()), cycles.end());
}

void Planner::stand_at(std::size_t leg, std::size_t stretch, double middle, Footfall& fall) const {
    const Way& way = trajectory_.way();
    fall.pose = trajectory_.pose(stretch, middle);
    fall.search = {in_world(fall.pose, way.rest[leg]), in_world(fall.pose, hips_[leg]),
                   trajectory_.axes(fall.pose).up};
    find_place(fall);
    fall.middle = middle;
    if (stretch > 0) fall.middle = std::max(middle, way.times[trajectory_.first_sample(stretch)]);
    if (stretch + 1 < trajectory_.stretch_count())
        fall.middle = std::min(fall.middle, way.times[trajectory_.last_sample(stretch)]);
}

double Planner::least_step(const Footfall& fall) const {
    const double none = no_step * fall.pace.stride;
    return fall.chosen ? none : std::max(settings_.minimum_step, none);
}

glm::dquat Planner::turn_of(const Footfall& fall) const {
    if (!fall.chosen) return soles_.flat(fall.pose, fall.place.normal);
    const ChosenStep& step = settings_.chosen[*fall.chosen];
    const glm::dquat flat = step.fixed ? step.fixed->turn : soles_.flat(fall.pose, fall.place.normal);
    return soles_.turned(flat, step.turn);
}

std::vector<Footstep> Planner::steps_of(const Footfalls& falls, bool looks_for_obstacles) const {
    std::vector<Footstep> steps;
    std::vector<Pace> paces;
    const Footfall* before = nullptr;
    for (const Footfall& fall : falls) {
        Footstep step;
        step.lift = fall.lift;
        step.touch = fall.touch;
        step.end = fall.place.point;
        step.end_normal = fall.place.normal;
        step.end_turn = turn_of(fall);
        step.middle = fall.middle;
        step.planned = fall.planned;
        step.chosen = fall.chosen;
        step.is_grounded = fall.is_grounded;
        step.start = before != nullptr ? before->place.point : step.end;
        step.start_normal = before != nullptr ? before->place.normal : step.end_normal;
        step.start_turn = before != nullptr ? steps.back().end_turn : step.end_turn;
        if (before != nullptr) {
            const double length = length_of(step.end - step.start);
            if (length <= least_step(fall)) continue;
            const glm::dvec3 up = direction_or(before->search.up + fall.search.up, fall.search.up);
            const Clearing over =
                looks_for_obstacles && ground_ != nullptr
                    ? clearing(*ground_, step.start - settings_.soles.ankle * step.start_normal,
                               step.end - settings_.soles.ankle * step.end_normal, up, settings_.reach_up)
                    : Clearing{};
            const double share = std::min(1.0, length / (full_step * fall.pace.stride));
            step.rise = (settings_.clearance * share + over.rise) * up;
            step.upwards = over.upwards;
            step.downwards = over.downwards;
        }
        steps.push_back(step);
        paces.push_back(fall.pace);
        before = &fall;
    }
    soles_.add_rolls(steps, paces);
    return steps;
}

Footsteps Planner::all_steps(bool looks_for_obstacles) const {
    std::vector<std::vector<Footstep>> steps(falls_.size());
    for_legs([&](std::size_t leg) {
        for (std::size_t stretch = 0; stretch < trajectory_.stretch_count(); ++stretch)
            steps[row(leg, stretch)] = steps_of(falls_[row(leg, stretch)], looks_for_obstacles);
    });
    Footsteps all;
    for (const std::vector<Footstep>& of_row : steps) all.add(of_row);
    return all;
}

dynamics::Track Planner::leans_of(const Footsteps& steps) const {
    const Way& way = trajectory_.way();
    const std::size_t legs = way.rest.size();
    std::vector<double> inputs(3 * way.times.size());
    std::vector<glm::dvec3> rest(legs), feet(legs);
    std::vector<double> weights(legs);
    for (std::size_t stretch = 0; stretch < trajectory_.stretch_count(); ++stretch) {
        for (std::size_t i = trajectory_.first_sample(stretch); i <= trajectory_.last_sample(stretch); ++i) {
            for (std::size_t leg = 0; leg < legs; ++leg) {
                const Footstep& step = step_at(steps.of(row(leg, stretch)), way.times[i]);
                const double through = step.through(way.times[i]);
                rest[leg] = in_world(way.poses[i], way.rest[leg]);
                feet[leg] = step.start + (step.end - step.start) * step.share(through);
                weights[leg] = 1.0 - (1.0 - least_weight) * above(through);
            }
            const glm::dvec3 origin(way.poses[i][3]);
            const Lean lean = lean_of(origin, trajectory_.axes(way.poses[i]), rest, feet, weights);
            inputs[3 * i] = lean.height;
            inputs[3 * i + 1] = lean.side;
            inputs[3 * i + 2] = lean.ahead;
        }
    }
    return {settings_.filter, way.times, inputs, 3, trajectory_.starts()};
}

void Planner::correct(const dynamics::Track& leans) {
    const std::vector<glm::dmat4>& poses = trajectory_.way().poses;
    std::vector<double> outputs(3 * poses.size());
    leans.outputs(outputs);
    corrections_.clear();
    for (std::size_t i = 0; i < poses.size(); ++i)
        corrections_.push_back(corrected(settings_, {outputs[3 * i], outputs[3 * i + 1], outputs[3 * i + 2]},
                                         trajectory_.axes(poses[i])));
}

glm::dvec3 Planner::hip_at(std::size_t leg, std::size_t sample) const {
    const glm::dmat4& pose = trajectory_.way().poses[sample];
    const Correction& correction = corrections_[sample];
    const glm::dvec3 origin(pose[3]);
    const glm::dvec3 hip =
        settings_.bodies.empty() ? hips_[leg] : in_world(settings_.bodies[sample], hips_[leg]);
    return origin + correction.offset + correction.rotation * (in_world(pose, hip) - origin);
}

glm::dvec3 Planner::hip_after(std::size_t leg, std::size_t sample, double time) const {
    const std::vector<double>& times = trajectory_.way().times;
    const glm::dvec3 hip = hip_at(leg, sample);
    if (!(time > times[sample])) return hip;
    const double share = (time - times[sample]) / (times[sample + 1] - times[sample]);
    return hip + share * (hip_at(leg, sample + 1) - hip);
}

double Planner::longest_reach(std::size_t leg) const {
    constexpr double rounding = 1e-6;
    return settings_.lengths[leg] * (1.0 + rounding);
}

bool Planner::is_missed(std::size_t leg, std::size_t stretch, const glm::dvec3& place, double from,
                        double until) const {
    const std::vector<double>& times = trajectory_.way().times;
    const std::size_t last = trajectory_.last_sample(stretch);
    const double begin = std::clamp(from, times[trajectory_.first_sample(stretch)], times[last]);
    const double end = std::clamp(until, begin, times[last]);
    const double longest = longest_reach(leg);
    const auto is_too_far = [&](const glm::dvec3& hip) { return length_of(place - hip) > longest; };
    const auto after = std::ranges::upper_bound(times, begin);
    auto sample = static_cast<std::size_t>(after - times.begin()) - 1;
    if (is_too_far(hip_after(leg, sample, begin))) return true;
    while (sample < last && times[sample + 1] <= end)
        if (is_too_far(hip_at(leg, ++sample))) return true;
    return is_too_far(hip_after(leg, sample, end));
}

bool Planner::move_nearer(std::size_t leg, std::size_t stretch, Footfalls& falls) const {
    bool has_moved = false;
    for (Footfall& fall : falls) {
        if (fall.chosen || !is_missed(leg, stretch, fall.place.point, fall.touch, fall.until)) continue;
        for (const double share : nearer) {
            const auto place = foothold(moved_nearer(fall.search, share));
            if (!place || is_missed(leg, stretch, place->point, fall.touch, fall.until)) continue;
            fall.place = *place;
            fall.is_grounded = true;
            has_moved = true;
            break;
        }
    }
    return has_moved;
}

void Planner::add_missed(std::size_t leg, std::size_t stretch, const glm::dvec3& place, double from,
                         double until, std::vector<Problem>& found) const {
    const std::vector<double>& times = trajectory_.way().times;
    const double longest = longest_reach(leg);
    bool was_missed = false;
    const auto begin = times.begin() + static_cast<std::ptrdiff_t>(trajectory_.first_sample(stretch));
    const auto end = times.begin() + static_cast<std::ptrdiff_t>(trajectory_.last_sample(stretch)) + 1;
    const auto first = std::lower_bound(begin, end, from), last = std::upper_bound(first, end, until);
    for (auto at = first; at != last; ++at) {
        const auto sample = static_cast<std::size_t>(at - times.begin());
        const bool is_missed = length_of(place - hip_at(leg, sample)) > longest;
        if (is_missed && was_missed)
            found.back().last = times[sample];
        else if (is_missed)
            found.push_back({leg, times[sample], times[sample], Trouble::out_of_reach});
        was_missed = is_missed;
    }
}

std::vector<Problem> Planner::problems(std::size_t leg, std::size_t stretch,
                                       std::span<const Footstep> steps) const {
    const std::vector<double>& times = trajectory_.way().times;
    const double begin = times[trajectory_.first_sample(stretch)],
                 end = times[trajectory_.last_sample(stretch)];
    std::vector<Problem> found;
    if (!settings_.lengths.empty() && !has_reach(leg)) found.push_back({leg, begin, end, Trouble::no_length});
    for (std::size_t i = 0; i < steps.size(); ++i) {
        // Before the first sample.
        if (i + 1 < steps.size() && steps[i + 1].lift <= begin) continue;
        const double first = std::max(begin, steps[i].touch);
        const double last = std::max(first, i + 1 < steps.size() ? steps[i + 1].lift : end);
        if (!steps[i].is_grounded) {
            found.push_back({leg, first, last, Trouble::no_ground});
        } else if (has_reach(leg)) {
            add_missed(leg, stretch, steps[i].end, first, last, found);
        }
    }
    add_mistimed(row(leg, stretch), steps, found);
    std::ranges::stable_sort(found, {}, &Problem::first);
    return found;
}

void Planner::place(std::size_t leg, std::size_t stretch) {
    Footfalls& falls = falls_[row(leg, stretch)];
    falls = footfalls(leg, stretch);
    uncertain_[row(leg, stretch)] = choose(leg, stretch, falls);
    falls.resize(happening(stretch, falls));
}

WalkPlan Planner::plan() {
    const std::size_t stretches = trajectory_.stretch_count();
    const std::size_t rows = hips_.size() * stretches;
    falls_.resize(rows);
    uncertain_.resize(rows);
    for_legs([&](std::size_t leg) {
        for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
            do place(leg, stretch);
            while (refuse_missed(row(leg, stretch)));
        }
    });
    dynamics::Track leans = leans_of(all_steps(false));
    correct(leans);
    if (ground_ != nullptr && !settings_.lengths.empty()) {
        // The reach of the hips is known after the body has followed the feet; then the body follows them
        // again.
        std::vector<char> has_moved(hips_.size(), 0);
        for_legs([&](std::size_t leg) {
            for (std::size_t stretch = 0; has_reach(leg) && stretch < stretches; ++stretch) {
                bool moves = move_nearer(leg, stretch, falls_[row(leg, stretch)]);
                if (moves) has_moved[leg] = 1;
                // A step to a place that is moved may have become none.
                while (moves && refuse_missed(row(leg, stretch))) {
                    place(leg, stretch);
                    moves = move_nearer(leg, stretch, falls_[row(leg, stretch)]);
                }
            }
        });
        if (std::ranges::count(has_moved, 1) > 0) {
            leans = leans_of(all_steps(false));
            correct(leans);
        }
    }

    WalkPlan plan{all_steps(true), std::move(leans), {}, trajectory_.way().times.back()};
    std::vector<std::vector<Problem>> troubles(rows);
    for_legs([&](std::size_t leg) {
        for (std::size_t stretch = 0; stretch < stretches; ++stretch)
            troubles[row(leg, stretch)] = problems(leg, stretch, plan.steps.of(row(leg, stretch)));
    });
    for (std::size_t i = 0; i < rows; ++i)
        plan.problems.insert(plan.problems.end(), troubles[i].begin(), troubles[i].end());
    for (std::size_t leg = 0; leg < hips_.size(); ++leg)
        plan.settled = std::max(plan.settled, plan.steps.of(row(leg, stretches - 1)).back().touch);
    return plan;
}

}  // namespace motus::walker
