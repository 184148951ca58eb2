#include "bogies.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motus/core/numeric.hpp"
#include "polish.hpp"

namespace motus::path {
namespace {

constexpr double finest = 1.0 / 256.0;  // of the wheelbase: the first step of the search
constexpr double growth = 1.02;         // of the steps: their number grows with the length's logarithm
constexpr double exact = 1e-13;         // of the wheelbase
constexpr double rounding = 1e-15;      // of the coordinates
constexpr int most_refinements = 80;

const glm::dvec3 forward(0.0, 1.0, 0.0), up(0.0, 0.0, 1.0);

/// The least rotation that takes one unit vector to another; half a turn about `axis` if they are opposite.
glm::dquat least_turn(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& axis) {
    const double cosine = glm::dot(from, to);
    constexpr double opposite = -1.0 + 1e-12;
    if (cosine < opposite) return {0.0, axis.x, axis.y, axis.z};
    const glm::dvec3 across = glm::cross(from, to);
    return glm::normalize(glm::dquat(1.0 + cosine, across.x, across.y, across.z));
}

/// The root of `excess`, which is <= 0 at `low` and > 0 at `high`, by the Illinois method: a secant, whose
/// end that stays counts half.
template <class Excess>
double refined(const Excess& excess, double low, double excess_low, double high, double excess_high,
               double tolerance) {
    double middle = low;
    bool was_low = false, was_high = false;
    for (int i = 0; i < most_refinements; ++i) {
        middle = low + excess_low / (excess_low - excess_high) * (high - low);
        const double found = excess(middle);
        if (std::abs(found) <= tolerance || middle == low || middle == high) break;
        const bool is_low = found <= 0.0;
        (is_low ? low : high) = middle;
        (is_low ? excess_low : excess_high) = found;
        if (is_low && was_low) excess_high *= 0.5;
        if (!is_low && was_high) excess_low *= 0.5;
        was_low = is_low;
        was_high = !is_low;
    }
    return middle;
}

}  // namespace

EndlessPath::EndlessPath(const Frames& frames, bool goes_round)
    : frames_(frames), is_closed_(goes_round && frames.path().curve().cyclic() && length() > 0.0) {}

glm::dvec3 EndlessPath::position(double s) const {
    return position_at_length(frames_.path(), s,
                              is_closed_ ? curve::Extend::loop : curve::Extend::extrapolate);
}

Pose EndlessPath::pose(double s, double speed) const {
    const curve::Extended on_path =
        extended(s, length(), is_closed_ ? curve::Extend::loop : curve::Extend::extrapolate);
    Pose pose = frames_.pose(on_path.value, speed);
    if (on_path.beyond != 0.0) pose.location += on_path.beyond * (pose.rotation * forward);
    return pose;
}

double arc_between(const EndlessPath& path, double middle, double wheelbase) {
    const auto excess = [&](double arc) {
        return length_of(path.position(middle + 0.5 * arc) - path.position(middle - 0.5 * arc)) - wheelbase;
    };
    // Beyond both ends of an open path the bogies are on two straight lines.
    constexpr double beyond = 8.0;
    const double most =
        path.is_closed()
            ? path.length()
            : 2.0 * std::max(std::abs(middle), std::abs(path.length() - middle)) + beyond * wheelbase;
    const double tolerance = exact * wheelbase + rounding * length_of(path.position(middle));
    double low = wheelbase;
    double excess_low = excess(low);
    if (excess_low >= -tolerance) return low;
    // The straight distance grows no faster than the arc: a step by what is missing passes no root.
    for (double step = finest * wheelbase; low < most; step *= growth) {
        const double high = low + std::max(step, -excess_low);
        const double excess_high = excess(high);
        if (std::abs(excess_high) <= tolerance) return high;
        if (excess_high > 0.0) return refined(excess, low, excess_low, high, excess_high, tolerance);
        low = high;
        excess_low = excess_high;
    }
    return wheelbase;
}

Pose on_bogies(const EndlessPath& path, double middle, double wheelbase, double speed) {
    const double arc = arc_between(path, middle, wheelbase);
    const Pose front = path.pose(middle + 0.5 * arc, speed);
    const Pose rear = path.pose(middle - 0.5 * arc, speed);
    const double sign = glm::dot(rear.rotation, front.rotation) < 0.0 ? -1.0 : 1.0;
    const glm::dquat between = glm::normalize(rear.rotation + sign * front.rotation);
    const glm::dvec3 line = front.location - rear.location;
    const double apart = length_of(line);
    Pose pose{rear.location + 0.5 * line, between};
    if (apart > 0.0) {
        const glm::dquat turn = least_turn(between * forward, line / apart, between * up);
        pose.rotation = polished(turn * between);
    }
    return pose;
}

}  // namespace motus::path
