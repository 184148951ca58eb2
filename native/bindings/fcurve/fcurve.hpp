// F-curves as bindings of several topics read them.
#pragma once
#include <vector>

#include "core/typed.hpp"
#include "motus/fcurve/fcurve.hpp"

namespace motus::bindings {

using FCurves = Typed<"list[FCurve]">;

/// A list of FCurve; TypeError that names the argument for anything else.
[[nodiscard]] std::vector<fcurve::FCurve> fcurves_in(const FCurves& given, const char* name);

}  // namespace motus::bindings
