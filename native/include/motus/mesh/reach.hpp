// The vertices within reach of a root, and how far away they are: a geodesic disc.
#pragma once
#include <cstdint>
#include <vector>

namespace motus::mesh {

/// Vertices, ascending and each once, with one distance each. The functions that make a Reach say what the
/// distance is: straight, along the surface, or in edges.
struct Reach {
    std::vector<std::uint32_t> vertices;
    std::vector<float> distances;  ///< >= 0, finite
};

}  // namespace motus::mesh
