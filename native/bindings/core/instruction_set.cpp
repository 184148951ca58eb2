// Which instruction set the library's inner loops run with.
#include <pybind11/pybind11.h>

#include "areas.hpp"
#include "motus/core/instruction_sets.hpp"

namespace motus::bindings {

void bind_instruction_set(pybind11::module_& m) {
    m.def("instruction_set", &instruction_set,
          "The widest instruction set that inner loops run with on this processor, such as AVX2 or NEON.");
}

}  // namespace motus::bindings
