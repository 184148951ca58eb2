// Meshes as arrays: float32 positions and int32 indices, read where they lie if they have these types.
#pragma once
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/arrays.hpp"
#include "motus/core/parallel.hpp"

namespace motus::bindings {

static_assert(sizeof(glm::vec3) == 3 * sizeof(float), "a (v, 3) array is read as v vectors");
static_assert(sizeof(glm::ivec3) == 3 * sizeof(int), "a (t, 3) array is read as t triangles");
static_assert(sizeof(glm::ivec2) == 2 * sizeof(int), "an (e, 2) array is read as e edges");

using FloatArray = py::array_t<float, py::array::c_style>;
using IntArray = py::array_t<int, py::array::c_style>;

/// The object as contiguous float32: itself, if it is that; a copy of other real numbers. Values are not
/// looked at. TypeError for anything else.
[[nodiscard]] inline FloatArray floats(py::handle object, std::string_view name) {
    const py::array array = py::array::ensure(object);
    if (!array) value_error(name, "must be an array of numbers, all rows of one length");
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u') type_error(name, "must hold real numbers");
    const auto converted = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(array);
    if (!converted) type_error(name, "cannot be converted to float32");
    auto result = py::reinterpret_borrow<FloatArray>(converted);
    if (!is_aligned(result)) result = FloatArray(result.attr("copy")());
    return result;
}

/// The object as contiguous int32: itself, if it is that; a copy of other whole numbers. TypeError for
/// anything else, ValueError if one is no int32.
[[nodiscard]] inline IntArray ints(py::handle object, std::string_view name) {
    py::array array = py::array::ensure(object);
    if (!array) value_error(name, "must be an array of whole numbers, all rows of one length");
    const char kind = array.dtype().kind();
    if (kind != 'i' && kind != 'u') {
        if (array.size() > 0) type_error(name, "must hold whole numbers");
        array = py::array(array.attr("astype")("int32"));  // NumPy makes an empty list one of float64
    }
    if (py::isinstance<IntArray>(array) && is_aligned(array)) return py::reinterpret_borrow<IntArray>(array);
    const auto wide = py::array_t<long long, py::array::c_style | py::array::forcecast>::ensure(array);
    if (!wide) type_error(name, "cannot be converted to int32");
    IntArray result(std::vector<py::ssize_t>(wide.shape(), wide.shape() + wide.ndim()));
    int* values = result.mutable_data();
    for (py::ssize_t i = 0; i < wide.size(); ++i) {
        if (!std::in_range<int>(wide.data()[i])) value_error(name, "a number is too large");
        values[i] = static_cast<int>(wide.data()[i]);
    }
    return result;
}

/// Rows of x, y, z: (v, 3). Holds the array that the span points into. Values are not looked at.
class Positions {
  public:
    Positions(py::handle object, std::string_view name) : array_(floats(object, name)) {
        if (array_.ndim() != 2 || array_.shape(1) != 3)
            value_error(name, "must have the shape (v, 3), not " + shape_of(array_));
    }

    [[nodiscard]] std::span<const glm::vec3> values() const {
        return {reinterpret_cast<const glm::vec3*>(array_.data()), static_cast<std::size_t>(array_.shape(0))};
    }

  private:
    FloatArray array_;
};

/// Rows of indices, (n, 3) or (n, 2): triangles or edges. Which vertices there are is not looked at. None: no
/// rows.
template <class Row>
class IndexRows {
  public:
    IndexRows(py::handle object, std::string_view name) {
        if (object.is_none()) return;
        constexpr int width = Row::length();
        array_ = ints(object, name);
        const bool is_empty = array_.size() == 0 && array_.ndim() <= 2;
        if (!is_empty && (array_.ndim() != 2 || array_.shape(1) != width))
            value_error(name,
                        "must have the shape (n, " + std::to_string(width) + "), not " + shape_of(array_));
    }

    [[nodiscard]] std::span<const Row> values() const {
        return {reinterpret_cast<const Row*>(array_.data()),
                static_cast<std::size_t>(array_.size()) / static_cast<std::size_t>(Row::length())};
    }

  private:
    IntArray array_{py::ssize_t{0}};
};

/// A new array of rows, (n, width), or of numbers, (n,).
template <class Row>
[[nodiscard]] py::array array_of(const std::vector<Row>& rows) {
    const auto count = static_cast<py::ssize_t>(rows.size());
    const auto filled = [&](auto array) {
        if (!rows.empty()) std::memcpy(array.mutable_data(), rows.data(), sizeof(Row) * rows.size());
        return array;
    };
    if constexpr (std::is_arithmetic_v<Row>)
        return filled(py::array_t<Row>(count));
    else
        return filled(py::array_t<typename Row::value_type>({count, py::ssize_t{Row::length()}}));
}

/// Whether every position is finite. Calls no Python.
[[nodiscard]] inline bool are_finite(std::span<const glm::vec3> positions) {
    const std::span<const float> numbers(reinterpret_cast<const float*>(positions.data()),
                                         3 * positions.size());
    std::atomic<bool> all{true};
    in_parts(numbers.size(), std::size_t{1} << 20, [&](std::size_t first, std::size_t last) {
        int strange = 0;
        for (std::size_t i = first; i < last; ++i)
            strange |= static_cast<int>(!(std::abs(numbers[i]) <= std::numeric_limits<float>::max()));
        if (strange != 0) all = false;
    });
    return all;
}

/// (3,) in single precision; finite.
[[nodiscard]] inline glm::vec3 float_vector(py::handle object, std::string_view name) {
    const glm::vec3 result(vector(object, name));
    if (!are_finite({&result, 1})) value_error(name, "must fit into single precision");
    return result;
}

/// A number in single precision; finite.
[[nodiscard]] inline float float_number(py::handle object, std::string_view name) {
    const auto result = static_cast<float>(number(object, name));
    if (!std::isfinite(result)) value_error(name, "must fit into single precision");
    return result;
}

/// (3, 3) in rows, as Blender's and NumPy's are; None: the identity.
[[nodiscard]] inline glm::mat3 metric_argument(py::handle object, std::string_view name) {
    if (object.is_none()) return glm::mat3(1.0f);
    const DoubleArray array = doubles(object, name);
    if (array.ndim() != 2 || array.shape(0) != 3 || array.shape(1) != 3)
        value_error(name, "must have the shape (3, 3), not " + shape_of(array));
    glm::mat3 result;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            result[column][row] = static_cast<float>(array.at(row, column));
    }
    for (int column = 0; column < 3; ++column) {
        if (!are_finite({&result[column], 1})) value_error(name, "must fit into single precision");
    }
    return result;
}

}  // namespace motus::bindings
