#include "motus/walker/gait.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "motus/core/numeric.hpp"

namespace motus::walker {
namespace {

/// Position of a leg among the legs: its side and its row.
struct Seat {
    std::size_t side = 0;  ///< 0 left, 1 right
    std::size_t row = 0;   ///< 0 is in front
};

struct Seats {
    std::vector<Seat> of_legs;
    std::size_t rows = 0;  ///< of the side that has more
    std::array<std::size_t, 2> on_side{};
};

[[nodiscard]] Seats seats_of(std::span<const glm::dvec3> rest, const glm::dvec3& forward,
                             const glm::dvec3& right) {
    std::vector<double> across;
    for (const glm::dvec3& place : rest) across.push_back(glm::dot(place, right));
    const auto [low, high] = std::ranges::minmax(across);
    const double middle = 0.5 * (low + high);
    std::vector<std::size_t> order(rest.size());
    for (std::size_t leg = 0; leg < order.size(); ++leg) order[leg] = leg;
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::size_t leg) { return glm::dot(rest[leg], forward); });

    const double narrow = 1e-4 * (high - low);  // nearer to the middle a leg is on no side
    constexpr std::size_t no_side = 2;
    Seats seats;
    std::vector<std::size_t> sides(rest.size(), no_side);
    const auto seat = [&](std::size_t leg, std::size_t side) {
        sides[leg] = side;
        ++seats.on_side.at(side);
    };
    for (std::size_t leg = 0; leg < rest.size(); ++leg)
        if (std::abs(across[leg] - middle) > narrow) seat(leg, across[leg] > middle ? 1 : 0);
    for (const std::size_t leg : order)
        if (sides[leg] == no_side) seat(leg, seats.on_side[1] < seats.on_side[0] ? 1 : 0);
    seats.rows = std::max(seats.on_side[0], seats.on_side[1]);
    seats.of_legs.resize(rest.size());
    std::array<std::size_t, 2> next{};
    for (const std::size_t leg : order) seats.of_legs[leg] = {sides[leg], next.at(sides[leg])++};
    return seats;
}

/// Share of a cycle, [0, 1), by which a leg swings later than the first leg.
[[nodiscard]] double delay_of(Gait gait, const Seat& seat, const Seats& seats) {
    const auto rows = static_cast<double>(seats.rows);
    const auto from_back = static_cast<double>(seats.on_side.at(seat.side) - 1 - seat.row);
    const std::size_t half = 2 * seat.row / seats.rows;  // 0 the front one
    const bool leads = seat.side == 0;
    switch (gait) {
        case Gait::tripod:
        case Gait::tetrapod:
            return (seat.row + seat.side) % 2 == 0 ? 0.0 : 0.5;
        case Gait::trot:
        case Gait::run:
            return (half + seat.side) % 2 == 0 ? 0.0 : 0.5;
        case Gait::pace:
            return seat.side == 0 ? 0.0 : 0.5;
        case Gait::walk:
            return 0.5 * from_back / rows + (seat.side == 0 ? 0.0 : 0.5);
        case Gait::canter:
            return (half == 0 ? 0.3 : 0.0) + (leads ? 0.3 : 0.0);
        case Gait::gallop:
            return half == 0 ? (leads ? 0.5 : 0.3) : (leads ? 0.1 : 0.0);
        case Gait::hop:
            return 0.0;
        case Gait::ripple: {
            // With an even number of rows half a lag more, so that no two legs lift together.
            const double apart = seats.rows % 2 == 0 ? 0.5 + 0.5 / rows : 0.5;
            const double delay = from_back / rows + (seat.side == 0 ? 0.0 : apart);
            return delay - std::floor(delay);
        }
        case Gait::wave: {
            const auto before = static_cast<double>(seat.side == 0 ? 0 : seats.on_side[0]);
            return (before + from_back) / static_cast<double>(seats.of_legs.size());
        }
    }
    return 0.0;
}

[[nodiscard]] double duty_of(Gait gait, const Seats& seats) {
    switch (gait) {
        case Gait::tripod:
        case Gait::trot:
        case Gait::pace:
            return 0.5;
        case Gait::tetrapod:
            return 0.6;
        case Gait::walk:
            return seats.rows == 1 ? 0.6 : 0.65;
        case Gait::run:
        case Gait::canter:
            return 0.35;
        case Gait::hop:
            return 0.4;
        case Gait::gallop:
            return 0.3;
        case Gait::ripple:
            return std::clamp(1.0 - 1.0 / static_cast<double>(seats.rows), 0.5, most_duty);
        case Gait::wave:
            return std::clamp(1.0 - 1.0 / static_cast<double>(seats.of_legs.size()), 0.5, most_duty);
    }
    return 0.5;
}

/// The tenth root of a number from 1e-3 to 1e40, by Newton's method: by arithmetic and square roots alone.
[[nodiscard]] double tenth_root(double x) {
    const double square = std::sqrt(x);
    double root = std::sqrt(std::sqrt(square));  // x^(1/8): above the root for x > 1, and not far below it
    constexpr int steps = 30;
    for (int step = 0; step < steps; ++step) {
        const double fourth = root * root * root * root;
        root = (4.0 * root + square / fourth) / 5.0;
    }
    return root;
}

}  // namespace

double natural_stride(double speed, double hip_height) {
    constexpr double largest = 1e12, gravity = 9.81, least = 1e-3, share = 2.3;
    require(speed >= 0.0 && speed <= largest, "speed: must be from 0 to 1e12");
    require(hip_height >= 0.0 && hip_height <= largest, "hip_height: must be from 0 to 1e12");
    if (hip_height == 0.0) return 0.0;
    constexpr double most = 1e36;
    const double froude = std::clamp(speed * speed / (gravity * hip_height), least, most);
    const double root = tenth_root(froude);
    return share * hip_height * root * root * root;
}

Pattern pattern_of(Gait gait, std::span<const glm::dvec3> rest, const glm::dvec3& forward,
                   const glm::dvec3& up) {
    require(!rest.empty() && rest.size() <= most_legs, "rest: must have 1 to 256 legs");
    for (const glm::dvec3& place : rest) require(is_finite(place), "rest: must be finite");
    const std::optional<glm::dvec3> ahead = direction_of(forward), above = direction_of(up);
    require(ahead.has_value(), "forward: must not be zero");
    require(above.has_value(), "up: must not be zero");
    const glm::dvec3 across = glm::cross(*ahead, *above);
    constexpr double parallel = 1e-6;
    require(length_of(across) > parallel, "up: must not be parallel to forward");

    const Seats seats = seats_of(rest, *ahead, unit_vector(across));
    Pattern pattern;
    pattern.duty = duty_of(gait, seats);
    for (const Seat& seat : seats.of_legs) {
        const double delay = delay_of(gait, seat, seats);
        pattern.phases.push_back(delay > 0.0 ? 1.0 - delay : 0.0);
    }
    return pattern;
}

}  // namespace motus::walker
