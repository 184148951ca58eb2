// Adds marks in lying snow to the module.
#pragma once
#include <pybind11/pybind11.h>

namespace motus::bindings {

void bind_snow_marks(pybind11::module_& m);

}  // namespace motus::bindings
