#include "kernel.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "motus/core/instruction_sets.hpp"

// By this the file is compiled once for each of Highway's targets, and what is not of one of them at the end.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "draws-inl.hpp"
#include "flight-inl.hpp"
#include "lanes-inl.hpp"
#include "rotations-inl.hpp"
#include "shapes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::snow::HWY_NAMESPACE {
namespace {

// Loops over scratch rows run over `n`, a multiple of all lanes; those that write results over `count`.

void stream_ages(double time, double delay, double rate, std::uint64_t streamed, std::size_t count,
                 double* out) {
    const auto before = static_cast<double>(streamed + 1);
    for (std::size_t i = 0; i < count; ++i)
        out[i] = time - (delay + (before + static_cast<double>(static_cast<std::int32_t>(i))) / rate);
}

void set_ages(const Run& run, std::size_t n, Scratch& rows) {
    const Doubles start = hn::Set(as_doubles, run.start), per_step = hn::Set(as_doubles, 1.0 / run.step);
    for (std::size_t i = 0; i < n; i += double_lanes) {
        const Doubles age = hn::LoadU(as_doubles, run.ages + i);
        hn::Store(hn::DemoteTo(as_half_floats, age), as_half_floats, rows.age.data() + i);
        hn::Store(hn::DemoteTo(as_half_floats, (age - start) * per_step), as_half_floats, rows.u.data() + i);
    }
}

void write_sizes(const Kind& kind, const Run& run, const Scratch& rows) {
    for (std::size_t i = 0; i < run.count; i += lanes) {
        const Floats by = floats(1.0F) + floats(kind.size_range) * spread(load(rows.size, i));
        write(run.size, i, run.count, floats(kind.size) * by);
    }
}

struct Colors {
    Floats r, g, b, a;
};

HWY_INLINE Colors colors(const std::array<float, 4>& one) {
    return {floats(one[0]), floats(one[1]), floats(one[2]), floats(one[3])};
}

void write_color(const Kind& kind, const Run& run) {
    const std::array<float, 4> color = kind.first_color;
    for (std::size_t i = 0; i < run.count; ++i) std::ranges::copy(color, run.color + color.size() * i);
}

void write_random_colors(const Kind& kind, const Run& run, const Scratch& rows) {
    const Colors first = colors(kind.first_color);
    for (std::size_t i = 0; i < run.count; i += lanes) {
        const Floats drawn = load(rows.color, i);
        Colors all = first;
        for (std::size_t stop = 0; stop < kind.places.size(); ++stop) {
            const Floats beyond = (drawn - floats(kind.places[stop])) * floats(kind.scales[stop]);
            const Floats part = hn::Min(hn::Max(beyond, floats(0.0F)), floats(1.0F));
            const Colors change = colors(kind.changes[stop]);
            all = {all.r + part * change.r, all.g + part * change.g, all.b + part * change.b,
                   all.a + part * change.a};
        }
        write(run.color, i, run.count, all.r, all.g, all.b, all.a);
    }
}

void write_ids(const Run& run) {
    const auto upper = static_cast<std::int64_t>(run.high) << 32U;
    for (std::size_t i = 0; i < run.count; ++i) run.id[i] = upper | static_cast<std::int64_t>(run.lows[i]);
}

void fill(const Kind& kind, const Run& run, Scratch& rows) {
    constexpr std::size_t step = 16;
    const std::size_t n = (run.count + step - 1) / step * step;
    const bool heads = run.position != nullptr || run.velocity != nullptr || run.rotation != nullptr;
    const bool has_sizes = run.size != nullptr && kind.size_range > 0.0F;
    const bool has_colors = run.color != nullptr && kind.random_color;

    if (has_sizes || (heads && kind.speed_range > 0.0F))
        draw(kind, run, Stream::place, n, rows.x, rows.y, rows.speed, rows.size);
    else if (heads)
        draw(kind, run, Stream::place, n, rows.x, rows.y);
    if (has_colors || (heads && kind.turns_out))
        draw(kind, run, Stream::life, n, rows.life, rows.color, rows.tilt, rows.turn);
    if (heads && (kind.snow_offsets || kind.shape == Shape::box || kind.shape == Shape::sphere ||
                  kind.shape == Shape::surface || kind.shape == Shape::frustum))
        draw(kind, run, Stream::depth, n, rows.one, rows.two, rows.three, rows.offset);
    if (heads || run.age != nullptr) set_ages(run, n, rows);

    if (heads) {
        leave(kind, n, rows);
        if (run.rotation != nullptr) write_rotations(kind, run, n, rows);
        to_world(kind, run, n, rows);
    }
    if (run.position != nullptr) go<false>(kind, run, n, rows, run.position);
    if (run.velocity != nullptr) go<true>(kind, run, n, rows, run.velocity);
    if (has_sizes)
        write_sizes(kind, run, rows);
    else if (run.size != nullptr)
        std::fill_n(run.size, run.count, kind.size);
    if (has_colors)
        write_random_colors(kind, run, rows);
    else if (run.color != nullptr)
        write_color(kind, run);
    if (run.age != nullptr) std::copy_n(rows.age.data(), run.count, run.age);
    if (run.id != nullptr) write_ids(run);
}

constexpr Kernel kernel{HWY_STR(HWY_NAMESPACE), &stream_ages, &draw_lives, &fill};

}  // namespace
}  // namespace motus::snow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace motus::snow {

std::span<const Kernel> kernels() {
    static const Kernels<Kernel> kernels({MOTUS_EVERY_TARGET(kernel)});
    return kernels.runnable();
}

}  // namespace motus::snow
#endif
