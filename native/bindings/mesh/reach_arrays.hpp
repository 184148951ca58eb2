// A Reach as a pair of arrays, and back.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>

#include "arrays.hpp"
#include "motus/mesh/reach.hpp"

namespace motus::bindings {

[[nodiscard]] inline IntArray index_array(std::span<const std::uint32_t> vertices) {
    IntArray result(static_cast<py::ssize_t>(vertices.size()));
    std::transform(vertices.begin(), vertices.end(), result.mutable_data(),
                   [](std::uint32_t vertex) { return static_cast<int>(vertex); });
    return result;
}

/// (indices (n,) int32, distances (n,) float32).
[[nodiscard]] inline py::tuple to_pair(const mesh::Reach& reach) {
    FloatArray distances(static_cast<py::ssize_t>(reach.distances.size()));
    std::copy(reach.distances.begin(), reach.distances.end(), distances.mutable_data());
    return py::make_tuple(index_array(reach.vertices), distances);
}

/// The pair's arrays, of one length; the indices ascend, each once, and are below `count`. ValueError
/// otherwise.
[[nodiscard]] inline mesh::Reach from_pair(const py::tuple& pair, std::size_t count) {
    if (pair.size() != 2) value_error("reach", "must be a pair of indices and distances");
    const IntArray indices = ints(pair[0], "reach");
    const FloatArray distances = floats(pair[1], "reach");
    if (indices.ndim() != 1 || distances.ndim() != 1 || indices.size() != distances.size())
        value_error("reach", "indices and distances must both have the shape (n,)");
    mesh::Reach reach;
    reach.vertices.resize(static_cast<std::size_t>(indices.size()));
    reach.distances.assign(distances.data(), distances.data() + distances.size());
    std::int64_t last = -1;
    for (py::ssize_t i = 0; i < indices.size(); ++i) {
        const std::int64_t index = indices.data()[i];
        if (index <= last) value_error("reach", "its indices must ascend, each of them once");
        last = index;
        reach.vertices[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(index);
    }
    if (last >= static_cast<std::int64_t>(count))
        value_error("reach", "every index must be below " + std::to_string(count));
    if (std::any_of(reach.distances.begin(), reach.distances.end(),
                    [](float distance) { return !(distance >= 0.0f); }))
        value_error("reach", "every distance must be >= 0");
    return reach;
}

}  // namespace motus::bindings
