#include "flight_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "motus/core/numeric.hpp"
#include "motus/core/sine.hpp"
#include "surface.hpp"
#include "turbulence.hpp"

namespace motus::snow {
namespace {

constexpr float speed_range = 1.0F;  // m/s
constexpr float size_range = 0.1F;
constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr double largest_step = 0x1p-5;  // s

/// Numbers that the loops take in single precision.
[[nodiscard]] bool is_single(double value) {
    constexpr double largest = 1e30;
    return std::abs(value) <= largest;
}
[[nodiscard]] bool is_single(const glm::dvec3& v) {
    return is_single(v.x) && is_single(v.y) && is_single(v.z);
}
[[nodiscard]] bool is_between(double value, double least, double most) {
    return value >= least && value <= most;
}
[[nodiscard]] bool is_rate(double value) {
    constexpr double most = 1000.0;
    return value > 0.0 && value <= most;
}

void require_valid(const SnowSettings& s) {
    require(is_single(s.start_speed), "start_speed: must be finite");
    require(is_between(s.lifetime, 0.0, 1e30), "lifetime: must be at least 0 and finite");
    require(is_single(s.start_size), "start_size: must be finite");
    require(!s.start_color.empty(), "start_color: must have a colour");
    for (const GradientStop& stop : s.start_color)
        require(std::isfinite(stop.position) && is_finite(stop.color), "start_color: must be finite");
    require(std::ranges::is_sorted(s.start_color, {}, &GradientStop::position),
            "start_color: must have rising positions");
    require(is_between(s.cone_angle, 0.0, std::numbers::pi), "cone_angle: must be from 0 to pi");
    require(is_between(s.cone_radius, 0.0, 1e30), "cone_radius: must be at least 0 and finite");
    for (int axis = 0; axis < 2; ++axis)
        require(s.frustum_angles[axis] >= 0.0 && s.frustum_angles[axis] < 0.5 * std::numbers::pi,
                "frustum_angles: must be from 0 to less than pi / 2");
    require(is_between(s.frustum_far, 1e-6, 1e30), "frustum_far: must be at least 1e-6 and finite");
    require(is_between(s.frustum_near, 0.0, s.frustum_far), "frustum_near: must be from 0 to frustum_far");
    require(is_between(s.max_angle, -1e6, 1e6), "max_angle: must be from -1e6 to 1e6");
    require(is_rate(s.snow_frequency), "snow_frequency: must be greater than 0 and at most 1000");
    require(is_single(s.acceleration), "acceleration: must be finite");
    require(is_between(s.drag, 0.0, 1000.0), "drag: must be from 0 to 1000");
    require(is_single(s.wind), "wind: must be finite");
    require(s.wind_values.size() == s.wind_times.size(), "wind_values: must be as many as wind_times");
    require(are_finite(s.wind_times), "wind_times: must be finite");
    require(std::ranges::adjacent_find(s.wind_times, std::ranges::greater_equal{}) == s.wind_times.end(),
            "wind_times: must rise");
    for (const glm::dvec3& wind : s.wind_values) require(is_single(wind), "wind_values: must be finite");
    require(is_single(s.inherited), "inherited: must be finite");
    require(s.period == 0.0 || is_between(s.period, 1e-6, 1e30), "period: must be 0, or from 1e-6 to 1e30");
    require(is_between(s.gusts, 0.0, 1e30), "gusts: must be at least 0 and finite");
    require(is_rate(s.gust_frequency), "gust_frequency: must be greater than 0 and at most 1000");
    require(is_between(s.turbulence, 0.0, 1e6), "turbulence: must be from 0 to 1e6");
    require(is_between(s.turbulence_size, 1e-6, 1e30), "turbulence_size: must be at least 1e-6 and finite");
    require(is_between(s.tumble, 0.0, 1e6), "tumble: must be from 0 to 1e6");
    require(!s.ground || is_single(*s.ground), "ground: must be finite");
    require(s.rest_time >= 0.0, "rest_time: must be at least 0");
    require(is_between(s.melt_time, 0.0, 1e30), "melt_time: must be at least 0 and finite");
    require(is_between(s.friction, 0.0, 1e30), "friction: must be at least 0 and finite");
}

/// Between nodes of what depends on the age: a power of two, so that nodes lie at exact ages. The cubics
/// between them are then right to 1e-5 of a second's way.
[[nodiscard]] double step_for(const SnowSettings& s) {
    double step = largest_step;
    const double gusts = s.period > 0.0 ? std::max(s.gust_frequency, 1.0 / s.period) : s.gust_frequency;
    const double fastest =
        std::max({s.snow ? s.snow_frequency : 0.0, 0.25 * s.drag, s.gusts > 0.0 ? gusts : 0.0});
    while (step * fastest > largest_step) step *= 0.5;
    return step;
}

[[nodiscard]] std::array<float, 4> floats_of(const glm::vec4& v) {
    return {v.x, v.y, v.z, v.w};
}

[[nodiscard]] Frustum frustum_of(const SnowSettings& s) {
    const SineCosine<double> x = sine_cosine(s.frustum_angles.x), y = sine_cosine(s.frustum_angles.y);
    const double part = s.frustum_near / s.frustum_far;
    return {static_cast<float>(x.sine / x.cosine), static_cast<float>(y.sine / y.cosine),
            static_cast<float>(s.frustum_far), static_cast<float>(part * part * part)};
}

[[nodiscard]] Air air_of(const SnowSettings& s) {
    const glm::dvec3 acceleration = s.gravity ? s.acceleration : glm::dvec3(0.0);
    if (s.wind_times.empty()) return {acceleration, s.drag, s.wind, s.gusts, s.gust_frequency, s.period};
    return {acceleration, s.drag, s.wind_times, s.wind_values, s.gusts, s.gust_frequency, s.period};
}

[[nodiscard]] glm::dvec3 mean_wind(const SnowSettings& s) {
    if (s.wind_times.empty()) return s.wind;
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& wind : s.wind_values) sum += wind;
    return sum / static_cast<double>(s.wind_values.size());
}

/// Of the same length however fine the steps are, and twice, four times as long and so on for lives that are
/// longer than 128 s, so that a flake's way is looked at a few thousand times at most.
[[nodiscard]] double look_step_for(double longest) {
    constexpr double most = 4096.0;
    double step = largest_step;
    while (step * most < longest) step *= 2.0;
    return step;
}

/// At the nodes that flakes come to, or at the first ones of long lives.
[[nodiscard]] std::vector<Relaxation> relaxations_for(double drag, double longest, double step) {
    constexpr double most = 4096.0;
    const auto count = static_cast<std::size_t>(std::min(most, std::ceil(longest / step) + 2.0));
    std::vector<Relaxation> found(count);
    for (std::size_t i = 0; i < count; ++i) found[i] = relaxation(static_cast<double>(i) * step, drag);
    return found;
}

template <class Row>
[[nodiscard]] float* row_at(std::span<Row> rows, std::size_t index) {
    return rows.empty() ? nullptr : &rows[index][0];
}
template <>
[[nodiscard]] float* row_at(std::span<float> rows, std::size_t index) {
    return rows.empty() ? nullptr : &rows[index];
}

void write_from(const Fields& out, std::size_t index, Run& run) {
    run.position = row_at(out.position, index);
    run.velocity = row_at(out.velocity, index);
    run.size = row_at(out.size, index);
    run.color = row_at(out.color, index);
    run.age = row_at(out.age, index);
    run.rotation = row_at(out.rotation, index);
    run.id = out.id.empty() ? nullptr : &out.id[index];
}

}  // namespace

FlightModel::FlightModel(SnowSettings settings)
    : lifetime((require_valid(settings), settings.lifetime)),
      random_lifetime(settings.random_lifetime),
      births(settings.rate, settings.delay, settings.duration, settings.looping, std::move(settings.bursts),
             settings.rate_keys),
      emitter(settings.emitter_times, settings.emitter_matrices),
      air(air_of(settings)),
      step(step_for(settings)),
      relaxations(relaxations_for(settings.drag, longest(), step)),
      look_step(look_step_for(longest())) {
    const double flakes = births.most_within(longest());
    if (flakes > Snow::most_flakes) {
        constexpr double bytes = 72.0;
        std::array<char, 160> text{};
        std::snprintf(
            text.data(), text.size(),
            "rate: must be lower: up to %.3g flakes would live at once, which take %.3g GB; at most "
            "%.3g may",
            flakes, 1e-9 * bytes * flakes, Snow::most_flakes);
        throw std::invalid_argument(text.data());
    }

    kind.key = {static_cast<std::uint32_t>(settings.seed), static_cast<std::uint32_t>(settings.seed >> 32U)};
    kind.shape = settings.shape;
    kind.radius = static_cast<float>(settings.cone_radius);
    if (kind.shape == Shape::surface)
        facets = facets_of(settings.surface_positions, settings.surface_triangles);
    kind.facets = facets;
    if (kind.shape == Shape::frustum) kind.frustum = frustum_of(settings);
    kind.turns_out = settings.random_orientation && settings.cone_angle > 0.0;
    // 1 - cos(c) = 2 sin^2(c / 2), which small angles keep their digits in.
    const double half = sine_cosine(0.5 * settings.cone_angle).sine;
    kind.cone_depth = static_cast<float>(2.0 * half * half);
    kind.cone_turn = static_cast<float>(settings.cone_angle / whole_turn);
    kind.speed = static_cast<float>(settings.start_speed);
    kind.speed_range = settings.random_speed ? speed_range : 0.0F;
    kind.inherited = static_cast<float>(settings.inherited);
    kind.size = static_cast<float>(settings.start_size);
    kind.size_range = settings.random_size ? size_range : 0.0F;
    kind.random_color = settings.random_color;
    kind.first_color = floats_of(settings.start_color.front().color);
    for (std::size_t i = 1; i < settings.start_color.size(); ++i) {
        const GradientStop &from = settings.start_color[i - 1], &to = settings.start_color[i];
        constexpr float sudden = 1e30F;
        places.push_back(from.position);
        scales.push_back(std::min(sudden, 1.0F / (to.position - from.position)));
        changes.push_back(floats_of(to.color - from.color));
    }
    kind.places = places;
    kind.scales = scales;
    kind.changes = changes;
    kind.tumble = static_cast<float>(settings.tumble / whole_turn);
    kind.is_turbulent = settings.turbulence > 0.0;
    // With drag and without steering a flake soon goes with the wind alone.
    kind.carried = settings.snow || settings.drag == 0.0 ? 1.0F : 0.0F;
    if (kind.is_turbulent)
        kind.waves = waves_of(settings.turbulence, settings.turbulence_size,
                              settings.drag > 0.0 ? mean_wind(settings) : glm::dvec3(0.0), settings.seed,
                              settings.period);
    kind.snow = settings.snow;
    if (!kind.snow) return;

    kind.snow_offsets = settings.snow_offsets;
    kind.offset_count = static_cast<float>(Steering::offset_count);
    const std::size_t offsets = kind.snow_offsets ? Steering::offset_count : 0;
    // A flake's way is looked at once more after its lifetime.
    const double farthest = longest() + look_step;
    require(farthest < step * static_cast<double>(Steering::most_nodes - Steering::offset_count - 2),
            "lifetime: must be shorter for flakes that steer at this snow_frequency");
    steering.emplace(settings.max_angle, settings.snow_frequency, settings.seed, farthest, step, offsets);
}

Air::State Interval::node(double time, double index) const {
    const double age = index * step_;
    if (index < static_cast<double>(model_.relaxations.size()))
        return model_.air.at(time, age, model_.relaxations[static_cast<std::size_t>(index)]);
    return model_.air.at(time, age);
}

void Interval::set(double time, double index, Run& run) {
    if (index != index_ || time != time_) {
        // Ages fall, so that the runs of a block go from each interval to the one before.
        const bool is_next = index + 1.0 == index_ && time == time_;
        const Air::State b = is_next ? start_ : node(time, index + 1.0);
        start_ = node(time, index);
        const Air::State& a = start_;
        index_ = index;
        time_ = time;
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            drift_[at] = cubic(a.way[axis], a.way_slope[axis], b.way[axis], b.way_slope[axis], step_);
            velocity_[at] = cubic(a.velocity[axis], a.velocity_slope[axis], b.velocity[axis],
                                  b.velocity_slope[axis], step_);
        }
        const Relaxation &p = a.relaxation, &q = b.relaxation;
        way_ = cubic(p.first, p.decay, q.first, q.decay, step_);
        const auto rate = static_cast<float>(1.0 / step_);
        way_rate_ = {way_.c1 * rate, 2.0F * way_.c2 * rate, 3.0F * way_.c3 * rate, 0.0F};
    }
    run.drift = drift_;
    run.drift_velocity = velocity_;
    run.way = way_;
    run.way_rate = way_rate_;
}

Flight::Flight(const FlightModel& model) : model_(model), interval_(model), standing_(model.kind) {
    standing_.snow = standing_.snow_offsets = standing_.is_turbulent = false;
    run_.step = model.step;
}

template <class Fly>
void Flight::in_runs(double time, const double* ages, const std::uint32_t* lows, std::uint32_t high,
                     std::size_t count, const Fields& out, std::size_t index, const Fly& fly) {
    const double *age = ages, *end = ages + count;
    run_.high = high;
    while (age != end) {
        const double interval = std::floor(*age / model_.step);
        run_.start = interval * model_.step;
        const std::size_t part = model_.emitter.part_at(time - *age);
        const double part_end = model_.emitter.end_of(part);
        const double* next = std::partition_point(
            age + 1, end, [&](double other) { return other >= run_.start && time - other < part_end; });
        run_.glide = model_.emitter.glide(part, time - run_.start, model_.step);
        const auto at = static_cast<std::size_t>(age - ages);
        run_.ages = age;
        run_.lows = lows + at;
        run_.count = static_cast<std::size_t>(next - age);
        write_from(out, index + at, run_);
        fly(interval);
        age = next;
    }
}

void Flight::fill(double time, const double* ages, const std::uint32_t* lows, std::uint32_t high,
                  std::size_t count, const Fields& out, std::size_t index) {
    in_runs(time, ages, lows, high, count, out, index, [&](double interval) {
        interval_.set(time, interval, run_);
        for (std::size_t wave = 0; model_.kind.is_turbulent && wave < wave_count; ++wave) {
            run_.phases[wave] = phase_at(model_.kind.waves[wave], time - run_.start);
            run_.phase_changes[wave] = static_cast<float>(-model_.kind.waves[wave].frequency * model_.step);
        }
        if (model_.steering) model_.steering->set(static_cast<std::size_t>(interval), run_);
        model_.kernel->fill(model_.kind, run_, scratch_);
    });
}

void Flight::fill_births(double time, const double* ages, const std::uint32_t* lows, std::uint32_t high,
                         std::size_t count, const Fields& out) {
    in_runs(time, ages, lows, high, count, out, 0, [&](double /*interval*/) {
        run_.drift = run_.drift_velocity = {};
        run_.way = run_.way_rate = {};
        model_.kernel->fill(standing_, run_, scratch_);
    });
}

}  // namespace motus::snow
