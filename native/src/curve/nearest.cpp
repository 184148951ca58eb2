#include "motus/curve/nearest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <stdexcept>

#include "bernstein.hpp"

namespace motus::curve {
namespace {

// At this depth a part is as wide as the rounding of its parameter.
constexpr int deepest = 50;

/// Parameter, 0 to 1, of the point nearest to the origin on the straight line from a to b.
[[nodiscard]] double foot(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 chord = b - a;
    const double square = glm::dot(chord, chord);
    return square > 0.0 ? std::clamp(-glm::dot(a, chord) / square, 0.0, 1.0) : 0.0;
}

/// The curve's parameter at t in [0, 1] of a segment. The end of a segment that the next one does not begin
/// at is told by the last parameter before the gap.
[[nodiscard]] double parameter(const Curve& curve, std::size_t segment, double t) {
    const auto first = static_cast<double>(segment);
    const bool gap = t == 1.0 && segment + 1 < curve.segment_count() &&
                     curve.segment(segment).back() != curve.segment(segment + 1).front();
    return gap ? std::nextafter(first + 1.0, first) : first + t;
}

/// A point of the curve.
struct Candidate {
    std::size_t segment = 0;
    double t = 0.0;  ///< 0 to 1
    double distance = std::numeric_limits<double>::infinity();
};

/// Control points of a segment relative to `point`. Distances then do not contain the rounding of coordinates
/// far from the origin, which would hide that some parts of the curve are farther than others.
[[nodiscard]] bernstein::Points seen_from(const glm::dvec3& point, bernstein::Segment segment) {
    bernstein::Points points;
    std::transform(segment.begin(), segment.end(), points.begin(),
                   [&point](const glm::dvec3& p) { return p - point; });
    return points;
}

/// Least distance from the origin to anywhere on a segment, by the squared distance written as a Bézier
/// polynomial, which lies above its least coefficient. If all of the segment is nearly as far away, as an
/// arc is from its centre, this is far closer than what the chord says; near the segment the chord says more.
class SquaredDistance {
  public:
    explicit SquaredDistance(std::size_t size) : size_(size) {
        const auto n = static_cast<double>(size - 1);
        double of_degree = 1.0;
        for (std::size_t i = 0; i < size; ++i) {
            weight_[i] = of_degree;
            of_degree *= (n - static_cast<double>(i)) / static_cast<double>(i + 1);
        }
        double of_square = 1.0;
        for (std::size_t k = 0; k < 2 * size - 1; ++k) {
            scale_[k] = 1.0 / of_square;
            of_square *= (2.0 * n - static_cast<double>(k)) / static_cast<double>(k + 1);
        }
    }

    [[nodiscard]] double least(bernstein::Segment part) const {
        bernstein::Points weighted;
        double farthest = 0.0;
        for (std::size_t i = 0; i < size_; ++i) {
            weighted[i] = weight_[i] * part[i];
            farthest = std::max(farthest, glm::dot(part[i], part[i]));
        }
        double least = farthest;
        for (std::size_t k = 0; k < 2 * size_ - 1; ++k) {
            double sum = 0.0;
            for (std::size_t i = k < size_ ? 0 : k - size_ + 1; 2 * i <= k; ++i)
                sum += (2 * i == k ? 1.0 : 2.0) * glm::dot(weighted[i], weighted[k - i]);
            least = std::min(least, scale_[k] * sum);
        }
        // Each coefficient is a mean of products of the points, rounded once or twice for each.
        const double rounding = 4.0 * static_cast<double>(size_) * std::numeric_limits<double>::epsilon();
        return std::sqrt(std::max(0.0, least - rounding * farthest));
    }

  private:
    std::size_t size_;
    std::array<double, static_cast<std::size_t>(max_degree) + 1> weight_{};
    std::array<double, 2 * static_cast<std::size_t>(max_degree) + 1> scale_{};
};

/// Branch and bound over all segments, each seen from the point.
class Search {
  public:
    /// size: control points of a segment.
    explicit Search(std::size_t size) : square_(size) {}

    void visit(std::size_t index, bernstein::Segment segment) {
        index_ = index;
        segment_ = segment;
        tolerance_ = 1e-14 * bernstein::extent(segment);
        try_at(0.0);
        try_at(1.0);
        descend(segment, 0.0, 1.0, deepest);
    }

    [[nodiscard]] const Candidate& best() const noexcept { return best_; }
    [[nodiscard]] std::size_t parts() const noexcept { return parts_; }

  private:
    void try_at(double t) {
        const double distance = glm::length(bernstein::position(segment_, t));
        if (distance < best_.distance) best_ = {index_, t, distance};
    }

    /// Searches the part of a segment between the parameters a and b; `part` has its control points.
    void descend(bernstein::Segment part, double a, double b, int depth) {
        ++parts_;
        // The curve and its chord are no farther apart than their control points, if the chord is written
        // with as many.
        const auto n = static_cast<double>(part.size() - 1);
        double deviation = 0.0;
        for (std::size_t k = 1; k + 1 < part.size(); ++k) {
            const glm::dvec3 on_chord = bernstein::mix(part.front(), part.back(), static_cast<double>(k) / n);
            deviation = std::max(deviation, glm::distance(part[k], on_chord));
        }
        const double on_chord = foot(part.front(), part.back());
        const double bound = glm::length(bernstein::mix(part.front(), part.back(), on_chord)) - deviation;
        const double worth_it = best_.distance * (1.0 - 1e-12) - tolerance_;
        if (bound >= worth_it || square_.least(part) >= worth_it) return;
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

    SquaredDistance square_;
    std::size_t index_ = 0;
    bernstein::Segment segment_;
    double tolerance_ = 0.0;
    Candidate best_;
    std::size_t parts_ = 0;
};

/// The search ends where the distance has settled, which leaves half the digits of t: Newton's method on
/// C . C' = 0 gives the others. A step that does not bring the curve nearer is not taken.
[[nodiscard]] Candidate polished(bernstein::Segment segment, Candidate best) {
    constexpr int most_steps = 4;
    for (int step = 0; step < most_steps; ++step) {
        const Jet here = bernstein::jet(segment, best.t);
        const double slope = glm::dot(here.d1, here.d1) + glm::dot(here.position, here.d2);
        if (!(slope > 0.0)) break;
        const double t = std::clamp(best.t - glm::dot(here.position, here.d1) / slope, 0.0, 1.0);
        const double distance = glm::length(bernstein::position(segment, t));
        // An increase by one rounding is allowed: t may still gain where the distance has no digits left to
        // show it.
        if (distance > best.distance * (1.0 + 4.0 * std::numeric_limits<double>::epsilon())) break;
        best.t = t;
        best.distance = distance;
    }
    return best;
}

}  // namespace

Nearest nearest(const Curve& curve, const glm::dvec3& point) {
    const auto fits = [](double value) { return std::abs(value) <= coordinate_limit; };  // false for NaN
    if (!(fits(point.x) && fits(point.y) && fits(point.z)))
        throw std::invalid_argument("point: every coordinate must be finite, and at most 1e100");
    const std::size_t size = curve.segment(0).size();
    Search search(size);
    for (std::size_t i = 0; i < curve.segment_count(); ++i) {
        const bernstein::Points segment = seen_from(point, curve.segment(i));
        search.visit(i, {segment.data(), size});
    }
    const bernstein::Points segment = seen_from(point, curve.segment(search.best().segment));
    const Candidate best = polished({segment.data(), size}, search.best());
    const glm::dvec3 position = bernstein::position(curve.segment(best.segment), best.t);
    return {parameter(curve, best.segment, best.t), position, glm::distance(position, point), search.parts()};
}

}  // namespace motus::curve
