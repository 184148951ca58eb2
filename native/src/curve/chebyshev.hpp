// Chebyshev series on [-1, 1] from values at the Lobatto points. Trefethen, "Approximation Theory and
// Approximation Practice" (2013), ch. 3-4 and 19. Private to the library.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace motus::curve::chebyshev {

/// Coefficients of T_0 to T_degree.
template <std::size_t degree>
using Series = std::array<double, degree + 1>;

/// cos(pi j / degree): from 1 down to -1, exact at both ends and in the middle.
template <std::size_t degree>
[[nodiscard]] inline const std::array<double, degree + 1>& lobatto_points() {
    static const auto points = [] {
        std::array<double, degree + 1> x{};
        for (std::size_t j = 0; j <= degree; ++j) {
            // Computed by the sine, which is odd, so that the points are exactly symmetric.
            const double from_middle = static_cast<double>(degree) - 2.0 * static_cast<double>(j);
            x[j] = std::sin(0.5 * std::numbers::pi * from_middle / static_cast<double>(degree));
        }
        return x;
    }();
    return points;
}

/// The series of the given degree through values at lobatto_points().
template <std::size_t degree>
[[nodiscard]] inline Series<degree> interpolate(const std::array<double, degree + 1>& values) {
    static const auto matrix = [] {
        std::array<std::array<double, degree + 1>, degree + 1> m{};
        for (std::size_t k = 0; k <= degree; ++k) {
            for (std::size_t j = 0; j <= degree; ++j) {
                const double weight = (k % degree == 0 ? 0.5 : 1.0) * (j % degree == 0 ? 0.5 : 1.0);
                const double angle = std::numbers::pi * static_cast<double>((j * k) % (2 * degree));
                m[j][k] = weight * 2.0 / static_cast<double>(degree) *
                          std::cos(angle / static_cast<double>(degree));
            }
        }
        return m;
    }();
    Series<degree> series{};
    for (std::size_t j = 0; j <= degree; ++j) {
        for (std::size_t k = 0; k <= degree; ++k) series[k] += matrix[j][k] * values[j];
    }
    return series;
}

/// The integral from -1 to x.
template <std::size_t degree>
[[nodiscard]] inline Series<degree + 1> integrate(const Series<degree>& series) {
    const auto a = [&](std::size_t k) { return k <= degree ? series[k] : 0.0; };
    Series<degree + 1> integral{};
    integral[1] = a(0) - 0.5 * a(2);
    for (std::size_t k = 2; k <= degree + 1; ++k)
        integral[k] = (a(k - 1) - a(k + 1)) / (2.0 * static_cast<double>(k));
    for (std::size_t k = 1; k <= degree + 1; ++k) integral[0] += k % 2 == 1 ? integral[k] : -integral[k];
    return integral;
}

/// Clenshaw's scheme at many points side by side, which hides the latency of its recurrence.
template <std::size_t terms, std::size_t count>
[[nodiscard]] inline std::array<double, count> evaluate(const std::array<double, terms>& series,
                                                        const std::array<double, count>& x) {
    std::array<double, count> b1{};
    std::array<double, count> b2{};
    for (std::size_t k = terms - 1; k > 0; --k) {
        for (std::size_t i = 0; i < count; ++i) {
            const double b0 = series[k] + (2.0 * x[i] * b1[i] - b2[i]);
            b2[i] = b1[i];
            b1[i] = b0;
        }
    }
    for (std::size_t i = 0; i < count; ++i) b1[i] = series[0] + (x[i] * b1[i] - b2[i]);
    return b1;
}

/// Clenshaw's scheme at one point.
template <std::size_t terms>
[[nodiscard]] inline double evaluate(const std::array<double, terms>& series, double x) {
    return evaluate(series, std::array{x})[0];
}

}  // namespace motus::curve::chebyshev
