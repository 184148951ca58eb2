#include "motus/bones/layers/spin.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"
#include "trigonometry.hpp"

namespace motus::bones::layers {
namespace {

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

/// Rotation by Euler angles: turns about the fixed axes, one after the other.
glm::dquat of_euler(const Order& order, std::span<const double, 4> angles) {
    glm::dquat result = no_turn;
    for (const int axis : {order.i, order.j, order.k}) {
        const Angle half = angle_of(0.5 * angles[static_cast<std::size_t>(axis)]);
        glm::dquat turn{half.cosine, 0.0, 0.0, 0.0};
        (axis == 0 ? turn.x : axis == 1 ? turn.y : turn.z) = half.sine;
        result = turn * result;
    }
    return result;
}

}  // namespace

glm::dquat rotation_of(Rotation mode, std::span<const double, 4> numbers) {
    if (mode == Rotation::axis_angle) {
        const glm::dvec3 given(numbers[1], numbers[2], numbers[3]);
        const glm::dvec3 axis =
            std::isinf(glm::dot(given, given)) ? unit_vector(given) : direction_or(given, glm::dvec3(0.0));
        if (axis == glm::dvec3(0.0)) return no_turn;
        const Angle half = angle_of(0.5 * numbers[0]);
        return {half.cosine, half.sine * axis.x, half.sine * axis.y, half.sine * axis.z};
    }
    if (mode != Rotation::quaternion) return of_euler(orders[static_cast<std::size_t>(mode) - 1], numbers);
    const glm::dquat q{numbers[0], numbers[1], numbers[2], numbers[3]};
    const double square = glm::dot(q, q);
    constexpr double vanished = 1e-280;
    if (!(square > vanished)) return {0.0, 1.0, 0.0, 0.0};
    if (std::isinf(square)) {
        constexpr double smaller = 0x1p-600;
        const glm::dquat scaled = q * smaller;
        return scaled * (1.0 / std::sqrt(glm::dot(scaled, scaled)));
    }
    return q * (1.0 / std::sqrt(square));
}

glm::dquat Spin::turn(double share) const {
    Numbers there{};
    for (std::size_t i = 0; i < there.size(); ++i) there[i] = from[i] + share * (to[i] - from[i]);
    return normalized_product(rotation_of(mode, there) * glm::conjugate(start()));
}

Numbers with_laps(Rotation mode, const Numbers& numbers, const Numbers& lap, double laps) {
    Numbers result = numbers;
    constexpr double whole = 2.0 * std::numbers::pi;
    for (std::size_t i = 0; i < angle_count(mode); ++i)
        result[i] += laps * whole * std::round(lap[i] / whole);
    return result;
}

}  // namespace motus::bones::layers
