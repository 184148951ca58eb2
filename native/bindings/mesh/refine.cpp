// Meshes with shorter edges.
#include "motus/mesh/refine.hpp"

#include <pybind11/pybind11.h>

#include <cstddef>

#include "areas.hpp"
#include "arrays.hpp"
#include "core/arguments.hpp"
#include "core/typed.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

[[nodiscard]] Typed<
    "tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.int32], "
    "numpy.typing.NDArray[numpy.int32]]">
refined(const ArrayLike& given_positions, const ArrayLike& given_triangles, const Number& longest_edge,
        const WholeNumber& most_vertices) {
    const Positions positions(given_positions, "positions");
    const IndexRows<glm::ivec3> triangles(given_triangles, "triangles");
    const double longest = number(longest_edge, "longest_edge");
    const int most = whole_number(most_vertices, "most_vertices");
    if (most < 0) value_error("most_vertices", "must be at least 0");
    const auto places = copied(positions.values());
    const auto corners = copied(triangles.values());
    const mesh::Refined found = [&] {
        const py::gil_scoped_release released;
        return mesh::refine(places, corners, longest, static_cast<std::size_t>(most));
    }();
    return py::make_tuple(array_of(found.positions), array_of(found.triangles), array_of(found.ends));
}

}  // namespace

void bind_refine(py::module_& m) {
    m.def("refine", &refined, "positions"_a, "triangles"_a, "longest_edge"_a, "most_vertices"_a = 1 << 22, R"(
The mesh with all edges longer than longest_edge, > 0, halved again and again: (positions (v, 3) float32, triangles (t, 3)
int32, ends (m, 2) int32), on the same surface and without new gaps. The given vertices come first; each of the m that follow
halves the edge between two earlier ones, its ends.

Raises ValueError or TypeError that names the argument, also if there would be more than most_vertices.)");
}

}  // namespace motus::bindings
