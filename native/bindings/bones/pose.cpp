// Poses in the forms that Blender takes.
#include "motus/bones/pose.hpp"

#include <pybind11/pybind11.h>

#include <cstddef>
#include <optional>
#include <span>

#include "areas.hpp"
#include "bones/rig_arrays.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "motus/bones/products.hpp"
#include "motus/bones/turns.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr double euler_cost = 60.0;  // ns, rough
constexpr double matrix_cost = 20.0;

py::object euler_rows(const ArrayLike& rotations, const OptionalFloat64Array& out) {
    const Rotations in(rotations, "rotations");
    const std::span<const glm::dquat> quaternions = in.values();
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(quaternions.size()), 3};
    if (in.is_single()) shape.erase(shape.begin());
    DoubleArray rows = output<double>(out, "out", shape);
    const std::span<glm::dvec3> angles = points_of(rows);
    {
        const ReleaseGil released(quaternions.size(), euler_cost);
        for (std::size_t i = 0; i < quaternions.size(); ++i) angles[i] = bones::euler_xyz(quaternions[i]);
    }
    return rows;
}

py::object matrix_rows(const ArrayLike& locations, const ArrayLike& rotations,
                       const OptionalFloat32Array& out, const OptionalArrayLike& scales) {
    const Points points(locations, "locations");
    const Rotations quaternions(rotations, "rotations");
    const std::size_t count = points.values().size();
    if (quaternions.is_single() || quaternions.values().size() != count)
        value_error("rotations", "must have as many rows as locations");
    std::optional<Points> sizes;
    if (!scales.is_none()) {
        sizes.emplace(scales, "scales");
        if (sizes->values().size() != count) value_error("scales", "must have as many rows as locations");
    }
    const std::span<const glm::dvec3> scale_rows = sizes ? sizes->values() : std::span<const glm::dvec3>();
    auto matrices = output<float>(out, "out", {static_cast<py::ssize_t>(count), 16});
    const std::span<float> floats(matrices.mutable_data(), static_cast<std::size_t>(matrices.size()));
    require_apart(memory_of(locations), "locations", floats, "out");
    require_apart(memory_of(scales), "scales", floats, "out");
    {
        const ReleaseGil released(count, matrix_cost);
        bones::pack_matrices(points.values(), quaternions.values(), floats, scale_rows);
    }
    return matrices;
}

[[nodiscard]] py::array rows_of_matrices(const py::object& given, const char* name) {
    py::array array = py::array::ensure(given);
    if (!array || array.ndim() != 3) value_error(name, "must have the shape (n, k, m)");
    return array;
}

DoubleArray products(const Float64Array& left, const Float64Array& right) {
    const py::array first = rows_of_matrices(left, "left"), second = rows_of_matrices(right, "right");
    const auto lefts = static_cast<std::size_t>(first.shape(0)),
               rights = static_cast<std::size_t>(second.shape(0));
    const auto rows = static_cast<std::size_t>(second.shape(1)),
               columns = static_cast<std::size_t>(second.shape(2));
    if (lefts != rights && lefts != 1 && rights != 1) value_error("right", "another number of matrices");
    const std::span<const double> a = elements<double>(left, "left", {lefts, rows, rows});
    const std::span<const double> b = elements<double>(right, "right", {rights, rows, columns});
    DoubleArray result = new_array({lefts == 1 ? rights : lefts, rows, columns});
    bones::multiply(a, b, {rows, columns}, values_of(result));
    return result;
}

constexpr double link_cost = 20.0;  // ns, rough

[[nodiscard]] DoubleArray turns_of_links(const Float64Array& before, const Float64Array& after) {
    const py::array rows = rows_of_matrices(before, "before");
    const auto count = static_cast<std::size_t>(rows.shape(0)),
               links = static_cast<std::size_t>(rows.shape(1));
    const auto* from =
        reinterpret_cast<const glm::dvec3*>(elements<double>(before, "before", {count, links, 3}).data());
    const auto* to =
        reinterpret_cast<const glm::dvec3*>(elements<double>(after, "after", {count, links, 3}).data());
    DoubleArray result = new_array({count, links, 4});
    const std::span<glm::dquat> out = quaternions_in(result.mutable_data(), count * links);
    {
        const ReleaseGil released(count * links, link_cost);
        for (std::size_t first = 0; first < out.size(); first += links)
            bones::turn_links({from + first, links}, {to + first, links}, out.subspan(first, links));
        rows_from_quaternions(out);
    }
    return result;
}

}  // namespace

void bind_pose(py::module_& m) {
    m.def("euler_xyz", &euler_rows, "rotations"_a, "out"_a = py::none(), R"(
Euler angles of quaternions in Blender's order XYZ, as mathutils' Quaternion.to_euler('XYZ') gives them.

rotations: (m, 4) or (4,), w, x, y, z, of any length but 0.  out: a C-contiguous float64 array (m, 3) or (3,) to write
into.  Returns (m, 3) or (3,), rad.  Raises ValueError or TypeError that names the argument.)");
    m.def("pack_matrices", &matrix_rows, "locations"_a, "rotations"_a, "out"_a = py::none(),
          "scales"_a = py::none(),
          R"(
Locations, rotations and scales as 4 x 4 matrices, column by column, as Blender's FLOAT4X4 attributes take them.

locations: (m, 3).  rotations: (m, 4), w, x, y, z.  out: a C-contiguous float32 array (m, 16) to write into, which shares
no memory with locations and scales.  scales: (m, 3) along the rotated axes; None: 1.
Returns (m, 16) float32.  Raises ValueError or TypeError that names the argument.)");
    m.def("link_turns", &turns_of_links, "before"_a, "after"_a, R"(
Rotations (n, k, 4), w, x, y, z, by which the k links of n rows turn from directions to others: each link takes the next ones
along, and these turn by the smallest rotation from there. A link that has no length turns with the one above.

before, after: (n, k, 3) float64, of any length, aligned and C-contiguous. Their numbers may be infinite or NaN.
Raises ValueError or TypeError that names the argument.)");
    m.def("matrix_products", &products, "left"_a, "right"_a, R"(
Matrix products left @ right, (n, k, m). Their numbers may be infinite or NaN.

left: (n, k, k) or (1, k, k).  right: (n, k, m) or (1, k, m).  Both aligned and C-contiguous.
Raises ValueError or TypeError that names the argument.)");
}

}  // namespace motus::bindings
