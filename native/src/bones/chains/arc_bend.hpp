// Bones laid along a circle: the one-parameter bend of a whole chain. Private to the library.
#pragma once
#include <complex>
#include <cstddef>
#include <span>

namespace motus::bones::chains {

/// A chain bent into the arc of a circle whose chord, from root to tip, has a given length: with that chord
/// the bones make the one convex polygon inscribed in a circle that has these sides. It exists for every
/// chord between the chain's inner radius and its length, and changes continuously from straight to folded.
class ArcBend {
  public:
    /// lengths >= 0; inner radius < chord < sum of lengths, both with room for rounding.
    ArcBend(std::span<const double> lengths, double chord);

    /// Angle, rad, between the tangent at the root and the chord: 0 straight, pi closed.
    [[nodiscard]] double half_turn() const noexcept { return half_turn_; }

    /// Directions of the bones, the chord along the real axis and the bulge on the side of +i.
    void directions(std::span<const double> lengths, std::span<std::complex<double>> out) const;

  private:
    double curvature_ = 0.0;  // 1 / diameter
    double half_turn_ = 0.0;
    double longest_cosine_ = 1.0;  // of half the angle that the longest bone is seen under from the centre
    std::size_t longest_ = 0;      // bone; the number of bones where the chord is the longest side
};

}  // namespace motus::bones::chains
