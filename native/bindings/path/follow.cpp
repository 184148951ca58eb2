// Followers on curves.
#include "motus/path/follow.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "curve/curve.hpp"
#include "follow_plan.hpp"
#include "motus/core/numeric.hpp"
#include "options.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr double follower_cost = 300.0;  // ns, rough

[[nodiscard]] glm::dvec3 axis_option(const py::object& axis, const char* name) {
    return choice<glm::dvec3>(axis, name,
                              {{"X", {1, 0, 0}},
                               {"Y", {0, 1, 0}},
                               {"Z", {0, 0, 1}},
                               {"-X", {-1, 0, 0}},
                               {"-Y", {0, -1, 0}},
                               {"-Z", {0, 0, -1}}});
}

[[nodiscard]] path::LagBy lag_option(const Text& lag_by) {
    return choice<path::LagBy>(
        lag_by, "lag_by",
        {{"acceleration", path::LagBy::acceleration}, {"curvature", path::LagBy::curvature}});
}

Typed<"tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]"> follow_curve(
    const Typed<"motus_native.Curve">& curve, const Typed<"motus_native.Timing">& timing, const Number& time,
    const ArrayLike& offsets, const FrameModeName& mode, const ExtendName& extend, const AxisName& forward,
    const AxisName& up, const Flag& rotate, const Number& lag_rate, const Text& lag_by,
    const OptionalFloat64Array& locations, const OptionalFloat64Array& rotations, const Flag& line_up,
    const ArrayLike& delays, const ArrayLike& wheelbases, const Number& side, const Number& height,
    const Flag& level, const OptionalNumber& start, const py::kwargs& options) {
    const BoundCurve& path = curve_argument(curve);
    const path::Timing& motion = instance<path::Timing>(timing, "timing", "a Timing");
    const std::vector<path::Follower> followers = followers_of(offsets, delays, wheelbases);
    const double at = number(time, "time");
    path::FollowSettings settings =
        follow_settings(extend, forward, up, rotate, lag_rate, lag_by, line_up, side, height, start);
    const bool is_level = flag(level, "level");
    path::FrameSettings frame = frames_read(frame_settings(mode, options, false), settings, is_level);

    const std::size_t count = followers.size();
    const auto rows = static_cast<py::ssize_t>(count);
    auto location_rows = output<double>(locations, "locations", {rows, 3});
    auto rotation_rows = output<double>(rotations, "rotations", {rows, 4});
    require_apart(memory_of(offsets), "offsets", values_of(location_rows), "locations");
    require_apart(memory_of(offsets), "offsets", values_of(rotation_rows), "rotations");
    require_apart(values_of(location_rows), "locations", values_of(rotation_rows), "rotations");
    const std::span<glm::dvec3> location_out = points_of(location_rows);
    const std::span<glm::dquat> rotation_out = quaternions_in(rotation_rows.mutable_data(), count);
    const path::Frames frames = frames_on(path, std::move(frame));
    settings.aside = frames_aside(path, is_level);
    {
        const ReleaseGil released(count, settings.lag_rate > 0.0 ? 1e3 * follower_cost : follower_cost);
        follow(frames, motion, at, followers, settings, location_out, rotation_out);
        rows_from_quaternions(rotation_out);
    }
    return py::make_tuple(location_rows, rotation_rows);
}

}  // namespace

path::FollowSettings follow_settings(const ExtendName& extend, const AxisName& forward, const AxisName& up,
                                     const Flag& rotate, const Number& lag_rate, const Text& lag_by,
                                     const Flag& line_up, const Number& side, const Number& height,
                                     const OptionalNumber& start) {
    path::FollowSettings settings;
    settings.extend = extend_option(extend);
    settings.axes = path::follower_axes(axis_option(forward, "forward"), axis_option(up, "up"));
    settings.rotate = flag(rotate, "rotate");
    settings.line_up = flag(line_up, "line_up");
    settings.lag_rate = number(lag_rate, "lag_rate");
    settings.lag_by = lag_option(lag_by);
    settings.side = number(side, "side");
    settings.height = number(height, "height");
    if (!start.is_none()) settings.start = number(start, "start");
    return settings;
}

std::vector<path::Follower> followers_of(const ArrayLike& offsets, const ArrayLike& delays,
                                         const ArrayLike& wheelbases) {
    const Numbers along(offsets, "offsets");
    const Numbers late(delays, "delays");
    const Numbers bases(wheelbases, "wheelbases");
    const std::size_t count = along.values().size();
    if (!late.is_single() && late.values().size() != count)
        value_error("delays", "must be a number or have one value per offset");
    if (!bases.is_single() && bases.values().size() != count)
        value_error("wheelbases", "must be a number or have one value per offset");
    if (!are_finite(along.values())) value_error("offsets", "must be finite");
    if (!are_finite(late.values())) value_error("delays", "must be finite");
    if (!are_finite(bases.values()) || std::ranges::any_of(bases.values(), [](double x) { return x < 0.0; }))
        value_error("wheelbases", "must be finite and 0 or more");
    std::vector<path::Follower> found(count);
    for (std::size_t i = 0; i < count; ++i) {
        found[i] = {along.values()[i], late.values()[late.is_single() ? 0 : i],
                    bases.values()[bases.is_single() ? 0 : i]};
    }
    return found;
}

path::FrameSettings frames_read(path::FrameSettings settings, const path::FollowSettings& by, bool level) {
    const bool is_aside = (by.side != 0.0 || by.height != 0.0) && !level;
    return by.rotate || is_aside ? std::move(settings) : path::FrameSettings{};
}

std::optional<path::Frames> frames_aside(const BoundCurve& curve, bool level) {
    if (!level) return std::nullopt;
    path::FrameSettings settings;
    settings.mode = path::FrameMode::world_up;
    return frames_on(curve, std::move(settings));
}

void bind_follow(py::module_& m) {
    m.attr("LAG_MEMORY") = path::lag_memory;  // s
    m.def("follow", &follow_curve, "curve"_a, "timing"_a, "time"_a, "offsets"_a, "mode"_a,
          "extend"_a = "clamp", "forward"_a = "Y", "up"_a = "Z", "rotate"_a = true, "lag_rate"_a = 0.0,
          "lag_by"_a = "acceleration", "locations"_a = py::none(), "rotations"_a = py::none(),
          "line_up"_a = false, "delays"_a = 0.0, "wheelbases"_a = 0.0, "side"_a = 0.0, "height"_a = 0.0,
          "level"_a = false, "start"_a = py::none(), R"(
Poses of followers on a curve at one time. A function of its arguments alone: times may come in any order.

timing: a Timing.  time: s.  offsets: a number or (n,), how far each follower is ahead (+) or behind (-) along the curve.
mode and its options: as in frames(), without speed, which the timing gives.
extend: the path beyond its ends: 'clamp'; 'extrapolate' straight on along the tangent with the end's frame; 'loop';
'ping_pong'.  forward, up: the follower's own axes that go along the curve and up: 'X', '-X', 'Y', '-Y', 'Z', '-Z', across
each other.  rotate: False leaves every rotation the identity.
lag_rate: > 0 lets the orientation trail its target at lag_rate times the bend of the curve per second, from time 0 on
and with LAG_MEMORY = 120 s of memory, in at most 2300 steps: 1/120 s each for the last 10 s, and up to 1/300 of their age before. The
error is 1e-4 rad; 0.01 rad after a jump of the target, 0.3 rad if the target ran more than half a turn ahead.  lag_by: the bend is |C''(t)| ('acceleration') or the curvature ('curvature').
line_up: the first follower stops at the ends, and the others keep their distance from it; with extend='extrapolate' they
stand in line before the start.
delays: a number or (n,), s: each follower is where one without delay was so long ago.
wheelbases: a number or (n,), >= 0: above 0 two bogies whose straight distance this is carry the follower, equal arcs before
and behind its place. It lies midway between them, its forward axis along the line through them.
side, height: metres to the right of the path and above it, along the frames of the mode, or those of 'world_up' if level is
True; distance and speed are still the path's.
start: s; before it the timing rests as at it.
locations, rotations: C-contiguous float64 arrays (n, 3) and (n, 4) to write into, which share no memory with each other
or offsets; new ones if None.
Returns (locations, rotations): (n, 3) and (n, 4) quaternions w, x, y, z.
Raises ValueError or TypeError that names the argument.)");
    bind_follow_plan(m);
}

}  // namespace motus::bindings
