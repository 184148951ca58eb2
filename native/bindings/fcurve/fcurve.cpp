// F-curves: Blender's keys and its Cycles modifier.
#include "fcurve/fcurve.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "areas.hpp"
#include "bones/rig_arrays.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using fcurve::FCurve;
using fcurve::Key;

constexpr double value_cost = 60.0;  // ns, rough
constexpr std::size_t key_size = 6, shape_size = 3, cycles_size = 10;

[[nodiscard]] int kind_in(int kind, int count, const char* name) {
    if (kind < 0 || kind >= count) value_error(name, "must be 0 to " + std::to_string(count - 1));
    return kind;
}

/// Finite numbers of an array (count, width); none where None is given.
[[nodiscard]] std::span<const float> rows_in(const py::object& given, const char* name, std::size_t count,
                                             std::size_t width) {
    const std::span<const float> rows = elements<float>(given, name, {count, width});
    if (!are_finite(rows)) value_error(name, "every value must be finite");
    return rows;
}

[[nodiscard]] std::vector<Key> read_keys(const Float32Array& given, const Int32Array& interpolations,
                                         const OptionalInt32Array& easings,
                                         const OptionalFloat32Array& shapes) {
    const py::array array = py::array::ensure(given);
    if (!array || array.ndim() != 2) value_error("keys", "must be an array of rows");
    const auto count = static_cast<std::size_t>(array.shape(0));
    const std::span<const float> rows = rows_in(given, "keys", count, key_size);
    const std::span<const int> kinds = elements<int>(interpolations, "interpolations", {count});
    std::span<const int> eased;
    if (!easings.is_none()) eased = elements<int>(easings, "easings", {count});
    std::span<const float> shaped;
    if (!shapes.is_none()) shaped = rows_in(shapes, "shapes", count, shape_size);
    std::vector<Key> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::span<const float> row = rows.subspan(i * key_size, key_size);
        Key& key = result[i];
        key.place = {row[0], row[1]};
        key.left = {row[2], row[3]};
        key.right = {row[4], row[5]};
        key.interpolation = static_cast<fcurve::Interpolation>(
            kind_in(kinds[i], fcurve::interpolation_count, "interpolations"));
        if (!eased.empty())
            key.easing = static_cast<fcurve::Easing>(kind_in(eased[i], fcurve::easing_count, "easings"));
        if (shaped.empty()) continue;
        key.overshoot = shaped[i * shape_size];
        key.amplitude = shaped[i * shape_size + 1];
        key.period = shaped[i * shape_size + 2];
    }
    return result;
}

[[nodiscard]] int count_in(double number) {
    constexpr double most = 1e9;
    if (!(number >= 0.0 && number <= most && number == static_cast<int>(number)))
        value_error("cycles", "how often must be whole numbers, 0 or more");
    return static_cast<int>(number);
}

[[nodiscard]] fcurve::Repeat repeat_in(double number) {
    for (int i = 0; i < fcurve::repeat_count; ++i)
        if (number == i) return static_cast<fcurve::Repeat>(i);
    value_error("cycles", "a mode must be 0 to 3");
}

/// start and end may be infinite.
[[nodiscard]] std::optional<fcurve::Cycles> read_cycles(const OptionalFloat64Array& given) {
    if (given.is_none()) return std::nullopt;
    const std::span<const double> row = elements<double>(given, "cycles", {cycles_size});
    fcurve::Cycles cycles;
    cycles.before = repeat_in(row[0]);
    cycles.after = repeat_in(row[1]);
    cycles.before_count = count_in(row[2]);
    cycles.after_count = count_in(row[3]);
    cycles.start = static_cast<float>(row[4]);
    cycles.end = static_cast<float>(row[5]);
    cycles.blend_in = static_cast<float>(row[6]);
    cycles.blend_out = static_cast<float>(row[7]);
    cycles.influence = static_cast<float>(row[8]);
    cycles.is_exact = row[9] != 0.0;
    return cycles;
}

[[nodiscard]] FCurve make_fcurve(const Float32Array& keys, const Int32Array& interpolations, bool goes_on,
                                 const OptionalInt32Array& easings, const OptionalFloat32Array& shapes,
                                 const OptionalFloat64Array& cycles) {
    return {read_keys(keys, interpolations, easings, shapes), goes_on, read_cycles(cycles)};
}

[[nodiscard]] DoubleArray values(const FCurve& curve, const ArrayLike& frames) {
    const DoubleArray at = doubles(frames, "frames");
    if (at.ndim() != 1) value_error("frames", "must have the shape (n,), not " + shape_of(at));
    const auto count = static_cast<std::size_t>(at.size());
    DoubleArray result = new_array({count});
    const std::span<double> out = values_of(result);
    {
        const ReleaseGil released(count, value_cost);
        curve.values({at.data(), count}, out);
    }
    return result;
}

[[nodiscard]] double value(const FCurve& curve, const Number& frame) {
    return static_cast<double>(curve.value(number(frame, "frame")));
}

}  // namespace

std::vector<FCurve> fcurves_in(const FCurves& given, const char* name) {
    std::vector<FCurve> result;
    if (!py::isinstance<py::list>(given)) wrong_type(given, name, "a list");
    for (const py::handle item : py::list(given)) result.push_back(instance<FCurve>(item, name, "an FCurve"));
    return result;
}

void bind_fcurve(py::module_& m) {
    py::class_<FCurve>(m, "FCurve", py::module_local(), R"(
An F-curve as Blender plays it: its keys, and a Cycles modifier. Immutable. Its values are in single precision, as Blender's are;
a LayerClip plays it in double precision if it is_plain.

keys: (K, 6) float32, K > 0, their frames rising: frame and value of the key, of its left handle, of its right one.
interpolations: (K,) int32, Blender's numbers: 0 constant, 1 linear, 2 Bezier, 3 back, 4 bounce, 5 circular, 6 cubic, 7 elastic,
8 exponential, 9 quadratic, 10 quartic, 11 quintic, 12 sinusoidal.  goes_on: beyond the keys as a straight line, else it holds.
easings: (K,) int32: 0 automatic, 1 in, 2 out, 3 in and out; None: all automatic.
shapes: (K, 3) float32: overshoot of back, amplitude and period of elastic; None: as of new keys.
cycles: (10,) float64, or None without the modifier: what it does before and after the keys, 0 nothing, 1 repeat, 2 repeat with
offset, 3 repeat mirrored; how often before and after, 0 for ever; first and last frame, which may be infinite; over how many
frames it blends in and out; influence; 0 if laps are counted in single precision, as versions of Blender before 4.2 do.
is_plain: whether it has neither easings that go by a name nor a Cycles modifier.
Raises ValueError or TypeError that names the argument.)")
        .def(py::init(&make_fcurve), "keys"_a, "interpolations"_a, "goes_on"_a, "easings"_a = py::none(),
             "shapes"_a = py::none(), "cycles"_a = py::none())
        .def_property_readonly("is_plain", &FCurve::is_plain)
        .def("value", &value, "frame"_a, R"(
Value at a frame; infinite or NaN where Blender's overflows.  Raises ValueError or TypeError that names the argument.)")
        .def("values", &values, "frames"_a, R"(
(n,): values at frames (n,), in any order.  Raises ValueError or TypeError that names the argument.)");
}

}  // namespace motus::bindings
