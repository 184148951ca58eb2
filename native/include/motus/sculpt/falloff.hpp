// How strongly a pull acts at a distance from its root: the falloff of a soft selection.
//
// Costs: O(n). Allocates nothing. Any number of threads at once, each with an `out` of its own.
#pragma once
#include <span>

namespace motus::sculpt {

/// The force at the distance d, with t = 1 - d / R within the radius R.
enum class Falloff {
    classic,   ///< (1 - d^2 / (R + 1)) ^ (1 + |k|) for d^2 < R: reaches as far as sqrt(R)
    smooth,    ///< 3 t^2 - 2 t^3
    sphere,    ///< sqrt(2 t - t^2)
    root,      ///< sqrt(t)
    linear,    ///< t
    sharp,     ///< t^2
    constant,  ///< 1
    gaussian,  ///< (e^(-4.5 d^2 / R^2) - e^-4.5) / (1 - e^-4.5)
    curve,     ///< from samples, linear in between
};

/// A falloff with its parameters, except the radius.
struct Profile {
    Falloff falloff = Falloff::smooth;
    float scale_factor = 0.0f;     ///< k of `classic`, finite
    std::span<const float> curve;  ///< of `curve`: 2 to 65536 finite samples at equal steps of t from 0 to 1
};

/// The largest absolute error of forces() for |k| <= 10; for larger |k| the error grows like 1 + |k|.
inline constexpr float force_error = 1e-6f;

/// The distance at and beyond which nothing moves: the radius, and for `classic` its square root.
[[nodiscard]] float reach_of(const Profile& profile, float radius);

/// Forces at distances >= 0; 0 at the radius and beyond, NaN for NaN. radius > 0
/// and finite. `out` may be `distances`. The same bits by the same compiler (docs/library.md). Throws
/// std::invalid_argument if the sizes differ or something is outside its domain.
void forces(const Profile& profile, float radius, std::span<const float> distances, std::span<float> out);

}  // namespace motus::sculpt
