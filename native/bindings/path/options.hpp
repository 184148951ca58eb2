// Names and options that several functions on paths have in common.
#pragma once
#include <pybind11/pybind11.h>

#include <optional>
#include <vector>

#include "core/arguments.hpp"
#include "core/typed.hpp"
#include "curve/curve.hpp"
#include "motus/curve/extend.hpp"
#include "motus/path/follow.hpp"
#include "motus/path/frames.hpp"

namespace motus::bindings {

[[nodiscard]] inline curve::Extend extend_option(const ExtendName& extend) {
    return choice<curve::Extend>(extend, "extend",
                                 {{"clamp", curve::Extend::clamp},
                                  {"extrapolate", curve::Extend::extrapolate},
                                  {"loop", curve::Extend::loop},
                                  {"ping_pong", curve::Extend::ping_pong}});
}

[[nodiscard]] inline const BoundCurve& curve_argument(const py::object& curve) {
    return instance<BoundCurve>(curve, "curve", "a Curve");
}

/// Settings of a mode by its name and its options; TypeError for an option that the mode does not read.
/// `speed` is left to the caller if `reads_speed`.
[[nodiscard]] path::FrameSettings frame_settings(const FrameModeName& mode, const py::kwargs& options,
                                                 bool reads_speed);

/// Settings of followers by their names.
[[nodiscard]] path::FollowSettings follow_settings(const ExtendName& extend, const AxisName& forward,
                                                   const AxisName& up, const Flag& rotate,
                                                   const Number& lag_rate, const Text& lag_by,
                                                   const Flag& line_up, const Number& side,
                                                   const Number& height, const OptionalNumber& start);

/// Followers by their numbers, each a single one for all or one for each offset.
[[nodiscard]] std::vector<path::Follower> followers_of(const ArrayLike& offsets, const ArrayLike& delays,
                                                       const ArrayLike& wheelbases);

/// Frames of the mode, or the cheapest ones if followers read none of them.
[[nodiscard]] path::FrameSettings frames_read(path::FrameSettings settings, const path::FollowSettings& by,
                                              bool level);

/// Frames along which followers that are `level` stand aside.
[[nodiscard]] std::optional<path::Frames> frames_aside(const BoundCurve& curve, bool level);

/// Frames of a curve, from the cache or built, without the interpreter's lock meanwhile.
[[nodiscard]] path::Frames frames_on(const BoundCurve& curve, path::FrameSettings settings);

}  // namespace motus::bindings
