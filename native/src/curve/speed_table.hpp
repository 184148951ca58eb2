// Speed and distance along a curve as Chebyshev series over pieces of the parameter. Private to the library.
#pragma once
#include <cstddef>
#include <vector>

#include "chebyshev.hpp"
#include "motus/core/cache.hpp"
#include "motus/curve/curve.hpp"

namespace motus::curve {

/// Degree of the series of the speed on one piece.
inline constexpr std::size_t speed_degree = 16;

/// The curve between the parameters t - half and t + half, x = -1 to 1.
struct SpeedPiece {
    double middle = 0.0;
    double half = 0.0;
    double start = 0.0;                              ///< distance along the curve at x = -1
    double length = 0.0;                             ///< of the piece
    chebyshev::Series<speed_degree> speed{};         ///< ds / dx
    chebyshev::Series<speed_degree + 1> distance{};  ///< s - start

    [[nodiscard]] double t(double x) const { return middle + half * x; }
    [[nodiscard]] double distance_at(double x) const { return chebyshev::evaluate(distance, x); }
};

class SpeedTable {
  public:
    explicit SpeedTable(const Curve& curve);

    [[nodiscard]] double length() const noexcept { return segment_starts_.back(); }
    [[nodiscard]] double length_at(const Location& at) const;
    [[nodiscard]] double segment_start(std::size_t index) const { return segment_starts_.at(index); }
    [[nodiscard]] const std::vector<SpeedPiece>& pieces() const noexcept { return pieces_; }
    [[nodiscard]] std::size_t evaluation_count() const noexcept { return evaluations_; }
    [[nodiscard]] std::size_t bytes() const noexcept {
        return sizeof *this + bytes_of(pieces_) + bytes_of(first_pieces_) + bytes_of(segment_starts_);
    }

  private:
    std::vector<SpeedPiece> pieces_;         ///< all segments', in order
    std::vector<std::size_t> first_pieces_;  ///< one a segment, and the end
    std::vector<double> segment_starts_;     ///< one a segment, and the length
    std::size_t evaluations_ = 0;
};

}  // namespace motus::curve
