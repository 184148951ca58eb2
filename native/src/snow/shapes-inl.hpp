// Where flakes are born, and where they head, in the emitter's space: see lanes-inl.hpp.
#if defined(MOTUS_SNOW_SHAPES) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_SNOW_SHAPES
#undef MOTUS_SNOW_SHAPES
#else
#define MOTUS_SNOW_SHAPES
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::snow::HWY_NAMESPACE {

struct Births {
    Vectors place, direction;
};

HWY_INLINE Births in_square(float radius, Floats x, Floats y, Floats z) {
    const Floats zero = floats(0.0F);
    return {{floats(radius) * x, floats(radius) * y, z}, {zero, zero, floats(1.0F)}};
}

HWY_INLINE Births on_disc(float radius, Floats far, Floats around) {
    const Floats distance = floats(radius) * root(far), zero = floats(0.0F);
    const Circle by = circle(around);
    return {{distance * by.cosine, distance * by.sine, zero}, {zero, zero, floats(1.0F)}};
}

HWY_INLINE Births in_ball(float radius, Floats upright, Floats around, Floats far) {
    const Floats height = floats(1.0F) - floats(2.0F) * upright;
    const Floats level = root(floats(1.0F) - height * height);
    const Circle by = circle(around);
    const Vectors direction = {level * by.cosine, level * by.sine, height};
    return {direction * (floats(radius) * far), direction};
}

HWY_INLINE Births in_cone(float radius, float cone_turn, Floats far, Floats around) {
    const Floats distance = root(far);
    const Circle by = circle(around), lean = circle(distance * floats(cone_turn));
    const Floats out = floats(radius) * distance;
    return {{out * by.cosine, out * by.sine, floats(0.0F)},
            {lean.sine * by.cosine, lean.sine * by.sine, lean.cosine}};
}

/// Of numbers in (0, 1].
HWY_INLINE Floats cube_root(Floats numbers) {
    // A third of the exponent, then Newton's method.
    const auto third = hn::ConvertTo(as_floats, hn::BitCast(as_integers, numbers)) * floats(1.0F / 3);
    Floats roots =
        hn::BitCast(as_floats, hn::ConvertTo(as_integers, third) + hn::Set(as_integers, 0x2a514067));
    for (int round = 0; round < 3; ++round)
        roots = roots - (roots - numbers / (roots * roots)) * floats(1.0F / 3);
    return roots;
}

/// What a camera sees that looks along -Z, by the tangents of its half angles: as many at each distance as
/// its picture is large there.
HWY_INLINE Births in_frustum(const Frustum& frustum, Floats x, Floats y, Floats far) {
    const Floats volume = floats(frustum.nearest) + floats(1.0F - frustum.nearest) * far;
    const Floats distance = floats(frustum.far) * cube_root(volume), zero = floats(0.0F);
    return {{distance * floats(frustum.wide) * x, distance * floats(frustum.high) * y, hn::Neg(distance)},
            {zero, zero, floats(-1.0F)}};
}

/// Facets lie anywhere in memory: flake by flake.
inline void on_surface(std::span<const Facet> facets, std::size_t n, Scratch& rows) {
    const auto facet_count = static_cast<double>(facets.size());
    for (std::size_t i = 0; i < n; ++i) {
        // Of two draws, since one has too few digits for millions of facets.
        const double at = static_cast<double>(rows.one[i]) + 0x1p-24 * static_cast<double>(rows.two[i]);
        const Facet* facet = facets.data() + static_cast<std::int32_t>(at * facet_count);
        if (!(rows.three[i] < facet->kept)) facet = facets.data() + facet->other;
        const float far = std::sqrt(rows.x[i]);
        const float q = far * rows.y[i], p = far - q;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            rows.birth[axis][i] = facet->corner[axis] + p * facet->edge1[axis] + q * facet->edge2[axis];
            rows.direction[axis][i] = facet->normal[axis];
        }
    }
}

HWY_INLINE Births born(const Kind& kind, const Scratch& rows, std::size_t i) {
    const Floats x = load(rows.x, i), y = load(rows.y, i);
    switch (kind.shape) {
        case Shape::square:
            return in_square(kind.radius, spread(x), spread(y), floats(0.0F));
        case Shape::disc:
            return on_disc(kind.radius, x, y);
        case Shape::box:
            return in_square(kind.radius, spread(x), spread(y),
                             floats(kind.radius) * spread(load(rows.one, i)));
        case Shape::sphere:
            // The largest of three numbers is spread as the cube root of one.
            return in_ball(kind.radius, x, y,
                           hn::Max(hn::Max(load(rows.one, i), load(rows.two, i)), load(rows.three, i)));
        case Shape::cone:
            return in_cone(kind.radius, kind.cone_turn, x, y);
        case Shape::frustum:
            return in_frustum(kind.frustum, spread(x), spread(y), load(rows.one, i));
        case Shape::surface:
            break;
    }
    return {load(rows.birth, i), load(rows.direction, i)};
}

/// Turns unit directions by up to the cone's angle. Duff et al., "Building an Orthonormal Basis, Revisited"
/// (2017).
HWY_INLINE Vectors turned_out(const Vectors& v, float cone_depth, Floats tilt, Floats turn) {
    const Floats one = floats(1.0F);
    const Floats depth = tilt * floats(cone_depth);
    const Floats aside = root(depth * (floats(2.0F) - depth)), along = one - depth;
    const Circle around = circle(turn);
    const Floats p = aside * around.cosine, q = aside * around.sine;
    const Floats sign = hn::IfThenElse(v.z < floats(0.0F), floats(-1.0F), one);
    const Floats a = floats(-1.0F) / (sign + v.z);
    const Floats b = v.x * v.y * a;
    return {p * (one + sign * v.x * v.x * a) + q * b + along * v.x,
            p * (sign * b) + q * (sign + v.y * v.y * a) + along * v.y,
            p * (hn::Neg(sign) * v.x) - q * v.y + along * v.z};
}

inline void leave(const Kind& kind, std::size_t n, Scratch& rows) {
    if (kind.shape == Shape::surface) on_surface(kind.facets, n, rows);
    for (std::size_t i = 0; i < n; i += lanes) {
        Births births = born(kind, rows, i);
        if (kind.turns_out)
            births.direction =
                turned_out(births.direction, kind.cone_depth, load(rows.tilt, i), load(rows.turn, i));
        store(births.place, rows.birth, i);
        store(births.direction, rows.direction, i);
    }
}

}  // namespace motus::snow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
