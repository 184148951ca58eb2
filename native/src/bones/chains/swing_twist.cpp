#include "swing_twist.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "motus/core/numeric.hpp"

namespace motus::bones::chains {
namespace {

using std::numbers::pi;

constexpr double edge = 1e-9;  // rad, or share of a half-axis: nearer to the limit counts as on it

/// The nearest point of the ellipse with the half-axes a, b > 0 to p >= 0 outside of it. The root of a
/// convex, falling function, by Newton's method from its left (Eberly, "Distance from a Point to an Ellipse",
/// 2013).
glm::dvec2 nearest_on_ellipse(const glm::dvec2& p, double a, double b) {
    const double aa = a * a;
    const double bb = b * b;
    double t = std::max({0.0, a * p.x - aa, b * p.y - bb});
    for (int i = 0; i < 60; ++i) {
        const double u = a * p.x / (t + aa);
        const double v = b * p.y / (t + bb);
        const double value = u * u + v * v - 1.0;
        const double step = value / (2.0 * (u * u / (t + aa) + v * v / (t + bb)));
        if (!(step > 1e-16 * (t + std::min(aa, bb)))) break;
        t += step;
    }
    return {aa * p.x / (t + aa), bb * p.y / (t + bb)};
}

/// The point p >= 0 moved into the ellipse with these half-axes, which may be zero or infinite.
glm::dvec2 clamp_quadrant(const glm::dvec2& p, double a, double b) {
    if (a <= 0.0 || b <= 0.0 || std::isinf(a) || std::isinf(b)) return {std::min(p.x, a), std::min(p.y, b)};
    const double u = p.x / a;
    const double v = p.y / b;
    return u * u + v * v <= 1.0 ? p : nearest_on_ellipse(p, a, b);
}

/// Whether the limits of the swing are an ellipse: neither interval leaves zero out (see JointLimits).
bool has_ellipse(const JointLimits& limits) {
    return limits.min.x <= 0.0 && limits.max.x >= 0.0 && limits.min.z <= 0.0 && limits.max.z >= 0.0;
}

/// Half-axes of the limits on the side on which the swing lies.
glm::dvec2 half_axes(const glm::dvec2& swing, const JointLimits& limits) {
    return {swing.x < 0.0 ? -limits.min.x : limits.max.x, swing.y < 0.0 ? -limits.min.z : limits.max.z};
}

/// Unit normals, to the outside, of the limits that a swing stands at.
struct Walls {
    std::size_t count = 0;
    std::array<glm::dvec2, 5> normals{};
    double curvature = 0.0;  // of the last one

    void add(double x, double z) { normals[count++] = {x, z}; }
    void add_box(const glm::dvec2& swing, const JointLimits& limits) {
        if (swing.x >= limits.max.x - edge) add(1.0, 0.0);
        if (swing.x <= limits.min.x + edge) add(-1.0, 0.0);
        if (swing.y >= limits.max.z - edge) add(0.0, 1.0);
        if (swing.y <= limits.min.z + edge) add(0.0, -1.0);
    }
    void add_round(const glm::dvec2& swing, const JointLimits& limits) {
        const glm::dvec2 axes = half_axes(swing, limits);
        if (!has_ellipse(limits) || axes.x <= edge || axes.y <= edge || std::isinf(axes.x) ||
            std::isinf(axes.y))
            return;
        const glm::dvec2 scaled = swing / axes;
        if (glm::dot(scaled, scaled) < 1.0 - 2.0 * edge) return;
        const glm::dvec2 normal = scaled / axes;
        const double steepness = glm::length(normal);
        add(normal.x / steepness, normal.y / steepness);
        const double size = axes.x * axes.y * steepness;
        curvature = 1.0 / (size * size * steepness);
    }
    /// Whether one of these limits stops a swing in the direction `way`.
    [[nodiscard]] bool stop(const glm::dvec2& way) const {
        for (std::size_t i = 0; i < count; ++i) {
            if (glm::dot(way, normals[i]) > 1e-9 * glm::length(way)) return true;
        }
        return false;
    }
};

/// The rotation vector of an equal rotation the other way round.
glm::dvec2 other_way(const glm::dvec2& swing) {
    const double angle = glm::length(swing);
    return swing * ((angle - 2.0 * pi) / angle);
}

}  // namespace

SwingTwist swing_twist_of(const glm::dquat& rotation) {
    const double r = std::hypot(rotation.w, rotation.y);
    const double c = r > 0.0 ? rotation.w / r : 1.0;
    const double s = r > 0.0 ? rotation.y / r : 0.0;
    const glm::dvec2 v(rotation.x * c + rotation.z * s,
                       rotation.z * c - rotation.x * s);  // of q times the conjugate of the twist
    const double sine = glm::length(v);
    return {sine > 1e-150 ? v * (2.0 * std::atan2(sine, r) / sine) : 2.0 * v,
            2.0 * std::atan2(c < 0.0 ? -s : s, std::abs(c))};
}

glm::dquat rotation_of(const SwingTwist& angles) {
    const double half = 0.5 * glm::length(angles.swing);
    const double by_angle = half > 1e-8 ? 0.5 * std::sin(half) / half : 0.5;
    const double w = std::cos(half);
    const double x = by_angle * angles.swing.x;
    const double z = by_angle * angles.swing.y;
    const double c = std::cos(0.5 * angles.twist);
    const double s = std::sin(0.5 * angles.twist);
    return {w * c, x * c - z * s, w * s, z * c + x * s};
}

glm::dvec2 clamp_swing(const glm::dvec2& swing, const JointLimits& limits) {
    if (!has_ellipse(limits))
        return {std::clamp(swing.x, limits.min.x, limits.max.x),
                std::clamp(swing.y, limits.min.z, limits.max.z)};
    const glm::dvec2 axes = half_axes(swing, limits);
    const glm::dvec2 p = clamp_quadrant(glm::abs(swing), axes.x, axes.y);
    return {std::copysign(p.x, swing.x), std::copysign(p.y, swing.y)};
}

glm::dmat2 slope_of_clamp(const glm::dvec2& swing, const glm::dvec2& kept, const JointLimits& limits) {
    if (swing == kept) return glm::dmat2(1.0);
    const glm::dvec2 axes = half_axes(swing, limits);
    const bool is_round =
        has_ellipse(limits) && axes.x > 0.0 && axes.y > 0.0 && !std::isinf(axes.x) && !std::isinf(axes.y);
    if (!is_round) return {swing.x == kept.x ? 1.0 : 0.0, 0.0, 0.0, swing.y == kept.y ? 1.0 : 0.0};
    const glm::dvec2 normal = kept / (axes * axes);
    const double steepness = glm::length(normal);
    const glm::dvec2 tangent = glm::dvec2(-normal.y, normal.x) / steepness;
    const double size = axes.x * axes.y * steepness;
    const double curvature = 1.0 / (size * size * steepness);
    return glm::outerProduct(tangent, tangent) / (1.0 + curvature * glm::distance(swing, kept));
}

double clamp_twist(double twist, const JointLimits& limits) {
    const double width = limits.max.y - limits.min.y;
    if (width >= 2.0 * pi) return twist;
    const double middle = 0.5 * (limits.min.y + limits.max.y);
    if (std::isinf(middle)) return std::clamp(twist, limits.min.y, limits.max.y);
    if (twist >= limits.min.y && twist <= limits.max.y) return twist;
    return std::clamp(middle + std::remainder(twist - middle, 2.0 * pi), limits.min.y, limits.max.y);
}

Ways swing_ways(const glm::dvec2& swing, const JointLimits& limits, const glm::dvec2& pull) {
    const bool is_hinge_z = limits.max.x - limits.min.x <= edge;
    const bool is_hinge_x = limits.max.z - limits.min.z <= edge;
    Walls walls;
    if (is_hinge_x || is_hinge_z) {
        const glm::dvec2 way = is_hinge_x ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0, 1.0);
        if (is_hinge_x && is_hinge_z) return {};
        walls.add_box(swing, limits);
        return walls.stop(way * glm::dot(pull, way)) ? Ways{} : Ways{1, {way, {}}, 0.0};
    }
    walls.add_box(swing, limits);
    walls.add_round(swing, limits);
    glm::dvec2 left = pull;
    double curvature = 0.0;
    bool is_along = false;
    for (std::size_t i = 0; i < walls.count; ++i) {
        const glm::dvec2 normal = walls.normals[i];
        const double out = glm::dot(left, normal);
        if (out <= 0.0) continue;
        left -= out * normal;
        is_along = true;
        if (i + 1 == walls.count) curvature = out * walls.curvature;
    }
    if (!is_along) return {2, {glm::dvec2(1.0, 0.0), glm::dvec2(0.0, 1.0)}, 0.0};
    const double size = glm::length(left);
    if (size <= 1e-9 * glm::length(pull) || walls.stop(left)) return {};
    return {1, {left / size, {}}, curvature};
}

bool may_twist(double twist, const JointLimits& limits, double pull) {
    if (limits.max.y - limits.min.y <= edge) return false;
    return pull > 0.0 ? twist < limits.max.y - edge : twist > limits.min.y + edge;
}

SwingRates swing_rates(const glm::dvec2& swing) {
    const double square = glm::dot(swing, swing);
    const double angle = std::sqrt(square);
    const bool is_small = angle < 1e-2;
    const double a = is_small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
    const double b = is_small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
    const double a2 = is_small ? -1.0 / 12.0 : (1.0 - b * square - 2.0 * a) / square;
    const double b2 = is_small ? -1.0 / 60.0 : (a - 3.0 * b) / square;
    const double x = swing.x;
    const double z = swing.y;
    // 1 + a s^ + b s^ s^ with s = (x, 0, z), applied to the axes X and Z.
    return {{1.0 - b * z * z, a * z, b * x * z},
            {b * x * z, -a * x, 1.0 - b * x * x},
            {-b2 * x * z * z, a2 * x * z, b * z + b2 * x * x * z},
            {-0.5 * (b * z + b2 * z * square) + b2 * x * x * z, 0.5 * a2 * (z * z - x * x),
             -0.5 * (b * x + b2 * x * square) + b2 * x * z * z},
            {b * x + b2 * x * z * z, -a2 * x * z, -b2 * x * x * z}};
}

glm::dquat clamp_rotation(const glm::dquat& rotation, const JointLimits& limits) {
    for (int axis = 0; axis < 3; ++axis)
        require(limits.min[axis] <= limits.max[axis], "limits: each minimum must be at most its maximum");
    const SwingTwist given = swing_twist_of(rotation);
    SwingTwist kept{clamp_swing(given.swing, limits), clamp_twist(given.twist, limits)};
    if (kept.swing != given.swing && given.swing != glm::dvec2(0.0)) {
        const glm::dvec2 other = other_way(given.swing);
        const glm::dvec2 other_kept = clamp_swing(other, limits);
        if (other_kept == other) {
            kept.swing = given.swing;
        } else if (glm::distance(other_kept, other) < glm::distance(kept.swing, given.swing)) {
            kept.swing = other_kept;
        }
    }
    const double untwisted = std::abs(std::remainder(kept.twist - given.twist, 2.0 * pi));
    return kept.swing == given.swing && untwisted < 1e-15 ? rotation : rotation_of(kept);
}

}  // namespace motus::bones::chains
