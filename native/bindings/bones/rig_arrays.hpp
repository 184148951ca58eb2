// A rig's arrays as Blender's foreach_get fills them, taken as they are: functions that run at every
// frame neither copy nor check all values. Shape, type and layout are checked; values are not.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "motus/bones/rig.hpp"

namespace motus::bindings {

static_assert(sizeof(int) == 4, "int32 arrays are read as ints");

template <class T>
[[nodiscard]] constexpr std::string_view dtype_name() {
    if constexpr (std::is_same_v<T, float>) return "float32";
    if constexpr (std::is_same_v<T, double>) return "float64";
    if constexpr (std::is_same_v<T, int>) return "int32";
}

/// The elements of an aligned, C-contiguous array of T with that shape, which the caller keeps alive.
/// TypeError for another type or layout, ValueError for another shape.
template <class T>
[[nodiscard]] std::span<const T> elements(py::handle object, std::string_view name,
                                          std::initializer_list<std::size_t> shape) {
    using Array = py::array_t<T, py::array::c_style>;
    if (!py::isinstance<Array>(object) || !is_aligned(py::reinterpret_borrow<py::array>(object)))
        type_error(name, "must be an aligned, C-contiguous array of " + std::string(dtype_name<T>()));
    const Array array = py::reinterpret_borrow<Array>(object);
    const std::vector<py::ssize_t> wanted_shape(shape.begin(), shape.end());
    const bool fits =
        std::equal(wanted_shape.begin(), wanted_shape.end(), array.shape(), array.shape() + array.ndim());
    if (!fits) {
        std::string wanted;
        for (const std::size_t size : shape) wanted += (wanted.empty() ? "(" : ", ") + std::to_string(size);
        value_error(name, "must have the shape " + wanted + (shape.size() == 1 ? ",)" : ")") + ", not " +
                              shape_of(array));
    }
    return {array.data(), static_cast<std::size_t>(array.size())};
}

/// The matrix in the memory that an object lends as (4, 4) floats, which a mathutils.Matrix does from Blender
/// 5 on; nothing if it lends none.
[[nodiscard]] inline std::optional<glm::dmat4> lent_matrix(py::handle object) {
    Py_buffer lent;
    if (PyObject_GetBuffer(object.ptr(), &lent, PyBUF_STRIDES | PyBUF_FORMAT) != 0) {
        PyErr_Clear();
        return std::nullopt;
    }
    std::optional<glm::dmat4> result;
    if (lent.ndim == 2 && lent.shape[0] == 4 && lent.shape[1] == 4 && std::string_view(lent.format) == "f") {
        result.emplace();
        const auto* const memory = static_cast<const std::byte*>(lent.buf);
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                float value = 0.0F;
                std::memcpy(&value, memory + row * lent.strides[0] + column * lent.strides[1], sizeof(value));
                (*result)[column][row] = static_cast<double>(value);
            }
        }
    }
    PyBuffer_Release(&lent);
    return result;
}

/// (16,) float64, column by column, or a mathutils.Matrix that lends its memory.
[[nodiscard]] inline glm::dmat4 matrix_of_columns(py::handle object, std::string_view name) {
    if (!py::isinstance<py::array>(object)) {
        if (const std::optional<glm::dmat4> lent = lent_matrix(object)) return *lent;
    }
    const std::span<const double> values = elements<double>(object, name, {16});
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
    return matrix;
}

/// All bones of a rig with these parents, without poses, basis and lengths, which not every solver reads.
[[nodiscard]] inline bones::RigArrays rig_at_rest(std::span<const int> parents, py::handle rest,
                                                  py::handle inheritance) {
    const std::size_t count = parents.size();
    bones::RigArrays rig;
    rig.parents = parents;
    rig.rest = elements<float>(rest, "rest", {count, 16});
    rig.inheritance = elements<int>(inheritance, "inheritance", {count});
    return rig;
}

/// A copy of all that a solver reads of a rig but its lengths: another thread may write into the arrays while
/// the interpreter's lock is given away, and values that were found finite are read again.
class CopiedRig {
  public:
    CopiedRig(std::span<const int> parents, const Float32Array& rest, const py::object& poses,
              const py::object& basis, const Int32Array& inheritance) {
        const bones::RigArrays given = rig_at_rest(parents, rest, inheritance);
        rest_ = copied(given.rest);
        poses_ = copied(elements<float>(poses, "poses", {parents.size(), 16}));
        basis_ = copied(elements<float>(basis, "basis", {parents.size(), 16}));
        inheritance_ = copied(given.inheritance);
        view_ = bones::RigArrays{parents, rest_, poses_, basis_, {}, inheritance_};
    }
    CopiedRig(const CopiedRig&) = delete;
    CopiedRig& operator=(const CopiedRig&) = delete;
    CopiedRig(CopiedRig&&) = delete;
    CopiedRig& operator=(CopiedRig&&) = delete;
    ~CopiedRig() = default;

    [[nodiscard]] const bones::RigView& view() const noexcept { return view_; }

  private:
    std::vector<float> rest_, poses_, basis_;
    std::vector<int> inheritance_;
    bones::RigView view_;
};

}  // namespace motus::bindings
