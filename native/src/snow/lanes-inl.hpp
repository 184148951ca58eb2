// A number of each of several flakes, and what is done with them, in the instructions of one of Highway's
// targets: kernel.cpp is compiled once for each of these, and this file with it.
#if defined(MOTUS_SNOW_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_SNOW_LANES
#undef MOTUS_SNOW_LANES
#else
#define MOTUS_SNOW_LANES
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel.hpp"
#include "motus/core/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::snow::HWY_NAMESPACE {

using namespace motus::HWY_NAMESPACE;

// A vector holds half as many doubles, and these become half a vector of floats.
inline constexpr hn::ScalableTag<double> as_doubles;
inline constexpr hn::Rebind<float, decltype(as_doubles)> as_half_floats;
using Doubles = hn::Vec<decltype(as_doubles)>;
inline constexpr std::size_t double_lanes = hn::MaxLanes(as_doubles);

HWY_INLINE Floats load(const FloatRow& row, std::size_t i) {
    return hn::Load(as_floats, row.data() + i);
}

HWY_INLINE void store(Floats numbers, FloatRow& row, std::size_t i) {
    hn::Store(numbers, as_floats, row.data() + i);
}

/// From [0, 1) to [-1, 1).
HWY_INLINE Floats spread(Floats drawn) {
    return floats(2.0F) * drawn - floats(1.0F);
}

HWY_INLINE Floats root(Floats square) {
    return hn::Sqrt(hn::Max(square, floats(0.0F)));
}

/// c0 + x (c1 + x (c2 + ...)).
template <class... Higher>
HWY_INLINE Floats polynomial(Floats x, float c0, Higher... higher) {
    if constexpr (sizeof...(higher) == 0)
        return floats(c0);
    else
        return floats(c0) + x * polynomial(x, higher...);
}

HWY_INLINE Floats at(const Cubic& c, Floats u) {
    return polynomial(u, c.c0, c.c1, c.c2, c.c3);
}

/// w of the emitter's motion.
HWY_INLINE Floats part_of(const Glide& glide, Floats u) {
    return floats(glide.w_start) + floats(glide.w_change) * u;
}

// --- Angles ------------------------------------------------------------------------------------------------

struct Circle {
    Floats sine, cosine;
};

/// The other sign where the bit of 2 is set.
HWY_INLINE Floats turn_where_two(Integers bits, Floats numbers) {
    const Floats signs = hn::BitCast(as_floats, hn::ShiftLeft<30>(bits));
    return numbers ^ (signs & floats(-0.0F));
}

/// Of an angle in whole turns. Beyond 2^21 it has no digits of a quarter turn left, and beyond 2^28 it is
/// taken for that, since the conversion knows no larger numbers.
HWY_INLINE Circle circle(Floats turns) {
    const Floats most = floats(0x1p30F);
    const Floats quarters = hn::Max(hn::Min(floats(4.0F) * turns, most), hn::Neg(most));
    const auto quadrant = hn::ConvertTo(as_integers, quarters + hn::CopySign(floats(0.5F), quarters));
    const Floats x = (quarters - hn::ConvertTo(as_floats, quadrant)) * floats(1.57079632679F);
    const Floats z = x * x;
    const Floats s = x + x * z * polynomial(z, -1.0F / 6, 1.0F / 120, -1.0F / 5040, 1.0F / 362880);
    const Floats c = polynomial(z, 1.0F, -0.5F, 1.0F / 24, -1.0F / 720, 1.0F / 40320, -1.0F / 3628800);
    const auto one = hn::Set(as_integers, 1);
    const auto is_odd = hn::RebindMask(as_floats, hn::TestBit(quadrant, one));
    return {turn_where_two(quadrant, hn::IfThenElse(is_odd, c, s)),
            turn_where_two(quadrant + one, hn::IfThenElse(is_odd, s, c))};
}

// --- Vectors and rotations ---------------------------------------------------------------------------------

struct Vectors {
    Floats x, y, z;
};

HWY_INLINE Vectors vectors(const std::array<float, 3>& one) {
    return {floats(one[0]), floats(one[1]), floats(one[2])};
}

HWY_INLINE Vectors load(const std::array<FloatRow, 3>& rows, std::size_t i) {
    return {load(rows[0], i), load(rows[1], i), load(rows[2], i)};
}

HWY_INLINE void store(const Vectors& v, std::array<FloatRow, 3>& rows, std::size_t i) {
    store(v.x, rows[0], i);
    store(v.y, rows[1], i);
    store(v.z, rows[2], i);
}

HWY_INLINE Vectors operator+(const Vectors& a, const Vectors& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

HWY_INLINE Vectors operator*(const Vectors& a, Floats by) {
    return {a.x * by, a.y * by, a.z * by};
}

HWY_INLINE Floats dot(const Vectors& a, const Vectors& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

HWY_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

HWY_INLINE Vectors product(const Rows& m, const Vectors& v) {
    const auto row = [&](std::size_t i) HWY_ATTR {
        return dot({floats(m[i]), floats(m[i + 1]), floats(m[i + 2])}, v);
    };
    return {row(0), row(3), row(6)};
}

/// About a unit axis.
HWY_INLINE Vectors turned(const Vectors& v, const Vectors& axis, const Circle& by) {
    return v * by.cosine + cross(axis, v) * by.sine + axis * (dot(axis, v) * (floats(1.0F) - by.cosine));
}

struct Quaternions {
    Floats w, x, y, z;
};

/// The right one first.
HWY_INLINE Quaternions operator*(const Quaternions& a, const Quaternions& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

// --- Results -----------------------------------------------------------------------------------------------

HWY_INLINE void store_side_by_side(float* out, Floats x) {
    hn::StoreU(x, as_floats, out);
}

HWY_INLINE void store_side_by_side(float* out, Floats x, Floats y, Floats z) {
    hn::StoreInterleaved3(x, y, z, as_floats, out);
}

HWY_INLINE void store_side_by_side(float* out, Floats x, Floats y, Floats z, Floats w) {
    hn::StoreInterleaved4(x, y, z, w, as_floats, out);
}

/// Writes the numbers of a flake side by side: of those of the flakes from i on that are below `count`.
template <class... Numbers>
HWY_INLINE void write(float* out, std::size_t i, std::size_t count, Numbers... numbers) {
    constexpr std::size_t width = sizeof...(numbers);
    if (i + lanes <= count) {
        store_side_by_side(out + width * i, numbers...);
    } else {
        Unfilled<float, width * lanes> last;
        store_side_by_side(last.data(), numbers...);
        std::copy_n(last.data(), width * (count - i), out + width * i);
    }
}

}  // namespace motus::snow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
