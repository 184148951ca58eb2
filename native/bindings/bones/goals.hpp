// Binds RigGoals, for bind_rig_ik().
#pragma once
#include <pybind11/pybind11.h>

namespace motus::bindings {

void bind_goals(pybind11::module_& m);

}  // namespace motus::bindings
