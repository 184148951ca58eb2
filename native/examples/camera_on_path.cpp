// A camera that flies along a curve and banks into its bends: camera_on_path FILE.csv
// Each line of the file is a frame: its time, where the camera is, and its orientation, which turns +Y to
// where it flies and +Z to its up.
#include <array>
#include <fstream>
#include <memory>
#include <motus/curve/arc_length.hpp>
#include <motus/curve/curve.hpp>
#include <motus/path/follow.hpp>
#include <motus/path/frames.hpp>
#include <motus/path/timing.hpp>

using namespace motus;

int main(int argc, char** argv) {
    if (argc != 2) return 1;

    // Three points with handles, as an artist draws them; metres.
    const std::array<glm::dvec3, 3> points{{{0, 0, 2}, {20, 8, 5}, {40, 0, 3}}};
    const std::array<glm::dvec3, 3> left{{{-6, -6, 2}, {12, 8, 5}, {34, -8, 3}}};
    const std::array<glm::dvec3, 3> right{{{6, 6, 2}, {28, 8, 5}, {46, 8, 3}}};
    const auto path =
        std::make_shared<const curve::ArcLength>(curve::Curve::spline(points, left, right, false));

    // The frames roll as an aircraft does that flies this bend at this speed, but never by more than 40
    // degrees.
    path::FrameSettings banking;
    banking.mode = path::FrameMode::banking;
    banking.limit = 0.7;
    banking.smoothing = 2.0;
    const path::Frames frames(path, banking);

    // The whole curve in six seconds; the first and the last fifth of the time to gather speed and to brake.
    const double duration = 6.0;
    const path::Timing timing = path::Timing::eased(duration, path->length(), 0.2, 0.2);

    std::ofstream file(argv[1]);
    file << "time,x,y,z,rotation_w,rotation_x,rotation_y,rotation_z\n";
    const int frames_a_second = 24;
    for (int frame = 0; frame <= static_cast<int>(duration) * frames_a_second; ++frame) {
        const double time = static_cast<double>(frame) / frames_a_second;
        const path::Pose pose = frames.pose(timing.distance(time), timing.speed(time));
        file << time << ',' << pose.location.x << ',' << pose.location.y << ',' << pose.location.z << ','
             << pose.rotation.w << ',' << pose.rotation.x << ',' << pose.rotation.y << ',' << pose.rotation.z
             << '\n';
    }
    return file.flush() ? 0 : 1;
}
