// Names and options that several functions on paths have in common.
#pragma once
#include <pybind11/pybind11.h>

#include "arguments.hpp"
#include "curve.hpp"
#include "motus/extend.hpp"
#include "motus/frames.hpp"

namespace motus::bindings {

[[nodiscard]] inline Extend extend_option(const py::object& extend) {
    return choice<Extend>(extend, "extend",
                          {{"clamp", Extend::clamp},
                           {"extrapolate", Extend::extrapolate},
                           {"loop", Extend::loop},
                           {"ping_pong", Extend::ping_pong}});
}

[[nodiscard]] inline const BoundCurve& curve_argument(const py::object& curve) {
    return instance<BoundCurve>(curve, "curve", "a Curve");
}

/// Settings of a mode by its name and its options; TypeError for an option that the mode does not read.
/// `speed` is left to the caller where `reads_speed`.
[[nodiscard]] FrameSettings frame_settings(const py::object& mode, const py::kwargs& options,
                                           bool reads_speed);

/// Frames of a curve, from the cache or built, without the interpreter's lock meanwhile.
[[nodiscard]] Frames frames_on(const BoundCurve& curve, FrameSettings settings);

}  // namespace motus::bindings
