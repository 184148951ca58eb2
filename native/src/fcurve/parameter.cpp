#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "motus/fcurve/fcurve.hpp"

namespace motus::fcurve {
namespace {

// --- single precision, by Blender's formulas --------------------------------------------------------------

[[nodiscard]] double cube_root(double x) {
    if (x == 0.0) return 0.0;
    // As Blender has it; std::cbrt differs in the last bits.
    return std::copysign(std::exp(std::log(std::abs(x)) / 3.0), x);
}

/// Whether a root of a cubic equation lies in the piece, by Blender's bounds.
[[nodiscard]] bool is_within(float root) {
    return root >= -1e-10f && root <= 1.000001f;
}

/// The first of the roots that lies in the piece.
template <class... Roots>
[[nodiscard]] std::optional<float> first_within(Roots... roots) {
    for (const double root : {static_cast<double>(roots)...})
        if (is_within(static_cast<float>(root))) return static_cast<float>(root);
    return std::nullopt;
}

/// Of c0 + c1 t + c2 t^2 = 0.
[[nodiscard]] std::optional<float> root_of(double c0, double c1, double c2) {
    if (c2 != 0.0) {
        const double discriminant = c1 * c1 - 4.0 * c2 * c0;
        if (discriminant < 0.0) return std::nullopt;
        const double way = std::sqrt(discriminant);
        return first_within((-c1 - way) / (2.0 * c2), (-c1 + way) / (2.0 * c2));
    }
    if (c1 != 0.0) return first_within(-c0 / c1);
    if (c0 == 0.0) return 0.0f;
    return std::nullopt;
}

/// Of c0 + c1 t + c2 t^2 + c3 t^3 = 0: Cardano's formula, with cosines where there are three roots.
[[nodiscard]] std::optional<float> root_of(double c0, double c1, double c2, double c3) {
    if (c3 == 0.0) return root_of(c0, c1, c2);
    const double a = c2 / c3 / 3.0, b = c1 / c3, c = c0 / c3;
    const double p = b / 3.0 - a * a;
    const double q = (2.0 * a * a * a - a * b + c) / 2.0;
    const double discriminant = q * q + p * p * p;
    if (discriminant > 0.0) {
        const double way = std::sqrt(discriminant);
        return first_within(cube_root(-q + way) + cube_root(-q - way) - a);
    }
    if (discriminant == 0.0) {
        const double way = cube_root(-q);
        return first_within(2.0 * way - a, -way - a);
    }
    const double angle = std::acos(-q / std::sqrt(-(p * p * p)));
    const double size = std::sqrt(-p);
    const double cosine = std::cos(angle / 3.0);
    const double sine = std::sqrt(3.0 - 3.0 * cosine * cosine);
    return first_within(2.0 * size * cosine - a, -size * (cosine + sine) - a, -size * (cosine - sine) - a);
}

// --- double precision --------------------------------------------------------------------------------------

/// The polynomial a + b t + c t^2 + d t^3 with the given Bezier control numbers.
struct Cubic {
    double a, b, c, d;

    explicit Cubic(const std::array<double, 4>& p)
        : a(p[0]),
          b(3.0 * (p[1] - p[0])),
          c(3.0 * (p[0] - 2.0 * p[1] + p[2])),
          d(p[3] - p[0] + 3.0 * (p[1] - p[2])) {}

    [[nodiscard]] double at(double t) const { return a + t * (b + t * (c + t * d)); }
    [[nodiscard]] double slope(double t) const { return b + t * (2.0 * c + t * 3.0 * d); }
};

}  // namespace

std::optional<float> parameter_at(const std::array<float, 4>& frames, float frame) {
    const auto& p = frames;
    return root_of(static_cast<double>(p[0] - frame), static_cast<double>(3.0f * (p[1] - p[0])),
                   static_cast<double>(3.0f * (p[0] - 2.0f * p[1] + p[2])),
                   static_cast<double>(p[3] - p[0] + 3.0f * (p[1] - p[2])));
}

/// Newton's method within a bracket.
std::optional<double> parameter_at(const std::array<double, 4>& frames, double frame) {
    const auto& p = frames;
    const Cubic cubic(p);
    double low = 0.0, high = 1.0;
    double t = (frame - p[0]) / (p[3] - p[0]);
    const double close = 1e-14 * std::max({std::abs(p[0]), std::abs(p[3]), p[3] - p[0]});
    for (int step = 0; step < 100; ++step) {
        const double miss = cubic.at(t) - frame;
        if (std::abs(miss) <= close) break;
        (miss > 0.0 ? high : low) = t;
        const double slope = cubic.slope(t);
        const double next = slope > 0.0 ? t - miss / slope : -1.0;
        const double last = t;
        t = next > low && next < high ? next : 0.5 * (low + high);
        if (t == last) break;
    }
    return t;
}

}  // namespace motus::fcurve
