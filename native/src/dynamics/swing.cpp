#include "swing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "elliptic.hpp"

namespace motus::dynamics {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// x within -period/2 to period/2.
[[nodiscard]] double wrapped(double x, double period) {
    return std::isfinite(period) ? std::remainder(x, period) : x;
}

}  // namespace

Swing::Swing(const Pendulum& pendulum, const PendulumState& start) : start_(start) {
    const double small_rate = std::sqrt(pendulum.gravity / pendulum.length);
    if (small_rate == 0.0) return;
    turns_ = turn * std::round(start.angle / turn);
    const double half = 0.5 * (start.angle - turns_);
    const double sine = std::sin(half);
    const double cosine = std::abs(std::cos(half));
    // sin(theta / 2) and this are the sides of the right triangle whose hypotenuse is k.
    const double speed = 0.5 * std::abs(start.velocity) / small_rate;
    constexpr double fastest = 1e100;  // gravity changes no digit of a larger velocity
    if (speed > fastest) return;
    const double k = std::hypot(sine, speed);
    const double below_top = (cosine - speed) * (cosine + speed);  // 1 - k^2
    const bool stands_up = speed == 0.0 && cosine < 1e-15;
    if (k == 0.0 || stands_up) return;
    if (below_top > 0.0) {
        kind_ = Kind::swings;
        rate_ = small_rate;
        modulus_ = std::min(k, 1.0);
        complement_ = std::sqrt(below_top);
        quarter_ = complete_integral(complement_);
        // sin(theta / 2) = k sn, theta' = 2 k rate cn.
        phase_ = incomplete_integral(sine / k, speed / k, cosine);
        if (start.velocity < 0.0) phase_ = std::copysign(2.0 * quarter_, phase_) - phase_;
        return;
    }
    kind_ = Kind::rotates;
    side_ = std::copysign(1.0, start.velocity);
    rate_ = small_rate * k;
    modulus_ = 1.0 / k;
    complement_ = std::sqrt(-below_top) / k;
    quarter_ = complete_integral(complement_);
    // theta / 2 = am, theta' = 2 rate dn.
    phase_ = incomplete_integral(side_ * sine, cosine, speed / k);
}

PendulumState Swing::at(double time) const {
    if (kind_ == Kind::drifts) return {start_.angle + start_.velocity * time, start_.velocity};
    const double u = phase_ + rate_ * time;
    if (kind_ == Kind::swings) {
        const double angle = amplitude(wrapped(u, 4.0 * quarter_), modulus_, complement_);
        const double sine = modulus_ * std::sin(angle);
        const double cosine = std::cos(angle);
        return {turns_ + 2.0 * std::atan2(sine, std::hypot(complement_, modulus_ * cosine)),
                2.0 * modulus_ * rate_ * cosine};
    }
    const double cycle = 2.0 * quarter_;
    const double rest = wrapped(u, cycle);
    const double cycles = std::isfinite(cycle) ? std::round((u - rest) / cycle) : 0.0;
    const double angle = amplitude(rest, modulus_, complement_);
    const double delta = std::hypot(complement_, modulus_ * std::cos(angle));
    return {turns_ + side_ * (turn * cycles + 2.0 * angle), side_ * 2.0 * rate_ * delta};
}

double Swing::period() const {
    if (kind_ == Kind::drifts) return std::numeric_limits<double>::infinity();
    return (kind_ == Kind::swings ? 4.0 : 2.0) * quarter_ / rate_;
}

}  // namespace motus::dynamics
