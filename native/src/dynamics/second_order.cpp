#include "motus/dynamics/second_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "motus/core/numeric.hpp"

namespace motus::dynamics {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double most = 1e100;  // of the numbers of a filter: their products are numbers too

/// exp(-damping w h) times cos and sin(wd h) / wd, or their hyperbolic likes above critical damping; at
/// critical damping both forms end in h.
struct Waves {
    double even = 1.0;
    double odd = 0.0;
};

[[nodiscard]] Waves waves(double rate, double damping, double time) {
    if (damping < 1.0) {
        const double wd = rate * std::sqrt((1.0 - damping) * (1.0 + damping));
        const double decay = std::exp(-damping * rate * time);
        constexpr double farthest = 1e300;  // a number without an angle
        const double angle = std::min(wd * time, farthest);
        return {decay * std::cos(angle), wd > 0.0 ? decay * std::sin(angle) / wd : decay * time};
    }
    // exp(-(damping w - b) h) is taken out: it neither overflows nor loses digits.
    const double root = std::sqrt((damping - 1.0) * (damping + 1.0));
    const double b = rate * root;
    const double slow = std::exp(-rate / (damping + root) * time);
    const double fast_less_one = std::expm1(-2.0 * b * time);  // exp(-2 b h) - 1
    return {slow * (1.0 + 0.5 * fast_less_one), b > 0.0 ? slow * fast_less_one / (-2.0 * b) : slow * time};
}

[[nodiscard]] double deviation(const SecondOrder& filter, double time) {
    return step_response(filter, time).value - 1.0;
}

/// First time > 0 at which the step response turns back from a maximum; infinity if it does not.
[[nodiscard]] double first_maximum(const SecondOrder& filter) {
    // The derivative is exp(-a t) (v0 c + q s), with the waves c and s.
    const double w = filter.rate();
    const double v0 = filter.lead() * w * w;
    const double a = filter.damping() * w;
    const double q = w * w - a * v0;
    if (filter.damping() < 1.0) {
        const double wd = w * std::sqrt((1.0 - filter.damping()) * (1.0 + filter.damping()));
        double angle = std::atan2(q, v0 * wd) + 0.5 * std::numbers::pi;
        if (angle <= 0.0) angle += turn;
        return angle / wd;
    }
    if (!(v0 > 0.0 && q < 0.0)) return std::numeric_limits<double>::infinity();
    const double b = w * std::sqrt((filter.damping() - 1.0) * (filter.damping() + 1.0));
    const double tanh = v0 * b / -q;
    if (tanh >= 1.0) return std::numeric_limits<double>::infinity();
    return v0 / -q * (tanh > 0.0 ? std::atanh(tanh) / tanh : 1.0);
}

/// Where `f`, of different signs at both ends, is zero.
template <class Function>
[[nodiscard]] double bisect(double low, double high, Function&& f) {
    const bool rises = f(high) > 0.0;
    for (;;) {
        const double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) return middle;
        ((f(middle) > 0.0) == rises ? high : low) = middle;
    }
}

}  // namespace

SecondOrder::SecondOrder(Raw /*raw*/, double rate, double damping, double lead)
    : rate_(rate), damping_(damping), lead_(lead) {}

SecondOrder::SecondOrder(double frequency, double damping, double response)
    : SecondOrder(Raw{}, turn * frequency, damping, response * damping / (turn * frequency)) {
    require(frequency >= 1.0 / most && frequency <= most, "frequency: must be from 1e-100 to 1e100");
    require(damping >= 0.0 && damping <= most, "damping: must be from 0 to 1e100");
    require(std::abs(response) <= most, "response: must be from -1e100 to 1e100");
}

SecondOrder SecondOrder::from_coefficients(const Coefficients& coefficients) {
    const auto [k1, k2, k3] = coefficients;
    require(k2 >= 1.0 / most && k2 <= most, "k2: must be from 1e-100 to 1e100");
    const double root = std::sqrt(k2);
    require(k1 >= 0.0 && k1 <= most * root, "k1: must be from 0 to 1e100 times the root of k2");
    require(std::abs(k3) <= most * root, "k3: must be within 1e100 times the root of k2");
    return {Raw{}, 1.0 / root, 0.5 * k1 / root, k3};
}

SecondOrder SecondOrder::from_mass_spring(double mass, double stiffness, double resistance) {
    require(mass > 0.0 && std::isfinite(mass), "mass: must be greater than 0 and finite");
    require(stiffness > 0.0 && std::isfinite(stiffness), "stiffness: must be greater than 0 and finite");
    require(resistance >= 0.0 && std::isfinite(resistance), "resistance: must be at least 0 and finite");
    const double k1 = resistance / stiffness, k2 = mass / stiffness;
    require(k2 >= 1.0 / most && k2 <= most, "mass: must be from 1e-100 to 1e100 times the stiffness");
    require(k1 <= most * std::sqrt(k2), "resistance: must be lower for so little mass and stiffness");
    return from_coefficients({k1, k2, k1});
}

SecondOrder SecondOrder::from_overshoot(double overshoot, double settling, double response,
                                        double tolerance) {
    require(overshoot > 0.0 && overshoot < 1.0, "overshoot: must lie between 0 and 1");
    require(settling > 0.0 && std::isfinite(settling), "settling: must be greater than 0 and finite");
    require(std::abs(response) <= most, "response: must be from -1e100 to 1e100");
    require(tolerance > 0.0 && tolerance < 1.0, "tolerance: must lie between 0 and 1");
    constexpr double most_damping = 100.0;
    const auto excess = [&](double damping) {
        return dynamics::overshoot(SecondOrder(1.0, damping, response)) - overshoot;
    };
    require(excess(most_damping) < 0.0, "overshoot: must be larger: with this response it never is as small");
    const double damping = bisect(0.0, most_damping, excess);
    // All times go with 1 / frequency.
    const double at_one = settling_time(SecondOrder(1.0, damping, response), tolerance);
    const double frequency = at_one / settling;
    require(frequency >= 1.0 / most && frequency <= most,
            "settling: must give a frequency from 1e-100 to 1e100");
    return {frequency, damping, response};
}

double SecondOrder::frequency() const noexcept {
    return rate_ / turn;
}

double SecondOrder::response() const noexcept {
    return damping_ > 0.0 ? lead_ * rate_ / damping_ : 0.0;
}

Coefficients SecondOrder::coefficients() const noexcept {
    return {2.0 * damping_ / rate_, 1.0 / (rate_ * rate_), lead_};
}

Response step_response(const SecondOrder& filter, double time) {
    if (time < 0.0) return {};
    const double w = filter.rate();
    const double v0 = filter.lead() * w * w;
    const auto [c, s] = waves(w, filter.damping(), time);
    const double a = filter.damping() * w;
    return {1.0 - c - (a - v0) * s, v0 * c + (w * w - a * v0) * s};
}

double overshoot(const SecondOrder& filter) {
    const double time = first_maximum(filter);
    return std::isfinite(time) ? std::max(deviation(filter, time), 0.0) : 0.0;
}

double settling_time(const SecondOrder& filter, double tolerance) {
    require(tolerance > 0.0 && std::isfinite(tolerance), "tolerance: must be greater than 0 and finite");
    if (filter.damping() == 0.0) return std::numeric_limits<double>::infinity();
    const auto outside = [&](double time) { return std::abs(deviation(filter, time)) - tolerance; };
    double last = 0.0;  // an extremum outside the tolerance, or the step itself; inside from `next` on
    double next = 0.0;
    if (const double first = first_maximum(filter); filter.damping() < 1.0) {
        // The extrema lie half a period apart, and each is smaller than the one before by the same factor.
        const double wd = filter.rate() * std::sqrt((1.0 - filter.damping()) * (1.0 + filter.damping()));
        const double half = std::numbers::pi / wd;
        double extremum = first > half ? first - half : first;
        const double size = std::abs(deviation(filter, extremum));
        const double decay = filter.damping() * filter.rate() * half;
        const double more = size > tolerance ? std::floor(std::log(size / tolerance) / decay) : -1.0;
        if (more >= 0.0) last = extremum + more * half;
        next = extremum + (more + 1.0) * half;
        // Rounding of the logarithm may be off by one at an extremum as large as the tolerance.
        if (outside(next) > 0.0) {
            last = next;
            next += half;
        }
    } else {
        if (std::isfinite(first) && outside(first) > 0.0) last = first;
        next = std::max(last, 1.0 / filter.rate());
        while (outside(next) > 0.0) next *= 2.0;
    }
    return outside(last) > 0.0 ? bisect(last, next, outside) : 0.0;
}

Step make_step(const SecondOrder& filter, double length) {
    require(length >= 0.0 && std::isfinite(length), "length: must be at least 0 and finite");
    const double w = filter.rate();
    const auto [c, s] = waves(w, filter.damping(), length);
    const double a = filter.damping() * w;
    return {length, filter.lead() - filter.coefficients().k1, c + a * s, s, -w * w * s, c - a * s};
}

}  // namespace motus::dynamics
