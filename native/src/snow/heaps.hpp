// Slopes of lying snow: what is steeper than snow holds slides to lower vertices.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace motus::snow {

/// What settling reads of a layer's mesh.
struct HeapPlan {
    static constexpr std::size_t width = 4;
    /// Edges without a common vertex, which are changed at once. A missing one leads from a vertex that there
    /// is not, the number of which is that of the vertices, to itself.
    struct Ways {
        std::array<std::uint32_t, width> x{}, y{};
        std::array<float, width> lengths{};
    };
    /// A vertex at most 31 edges away from a triangle that is crossed by the line at which snow ends.
    struct Shore {
        std::uint32_t vertex = 0;
        float distance = 0.0F;  ///< m, to the line
        float cell = 0.0F;      ///< m, from a vertex to the next about the nearest part of the line
        glm::uvec3 corners{};   ///< of the triangle that has the nearest part of the line
        double weights = 0.0;   ///< sum over all vertices that receive what is too much for this one
    };
    /// A shore, farther from the line, that receives a part of what is too much for another shore: `weight`
    /// divided by the other's Shore::weights.
    struct Handing {
        std::uint32_t shore = 0;
        double weight = 0.0;
    };

    static constexpr std::size_t block = 16;  ///< Ways that are checked, or skipped, together
    static constexpr std::size_t group = 32;  ///< vertices that share one time of the last change

    std::vector<Ways> ways;    ///< all edges; those that the line at which snow ends crosses come last
    std::size_t whole = 0;     ///< how many of `ways`, the first ones, that line does not cross
    std::vector<float> areas;  ///< m^2, of each vertex, as Cover::areas(); then a 0 for missing edges
    std::vector<std::uint32_t> group_starts, groups;  ///< groups of vertices at the ends of each block
    std::vector<Shore> shores;                        ///< the nearest to the line first
    std::vector<std::uint32_t> handing_starts;
    std::vector<Handing> handings;  ///< of each shore

    [[nodiscard]] std::size_t block_count() const { return group_starts.size() - 1; }
};

/// The vertices and edges of a layer, prepared for moving snow from vertices that are too high to their
/// neighbours. Immutable.
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

    /// Changes `depths`, m, one for each vertex, so that those at the two ends of an edge differ by no more
    /// than `steepest` times the length of the edge, and so that the snow rises in a rounded slope from the
    /// line at which it ends. Snow that is too high moves to other vertices, so that the volume stays; what
    /// is still too high after 8 rounds over all edges is removed.
    void settle(std::vector<float>& depths, float steepest) const;

    [[nodiscard]] const HeapPlan& plan() const noexcept { return plan_; }

  private:
    using Ways = HeapPlan::Ways;
    using Shore = HeapPlan::Shore;
    class Linker;
    void measure(const Net& net);
    void gather_groups();
    void find_shores(const Net& net, const Linker& linker);
    void find_handings(std::span<const float> distances, const Linker& linker);

    HeapPlan plan_;
};

}  // namespace motus::snow
