// Sine and cosine of several numbers at once, by arithmetic alone: no release of the system's mathematics
// changes a bit. For the topics of the library alone.
#pragma once
#include <cstdint>

#include "motus/core/wide.hpp"

namespace motus {

template <class Real>
struct SineCosine {
    Real sine, cosine;
};

/// Size of angles, rad, up to which sine_cosine_within_limit() holds.
inline constexpr double sine_limit = 0x1p30;

/// Sine and cosine of angles. Error 2e-16 up to some 1e5 rad; then it grows as the rounding of the angle
/// does, up to sine_limit, beyond which the results are meaningless. The system's functions differ in the
/// last digit between processors and releases, and a chaotic motion makes that visible. Reduction by a
/// quarter turn in three parts and polynomials of the remainder: Sun's fdlibm (1993), k_sin.c and k_cos.c.
template <int n>
[[nodiscard, gnu::always_inline]] inline SineCosine<Wide<n>> sine_cosine_within_limit(Wide<n> angle) {
    using Real = Wide<n>;
    using Numbers = typename Real::Numbers;
    using Bits = typename WideMask<n>::Bits;
    // The last bits of the sum of this and a number below 2^51 are the nearest whole number.
    const Real to_whole = 6755399441055744.0;
    const Real shifted = angle * Real(6.36619772367581382433e-01) + to_whole;
    const Bits quarter = __builtin_bit_cast(Bits, shifted.lanes);
    const Real count = shifted - to_whole;
    const Real r =
        ((angle - count * Real(1.57079632673412561417e+00)) - count * Real(6.07710050630396597660e-11)) -
        count * Real(2.02226624879595063154e-21);
    const Real z = r * r;
    const Real sine =
        r +
        r * z *
            (Real(-1.66666666666666324348e-01) +
             z * (Real(8.33333333332248946124e-03) +
                  z * (Real(-1.98412698298579493134e-04) +
                       z * (Real(2.75573137070700676789e-06) + z * (Real(-2.50507602534068634195e-08) +
                                                                    z * Real(1.58969099521155010221e-10))))));
    const Real cosine =
        (Real(1.0) - Real(0.5) * z) + z * z *
                                          (Real(4.16666666666666019037e-02) +
                                           z * (Real(-1.38888888888741095749e-03) +
                                                z * (Real(2.48015872894767294178e-05) +
                                                     z * (Real(-2.75573143513906633035e-07) +
                                                          z * (Real(2.08757232129817482790e-09) +
                                                               z * Real(-1.13596475577881948265e-11))))));

    const Bits odd = -(quarter & 1);  // all bits if the quarter is odd
    const Bits s = __builtin_bit_cast(Bits, sine.lanes);
    const Bits c = __builtin_bit_cast(Bits, cosine.lanes);
    const Bits sine_sign = (quarter & 2) << 62;
    const Bits cosine_sign = ((quarter + 1) & 2) << 62;
    return {Real(__builtin_bit_cast(Numbers, ((c & odd) | (s & ~odd)) ^ sine_sign)),
            Real(__builtin_bit_cast(Numbers, ((s & odd) | (c & ~odd)) ^ cosine_sign))};
}

/// The remainder of an angle by whole turns; exact but for the rounding of a turn, which is less than that
/// of the angle.
[[nodiscard]] double without_turns(double angle);

/// Sine and cosine of any angle, with an error like the angle's own rounding; NaN of NaN and infinity.
template <int n>
[[nodiscard, gnu::always_inline]] inline SineCosine<Wide<n>> sine_cosine(Wide<n> angle) {
    if (any(!(abs(angle) <= Wide<n>(sine_limit))))
        for (int i = 0; i < n; ++i)
            if (!(lane(abs(angle), i) <= sine_limit)) set_lane(angle, i, without_turns(lane(angle, i)));
    return sine_cosine_within_limit(angle);
}

}  // namespace motus
