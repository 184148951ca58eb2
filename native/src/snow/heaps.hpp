// How far snow that lies too high falls off.
#pragma once
#include <array>
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
        /// A different number of each vertex. Of two edges that share a vertex the one that leads from there
        /// to the lower rank is changed first, so that depths do not depend on the order of the vertices.
        std::span<const std::uint32_t> ranks;
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
    static constexpr std::size_t width = 4;
    /// Edges without a common vertex, which are changed at once. A missing one leads from a vertex that there
    /// is not, the number of which is that of the vertices, to itself.
    struct Ways {
        std::array<std::uint32_t, width> x{}, y{};
        std::array<float, width> lengths{};
    };
    /// A vertex near the line at which snow ends.
    struct Shore {
        std::uint32_t vertex = 0;
        float distance = 0.0F;  ///< m, to the line
        float cell = 0.0F;      ///< m, from a vertex to the next about the nearest part of the line
        glm::uvec3 corners{};   ///< of the triangle that has the nearest part of the line
        double weights = 0.0;   ///< sum of those of all vertices that what is too much goes to
    };
    /// Where what is too much for a shore goes: a shore that is farther from the line.
    struct Handing {
        std::uint32_t shore = 0;
        double weight = 0.0;
    };
    class Fall;
    class Linker;
    void measure(const Net& net);
    void gather_groups();
    void find_shores(const Net& net, const Linker& linker);
    void find_handings(std::span<const float> distances, const Linker& linker);
    [[nodiscard]] std::size_t block_count() const { return group_starts_.size() - 1; }

    static constexpr std::size_t block = 16;  ///< Ways that are gone through, or rest, together
    static constexpr std::size_t group = 32;  ///< vertices of which is kept when one of them changed

    std::vector<Ways> ways_;    ///< the edges, those on which snow ends last
    std::size_t whole_ = 0;     ///< of `ways_`: on which snow does not end
    std::vector<float> areas_;  ///< m^2, of the snow on each vertex, as Cover::areas(), and 0 in the end
    std::vector<std::uint32_t> group_starts_, groups_;  ///< groups of vertices at the ends of each block
    std::vector<Shore> shores_;                         ///< the nearest to the line first
    std::vector<std::uint32_t> handing_starts_;
    std::vector<Handing> handings_;  ///< of each shore
};

}  // namespace motus::snow
