// States of an integrated motion at equal intervals of time, as far as anybody has asked for. Private to the
// library.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motion.hpp"
#include "motus/core/cache.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/sine.hpp"

namespace motus::dynamics {

/// Settings of an integrated motion, in the motion's own units.
template <class System>
struct MotionSettings {
    [[nodiscard]] friend bool operator==(const MotionSettings&, const MotionSettings&) = default;

    System system;
    std::array<double, System::size> start{};
    double interval = 0.0;  ///< between nodes; below 0: backwards in time
    /// Accelerations of the pivot, along the system's axes in turn, at every `intervals_per_sample` nodes;
    /// linear between.
    std::vector<double> accelerations;
    int intervals_per_sample = 1;
};

/// Thread-safe. Answers are a function of the settings and the time, however far the table has grown.
template <class System>
class MotionTable {
    using State = std::array<double, System::size>;

  public:
    static constexpr std::size_t most_nodes = std::size_t{1} << 18U;
    /// Limit for stiff motions, whose intervals take many steps each; some seconds' work.
    static constexpr std::size_t most_steps = 8 * most_nodes;

    explicit MotionTable(MotionSettings<System> settings)
        : settings_(std::move(settings)), states_{settings_.start}, levels_{0} {
        if (!are_finite(settings_.start))
            throw std::invalid_argument("start: angles and angular velocities must be smaller");
    }

    /// The state at a time that has the sign of the interval, and less than most_nodes intervals away from
    /// the start.
    [[nodiscard]] State at(double time) const {
        const Place place = place_of(time);
        grow(place.last());
        return leave(place);
    }

    /// The tables' states at one time; they grow several at a time.
    static void at(std::span<const MotionTable* const> tables, double time, std::span<State> out) {
        std::vector<const MotionTable*> short_ones;
        for (const MotionTable* table : tables)
            if (!table->reaches(table->place_of(time).last())) short_ones.push_back(table);
        std::ranges::sort(short_ones);  // locked in one order by all threads, and each once
        short_ones.erase(std::unique(short_ones.begin(), short_ones.end()), short_ones.end());
        for (std::size_t i = 0; i < short_ones.size(); i += steps_at_once) {
            std::vector<Growth> growths;
            std::array<std::unique_lock<std::mutex>, steps_at_once> locks;
            for (std::size_t k = 0; k < std::min(steps_at_once, short_ones.size() - i); ++k) {
                const MotionTable& table = *short_ones[i + k];
                locks[k] = std::unique_lock(table.growing_);
                growths.emplace_back(table, table.place_of(time).last());
            }
            run(growths);
        }
        for (std::size_t i = 0; i < tables.size(); ++i) out[i] = tables[i]->at(time);
    }

    [[nodiscard]] std::size_t bytes() const {
        const std::shared_lock lock(states_lock_);
        return sizeof *this + states_.capacity() * node_bytes + bytes_of(settings_.accelerations);
    }

    /// Greatest size of a motion's table that has grown up to a time. Throws as at().
    [[nodiscard]] std::size_t bytes_until(double time) const {
        const std::size_t nodes = place_of(time).last() + 1;
        return sizeof *this + (nodes + nodes / spare + least_room) * node_bytes +
               bytes_of(settings_.accelerations);
    }

  private:
    struct Place {
        std::size_t node = 0;
        double rest = 0.0;  ///< from the node on

        /// The last node that the table must have: the one after the time, since a state depends on how its
        /// whole interval was integrated.
        [[nodiscard]] std::size_t last() const { return rest == 0.0 ? node : node + 1; }
    };

    /// Whether the numbers of a state are finite, and its angles so small that their sines have digits.
    [[nodiscard]] static bool are_within_bounds(const State& state) {
        return are_finite(state) &&
               std::ranges::all_of(std::span(state).first(System::size / 2),
                                   [](double angle) { return std::abs(angle) <= sine_limit; });
    }

    /// Bound of a step's tail; a step of half the length has a 256th of it. An error of the momenta becomes
    /// one of the velocities that is larger the smaller `inertia` is.
    static constexpr double largest_tail = 1e-5;
    static constexpr double needless = 1.0 / 1024.0;  ///< of the largest: half as many steps would do
    static constexpr int highest_level = 12;

    static constexpr std::size_t node_bytes = sizeof(State) + 1;
    static constexpr std::size_t spare = 8;        ///< a table has room for an 8th more than it holds,
    static constexpr std::size_t least_room = 64;  ///< and for so many

    [[nodiscard]] Place place_of(double time) const {
        const double intervals = std::floor(time / settings_.interval);
        if (!(intervals < static_cast<double>(most_nodes)))
            throw std::invalid_argument("times: must lie within the table's reach");
        Place place{static_cast<std::size_t>(std::max(intervals, 0.0)), 0.0};
        place.rest = time - static_cast<double>(place.node) * settings_.interval;
        if (place.rest * settings_.interval < 0.0) place.rest = 0.0;
        return place;
    }

    [[nodiscard]] bool reaches(std::size_t node) const {
        const std::shared_lock lock(states_lock_);
        return node < states_.size();
    }

    void grow(std::size_t node) const {
        if (reaches(node)) return;
        const std::scoped_lock lock(growing_);
        std::array<Growth, 1> growth{Growth(*this, node)};
        run(growth);
        if (reaches(node)) return;
        if (end_ == End::is_long)
            throw std::invalid_argument("times: must be nearer to 0 for so stiff a motion");
        throw std::invalid_argument("times: must not reach where the motion leaves all bounds");
    }

    /// Why a table grows no further.
    enum class End : std::uint8_t { none, is_long, leaves_bounds };

    /// Growth of a table by the steps of one interval and the next ones. Others compute the steps; this class
    /// judges them.
    class Growth {
      public:
        Growth(const MotionTable& table, std::size_t node) : table_(table), node_(node) { begin(); }

        [[nodiscard]] bool is_done() const noexcept {
            return table_.states_.size() > node_ || table_.end_ != End::none;
        }

        /// The step to be made.
        [[nodiscard]] GaussStep<System> step() {
            const double length = std::scalbn(table_.settings_.interval, -level_);
            const int count = 1 << level_;
            return {&table_.settings_.system, &state_, &table_.derivatives_, length,
                    table_.drive(table_.states_.size() - 1, static_cast<double>(made_) / count,
                                 static_cast<double>(made_ + 1) / count)};
        }

        void take(const GaussStep<System>& step) {
            table_.steps_ += step.work;
            if (table_.steps_ > most_steps) {
                table_.end_ = End::is_long;
                return;
            }
            if (!step.converged || !are_within_bounds(state_) || step.tail > table_.largest_tail_) {
                if (level_ == highest_level) {
                    table_.end_ = End::leaves_bounds;
                    return;
                }
                ++level_;
                again();
                return;
            }
            largest_ = std::max(largest_, step.tail);
            if constexpr (requires { System::settle(state_); }) System::settle(state_);
            if (++made_ < 1 << level_) return;
            table_.add(state_, level_);
            if (level_ > 0 && largest_ < needless * table_.largest_tail_) {
                --level_;
                table_.derivatives_.are_known = false;
            }
            begin();
        }

      private:
        void begin() {
            if (is_done()) {
                table_.level_ = level_;
                return;
            }
            state_ = table_.states_.back();
            made_ = 0;
            largest_ = 0.0;
        }
        void again() {
            table_.derivatives_.are_known = false;
            begin();
        }

        const MotionTable& table_;
        std::size_t node_;
        State state_{};
        int level_ = table_.level_;
        int made_ = 0;
        double largest_ = 0.0;
    };

    /// Runs at most steps_at_once growths.
    static void run(std::span<Growth> growths) {
        const MakeSteps<System> make = fastest_steps<System>();
        std::array<GaussStep<System>, steps_at_once> steps;
        std::array<Growth*, steps_at_once> busy{};
        for (;;) {
            std::size_t count = 0;
            for (Growth& growth : growths) {
                if (growth.is_done()) continue;
                steps[count] = growth.step();
                busy[count++] = &growth;
            }
            if (count == 0) return;
            make(std::span(steps).first(count));
            for (std::size_t i = 0; i < count; ++i) busy[i]->take(steps[i]);
        }
    }

    void add(const State& state, int level) const {
        const std::scoped_lock lock(states_lock_);
        if (states_.size() == states_.capacity()) {
            const std::size_t room = states_.size() + states_.size() / spare + least_room;
            states_.reserve(room);
            levels_.reserve(room);
        }
        levels_.back() = static_cast<std::uint8_t>(level);
        states_.push_back(state);
        levels_.push_back(0);
    }

    /// From a node to a time before the next one.
    [[nodiscard]] State leave(const Place& place) const {
        State state;
        int level = 0;
        {
            const std::shared_lock lock(states_lock_);
            state = states_[place.node];
            level = levels_[place.node];
        }
        if (place.rest == 0.0) return state;
        const double share = place.rest / settings_.interval;
        Derivatives<System::size> derivatives;
        // Take as many equal steps as make them at least as short as the table's.
        for (;; ++level) {
            const int count = static_cast<int>(std::ceil(std::scalbn(share, level)));
            State trial = state;
            bool is_right = true;
            derivatives.are_known = false;
            for (int i = 0; i < count && is_right; ++i) {
                std::array<GaussStep<System>, 1> step{
                    {{&settings_.system, &trial, &derivatives, place.rest / count,
                      drive(place.node, share * i / count, share * (i + 1) / count)}}};
                fastest_steps<System>()(step);
                is_right = step[0].converged;
            }
            if (is_right) return trial;
            if (level == highest_level)
                throw std::invalid_argument("times: must not reach where the motion leaves all bounds");
        }
    }

    /// The pivot's drive between two fractions of the interval that begins at a node.
    [[nodiscard]] Drive<System::axes> drive(std::size_t node, double from, double to) const {
        constexpr std::size_t axes = System::axes;
        Drive<axes> drive;
        const std::size_t samples = settings_.accelerations.size() / axes;
        const auto per_sample = static_cast<std::size_t>(settings_.intervals_per_sample);
        const std::size_t sample = node / per_sample;
        if (sample + 1 >= samples) return drive;
        const double first = static_cast<double>(node % per_sample);
        for (std::size_t axis = 0; axis < axes; ++axis) {
            const double start = settings_.accelerations[axes * sample + axis];
            const double more = settings_.accelerations[axes * (sample + 1) + axis] - start;
            drive.start[axis] = start + more * ((first + from) / settings_.intervals_per_sample);
            drive.end[axis] = start + more * ((first + to) / settings_.intervals_per_sample);
        }
        return drive;
    }

    mutable Derivatives<System::size> derivatives_;  ///< of the interval that comes next
    mutable std::mutex growing_;
    mutable std::shared_mutex states_lock_;  ///< of the two vectors, while they grow
    const MotionSettings<System> settings_;
    const double largest_tail_ = largest_tail * std::sqrt(settings_.system.inertia());
    mutable std::vector<State> states_;
    mutable std::vector<std::uint8_t> levels_;  ///< with 2 to the power of which steps the interval was made
    mutable int level_ = 0;                     ///< of the interval that comes next
    mutable std::size_t steps_ = 0;             ///< the work of those that were made, also of those in vain
    mutable End end_ = End::none;
};

}  // namespace motus::dynamics
