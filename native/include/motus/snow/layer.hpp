// The mesh of snow that lies on a surface: a height field over it, with walls.
//
// Costs: O(triangles) to make and to ask, which both allocate. Immutable: any number of threads may share
// one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"
#include "motus/core/leaves_zero.hpp"
#include "motus/snow/collider.hpp"

namespace motus::snow {

class Heaps;  ///< how what lies too high falls off; private to the library

/// What lies on triangles, in their space. Immutable, so that several threads may ask at once.
///
/// The layer is a surface above that of the triangles, as far off each vertex as the snow there is deep. It
/// is cut where it is thin, along a line on the surface, and is closed by a wall at loose edges. What is
/// moved from has no vertices.
class SnowLayer {
  public:
    /// `up`: away from what pulls snow down, finite, of any length but 0. Throws std::invalid_argument,
    /// naming layer_positions or layer_triangles, where a position is not finite, a triangle names a vertex
    /// that there is not, or there are 2^29 triangles or more.
    ///
    /// `shelter`: what snow cannot fall through. Between a vertex with snow and a bare one that is under
    /// something, or steeper than `hold`, the tangent of a slope, the layer ends where the one or the other
    /// begins. Without a shelter it ends everywhere as the depths have it.
    SnowLayer(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
              const glm::dvec3& up, const Collider* shelter = nullptr,
              double hold = std::numeric_limits<double>::infinity(), const Executor& executor = {});

    struct Mesh {
        std::vector<glm::vec3> positions;
        std::vector<float> depths;  ///< of the snow at each vertex, 0 at the foot of walls
        std::vector<glm::ivec3> triangles;
        std::vector<glm::ivec2> edges;  ///< all sides of the triangles, each once
        std::vector<glm::ivec3> sides;  ///< of each triangle the edges that leave its corners
    };

    [[nodiscard]] std::size_t vertex_count() const noexcept { return vertex_count_; }

    /// A vertex of the triangles on which snow can lie, and the unit vector along which it lies there.
    struct Column {
        std::uint32_t vertex = 0;
        glm::vec3 foot{0.0F};
        glm::vec3 up{0.0F};
    };
    /// Of each vertex that triangles with an area are around.
    [[nodiscard]] std::vector<Column> columns() const;

    /// `depths`, m: how deep the snow is on each vertex, across the surface. From one vertex to the next its
    /// depth differs by no more than the fraction `steepest`, > 0, of the way between them: what would be
    /// higher lies on what is lower beside it, so that the volume stays, but for heaps so wide that it would
    /// go on for too long. From the line at which snow ends it rises in a slope that is rounded above, some
    /// edges wide: what is too much there lies farther from the line, and is gone where that is too far.
    /// `left`, >= 0: how much of that depth is left on each vertex; empty where it is all. Snow that is not
    /// deeper than `thinnest`, >= 0, m, is hidden. Throws std::invalid_argument where there is not a finite
    /// depth for each vertex, or another number is outside its domain.
    [[nodiscard]] Mesh at(std::span<const float> depths, float thinnest, float steepest,
                          std::span<const float> left = {}) const;

  private:
    struct Loose {
        std::uint32_t triangle = 0;
        std::uint32_t side = 0;
    };
    class Builder;
    void number(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles);
    void find_normals(const glm::dvec3& up);
    void find_edges();
    void leave_out_degenerate();
    void find_ends(const Collider& shelter, const glm::dvec3& up, double hold, const Executor& executor);

    // Vertices of triangles alone, in the order in which the triangles first name them: what is near on the
    // surface is near in memory.
    LeavesZero<std::size_t> vertex_count_;  ///< of the given vertices,
    std::vector<std::uint32_t> numbers_;    ///< among which the vertices of triangles have these numbers
    std::vector<glm::vec3> positions_, normals_;  ///< unit, upwards; zero where there is none
    std::vector<std::uint8_t> is_upright_;        ///< whether the triangles' own normals point upwards there
    std::vector<glm::ivec3> triangles_;           ///< those with three different corners
    std::vector<glm::ivec2> edges_;
    std::vector<float> ends_;  ///< fractions of the edges at which snow ends, or none: a negative number
    std::vector<glm::ivec3> sides_;
    std::vector<Loose> loose_;  ///< sides that no other triangle has
    std::shared_ptr<const Heaps> heaps_;
};

}  // namespace motus::snow
