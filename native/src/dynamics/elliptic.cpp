#include "elliptic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace motus::dynamics {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Carlson's R_F(x, y, 1); at most one of x and y may be 0.
[[nodiscard]] double carlson(double x, double y) {
    double z = 1.0;
    double mean = (x + y + z) / 3.0;
    constexpr double precise = 2.5e-3;  // the series below is then right to the last digit
    for (;;) {
        const double spread = std::max({std::abs(mean - x), std::abs(mean - y), std::abs(mean - z)}) / mean;
        if (!(spread >= precise)) break;
        const double lambda = std::sqrt(x) * std::sqrt(y) + std::sqrt(z) * (std::sqrt(x) + std::sqrt(y));
        x = 0.25 * (x + lambda);
        y = 0.25 * (y + lambda);
        z = 0.25 * (z + lambda);
        mean = (x + y + z) / 3.0;
    }
    const double a = (mean - x) / mean;
    const double b = (mean - y) / mean;
    const double c = -a - b;
    const double e2 = a * b - c * c;
    const double e3 = a * b * c;
    return (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) / std::sqrt(mean);
}

}  // namespace

double complete_integral(double complement) {
    if (complement <= 0.0) return infinite;
    double a = 1.0;
    double b = complement;
    while (std::abs(a - b) > 1e-15 * a) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return std::numbers::pi / (a + b);
}

double incomplete_integral(double sine, double cosine, double delta) {
    if (sine == 0.0) return 0.0;
    if (cosine == 0.0 && delta == 0.0) return std::copysign(infinite, sine);
    return sine * carlson(cosine * cosine, delta * delta);
}

double amplitude(double u, double modulus, double complement) {
    if (complement <= 0.0) return 2.0 * std::atan(std::tanh(0.5 * u));
    // Descending: the modulus is brought to 0, where the amplitude is the argument.
    constexpr std::size_t most =
        16;  // the complement's exponent halves each time, and then the digits double
    std::array<double, most> complements{};
    double a = 1.0;
    double b = complement;
    double c = modulus;
    std::size_t level = 0;
    for (; level < most && c > 1e-17 * a; ++level) {
        complements[level] = b / a;
        const double mean = 0.5 * (a + b);
        c = 0.5 * (a - b);
        b = std::sqrt(a * b);
        a = mean;
    }
    double angle = std::scalbn(a * u, static_cast<int>(level));
    while (level-- > 0) {
        // The modulus that this level was brought to, and its complement.
        const double above = complements[level];
        const double lower = (1.0 - above) / (1.0 + above);
        const double lower_complement = 2.0 * std::sqrt(above) / (1.0 + above);
        const double sine = std::sin(angle);
        // asin(lower * sine) without the digits that a sine near 1 loses.
        angle =
            0.5 * (angle + std::atan2(lower * sine, std::hypot(std::cos(angle), lower_complement * sine)));
    }
    return angle;
}

}  // namespace motus::dynamics
