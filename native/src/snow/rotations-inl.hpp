// How flakes are turned: see lanes-inl.hpp.
#if defined(MOTUS_SNOW_ROTATIONS) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_SNOW_ROTATIONS
#undef MOTUS_SNOW_ROTATIONS
#else
#define MOTUS_SNOW_ROTATIONS
#endif

#include <cstddef>
#include <cstdint>

#include "draws-inl.hpp"
#include "lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::snow::HWY_NAMESPACE {

/// The shortest one from +Z to unit directions.
HWY_INLINE Quaternions headed(const Vectors& direction) {
    const Floats zero = floats(0.0F), one = floats(1.0F);
    const Floats up = one + direction.z;
    const auto is_down = up < floats(1e-6F);
    const Floats squares = up * up + direction.x * direction.x + direction.y * direction.y;
    const Floats scale = one / root(hn::IfThenElse(is_down, one, squares));
    return {hn::IfThenElse(is_down, zero, up * scale),
            hn::IfThenElse(is_down, one, hn::Neg(direction.y) * scale),
            hn::IfThenElse(is_down, zero, direction.x * scale), zero};
}

/// About a unit axis, by the half angles.
HWY_INLINE Quaternions about(const Vectors& axis, Floats half_turns) {
    const Circle by = circle(half_turns);
    return {by.cosine, axis.x * by.sine, axis.y * by.sine, axis.z * by.sine};
}

/// The emitter's.
HWY_INLINE Quaternions glide_turns(const Glide& glide, Floats u) {
    const auto& q = glide.quaternion;
    return Quaternions{floats(q[0]), floats(q[1]), floats(q[2]), floats(q[3])} *
           about(vectors(glide.axis), floats(0.5F * glide.turn) * part_of(glide, u));
}

/// About X by the one angle after about Y by the other.
HWY_INLINE Quaternions steer_turns(Floats about_x, Floats about_y) {
    const Circle p = circle(floats(0.5F) * about_x), q = circle(floats(0.5F) * about_y);
    return {p.cosine * q.cosine, p.sine * q.cosine, p.cosine * q.sine, p.sine * q.sine};
}

/// The steering's angles of flakes that begin at nodes of their own.
inline void angles_from_nodes(const Run& run, float offset_count, std::size_t n, Scratch& rows) {
    for (std::size_t i = 0; i < n; ++i) {
        const OwnAngles* a = run.own_angles + static_cast<std::int32_t>(offset_count * rows.offset[i]);
        const float u = rows.u[i];
        for (std::size_t axis = 0; axis < 2; ++axis) {
            // The cubic by the values and slopes at its ends.
            const float start = a[0].angle[axis], m0 = a[0].slope[axis], m1 = a[1].slope[axis];
            const float change = a[1].angle[axis] - start;
            rows.angles[axis][i] =
                start + u * (m0 + u * (3.0F * change - 2.0F * m0 - m1 + u * (m0 + m1 - 2.0F * change)));
        }
    }
}

inline void angles_alike(const Run& run, std::size_t n, Scratch& rows) {
    const Node &start = run.node[0], &end = run.node[1];
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const Cubic c =
            cubic(start.angle[axis], start.angle_slope[axis], end.angle[axis], end.angle_slope[axis], 1.0);
        for (std::size_t i = 0; i < n; i += lanes) store(at(c, load(rows.u, i)), rows.angles[axis], i);
    }
}

/// How far flakes have turned that tumble about an axis of their own.
inline void tumble(const Kind& kind, const Run& run, std::size_t n, Scratch& rows) {
    draw(kind, run, Stream::spin, n, rows.axis_height, rows.axis_turn, rows.spin, rows.spin_phase);
    const auto most = hn::Set(as_half_floats, kind.tumble), one = hn::Set(as_half_floats, 1.0F),
               two = hn::Set(as_half_floats, 2.0F);
    for (std::size_t i = 0; i < n; i += double_lanes) {
        const auto rate = most * (two * hn::Load(as_half_floats, rows.spin.data() + i) - one);
        // In doubles, less the whole turns: the ages may be large.
        const Doubles turns = hn::PromoteTo(as_doubles, rate) * hn::LoadU(as_doubles, run.ages + i);
        hn::Store(hn::DemoteTo(as_half_floats, turns - hn::Round(turns)), as_half_floats,
                  rows.spin.data() + i);
    }
}

HWY_INLINE Quaternions tumbling(const Scratch& rows, std::size_t i) {
    const Floats up = floats(1.0F) - floats(2.0F) * load(rows.axis_height, i);
    const Floats level = root(floats(1.0F) - up * up);
    const Circle around = circle(load(rows.axis_turn, i));
    return about({level * around.cosine, level * around.sine, up},
                 floats(0.5F) * (load(rows.spin, i) + load(rows.spin_phase, i)));
}

/// From directions in the emitter's space, or in the world if the emitter is none.
inline void write_rotations(const Kind& kind, const Run& run, std::size_t n, Scratch& rows) {
    const Glide glide = kind.shape == Shape::frustum ? Glide{} : run.glide;
    if (kind.snow && kind.snow_offsets)
        angles_from_nodes(run, kind.offset_count, n, rows);
    else if (kind.snow)
        angles_alike(run, n, rows);
    const bool tumbles = kind.tumble > 0.0F;
    if (tumbles) tumble(kind, run, n, rows);
    for (std::size_t i = 0; i < run.count; i += lanes) {
        Quaternions q = glide_turns(glide, load(rows.u, i)) * headed(load(rows.direction, i));
        if (kind.snow) q = steer_turns(load(rows.angles[0], i), load(rows.angles[1], i)) * q;
        if (tumbles) q = q * tumbling(rows, i);
        const Floats scale = floats(1.0F) / root(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
        write(run.rotation, i, run.count, q.w * scale, q.x * scale, q.y * scale, q.z * scale);
    }
}

}  // namespace motus::snow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
