// Sine and cosine of one double or several, to the same bits: see wide-inl.hpp.
#if defined(MOTUS_CORE_SINE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_CORE_SINE_INL_HPP
#undef MOTUS_CORE_SINE_INL_HPP
#else
#define MOTUS_CORE_SINE_INL_HPP
#endif

#include <bit>
#include <cmath>
#include <cstdint>

#include "motus/core/sine.hpp"
#include "motus/core/wide-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::HWY_NAMESPACE {

/// Sine and cosine of an angle, by those of the angle less some quarter turns, whose number's last bits are
/// those of `quarters`.
HWY_INLINE SineCosine<double> turned(double quarters, SineCosine<double> rest) {
    const auto quarter = std::bit_cast<std::uint64_t>(quarters);
    const auto signed_by = [](double number, std::uint64_t sign) {
        return std::bit_cast<double>(std::bit_cast<std::uint64_t>(number) ^ (sign << 62U));
    };
    const bool is_odd = (quarter & 1U) != 0;
    return {signed_by(is_odd ? rest.cosine : rest.sine, quarter & 2U),
            signed_by(is_odd ? rest.sine : rest.cosine, (quarter + 1) & 2U)};
}
#if HWY_TARGET != HWY_SCALAR
template <int n>
HWY_INLINE SineCosine<Wide<n>> turned(Wide<n> quarters, SineCosine<Wide<n>> rest) {
    constexpr hn::FixedTag<double, n> as_doubles;
    constexpr hn::FixedTag<std::int64_t, n> as_bits;
    const auto one = hn::Set(as_bits, 1), two = hn::Set(as_bits, 2);
    const auto quarter = hn::BitCast(as_bits, quarters.lanes);
    const auto sine_sign = hn::ShiftLeft<62>(hn::And(quarter, two));
    const auto cosine_sign = hn::ShiftLeft<62>(hn::And(hn::Add(quarter, one), two));
    const WideMask<n> is_odd{hn::RebindMask(as_doubles, hn::TestBit(quarter, one))};
    return {
        Wide<n>(hn::Xor(select(is_odd, rest.cosine, rest.sine).lanes, hn::BitCast(as_doubles, sine_sign))),
        Wide<n>(hn::Xor(select(is_odd, rest.sine, rest.cosine).lanes, hn::BitCast(as_doubles, cosine_sign)))};
}
#endif

/// Sine and cosine of angles. Error 2e-16 up to some 1e5 rad; then it grows as the rounding of the angle
/// does, up to sine_limit, beyond which the results are meaningless. The system's functions differ in the
/// last digit between processors and releases, and a chaotic motion makes that visible. Reduction by a
/// quarter turn in three parts and polynomials of the remainder: Sun's fdlibm (1993), k_sin.c and k_cos.c.
template <class Real>
HWY_INLINE SineCosine<Real> sine_cosine_within_limit(Real angle) {
    // The last bits of the sum of this and a number below 2^51 are the nearest whole number.
    const Real to_whole = 6755399441055744.0;
    const Real shifted = angle * Real(6.36619772367581382433e-01) + to_whole;
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
    return turned(shifted, SineCosine<Real>{sine, cosine});
}

/// As motus::sine_cosine().
template <class Real>
HWY_INLINE SineCosine<Real> sine_cosine(Real angle) {
    using std::abs;
    if (any(!(abs(angle) <= Real(sine_limit))))
        for (int i = 0; i < lane_count<Real>; ++i)
            if (!(std::abs(lane(angle, i)) <= sine_limit)) set_lane(angle, i, without_turns(lane(angle, i)));
    return sine_cosine_within_limit(angle);
}

}  // namespace motus::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
