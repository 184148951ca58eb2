// A ride along a curve of Bézier segments.
#include <memory>

#include "motus/curve/arc_length.hpp"
#include "motus/path/follow.hpp"
#include "web.hpp"

namespace motus::web {
namespace {

std::shared_ptr<const curve::ArcLength> path_of(const double* points, std::size_t count) {
    return curve::shared_arc_length(curve::Curve::bezier(points_of(points, count)));
}

}  // namespace

/// out: the length of one segment.
MOTUS_WEB(bezier_length)(const double* points, std::size_t count, double* out) {
    *out = path_of(points, count)->length();
}

/// Places at fractions of the length. out: three numbers a fraction.
MOTUS_WEB(bezier_places)
(const double* points, std::size_t count, const double* fractions, std::size_t wanted, double* out) {
    const auto path = path_of(points, count);
    for (std::size_t i = 0; i < wanted; ++i)
        out = write(out, curve::position_at_length(*path, fractions[i] * path->length()));
}

/// Where a follower is that rides with ease and banks by `strength`, and which way its right and its up are.
/// out: eleven numbers a time: three vectors, the distance, and the speed.
MOTUS_WEB(bezier_ride)
(const double* points, std::size_t count, const double* times, std::size_t wanted, double duration,
 double ease_in, double ease_out, double strength, double* out) {
    const auto path = path_of(points, count);
    path::FrameSettings banking;
    banking.mode = path::FrameMode::banking;
    banking.strength = strength;
    const path::Frames frames = path::shared_frames(path, banking);
    const path::Timing timing = path::Timing::eased(duration, path->length(), ease_in, ease_out);
    for (std::size_t i = 0; i < wanted; ++i) {
        const path::Follower follower;
        path::Pose pose;
        path::follow(frames, timing, times[i], {&follower, 1}, {}, {&pose.location, 1}, {&pose.rotation, 1});
        out = write(out, pose.location);
        out = write(out, pose.rotation * glm::dvec3(1.0, 0.0, 0.0));
        out = write(out, pose.rotation * glm::dvec3(0.0, 0.0, 1.0));
        *out++ = timing.distance(times[i]);
        *out++ = timing.speed(times[i]);
    }
}

}  // namespace motus::web
