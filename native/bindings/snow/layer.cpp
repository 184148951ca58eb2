// The mesh of snow that lies.
#include "motus/snow/layer.hpp"

#include <pybind11/pybind11.h>

#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/typed.hpp"
#include "marks.hpp"
#include "mesh/arrays.hpp"
#include "motus/snow/cover.hpp"
#include "rows.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using snow::SnowLayer;

[[nodiscard]] SnowLayer layer_of(const ArrayLike& positions, const ArrayLike& triangles, const ArrayLike& up,
                                 const std::shared_ptr<snow::Collider>& shelter,
                                 const OptionalNumber& repose) {
    const auto places = copied(Positions(positions, "layer_positions").values());
    const auto corners = copied(IndexRows<glm::ivec3>(triangles, "layer_triangles").values());
    const glm::dvec3 upwards = vector(up, "up");
    if (upwards == glm::dvec3(0.0)) value_error("up", "must not be 0");
    double hold = std::numeric_limits<double>::infinity();
    if (!repose.is_none()) {
        const double angle = number(repose, "repose");
        if (!(angle >= 0.0 && angle < 0.5 * std::numbers::pi))
            value_error("repose", "must be from 0 to less than pi / 2");
        hold = snow::steepest_slope(angle);
    }
    const py::gil_scoped_release released;
    return {places, corners, upwards, shelter.get(), hold};
}

[[nodiscard]] Typed<"dict[str, numpy.typing.NDArray[typing.Any]]"> mesh(const SnowLayer& self,
                                                                        const ArrayLike& given_depths,
                                                                        const Number& thinnest,
                                                                        const OptionalNumber& steepest,
                                                                        const OptionalArrayLike& given_left) {
    const std::vector<float> depths = float_row(given_depths, "depths");
    const std::vector<float> left = float_row(given_left, "left");
    const float least = float_number(thinnest, "thinnest");
    const float tangent =
        steepest.is_none() ? std::numeric_limits<float>::infinity() : float_number(steepest, "steepest");
    const SnowLayer::Mesh found = [&] {
        const py::gil_scoped_release released;
        return self.at(depths, least, tangent, left);
    }();
    return py::dict("position"_a = array_of(found.positions), "depth"_a = array_of(found.depths),
                    "triangle"_a = array_of(found.triangles), "edge"_a = array_of(found.edges),
                    "side"_a = array_of(found.sides));
}

}  // namespace

void bind_snow_layer(py::module_& m) {
    py::class_<SnowLayer>(m, "SnowLayer", py::module_local(), R"(
The mesh of snow that lies on triangles, as far off each vertex as the snow there is deep. Immutable.

layer_positions (v, 3); layer_triangles (t, 3): indices of vertices.  up (3,): away from what pulls snow down; the layer is
on that side.  shelter: None, or the SnowCollider of what snow cannot fall through: between a vertex with snow and a bare one
that is under something, or too steep by SnowCover's repose, the layer ends where the one or the other begins.
Raises ValueError or TypeError that names the argument.)")
        .def(py::init(&layer_of), "layer_positions"_a, "layer_triangles"_a,
             "up"_a = py::make_tuple(0.0, 0.0, 1.0), "shelter"_a = py::none(), "repose"_a = py::none())
        .def_property_readonly("vertex_count", &SnowLayer::vertex_count,
                               "How many vertices the triangles have.")
        .def("mesh", &mesh, "depths"_a, "thinnest"_a = 0.0, "steepest"_a = py::none(), "left"_a = py::none(),
             R"(
The layer, as a dict: float32 position (n, 3) and depth (n,); int32 triangle (m, 3), edge (e, 2), which are all sides of the
triangles, each once, and side (m, 3), the edges that leave each triangle's corners.

depths (v,), m, across the surface.  thinnest, >= 0, m: snow that is not deeper is left out: the layer is cut along the
line where it is that thin.  steepest, > 0: from vertex to vertex depths differ by no more than this fraction of the way between them; what
would be higher has fallen off.  left (v,), >= 0, None: 1: how much of that depth is left. At loose edges walls close the layer.
Raises ValueError or TypeError that names the argument.)");
    bind_snow_marks(m);
}

}  // namespace motus::bindings
