// Arc length of a curve and its inverse (arc-length parametrization), to 1e-10 of the length and better.
//
// Costs: O(n) adaptive steps to build the tables, which are allocated; O(log n) for a length, O(1) for a
// parameter, without allocating but for the first one, which builds the inverse. Any number of threads at
// once.
#pragma once
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>

#include "motus/curve/curve.hpp"

namespace motus::curve {

class SpeedTable;
class InverseTable;

/// Arc length tables of one curve: immutable as seen from outside, safe to share between threads. Answers
/// depend on the curve and the argument alone.
///
/// Forward: the speed |C'(t)| as Chebyshev series over adaptive pieces of t (cusps included), integrated term
/// by term: adaptive Clenshaw-Curtis quadrature whose running integral is a polynomial, too. Inverse: t(s) as
/// polynomials over adaptive intervals of s, refined until the distance error, measured against the forward
/// table, is <= 1e-12 of the length; a uniform bucket index makes the look-up O(1). Built on first use.
class ArcLength {
  public:
    explicit ArcLength(Curve curve);
    ~ArcLength();
    ArcLength(const ArcLength&) = delete;
    ArcLength& operator=(const ArcLength&) = delete;
    ArcLength(ArcLength&&) = delete;
    ArcLength& operator=(ArcLength&&) = delete;

    [[nodiscard]] const Curve& curve() const noexcept { return curve_; }
    /// Total length in the curve's unit; gaps between segments do not count. 0 for a degenerate curve.
    [[nodiscard]] double length() const noexcept { return length_; }
    /// Distance along the curve at parameter t (clamped). Error <= 1e-12 of the length.
    [[nodiscard]] double length_at(double t) const;
    /// Parameter at distance s (clamped). Error <= 1e-10 of the length in s. On a segment of zero length, all
    /// of whose parameters have one distance, one of them; 0 on a curve of zero length.
    [[nodiscard]] double t_at_length(double s) const;
    /// Distance at which segment i begins; i = segment_count() gives the length.
    [[nodiscard]] double segment_start(std::size_t index) const;

    /// Evaluations of the curve that building took, and intervals of the inverse (which this builds), for
    /// tests that count work, since milliseconds depend on the machine.
    [[nodiscard]] std::size_t evaluation_count() const noexcept;
    [[nodiscard]] std::size_t interval_count() const;
    /// Bytes that the tables take now; more once the inverse is built.
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    [[nodiscard]] const InverseTable& inverse() const;

    Curve curve_;
    std::unique_ptr<const SpeedTable> speed_;
    double length_ = 0.0;
    mutable std::mutex building_;
    mutable std::unique_ptr<const InverseTable> inverse_owner_;
    mutable std::atomic<const InverseTable*> inverse_{nullptr};
};

/// Distance s at which position_at_length(path, s, extend) is position(curve, t, extend): inside [0, length]
/// as ArcLength::length_at; outside, whole lengths are added (loop, ping_pong), or the speed at that end
/// times the parameter beyond it (extrapolate).
[[nodiscard]] double length_at(const ArcLength& path, double t, Extend extend);

/// Parameter at distance s, and how far s lies beyond an end of the curve (extrapolate only; < 0 before the
/// start).
[[nodiscard]] Extended t_at_length(const ArcLength& path, double s, Extend extend);

/// Position at distance s; outside [0, length] as `extend` says, extrapolated along the unit tangent of that
/// end.
[[nodiscard]] glm::dvec3 position_at_length(const ArcLength& path, double s, Extend extend = Extend::clamp);

/// Positions at many distances. Allocates nothing. Throws std::invalid_argument if the sizes differ.
void positions_at_length(const ArcLength& path, std::span<const double> s, Extend extend,
                         std::span<glm::dvec3> out);

/// Tables of a curve: from the cache, or built and then cached.
[[nodiscard]] std::shared_ptr<const ArcLength> shared_arc_length(const Curve& curve);

}  // namespace motus::curve
