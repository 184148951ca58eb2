#include "motus/bones/layers/spin.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "motus/bones/turns.hpp"
#include "trigonometry.hpp"

namespace motus::bones::layers {
namespace {

constexpr double half_turn = 3.14159265358979323846;

/// Axes of a mode, in the order in which they turn, and whether the three are an odd permutation.
struct Order {
    int i, j, k;
    bool is_odd;
};
constexpr std::array<Order, 6> orders{{{0, 1, 2, false},
                                       {0, 2, 1, true},
                                       {1, 0, 2, true},
                                       {1, 2, 0, false},
                                       {2, 0, 1, false},
                                       {2, 1, 0, true}}};

const Order& order_of(Rotation mode) {
    return orders[static_cast<std::size_t>(mode) - 1];
}

/// Angle of the point (x, y) from the x axis, -half a turn to half a turn.
double angle_at(double y, double x) {
    const double angle = arc_tangent(std::abs(y), std::abs(x));
    return std::copysign(x < 0.0 ? half_turn - angle : angle, y);
}

/// The angle that differs from `angle` by whole turns and lies nearest to `near`.
double nearest(double angle, double near) {
    return angle + 2.0 * half_turn * std::round((near - angle) / (2.0 * half_turn));
}

glm::dvec3 nearest(const glm::dvec3& angles, const glm::dvec3& near) {
    return {nearest(angles.x, near.x), nearest(angles.y, near.y), nearest(angles.z, near.z)};
}

}  // namespace

/// Turns about the fixed axes, one after the other.
glm::dquat of_angles(Rotation mode, const glm::dvec3& angles) {
    const Order& order = order_of(mode);
    glm::dquat result = no_turn;
    for (const int axis : {order.i, order.j, order.k}) {
        const Angle half = angle_of(0.5 * angles[axis]);
        glm::dquat turn{half.cosine, 0.0, 0.0, 0.0};
        (axis == 0 ? turn.x : axis == 1 ? turn.y : turn.z) = half.sine;
        result = turn * result;
    }
    return result;
}

glm::dvec3 angles_near(Rotation mode, const glm::dquat& rotation, const glm::dvec3& near) {
    const auto [i, j, k, is_odd] = order_of(mode);
    const glm::dmat3 axes = glm::mat3_cast(rotation);
    const double sign = is_odd ? -1.0 : 1.0;  // of the angles in axes that are an even permutation
    const double across = std::sqrt(axes[i][i] * axes[i][i] + axes[i][j] * axes[i][j]);
    constexpr double locked = 1e-9;  // the first and the last axis are one: the last angle is `near`'s
    glm::dvec3 one;
    one[j] = sign * angle_at(-axes[i][k], across);
    if (across > locked) {
        one[i] = sign * angle_at(axes[j][k], axes[k][k]);
        one[k] = sign * angle_at(axes[i][j], axes[i][i]);
    } else {
        one[k] = near[k];
        const double both = sign * angle_at(-axes[k][j], axes[j][j]);  // with the last angle at 0
        one[i] = axes[i][k] < 0.0 ? both + near[k] : both - near[k];
    }
    glm::dvec3 other;
    other[i] = one[i] + half_turn;
    other[j] = half_turn - one[j];
    other[k] = one[k] + half_turn;
    one = nearest(one, near);
    other = nearest(other, near);
    const glm::dvec3 way = one - near, longer = other - near;
    return glm::dot(way, way) <= glm::dot(longer, longer) ? one : other;
}

}  // namespace motus::bones::layers
