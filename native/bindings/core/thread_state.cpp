// The states that Python has of the threads that call it.
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

Otherwise a thread that Python has not started gets a new state for each call into Python, without cached memory: for a
short function this costs some 100 us a call. A second call does nothing. A thread that ends leaves its state behind, so
states of at most 64 threads are kept.
Returns whether the thread's state is kept.)");
}

}  // namespace motus::bindings
