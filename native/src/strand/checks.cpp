#include "checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <vector>

#include "motus/core/numeric.hpp"

namespace motus::strand {
namespace {

constexpr double farthest = 1e9;  // m, m/s or m/s^2: beyond it doubles have lost a tenth of a micrometre

[[nodiscard]] bool is_within(double value, double least, double most) {
    return value >= least && value <= most;
}

[[nodiscard]] bool are_near(std::span<const glm::dvec3> vectors) {
    return std::ranges::all_of(vectors, [](const glm::dvec3& v) {
        return is_within(v.x, -farthest, farthest) && is_within(v.y, -farthest, farthest) &&
               is_within(v.z, -farthest, farthest);
    });
}

void require_links(std::span<const Link> links, double rate) {
    for (std::size_t i = 0; i < links.size(); ++i) {
        const Link& link = links[i];
        require(link.parent >= -1 && link.parent < static_cast<int>(i),
                "parent: must be -1, or the index of a link before this one");
        require(link.mass > 0.0 && link.mass <= 1e12, "mass: must be greater than 0 and at most 1e12");
        require(is_within(link.frequency, 0.0, rate / 8.0),
                "frequency: must be at least 0 and at most an eighth of the rate");
        require(is_within(link.bend_frequency, 0.0, rate / 8.0),
                "bend_frequency: must be at least 0 and at most an eighth of the rate");
        require(is_within(link.damping, 0.0, 100.0), "damping: must be between 0 and 100");
        require(is_within(link.response, -100.0, 100.0), "response: must be between -100 and 100");
        require(is_within(link.drag, 0.0, 1000.0), "drag: must be between 0 and 1000");
        require(is_within(link.stretch, 0.0, 1e6), "stretch: must be between 0 and 1e6");
        require(is_within(link.bend, 0.0, std::numbers::pi), "bend: must be between 0 and pi");
        require(is_within(link.side_bend, 0.0, std::numbers::pi), "side_bend: must be between 0 and pi");
        require(is_within(link.thickness, 0.0, 1e6), "thickness: must be between 0 and 1e6");
    }
}

void require_over_time(std::span<const Link> links, const Inputs& inputs) {
    const std::size_t count = inputs.times.size();
    require(count > 0, "times: must have at least one");
    require(are_finite(inputs.times), "times: must be finite");
    require(std::ranges::adjacent_find(inputs.times, std::ranges::greater_equal{}) == inputs.times.end(),
            "times: must strictly rise");
    require(inputs.poses.size() == count * links.size(), "poses: must have a row of all links for each time");
    require(are_near(inputs.poses), "poses: must be finite, and at most 1e9 in size");
    require(inputs.gravity.size() <= 1 || inputs.gravity.size() == count,
            "gravity: must be none, one, or one for each time");
    require(are_near(inputs.gravity), "gravity: must be finite, and at most 1e9 in size");
    require(inputs.air.size() <= 1 || inputs.air.size() == count,
            "air: must be none, one, or one for each time");
    require(are_near(inputs.air), "air: must be finite, and at most 1e9 in size");
    require(inputs.sides.empty() || inputs.sides.size() == inputs.poses.size(),
            "sides: must be none, or have a row of all links for each time");
    require(are_near(inputs.sides), "sides: must be finite, and at most 1e9 in size");
    require(is_within(inputs.friction, 0.0, 100.0), "friction: must be between 0 and 100");
    require(std::ranges::adjacent_find(inputs.resets, std::ranges::greater_equal{}) == inputs.resets.end() &&
                (inputs.resets.empty() || (inputs.resets.front() > 0 && inputs.resets.back() < count)),
            "resets: must rise, and be indices of times but the first");
}

void require_obstacles(const Inputs& inputs) {
    for (const Obstacle& obstacle : inputs.obstacles) {
        require(is_within(obstacle.radius, 0.0, 1e6), "radius: must be between 0 and 1e6");
        require(is_within(obstacle.friction, 0.0, 100.0), "friction: must be between 0 and 100");
    }
    require(inputs.obstacle_places.size() == 2 * inputs.obstacles.size() * inputs.times.size(),
            "obstacle_places: must have a row of two places for each obstacle for each time");
    require(are_near(inputs.obstacle_places), "obstacle_places: must be finite, and at most 1e9 in size");
}

void require_surfaces(const Inputs& inputs) {
    for (const PlacedSurface& surface : inputs.surfaces) {
        require(surface.surface != nullptr, "surfaces: there must be one");
        require(is_within(surface.distance, 0.0, 1e6), "distance: must be between 0 and 1e6");
        require(is_within(surface.friction, 0.0, 100.0), "friction: must be between 0 and 100");
    }
    require(inputs.surface_matrices.size() == inputs.surfaces.size() * inputs.times.size(),
            "surface_matrices: must have a row of all surfaces for each time");
    for (const glm::dmat4& matrix : inputs.surface_matrices) {
        constexpr double least = 1e-6, most = 1e6;  // scales
        require(are_near(std::array{glm::dvec3(matrix[3])}),
                "surface_matrices: must be finite, and move by at most 1e9");
        const double scale = glm::length(glm::dvec3(matrix[0]));
        require(is_within(scale, least, most), "surface_matrices: scales must be between 1e-6 and 1e6");
        const glm::dmat3 axes(matrix);
        const glm::dmat3 square = glm::transpose(axes) * axes;
        constexpr double even = 1e-3;
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                require(std::abs(square[column][row] / (scale * scale) - (row == column ? 1.0 : 0.0)) < even,
                        "surface_matrices: must turn, move and scale evenly alone");
    }
}

void require_pins(std::span<const Link> links, const Inputs& inputs) {
    std::vector<bool> is_pinned(links.size());
    for (const std::size_t pinned : inputs.pinned) {
        require(pinned < links.size() && !is_pinned[pinned], "pinned: must be indices of links, each once");
        is_pinned[pinned] = true;
    }
    const std::size_t numbers = inputs.pinned.size() * inputs.times.size();
    require(inputs.pin_places.size() == numbers, "pin_places: must have a row for each time");
    require(are_near(inputs.pin_places), "pin_places: must be finite, and at most 1e9 in size");
    require(inputs.pin_weights.size() == numbers, "pin_weights: must have a row for each time");
    require(
        std::ranges::all_of(inputs.pin_weights, [](double weight) { return is_within(weight, 0.0, 1.0); }),
        "pin_weights: must be between 0 and 1");
}

void require_solving(const Inputs& inputs, const Solving& solving) {
    require(is_within(solving.rate, 60.0, 1e5), "rate: must be between 60 and 1e5");
    require(is_within(solving.settle, 0.0, 1000.0), "settle: must be between 0 and 1000");
    require(is_within(solving.cycles, 1.0, 1000.0), "cycles: must be between 1 and 1000");
    if (!solving.is_loop) return;
    require(inputs.resets.empty(), "resets: must be none in a loop");
    require(inputs.times.size() > 1, "times: must be at least two in a loop");
}

}  // namespace

void require_sound(std::span<const Link> links, const Inputs& inputs, const Solving& solving) {
    require_solving(inputs, solving);
    require_links(links, solving.rate);
    require_over_time(links, inputs);
    require_obstacles(inputs);
    require_surfaces(inputs);
    require_pins(links, inputs);
}

}  // namespace motus::strand
