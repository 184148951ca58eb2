// How far snow that lies too high falls off.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace motus::snow {

/// The vertices and edges of a layer, over which snow that is too high goes to other vertices. Immutable.
class Heaps {
  public:
    /// A layer's mesh.
    struct Net {
        std::span<const glm::vec3> positions;
        std::span<const glm::ivec3> triangles;
        std::span<const glm::ivec2> edges;  ///< all sides of the triangles, each once
        std::span<const glm::ivec3> sides;  ///< of each triangle the edges that leave its corners
        std::span<const float> ends;  ///< fractions of the edges at which snow ends, or a negative number
    };
    explicit Heaps(const Net& net);

    /// Makes depths, m, one for each vertex, that differ by no more than the fraction `steepest` of the way
    /// from one vertex to the next, and rise from the line at which snow ends in a rounded slope. What is too
    /// high goes to other vertices, so that volumes stay.
    void settle(std::vector<float>& depths, float steepest) const;

  private:
    struct Way {
        std::uint32_t x = 0, y = 0;
        float length = 0.0F;

        [[nodiscard]] std::uint32_t beyond(std::uint32_t vertex) const { return vertex == x ? y : x; }
    };
    /// A vertex near the line at which snow ends.
    struct Shore {
        std::uint32_t vertex = 0, triangle = 0;  ///< the triangle that has the nearest part of the line
        float distance = 0.0F;                   ///< m, to the line
        float cell = 0.0F;                       ///< m, from a vertex to the next about the triangle
    };
    class Fall;
    void measure(const Net& net);
    void link(const Net& net);
    void find_shores(const Net& net);
    [[nodiscard]] std::span<const std::uint32_t> spokes(std::uint32_t vertex) const {
        return std::span(spokes_).subspan(spoke_starts_[vertex],
                                          spoke_starts_[vertex + 1] - spoke_starts_[vertex]);
    }

    std::vector<Way> ways_;     ///< the edges, those on which snow ends last
    std::uint32_t whole_ = 0;   ///< edges on which snow does not end
    std::vector<float> areas_;  ///< m^2, of the snow on each vertex, as Cover::areas()
    std::vector<std::uint32_t> spoke_starts_, spokes_;  ///< ways that each vertex has
    std::vector<Shore> shores_;                         ///< the nearest to the line first
    std::vector<glm::uvec3> shore_corners_;             ///< of the triangle of each shore
    std::vector<float> distances_;                      ///< of all vertices, infinite where they are no shore
};

}  // namespace motus::snow
