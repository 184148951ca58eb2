#include "motus/path/follow.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <stdexcept>
#include <vector>

#include "bogies.hpp"
#include "motus/core/numeric.hpp"

namespace motus::path {
namespace {

constexpr double lag_steps_per_second = 120.0;
constexpr double exact_memory =
    10.0;                            // s; older steps are longer: four of the grid's, and twice as many each
constexpr double older_width = 4.0;  // time that the age doubles
constexpr double largest_bend = 1e100;  // in place of a cusp's infinity
constexpr double forgotten = 40.0;      // e^-40 of an orientation is below rounding

/// Follower at a distance along the curve, where it may also lie beyond an end.
Pose pose_at(const Frames& frames, double distance, double wheelbase, double speed, curve::Extend extend) {
    const curve::Extended on_path = extended(distance, frames.path().length(), extend);
    if (wheelbase > 0.0) {
        const EndlessPath path(frames, extend != curve::Extend::extrapolate);
        return on_bogies(path, on_path.value + on_path.beyond, wheelbase, speed);
    }
    Pose pose = frames.pose(on_path.value, speed);
    if (on_path.beyond != 0.0 && frames.path().length() > 0.0) {
        pose.location += on_path.beyond * (pose.rotation * glm::dvec3(0.0, 1.0, 0.0));
    }
    return pose;
}

/// Where followers are along a curve of a `length`, the `first` of which is so far ahead of the timing.
struct Places {
    double first, length;
    bool line_up;

    [[nodiscard]] double at(double distance, double offset) const {
        if (!line_up) return distance + offset;
        return std::clamp(distance + first, 0.0, length) + (offset - first);
    }
};

/// One step of a lagging orientation: the share of the way to the target as it is at `time`.
struct LagStep {
    double time, share;
};

/// Orientation that trails its target, by steps on a fixed grid of time, whose width grows with their age;
/// the last one, and the first if the memory begins between two grid points, are shorter. A step of
/// several grid widths begins at a multiple of them, so that steps stay where they are as time goes on, until
/// two become one.
class Lag {
  public:
    Lag(const Frames& frames, const Timing& timing, const Places& places, const Follower& follower,
        const FollowSettings& settings)
        : frames_(frames), timing_(timing), places_(places), follower_(follower), settings_(settings) {}

    /// `steps` is scratch.
    [[nodiscard]] glm::dquat at(double time, std::vector<LagStep>& steps) const {
        const double oldest = std::max(0.0, time - lag_memory);
        // From the present back, as far as the steps do not yet make the rest forgotten.
        steps.clear();
        double begin = time;
        const double grid = std::ceil(time * lag_steps_per_second);
        double total = 0.0;
        double width = 1.0;
        double next_age = exact_memory;
        // Counted, since one less is the same number if the time is very large.
        for (double count = 0.0; begin > oldest && total < forgotten;) {
            const double end = begin;
            if (time - end >= next_age) {
                width = std::max(2.0 * width, older_width);
                next_age *= 2.0;
            }
            // How far (grid - count) lies behind a multiple of the width.
            const double behind = std::fmod(std::fmod(grid, width) + width - std::fmod(count, width), width);
            count += behind > 0.0 ? behind : width;
            begin = std::clamp((grid - count) / lag_steps_per_second, oldest, end);
            const double exponent = settings_.lag_rate * bend(0.5 * (begin + end)) * (end - begin);
            steps.push_back({0.5 * (begin + end), -std::expm1(-exponent)});
            total += exponent;
        }
        glm::dquat rotation = target(begin);
        for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
            if (step->share > 0.0) rotation = glm::slerp(rotation, target(step->time), step->share);
        }
        return glm::normalize(rotation);
    }

  private:
    [[nodiscard]] double distance(double time) const {
        return places_.at(timing_.distance(time), follower_.offset);
    }

    [[nodiscard]] glm::dquat target(double time) const {
        return pose_at(frames_, distance(time), follower_.wheelbase, timing_.speed(time), settings_.extend)
            .rotation;
    }

    [[nodiscard]] double bend(double time) const {
        const curve::ArcLength& path = frames_.path();
        const double t = t_at_length(path, distance(time), settings_.extend).value;
        if (settings_.lag_by == LagBy::curvature) return std::min(curvature(path.curve(), t), largest_bend);
        return glm::length(derivative(path.curve(), t, 2));
    }

    const Frames& frames_;
    const Timing& timing_;
    const Places& places_;
    const Follower& follower_;
    const FollowSettings& settings_;
};

/// value modulo period > 0, in [0, period].
double wrapped(double value, double period) {
    const double rest = std::fmod(value, period);
    return rest < 0.0 ? rest + period : std::abs(rest);  // never -0
}

/// A distance with the meaning that `extend` gives to those beyond the ends; extrapolate leaves it alone.
double within(double distance, double length, curve::Extend extend) {
    if ((distance >= 0.0 && distance <= length) || extend == curve::Extend::extrapolate || length == 0.0)
        return distance;
    if (extend == curve::Extend::clamp) return std::clamp(distance, 0.0, length);
    if (extend == curve::Extend::loop) return wrapped(distance, length);
    return length - std::abs(wrapped(distance, 2.0 * length) - length);
}

bool is_axis(const glm::dvec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z) == 1.0 && glm::dot(v, v) == 1.0;
}

}  // namespace

void follow(const Frames& frames, const Timing& timing, double time, std::span<const Follower> followers,
            const FollowSettings& settings, std::span<glm::dvec3> locations,
            std::span<glm::dquat> rotations) {
    require(locations.size() == followers.size(), "locations: must be as many as followers");
    require(rotations.size() == followers.size(), "rotations: must be as many as followers");
    require(std::isfinite(time), "time: must be finite");
    require(std::isfinite(settings.lag_rate) && settings.lag_rate >= 0.0,
            "lag_rate: must be finite and 0 or more");
    constexpr double rounding = 1e-3;
    require(std::abs(glm::dot(settings.axes, settings.axes) - 1.0) < rounding,
            "axes: must be a unit quaternion");
    require(std::abs(settings.side) <= curve::coordinate_limit, "side: must be at most 1e100 in size");
    require(std::abs(settings.height) <= curve::coordinate_limit, "height: must be at most 1e100 in size");
    require(settings.start < std::numeric_limits<double>::infinity(), "start: must be below infinity");
    for (const Follower& one : followers) {
        require(std::isfinite(one.offset), "offset: must be finite");
        require(std::isfinite(one.delay), "delay: must be finite");
        require(std::isfinite(one.wheelbase) && one.wheelbase >= 0.0,
                "wheelbase: must be finite and 0 or more");
    }
    const Places places{followers.empty() ? 0.0 : followers.front().offset, frames.path().length(),
                        settings.line_up};
    const glm::dvec3 aside(settings.side, 0.0, settings.height);
    const bool is_aside = settings.side != 0.0 || settings.height != 0.0;
    std::vector<LagStep> steps;
    for (std::size_t i = 0; i < followers.size(); ++i) {
        const Follower& one = followers[i];
        const double own_time = std::max(time - one.delay, settings.start);
        const double distance = timing.distance(own_time);
        const double speed = timing.speed(own_time);
        require(are_finite(distance, speed), "time: the distance and the speed at it must be finite");
        const double along = places.at(distance, one.offset);
        if (!settings.rotate && !is_aside && one.wheelbase == 0.0) {
            locations[i] = position_at_length(frames.path(), along, settings.extend);
            rotations[i] = glm::dquat(1.0, 0.0, 0.0, 0.0);
            continue;
        }
        Pose pose = pose_at(frames, along, one.wheelbase, speed, settings.extend);
        if (is_aside) {
            const glm::dquat level =
                settings.aside
                    ? pose_at(*settings.aside, along, one.wheelbase, speed, settings.extend).rotation
                    : pose.rotation;
            pose.location += level * aside;
        }
        if (settings.rotate && settings.lag_rate > 0.0 && own_time > 0.0) {
            pose.rotation = Lag(frames, timing, places, one, settings).at(own_time, steps);
        }
        locations[i] = pose.location;
        rotations[i] = settings.rotate ? pose.rotation * settings.axes : glm::dquat(1.0, 0.0, 0.0, 0.0);
    }
}

Progress progress(const curve::ArcLength& path, const Timing& timing, double time, double moved,
                  double offset, curve::Extend extend) {
    const double length = path.length();
    const double gone = timing.distance(time) + moved + offset;
    const double place = within(gone, length, extend);
    Progress found;
    found.parameter = path.t_at_length(std::clamp(place, 0.0, length));
    found.fraction = length > 0.0 ? place / length : 0.0;
    found.distance = extend == curve::Extend::loop && length > 0.0 ? gone : place;
    found.speed = timing.speed(time);
    found.length = length;
    return found;
}

glm::dquat follower_axes(const glm::dvec3& forward, const glm::dvec3& up) {
    require(is_axis(forward), "forward: must be one of the axes");
    require(is_axis(up), "up: must be one of the axes");
    require(glm::dot(forward, up) == 0.0, "up: must be across forward");
    const glm::dmat3 from_axes(glm::cross(forward, up), forward, up);
    return glm::quat_cast(glm::transpose(from_axes));
}

}  // namespace motus::path
