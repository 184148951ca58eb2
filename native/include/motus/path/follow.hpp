// Followers on a curve: positions and orientations of many objects at one time.
//
// Costs: O(n log n); with lag some 2300 steps a follower at most. Allocates nothing, but for lag. Any
// number of threads at once, each with spans of its own to write to.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
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

/// How distances become poses.
struct FollowSettings {
    curve::Extend extend = curve::Extend::clamp;  ///< extrapolate keeps the end's frame
    bool line_up = false;  ///< the first follower stops at the ends; the others keep their distance from it
    glm::dquat axes{1.0, 0.0, 0.0, 0.0};  ///< unit: turns the follower's own forward and up axes to +Y, +Z
    bool rotate = true;                   ///< if false, all rotations are the identity
    double lag_rate = 0.0;  ///< > 0: orientation trails the target at lag_rate * bend per second
    LagBy lag_by = LagBy::acceleration;
};

/// How far back a lagging orientation remembers, s.
inline constexpr double lag_memory = 120.0;

/// Poses at `time` seconds of followers that are `offsets` ahead (+) or behind (-) along the arc.
/// Writes offsets.size() locations and rotations, allocates nothing (lag apart). A function of its arguments
/// alone.
///
/// With lag the orientation starts on its target at time 0, or lag_memory seconds ago if that is later,
/// and moves towards it along the shortest arc at the rate stated; before time 0 it is on its target.
/// Its steps are 1/120 s, and longer if they are more than 10 s old, up to 1/300 of their age: at most 2300
/// steps for one follower. The long steps move the orientation by less than 1e-4 rad; by less than 0.01 rad
/// if the target has jumped meanwhile; by less than 0.3 rad if the target has run more than half a turn
/// ahead, so that the shortest arc turned over. As time goes on the orientation may jump by these amounts,
/// and is else continuous. Throws std::invalid_argument if a span's size differs, time, an offset, or the
/// timing's distance or speed at that time is not finite, lag_rate is not >= 0, or
/// `axes` is not a unit quaternion.
void follow(const Frames& frames, const Timing& timing, double time, std::span<const double> offsets,
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
