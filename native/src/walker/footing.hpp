// Where a foot finds ground, and how high it has to swing over it. Private to the library.
#pragma once
#include <glm/vec3.hpp>
#include <optional>

#include "motus/walker/ground.hpp"

namespace motus::walker {

/// From where, and in which direction, ground is looked for. World space.
struct Search {
    glm::dvec3 rest{0.0};  ///< where the foot would stand
    glm::dvec3 hip{0.0};   ///< a place over which there is the body
    glm::dvec3 up{0.0, 0.0, 1.0};
};

/// How far above and below a rest place, m.
struct Reach {
    double up = 0.0;
    double down = 0.0;
};

/// The ground at a rest place: what is met first on a way from above the hip, level to above the rest place,
/// so that a foot stands on a wall before it and not behind, and down to below the rest place. Below a roof,
/// over the rest place or over the hip, all that from below the roof.
[[nodiscard]] std::optional<Contact> footing(const Ground& ground, const Search& search, const Reach& reach);

/// The ground beside a rest place under which there is none: what is met from below it, level back to below
/// the hip, as the side of a block over whose edge the body goes.
[[nodiscard]] std::optional<Contact> footing_around_edge(const Ground& ground, const Search& search,
                                                         const Reach& reach);

/// The rise, and the straight parts at both ends, with which a swing clears the ground.
struct Clearing {
    double rise = 0.0;                      ///< m, >= 0, half-way, above the line from start to end
    double upwards = 0.0, downwards = 0.0;  ///< as of Step
};

/// The Clearing of a swing from start to end, for ground that is looked for up to `reach` above the line from
/// start to end, and below roofs. Ground that is looked at at seven places; edges between these, as of
/// stairs, are found to a millionth of the way.
[[nodiscard]] Clearing clearing(const Ground& ground, const glm::dvec3& start, const glm::dvec3& end,
                                const glm::dvec3& up, double reach);

}  // namespace motus::walker
