#include "motus/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "bernstein.hpp"

namespace motus {
namespace {

// At this depth a part is as wide as the rounding of its parameter.
constexpr int deepest = 50;

/// Parameter, 0 to 1, of the point nearest to `point` on the straight line from a to b.
[[nodiscard]] double foot(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& point) {
    const glm::dvec3 chord = b - a;
    const double square = glm::dot(chord, chord);
    return square > 0.0 ? std::clamp(glm::dot(point - a, chord) / square, 0.0, 1.0) : 0.0;
}

/// The curve's parameter at t in [0, 1] of a segment. The end of a segment that the next one does not begin
/// at is told by the last parameter before the gap.
[[nodiscard]] double parameter(const Curve& curve, std::size_t segment, double t) {
    const auto first = static_cast<double>(segment);
    const bool gap = t == 1.0 && segment + 1 < curve.segment_count() &&
                     curve.segment(segment).back() != curve.segment(segment + 1).front();
    return gap ? std::nextafter(first + 1.0, first) : first + t;
}

class Search {
  public:
    Search(const Curve& curve, const glm::dvec3& point) : curve_(curve), point_(point) {}

    void visit(std::size_t index) {
        const bernstein::Segment segment = curve_.segment(index);
        tolerance_ = 1e-14 * bernstein::extent(segment);
        index_ = index;
        try_at(0.0);
        try_at(1.0);
        descend(segment, 0.0, 1.0, deepest);
    }

    [[nodiscard]] const Nearest& best() const noexcept { return best_; }

  private:
    void try_at(double t) {
        const glm::dvec3 position = bernstein::position(curve_.segment(index_), t);
        const double distance = glm::distance(position, point_);
        if (distance < best_.distance) best_ = {parameter(curve_, index_, t), position, distance};
    }

    /// Looks through the part a to b, whose control points these are.
    void descend(bernstein::Segment part, double a, double b, int depth) {
        // The curve and its chord, written with as many control points, are no farther apart than those are.
        const auto n = static_cast<double>(part.size() - 1);
        double deviation = 0.0;
        for (std::size_t k = 1; k + 1 < part.size(); ++k) {
            const glm::dvec3 on_chord = bernstein::mix(part.front(), part.back(), static_cast<double>(k) / n);
            deviation = std::max(deviation, glm::distance(part[k], on_chord));
        }
        const double on_chord = foot(part.front(), part.back(), point_);
        const double bound =
            glm::distance(bernstein::mix(part.front(), part.back(), on_chord), point_) - deviation;
        if (bound >= best_.distance * (1.0 - 1e-12) - tolerance_) return;
        try_at(a + (b - a) * on_chord);
        if (depth == 0) return;
        bernstein::Points left_points;
        bernstein::Points right_points;
        const std::span<glm::dvec3> left(left_points.data(), part.size());
        const std::span<glm::dvec3> right(right_points.data(), part.size());
        bernstein::split(part, 0.5, left, right);
        const double middle = 0.5 * (a + b);
        descend(left, a, middle, depth - 1);
        descend(right, middle, b, depth - 1);
    }

    const Curve& curve_;
    glm::dvec3 point_;
    std::size_t index_ = 0;
    double tolerance_ = 0.0;
    Nearest best_{0.0, glm::dvec3(0.0), std::numeric_limits<double>::infinity()};
};

/// The search ends where the distance has settled, which leaves half the digits of t: Newton's method on
/// (C - point) . C' = 0 gives the others. A step that does not bring the curve nearer is not taken.
[[nodiscard]] Nearest polished(const Curve& curve, const glm::dvec3& point, Nearest best) {
    constexpr int most_steps = 4;
    const Location at = locate(curve, best.t);
    const auto first = static_cast<double>(at.segment);
    for (int step = 0; step < most_steps; ++step) {
        const Jet here = bernstein::jet(curve.segment(at.segment), best.t - first);
        const glm::dvec3 away = here.position - point;
        const double slope = glm::dot(here.d1, here.d1) + glm::dot(away, here.d2);
        if (!(slope > 0.0)) break;
        const double t = std::clamp(best.t - first - glm::dot(away, here.d1) / slope, 0.0, 1.0);
        const glm::dvec3 position = bernstein::position(curve.segment(at.segment), t);
        const double distance = glm::distance(position, point);
        // One rounding more is let pass: t may still gain where the distance has no digits left to show it.
        if (distance > best.distance * (1.0 + 4.0 * std::numeric_limits<double>::epsilon())) break;
        best = {parameter(curve, at.segment, t), position, distance};
    }
    return best;
}

}  // namespace

Nearest nearest(const Curve& curve, const glm::dvec3& point) {
    Search search(curve, point);
    for (std::size_t i = 0; i < curve.segment_count(); ++i) search.visit(i);
    return polished(curve, point, search.best());
}

}  // namespace motus
