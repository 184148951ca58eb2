// Python objects to checked spans and back: shape, dtype and finiteness are looked at here, once, and the
// exception names the argument.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motus::bindings {

namespace py = pybind11;

static_assert(sizeof(glm::dvec3) == 3 * sizeof(double), "a (m, 3) array is read as m vectors");

using DoubleArray = py::array_t<double, py::array::c_style>;

[[noreturn]] inline void value_error(std::string_view name, std::string_view problem) {
    throw py::value_error(std::string(name) + ": " + std::string(problem));
}

[[noreturn]] inline void type_error(std::string_view name, std::string_view problem) {
    throw py::type_error(std::string(name) + ": " + std::string(problem));
}

/// Whether the elements lie where their type may: not so in a view of bytes.
[[nodiscard]] inline bool is_aligned(const py::array& array) {
    return (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

[[nodiscard]] inline std::string shape_of(const py::array& array) {
    std::string text = "(";
    for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
        if (axis > 0) text += ", ";
        text += std::to_string(array.shape(axis));
    }
    return text + (array.ndim() == 1 ? ",)" : ")");
}

/// A copy of the object as contiguous float64. Integers and other floats are converted; TypeError for
/// anything else (complex, bool, strings, objects), ValueError if the values are ragged or one of them is
/// not finite. A copy, since another thread may write into the caller's array after the values have been
/// looked at.
[[nodiscard]] inline DoubleArray doubles(py::handle object, std::string_view name) {
    const py::array array = py::array::ensure(object);
    if (!array) value_error(name, "must be an array of numbers, all rows of one length");
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u') type_error(name, "must hold real numbers");
    const DoubleArray given = DoubleArray::ensure(array);
    if (!given) type_error(name, "cannot be converted to float64");
    DoubleArray result(py::array::ShapeContainer(given.shape(), given.shape() + given.ndim()));
    const double* values = result.data();
    if (result.size() > 0)
        std::memcpy(result.mutable_data(), given.data(), static_cast<std::size_t>(given.nbytes()));
    for (py::ssize_t i = 0; i < result.size(); ++i) {
        if (!std::isfinite(values[i])) value_error(name, "every value must be finite");
    }
    return result;
}

/// The memory that doubles() copies from, if that is an array's own; of other objects nothing.
[[nodiscard]] inline std::span<const double> memory_of(py::handle object) {
    if (!py::isinstance<DoubleArray>(object)) return {};
    const auto array = py::reinterpret_borrow<DoubleArray>(object);
    return {array.data(), static_cast<std::size_t>(array.size())};
}

/// The value of a Python int or float, without the cost of an array; nothing for other objects and for
/// integers that no float64 holds. ValueError if it is not finite.
[[nodiscard]] inline std::optional<double> plain_number(py::handle object, std::string_view name) {
    if (PyFloat_Check(object.ptr()) != 0) {
        const double value = PyFloat_AS_DOUBLE(object.ptr());
        if (!std::isfinite(value)) value_error(name, "must be finite");
        return value;
    }
    if (PyLong_CheckExact(object.ptr()) == 0) return std::nullopt;
    const double value = PyLong_AsDouble(object.ptr());
    if (value == -1.0 && PyErr_Occurred() != nullptr) {
        PyErr_Clear();
        return std::nullopt;
    }
    return value;
}

/// A number: int, float or an array of no dimension. TypeError for others, ValueError if it is not finite.
[[nodiscard]] inline double number(py::handle object, std::string_view name) {
    if (const std::optional<double> plain = plain_number(object, name)) return *plain;
    const DoubleArray array = doubles(object, name);
    if (array.ndim() != 0) type_error(name, "must be a number, not an array of shape " + shape_of(array));
    return *array.data();
}

/// A number or a (m,) array of numbers, as a span.
class Numbers {
  public:
    Numbers(py::handle object, std::string_view name) {
        if (const std::optional<double> plain = plain_number(object, name)) {
            single_ = *plain;
            return;
        }
        DoubleArray array = doubles(object, name);
        if (array.ndim() > 1) value_error(name, "must be a number or (m,), not " + shape_of(array));
        if (array.ndim() == 0)
            single_ = *array.data();
        else
            array_ = std::move(array);
    }

    [[nodiscard]] bool is_single() const noexcept { return !array_.has_value(); }
    [[nodiscard]] std::span<const double> values() const {
        if (!array_) return {&single_, 1};
        return {array_->data(), static_cast<std::size_t>(array_->size())};
    }

  private:
    double single_ = 0.0;
    std::optional<DoubleArray> array_;
};

/// Rows of x, y, z: (m, 3). Holds the array that the span points into.
class Points {
  public:
    Points(py::handle object, std::string_view name) : array_(doubles(object, name)) {
        if (array_.ndim() != 2 || array_.shape(1) != 3)
            value_error(name, "must have the shape (m, 3), not " + shape_of(array_));
    }

    [[nodiscard]] std::span<const glm::dvec3> values() const {
        return {reinterpret_cast<const glm::dvec3*>(array_.data()),
                static_cast<std::size_t>(array_.shape(0))};
    }

  private:
    DoubleArray array_;
};

/// (3,).
[[nodiscard]] inline glm::dvec3 vector(py::handle object, std::string_view name) {
    const DoubleArray array = doubles(object, name);
    if (array.ndim() != 1 || array.shape(0) != 3)
        value_error(name, "must have the shape (3,), not " + shape_of(array));
    return {array.data()[0], array.data()[1], array.data()[2]};
}

/// (4, 4) in rows, as Blender's and NumPy's are.
[[nodiscard]] inline glm::dmat4 matrix(py::handle object, std::string_view name) {
    const DoubleArray array = doubles(object, name);
    if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4)
        value_error(name, "must have the shape (4, 4), not " + shape_of(array));
    glm::dmat4 result;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) result[column][row] = array.at(row, column);
    }
    return result;
}

/// (k, 4, 4) in rows, the same.
[[nodiscard]] inline std::vector<glm::dmat4> matrices(py::handle object, std::string_view name) {
    const DoubleArray array = doubles(object, name);
    if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4)
        value_error(name, "must have the shape (k, 4, 4), not " + shape_of(array));
    std::vector<glm::dmat4> result(static_cast<std::size_t>(array.shape(0)));
    const double* value = array.data();
    for (glm::dmat4& one : result) {
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) one[column][row] = *value++;
        }
    }
    return result;
}

/// A new array of the given shape.
[[nodiscard]] inline DoubleArray new_array(std::initializer_list<std::size_t> shape) {
    return DoubleArray(py::array::ShapeContainer(shape.begin(), shape.end()));
}

/// The new array's values, to be filled.
[[nodiscard]] inline std::span<double> values_of(DoubleArray& array) {
    return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

/// The values of an array whose last axis has length 3, as vectors.
[[nodiscard]] inline std::span<glm::dvec3> points_of(DoubleArray& array) {
    return {reinterpret_cast<glm::dvec3*>(array.mutable_data()), static_cast<std::size_t>(array.size()) / 3};
}

[[nodiscard]] inline DoubleArray to_array(const glm::dvec3& v) {
    DoubleArray result = new_array({3});
    points_of(result)[0] = v;
    return result;
}

[[nodiscard]] inline DoubleArray to_array(std::span<const glm::dvec3> points) {
    DoubleArray result = new_array({points.size(), 3});
    std::copy(points.begin(), points.end(), points_of(result).begin());
    return result;
}

/// Values of an array of the caller's that must not change after they have been checked: while the
/// interpreter's lock is given away another thread may write into the array.
template <class T>
[[nodiscard]] std::vector<T> copied(std::span<const T> values) {
    return {values.begin(), values.end()};
}

/// Gives the interpreter's lock away for work that takes longer than handing it over does. No Python in its
/// scope.
class ReleaseGil {
  public:
    /// `count` items of about `nanoseconds` each.
    ReleaseGil(std::size_t count, double nanoseconds) {
        constexpr double worth_it = 50e3;
        if (static_cast<double>(count) * nanoseconds > worth_it) release_.emplace();
    }

  private:
    std::optional<py::gil_scoped_release> release_;
};

/// f(number) -> double for each: a float, or a (m,) array.
template <class Function>
[[nodiscard]] py::object map_numbers(const Numbers& numbers, double nanoseconds, Function&& f) {
    const std::span<const double> in = numbers.values();
    if (numbers.is_single()) return py::float_(f(in[0]));
    DoubleArray result = new_array({in.size()});
    const std::span<double> out = values_of(result);
    {
        const ReleaseGil released(in.size(), nanoseconds);
        for (std::size_t i = 0; i < in.size(); ++i) out[i] = f(in[i]);
    }
    return result;
}

/// f(number) -> vector for each: a (3,) array, or a (m, 3) one.
template <class Function>
[[nodiscard]] py::object map_points(const Numbers& numbers, double nanoseconds, Function&& f) {
    const std::span<const double> in = numbers.values();
    if (numbers.is_single()) return to_array(f(in[0]));
    DoubleArray result = new_array({in.size(), 3});
    const std::span<glm::dvec3> out = points_of(result);
    {
        const ReleaseGil released(in.size(), nanoseconds);
        for (std::size_t i = 0; i < in.size(); ++i) out[i] = f(in[i]);
    }
    return result;
}

}  // namespace motus::bindings
