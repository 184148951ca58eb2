// Lattices: deformation, pulls at deformed points, and boxes that lattices are fitted to.
#include "motus/lattice/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "mesh/arrays.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr double blend_cost = 200.0;  // ns a position, rough
constexpr double pull_cost = 50.0;    // ns a lattice point and part, rough
constexpr double box_cost = 200.0;    // ns a point, rough

// --- Arguments -------------------------------------------------------------------------------------------

/// (m, 3), finite; a copy.
[[nodiscard]] std::vector<glm::vec3> finite_rows(const Positions& given, const char* name) {
    std::vector<glm::vec3> rows = copied(given.values());
    if (!are_finite(rows)) value_error(name, "every value must be finite");
    return rows;
}

/// (count,) numbers, copied, or none if the object is None.
class OneEach {
  public:
    OneEach(const py::object& object, const char* name, std::size_t count) {
        if (object.is_none()) return;
        const FloatArray array = floats(object, name);
        if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != count)
            value_error(name, "must have the shape (" + std::to_string(count) + ",), not " + shape_of(array));
        values_.assign(array.data(), array.data() + count);
        if (!std::all_of(values_.begin(), values_.end(), [](float value) { return std::isfinite(value); }))
            value_error(name, "every value must be finite");
    }
    [[nodiscard]] std::span<const float> values() const noexcept { return values_; }

  private:
    std::vector<float> values_;
};

/// Rows of a (3, 3) array as the columns of a matrix.
[[nodiscard]] glm::dmat3 three_vectors(const py::object& object, const char* name) {
    const DoubleArray array = doubles(object, name);
    if (array.ndim() != 2 || array.shape(0) != 3 || array.shape(1) != 3)
        value_error(name, "must have the shape (3, 3), not " + shape_of(array));
    glm::dmat3 result;
    for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 3; ++i) result[row][i] = array.at(row, i);
    }
    return result;
}

[[nodiscard]] lattice::Basis basis_of(py::handle object) {
    return choice<lattice::Basis>(object, "basis",
                                  {{"bernstein", lattice::Basis::bernstein},
                                   {"linear", lattice::Basis::linear},
                                   {"cardinal", lattice::Basis::cardinal},
                                   {"catmull_rom", lattice::Basis::catmull_rom},
                                   {"bspline", lattice::Basis::bspline}});
}

/// Three of something in a tuple or list.
[[nodiscard]] py::tuple three(const py::object& object, const char* name, const char* wanted) {
    if (PySequence_Check(object.ptr()) == 0 || py::isinstance<py::str>(object))
        wrong_type(object, name, wanted);
    py::tuple result(object);
    if (result.size() != 3) value_error(name, "must be " + std::string(wanted));
    return result;
}

[[nodiscard]] lattice::Lattice make_lattice(const ArrayLike& origin, const ArrayLike& axes,
                                            const WholeNumbers& resolution,
                                            const Typed<"str | typing.Sequence[str]">& basis) {
    lattice::Lattice lattice;
    lattice.origin = vector(origin, "origin");
    lattice.axes = three_vectors(axes, "axes");
    const py::tuple counts = three(resolution, "resolution", "three whole numbers");
    for (std::size_t i = 0; i < 3; ++i) {
        lattice.resolution[i] = whole_number(counts[i], "resolution");
        if (lattice.resolution[i] < 1 || lattice.resolution[i] > lattice::max_resolution)
            value_error("resolution", "must be from 1 to " + std::to_string(lattice::max_resolution));
    }
    if (py::isinstance<py::str>(basis)) {
        lattice.basis.fill(basis_of(basis));
    } else {
        const py::tuple names = three(basis, "basis", "a name or three");
        for (std::size_t i = 0; i < 3; ++i) lattice.basis[i] = basis_of(names[i]);
    }
    try {
        (void)lattice::weights_at(lattice, lattice.origin);
    } catch (const std::invalid_argument&) {
        value_error("axes", "must be independent of each other");
    }
    return lattice;
}

// --- Lattice ---------------------------------------------------------------------------------------------

[[nodiscard]] DoubleArray weights_at(const lattice::Lattice& lattice, const ArrayLike& places) {
    const Points points(places, "places");
    const std::size_t count = point_count(lattice);
    DoubleArray result = new_array({points.values().size(), count});
    double* row = result.mutable_data();
    for (const glm::dvec3& place : points.values()) {
        std::fill(row, row + count, 0.0);
        const lattice::Weights weights = lattice::weights_at(lattice, place);
        for (std::size_t i = 0; i < weights.points.size(); ++i) row[weights.points[i]] = weights.weights[i];
        row += count;
    }
    return result;
}

[[nodiscard]] FloatArray deformed(const lattice::Lattice& lattice, const ArrayLike& positions,
                                  const ArrayLike& displacements, const OptionalArrayLike& influence,
                                  const OptionalArrayLike& point_weights, const OptionalFloat32Array& out) {
    const Positions position_rows(positions, "positions"), move_rows(displacements, "displacements");
    const std::vector<glm::vec3> from = finite_rows(position_rows, "positions");
    const std::vector<glm::vec3> moves = finite_rows(move_rows, "displacements");
    const std::size_t count = point_count(lattice);
    if (moves.size() != count)
        value_error("displacements", "must have " + std::to_string(count) + " rows, one for each point");
    const OneEach factors(influence, "influence", from.size());
    const OneEach weights(point_weights, "point_weights", count);
    FloatArray result = output<float>(out, "out", {static_cast<py::ssize_t>(from.size()), 3});
    const std::span<glm::vec3> to{reinterpret_cast<glm::vec3*>(result.mutable_data()), from.size()};
    const std::span<const glm::vec3> given = position_rows.values();
    if (to.data() != given.data()) require_apart(given, "positions", to, "out");
    require_apart(move_rows.values(), "displacements", to, "out");
    {
        const ReleaseGil released(from.size(), blend_cost);
        deform(lattice, moves, {factors.values(), weights.values()}, from, to);
    }
    return result;
}

[[nodiscard]] Typed<"tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]"> pulled(
    const lattice::Lattice& lattice, const ArrayLike& places, const ArrayLike& displacements,
    const OptionalArrayLike& pulls, const OptionalArrayLike& shares, const OptionalArrayLike& influence,
    const OptionalArrayLike& point_weights, const Flag& outside_only, const Number& max_gain) {
    const Points place_rows(places, "places"), wanted_rows(displacements, "displacements");
    const std::span<const glm::dvec3> at = place_rows.values(), wanted = wanted_rows.values();
    const OneEach part_shares(shares, "shares", at.size()), influences(influence, "influence", at.size());
    const OneEach numbers(pulls, "pulls", at.size());
    if (pulls.is_none() && wanted.size() != at.size())
        value_error("displacements", "must have as many rows as places, or pulls say whose they are");
    const std::size_t count = point_count(lattice);
    const OneEach weights(point_weights, "point_weights", count);
    std::vector<lattice::Part> parts(at.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].pull = i;
        if (!numbers.values().empty()) {
            const float number = numbers.values()[i];
            if (number < 0.0f || number != std::floor(number) || number >= static_cast<float>(wanted.size()))
                value_error("pulls", "must be indices of displacements");
            parts[i].pull = static_cast<std::size_t>(number);
        }
        parts[i].place = at[i];
        if (!part_shares.values().empty()) parts[i].share = static_cast<double>(part_shares.values()[i]);
        if (!influences.values().empty()) parts[i].influence = static_cast<double>(influences.values()[i]);
    }
    lattice::PullOptions options;
    options.max_gain = number(max_gain, "max_gain");
    if (options.max_gain <= 0.0) value_error("max_gain", "must be > 0");
    options.outside_only = flag(outside_only, "outside_only");
    options.point_weights = weights.values();
    DoubleArray moves = new_array({count, 3});
    const std::span<glm::dvec3> to = points_of(moves);
    std::vector<glm::dvec3> left;
    {
        const ReleaseGil released(count * parts.size(), pull_cost);
        left = lattice::pull_lattice(lattice, parts, wanted, options, to);
    }
    return py::make_tuple(moves, to_array(left));
}

// --- Boxes -----------------------------------------------------------------------------------------------

[[nodiscard]] Typed<
    "tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], "
    "numpy.typing.NDArray[numpy.float64]]">
box(const ArrayLike& points, const OptionalArrayLike& axes, const Flag& turn) {
    const std::vector<glm::vec3> around = finite_rows(Positions(points, "points"), "points");
    glm::dmat3 frame(1.0);
    if (!axes.is_none()) {
        frame = three_vectors(axes, "axes");
        constexpr double rounding = 1e-5;
        for (int i = 0; i < 3; ++i) {
            const double length = glm::length(frame[i]);
            const double across = glm::dot(frame[i], frame[(i + 1) % 3]);
            if (!(std::abs(length - 1.0) < rounding) || !(std::abs(across) < rounding))
                value_error("axes", "must be at right angles and of length 1");
        }
    }
    const bool turns = flag(turn, "turn");
    lattice::OrientedBox found;
    {
        const ReleaseGil released(around.size(), box_cost);
        found = turns ? lattice::small_box(around, frame) : lattice::box_along(around, frame);
    }
    DoubleArray found_axes = new_array({3, 3});
    for (int i = 0; i < 3; ++i) points_of(found_axes)[static_cast<std::size_t>(i)] = found.axes[i];
    return py::make_tuple(to_array(found.center), found_axes, to_array(found.size));
}

}  // namespace

void bind_lattice(py::module_& m) {
    py::class_<lattice::Lattice> lattice(m, "Lattice", py::module_local(), R"(
A grid of points that deforms positions within it (free-form deformation).

origin: (3,), the first point at rest.  axes: (3, 3), rows: from the first to the last point along u, v and w; independent.
resolution: points along u, v and w, 1 to 64.  basis: one name, or one each: 'bernstein' (Sederberg and Parry's, of the
degree resolution - 1), or Blender's 'linear', 'cardinal', 'catmull_rom', 'bspline'.
Points are counted with u fastest, then v, then w. Any space, any unit of length.
Raises ValueError or TypeError that names the argument, as its methods do.)");
    lattice.attr("MAX_PULLS") = lattice::max_pulls;
    lattice.def(py::init(&make_lattice), "origin"_a, "axes"_a, "resolution"_a, "basis"_a = "bspline");
    lattice.def_property_readonly("resolution", [](const lattice::Lattice& self) {
        return py::make_tuple(self.resolution[0], self.resolution[1], self.resolution[2]);
    });
    lattice.def_property_readonly("point_count",
                                  [](const lattice::Lattice& self) { return point_count(self); });
    lattice.def(
        "rest_points", [](const lattice::Lattice& self) { return to_array(rest_points(self)); },
        "Positions of the points at rest: (n, 3).");
    lattice.def("weights", &weights_at, "places"_a, R"(
How much each point moves places: (m, n), rows add up to 1.  places: (m, 3), before they are deformed.)");
    lattice.def("deform", &deformed, "positions"_a, "displacements"_a, "influence"_a = py::none(),
                "point_weights"_a = py::none(), "out"_a = py::none(), R"(
Positions deformed by displacements of the points.

positions: (m, 3).  displacements: (n, 3), from rest.  influence: (m,) factors of the change, strength times the weight of a
vertex group in Blender.  point_weights: (n,), Blender's vertex group of the lattice: fades the change once more by
influence times their blend.  out: a float32 array (m, 3) to write into, positions itself included.
Returns float32 (m, 3).)");
    lattice.def("pull", &pulled, "places"_a, "displacements"_a, "pulls"_a = py::none(),
                "shares"_a = py::none(), "influence"_a = py::none(), "point_weights"_a = py::none(),
                "outside_only"_a = false, "max_gain"_a = lattice::PullOptions{}.max_gain, R"(
The smallest displacements of the points that move places as wanted, or as nearly as possible (least squares).

places: (k, 3), before they are deformed.  displacements: (p, 3), wanted; 0 holds a place.  pulls: (k,) index of the
displacement that each place takes part in; None: one each.  shares: (k,) with pulls, such as the barycentric coordinates
of a point of a triangle; None: 1.  influence: (k,), point_weights: (n,), as of deform().
outside_only: points inside follow those of the outside, as with Blender's Outside.
MAX_PULLS displacements at most, if they move more points than that: the work grows with the cube of the smaller number.
max_gain: > 0; bounds the points' movement to this many times what the pulls would need at full influence by themselves.
Returns ((n, 3), (p, 3)): displacements to be added to those of the points, and the rest of the wanted displacements that is not reached.)");

    m.def("box_around", &box, "points"_a, "axes"_a = py::none(), "turn"_a = false, R"(
A box around points.

points: (m, 3).  axes: (3, 3), rows are its axes, at right angles and of length 1; None: x, y, z.  turn: look for a smaller
box of a different orientation, its axes ordered and signed to be near the given ones.
Returns (center (3,), axes (3, 3) in rows, size (3,)); all 0 but the axes if there are no points.
Raises ValueError or TypeError that names the argument.)");
}

}  // namespace motus::bindings
