#include "surface.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "floats.hpp"
#include "motus/core/numeric.hpp"

namespace motus::snow {
namespace {

/// An alias table: each facet keeps a share of the draws that fall on it and leaves the rest to one other
/// facet, so that all get what their weight is. Vose, "A linear algorithm for generating random numbers with
/// a given distribution" (1991).
void share(std::span<double> weights, double sum, std::span<Facet> facets) {
    std::vector<std::uint32_t> small, large;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i] *= static_cast<double>(weights.size()) / sum;
        (weights[i] < 1.0 ? small : large).push_back(static_cast<std::uint32_t>(i));
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t less = small.back(), more = large.back();
        small.pop_back();
        facets[less].kept = static_cast<float>(weights[less]);
        facets[less].other = more;
        weights[more] -= 1.0 - weights[less];
        if (weights[more] >= 1.0) continue;
        large.pop_back();
        small.push_back(more);
    }
    // What is left has the mean weight but for rounding; a facet without weight is never left.
}

}  // namespace

std::vector<Facet> facets_of(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles) {
    require(triangles.size() < std::numeric_limits<std::int32_t>::max(), "surface_triangles: must be fewer");
    for (const glm::vec3& position : positions)
        require(is_finite(position), "surface_positions: must be finite");
    std::vector<Facet> facets;
    std::vector<double> weights;
    double sum = 0.0;
    const auto corner = [&](int vertex) {
        require(vertex >= 0 && static_cast<std::size_t>(vertex) < positions.size(),
                "surface_triangles: must name vertices of surface_positions");
        return glm::dvec3(positions[static_cast<std::size_t>(vertex)]);
    };
    for (const glm::ivec3& triangle : triangles) {
        const glm::dvec3 a = corner(triangle.x), b = corner(triangle.y) - a, c = corner(triangle.z) - a;
        const glm::dvec3 across = glm::cross(b, c);
        const double area = length_of(across);
        if (!(area > 0.0)) continue;
        Facet facet;
        facet.corner = floats_of(a);
        facet.edge1 = floats_of(b);
        facet.edge2 = floats_of(c);
        facet.normal = floats_of(unit_vector(across));
        facet.other = static_cast<std::uint32_t>(facets.size());
        facets.push_back(facet);
        weights.push_back(area);
        sum += area;
    }
    require(sum > 0.0, "surface_triangles: must have an area");
    share(weights, sum, facets);
    return facets;
}

}  // namespace motus::snow
