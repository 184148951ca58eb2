// Python objects that are no arrays to checked values. They are taken as they come and looked at here, so
// that the exception names the argument instead of listing a signature.
#pragma once
#include <pybind11/pybind11.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arrays.hpp"

namespace motus::bindings {

[[nodiscard]] inline std::string_view type_name(py::handle object) {
    return Py_TYPE(object.ptr())->tp_name;
}

[[noreturn]] inline void wrong_type(py::handle given, std::string_view name, std::string_view wanted) {
    std::string_view type = type_name(given);
    type.remove_prefix(type.rfind('.') + 1);  // its module's name; nothing if there is none
    type_error(name, "must be " + std::string(wanted) + ", not " + std::string(type));
}

/// True or False, NumPy's included.
[[nodiscard]] inline bool flag(py::handle object, std::string_view name) {
    const bool is_numpy = type_name(object) == "numpy.bool" || type_name(object) == "numpy.bool_";
    if (!is_numpy && PyBool_Check(object.ptr()) == 0) wrong_type(object, name, "True or False");
    return PyObject_IsTrue(object.ptr()) == 1;
}

/// A whole number, NumPy's included. One that no int holds becomes the nearest that does: no argument's
/// domain is as wide, so that the sentence about the domain comes from the one who knows it.
[[nodiscard]] inline int whole_number(py::handle object, std::string_view name) {
    constexpr long lowest = std::numeric_limits<int>::min();
    constexpr long highest = std::numeric_limits<int>::max();
    if (PyIndex_Check(object.ptr()) == 0 || PyBool_Check(object.ptr()) != 0)
        wrong_type(object, name, "a whole number");
    const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
    if (!index) {
        PyErr_Clear();  // an array of several numbers, which has the method but no use for it
        wrong_type(object, name, "a whole number");
    }
    int overflow = 0;
    const long value = PyLong_AsLongAndOverflow(index.ptr(), &overflow);
    if (overflow > 0 || value > highest) return static_cast<int>(highest);
    if (overflow < 0 || value < lowest) return static_cast<int>(lowest);
    return static_cast<int>(value);
}

/// (n,) whole numbers of any integer type, such as indices of bones: copied. TypeError for others, ValueError
/// if one is no int.
[[nodiscard]] inline std::vector<int> whole_numbers(py::handle object, std::string_view name) {
    const py::array array = py::array::ensure(object);
    if (!array) value_error(name, "must be an array of whole numbers");
    if (array.ndim() != 1) value_error(name, "must have the shape (n,), not " + shape_of(array));
    if (array.size() == 0) return {};  // NumPy makes an empty list one of float64
    const char kind = array.dtype().kind();
    if (kind != 'i' && kind != 'u') type_error(name, "must hold whole numbers");
    const auto wide = py::array_t<long long, py::array::c_style | py::array::forcecast>::ensure(array);
    std::vector<int> result;
    result.reserve(static_cast<std::size_t>(wide.size()));
    for (py::ssize_t i = 0; i < wide.size(); ++i) {
        if (!std::in_range<int>(wide.data()[i])) value_error(name, "a number is too large");
        result.push_back(static_cast<int>(wide.data()[i]));
    }
    return result;
}

/// Indices of samples; None: there are none.
[[nodiscard]] inline std::vector<std::size_t> indices(py::handle object, std::string_view name) {
    std::vector<std::size_t> result;
    if (object.is_none()) return result;
    if (!py::isinstance<py::iterable>(object)) wrong_type(object, name, "a sequence of indices");
    for (const py::handle item : object) {
        const int index = whole_number(item, name);
        if (index < 0) value_error(name, "must be indices of samples");
        result.push_back(static_cast<std::size_t>(index));
    }
    return result;
}

/// The seed of random numbers.
[[nodiscard]] inline std::uint32_t seed_of(py::handle object) {
    const double given = number(object, "seed");
    if (!(given >= 0.0 && given < 0x1p32) || given != std::floor(given))
        value_error("seed", "must be a whole number from 0 to 2^32 - 1");
    return static_cast<std::uint32_t>(given);
}

/// An object of a bound class, called `wanted` in the message.
template <class Bound>
[[nodiscard]] Bound& instance(py::handle object, std::string_view name, std::string_view wanted) {
    if (!py::isinstance<Bound>(object)) wrong_type(object, name, wanted);
    return object.cast<Bound&>();
}

/// The value that a name stands for; TypeError if it is no string, ValueError with the list of names if
/// no value has that name.
template <class Value>
[[nodiscard]] Value choice(py::handle object, std::string_view name,
                           std::initializer_list<std::pair<std::string_view, Value>> choices) {
    if (!py::isinstance<py::str>(object)) wrong_type(object, name, "a string");
    const auto given = object.cast<std::string>();
    std::string list;
    for (const auto& [text, value] : choices) {
        if (text == given) return value;
        list += (list.empty() ? "'" : ", '") + std::string(text) + "'";
    }
    value_error(name, "must be one of " + list + ", not '" + given + "'");
}

}  // namespace motus::bindings
