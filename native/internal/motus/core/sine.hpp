// Sine and cosine by arithmetic alone: no release of the system's mathematics changes a bit. For the topics
// of the library alone.
#pragma once

namespace motus {

template <class Real>
struct SineCosine {
    Real sine, cosine;
};

/// Size of angles, rad, up to which sine_cosine_within_limit() of sine-inl.hpp holds.
inline constexpr double sine_limit = 0x1p30;

/// The remainder of an angle by whole turns; exact but for the rounding of a turn, which is less than that
/// of the angle.
[[nodiscard]] double without_turns(double angle);

/// Sine and cosine of any angle, with an error like the angle's own rounding; NaN of NaN and infinity.
[[nodiscard]] SineCosine<double> sine_cosine(double angle);

}  // namespace motus
