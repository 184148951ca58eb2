// Whether arrays hold nothing but ordinary numbers.
#include "motus/core/bounded.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <span>

#include "areas.hpp"
#include "core/arrays.hpp"

namespace motus::bindings {
namespace {

template <class Number>
[[nodiscard]] bool is_below(const py::array& array, double limit) {
    return motus::are_below(
        std::span(static_cast<const Number*>(array.data()), static_cast<std::size_t>(array.size())), limit);
}

bool are_below(double limit, const py::args& arrays) {
    bool holds = true;
    for (const py::handle one : arrays) {
        const bool is_single = py::isinstance<py::array_t<float, py::array::c_style>>(one);
        if (!is_single && !py::isinstance<DoubleArray>(one))
            type_error("arrays", "must be C-contiguous arrays of float32 or float64");
        const auto array = py::reinterpret_borrow<py::array>(one);
        if (!is_aligned(array)) type_error("arrays", "must be aligned");
        holds = (is_single ? is_below<float>(array, limit) : is_below<double>(array, limit)) && holds;
    }
    return holds;
}

}  // namespace

void bind_bounded(py::module_& m) {
    m.def("are_below", &are_below, py::arg("limit"), R"(
Whether each number of all arrays is smaller in size than the limit; NaN is not.

arrays: C-contiguous, of float32 or float64 and any shape.  Raises TypeError that names the argument.)");
}

}  // namespace motus::bindings
