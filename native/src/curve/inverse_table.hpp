// The curve's parameter as a function of the distance. Private to the library.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "speed_table.hpp"

namespace motus::curve {

/// Degree of the polynomials t(s).
inline constexpr std::size_t inverse_degree = 13;

class InverseTable {
  public:
    /// `table` has a length > 0.
    explicit InverseTable(const SpeedTable& table);

    /// Parameter at distance s, 0 < s < length.
    [[nodiscard]] double t_at(double s) const noexcept;
    [[nodiscard]] std::size_t interval_count() const noexcept { return polynomials_.size(); }
    [[nodiscard]] std::size_t bytes() const noexcept {
        return sizeof *this + bytes_of(starts_) + bytes_of(polynomials_) + bytes_of(lowest_);
    }

  private:
    struct Start {
        double s;
        double t;
    };
    /// t = sum of c[k] u^k with u = (s - middle) scale in [-1, 1].
    struct Polynomial {
        double middle;
        double scale;
        std::array<double, inverse_degree + 1> c;

        [[nodiscard]] double operator()(double s) const noexcept;
    };

    void refine(const SpeedPiece& piece, double x0, double x1, double tolerance);
    void index(double length);
    [[nodiscard]] std::size_t bucket(double s) const noexcept {
        return static_cast<std::size_t>(s * buckets_per_length_);
    }

    std::vector<Start> starts_;  ///< one an interval, and the end
    std::vector<Polynomial> polynomials_;
    /// Bucket b's distances lie in intervals lowest_[b] to lowest_[b + 1].
    std::vector<std::uint32_t> lowest_;
    double buckets_per_length_ = 0.0;
};

inline double InverseTable::Polynomial::operator()(double s) const noexcept {
    static_assert(inverse_degree % 2 == 1);
    const double u = (s - middle) * scale;
    const double square = u * u;
    // Even and odd powers apart: two chains of half the latency.
    double even = c[inverse_degree - 1];
    double odd = c[inverse_degree];
    for (std::size_t k = inverse_degree - 1; k > 0; k -= 2) {
        even = even * square + c[k - 2];
        odd = odd * square + c[k - 1];
    }
    return even + u * odd;
}

}  // namespace motus::curve
