// Orientation along curves.
#include "motus/path/frames.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "curve/curve.hpp"
#include "options.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr double frame_cost = 300.0;  // ns, rough
constexpr double default_speed = 1.0;

/// Takes one option; false if the mode does not read it.
bool set_option(path::FrameSettings& settings, std::string_view name, py::handle value) {
    const bool banking = settings.mode == path::FrameMode::banking;
    const bool curvature = settings.mode == path::FrameMode::curvature;
    if (banking && name == "strength") {
        settings.strength = number(value, name);
    } else if (banking && name == "gravity") {
        settings.gravity = number(value, name);
    } else if (banking && name == "limit") {
        settings.limit = number(value, name);
    } else if ((banking || curvature) && name == "smoothing") {
        settings.smoothing = number(value, name);
    } else if (curvature && name == "outward") {
        settings.outward = flag(value, name);
    } else if (settings.mode == path::FrameMode::tilt && name == "tilt") {
        const DoubleArray tilt = doubles(value, name);
        if (tilt.ndim() != 1) value_error(name, "must have the shape (k,), not " + shape_of(tilt));
        settings.tilt.assign(tilt.data(), tilt.data() + tilt.size());
    } else if (settings.mode == path::FrameMode::rail && name == "rail") {
        settings.rail = instance<BoundCurve>(value, name, "a Curve").path();
    } else if (settings.mode == path::FrameMode::rail && name == "rail_point") {
        settings.rail_point = choice<path::RailPoint>(
            value, name, {{"share", path::RailPoint::share}, {"nearest", path::RailPoint::nearest}});
    } else if (settings.mode == path::FrameMode::rail && name == "rail_side") {
        settings.rail_side = choice<path::RailSide>(value, name,
                                                    {{"above", path::RailSide::above},
                                                     {"right", path::RailSide::right},
                                                     {"left", path::RailSide::left}});
    } else {
        return false;
    }
    return true;
}

py::object frames_of(const Typed<"motus_native.Curve">& curve, const ArrayLike& lengths,
                     const FrameModeName& mode, const ExtendName& extend, const py::kwargs& options) {
    const BoundCurve& along = curve_argument(curve);
    const Numbers at(lengths, "lengths");
    const curve::Extend how = extend_option(extend);
    const path::FrameSettings settings = frame_settings(mode, options, true);
    const bool speed_given = settings.mode == path::FrameMode::banking && options.contains("speed");
    const Numbers speed(speed_given ? py::object(options["speed"]) : py::float_(default_speed), "speed");
    const std::span<const double> s = at.values();
    const std::span<const double> v = speed.values();
    if (!speed.is_single() && v.size() != s.size())
        value_error("speed", "must be a number or have one value per length");

    const path::Frames frames = frames_on(along, settings);
    py::array_t<double, py::array::c_style> rows({static_cast<py::ssize_t>(s.size()), py::ssize_t{4}});
    const std::span<glm::dquat> out = quaternions_in(rows.mutable_data(), s.size());
    {
        const ReleaseGil released(s.size(), frame_cost);
        const double length = frames.path().length();
        for (std::size_t i = 0; i < s.size(); ++i) {
            out[i] = frames.at(extended(s[i], length, how).value, v[speed.is_single() ? 0 : i]);
        }
        rows_from_quaternions(out);
    }
    if (at.is_single()) return rows.attr("reshape")(4);
    return rows;
}

}  // namespace

path::FrameSettings frame_settings(const FrameModeName& mode, const py::kwargs& options, bool reads_speed) {
    path::FrameSettings settings;
    settings.mode = choice<path::FrameMode>(mode, "mode",
                                            {{"world_up", path::FrameMode::world_up},
                                             {"minimal", path::FrameMode::minimal},
                                             {"banking", path::FrameMode::banking},
                                             {"curvature", path::FrameMode::curvature},
                                             {"tilt", path::FrameMode::tilt},
                                             {"rail", path::FrameMode::rail}});
    for (const auto& [key, value] : options) {
        const std::string name = py::str(key);
        if (reads_speed && settings.mode == path::FrameMode::banking && name == "speed") continue;
        if (!set_option(settings, name, value))
            type_error(name, "is no option of the mode '" + mode.cast<std::string>() + "'");
    }
    if (settings.mode == path::FrameMode::tilt && !options.contains("tilt"))
        type_error("tilt", "must be given for the mode 'tilt'");
    if (settings.mode == path::FrameMode::rail && !options.contains("rail"))
        type_error("rail", "must be given for the mode 'rail'");
    return settings;
}

path::Frames frames_on(const BoundCurve& curve, path::FrameSettings settings) {
    std::shared_ptr<const curve::ArcLength> path = curve.path();
    const py::gil_scoped_release released;
    return shared_frames(std::move(path), std::move(settings));
}

void bind_frames(py::module_& m) {
    m.def("frames", &frames_of, "curve"_a, "lengths"_a, "mode"_a, "extend"_a = "clamp", R"(
Orientations at distances along a curve: quaternions w, x, y, z that turn +Y to the tangent and +Z to up.

lengths: a number or (m,), unit of the curve.  extend: the meaning of a length outside [0, length]: 'clamp', 'extrapolate'
(both: the end's frame), 'loop', 'ping_pong'.
mode, and the options that only this mode reads:
'world_up'   the world's Z across the tangent; through places where the tangent nears the vertical (11.5 degrees) it
             goes on smoothly, without a flip.
'minimal'    rotation-minimising from world up at the start (double reflection: Wang et al. 2008); without a seam on
             cyclic curves.
'banking'    up along g z + k a, a = speed^2 * curvature towards the centre of the bend.  speed: a number or (m,), unit
             of length / s (1).  strength: k (1).  gravity: g > 0 (9.81).  limit: largest roll away from world up, rad,
             >= 0, pi and more: none (3.2).  smoothing: width along the curve of the zero-lag filter of the curvature,
             >= 0 (0).
'curvature'  up towards the centre of the bend, carried on through inflexions without a flip.  outward: bool (False).
             smoothing: as above.
'tilt'       'world_up' turned about the tangent by tilt: (k,) rad, one per point of the curve, linear in t between.
'rail'       up towards rail, a second Curve; goes on smoothly where the rail lies along the tangent.  rail_point: the point of
             the rail at the same 'share' of its length, or the 'nearest' one ('share').  rail_side: the rail lies 'above',
             'right' or 'left' ('above').
Returns (m, 4), or (4,) for a number. Continuous along the curve wherever its tangent is; the identity on a curve of zero
length.  Raises TypeError for an option that the mode does not read, ValueError for values outside these domains.)");
}

}  // namespace motus::bindings
