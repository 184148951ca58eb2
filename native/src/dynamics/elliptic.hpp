// Elliptic functions of the modulus k and its complement k' = sqrt(1 - k^2). Both are given, since near k = 1
// the complement computed from k has lost its digits. Private to the library.
// Abramowitz, Stegun, "Handbook of Mathematical Functions" (1964), 16.4, 17.6; Carlson, "Numerical
// computation of real or complex elliptic integrals" (1995).
#pragma once

namespace motus::dynamics {

/// K, a quarter of the period: the integral over 0 to pi/2 of 1 / sqrt(1 - k^2 sin^2). Infinity for k' = 0.
[[nodiscard]] double complete_integral(double complement);

/// The integral from 0 to an angle from -pi/2 to pi/2, whose sine and cosine are given (cosine >= 0), with
/// delta = sqrt(1 - k^2 sine^2).
[[nodiscard]] double incomplete_integral(double sine, double cosine, double delta);

/// The angle at which the incomplete integral is u, of any size: with all turns. k in [0, 1].
[[nodiscard]] double amplitude(double u, double modulus, double complement);

}  // namespace motus::dynamics
