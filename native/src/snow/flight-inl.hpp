// Where flakes are, and how fast: see lanes-inl.hpp.
#if defined(MOTUS_SNOW_FLIGHT) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_SNOW_FLIGHT
#undef MOTUS_SNOW_FLIGHT
#else
#define MOTUS_SNOW_FLIGHT
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::snow::HWY_NAMESPACE {

// --- To the world ------------------------------------------------------------------------------------------

HWY_INLINE Vectors turned(const Glide& glide, Floats w, const Vectors& v) {
    return turned(v, vectors(glide.axis), circle(floats(glide.turn) * w));
}

HWY_INLINE Vectors stretched(const Glide& glide, Floats w, const Vectors& v) {
    const auto row = [&](std::size_t i) HWY_ATTR {
        const auto entry = [&](std::size_t j) HWY_ATTR {
            return floats(glide.stretch[j]) + w * floats(glide.stretch_change[j]);
        };
        return dot({entry(i), entry(i + 1), entry(i + 2)}, v);
    };
    return {row(0), row(3), row(6)};
}

HWY_INLINE Vectors place_in_world(const Glide& glide, Floats w, const Vectors& place) {
    if (!glide.is_moving) return product(glide.stretch, place) + vectors(glide.location);
    return product(glide.rotation, turned(glide, w, stretched(glide, w, place))) +
           (vectors(glide.location) + vectors(glide.location_change) * w);
}

HWY_INLINE Vectors direction_in_world(const Glide& glide, Floats w, const Vectors& direction) {
    return product(glide.rotation, glide.is_moving ? turned(glide, w, direction) : direction);
}

/// How fast flakes are born. Where all are alike, their draws are not there.
HWY_INLINE Floats speeds(const Kind& kind, const Scratch& rows, std::size_t i) {
    if (kind.speed_range == 0.0F) return floats(kind.speed);
    return floats(kind.speed) + floats(kind.speed_range) * spread(load(rows.speed, i));
}

/// Places of birth, and the velocities there.
inline void to_world(const Kind& kind, const Run& run, std::size_t n, Scratch& rows) {
    const bool is_world = kind.shape == Shape::frustum;  // what the directions are in
    const bool inherits = kind.inherited != 0.0F && run.glide.is_moving;
    const Vectors inherited = vectors(run.glide.velocity) * floats(kind.inherited);
    for (std::size_t i = 0; i < n; i += lanes) {
        const Floats w = part_of(run.glide, load(rows.u, i));
        const Vectors direction = load(rows.direction, i);
        const Vectors own =
            (is_world ? direction : direction_in_world(run.glide, w, direction)) * speeds(kind, rows, i);
        store(inherits ? own + inherited : own, rows.velocity, i);
        store(place_in_world(run.glide, w, load(rows.birth, i)), rows.birth, i);
    }
}

// --- By the air --------------------------------------------------------------------------------------------

HWY_INLINE Vectors at(const std::array<Cubic, 3>& c, Floats u) {
    return {at(c[0], u), at(c[1], u), at(c[2], u)};
}

/// By how much a wave's velocity moves flakes that go straight through it: since birth, or now.
template <bool is_rate>
HWY_INLINE Floats swirl(const Wave& wave, Floats birth, Floats way, Floats age) {
    const Floats turns = (way + floats(wave.rate)) * age;
    if constexpr (is_rate) {
        return circle(birth + turns).cosine;
    } else {
        const Floats angle = floats(3.14159265359F) * turns, half = floats(0.5F) * turns;
        const auto is_small = hn::Abs(angle) < floats(1e-2F);
        const Floats sine = circle(half).sine / hn::IfThenElse(is_small, floats(1.0F), angle);
        const Floats mean = hn::IfThenElse(is_small, floats(1.0F) - angle * angle * floats(1.0F / 6), sine);
        return age * mean * circle(birth + half).cosine;
    }
}

/// Where flakes would be that have no velocity of their own, or how fast.
template <bool is_rate>
HWY_INLINE Vectors blown(const Kind& kind, const Run& run, const Scratch& rows, std::size_t i) {
    const Floats u = load(rows.u, i);
    const Vectors birth = load(rows.birth, i);
    Vectors found = is_rate ? at(run.drift_velocity, u) : birth + at(run.drift, u);
    if (!kind.is_turbulent) return found;
    const Vectors velocity = load(rows.velocity, i);
    const Floats age = load(rows.age, i);
    for (std::size_t wave = 0; wave < wave_count; ++wave) {
        const Vectors across = vectors(kind.waves[wave].vector);
        const Floats phase =
            dot(across, birth) + floats(run.phases[wave]) + floats(run.phase_changes[wave]) * u;
        const Floats way = floats(kind.carried) * dot(across, velocity);
        const Floats by = swirl<is_rate>(kind.waves[wave], phase, way, age);
        found = found + vectors(kind.waves[wave].velocity) * by;
    }
    return found;
}

// --- By themselves -----------------------------------------------------------------------------------------

template <bool is_rate>
void go_straight(const Kind& kind, const Run& run, const Scratch& rows, float* out) {
    for (std::size_t i = 0; i < run.count; i += lanes) {
        const Floats way = at(is_rate ? run.way_rate : run.way, load(rows.u, i));
        const Vectors found = blown<is_rate>(kind, run, rows, i) + load(rows.velocity, i) * way;
        write(out, i, run.count, found.x, found.y, found.z);
    }
}

/// The cubic's derivative by time.
inline Cubic rate_of(const Cubic& c, double step) {
    const auto by = static_cast<float>(1.0 / step);
    return {c.c1 * by, 2.0F * c.c2 * by, 3.0F * c.c3 * by, 0.0F};
}

/// Flakes that all steer alike.
template <bool is_rate>
void go_steering(const Kind& kind, const Run& run, const Scratch& rows, float* out) {
    std::array<Cubic, entries> integral;
    const Node &start = run.node[0], &end = run.node[1];
    for (std::size_t e = 0; e < entries; ++e) {
        const Cubic c = cubic(start.integral[e], start.slope[e], end.integral[e], end.slope[e], 1.0);
        integral[e] = is_rate ? rate_of(c, run.step) : c;
    }
    for (std::size_t i = 0; i < run.count; i += lanes) {
        const Floats u = load(rows.u, i);
        const Vectors v = load(rows.velocity, i);
        const auto m = [&](std::size_t e) HWY_ATTR { return at(integral[e], u); };
        const Vectors found = blown<is_rate>(kind, run, rows, i) +
                              Vectors{m(0) * v.x + m(1) * v.z, m(2) * v.x + m(3) * v.y + m(4) * v.z,
                                      m(5) * v.x + m(6) * v.y + m(7) * v.z};
        write(out, i, run.count, found.x, found.y, found.z);
    }
}

/// The integral's entries of flakes that begin at nodes of their own, or their rates.
template <bool is_rate>
void steer_from_nodes(const Run& run, float offset_count, std::size_t n, Scratch& rows) {
    constexpr hn::CappedTag<float, entries> as_entries;
    constexpr hn::RebindToSigned<decltype(as_entries)> as_units;
    const auto unit = hn::Set(as_entries, run.unit);
    const auto by = hn::Set(as_entries, static_cast<float>(1.0 / run.step));
    const auto two = hn::Set(as_entries, 2.0F), three = hn::Set(as_entries, 3.0F);
    for (std::size_t i = 0; i < n; ++i) {
        const auto offset = static_cast<std::int32_t>(offset_count * rows.offset[i]);
        const OwnNode &origin = run.own_origin[offset], *node = run.own_node + offset;
        const auto t = hn::Set(as_entries, rows.u[i]);
        for (std::size_t e = 0; e < entries; e += hn::Lanes(as_entries)) {
            const auto first = hn::Load(as_units, origin.integral.data() + e);
            const auto start = hn::Load(as_units, node[0].integral.data() + e);
            const auto end = hn::Load(as_units, node[1].integral.data() + e);
            const auto m0 = hn::Load(as_entries, node[0].slope.data() + e);
            const auto m1 = hn::Load(as_entries, node[1].slope.data() + e);
            // As cubic() has it.
            const auto change = hn::ConvertTo(as_entries, end - start) * unit;
            const auto c2 = three * change - two * m0 - m1, c3 = m0 + m1 - two * change;
            auto found = hn::Zero(as_entries);
            if constexpr (is_rate)
                found = by * (m0 + t * (two * c2 + t * (three * c3)));
            else
                found = hn::ConvertTo(as_entries, start - first) * unit + t * (m0 + t * (c2 + t * c3));
            hn::Store(found, as_entries, rows.integral.data() + entries * i + e);
        }
    }
}

template <bool is_rate>
void go_from_nodes(const Kind& kind, const Run& run, std::size_t n, Scratch& rows, float* out) {
    steer_from_nodes<is_rate>(run, kind.offset_count, n, rows);
    for (std::size_t i = 0; i < n; i += lanes) store(blown<is_rate>(kind, run, rows, i), rows.air, i);
    for (std::size_t i = 0; i < run.count; ++i) {
        const float* m = rows.integral.data() + entries * i;
        const float x = rows.velocity[0][i], y = rows.velocity[1][i], z = rows.velocity[2][i];
        out[3 * i] = rows.air[0][i] + (m[0] * x + m[1] * z);
        out[3 * i + 1] = rows.air[1][i] + (m[2] * x + m[3] * y + m[4] * z);
        out[3 * i + 2] = rows.air[2][i] + (m[5] * x + m[6] * y + m[7] * z);
    }
}

/// Where the flakes are, or how fast.
template <bool is_rate>
void go(const Kind& kind, const Run& run, std::size_t n, Scratch& rows, float* out) {
    if (!kind.snow)
        go_straight<is_rate>(kind, run, rows, out);
    else if (kind.snow_offsets)
        go_from_nodes<is_rate>(kind, run, n, rows, out);
    else
        go_steering<is_rate>(kind, run, rows, out);
}

}  // namespace motus::snow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
