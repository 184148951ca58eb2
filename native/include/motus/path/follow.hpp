// Followers on a curve: positions and orientations of many objects at one time.
//
// Costs: O(n log n); with lag some 2300 steps a follower at most. Allocates nothing, but for lag. Any
// number of threads at once, each with spans of its own to write to.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>

#include "motus/config.hpp"
#include "motus/curve/extend.hpp"
#include "motus/path/frames.hpp"
#include "motus/path/timing.hpp"

namespace motus::path {

/// The measure of the bend to which the rate of a lagging orientation is proportional.
enum class LagBy {
    acceleration,  ///< |C''(t)|, the second derivative by the curve's parameter, which depends on how the
                   ///< curve is parametrised, too
    curvature,     ///< 1 / length unit
};

/// One of the followers that have a timing in common.
struct Follower {
    double offset = 0.0;  ///< ahead (+) or behind (-) along the arc, length unit
    double delay = 0.0;   ///< s: where a follower without delay was so long ago
    /// >= 0, length unit: above 0 two bogies on the path carry the follower, whose straight distance this is.
    double wheelbase = 0.0;
};

/// How distances become poses.
struct FollowSettings {
    curve::Extend extend = curve::Extend::clamp;  ///< extrapolate keeps the end's frame
    bool line_up = false;  ///< the first follower stops at the ends; the others keep their distance from it
    glm::dquat axes{1.0, 0.0, 0.0, 0.0};  ///< unit: turns the follower's own forward and up axes to +Y, +Z
    bool rotate = true;                   ///< if false, all rotations are the identity
    double lag_rate = 0.0;  ///< > 0: orientation trails the target at lag_rate * bend per second
    LagBy lag_by = LagBy::acceleration;
    double side = 0.0;    ///< to the right of the path, length unit; distance and speed are still the path's
    double height = 0.0;  ///< above the path, length unit
    /// Frames of the same path whose right and up these two are along; none: the followers' own, without lag.
    std::optional<Frames> aside{};
    double start = -std::numeric_limits<double>::infinity();  ///< s: before it the timing rests as at it
};

/// How far back a lagging orientation remembers, s.
inline constexpr double lag_memory = 120.0;

/// Poses at `time` seconds of followers along one path.
/// Writes followers.size() locations and rotations, allocates nothing (lag apart). A function of its
/// arguments alone.
///
/// The bogies of a follower stand equal arcs before and behind its own place, the nearest such places whose
/// straight distance is the wheelbase, to 1e-12 of it. The follower lies midway between the bogies, its
/// forward axis along the line from the rear one to the front one, its up midway between their frames. Bogies
/// run round a cyclic curve, but for extrapolate, and else beyond the ends along the tangents there. If the
/// path is nowhere so wide, the arc between the bogies is the wheelbase.
///
/// With lag the orientation starts on its target at time 0, or lag_memory seconds ago if that is later,
/// and moves towards it along the shortest arc at the rate stated; before time 0 it is on its target.
/// Its steps are 1/120 s, and longer if they are more than 10 s old, up to 1/300 of their age: at most 2300
/// steps for one follower. The long steps move the orientation by less than 1e-4 rad; by less than 0.01 rad
/// if the target has jumped meanwhile; by less than 0.3 rad if the target has run more than half a turn
/// ahead, so that the shortest arc turned over. As time goes on the orientation may jump by these amounts,
/// and is else continuous. Throws std::invalid_argument if a span's size differs, time, a number of a
/// follower, or the timing's distance or speed at a follower's time is not finite, side or height passes
/// coordinate_limit, a wheelbase or lag_rate is not >= 0, `start` is not below infinity, or `axes` is not a
/// unit quaternion.
void follow(const Frames& frames, const Timing& timing, double time, std::span<const Follower> followers,
            const FollowSettings& settings, std::span<glm::dvec3> locations, std::span<glm::dquat> rotations);

/// How far a follower has come, in the curve's unit of length and seconds.
struct Progress {
    double parameter = 0.0;  ///< of the curve, at the nearest place on it
    double fraction = 0.0;   ///< of the length; 0 on a curve without length
    double distance = 0.0;   ///< along the curve; with loop it goes on rising from lap to lap
    double speed = 0.0;
    double length = 0.0;  ///< of the curve
};

/// The progress at `time` seconds of a follower whose distance is that of the timing plus `moved` plus
/// `offset`. NaN where the distance is.
[[nodiscard]] Progress progress(const curve::ArcLength& path, const Timing& timing, double time, double moved,
                                double offset, curve::Extend extend);

/// The rotation that takes a follower's `forward` axis to +Y and its `up` axis to +Z (both one of +-X, +-Y,
/// +-Z, and across each other, else std::invalid_argument).
[[nodiscard]] glm::dquat follower_axes(const glm::dvec3& forward, const glm::dvec3& up);

}  // namespace motus::path
