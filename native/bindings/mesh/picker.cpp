// Picking vertices and triangles of a mesh, and vertices that count as one.
#include "picker.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "areas.hpp"
#include "arrays.hpp"
#include "core/arguments.hpp"
#include "core/typed.hpp"
#include "motus/mesh/weld.hpp"
#include "reach_arrays.hpp"

namespace motus::bindings {
namespace {

/// A mesh::Reach as Python sees it, and a list of several.
using ReachPair = Typed<"tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.float32]]">;
using ReachPairs =
    Typed<"list[tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.float32]]]">;

using namespace pybind11::literals;

constexpr double build_cost = 100.0;  // ns a vertex or triangle, rough
constexpr double refit_cost = 10.0;   // ns a vertex, rough

/// Indices of a list of vertices, checked; the library's own type.
[[nodiscard]] std::vector<std::uint32_t> vertex_list(const py::object& object, const char* name,
                                                     std::size_t count) {
    const IntArray array = ints(object, name);
    if (array.ndim() != 1 && array.size() > 0)
        value_error(name, "must have the shape (n,), not " + shape_of(array));
    std::vector<std::uint32_t> result;
    result.reserve(static_cast<std::size_t>(array.size()));
    for (py::ssize_t i = 0; i < array.size(); ++i) {
        const int index = array.data()[i];
        if (index < 0 || static_cast<std::size_t>(index) >= count)
            value_error(name, "every index must be below " + std::to_string(count));
        result.push_back(static_cast<std::uint32_t>(index));
    }
    return result;
}

void check_indices(std::span<const glm::ivec2> edges, std::size_t count) {
    for (const glm::ivec2& edge : edges) {
        for (int end = 0; end < 2; ++end) {
            if (edge[end] < 0 || static_cast<std::size_t>(edge[end]) >= count)
                value_error("edges", "every index must be below " + std::to_string(count));
        }
    }
}

[[nodiscard]] std::unique_ptr<PickedMesh> make(const ArrayLike& positions, const OptionalArrayLike& triangles,
                                               const OptionalArrayLike& edges) {
    const Positions points(positions, "positions");
    const IndexRows<glm::ivec3> faces(triangles, "triangles");
    const IndexRows<glm::ivec2> lines(edges, "edges");
    const std::vector<glm::vec3> own_points = copied(points.values());
    const std::vector<glm::ivec3> own_faces = copied(faces.values());
    const std::vector<glm::ivec2> own_lines = copied(lines.values());
    check_indices(own_lines, own_points.size());
    const auto given = edges.is_none() ? std::nullopt : std::optional(std::span(own_lines));
    const ReleaseGil released(own_points.size() + own_faces.size(), build_cost);
    if (!are_finite(own_points)) throw std::invalid_argument("positions: every value must be finite");
    return std::make_unique<PickedMesh>(own_points, own_faces, given);
}

[[nodiscard]] py::object ray(const PickedMesh& mesh, const ArrayLike& origin, const ArrayLike& direction,
                             const OptionalArrayLike& positions, const OptionalNumber& slack) {
    const glm::dvec3 from = vector(origin, "origin"), along = vector(direction, "direction");
    std::optional<mesh::Hit> hit;
    if (positions.is_none()) {
        if (!slack.is_none()) value_error("slack", "must be given with positions only");
        hit = mesh.ray(from, along);
    } else {
        const Positions points(positions, "positions");
        hit = mesh.ray(from, along, points.values(), float_number(slack, "slack"));
    }
    if (!hit) return py::none();
    return py::make_tuple(hit->triangle, to_array(hit->point), hit->distance);
}

/// bool (v,), or None. The array that the span points into has to stay.
[[nodiscard]] std::span<const std::uint8_t> hidden_argument(const py::object& object, std::size_t count) {
    if (object.is_none()) return {};
    using BoolArray = py::array_t<bool, py::array::c_style>;
    if (!py::isinstance<BoolArray>(object)) type_error("hidden", "must be an array of booleans without gaps");
    const auto array = py::reinterpret_borrow<BoolArray>(object);
    if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != count)
        value_error("hidden", "must have the shape (" + std::to_string(count) + ",), not " + shape_of(array));
    return {reinterpret_cast<const std::uint8_t*>(array.data()), count};
}

[[nodiscard]] py::object pick(const PickedMesh& mesh, const ArrayLike& origin, const ArrayLike& direction,
                              const OptionalArrayLike& metric, const OptionalArrayLike& hidden,
                              const OptionalArrayLike& positions, const OptionalNumber& slack) {
    const glm::dvec3 from = vector(origin, "origin"), along = vector(direction, "direction");
    const glm::mat3 measure = metric_argument(metric, "metric");
    const std::span<const std::uint8_t> flags = hidden_argument(hidden, mesh.vertex_count());
    std::optional<Pick> found;
    if (positions.is_none()) {
        if (!slack.is_none()) value_error("slack", "must be given with positions only");
        found = mesh.pick(from, along, flags, measure, {}, {});
    } else {
        const Positions points(positions, "positions");
        found = mesh.pick(from, along, flags, measure, points.values(), float_number(slack, "slack"));
    }
    if (!found) return py::none();
    return py::make_tuple(found->hit.triangle, to_array(found->hit.point), found->vertex);
}

[[nodiscard]] py::object nearest(const PickedMesh& mesh, const ArrayLike& point) {
    const std::optional<std::uint32_t> vertex = mesh.nearest(float_vector(point, "point"));
    return vertex ? py::object(py::int_(*vertex)) : py::object(py::none());
}

[[nodiscard]] IntArray within(const PickedMesh& mesh, const ArrayLike& point, const Number& radius,
                              const OptionalArrayLike& metric) {
    const glm::vec3 centre = float_vector(point, "point");
    const float most = float_number(radius, "radius");
    if (most < 0.0f) value_error("radius", "must be >= 0");
    const glm::mat3 measure = metric_argument(metric, "metric");
    std::vector<std::uint32_t> vertices;
    {
        const ReleaseGil released(mesh.vertex_count(), 1.0);
        vertices = mesh.within(centre, most, measure);
    }
    return index_array(vertices);
}

[[nodiscard]] std::vector<mesh::Reach> measure(const PickedMesh& mesh, const IndexOrArrayLike& root,
                                               const Number& radius, const DistanceName& distance,
                                               const OptionalArrayLike& metric, const Text& mirror) {
    sculpt::Dab dab;
    const Distance way = distance_argument(distance);
    Root from = root_argument(root, mesh.vertex_count());
    if (from.vertex) from.point = mesh.position(*from.vertex);
    if (way != Distance::straight && !from.vertex)
        value_error("root", "must be the index of a vertex, unless the distance is 'straight'");
    dab.root = from.point;
    dab.radius = float_number(radius, "radius");
    if (dab.radius < 0.0f) value_error("radius", "must be >= 0");
    dab.metric = metric_argument(metric, "metric");
    dab.mirror = mirror_argument(mirror);
    const ReleaseGil released(mesh.vertex_count(), 1.0);
    return mesh.reaches(dab, from, way);
}

void refit(PickedMesh& mesh, const ArrayLike& positions, const OptionalArrayLike& moved) {
    const Positions points(positions, "positions");
    const std::size_t count = mesh.vertex_count();
    if (points.values().size() != count)
        value_error("positions", "must be of the " + std::to_string(count) + " vertices of the mesh");
    if (moved.is_none()) {
        const ReleaseGil released(count, refit_cost);
        if (!are_finite(points.values()))
            throw std::invalid_argument("positions: every value must be finite");
        mesh.refit(points.values());
        return;
    }
    const std::vector<std::uint32_t> vertices = vertex_list(moved, "moved", count);
    for (const std::uint32_t vertex : vertices) {
        if (!are_finite(points.values().subspan(vertex, 1)))
            value_error("positions", "every value must be finite");
    }
    const ReleaseGil released(vertices.size(), build_cost);
    mesh.refit(points.values(), vertices);
}

[[nodiscard]] IntArray welded(const ArrayLike& positions, const Number& distance,
                              const OptionalArrayLike& metric) {
    const Positions points(positions, "positions");
    const float most = float_number(distance, "distance");
    const glm::mat3 measure = metric_argument(metric, "metric");
    const std::vector<glm::vec3> own_points = copied(points.values());
    std::vector<std::uint32_t> leaders;
    {
        const ReleaseGil released(own_points.size(), build_cost);
        leaders = mesh::weld(own_points, most, measure);
    }
    return index_array(leaders);
}

}  // namespace

void bind_picker(py::module_& m) {
    m.def("weld", &welded, "positions"_a, "distance"_a, "metric"_a = py::none(), R"(
Leaders (v,) int32 of vertices that count as one, such as the corners of a scan's loose triangles.

In the order of their indices, vertices without a leader lead themselves, and all vertices without a leader with
|metric (p - q)| <= distance, where q is the leader's position. leaders[triangles] are the triangles of the welded mesh.
positions: (v, 3) float32.  distance: >= 0.  metric: as in Picker.within().
Raises ValueError or TypeError that names the argument.)");
    py::class_<PickedMesh>(m, "Picker", py::module_local(), R"(
A mesh to pick from: a tree over its triangles and vertices, and the neighbours of each vertex.

It keeps a copy of the positions: answers are for the shape of the last refit. Coincident or loose vertices, triangles
without area and edges of any number of triangles are allowed. Threads may use it at the same time.)")
        .def(py::init(&make), "positions"_a, "triangles"_a, "edges"_a = py::none(), R"(
positions: (v, 3) float32.  triangles: (t, 3) int32, or None.  edges: (e, 2) int32, the mesh's own, for distances counted
in edges: the diagonals of polygons are no edges. None: all sides of triangles are.
Other real numbers are converted, which takes time. Raises ValueError or TypeError that names the argument.)")
        .def_property_readonly("vertex_count", &PickedMesh::vertex_count, "int")
        .def_property_readonly("triangle_count", &PickedMesh::triangle_count, "int")
        .def("ray", &ray, "origin"_a, "direction"_a, "positions"_a = py::none(), "slack"_a = py::none(), R"(
The first hit of a ray: (triangle, point (3,), distance from the origin), or None. Triangles are hit from either side.
The direction may have any length; with length 0 there is no hit.

positions: (v, 3) float32, a different shape of the mesh, which the ray meets instead. slack, needed with positions: the
most that a vertex has moved since the last refit; triangles of a vertex that moved further may be missed. For a few rays
this takes far less time than a refit, if the slack is small compared with the mesh.)")
        .def("pick", &pick, "origin"_a, "direction"_a, "metric"_a = py::none(), "hidden"_a = py::none(),
             "positions"_a = py::none(), "slack"_a = py::none(), R"(
The first hit of a ray, and the vertex that it picks: (triangle, point (3,), vertex), or None.

The vertex is the one nearest to the point, by |metric (p - point)|, on the surface that was hit: of the triangle, and of
at most 256 triangles that are connected with it by edges and seen from the same side. If triangles are thin it may belong
to a neighbour, but never to the far side of a wall or to a different sheet.
metric: as in within().  hidden: (v,) bool, vertices that are left out; if all around are hidden, the triangle's nearest
corner is picked.  positions, slack: as in ray().)")
        .def("nearest", &nearest, "point"_a, R"(
Index of the vertex nearest to the point (3,), the lowest if several are as near; None if there is no vertex.)")
        .def("within", &within, "point"_a, "radius"_a, "metric"_a = py::none(), R"(
Indices (n,) int32, ascending, of the vertices with |metric (p - point)| <= radius.

metric: (3, 3) in rows, such as that of an object's world matrix; None: the identity.)")
        .def(
            "reach",
            [](const PickedMesh& mesh, const IndexOrArrayLike& root, const Number& radius,
               const DistanceName& distance, const OptionalArrayLike& metric) -> ReachPair {
                return to_pair(measure(mesh, root, radius, distance, metric, py::str("")).front());
            },
            "root"_a, "radius"_a, "distance"_a = "straight", "metric"_a = py::none(), R"(
The vertices within a radius of a root: (indices (n,) int32, ascending, distances (n,) float32).

root: index of a vertex; for 'straight' also a point (3,).  radius: >= 0; for 'edges' a number of edges.
distance: 'straight'; 'surface', along triangles and loose edges; 'edges', counted.  metric: as in within().
The result can be given to pull() as `reach`.)")
        .def(
            "reaches",
            [](const PickedMesh& mesh, const IndexOrArrayLike& root, const Number& radius,
               const DistanceName& distance, const OptionalArrayLike& metric,
               const Text& mirror) -> ReachPairs {
                py::list pairs;
                for (const mesh::Reach& reach : measure(mesh, root, radius, distance, metric, mirror))
                    pairs.append(to_pair(reach));
                return pairs;
            },
            "root"_a, "radius"_a, "distance"_a = "straight", "metric"_a = py::none(), "mirror"_a = "", R"(
The results of reach() for the root and each of its mirror images, as a list for pull()'s `reach` with `mirror`. The order
is: the root, mirrored in x, y, xy, z, xz, yz, xyz, of which those that do not apply are left out.

mirror: letters of 'xyz'. The image of a vertex is the vertex nearest to its mirrored position.)")
        .def("refit", &refit, "positions"_a, "moved"_a = py::none(), R"(
Adapts the tree to new positions (v, 3). moved: indices of the vertices that have moved since the last refit, which
takes less time than to look at all; None: any vertex may have moved.)");
}

}  // namespace motus::bindings
