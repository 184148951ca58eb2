// What Python keeps of the threads that call it.
#include <pybind11/pybind11.h>

#include "areas.hpp"

namespace motus::bindings {
namespace {

constexpr int most_kept = 64;
int kept = 0;  // of all threads; read and written with the interpreter's lock held
thread_local bool is_kept = false;

bool keep_thread_state() {
    if (!is_kept && kept < most_kept) {
        PyGILState_Ensure();  // without a release: one more user of the state than there are
        is_kept = true;
        ++kept;
    }
    return is_kept;
}

}  // namespace

void bind_thread_state(pybind11::module_& m) {
    m.def("keep_thread_state", &keep_thread_state, R"(
Keeps the calling thread's Python state, until the interpreter ends.

A thread that Python has not started gets a new one for each call into Python otherwise, with no memory at hand: for a short
function some 100 us a call. To call it again does nothing. A thread that ends leaves its state behind, so it is done for 64
threads at most.
Returns whether the thread's state is kept.)");
}

}  // namespace motus::bindings
