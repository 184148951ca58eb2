#include "arc_bend.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace motus::bones::chains {
namespace {

using std::numbers::pi;

/// Sum of half the angles under which all sides but the longest are seen from the circle's centre, if half
/// the angle of the longest side is pi - gamma; and its derivative by gamma.
struct Turn {
    double angle = 0.0;
    double slope = 0.0;
};

/// Adds the angles as products of complex numbers, which is right while the sum stays below 2 pi.
Turn turn_of_others(std::span<const double> lengths, std::size_t longest, double chord, double side,
                    double gamma) {
    const double x = std::sin(gamma) / side;
    double re = 1.0;
    double im = 0.0;
    double weights = 0.0;
    const auto add = [&](double length) {
        const double sine = std::min(length * x, 1.0);
        const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
        weights += length / std::max(cosine, 1e-8);
        const double turned = re * cosine - im * sine;
        im = re * sine + im * cosine;
        re = turned;
    };
    for (std::size_t i = 0; i < longest; ++i) add(lengths[i]);
    for (std::size_t i = longest + 1; i < lengths.size(); ++i) add(lengths[i]);
    if (longest < lengths.size()) add(chord);
    const double angle = std::atan2(im, re);
    return {angle < 0.0 ? angle + 2.0 * pi : angle, weights * std::cos(gamma) / side};
}

/// First guess for half_turn(), within 4 %: the arc of a rope of that length, sin(s) / s = chord / length.
double rope_turn(double ratio) {
    return std::sqrt(1.0 - ratio) * (2.449 + 0.692 * (1.0 - ratio));
}

}  // namespace

ArcBend::ArcBend(std::span<const double> lengths, double chord) : longest_(lengths.size()) {
    double total = 0.0;
    double side = chord;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        total += lengths[i];
        if (lengths[i] > side) {
            side = lengths[i];
            longest_ = i;
        }
    }
    const bool bone_is_longest = longest_ < lengths.size();
    const double others = (bone_is_longest ? total - side + chord : total) / side;

    // turn_of_others(gamma) - gamma is concave: it rises from 0 and then falls through the root that is
    // sought.
    const double rope = rope_turn(chord / total);
    double gamma = bone_is_longest ? pi - std::min(side / total * rope, 0.5 * pi) : rope;
    double low = 0.0;
    double high = pi;
    for (int i = 0; i < 60; ++i) {
        double next = 0.0;
        if (others * std::sin(gamma) >= pi) {  // an arc is longer than its sine: the turn is past pi
            low = gamma;
            next = 0.5 * (low + high);
        } else {
            const Turn turn = turn_of_others(lengths, longest_, chord, side, gamma);
            const double excess = turn.angle - gamma;
            (excess > 0.0 ? low : high) = gamma;
            next = gamma - excess / (turn.slope - 1.0);
            if (!(turn.slope < 1.0) || next <= low || next >= high) next = 0.5 * (low + high);
        }
        const double change = std::abs(next - gamma);
        gamma = next;
        if (change <= 1e-9 * gamma) break;  // squared by the step just taken
    }
    curvature_ = std::sin(gamma) / side;
    longest_cosine_ = -std::cos(gamma);
    half_turn_ = bone_is_longest ? pi - std::asin(std::min(chord * curvature_, 1.0)) : gamma;
}

void ArcBend::directions(std::span<const double> lengths, std::span<std::complex<double>> out) const {
    std::complex<double> tangent = std::polar(1.0, half_turn_);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const double sine = std::min(lengths[i] * curvature_, 1.0);
        const double cosine = i == longest_ ? longest_cosine_ : std::sqrt((1.0 - sine) * (1.0 + sine));
        const double re = tangent.real() * cosine + tangent.imag() * sine;
        const double im = tangent.imag() * cosine - tangent.real() * sine;
        out[i] = {re, im};
        tangent = {re * cosine + im * sine, im * cosine - re * sine};
    }
}

}  // namespace motus::bones::chains
