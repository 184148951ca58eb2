#include "motus/snow/snow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "air.hpp"
#include "emitter.hpp"
#include "kernel.hpp"
#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/sine.hpp"
#include "motus/core/unfilled.hpp"
#include "steering.hpp"
#include "surface.hpp"
#include "turbulence.hpp"

namespace motus::snow {
namespace {

constexpr double lifetime_range = 1.0;  // s
constexpr float speed_range = 1.0F;     // m/s
constexpr float size_range = 0.1F;
constexpr double whole_turn = 2.0 * std::numbers::pi;

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

void require_valid(const Settings& s) {
    require(is_single(s.start_speed), "start_speed must be finite");
    require(is_between(s.lifetime, 0.0, 1e30), "lifetime must be at least 0 and finite");
    require(is_single(s.start_size), "start_size must be finite");
    require(!s.start_color.empty(), "start_color must have a colour");
    for (const GradientStop& stop : s.start_color)
        require(std::isfinite(stop.position) && is_finite(stop.color), "start_color must be finite");
    require(std::ranges::is_sorted(s.start_color, {}, &GradientStop::position),
            "start_color must have rising positions");
    require(is_between(s.cone_angle, 0.0, std::numbers::pi), "cone_angle must be from 0 to pi");
    require(is_between(s.cone_radius, 0.0, 1e30), "cone_radius must be at least 0 and finite");
    require(is_single(s.max_angle), "max_angle must be finite");
    require(is_rate(s.snow_frequency), "snow_frequency must be greater than 0 and at most 1000");
    require(is_single(s.acceleration), "acceleration must be finite");
    require(is_between(s.drag, 0.0, 1000.0), "drag must be from 0 to 1000");
    require(is_single(s.wind), "wind must be finite");
    require(is_between(s.gusts, 0.0, 1e30), "gusts must be at least 0 and finite");
    require(is_rate(s.gust_frequency), "gust_frequency must be greater than 0 and at most 1000");
    require(is_between(s.turbulence, 0.0, 1e6), "turbulence must be from 0 to 1e6");
    require(is_between(s.turbulence_size, 1e-6, 1e30), "turbulence_size must be at least 1e-6 and finite");
    require(is_between(s.tumble, 0.0, 1e6), "tumble must be from 0 to 1e6");
}

/// Between nodes of what depends on the age: a power of two, so that nodes lie at exact ages. The cubics
/// between them are then right to 1e-5 of a second's way.
[[nodiscard]] double step_for(const Settings& s) {
    double step = 0x1p-5;
    const double fastest =
        std::max({s.snow ? s.snow_frequency : 0.0, 0.25 * s.drag, s.gusts > 0.0 ? s.gust_frequency : 0.0});
    while (step * fastest > 0x1p-5) step *= 0.5;
    return step;
}

[[nodiscard]] std::array<float, 4> floats_of(const glm::vec4& v) {
    return {v.x, v.y, v.z, v.w};
}

}  // namespace

struct Snow::Parts {
    explicit Parts(Settings settings);

    [[nodiscard]] double longest() const { return lifetime + (random_lifetime ? lifetime_range : 0.0); }

    double lifetime;
    bool random_lifetime;
    Births births;
    Emitter emitter;
    Air air;
    double step;
    Kind kind;
    std::vector<Facet> facets;
    std::vector<float> places, scales;
    std::vector<std::array<float, 4>> changes;
    std::optional<Steering> steering;
    const Kernel* kernel = kernels().back();
};

Snow::Parts::Parts(Settings settings)
    : lifetime((require_valid(settings), settings.lifetime)),
      random_lifetime(settings.random_lifetime),
      births(settings.rate, settings.delay, settings.duration, settings.looping, std::move(settings.bursts)),
      emitter(settings.emitter_times, settings.emitter_matrices),
      air(settings.gravity ? settings.acceleration : glm::dvec3(0.0), settings.drag, settings.wind,
          settings.gusts, settings.gust_frequency),
      step(step_for(settings)) {
    const double flakes = births.most_within(longest());
    if (flakes > most_flakes) {
        constexpr double bytes = 72.0;
        std::array<char, 160> text{};
        std::snprintf(text.data(), text.size(),
                      "rate must be lower: up to %.3g flakes would live at once, which take %.3g GB; at most "
                      "%.3g may",
                      flakes, 1e-9 * bytes * flakes, most_flakes);
        throw std::invalid_argument(text.data());
    }

    kind.key = {static_cast<std::uint32_t>(settings.seed), static_cast<std::uint32_t>(settings.seed >> 32U)};
    kind.shape = settings.shape;
    kind.radius = static_cast<float>(settings.cone_radius);
    if (kind.shape == Shape::surface)
        facets = facets_of(settings.surface_positions, settings.surface_triangles);
    kind.facets = facets;
    kind.turns_out = settings.random_orientation && settings.cone_angle > 0.0;
    // 1 - cos(c) = 2 sin^2(c / 2), which small angles keep their digits in.
    const double half = lane(sine_cosine(Pair(0.5 * settings.cone_angle)).sine, 0);
    kind.cone_depth = static_cast<float>(2.0 * half * half);
    kind.cone_turn = static_cast<float>(settings.cone_angle / whole_turn);
    kind.speed = static_cast<float>(settings.start_speed);
    kind.speed_range = settings.random_speed ? speed_range : 0.0F;
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
                              settings.drag > 0.0 ? settings.wind : glm::dvec3(0.0), settings.seed);
    kind.snow = settings.snow;
    if (!kind.snow) return;

    kind.snow_offsets = settings.snow_offsets;
    kind.offset_count = static_cast<float>(Steering::offset_count);
    const std::size_t offsets = kind.snow_offsets ? Steering::offset_count : 0;
    require(longest() < step * static_cast<double>(Steering::most_nodes - Steering::offset_count - 2),
            "lifetime must be shorter for flakes that steer at this snow_frequency");
    steering.emplace(settings.max_angle, settings.snow_frequency, settings.seed, longest(), step, offsets);
}

namespace {

constexpr std::size_t padding = 16;  // loops run over whole vectors

/// The living flakes of a block, and what the runs in it need.
class Block {
  public:
    explicit Block(const Births& births, double lifetime, bool random_lifetime, const Kind& kind,
                   const Kernel& kernel)
        : births_(births),
          lifetime_(lifetime),
          random_lifetime_(random_lifetime),
          kind_(kind),
          kernel_(kernel) {}

    /// Those of numbers from first to last, all in one block of block_size.
    void take(double time, std::uint64_t first, std::uint64_t last) {
        count_ = 0;
        auto piece = std::ranges::upper_bound(births_.pieces(), first, {}, &Births::Piece::first);
        for (--piece; first < last; ++piece) {
            const std::uint64_t until = std::min(last, piece->last);
            const auto length = static_cast<std::size_t>(until - first);
            double* to = ages_.data() + count_;
            if (piece->is_burst)
                std::fill_n(to, length, time - piece->burst);
            else
                kernel_.ages(time, births_.delay(), births_.rate(), piece->streamed + (first - piece->first),
                             length, to);
            for (std::size_t i = 0; i < length; ++i)
                lows_[count_ + i] = static_cast<std::uint32_t>(first + i);
            high_ = static_cast<std::uint32_t>(first >> 32U);
            count_ += length;
            first = until;
        }
        pad();
        if (!random_lifetime_ || ages_[0] < lifetime_ - lifetime_range) return;
        keep_living();
        if (count_ > 0) pad();
    }

    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// Falling.
    [[nodiscard]] const double* ages() const noexcept { return ages_.data(); }
    [[nodiscard]] const std::uint32_t* lows() const noexcept { return lows_.data(); }
    [[nodiscard]] std::uint32_t high() const noexcept { return high_; }

  private:
    void pad() {
        std::fill_n(ages_.data() + count_, padding, ages_[count_ - 1]);
        std::fill_n(lows_.data() + count_, padding, lows_[count_ - 1]);
    }

    void keep_living() {
        Unfilled<float, block_size> draws;
        kernel_.lives(kind_.key, high_, lows_.data(), count_, draws.data());
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            ages_[kept] = ages_[i];
            lows_[kept] = lows_[i];
            const double life = lifetime_ + lifetime_range * static_cast<double>(draws[i]);
            kept += ages_[i] < life ? 1 : 0;
        }
        count_ = kept;
    }

    const Births& births_;
    double lifetime_;
    bool random_lifetime_;
    const Kind& kind_;
    const Kernel& kernel_;
    Unfilled<double, block_size + padding> ages_;
    Unfilled<std::uint32_t, block_size + padding> lows_;
    std::uint32_t high_ = 0;
    std::size_t count_ = 0;
};

/// Calls work(block, first, last) for the numbers of each block, of the parts that are given.
[[nodiscard]] std::size_t blocks_of(const Living& living) {
    if (living.first == living.last) return 0;
    return static_cast<std::size_t>((living.last - 1) / block_size - living.first / block_size + 1);
}
[[nodiscard]] std::pair<std::uint64_t, std::uint64_t> numbers_of(const Living& living, std::size_t block) {
    const std::uint64_t start = (living.first / block_size + block) * block_size;
    return {std::max(living.first, start), std::min(living.last, start + block_size)};
}

/// The air's and the way's cubics over one interval of ages, kept for the runs that follow in it.
class Interval {
  public:
    Interval(const Air& air, double time, double step) : air_(air), time_(time), step_(step) {}

    /// Sets what the run has of them.
    void set(double index, Run& run) {
        if (index != index_) {
            index_ = index;
            const Air::State a = air_.at(time_, index * step_), b = air_.at(time_, (index + 1.0) * step_);
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

  private:
    const Air& air_;
    double time_;
    double step_;
    double index_ = -1.0;
    std::array<Cubic, 3> drift_{}, velocity_{};
    Cubic way_, way_rate_;
};

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

Snow::Snow(Settings settings)
    : parts_(in_ieee_floats([&] { return std::make_unique<const Parts>(std::move(settings)); })) {}
Snow::~Snow() = default;
Snow::Snow(Snow&& other) noexcept = default;
Snow& Snow::operator=(Snow&& other) noexcept = default;

Living Snow::living(double time, std::size_t threads) const {
    require(std::isfinite(time), "time must be finite");
    const Parts& parts = *parts_;
    return in_ieee_floats([&] {
        Living living{time, parts.births.count_older(time, parts.longest()), parts.births.count(time)};
        living.count = static_cast<std::size_t>(living.last - living.first);
        if (!parts.random_lifetime) return living;
        std::vector<std::size_t> counts(blocks_of(living) + 1);
        in_parts(
            counts.size() - 1, 256,
            [&](std::size_t from, std::size_t to) {
                Block block(parts.births, parts.lifetime, true, parts.kind, *parts.kernel);
                for (std::size_t i = from; i < to; ++i) {
                    const auto [first, last] = numbers_of(living, i);
                    block.take(time, first, last);
                    counts[i + 1] = block.count();
                }
            },
            threads);
        for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
        living.count = counts.back();
        living.before = std::move(counts);
        return living;
    });
}

void Snow::evaluate(const Living& living, const Fields& out, std::size_t threads) const {
    const auto fits = [&](const auto& field) { return field.empty() || field.size() == living.count; };
    require(fits(out.position) && fits(out.velocity) && fits(out.size) && fits(out.color) && fits(out.age) &&
                fits(out.rotation) && fits(out.id),
            "out must have a row for each living flake");
    const Parts& parts = *parts_;
    const auto fill = [&](std::size_t from, std::size_t to) {
        Block block(parts.births, parts.lifetime, parts.random_lifetime, parts.kind, *parts.kernel);
        Interval interval(parts.air, living.time, parts.step);
        Unfilled<float, scratch_size> scratch;
        Run run;
        run.step = parts.step;
        for (std::size_t i = from; i < to; ++i) {
            const auto [first, last] = numbers_of(living, i);
            block.take(living.time, first, last);
            const std::size_t before =
                living.before.empty() ? static_cast<std::size_t>(first - living.first) : living.before[i];
            const double *age = block.ages(), *end = age + block.count();
            run.high = block.high();
            while (age != end) {
                const double index = std::floor(*age / parts.step);
                run.start = index * parts.step;
                const std::size_t part = parts.emitter.part_at(living.time - *age);
                const double part_end = parts.emitter.end_of(part);
                const double* next = std::partition_point(age + 1, end, [&](double other) {
                    return other >= run.start && living.time - other < part_end;
                });
                run.glide = parts.emitter.glide(part, living.time - run.start, parts.step);
                interval.set(index, run);
                for (std::size_t wave = 0; parts.kind.is_turbulent && wave < wave_count; ++wave) {
                    run.phases[wave] = phase_at(parts.kind.waves[wave], living.time - run.start);
                    run.phase_changes[wave] =
                        static_cast<float>(-parts.kind.waves[wave].frequency * parts.step);
                }
                if (parts.steering) {
                    run.origin = &parts.steering->node(0);
                    run.node = &parts.steering->node(static_cast<std::size_t>(index));
                }
                const auto at = static_cast<std::size_t>(age - block.ages());
                run.ages = age;
                run.lows = block.lows() + at;
                run.count = static_cast<std::size_t>(next - age);
                write_from(out, before + at, run);
                parts.kernel->fill(parts.kind, run, scratch.data());
                age = next;
            }
        }
    };
    constexpr std::size_t grain = 32;  // of blocks: some 50 us
    in_ieee_floats([&] { in_parts(blocks_of(living), grain, fill, threads); });
}

}  // namespace motus::snow
