// Piecewise Bézier curves of any degree.
// Bernstein form and de Casteljau evaluation: Farin, "Curves and Surfaces for CAGD" (5th ed., 2002), ch. 4-5.
//
// Costs: O(n) to make a curve, which allocates its points; O(degree) to evaluate one, which allocates
// nothing. Any number of threads may share one.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "motus/config.hpp"
#include "motus/curve/extend.hpp"

namespace motus::curve {

/// Highest degree evaluated; above it the Bernstein form loses too many digits to keep the stated errors.
inline constexpr int max_degree = 64;

/// Largest size of a coordinate: with larger ones products of derivatives would overflow. Curves with larger
/// coordinates are refused as those with infinite ones are.
inline constexpr double coordinate_limit = 1e100;

/// A chain of Bézier segments of one degree. Any space, any unit of length. An immutable value: copies share
/// the control points, and to move one is to copy it.
///
/// The parameter t runs over [0, segment_count()]: segment i covers [i, i + 1]. Every segment owns its degree
/// + 1 control points, so that neighbours may also be apart (several splines ridden as one path).
class Curve {
  public:
    /// One Bézier segment of degree control_points.size() - 1 >= 1.
    /// Throws std::invalid_argument if there are fewer than 2 or more than max_degree + 1 points, or one
    /// is not finite.
    [[nodiscard]] static Curve bezier(std::span<const glm::dvec3> control_points);

    /// Cubic segments through `points` with Blender's two handles a point; `cyclic` adds the segment last ->
    /// first. Throws std::invalid_argument if sizes differ, fewer than 2 points are given, or one is not
    /// finite.
    [[nodiscard]] static Curve spline(std::span<const glm::dvec3> points,
                                      std::span<const glm::dvec3> handles_left,
                                      std::span<const glm::dvec3> handles_right, bool cyclic);

    /// Segments of one degree, control points segment by segment: size = segments * (degree + 1). `cyclic`
    /// says that the last segment ends where the first begins; it adds nothing. Throws std::invalid_argument
    /// as bezier() does.
    [[nodiscard]] static Curve chain(int degree, std::span<const glm::dvec3> control_points, bool cyclic);

    [[nodiscard]] int degree() const noexcept { return degree_; }
    [[nodiscard]] std::size_t segment_count() const noexcept { return points_->size() / segment_size(); }
    [[nodiscard]] bool cyclic() const noexcept { return cyclic_; }
    /// All control points, segment by segment.
    [[nodiscard]] std::span<const glm::dvec3> control_points() const noexcept { return *points_; }
    [[nodiscard]] std::span<const glm::dvec3> segment(std::size_t index) const noexcept {
        return control_points().subspan(index * segment_size(), segment_size());
    }

    [[nodiscard]] friend bool operator==(const Curve& a, const Curve& b) noexcept {
        return a.degree_ == b.degree_ && a.cyclic_ == b.cyclic_ &&
               (a.points_ == b.points_ || *a.points_ == *b.points_);
    }

    ~Curve() = default;
    Curve(const Curve&) noexcept = default;
    Curve& operator=(const Curve&) noexcept = default;
    // A curve that is moved from stays the curve that it was.
    // NOLINTNEXTLINE(performance-move-constructor-init): copying is what it is for, and costs a counter
    Curve(Curve&& other) noexcept : Curve(std::as_const(other)) {}
    Curve& operator=(Curve&& other) noexcept { return *this = std::as_const(other); }

  private:
    Curve(int degree, std::vector<glm::dvec3> points, bool cyclic);
    [[nodiscard]] std::size_t segment_size() const noexcept { return static_cast<std::size_t>(degree_) + 1; }

    int degree_ = 1;
    bool cyclic_ = false;
    std::shared_ptr<const std::vector<glm::dvec3>> points_;  ///< never null
};

/// The segment that a parameter of the curve (clamped) lies in, and the parameter in that segment, 0 to 1.
struct Location {
    std::size_t segment = 0;
    double t = 0.0;
};
[[nodiscard]] Location locate(const Curve& curve, double t) noexcept;

/// Position at t (clamped to the curve's interval).
[[nodiscard]] glm::dvec3 position(const Curve& curve, double t);

/// Position at t; outside the curve's interval as `extend` says. Extrapolated, t goes on with the end's
/// derivative.
[[nodiscard]] glm::dvec3 position(const Curve& curve, double t, Extend extend);

/// Derivative of the given order (1 to 3) with respect to t (clamped); at a joint the one of the segment that
/// begins there. Throws std::invalid_argument for another order.
[[nodiscard]] glm::dvec3 derivative(const Curve& curve, double t, int order = 1);

/// Outside the curve's interval the derivative of position(curve, t, extend): on the way back of ping_pong
/// the odd orders change their sign, extrapolated the first derivative is that of the end and the others
/// are 0. Clamped, all are those of the end.
[[nodiscard]] glm::dvec3 derivative(const Curve& curve, double t, int order, Extend extend);

/// Position and the first three derivatives in one pass.
struct Jet {
    glm::dvec3 position{0.0};
    glm::dvec3 d1{0.0};
    glm::dvec3 d2{0.0};
    glm::dvec3 d3{0.0};
};
[[nodiscard]] Jet jet(const Curve& curve, double t);
/// Position and derivatives at a Location; t = 1 is the end of its segment, not the start of the next one.
[[nodiscard]] Jet jet(const Curve& curve, const Location& at);

/// Unit tangent. Where the first derivative vanishes (cusp, handle on its point) the limit from the right, or
/// at the end of the curve from the left; on a segment of zero length that of the next one that has a length,
/// else of the one before; (0, 1, 0) on a curve of zero length.
[[nodiscard]] glm::dvec3 tangent(const Curve& curve, double t);

/// Direction in which position(curve, t, extend) moves as t grows: turned back on the way back of ping_pong.
[[nodiscard]] glm::dvec3 tangent(const Curve& curve, double t, Extend extend);

/// Curvature |C' x C''| / |C'|^3, 1 / length unit. Where C' vanishes, the limit: infinity at a cusp, 0 on a
/// straight stretch and on a segment of zero length.
[[nodiscard]] double curvature(const Curve& curve, double t);

/// Curvature of position(curve, t, extend): 0 if it goes on straight.
[[nodiscard]] double curvature(const Curve& curve, double t, Extend extend);

/// Torsion (C' x C'') . C''' / |C' x C''|^2, 1 / length unit; 0 where the curvature is 0 or infinite.
[[nodiscard]] double torsion(const Curve& curve, double t);

/// Torsion of position(curve, t, extend): 0 if it goes on straight; the same forth and back.
[[nodiscard]] double torsion(const Curve& curve, double t, Extend extend);

}  // namespace motus::curve
