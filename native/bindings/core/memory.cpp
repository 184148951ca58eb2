#include "motus/core/memory.hpp"

#include <pybind11/pybind11.h>

#include "areas.hpp"

namespace motus::bindings {

namespace py = pybind11;

void bind_memory(py::module_& m) {
    m.def("cache_budget", &cache_budget, R"(
Bytes that the tables which the module keeps for later questions may take together; 1 GiB at first.

These are arc length tables, frames along curves, motions of pendulums and landings of flakes. Results do not depend on
what is kept, only the time they take.)");
    m.def("set_cache_budget", &set_cache_budget, py::arg("bytes"), R"(
Changes cache_budget(). Tables that no longer have room are let go, those first that were used longest ago.

A budget of 0 keeps nothing. Raises TypeError if bytes is not a whole number >= 0.)");
    m.def("cached_bytes", &cached_bytes, "Bytes that all kept tables take now.");
    m.def("clear_caches", &clear_caches, "Lets all kept tables go.");
}

}  // namespace motus::bindings
