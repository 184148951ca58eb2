// What flakes land on (collision geometry): triangles that stand still, and the way down over them.
//
// Costs: O(n log n) to make, which allocates it; O(log n) to ask. Immutable: any number of threads may
// share one.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"

namespace motus::snow {

/// A straight part of the way of what slides, up to the start of the next part; the last part rests.
struct Slide {
    double start = 0.0;  ///< s after the slide began
    glm::dvec3 from{0.0};
    glm::dvec3 direction{0.0};  ///< unit, or zero at rest
    double speed = 0.0;         ///< m/s at the start
    double acceleration = 0.0;  ///< along the direction, m/s^2

    [[nodiscard]] glm::dvec3 position(double time) const {
        const double t = time - start;
        return from + direction * (t * (speed + 0.5 * acceleration * t));
    }
    [[nodiscard]] glm::dvec3 velocity(double time) const {
        return direction * (speed + acceleration * (time - start));
    }
};

/// Triangles in world space. Immutable, so that several threads may ask at once. A million triangles take
/// some 70 MB, and 36 MB more once something has slid.
class Collider {
  public:
    static constexpr std::size_t most_slides = 64;

    /// Throws std::invalid_argument, naming collider_positions or collider_triangles, where a position is not
    /// finite, a triangle names a vertex that there is not, or there are 2^31 or more.
    Collider(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
             const Executor& executor = {});
    ~Collider();
    Collider(const Collider&) = delete;
    Collider& operator=(const Collider&) = delete;
    Collider(Collider&&) = delete;
    Collider& operator=(Collider&&) = delete;

    [[nodiscard]] std::span<const glm::vec3> positions() const noexcept;
    [[nodiscard]] std::span<const glm::ivec3> triangles() const noexcept;

    /// Largest error, m, of a place on the triangles, as their positions are in single precision.
    [[nodiscard]] double rounding() const noexcept;

    struct Hit {
        std::uint32_t triangle = 0;
        double part = 0.0;  ///< of the way from the start to the end, [0, 1]
        glm::dvec3 point{0.0};
    };
    /// What the straight way from the start to the end meets first, from either side of a triangle.
    [[nodiscard]] std::optional<Hit> first_hit(const glm::dvec3& start, const glm::dvec3& end) const;

    /// Unit; zero for a triangle without area. Throws std::invalid_argument where there is no such triangle.
    [[nodiscard]] glm::dvec3 normal(std::uint32_t triangle) const;

    /// A place on a triangle, and the side of it: behind is where its normal does not point to.
    struct Place {
        std::uint32_t triangle = 0;
        bool is_behind = false;
        glm::dvec3 point{0.0};
    };
    /// Where a slide ends. From a loose edge, and from one beyond which the surface overhangs, things fall.
    struct Rest {
        Place place;
        std::optional<glm::dvec3> over{};  ///< unit, away from the triangle, where things fall from its edge
    };
    /// Slides straight down each triangle in turn, as `pull` (m/s^2) and friction, >= 0, have it, the speed
    /// at the start and over each edge being that part of the velocity which points on. It rests where
    /// friction stops it, where two triangles lead down to the edge that they share, at an edge from which
    /// things fall, and after most_slides triangles. Triangles without area are passed. Adds what it does to
    /// `out`. Throws std::invalid_argument where there is no such triangle.
    Rest slide(const Place& first, const glm::dvec3& velocity, const glm::dvec3& pull, double friction,
               std::vector<Slide>& out) const;

    /// Where what falls along the direction (of any length) from a point lands, if it does.
    [[nodiscard]] std::optional<Place> below(const glm::dvec3& point, const glm::dvec3& direction) const;

  private:
    struct Mesh;
    std::unique_ptr<const Mesh> mesh_;
};

}  // namespace motus::snow
