// Where a foot finds ground, and how high it has to swing over it. Private to the library.
#pragma once
#include <glm/vec3.hpp>
#include <optional>

#include "motus/walker/ground.hpp"

namespace motus::walker {

/// Origin and directions of a search for ground, in world space.
struct Search {
    glm::dvec3 rest{0.0};  ///< where the foot would stand
    glm::dvec3 hip{0.0};   ///< a place over which there is the body
    glm::dvec3 up{0.0, 0.0, 1.0};
};

/// How far above and below a rest place ground is looked for, m.
struct Reach {
    double up = 0.0;
    double down = 0.0;
};

/// The ground at a rest place: the first thing met on a way from above the hip, level to above the rest
/// place, and down to below the rest place. So a foot stands on a wall in front of it and not behind the
/// wall. Below a roof, over the rest place or over the hip, the way begins below the roof.
[[nodiscard]] std::optional<Contact> footing(const Ground& ground, const Search& search, const Reach& reach);

/// The ground beside a rest place that has no ground below: the first thing met on a way from below the rest
/// place, level back to below the hip, such as the side of a block over whose edge the body goes.
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
