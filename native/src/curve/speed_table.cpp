#include "speed_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

namespace motus::curve {
namespace {

// Sum of the last three coefficients, in the unit of length and as a fraction of the whole, at which a piece
// is done. The integral of what was cut off is smaller by the square of the degree.
constexpr double series_tolerance = 1e-13;
// Speeds below this are lost in the square root of their square, in the unit of length.
constexpr double lost_speed = 1e-161;
// A kink of the speed (a cusp) is halved until the piece that holds it is this short, so that 20 levels do;
// the limit only makes the end certain.
constexpr int deepest = 60;

/// First derivative of one segment, by Horner's scheme in the Bernstein basis: as stable as de Casteljau's,
/// since all weights are positive, in linear time.
class Hodograph {
  public:
    explicit Hodograph(std::span<const glm::dvec3> segment) : degree_(segment.size() - 2) {
        const auto n = static_cast<double>(segment.size() - 1);
        double binomial = 1.0;
        double largest = 0.0;
        for (std::size_t k = 0; k <= degree_; ++k) {
            const glm::dvec3 control = n * (segment[k + 1] - segment[k]);
            largest = std::max({largest, std::abs(control.x), std::abs(control.y), std::abs(control.z)});
            weighted_[k] = binomial * control;
            binomial *= static_cast<double>(degree_ - k) / static_cast<double>(k + 1);
        }
        rounding_ = n * std::numeric_limits<double>::epsilon() * largest + lost_speed;
    }

    /// Largest error of a speed: that of the control points' weighted mean.
    [[nodiscard]] double rounding() const noexcept { return rounding_; }

    [[nodiscard]] double speed(double t) const {
        const double s = 1.0 - t;
        const bool first_half = t <= 0.5;
        const double ratio = first_half ? t / s : s / t;
        const double power_base = first_half ? s : t;
        glm::dvec3 sum(0.0);
        double power = 1.0;
        for (std::size_t k = 0; k <= degree_; ++k) {
            sum = sum * ratio + weighted_[first_half ? degree_ - k : k];
            if (k > 0) power *= power_base;
        }
        return power * glm::length(sum);
    }

  private:
    std::size_t degree_;
    double rounding_ = 0.0;
    std::array<glm::dvec3, static_cast<std::size_t>(max_degree)> weighted_{};
};

/// The piece a to b of segment `index`, with its distances counted from its own start.
[[nodiscard]] SpeedPiece sample(const Hodograph& hodograph, std::size_t index, double a, double b) {
    const auto& x = chebyshev::lobatto_points<speed_degree>();
    const double middle = 0.5 * (a + b);
    const double half = 0.5 * (b - a);
    std::array<double, speed_degree + 1> values{};
    for (std::size_t j = 0; j < values.size(); ++j) values[j] = half * hodograph.speed(middle + half * x[j]);
    SpeedPiece piece;
    piece.middle = static_cast<double>(index) + middle;
    piece.half = half;
    piece.speed = chebyshev::interpolate<speed_degree>(values);
    piece.distance = chebyshev::integrate<speed_degree>(piece.speed);
    piece.length = std::max(0.0, piece.distance_at(1.0));
    return piece;
}

/// Whether the rest of the series is below the tolerance, or no more than `rounding` of the speed, which
/// never fades out.
[[nodiscard]] bool resolved(const SpeedPiece& piece, double whole, double rounding) {
    double tail = 0.0;
    for (std::size_t k = speed_degree - 2; k <= speed_degree; ++k) tail += std::abs(piece.speed[k]);
    return tail <= series_tolerance * whole + piece.half * rounding;
}

}  // namespace

SpeedTable::SpeedTable(const Curve& curve) {
    const std::size_t count = curve.segment_count();
    std::vector<SpeedPiece> coarse;
    coarse.reserve(count);
    double whole = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        coarse.push_back(sample(Hodograph(curve.segment(i)), i, 0.0, 1.0));
        whole += coarse.back().length;
    }
    evaluations_ = count * (speed_degree + 1);
    pieces_.reserve(2 * count);
    first_pieces_.reserve(count + 1);
    segment_starts_.reserve(count + 1);
    double distance = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        first_pieces_.push_back(pieces_.size());
        segment_starts_.push_back(distance);
        const Hodograph hodograph(curve.segment(i));
        const auto refine = [&](const auto& self, SpeedPiece piece, double a, double b, int depth) -> void {
            if (depth == deepest || resolved(piece, whole, hodograph.rounding())) {
                piece.start = distance;
                distance += piece.length;
                pieces_.push_back(piece);
                return;
            }
            const double middle = 0.5 * (a + b);
            evaluations_ += 2 * (speed_degree + 1);
            self(self, sample(hodograph, i, a, middle), a, middle, depth + 1);
            self(self, sample(hodograph, i, middle, b), middle, b, depth + 1);
        };
        refine(refine, coarse[i], 0.0, 1.0, 0);
    }
    first_pieces_.push_back(pieces_.size());
    segment_starts_.push_back(distance);
    pieces_.shrink_to_fit();
}

double SpeedTable::length_at(const Location& at) const {
    const auto begin = pieces_.begin() + static_cast<std::ptrdiff_t>(first_pieces_[at.segment]);
    const auto end = pieces_.begin() + static_cast<std::ptrdiff_t>(first_pieces_[at.segment + 1]);
    const double t = static_cast<double>(at.segment) + at.t;
    const auto after = std::partition_point(
        begin + 1, end, [t](const SpeedPiece& piece) { return piece.middle - piece.half <= t; });
    const SpeedPiece& piece = *(after - 1);
    const double x = (t - piece.middle) / piece.half;
    return piece.start + std::clamp(piece.distance_at(x), 0.0, piece.length);
}

}  // namespace motus::curve
