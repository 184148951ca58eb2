#include "motus/dynamics/double_pendulum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motion-inl.hpp"
#include "motion_cache.hpp"
#include "motus/core/ieee_floats.hpp"
#include "motus/core/sine.hpp"
#include "units.hpp"

namespace motus::dynamics {
namespace {

void require_valid(const DoublePendulum& pendulum) {
    require(is_positive(pendulum.mass1), "mass1: must be greater than 0 and finite");
    require(is_positive(pendulum.mass2), "mass2: must be greater than 0 and finite");
    require(is_positive(pendulum.length1), "length1: must be greater than 0 and finite");
    require(is_positive(pendulum.length2), "length2: must be greater than 0 and finite");
    require(is_not_negative(pendulum.gravity), "gravity: must be at least 0 and finite");
    require(is_not_negative(pendulum.damping), "damping: must be at least 0 and finite");
    require(pendulum.most_acceleration > 0.0, "most_acceleration: must be greater than 0");
    require(pendulum.most_velocity > 0.0, "most_velocity: must be greater than 0");
}

void require_valid(const DoublePendulumState& start) {
    require(is_angle(start.theta1), "theta1: must be finite, and 1e9 at most");
    require(is_angle(start.theta2), "theta2: must be finite, and 1e9 at most");
    require(std::isfinite(start.omega1), "omega1: must be finite");
    require(std::isfinite(start.omega2), "omega2: must be finite");
}

void require_valid(std::span<const double> times) {
    require(are_finite(times), "times: must be finite");
}

[[nodiscard]] bool has_limits(const DoublePendulum& pendulum) {
    return std::isfinite(pendulum.most_acceleration) || std::isfinite(pendulum.most_velocity);
}

/// Sine and cosine of the angle between the rods.
[[nodiscard]] SineCosine<double> between_rods(double theta1, double theta2) {
    const auto [sine1, cosine1] = sine_cosine(theta1);
    const auto [sine2, cosine2] = sine_cosine(theta2);
    return {sine1 * cosine2 - cosine1 * sine2, cosine1 * cosine2 + sine1 * sine2};
}

/// Conversion between states and the systems' scaled variables.
class Scale {
  public:
    explicit Scale(const DoublePendulum& pendulum)
        : unit_(pendulum.length1, pendulum.gravity), free_(free_system(pendulum)) {}

    [[nodiscard]] const TimeUnit& unit() const noexcept { return unit_; }

    [[nodiscard]] MotionSettings<DoubleSystem> settings(const DoublePendulum& /*pendulum*/,
                                                        const DoublePendulumState& start,
                                                        const DoubleSystem& /*kind*/) const {
        const double w1 = unit_.from_rate(start.omega1);
        const double w2 = unit_.from_rate(start.omega2);
        const double cosine = between_rods(start.theta1, start.theta2).cosine;
        MotionSettings<DoubleSystem> settings;
        settings.system = free_;
        settings.start = {start.theta1, start.theta2, w1 + free_.mass * free_.length * cosine * w2,
                          w2 + cosine * w1 / free_.length};
        settings.interval = interval(w1, w2);
        return settings;
    }
    [[nodiscard]] MotionSettings<LimitedSystem> settings(const DoublePendulum& pendulum,
                                                         const DoublePendulumState& start,
                                                         const LimitedSystem& /*kind*/) const {
        MotionSettings<LimitedSystem> settings;
        settings.system = {free_, unit_.from_rate(unit_.from_rate(pendulum.most_acceleration)),
                           unit_.from_rate(pendulum.most_velocity)};
        settings.start = {start.theta1, start.theta2, unit_.from_rate(start.omega1),
                          unit_.from_rate(start.omega2)};
        settings.interval = interval(settings.start[2], settings.start[3]);
        return settings;
    }

    [[nodiscard]] DoublePendulumState state(const std::array<double, 4>& values,
                                            const DoubleSystem& /*kind*/) const {
        const auto [sine, cosine] = between_rods(values[0], values[1]);
        std::array<double, 2> velocities{};
        HWY_NAMESPACE::velocities(free_, &values[2], sine, cosine, velocities.data());
        return {values[0], values[1], unit_.to_rate(velocities[0]), unit_.to_rate(velocities[1])};
    }
    [[nodiscard]] DoublePendulumState state(const std::array<double, 4>& values,
                                            const LimitedSystem& /*kind*/) const {
        return {values[0], values[1], unit_.to_rate(values[2]), unit_.to_rate(values[3])};
    }

  private:
    [[nodiscard]] DoubleSystem free_system(const DoublePendulum& pendulum) const {
        // Uses the ratio of the masses, since the sum of the largest ones is not finite.
        const double ratio = pendulum.mass2 / pendulum.mass1;
        const double inverse = pendulum.mass1 / pendulum.mass2;
        DoubleSystem system;
        system.gravity = unit_.gravity;
        system.damping = unit_.from_rate(pendulum.damping);
        system.mass = 1.0 / (1.0 + inverse);
        system.other = 1.0 / (1.0 + ratio);
        system.length = pendulum.length2 / pendulum.length1;
        constexpr double least = 1e-12;  // beyond, the rods would swing too fast for any table
        require(system.mass > least && system.other > least, "mass2: must be comparable to mass1");
        require(system.length > least && 1.0 / system.length > least,
                "length2: must be comparable to length1");
        return system;
    }

    /// Between nodes: by the faster of the two small oscillations, and the velocities.
    [[nodiscard]] double interval(double w1, double w2) const {
        const double small = std::sqrt(free_.gravity * (1.0 + 1.0 / free_.length) / free_.other);
        return interval_for(std::max({small, std::abs(w1), std::abs(w2)}));
    }

    TimeUnit unit_;
    DoubleSystem free_;
};

template <class System>
void integrate(const DoublePendulum& pendulum, const DoublePendulumState& start, const PivotMotion* pivot,
               std::span<const double> times, std::span<DoublePendulumState> out) {
    const Scale scale(pendulum);
    MotionSettings<System> settings = scale.settings(pendulum, start, System{});
    if (pivot != nullptr) drive(settings, *pivot, scale.unit(), pendulum.length1);
    Motion<System> motion(std::move(settings));
    // Nothing is written before all states are known, since any of the times may have none.
    std::vector<DoublePendulumState> states;
    states.reserve(times.size());
    for (const double time : times)
        states.push_back(scale.state(motion.at(scale.unit().from_seconds(time)), System{}));
    std::ranges::copy(states, out.begin());
}

void integrate(const DoublePendulum& pendulum, const DoublePendulumState& start, const PivotMotion* pivot,
               std::span<const double> times, std::span<DoublePendulumState> out) {
    require_valid(pendulum);
    require_valid(start);
    require_valid(times);
    require(times.size() == out.size(), "out: must have a state for each time");
    const auto run = has_limits(pendulum) ? &integrate<LimitedSystem> : &integrate<DoubleSystem>;
    in_ieee_floats([&] { run(pendulum, start, pivot, times, out); });
}

template <class System>
void integrate_many(const DoublePendulum& pendulum, std::span<const DoublePendulumState> starts,
                    const PivotMotion* pivot, double time, std::span<DoublePendulumState> out) {
    if (starts.size() > most_tables_together) throw std::invalid_argument("starts: must be fewer");
    const Scale scale(pendulum);
    const double at = scale.unit().from_seconds(time);
    std::vector<Motion<System>> motions;
    std::vector<const MotionTable<System>*> tables;
    motions.reserve(starts.size());
    std::size_t bytes = 0;
    for (const DoublePendulumState& start : starts) {
        MotionSettings<System> settings = scale.settings(pendulum, start, System{});
        if (pivot != nullptr) drive(settings, *pivot, scale.unit(), pendulum.length1);
        Motion<System>& motion = motions.emplace_back(std::move(settings));
        tables.push_back(&motion.table(at < 0.0));
        bytes += motion.bytes_until(at);
        if (bytes > most_bytes_together)
            throw std::invalid_argument("time: must be nearer to 0 for so many pendulums");
    }
    std::vector<std::array<double, System::size>> states(starts.size());
    MotionTable<System>::at(tables, at, states);
    for (std::size_t i = 0; i < starts.size(); ++i) out[i] = scale.state(states[i], System{});
}

void integrate_many(const DoublePendulum& pendulum, std::span<const DoublePendulumState> starts,
                    const PivotMotion* pivot, double time, std::span<DoublePendulumState> out) {
    require_valid(pendulum);
    for (const DoublePendulumState& start : starts) require_valid(start);
    require(std::isfinite(time), "time: must be finite");
    require(starts.size() == out.size(), "out: must have a state for each start");
    const auto run = has_limits(pendulum) ? &integrate_many<LimitedSystem> : &integrate_many<DoubleSystem>;
    try {
        in_ieee_floats([&] { run(pendulum, starts, pivot, time, out); });
    } catch (const std::invalid_argument& problem) {
        // What is asked of tables is `times` in their sentences.
        const std::string_view sentence = problem.what();
        constexpr std::string_view plural = "times: ";
        if (!sentence.starts_with(plural)) throw;
        throw std::invalid_argument("time: " + std::string(sentence.substr(plural.size())));
    }
}

}  // namespace

void double_pendulum(const DoublePendulum& pendulum, const DoublePendulumState& start,
                     std::span<const double> times, std::span<DoublePendulumState> out) {
    integrate(pendulum, start, nullptr, times, out);
}

void double_pendulum(const DoublePendulum& pendulum, const DoublePendulumState& start,
                     const PivotMotion& pivot, std::span<const double> times,
                     std::span<DoublePendulumState> out) {
    integrate(pendulum, start, &pivot, times, out);
}

void double_pendulums(const DoublePendulum& pendulum, std::span<const DoublePendulumState> starts,
                      double time, std::span<DoublePendulumState> out) {
    integrate_many(pendulum, starts, nullptr, time, out);
}

void double_pendulums(const DoublePendulum& pendulum, std::span<const DoublePendulumState> starts,
                      const PivotMotion& pivot, double time, std::span<DoublePendulumState> out) {
    integrate_many(pendulum, starts, &pivot, time, out);
}

double longest_time(const DoublePendulum& pendulum, const DoublePendulumState& start) {
    require_valid(pendulum);
    require_valid(start);
    const Scale scale(pendulum);
    const double interval = scale.settings(pendulum, start, DoubleSystem{}).interval;
    constexpr auto nodes = static_cast<double>(MotionTable<DoubleSystem>::most_nodes);
    return scale.unit().to_seconds(interval * nodes);
}

double energy(const DoublePendulum& pendulum, const DoublePendulumState& state) {
    require_valid(pendulum);
    require_valid(state);
    const double v1 = pendulum.length1 * state.omega1;
    const double v2 = pendulum.length2 * state.omega2;
    const double height1 = -pendulum.length1 * std::cos(state.theta1);
    const double height2 = height1 - pendulum.length2 * std::cos(state.theta2);
    const double square = v1 * v1 + v2 * v2 + 2.0 * v1 * v2 * std::cos(state.theta1 - state.theta2);
    const double joules = 0.5 * (pendulum.mass1 * v1 * v1 + pendulum.mass2 * square) +
                          pendulum.gravity * (pendulum.mass1 * height1 + pendulum.mass2 * height2);
    require(std::isfinite(joules), "state: must be one of an energy that is no larger than numbers are");
    return joules;
}

}  // namespace motus::dynamics
