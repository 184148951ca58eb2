#include "motus/path/follow.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <stdexcept>
#include <vector>

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
Pose pose_at(const Frames& frames, double distance, double speed, curve::Extend extend) {
    const curve::Extended on_path = extended(distance, frames.path().length(), extend);
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
    Lag(const Frames& frames, const Timing& timing, const Places& places, double offset,
        const FollowSettings& settings)
        : frames_(frames), timing_(timing), places_(places), offset_(offset), settings_(settings) {}

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
    [[nodiscard]] double distance(double time) const { return places_.at(timing_.distance(time), offset_); }

    [[nodiscard]] glm::dquat target(double time) const {
        return pose_at(frames_, distance(time), timing_.speed(time), settings_.extend).rotation;
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
    double offset_;
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

void follow(const Frames& frames, const Timing& timing, double time, std::span<const double> offsets,
            const FollowSettings& settings, std::span<glm::dvec3> locations,
            std::span<glm::dquat> rotations) {
    require(locations.size() == offsets.size(), "locations: must be as many as offsets");
    require(rotations.size() == offsets.size(), "rotations: must be as many as offsets");
    require(std::isfinite(time), "time: must be finite");
    require(are_finite(offsets), "offsets: must be finite");
    require(std::isfinite(settings.lag_rate) && settings.lag_rate >= 0.0,
            "lag_rate: must be finite and 0 or more");
    constexpr double rounding = 1e-3;
    require(std::abs(glm::dot(settings.axes, settings.axes) - 1.0) < rounding,
            "axes: must be a unit quaternion");
    const double distance = timing.distance(time);
    const double speed = timing.speed(time);
    require(are_finite(distance, speed), "time: the distance and the speed at it must be finite");
    const Places places{offsets.empty() ? 0.0 : offsets.front(), frames.path().length(), settings.line_up};
    std::vector<LagStep> steps;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const double along = places.at(distance, offsets[i]);
        if (!settings.rotate) {
            locations[i] = position_at_length(frames.path(), along, settings.extend);
            rotations[i] = glm::dquat(1.0, 0.0, 0.0, 0.0);
            continue;
        }
        Pose pose = pose_at(frames, along, speed, settings.extend);
        if (settings.lag_rate > 0.0 && time > 0.0) {
            pose.rotation = Lag(frames, timing, places, offsets[i], settings).at(time, steps);
        }
        locations[i] = pose.location;
        rotations[i] = pose.rotation * settings.axes;
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
