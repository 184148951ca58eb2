#include "footing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>

#include "motus/core/numeric.hpp"
#include "motus/walker/step.hpp"

namespace motus::walker {
namespace {

[[nodiscard]] std::optional<Contact> first_between(const Ground& ground, const glm::dvec3& from,
                                                   const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    const glm::dvec3 direction = unit_vector(way);
    if (direction == glm::dvec3(0.0)) return std::nullopt;
    return ground.ray(from, direction, length_of(way));
}

/// The place above or below the hip that is level with another one.
[[nodiscard]] glm::dvec3 over_hip(const Search& search, const glm::dvec3& level) {
    return search.hip + search.up * glm::dot(level - search.hip, search.up);
}

constexpr std::size_t looks = 7;

/// Fractions of a swing at which it is as many eighths of its way.
[[nodiscard]] constexpr std::array<double, looks> fractions_of_eighths() {
    std::array<double, looks> result{};
    for (std::size_t i = 0; i < looks; ++i) {
        const double wanted = static_cast<double>(i + 1) / 8.0;
        double low = 0.0, high = 1.0;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (low + high);
            (along(middle) < wanted ? low : high) = middle;
        }
        result.at(i) = 0.5 * (low + high);
    }
    return result;
}
constexpr std::array<double, looks> fractions = fractions_of_eighths();

}  // namespace

std::optional<Contact> footing(const Ground& ground, const Search& search, const Reach& reach) {
    const glm::dvec3 above = search.rest + reach.up * search.up;
    if (const auto wall = first_between(ground, over_hip(search, above), above)) return wall;
    return first_between(ground, above, search.rest - reach.down * search.up);
}

std::optional<Contact> footing_around_edge(const Ground& ground, const Search& search, const Reach& reach) {
    const glm::dvec3 below = search.rest - reach.down * search.up;
    return first_between(ground, below, over_hip(search, below));
}

double obstacle(const Ground& ground, const glm::dvec3& start, const glm::dvec3& end, const glm::dvec3& up,
                double reach) {
    double highest = 0.0;
    for (const double fraction : fractions) {
        const glm::dvec3 place = start + (end - start) * along(fraction);
        const std::optional<Contact> met = ground.ray(place + reach * up, -up, reach);
        if (met) highest = std::max(highest, (reach - met->distance) / above(fraction));
    }
    return highest;
}

}  // namespace motus::walker
