#include "motus/bones/turns.hpp"

namespace motus::bones {
namespace {

/// Any unit vector perpendicular to a unit vector.
glm::dvec3 some_across(const glm::dvec3& v) {
    const glm::dvec3 other = std::abs(v.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(other - glm::dot(other, v) * v);
}

}  // namespace

glm::dquat half_turn_to(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& axis) {
    const glm::dvec3 middle = direction_or(from - to, from);
    glm::dvec3 about = axis - glm::dot(axis, middle) * middle;
    about = glm::dot(about, about) > 1e-12 ? glm::normalize(about) : some_across(middle);
    return {0.0, about.x, about.y, about.z};
}

void turn_links(std::span<const glm::dvec3> before, std::span<const glm::dvec3> after,
                std::span<glm::dquat> turns) {
    require(after.size() == before.size(), "after: must have as many rows as before");
    require(turns.size() == before.size(), "turns: must have as many rows as before");
    glm::dquat turn = no_turn;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const auto from = direction_of(turn * before[i]), to = direction_of(after[i]);
        if (from && to) turn = smallest_turn(*from, *to, some_across(*from)) * turn;
        turns[i] = turn;
    }
}

glm::dquat share_of_turn(const glm::dquat& turn, double weight) {
    if (weight <= 0.0) return no_turn;
    const glm::dquat near = turn.w < 0.0 ? -turn : turn;
    if (weight >= 1.0) return near;
    const double sine = std::sqrt(near.x * near.x + near.y * near.y + near.z * near.z);
    const double half = weight * std::atan2(sine, near.w);
    const double along = sine > 1e-150 ? std::sin(half) / sine : weight;
    return {std::cos(half), along * near.x, along * near.y, along * near.z};
}

glm::dquat frame_of(const glm::dmat3& axes) {
    const glm::dvec3 none(0.0);
    glm::dvec3 y = direction_or(axes[1], none);
    if (y == none) y = direction_or(glm::cross(axes[2], axes[0]), glm::dvec3(0.0, 1.0, 0.0));
    // Scaled first: what is left across Y may be small beside axes that are huge.
    return frame_of(axes, y, direction_or(axes[2], none));
}

glm::dquat frame_of(const glm::dmat3& axes, const glm::dvec3& y, glm::dvec3 z) {
    z -= glm::dot(z, y) * y;
    double square = glm::dot(z, z);
    constexpr double slanted = 1e-6;  // squared: what is left has lost digits
    if (square < slanted) {
        if (square < 1e-28) z = glm::cross(direction_or(axes[0], glm::dvec3(0.0)), y);
        if (glm::dot(z, z) < 1e-28) z = some_across(y);
        z = glm::normalize(z);
        z -= glm::dot(z, y) * y;
        square = glm::dot(z, z);
    }
    z *= inverse_root_near_one(square);
    return glm::quat_cast(glm::dmat3(glm::cross(y, z), y, z));
}

}  // namespace motus::bones
