// Rows of single-precision numbers, one for each vertex.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/arrays.hpp"
#include "mesh/arrays.hpp"

namespace motus::bindings {

/// A copy of numbers (v,); empty for None.
[[nodiscard]] inline std::vector<float> float_row(const py::object& object, std::string_view name) {
    if (object.is_none()) return {};
    const FloatArray array = floats(object, name);
    if (array.ndim() != 1) value_error(name, "must have the shape (v,), not " + shape_of(array));
    return {array.data(), array.data() + array.size()};
}

}  // namespace motus::bindings
