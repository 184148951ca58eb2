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

/// Derivatives f of the variables y.
template <class Real>
HWY_INLINE void derive(const SingleSystem& system, const Real* y, Real pivot_x, Real pivot_z, Real* f) {
    const SineCosine<Real> at = sine_cosine_within_limit(y[0]);
    f[0] = y[1];
    f[1] = Real(0.0) - ((Real(system.gravity) + pivot_z) * at.sine + pivot_x * at.cosine) -
           Real(system.damping) * y[1];
}
template <class Real>
HWY_INLINE void derive(const DoubleSystem& system, const Real* y, Real pivot_x, Real pivot_z, Real* f) {
    const SineCosine<Real> upper = sine_cosine_within_limit(y[0]);
    const SineCosine<Real> lower = sine_cosine_within_limit(y[1]);
    const Real sine = upper.sine * lower.cosine - upper.cosine * lower.sine;
    const Real cosine = upper.cosine * lower.cosine + upper.sine * lower.sine;
    velocities(system, y + 2, sine, cosine, f);
    const Real coupling = f[0] * f[1] * sine;
    const Real weight = Real(system.gravity) + pivot_z;
    f[2] = Real(0.0) - (weight * upper.sine + pivot_x * upper.cosine) -
           Real(system.mass * system.length) * coupling - Real(system.damping) * y[2];
    f[3] = (coupling - weight * lower.sine - pivot_x * lower.cosine) * Real(1.0 / system.length) -
           Real(system.damping) * y[3];
}

}  // namespace motus::dynamics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
