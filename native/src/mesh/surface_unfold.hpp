// One triangle's step of a distance along a surface.
#pragma once
#include <algorithm>
#include <cmath>

#include "surface_places.hpp"

namespace motus::mesh {

/// A way to a place.
struct Way {
    double distance = 0.0;
    double spread = 1.0;
};

/// A triangle a b c as seen from its corner a; b - a is the side that the wave comes across, c is to be
/// reached.
struct Corner {
    double side2 = 0.0;  ///< |b - a|^2
    double far2 = 0.0;   ///< |c - a|^2
    double dot = 0.0;    ///< (b - a) . (c - a)
    double area = 0.0;   ///< |(b - a) x (c - a)|
};

[[nodiscard]] inline Way way_along(const SurfacePlace& from, double length2) {
    return {from.distance + std::sqrt(length2), from.spread};
}

/// The shortest way to c through the corners a and b alone.
[[nodiscard]] inline Way way_by_sides(const Corner& corner, const SurfacePlace& a, const SurfacePlace& b) {
    const Way by_a = way_along(a, corner.far2);
    const Way by_b = way_along(b, std::max(corner.side2 + corner.far2 - 2.0 * corner.dot, 0.0));
    return by_a.distance <= by_b.distance ? by_a : by_b;
}

/// The spread of the wave midway between a and b. If it shrinks at both, its centre is the mean of theirs:
/// near a focus spreads differ too much from vertex to vertex to be averaged.
[[nodiscard]] inline double spread_between(const SurfacePlace& a, const SurfacePlace& b, double mean) {
    if (!(a.spread < 0.0f && b.spread < 0.0f && mean > 0.0))
        return 0.5 * (static_cast<double>(a.spread) + b.spread);
    const double radius_a = a.distance / static_cast<double>(a.spread);
    const double radius_b = b.distance / static_cast<double>(b.spread);
    return 2.0 * mean / (radius_a + radius_b);
}

/// The shortest way to c across the side between a and b. The triangle is unfolded into a plane in which the
/// wave is a circle: about the one point that has the distances of a and b, on a flat surface, else about one
/// nearer or farther by so much as the surface's curvature has bent the wave on its way here. Past a dome's
/// focus the circle's centre lies ahead. If the ray to c passes by the side, the way bends around its end.
[[nodiscard]] inline Way way_across(const Corner& corner, const SurfacePlace& a, const SurfacePlace& b) {
    if (!(corner.area > 0.0)) return way_by_sides(corner, a, b);
    const double side2 = corner.side2;
    const double mean = 0.5 * (static_cast<double>(a.distance) + b.distance);
    const double spread = spread_between(a, b, mean);
    double offset = 0.0;   // distance of the circle's centre
    double towards = 1.0;  // -1: the circle shrinks
    if (spread != 1.0) {
        constexpr double straight = 0.02;  // spread of a wave as good as straight
        const double used = std::abs(spread) < straight ? std::copysign(straight, spread) : spread;
        offset = mean - mean / used;
        if (used < 0.0) towards = -1.0;
    }
    double sum = a.distance + b.distance - 2.0 * offset;
    if (sum * sum < side2) {
        sum += 2.0 * offset;
        offset = 0.0;
        towards = 1.0;
    }
    // Plane coordinates times |side|: x along it from a, y towards c.
    const double difference = static_cast<double>(a.distance) - b.distance;
    const double centre_x = 0.5 * (difference * sum + side2);
    const double depth =
        0.5 * std::sqrt(std::max((sum * sum - side2) * (side2 - difference * difference), 0.0));
    const double height = towards * corner.area + depth;
    if (!(height > 0.0)) return way_by_sides(corner, a, b);
    const double crossing =
        centre_x * towards * corner.area + corner.dot * depth;  // x of the ray at y = 0, times height
    const double slack = 1e-3 * side2 * height;  // rounding must not make a bend of a straight line
    if (crossing < -slack) return way_along(a, corner.far2);
    if (crossing > side2 * height + slack)
        return way_along(b, std::max(side2 + corner.far2 - 2.0 * corner.dot, 0.0));

    const double across = corner.dot - centre_x;
    const double ray = std::sqrt((across * across + height * height) / side2);
    const double distance = offset + towards * ray;
    const double curvature = 0.5 * (static_cast<double>(a.curvature) + b.curvature);
    if ((spread == 1.0 && curvature == 0.0) || !(distance > 0.0)) return {distance, 1.0};
    // Jacobi's equation for the radius r of the wave, r'' = -K r, over the part of the ray beyond the side.
    // If the circle shrinks it starts from the radius drawn: near a focus the distance tells nothing of
    // it.
    const double part = ray * corner.area / height;
    const double before = towards < 0.0 ? ray + part : distance - part;
    const double slope = towards < 0.0 ? -1.0 : spread;
    const double next =
        distance * (slope - curvature * part * before) / std::max(before + slope * part, 0.1 * distance);
    return {distance, std::clamp(next, -30.0, 9.0)};
}

}  // namespace motus::mesh
