// Derivatives of the systems' variables, of one state or several: see motus/core/wide-inl.hpp.
#if defined(MOTUS_DYNAMICS_MOTION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MOTUS_DYNAMICS_MOTION_INL_HPP
#undef MOTUS_DYNAMICS_MOTION_INL_HPP
#else
#define MOTUS_DYNAMICS_MOTION_INL_HPP
#endif

#include "motion.hpp"
#include "motus/core/sine-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace motus::dynamics::HWY_NAMESPACE {

using namespace motus::HWY_NAMESPACE;

/// Both angular velocities of the double pendulum.
template <class Real>
HWY_INLINE void velocities(const DoubleSystem& system, const Real* momenta, Real sine, Real cosine,
                           Real* out) {
    const Real inverse = Real(1.0) / (Real(system.other) + Real(system.mass) * sine * sine);
    out[0] = (momenta[0] - Real(system.mass * system.length) * cosine * momenta[1]) * inverse;
    out[1] = (momenta[1] - Real(1.0 / system.length) * cosine * momenta[0]) * inverse;
}

/// Derivatives f of the variables y. pivot: its acceleration along the system's axes.
template <class Real>
HWY_INLINE void derive(const SingleSystem& system, const Real* y, const Real* pivot, Real* f) {
    const SineCosine<Real> at = sine_cosine_within_limit(y[0]);
    f[0] = y[1];
    f[1] = Real(0.0) - ((Real(system.gravity) + pivot[1]) * at.sine + pivot[0] * at.cosine) -
           Real(system.damping) * y[1];
}
template <class Real>
HWY_INLINE void derive(const DoubleSystem& system, const Real* y, const Real* pivot, Real* f) {
    const SineCosine<Real> upper = sine_cosine_within_limit(y[0]);
    const SineCosine<Real> lower = sine_cosine_within_limit(y[1]);
    const Real sine = upper.sine * lower.cosine - upper.cosine * lower.sine;
    const Real cosine = upper.cosine * lower.cosine + upper.sine * lower.sine;
    velocities(system, y + 2, sine, cosine, f);
    const Real coupling = f[0] * f[1] * sine;
    const Real weight = Real(system.gravity) + pivot[1];
    f[2] = Real(0.0) - (weight * upper.sine + pivot[0] * upper.cosine) -
           Real(system.mass * system.length) * coupling - Real(system.damping) * y[2];
    f[3] = (coupling - weight * lower.sine - pivot[0] * lower.cosine) * Real(1.0 / system.length) -
           Real(system.damping) * y[3];
}
template <class Real>
HWY_INLINE void derive(const SphericalSystem& system, const Real* y, const Real* pivot, Real* f) {
    const Real* velocity = y + 3;
    const Real weight = Real(system.gravity) + pivot[2];
    const Real square = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
    const Real speed = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
    const Real pulled = pivot[0] * y[0] + pivot[1] * y[1] + weight * y[2];
    // The rod's tension keeps the bob on the sphere. By the square of the rod, which is 1 but for rounding,
    // place and velocity stay at right angles for any place.
    const Real tension = (speed - pulled) / square;
    const Real drag(system.damping);
    for (int axis = 0; axis < 3; ++axis) f[axis] = velocity[axis];
    f[3] = Real(0.0) - pivot[0] - tension * y[0] - drag * velocity[0];
    f[4] = Real(0.0) - pivot[1] - tension * y[1] - drag * velocity[1];
    f[5] = Real(0.0) - weight - tension * y[2] - drag * velocity[2];
}

}  // namespace motus::dynamics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
