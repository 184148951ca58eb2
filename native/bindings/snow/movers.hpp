// Colliders that go from place to place, as Python gives them.
#pragma once
#include <pybind11/pybind11.h>

#include <memory>
#include <string_view>
#include <vector>

#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "motus/snow/snow.hpp"

namespace motus::bindings {

/// (k,), empty for None.
[[nodiscard]] inline DoubleArray row(const py::object& object, std::string_view name) {
    if (object.is_none()) return DoubleArray(0);
    DoubleArray array = doubles(object, name);
    if (array.ndim() != 1) value_error(name, "must have the shape (k,), not " + shape_of(array));
    return array;
}

using MoverList = Typed<
    "typing.Sequence[tuple[motus_native.SnowCollider, numpy.typing.ArrayLike, numpy.typing.ArrayLike]]">;

[[nodiscard]] inline std::vector<snow::Mover> movers_of(const MoverList& movers) {
    if (!py::isinstance<py::sequence>(movers)) wrong_type(movers, "movers", "a sequence");
    std::vector<snow::Mover> found;
    for (const py::handle one : movers) {
        if (!py::isinstance<py::sequence>(one) || py::len(one) != 3)
            wrong_type(py::reinterpret_borrow<py::object>(one), "movers",
                       "a sequence of colliders, times and matrices");
        const auto parts = py::reinterpret_borrow<py::sequence>(one);
        const py::object collider = parts[0], times = parts[1], poses = parts[2];
        static_cast<void>(instance<snow::Collider>(collider, "movers", "a SnowCollider"));
        const DoubleArray at = row(times, "movers");
        found.push_back({collider.cast<std::shared_ptr<snow::Collider>>(),
                         {at.data(), at.data() + at.size()},
                         matrices(poses, "movers")});
    }
    return found;
}

}  // namespace motus::bindings
