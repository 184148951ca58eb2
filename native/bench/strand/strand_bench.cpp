// Strands over a whole shot: the time until the last frame is known, and a frame looked up.
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "motus/strand/motion.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus::strand;
using motus::bench::keep;
using motus::bench::nanoseconds;

namespace {

constexpr std::size_t links = 8;
constexpr double frame_rate = 24.0;
constexpr double sample_rate = 192.0;  // of the inputs, 1/s

/// Tails side by side, on a body that moves.
struct Shot {
    std::vector<Link> all;
    std::vector<double> times;
    std::vector<glm::dvec3> poses, obstacle_places;
    std::vector<glm::dvec3> gravity{{0.0, 0.0, -9.81}};
    std::vector<Obstacle> obstacles;
    bool are_touching = false;

    /// apart: m, from one to the next.
    Shot(std::size_t chains, int frames, const Link& like, double apart = 1.0) {
        for (std::size_t chain = 0; chain < chains; ++chain)
            for (std::size_t i = 0; i <= links; ++i) {
                Link link = like;
                link.parent = i == 0 ? -1 : static_cast<int>(all.size()) - 1;
                all.push_back(link);
            }
        const int samples = static_cast<int>(std::lround(frames / frame_rate * sample_rate));
        for (int k = 0; k <= samples; ++k) {
            const double time = k / sample_rate;
            times.push_back(time);
            const glm::dvec3 body(0.3 * std::sin(2.0 * time), 0.0, 1.0 + 0.2 * std::sin(3.0 * time));
            for (std::size_t chain = 0; chain < chains; ++chain)
                for (std::size_t i = 0; i <= links; ++i)
                    poses.push_back(body + glm::dvec3(0.1 * static_cast<double>(i),
                                                      apart * static_cast<double>(chain), 0.0));
        }
    }
    /// Three balls and a floor.
    void obstruct() {
        for (const double x : {0.0, 0.5, 1.0}) {
            obstacles.push_back({Obstacle::Shape::capsule, 0.3, 0.5});
            obstacle_places.insert(obstacle_places.end(), 2, glm::dvec3(x, 1.0, 0.3));
        }
        obstacles.push_back({Obstacle::Shape::plane, 0.0, 0.5});
        obstacle_places.emplace_back(0.0);
        obstacle_places.emplace_back(0.0, 0.0, 1.0);
        const std::vector<glm::dvec3> row = obstacle_places;
        for (std::size_t k = 1; k < times.size(); ++k)
            obstacle_places.insert(obstacle_places.end(), row.begin(), row.end());
    }
    [[nodiscard]] Motion motion() const {
        return {all,
                {.times = times,
                 .poses = poses,
                 .gravity = gravity,
                 .obstacles = obstacles,
                 .obstacle_places = obstacle_places,
                 .are_touching = are_touching}};
    }
    [[nodiscard]] double work() const {  // links times steps
        return static_cast<double>(all.size()) * times.back() * Solving{}.rate;
    }
};

void row(const motus::bench::Table& table, const std::string& name, const Shot& shot) {
    const double solved = nanoseconds(
        [&] {
            Motion motion = shot.motion();
            motion.solve(std::numeric_limits<std::size_t>::max());
            keep(motion);
        },
        3);
    Motion motion = shot.motion();
    motion.solve(std::numeric_limits<std::size_t>::max());
    std::vector<glm::dvec3> places(shot.all.size());
    constexpr int frames = 100;
    const double looked_up = nanoseconds([&] {
        for (int frame = 0; frame < frames; ++frame) {
            motion.places(frame / frame_rate, places);
            keep(places);
        }
    });
    table.row(name, {1e-6 * solved, solved / shot.work(), 1e-3 * looked_up / frames});
}

}  // namespace

int main() {
    const motus::bench::Table table(
        "Chains of 8 links, 480 steps a second, one thread",
        {{"solved", "ms"}, {"a link and step", "ns"}, {"a frame looked up", "us"}});
    const Link tail{.frequency = 2.0, .drag = 0.5, .bend_frequency = 8.0};
    Link limited = tail, thick = tail;
    limited.bend = 0.5;
    thick.thickness = 0.02;
    Shot obstructed(10, 250, thick);
    obstructed.obstruct();
    row(table, "10 tails, 250 frames", Shot(10, 250, tail));
    row(table, "10 ropes, which nothing damps", Shot(10, 250, {}));
    row(table, "10 tails with limits", Shot(10, 250, limited));
    row(table, "10 tails, 3 balls and a floor", obstructed);
    row(table, "100 tails, 1020 frames", Shot(100, 1020, tail));
    Shot hair(100, 250, thick, 0.05);
    hair.are_touching = true;
    row(table, "100 tails that touch, 250 frames", hair);
    return 0;
}
