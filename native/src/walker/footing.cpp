#include "footing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

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

/// Faces above a place that are looked through; below more of them no roof is found.
constexpr std::size_t most_faces = 64;

/// How far up from a place ground is looked for, `most` at most: less below a roof, a face that looks down on
/// air through which one can go, with a floor below. A place may be within the ground, or within stones that
/// are within each other.
[[nodiscard]] double room_above(const Ground& ground, const glm::dvec3& place, const glm::dvec3& up,
                                double most) {
    struct Face {
        double height = 0.0;
        bool leaves = false;
    };
    constexpr double same = 1e-6;     // of the place's coordinates: faces that touch are met once
    constexpr double low = 0.1;       // of `most`: lower air is a crack between stones
    constexpr double below_it = 0.9;  // of the air's height
    std::array<Face, most_faces> faces;
    std::size_t count = 0;
    const double skip = same * (1.0 + length_of(place));
    // Further up than `most` too, since the place is within what is left there without being entered before.
    for (double height = skip;; height = faces[count - 1].height + skip) {
        const auto met = ground.ray(place + height * up, up, std::numeric_limits<double>::infinity());
        if (!met) break;
        if (count == most_faces) return most;
        faces[count++] = {height + met->distance, met->leaves};
    }
    const std::span<const Face> above(faces.data(), count);
    int within = 0, left = 0;
    for (const Face& face : above) {
        left += face.leaves ? 1 : -1;
        within = std::max(within, left);
    }
    // Without one it is ground whose faces are turned over.
    const auto has_floor = [&](double height) {
        return height > 0.0 || ground.ray(place + skip * up, -up, std::numeric_limits<double>::infinity());
    };
    double air = 0.0;  // from there on, while it is within nothing
    for (const Face& face : above) {
        if (face.leaves) {
            --within;
            air = face.height;
        } else if (within == 0 && face.height - air > low * most && has_floor(air)) {
            return std::min(most, air + below_it * (face.height - air));
        } else {
            ++within;
        }
    }
    return most;
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
    // As much lower as what is above the hip has it.
    const double level = reach.up + glm::dot(search.rest - search.hip, search.up);
    const double lower = level > 0.0 ? level - room_above(ground, search.hip, search.up, level) : 0.0;
    const double over_rest = room_above(ground, search.rest, search.up, reach.up);
    const glm::dvec3 above = search.rest + std::max(0.0, std::min(over_rest, reach.up - lower)) * search.up;
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
    const auto below = [&](const glm::dvec3& place, double room) {
        return ground.ray(place + room * up, -up, room);
    };
    for (const double fraction : fractions) {
        const glm::dvec3 place = start + (end - start) * along(fraction);
        // Roofs are looked for where anything is met at all, which is quicker.
        if (!below(place, reach)) continue;
        const double room = room_above(ground, place, up, reach);
        const std::optional<Contact> met = below(place, room);
        if (met) highest = std::max(highest, (room - met->distance) / above(fraction));
    }
    return highest;
}

}  // namespace motus::walker
