// Binds FollowPlan, for bind_follow().
#pragma once
#include <pybind11/pybind11.h>

namespace motus::bindings {

void bind_follow_plan(pybind11::module_& m);

}  // namespace motus::bindings
