// Steps that are chosen by hand: which stands they are, and how the plan makes room for those that are timed.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motus/core/numeric.hpp"
#include "plan.hpp"

namespace motus::walker {
namespace {

[[nodiscard]] bool has_times(const ChosenStep& step) {
    return step.touch.has_value() || step.until.has_value();
}

/// Which moments of a chosen step its foot keeps.
struct Kept {
    bool touch = false, until = false;
};

/// Finds the moments that chosen steps have in the footfalls or steps of a row.
template <class Steps>
class KeptMoments {
  public:
    explicit KeptMoments(const Steps& steps) : steps_(steps) {
        for (std::size_t i = 0; i < steps.size(); ++i)
            if (steps[i].chosen) places_.emplace_back(*steps[i].chosen, i);
        std::ranges::sort(places_);
    }
    /// chosen: index in WalkSettings::chosen.
    [[nodiscard]] Kept of(std::size_t chosen, const std::optional<double>& touch,
                          const std::optional<double>& until) const {
        const auto place = std::ranges::lower_bound(places_, std::pair(chosen, std::size_t(0)));
        if (place == places_.end() || place->first != chosen) return {};
        const std::size_t at = place->second;
        return {steps_[at].lift < steps_[at].touch && steps_[at].touch == touch,
                at + 1 < steps_.size() && steps_[at + 1].lift == until};
    }

  private:
    const Steps& steps_;
    std::vector<std::pair<std::size_t, std::size_t>> places_;  ///< of chosen steps
};

}  // namespace

void Planner::sort_chosen() {
    const std::vector<double>& times = trajectory_.way().times;
    chosen_.resize(trajectory_.way().rest.size() * trajectory_.stretch_count());
    for (std::size_t one = 0; one < settings_.chosen.size(); ++one) {
        const ChosenStep& step = settings_.chosen[one];
        const std::size_t stretch = trajectory_.stretch_at(step.time);
        const double begin = times[trajectory_.first_sample(stretch)];
        const auto here = [&](const std::optional<double>& moment) {
            const bool is_here = moment && *moment >= begin && trajectory_.stretch_at(*moment) == stretch;
            return is_here ? moment : std::nullopt;
        };
        chosen_[row(step.leg, stretch)].push_back(one);
        moments_.push_back({here(step.touch), here(step.until)});
    }
}

bool Planner::is_timed(std::size_t of_row) const {
    return std::ranges::any_of(chosen_[of_row], [&](std::size_t one) { return has_moments(one); });
}

std::size_t Planner::happening(std::size_t stretch, const Footfalls& falls) const {
    std::size_t count = falls.size();
    if (stretch + 1 == trajectory_.stretch_count()) return count;
    const double jump = trajectory_.way().times[trajectory_.first_sample(stretch + 1)];
    while (count > 1 && falls[count - 1].lift >= jump) --count;
    return count;
}

std::vector<Planner::ChosenStand> Planner::chosen_stands(std::size_t leg, std::size_t stretch,
                                                         const Footfalls& falls) const {
    const std::vector<std::size_t>& chosen = chosen_[row(leg, stretch)];
    if (chosen.empty()) return {};
    // Footfalls between which there is no step are one stand, which is chosen as a whole.
    std::vector<std::size_t> stands;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        const bool goes_on = i > 0 && length_of(falls[i].place.point - falls[stands.back()].place.point) <=
                                          least_step(falls[i]);
        stands.push_back(goes_on ? stands.back() : i);
    }
    // A footfall is chosen by times from its lift on. Next to a jump its planned time, which is kept within
    // the stretch, may lie outside, but always chooses it.
    std::vector<double> from;
    for (std::size_t i = 0; i < happening(stretch, falls); ++i) {
        const double after =
            i > 0 ? std::nextafter(falls[i - 1].planned, std::numeric_limits<double>::infinity())
                  : falls[i].lift;
        from.push_back(std::min(std::max(falls[i].lift, after), falls[i].planned));
    }
    std::vector<ChosenStand> found;
    for (const std::size_t one : chosen) {
        const auto after = std::ranges::upper_bound(from, settings_.chosen[one].time);
        const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - from.begin() - 1, 0));
        const auto end = std::ranges::upper_bound(stands, stands[at]);
        found.push_back({one, stands[at], static_cast<std::size_t>(end - stands.begin())});
    }
    std::ranges::stable_sort(found, {}, &ChosenStand::first);
    std::vector<ChosenStand> last;
    for (const ChosenStand& stand : found) {
        if (!last.empty() && last.back().first == stand.first)
            last.back() = stand;
        else
            last.push_back(stand);
    }
    return last;
}

std::vector<std::size_t> Planner::choose(std::size_t leg, std::size_t stretch, Footfalls& falls) const {
    std::vector<ChosenStand> stands = chosen_stands(leg, stretch, falls);
    const std::vector<ChosenStand> wanted = stands;
    if (is_timed(row(leg, stretch))) {
        Room room = room_for(leg, stretch, falls, stands);
        const Timing timing = set_moments(leg, stretch, falls, room);
        close_up(leg, stretch, falls, room, timing);
        stands = std::move(room.stands);
    }
    std::vector<std::size_t> uncertain;
    auto left = stands.begin();
    for (const ChosenStand& stand : wanted) {
        const bool is_left = left != stands.end() && left->chosen == stand.chosen;
        if (is_left) ++left;
        if (!is_left || has_times(settings_.chosen[stand.chosen])) uncertain.push_back(stand.chosen);
    }
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

Planner::Room Planner::room_for(std::size_t leg, std::size_t stretch, Footfalls& falls,
                                const std::vector<ChosenStand>& stands) const {
    const auto nearest = [&](double time, std::size_t from, std::size_t least, double Footfall::*moment) {
        const double wanted = trajectory_.cycles(stretch, leg, time);
        const auto apart = [&](std::size_t i) { return std::abs(falls[i].*moment - wanted); };
        std::size_t at = std::clamp(from, least, falls.size() - 1);
        while (at + 1 < falls.size() && apart(at + 1) < apart(at)) ++at;
        while (at > least && apart(at - 1) < apart(at)) --at;
        return at;
    };
    Room room;
    room.is_left_out.resize(falls.size());
    std::size_t free = 0;  // the footfalls before are taken by stands
    for (ChosenStand stand : stands) {
        const Moments& moments = moments_[stand.chosen];
        const bool touches = moments.touch && stand.first > 0;
        const std::size_t first = std::max(stand.first, free);
        if (first == falls.size() || (!touches && stand.end <= first)) continue;
        const double planned = falls[stand.first].planned;
        stand.first =
            touches ? nearest(*moments.touch, first, std::max<std::size_t>(free, 1), &Footfall::touch_cycles)
                    : first;
        stand.end = std::max(stand.end, stand.first + 1);
        if (moments.until && stand.first + 1 < falls.size())
            stand.end = nearest(*moments.until, stand.end, stand.first + 1, &Footfall::lift_cycles);
        for (std::size_t i = std::min(first, stand.first); i < stand.end; ++i)
            if (i != stand.first) room.is_left_out[i] = 1;
        Footfall& fall = falls[stand.first];
        fall.planned = planned;
        if (stand.first > first && !room.moments.empty() && room.moments.back().fall == first) {
            // The swing begins at the moment that is set, however late it ends.
            fall.lift_cycles = falls[first].lift_cycles;
            room.moments.back().fall = stand.first;
        }
        if (touches)
            room.moments.push_back({stand.first, &Footfall::touch, fall.touch_cycles, *moments.touch});
        if (moments.until && stand.end < falls.size())
            room.moments.push_back(
                {stand.end, &Footfall::lift, falls[stand.end].lift_cycles, *moments.until});
        free = stand.end;
        room.stands.push_back(stand);
    }
    return room;
}

Timing Planner::set_moments(std::size_t leg, std::size_t stretch, Footfalls& falls, const Room& room) const {
    const double begin = trajectory_.way().times[trajectory_.first_sample(stretch)];
    Timing timing;
    std::vector<SetMoment> set;
    for (const SetMoment& one : room.moments)
        if (timing.set(one.planned, trajectory_.cycles(stretch, leg, one.time))) set.push_back(one);
    for (std::size_t i = 1; i < falls.size(); ++i) {
        Footfall& fall = falls[i];
        if (timing.shift(fall.lift_cycles) != 0.0)
            fall.lift = std::max(trajectory_.time_after(stretch, leg, timing.moved(fall.lift_cycles)), begin);
        if (timing.shift(fall.touch_cycles) != 0.0)
            fall.touch = trajectory_.time_after(stretch, leg, timing.moved(fall.touch_cycles));
    }
    for (const SetMoment& one : set) falls[one.fall].*one.moment = one.time;
    return timing;
}

void Planner::close_up(std::size_t leg, std::size_t stretch, Footfalls& falls, Room& room,
                       const Timing& timing) const {
    Footfalls rest;
    auto stand = room.stands.begin();
    for (std::size_t i = 0; i < falls.size(); ++i) {
        if (room.is_left_out[i] != 0) continue;
        const bool is_chosen = stand != room.stands.end() && stand->first == i;
        const bool is_whole = !is_chosen || has_moments(stand->chosen);
        std::size_t next = i + 1;
        while (next < falls.size() && room.is_left_out[next] != 0) ++next;
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
}

bool Planner::refuse_missed(std::size_t of_row) {
    if (!is_timed(of_row)) return false;
    const std::vector<Footstep> steps = steps_of(falls_[of_row], false);
    const KeptMoments in_steps(steps);
    const KeptMoments in_falls(falls_[of_row]);
    std::vector<std::optional<double>*> missed, vain;
    for (const std::size_t one : chosen_[of_row]) {
        Moments& moments = moments_[one];
        const Kept kept = in_steps.of(one, moments.touch, moments.until);
        const Kept set = in_falls.of(one, moments.touch, moments.until);
        if (moments.touch && !kept.touch) (set.touch ? vain : missed).push_back(&moments.touch);
        if (moments.until && !kept.until) (set.until ? vain : missed).push_back(&moments.until);
    }
    // What was set in vain, as no step has come of it, may be why others could not be set.
    for (std::optional<double>* moment : vain.empty() ? missed : vain) moment->reset();
    return !missed.empty() || !vain.empty();
}

void Planner::add_mistimed(std::size_t of_row, std::span<const Footstep> steps,
                           std::vector<Problem>& found) const {
    const KeptMoments in_steps(steps);
    for (const std::size_t one : uncertain_[of_row]) {
        const ChosenStep& step = settings_.chosen[one];
        const Kept kept = in_steps.of(one, step.touch, step.until);
        if (!has_times(step)) found.push_back({step.leg, step.time, step.time, Trouble::left_out});
        if (step.touch && !kept.touch)
            found.push_back({step.leg, *step.touch, *step.touch, Trouble::no_touch});
        if (step.until && !kept.until)
            found.push_back({step.leg, *step.until, *step.until, Trouble::no_lift});
    }
}

}  // namespace motus::walker
