// Six legs that walk over hills under a body that moves: hexapod FILE.csv
// Each line of the file is a frame: its time, how far the body has been lifted, and the six feet.
#include <cmath>
#include <fstream>
#include <motus/walker/gait.hpp>
#include <motus/walker/ground.hpp>
#include <motus/walker/walker.hpp>
#include <vector>

using namespace motus;

namespace {

/// Hills over a square of 12 m, a vertex each 0.2 m.
walker::Ground hills() {
    constexpr int side = 61;
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const float x = 0.2F * static_cast<float>(column - side / 2),
                        y = 0.2F * static_cast<float>(row - side / 2);
            positions.emplace_back(x, y, 0.25F * std::sin(1.3F * x) * std::cos(1.1F * y));
            if (row + 1 < side && column + 1 < side) {
                const int corner = row * side + column;
                triangles.emplace_back(corner, corner + 1, corner + side + 1);
                triangles.emplace_back(corner, corner + side + 1, corner + side);
            }
        }
    }
    return {positions, triangles, std::nullopt};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 1;

    // A body that goes 6 m ahead, along +Y, in eight seconds.
    walker::Way way;
    for (int sample = 0; sample <= 96; ++sample) {
        const double time = sample / 12.0;
        way.times.push_back(time);
        way.poses.push_back(
            glm::dmat4{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.2 * std::sin(time), 0.75 * time - 3.0, 0, 1});
    }
    for (const double y : {0.5, 0.0, -0.5}) {
        for (const double x : {-0.6, 0.6}) way.rest.emplace_back(x, y, 0.0);
    }
    const walker::Pattern pattern =
        walker::pattern_of(walker::Gait::tripod, way.rest, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
    way.phases = pattern.phases;
    way.duty = pattern.duty;
    way.stride = 0.5;

    // The whole shot is planned here; every time is then only looked up.
    const walker::Ground ground = hills();
    const walker::Walker walker(way, {}, &ground);

    std::ofstream file(argv[1]);
    file << "time,lift";
    for (int leg = 1; leg <= 6; ++leg) file << ",x" << leg << ",y" << leg << ",z" << leg;
    file << '\n';
    for (int frame = 0; frame <= 8 * 24; ++frame) {
        const double time = frame / 24.0;
        file << time << ',' << walker.body(time).offset.z;
        for (std::size_t leg = 0; leg < walker.leg_count(); ++leg) {
            const glm::dvec3 foot = walker.foot(leg, time).position;
            file << ',' << foot.x << ',' << foot.y << ',' << foot.z;
        }
        file << '\n';
    }
    return file.flush() ? 0 : 1;
}
