// What Python keeps of the threads that call it.
#include <pybind11/pybind11.h>

#include "areas.hpp"

namespace motus::bindings {

void bind_thread_state(pybind11::module_& m) {
    m.def(
        "keep_thread_state", [] { PyGILState_Ensure(); }, R"(
Keeps the calling thread's Python state, until the interpreter ends.

A thread that Python has not started gets a new one for each call into Python otherwise, with no memory at hand: for a short
function some 100 us a call. Once a thread is enough.)");
}

}  // namespace motus::bindings
