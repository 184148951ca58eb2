// Poses that a solver computes at each frame.
#include "bones/pose_buffer.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/rotations.hpp"
#include "motus/bones/pose.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr std::size_t numbers_of_a_pose = 10;
constexpr std::size_t slots_of_a_pose = 6;
constexpr double ordinary = 1e30;
constexpr int largest_count = std::numeric_limits<int>::max() / 16;

[[nodiscard]] std::size_t count_of(const WholeNumber& given) {
    const int count = whole_number(given, "count");
    if (count < 0 || count > largest_count)
        value_error("count", "must be 0 to " + std::to_string(largest_count));
    return static_cast<std::size_t>(count);
}

/// An array that is written through later, of any shape.
[[nodiscard]] DoubleArray numbers_in(const Float64Array& given, const char* name) {
    if (!py::isinstance<DoubleArray>(given) || !is_aligned(py::reinterpret_borrow<py::array>(given)))
        type_error(name, "must be an aligned, C-contiguous array of float64");
    DoubleArray array = py::reinterpret_borrow<DoubleArray>(given);
    if (!array.writeable()) type_error(name, "must be writeable");
    return array;
}

[[nodiscard]] double sum_of_squares(std::span<const double> numbers) {
    double sum = 0.0;
    for (const double number : numbers) sum += number * number;
    return sum;
}

/// The rows of a PoseBuffer as an array, which keeps the buffer alive.
template <std::size_t columns>
[[nodiscard]] py::array rows_of(const py::object& self, std::span<double> numbers) {
    const auto rows = static_cast<py::ssize_t>(numbers.size() / columns);
    return py::array_t<double>({rows, static_cast<py::ssize_t>(columns)}, numbers.data(), self);
}

}  // namespace

PoseBuffer::PoseBuffer(const WholeNumber& count, const Float64Array& outputs)
    : count_(count_of(count)),
      block_(numbers_of_a_pose * count_),
      outputs_(numbers_in(outputs, "outputs")),
      matrices_(static_cast<py::ssize_t>(16 * count_)) {
    reset();
}

std::span<glm::dvec3> PoseBuffer::locations() {
    return {reinterpret_cast<glm::dvec3*>(block_.data()), count_};
}

std::span<glm::dquat> PoseBuffer::rotations() {
    return quaternions_in(rotation_numbers().data(), count_);
}

void PoseBuffer::reset() {
    const std::span<double> turns = rotation_numbers();
    std::ranges::fill(location_numbers(), 0.0);
    std::ranges::fill(turns, 0.0);
    for (std::size_t i = 0; i < turns.size(); i += 4) turns[i] = 1.0;
    std::ranges::fill(scale_numbers(), 1.0);
}

bool PoseBuffer::is_ordinary() const {
    const std::span<const double> told(outputs_.data(), static_cast<std::size_t>(outputs_.size()));
    return sum_of_squares(block_) < ordinary && sum_of_squares(told) < ordinary;
}

bool PoseBuffer::are_new() {
    if (last_.size() == block_.size() &&
        (block_.empty() || std::memcmp(last_.data(), block_.data(), sizeof(double) * block_.size()) == 0))
        return false;
    last_ = block_;
    return true;
}

py::object PoseBuffer::matrices(bool has_scales) {
    if (!are_new()) return py::none();
    float* out = matrices_.mutable_data();
    const double* row = rotation_numbers().data();
    const auto* scale = reinterpret_cast<const glm::dvec3*>(scale_numbers().data());
    for (const glm::dvec3& location : locations()) {
        const glm::dquat rotation = unit_quaternion(row, "rotations");
        bones::pack_matrices({&location, 1}, {&rotation, 1}, {out, 16}, {scale, has_scales ? 1U : 0U});
        out += 16;
        row += 4;
        ++scale;
    }
    return matrices_;
}

bool PoseBuffer::write_slots(const Float64Array& slots, bool has_scales) {
    const std::size_t wanted = (slots_of_a_pose + (has_scales ? 3 : 0)) * count_;
    DoubleArray array = numbers_in(slots, "slots");
    if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != wanted)
        value_error("slots", "must have the shape (" + std::to_string(wanted) + ",), not " + shape_of(array));
    if (!are_new()) return false;
    double* slot = array.mutable_data();
    const double* row = rotation_numbers().data();
    for (const glm::dvec3& location : locations()) {
        const glm::dvec3 angles = bones::euler_xyz(unit_quaternion(row, "rotations"));
        for (const double number : {location.x, location.y, location.z, angles.x, angles.y, angles.z})
            *slot++ = number;
        row += 4;
    }
    if (has_scales) std::ranges::copy(scale_numbers(), slot);
    return true;
}

void bind_pose_buffer(py::module_& m) {
    py::class_<PoseBuffer>(m, "PoseBuffer", py::module_local(), R"(
Memory for the poses of `count` members that a solver computes at each frame, and for the numbers that it tells beside them.

Not for two threads at once.)")
        .def(py::init<const WholeNumber&, const Float64Array&>(), "count"_a, "outputs"_a, R"(
outputs: an aligned, C-contiguous float64 array of any shape, which is kept. The poses are neutral: they change nothing.
Raises ValueError or TypeError that names the argument.)")
        .def_property_readonly(
            "locations",
            [](const py::object& self) {
                return rows_of<3>(self, self.cast<PoseBuffer&>().location_numbers());
            },
            "(count, 3), a view of the memory.")
        .def_property_readonly(
            "rotations",
            [](const py::object& self) {
                return rows_of<4>(self, self.cast<PoseBuffer&>().rotation_numbers());
            },
            "(count, 4): w, x, y, z, a view of the memory.")
        .def_property_readonly(
            "scales",
            [](const py::object& self) { return rows_of<3>(self, self.cast<PoseBuffer&>().scale_numbers()); },
            "(count, 3), a view of the memory.")
        .def("reset", &PoseBuffer::reset, "Sets all poses to neutral ones, which change nothing.")
        .def("is_ordinary", &PoseBuffer::is_ordinary, R"(
Whether the squares of all numbers of the poses, and of all outputs, have sums below 1e30: all of them are finite then.)")
        .def("forget", &PoseBuffer::forget, "Has the next poses count as new, whatever they are.")
        .def("matrices", &PoseBuffer::matrices, "has_scales"_a, R"(
The poses as 4 x 4 matrices, column by column; None if they are those at the last call of matrices() or write_slots().

has_scales: whether the scales count; they are 1 if not.  Returns (16 * count,) float32, which the next call overwrites.
Raises ValueError if a rotation is zero.)")
        .def("write_slots", &PoseBuffer::write_slots, "slots"_a, "has_scales"_a, R"(
Writes location and Euler angles (order XYZ, rad) of each member into slots, and then the scales of all members.

slots: a C-contiguous float64 array (6 * count,), or (9 * count,) if has_scales. Nothing is written if the poses are those
at the last call of matrices() or write_slots().
Returns whether the slots were written.  Raises ValueError or TypeError that names the argument.)");
}

}  // namespace motus::bindings
