// Rows of quaternions w, x, y, z, and arrays to write into.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "arrays.hpp"

namespace motus::bindings {

static_assert(sizeof(glm::dquat) == 4 * sizeof(double), "rows of w, x, y, z are written in place");

/// An array of T to be filled: the one given, of which nothing may need converting, or if there is none a
/// new one of that shape. ValueError for another shape, TypeError for another type, layout or a read-only
/// array.
template <class T>
[[nodiscard]] py::array_t<T, py::array::c_style> output(const py::object& given, std::string_view name,
                                                        const std::vector<py::ssize_t>& shape) {
    using Array = py::array_t<T, py::array::c_style>;
    if (given.is_none()) return Array(shape);
    if (!py::isinstance<Array>(given) || !is_aligned(py::reinterpret_borrow<py::array>(given)))
        type_error(name, std::string("must be an aligned, C-contiguous array of ") +
                             (sizeof(T) == 8 ? "float64" : "float32"));
    Array array = py::reinterpret_borrow<Array>(given);
    if (!array.writeable()) type_error(name, "must be writeable");
    if (!std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim())) {
        std::string wanted;
        for (const py::ssize_t size : shape) wanted += (wanted.empty() ? "" : ", ") + std::to_string(size);
        value_error(name, "must have the shape (" + wanted + "), not " + shape_of(array));
    }
    return array;
}

/// ValueError if two arrays overlap in memory: one would be overwritten before it is read.
template <class A, class B>
void require_apart(std::span<A> a, std::string_view a_name, std::span<B> b, std::string_view b_name) {
    const std::less<> before;  // a total order of all pointers
    const void* const a_begin = a.data();
    const void* const a_end = a.data() + a.size();
    const void* const b_begin = b.data();
    const void* const b_end = b.data() + b.size();
    if (before(a_begin, b_end) && before(b_begin, a_end))
        value_error(b_name, "must not share memory with " + std::string(a_name));
}

/// The memory of (m, 4) doubles as quaternions of GLM's own layout, until rows_from_quaternions() puts it in
/// order.
[[nodiscard]] inline std::span<glm::dquat> quaternions_in(double* rows, std::size_t count) {
    return {reinterpret_cast<glm::dquat*>(rows), count};
}

/// Rewrites quaternions as rows of w, x, y, z in the same memory.
inline void rows_from_quaternions(std::span<glm::dquat> quaternions) {
    double* row = reinterpret_cast<double*>(quaternions.data());
    for (const glm::dquat q : quaternions) {
        *row++ = q.w;
        *row++ = q.x;
        *row++ = q.y;
        *row++ = q.z;
    }
}

/// The unit quaternion along a row of w, x, y, z; ValueError for a row of zeros.
[[nodiscard]] inline glm::dquat unit_quaternion(const double* row, std::string_view name) {
    // Divide by the largest part first, since the square of a huge or tiny part would over- or underflow.
    const double largest = std::max({std::abs(row[0]), std::abs(row[1]), std::abs(row[2]), std::abs(row[3])});
    if (largest == 0.0) value_error(name, "a quaternion must not be zero");
    const glm::dquat q(row[0] / largest, row[1] / largest, row[2] / largest, row[3] / largest);
    return q / glm::length(q);
}

/// (m, 4) or (4,) read as unit quaternions; ValueError for another shape or a row of zeros.
class Rotations {
  public:
    Rotations(py::handle object, std::string_view name) {
        const DoubleArray array = doubles(object, name);
        single_ = array.ndim() == 1;
        if (array.ndim() < 1 || array.ndim() > 2 || array.shape(array.ndim() - 1) != 4)
            value_error(name, "must have the shape (m, 4) or (4,), not " + shape_of(array));
        const double* row = array.data();
        values_.reserve(static_cast<std::size_t>(array.size()) / 4);
        for (py::ssize_t i = 0; i < array.size(); i += 4) values_.push_back(unit_quaternion(row + i, name));
    }

    [[nodiscard]] bool is_single() const noexcept { return single_; }
    [[nodiscard]] std::span<const glm::dquat> values() const noexcept { return values_; }

  private:
    std::vector<glm::dquat> values_;
    bool single_ = false;
};

}  // namespace motus::bindings
