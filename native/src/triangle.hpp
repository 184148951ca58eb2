// Angles of a triangle by its sides, without inverse functions. Private to the library.
#pragma once
#include <algorithm>
#include <cmath>

namespace motus {

/// tan^2(angle / 2) = opposite / adjacent, both >= 0; their sum is 4 a b where the sides make a triangle.
struct HalfAngle {
    double opposite, adjacent;
};

/// Between the sides a and b, opposite c. Kahan, "Miscalculating Area and Angles of a Needle-like Triangle"
/// (2014), section 6: no difference in it loses digits, needles included.
[[nodiscard]] inline HalfAngle half_angle(double a, double b, double c) {
    const double longer = std::max(a, b);
    const double shorter = std::min(a, b);
    const double excess = shorter >= c ? c - (longer - shorter) : shorter - (longer - c);
    return {((longer - shorter) + c) * std::max(excess, 0.0),
            (longer + (shorter + c)) * std::max((longer - c) + shorter, 0.0)};
}

struct Direction {
    double cosine, sine;
};

/// cosine^2 + sine^2 = 1 to the last digits. A right angle where one of the sides is nothing beside the
/// other.
[[nodiscard]] inline Direction direction_of(const HalfAngle& half) {
    constexpr double no_side = 1e-290;
    const double sum = half.opposite + half.adjacent;
    if (sum < no_side) return {0.0, 1.0};
    const double inverse = 1.0 / sum;
    const double opposite = half.opposite * inverse;
    const double adjacent = half.adjacent * inverse;
    return {adjacent - opposite, 2.0 * std::sqrt(opposite * adjacent)};
}

/// Direction of the first of two bones, seen from the line to the tip at distance `reach`; longest, shortest:
/// sum and difference of the lengths. The ends of the reach are asked for by name: there rounding would make
/// 1e-8 rad of 1e-16.
[[nodiscard]] inline Direction shoulder(double length1, double length2, double longest, double shortest,
                                        double reach) {
    if (reach >= longest) return {1.0, 0.0};
    if (reach <= shortest && shortest > 0.0) return {length1 > length2 ? 1.0 : -1.0, 0.0};
    return direction_of(half_angle(length1, reach, length2));
}

}  // namespace motus
