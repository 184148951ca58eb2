// Shots of strands, for their tests.
#pragma once
#include <cmath>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/strand/motion.hpp"

namespace motus::test {

using namespace strand;

inline constexpr double g = 9.81;
inline const glm::dvec3 down(0.0, 0.0, -g);

/// Links of one chain, the first one its root.
inline std::vector<Link> chain(std::size_t links, const Link& like = {}) {
    std::vector<Link> all(links + 1, like);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].parent = static_cast<int>(i) - 1;
    return all;
}

/// Inputs and what their spans show: a pose that stands still unless it is changed.
struct Shot {
    std::vector<double> times;
    std::vector<glm::dvec3> poses, gravity{down}, air, obstacle_places, pin_places;
    std::vector<Obstacle> obstacles;
    std::vector<PlacedSurface> surfaces;
    std::vector<glm::dmat4> surface_matrices;
    std::vector<std::size_t> pinned, resets;
    std::vector<double> pin_weights;
    std::vector<glm::dvec3> sides;
    bool are_touching = false;
    double friction = 0.5;

    Shot(double seconds, const std::vector<glm::dvec3>& pose, double rate = 192.0) {
        const int count = static_cast<int>(std::lround(seconds * rate));
        for (int k = 0; k <= count; ++k) {
            times.push_back(k / rate);
            poses.insert(poses.end(), pose.begin(), pose.end());
        }
    }
    [[nodiscard]] std::size_t links() const { return poses.size() / times.size(); }
    template <class Place>
    void pose(std::size_t link, const Place& place) {
        for (std::size_t k = 0; k < times.size(); ++k) poses[k * links() + link] = place(times[k]);
    }
    [[nodiscard]] Inputs inputs() const {
        return {
            times,  poses,      gravity,     air,    obstacles, obstacle_places, surfaces, surface_matrices,
            pinned, pin_places, pin_weights, resets, sides,     are_touching,    friction};
    }
};

inline Motion solved(const std::vector<Link>& links, const Shot& shot, const Solving& solving = {}) {
    Motion motion(links, shot.inputs(), solving);
    while (!motion.solve(1000)) {
    }
    return motion;
}

inline std::vector<glm::dvec3> places(const Motion& motion, double time) {
    std::vector<glm::dvec3> out(motion.size());
    motion.places(time, out);
    return out;
}

/// A pose of links along a direction.
inline std::vector<glm::dvec3> straight(std::size_t links, double length, const glm::dvec3& direction) {
    std::vector<glm::dvec3> pose;
    for (std::size_t i = 0; i <= links; ++i)
        pose.push_back(direction * (length * static_cast<double>(i) / static_cast<double>(links)));
    return pose;
}

/// The obstacle's two places at each time.
template <class Places>
void add_obstacle(Shot& shot, const Obstacle& obstacle, const Places& at) {
    shot.obstacles.push_back(obstacle);
    std::vector<glm::dvec3> all;
    const std::size_t others = 2 * (shot.obstacles.size() - 1);
    for (std::size_t k = 0; k < shot.times.size(); ++k) {
        for (std::size_t i = 0; i < others; ++i) all.push_back(shot.obstacle_places[k * others + i]);
        const std::array<glm::dvec3, 2> two = at(shot.times[k]);
        all.insert(all.end(), two.begin(), two.end());
    }
    shot.obstacle_places = all;
}

}  // namespace motus::test
