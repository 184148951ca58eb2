// Frames and followers: time for each, compared with a simple implementation.
#include <cstddef>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "motus/bones/pose.hpp"
#include "motus/path/follow.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::bones;
using namespace motus::path;

namespace {

constexpr std::size_t follower_count = 1000;

curve::Curve winding_spline() {
    std::vector<glm::dvec3> points, left, right;
    for (int i = 0; i < 9; ++i) {
        const glm::dvec3 point(4.0 * i, i % 2 == 0 ? -3.0 : 3.0, 1.5 * (i % 3));
        const glm::dvec3 handle(2.0, i % 2 == 0 ? 0.5 : -0.5, 0.3);
        points.push_back(point);
        left.push_back(point - handle);
        right.push_back(point + handle);
    }
    return curve::Curve::spline(points, left, right, false);
}

/// The plain way: per follower a search along a table of chords from its start, as the usual scripts do, then
/// the coordinated turn if it is.
class PlainFollower {
  public:
    explicit PlainFollower(const curve::Curve& curve) : curve_(curve) {
        const double end = static_cast<double>(curve.segment_count());
        glm::dvec3 last = position(curve, 0.0);
        for (double t = 0.0; t <= end; t += 0.01) {
            const glm::dvec3 now = position(curve, t);
            lengths_.push_back((lengths_.empty() ? 0.0 : lengths_.back()) + glm::length(now - last));
            last = now;
        }
    }

    [[nodiscard]] Pose pose(double s, double speed) const {
        std::size_t i = 0;
        while (i + 2 < lengths_.size() && lengths_[i + 1] < s) ++i;
        const double t =
            0.01 * (static_cast<double>(i) + (s - lengths_[i]) / (lengths_[i + 1] - lengths_[i]));
        const curve::Jet at = jet(curve_, t);
        const glm::dvec3 tangent = glm::normalize(at.d1);
        const glm::dvec3 bend = (at.d2 - glm::dot(at.d2, tangent) * tangent) / glm::dot(at.d1, at.d1);
        const glm::dvec3 x =
            glm::normalize(glm::cross(tangent, glm::dvec3(0, 0, 9.81) + speed * speed * bend));
        return {at.position, glm::quat_cast(glm::dmat3(x, tangent, glm::cross(x, tangent)))};
    }

  private:
    const curve::Curve& curve_;
    std::vector<double> lengths_;
};

void row(const bench::Table& table, const std::string& name, double nanoseconds, double plain) {
    if (plain > 0.0)
        table.row(name, {nanoseconds / 1e3, plain / 1e3, plain / nanoseconds});
    else
        table.row(name, {nanoseconds / 1e3});
}

double time_of_plain(const PlainFollower& plain, const Timing& timing, const std::vector<double>& offsets,
                     std::vector<Pose>& poses) {
    return bench::nanoseconds([&] {
        const double distance = timing.distance(7.0);
        const double speed = timing.speed(7.0);
        for (std::size_t i = 0; i < offsets.size(); ++i) poses[i] = plain.pose(distance + offsets[i], speed);
        bench::keep(poses);
    });
}

}  // namespace

int main() {
    const curve::Curve curve = winding_spline();
    const auto path = std::make_shared<const curve::ArcLength>(curve);
    const Timing timing = Timing::eased(10.0, path->length(), 0.2, 0.2);
    std::vector<double> offsets;
    for (std::size_t i = 0; i < follower_count; ++i) offsets.push_back(-0.01 * static_cast<double>(i));
    std::vector<Follower> followers;
    for (const double offset : offsets) followers.push_back({offset});
    std::vector<glm::dvec3> locations(follower_count);
    std::vector<glm::dquat> rotations(follower_count);
    std::vector<Pose> poses(follower_count);
    const PlainFollower plain(curve);
    const double plain_time = time_of_plain(plain, timing, offsets, poses);

    std::printf("Plain: each follower searches a table of chords and banks by its own derivatives.\n");
    const bench::Table table("Frames and followers on a cubic spline of " +
                                 std::to_string(curve.segment_count()) + " segments; one thread, best of 7",
                             {{"Motus", "us", 1}, {"plain", "us", 1}, {"faster by", "x"}}, 40);
    const std::vector<std::pair<const char*, FrameMode>> modes{{"world_up", FrameMode::world_up},
                                                               {"minimal", FrameMode::minimal},
                                                               {"banking", FrameMode::banking},
                                                               {"curvature", FrameMode::curvature}};
    for (const auto& [name, mode] : modes) {
        FrameSettings settings;
        settings.mode = mode;
        const double build = bench::nanoseconds([&] { bench::keep(Frames(path, settings)); });
        row(table, std::string(name) + ", its tables", build, 0.0);
        const Frames frames(path, settings);
        const double taken = bench::nanoseconds([&] {
            follow(frames, timing, 7.0, followers, {}, locations, rotations);
            bench::keep(locations);
        });
        row(table, std::string(name) + ", 1000 followers", taken,
            mode == FrameMode::banking ? plain_time : 0.0);
    }

    const Frames frames(path, {});
    FollowSettings lagging;
    lagging.lag_rate = 0.01;
    row(table, "1 follower that lags, at 10 s", bench::nanoseconds([&] {
            follow(frames, timing, 10.0, {followers.data(), 1}, lagging, {locations.data(), 1},
                   {rotations.data(), 1});
        }),
        0.0);
    lagging.lag_rate = 1e-6;
    row(table, "1 follower that hardly turns, at 500 s", bench::nanoseconds([&] {
            follow(frames, timing, 500.0, {followers.data(), 1}, lagging, {locations.data(), 1},
                   {rotations.data(), 1});
        }),
        0.0);
    std::vector<Follower> wagons = followers;
    for (Follower& wagon : wagons) wagon.wheelbase = 0.5;
    row(table, "1000 followers on bogies",
        bench::nanoseconds([&] { follow(frames, timing, 7.0, wagons, {}, locations, rotations); }), 0.0);
    std::vector<float> matrices(16 * follower_count);
    row(table, "matrices of 1000 poses",
        bench::nanoseconds([&] { pack_matrices(locations, rotations, matrices); }), 0.0);
    std::vector<glm::dvec3> angles(follower_count);
    row(table, "Euler angles of 1000 rotations", bench::nanoseconds([&] {
            for (std::size_t i = 0; i < follower_count; ++i) angles[i] = euler_xyz(rotations[i]);
            bench::keep(angles);
        }),
        0.0);
    return 0;
}
