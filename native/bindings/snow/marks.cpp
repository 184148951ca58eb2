#include "marks.hpp"

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "core/arguments.hpp"
#include "core/typed.hpp"
#include "mesh/arrays.hpp"
#include "motus/snow/marks.hpp"
#include "movers.hpp"
#include "rows.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using snow::Marks;
using snow::SnowLayer;

[[nodiscard]] Marks marks_of(const Typed<"motus_native.SnowLayer">& given_layer,
                             const MoverList& given_movers, const ArrayLike& given_times,
                             const ArrayLike& given_heights, const Number& packed, const Number& step) {
    const SnowLayer& layer = instance<SnowLayer>(given_layer, "layer", "a SnowLayer");
    const std::vector<snow::Mover> movers = movers_of(given_movers);
    const DoubleArray at = row(given_times, "times");
    const std::vector<double> times(at.data(), at.data() + at.size());
    const FloatArray rows = floats(given_heights, "heights");
    if (rows.ndim() != 2) value_error("heights", "must have the shape (k, v), not " + shape_of(rows));
    const std::vector<float> heights(rows.data(), rows.data() + rows.size());
    const snow::MarksSettings settings{number(packed, "packed"), number(step, "step")};
    const py::gil_scoped_release released;
    return {layer, movers, times, heights, settings};
}

[[nodiscard]] Float32Array pressed(const Marks& self, const Number& given_time, const ArrayLike& given_depths,
                                   const OptionalArrayLike& given_shares) {
    const double time = number(given_time, "time");
    const std::vector<float> depths = float_row(given_depths, "depths");
    const std::vector<float> shares = float_row(given_shares, "shares");
    std::vector<float> found(self.vertex_count());
    {
        const py::gil_scoped_release released;
        self.press(time, depths, shares, found);
    }
    return array_of(found);
}

}  // namespace

void bind_snow_marks(py::module_& m) {
    py::class_<Marks>(m, "SnowMarks", py::module_local(), R"(
Marks that movers leave in lying snow: how much of it they have pressed or swept away, at any time. Immutable.

With the height H(t) that has fallen on a vertex, and the clearance c(s) beneath the movers, the depth there is
H(t) - max(0, max over s <= t of H(s) - c(s)).
layer: a SnowLayer.  movers: (SnowCollider in its own space, its triangles' normals outwards; times (k,), rising; matrices
(k, 4, 4) to world space, between which it goes evenly) each.  times (n,), rising: the stretch of time is from the first to
the last; marks of several stretches add up by their maximum.  heights (n, v), m, >= 0: of the snow on each vertex of the layer.
packed, m, >= 0: depth of the snow that stays under what presses.  step, m, > 0: a mover goes no farther from look to look, of
which there are 64 at most from one of its times to the next, and 10,000,000 in all.
Raises ValueError or TypeError that names the argument.)")
        .def(py::init(&marks_of), "layer"_a, "movers"_a, "times"_a, "heights"_a, py::kw_only(),
             "packed"_a = 0.0, "step"_a = 0.05)
        .def_property_readonly("vertex_count", &Marks::vertex_count, "How many vertices the layer has.")
        .def_property_readonly("marked_count", &Marks::marked_count,
                               "How many of them something has pressed on.")
        .def("pressed", &pressed, "time"_a, "depths"_a, "shares"_a = py::none(), R"(
(v,) float32: how much snow was pressed away on each vertex until `time`, m.

depths (v,): heights at that time.  shares (v,), [0, 1], None: 1: of the heights that lie there, at all times; what is pressed away is
as much of the whole height.
Raises ValueError or TypeError that names the argument.)");
}

}  // namespace motus::bindings
