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

[[nodiscard]] bool has_times(const ChosenStep& step) {
    return step.touch.has_value() || step.until.has_value();
}

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
    const auto spare = static_cast<double>(spare_footfalls) * static_cast<double>(settings.chosen.size());
    require(expected_steps(trajectory) + spare <= most_steps,
            "poses: must go slower, or the stride be longer, or the cadence lower: more than 1,000,000 steps "
            "would be planned");
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
    const int spare = is_timed(leg, stretch) ? spare_footfalls : 0;
    Footfalls falls;
    for (int cycle = first; cycle <= std::max(first, last) + spare; ++cycle) {
        Footfall fall;
        fall.lift_cycles = static_cast<double>(cycle) - own;
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

bool Planner::is_timed(std::size_t leg, std::size_t stretch) const {
    return std::ranges::any_of(settings_.chosen, [&](const ChosenStep& one) {
        return one.leg == leg && has_times(one) && trajectory_.stretch_at(one.time) == stretch;
    });
}

std::vector<Planner::ChosenStand> Planner::chosen_stands(std::size_t leg, std::size_t stretch,
                                                         const Footfalls& falls) const {
    const auto is_here = [&](const ChosenStep& one) {
        return one.leg == leg && trajectory_.stretch_at(one.time) == stretch;
    };
    if (std::ranges::none_of(settings_.chosen, is_here)) return {};
    // Footfalls between which there is no step are one stand, which is chosen as a whole.
    std::vector<std::size_t> stands;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        const bool goes_on = i > 0 && length_of(falls[i].place.point - falls[stands.back()].place.point) <=
                                          least_step(falls[i]);
        stands.push_back(goes_on ? stands.back() : i);
    }
    std::vector<ChosenStand> found;
    for (std::size_t one = 0; one < settings_.chosen.size(); ++one) {
        const ChosenStep& step = settings_.chosen[one];
        if (!is_here(step)) continue;
        const auto after = std::ranges::upper_bound(falls, step.time, {}, &Footfall::lift);
        const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - falls.begin() - 1, 0));
        const auto end = std::ranges::upper_bound(stands, stands[at]);
        const ChosenStand stand{one, stands[at], static_cast<std::size_t>(end - stands.begin())};
        const auto place = std::ranges::lower_bound(found, stand.first, {}, &ChosenStand::first);
        if (place != found.end() && place->first == stand.first)
            *place = stand;
        else
            found.insert(place, stand);
    }
    return found;
}

std::vector<std::size_t> Planner::choose(std::size_t leg, std::size_t stretch, Footfalls& falls) const {
    std::vector<ChosenStand> stands = chosen_stands(leg, stretch, falls);
    const std::vector<ChosenStand> wanted = stands;
    const auto is_timed_stand = [&](const ChosenStand& stand) {
        return has_times(settings_.chosen[stand.chosen]);
    };
    if (std::ranges::any_of(wanted, is_timed_stand)) make_room(leg, stretch, falls, stands);
    std::vector<std::size_t> uncertain;
    for (const ChosenStand& stand : wanted)
        if (is_timed_stand(stand) ||
            std::ranges::find(stands, stand.chosen, &ChosenStand::chosen) == stands.end())
            uncertain.push_back(stand.chosen);
    for (const ChosenStand& stand : stands) {
        const ChosenStep& step = settings_.chosen[stand.chosen];
        for (std::size_t i = stand.first; i < stand.end; ++i) {
            Footfall& fall = falls[i];
            fall.chosen = stand.chosen;
            if (step.fixed) {
                fall.place = {step.fixed->place, soles_.normal(step.fixed->turn), 0.0};
                fall.is_grounded = true;
            } else if (i > stand.first) {
                fall.place = falls[stand.first].place;
                fall.is_grounded = falls[stand.first].is_grounded;
            } else {
                fall.search.rest += glm::dmat3(fall.pose) * step.offset;
                find_place(fall);
            }
        }
    }
    return uncertain;
}

void Planner::make_room(std::size_t leg, std::size_t stretch, Footfalls& falls,
                        std::vector<ChosenStand>& stands) const {
    const auto cycles = [&](double time) { return trajectory_.cycles(stretch, leg, time); };
    const auto nearest = [&](double wanted, std::size_t from, std::size_t least, double Footfall::*moment) {
        const auto apart = [&](std::size_t i) { return std::abs(falls[i].*moment - wanted); };
        std::size_t at = std::clamp(from, least, falls.size() - 1);
        while (at + 1 < falls.size() && apart(at + 1) < apart(at)) ++at;
        while (at > least && apart(at - 1) < apart(at)) --at;
        return at;
    };
    const double begin = trajectory_.way().times[trajectory_.first_sample(stretch)];
    Timing timing;
    std::vector<std::pair<double*, double>> set;
    const auto is_here = [&](const std::optional<double>& moment) {
        return moment && *moment >= begin && trajectory_.stretch_at(*moment) == stretch;
    };
    const auto keep = [&](double& moment, double planned, double wanted) {
        if (timing.set(planned, cycles(wanted))) set.emplace_back(&moment, wanted);
    };
    std::vector<char> is_left_out(falls.size(), 0);
    std::size_t free = 0;  // the footfalls before are taken by stands
    std::vector<ChosenStand> kept;
    for (ChosenStand stand : stands) {
        const ChosenStep& step = settings_.chosen[stand.chosen];
        const bool touches = is_here(step.touch) && stand.first > 0, lifts = is_here(step.until);
        const std::size_t first = std::max(stand.first, free);
        if (first == falls.size() || (!touches && stand.end <= first)) continue;
        const double planned = falls[stand.first].planned;
        stand.first = touches ? nearest(cycles(*step.touch), first, std::max<std::size_t>(free, 1),
                                        &Footfall::touch_cycles)
                              : first;
        stand.end = std::max(stand.end, stand.first + 1);
        if (lifts && stand.first + 1 < falls.size())
            stand.end = nearest(cycles(*step.until), stand.end, stand.first + 1, &Footfall::lift_cycles);
        for (std::size_t i = std::min(first, stand.first); i < stand.end; ++i)
            if (i != stand.first) is_left_out[i] = 1;
        Footfall& fall = falls[stand.first];
        fall.planned = planned;
        if (stand.first > first && !set.empty() && set.back().first == &falls[first].lift) {
            // The swing begins at the moment that is set, however late it ends.
            fall.lift_cycles = falls[first].lift_cycles;
            set.back().first = &fall.lift;
        }
        if (touches) keep(fall.touch, fall.touch_cycles, *step.touch);
        if (lifts && stand.end < falls.size())
            keep(falls[stand.end].lift, falls[stand.end].lift_cycles, *step.until);
        free = stand.end;
        kept.push_back(stand);
    }
    for (std::size_t i = 1; i < falls.size(); ++i) {
        Footfall& fall = falls[i];
        if (timing.shift(fall.lift_cycles) != 0.0)
            fall.lift = std::max(trajectory_.time_after(stretch, leg, timing.moved(fall.lift_cycles)), begin);
        if (timing.shift(fall.touch_cycles) != 0.0)
            fall.touch = trajectory_.time_after(stretch, leg, timing.moved(fall.touch_cycles));
    }
    for (const auto& [moment, wanted] : set) *moment = wanted;

    Footfalls rest;
    auto stand = kept.begin();
    for (std::size_t i = 0; i < falls.size(); ++i) {
        if (is_left_out[i] != 0) continue;
        const bool is_chosen = stand != kept.end() && stand->first == i;
        const bool is_whole = !is_chosen || has_times(settings_.chosen[stand->chosen]);
        std::size_t next = i + 1;
        while (next < falls.size() && is_left_out[next] != 0) ++next;
        Footfall& fall = falls[i];
        fall.until = next < falls.size() ? falls[next].lift : std::numeric_limits<double>::infinity();
        const bool goes_on = is_whole && next < falls.size();
        const double end = goes_on ? falls[next].lift_cycles : fall.touch_cycles + fall.pace.duty;
        const bool stays =
            !(goes_on && next > i + 1) && timing.shift(fall.touch_cycles) == 0.0 && timing.shift(end) == 0.0;
        if (!stays) {
            const double middle = 0.5 * (timing.moved(fall.touch_cycles) + timing.moved(end));
            stand_at(leg, stretch, trajectory_.time_after(stretch, leg, middle), fall);
        }
        if (is_chosen) {
            stand->first = rest.size();
            stand->end = rest.size() + 1;
            ++stand;
        }
        rest.push_back(fall);
    }
    falls = std::move(rest);
    stands = std::move(kept);
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
    for (std::size_t sample = trajectory_.first_sample(stretch); sample <= trajectory_.last_sample(stretch);
         ++sample) {
        if (times[sample] < from) continue;
        if (times[sample] > until) break;
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
    add_mistimed(leg, stretch, steps, found);
    std::ranges::stable_sort(found, {}, &Problem::first);
    return found;
}

void Planner::add_mistimed(std::size_t leg, std::size_t stretch, std::span<const Footstep> steps,
                           std::vector<Problem>& found) const {
    for (const std::size_t one : uncertain_[row(leg, stretch)]) {
        const ChosenStep& wanted = settings_.chosen[one];
        const auto step = std::ranges::find(steps, std::optional(one), &Footstep::chosen);
        const bool is_there = step != steps.end();
        const bool touches = is_there && step->lift < step->touch && step->touch == wanted.touch;
        const bool lifts = is_there && step + 1 != steps.end() && (step + 1)->lift == wanted.until;
        if (!has_times(wanted)) found.push_back({leg, wanted.time, wanted.time, Trouble::left_out});
        if (wanted.touch && !touches) found.push_back({leg, *wanted.touch, *wanted.touch, Trouble::no_touch});
        if (wanted.until && !lifts) found.push_back({leg, *wanted.until, *wanted.until, Trouble::no_lift});
    }
}

WalkPlan Planner::plan() {
    const std::size_t stretches = trajectory_.stretch_count();
    const std::size_t rows = hips_.size() * stretches;
    falls_.resize(rows);
    uncertain_.resize(rows);
    for_legs([&](std::size_t leg) {
        for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
            falls_[row(leg, stretch)] = footfalls(leg, stretch);
            uncertain_[row(leg, stretch)] = choose(leg, stretch, falls_[row(leg, stretch)]);
        }
    });
    dynamics::Track leans = leans_of(all_steps(false));
    correct(leans);
    if (ground_ != nullptr && !settings_.lengths.empty()) {
        // The reach of the hips is known after the body has followed the feet; then the body follows them
        // again.
        std::vector<char> has_moved(hips_.size(), 0);
        for_legs([&](std::size_t leg) {
            for (std::size_t stretch = 0; has_reach(leg) && stretch < stretches; ++stretch)
                if (move_nearer(leg, stretch, falls_[row(leg, stretch)])) has_moved[leg] = 1;
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
