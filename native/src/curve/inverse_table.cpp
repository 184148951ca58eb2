#include "inverse_table.hpp"

#include <algorithm>
#include <cmath>

namespace motus::curve {
namespace {

// Largest error of an interval, as a fraction of the curve's length; shorter intervals are not divided
// further.
constexpr double distance_tolerance = 1e-12;
// Error of the fitted points, as a fraction of distance_tolerance.
constexpr double node_tolerance = 0.01;
// A stretch whose speed varies by more than this factor (towards a cusp) is divided without trying a
// polynomial.
constexpr double largest_speed_ratio = 4.0;
// Uniform buckets an interval: enough that a bucket seldom holds the start of a second one.
constexpr std::size_t buckets_an_interval = 4;
// A bucket with more intervals than this (at a cusp) is searched by bisection.
constexpr std::size_t longest_scan = 6;

using Nodes = std::array<double, inverse_degree + 1>;
using Inner = std::array<double, inverse_degree - 1>;  ///< without both ends
using Gaps = std::array<double, inverse_degree>;       ///< between neighbouring nodes

/// A stretch of a piece: its ends as x, and its middle and half length as distances from the start of the
/// piece.
struct Stretch {
    const SpeedPiece& piece;
    double x0;
    double x1;
    double middle;
    double half;
};

[[nodiscard]] Stretch stretch(const SpeedPiece& piece, double x0, double x1) {
    const double s0 = x0 > -1.0 ? piece.distance_at(x0) : 0.0;
    const double s1 = x1 < 1.0 ? piece.distance_at(x1) : piece.length;
    return {piece, x0, x1, 0.5 * (s0 + s1), 0.5 * (s1 - s0)};
}

/// x in [low, high] at which the distance is s, by Newton's method within a shrinking bracket.
[[nodiscard]] double solve(const SpeedPiece& piece, double s, double low, double high, double residual) {
    constexpr int most_steps = 80;  // bisection alone would be through after 60
    double x = 0.5 * (low + high);
    for (int step = 0; step < most_steps; ++step) {
        const double excess = piece.distance_at(x) - s;
        if (std::abs(excess) <= residual) break;
        (excess < 0.0 ? low : high) = x;
        const double next = x - excess / chebyshev::evaluate(piece.speed, x);
        // The comparison is false for a NaN, too: the speed is 0 at a cusp.
        x = next > low && next < high ? next : 0.5 * (low + high);
    }
    return x;
}

/// x at the distances `s` of a stretch: Newton's method for all at once, and one by one if that does not
/// settle.
[[nodiscard]] Inner solve(const Stretch& part, const Inner& s, double residual) {
    constexpr int most_steps = 4;
    const double slope = 0.5 * (part.x1 - part.x0) / part.half;
    Inner x{};
    for (std::size_t j = 0; j < x.size(); ++j)
        x[j] = 0.5 * (part.x0 + part.x1) + slope * (s[j] - part.middle);
    for (int step = 0; step < most_steps; ++step) {
        const Inner distance = chebyshev::evaluate(part.piece.distance, x);
        const Inner speed = chebyshev::evaluate(part.piece.speed, x);
        double largest = 0.0;
        for (std::size_t j = 0; j < x.size(); ++j) {
            const double excess = distance[j] - s[j];
            largest = std::max(largest, std::abs(excess));
            x[j] = std::clamp(x[j] - excess / speed[j], part.x0, part.x1);
        }
        // The step just taken squares the error.
        if (largest * largest <= 0.01 * residual * part.half) return x;
    }
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = solve(part.piece, s[j], part.x0, part.x1, residual);
    return x;
}

/// x at the interpolation points of a stretch.
[[nodiscard]] Nodes solve_nodes(const Stretch& part, double residual) {
    const auto& u = chebyshev::lobatto_points<inverse_degree>();
    Inner s{};
    for (std::size_t j = 0; j < s.size(); ++j) s[j] = part.middle + part.half * u[j + 1];
    const Inner inner = solve(part, s, residual);
    Nodes x{};
    x.front() = part.x1;
    std::copy(inner.begin(), inner.end(), x.begin() + 1);
    x.back() = part.x0;
    return x;
}

/// Whether the speed is even enough for a polynomial t(s) to be worth a try.
[[nodiscard]] bool even(const Stretch& part) {
    const std::array x{part.x0, 0.5 * (part.x0 + part.x1), part.x1};
    const auto speed = chebyshev::evaluate(part.piece.speed, x);
    const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end());
    return *fastest <= largest_speed_ratio * *slowest;
}

/// Coefficients of 1, u, u^2, ... from those of T_0, T_1, T_2, ...
[[nodiscard]] Nodes monomials(const chebyshev::Series<inverse_degree>& series) {
    static const auto matrix = [] {
        std::array<Nodes, inverse_degree + 1> t{};  // t[k][i]: coefficient of u^i in T_k
        t[0][0] = 1.0;
        t[1][1] = 1.0;
        for (std::size_t k = 2; k <= inverse_degree; ++k) {
            for (std::size_t i = 0; i <= inverse_degree; ++i)
                t[k][i] = (i > 0 ? 2.0 * t[k - 1][i - 1] : 0.0) - t[k - 2][i];
        }
        return t;
    }();
    Nodes c{};
    for (std::size_t k = 0; k <= inverse_degree; ++k) {
        for (std::size_t i = k % 2; i <= k; i += 2) c[i] += series[k] * matrix[k][i];
    }
    return c;
}

/// Largest distance error of a polynomial around the middle of a stretch, between the points it was fitted
/// at.
template <class Polynomial>
[[nodiscard]] double largest_error(const Stretch& part, const Polynomial& polynomial) {
    const auto& u = chebyshev::lobatto_points<inverse_degree>();
    Gaps s{};
    Gaps x{};
    for (std::size_t j = 0; j < s.size(); ++j) {
        s[j] = part.piece.start + part.middle + part.half * 0.5 * (u[j] + u[j + 1]);
        x[j] = 0.5 * (part.x0 + part.x1) + polynomial(s[j]) / part.piece.half;
    }
    const Gaps distance = chebyshev::evaluate(part.piece.distance, x);
    double largest = 0.0;
    for (std::size_t j = 0; j < s.size(); ++j)
        largest = std::max(largest, std::abs(part.piece.start + distance[j] - s[j]));
    return largest;
}

}  // namespace

InverseTable::InverseTable(const SpeedTable& table) {
    const double tolerance = distance_tolerance * table.length();
    polynomials_.reserve(2 * table.pieces().size());
    starts_.reserve(2 * table.pieces().size() + 1);
    for (const SpeedPiece& piece : table.pieces()) {
        if (piece.length > 0.0) refine(piece, -1.0, 1.0, tolerance);
    }
    const SpeedPiece& last = table.pieces().back();
    starts_.push_back({table.length(), last.middle + last.half});
    polynomials_.shrink_to_fit();
    starts_.shrink_to_fit();
    index(table.length());
}

void InverseTable::refine(const SpeedPiece& piece, double x0, double x1, double tolerance) {
    const Stretch part = stretch(piece, x0, x1);
    if (!(part.half > 0.0)) return;
    Polynomial polynomial{piece.start + part.middle, 1.0 / part.half, {}};
    const double center = 0.5 * (x0 + x1);
    const auto divide = [&] {
        refine(piece, x0, center, tolerance);
        refine(piece, center, x1, tolerance);
    };
    if (2.0 * part.half <= tolerance) {
        polynomial.c[1] = piece.half * 0.5 * (x1 - x0);
    } else {
        if (!even(part)) return divide();
        // Fitted around the middle: the coefficients then carry no rounding of t itself.
        Nodes t = solve_nodes(part, node_tolerance * tolerance);
        for (double& node : t) node = piece.half * (node - center);
        polynomial.c = monomials(chebyshev::interpolate<inverse_degree>(t));
        if (largest_error(part, polynomial) > tolerance) return divide();
    }
    polynomial.c[0] += piece.t(center);
    starts_.push_back({piece.start + part.middle - part.half, piece.t(x0)});
    polynomials_.push_back(polynomial);
}

void InverseTable::index(double length) {
    const std::size_t count = buckets_an_interval * polynomials_.size();
    buckets_per_length_ = static_cast<double>(count) / length;
    // bucket() rises with s and may round a distance just below the length up to `count`.
    lowest_.assign(count + 2, 0);
    std::size_t interval = 0;
    for (std::size_t b = 0; b < lowest_.size(); ++b) {
        while (interval + 1 < polynomials_.size() && bucket(starts_[interval + 1].s) < b) ++interval;
        lowest_[b] = static_cast<std::uint32_t>(interval);
    }
}

double InverseTable::t_at(double s) const noexcept {
    const std::size_t b = bucket(s);
    std::size_t i = lowest_[b];
    const std::size_t last = lowest_[b + 1];
    if (last - i > longest_scan) {
        const auto begin = starts_.begin();
        const auto after = std::partition_point(begin + static_cast<std::ptrdiff_t>(i) + 1,
                                                begin + static_cast<std::ptrdiff_t>(last) + 1,
                                                [s](const Start& start) { return start.s <= s; });
        i = static_cast<std::size_t>(after - begin) - 1;
    } else {
        while (i < last && starts_[i + 1].s <= s) ++i;
    }
    // Held inside the interval: rounding must not cross a gap between segments.
    return std::clamp(polynomials_[i](s), starts_[i].t, starts_[i + 1].t);
}

}  // namespace motus::curve
