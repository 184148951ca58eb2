// Which vertices of a mesh snow lies on, and how far along an edge.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "motus/core/executor.hpp"
#include "motus/snow/collider.hpp"

namespace motus::snow {

constexpr double clear = 1e-3;  ///< m: rays for falling and for shelter start this far off the surface

struct Holding {
    std::vector<double> margins;             ///< > 0 if snow holds on a vertex; linear along an edge
    std::vector<std::uint8_t> is_sheltered;  ///< whether something is above a vertex

    [[nodiscard]] bool holds(std::size_t vertex) const { return margins[vertex] > 0.0; }
};

/// Tells whether something is above a place, for one thread: the triangle that was above the last such place
/// is tried first, as places near each other are mostly under the same one. What it says does not depend on
/// which places it was asked about before.
class Shelter {
  public:
    /// `up`: unit.
    Shelter(const Collider& collider, const glm::dvec3& up) : collider_(&collider), up_(up) {}

    [[nodiscard]] bool is_over(const glm::dvec3& place);

  private:
    [[nodiscard]] bool is_last_over(const glm::dvec3& start) const;

    const Collider* collider_;
    glm::dvec3 up_;
    std::optional<std::uint32_t> last_;  ///< triangle
};

/// `up`: unit. `steepest`: tangent of the steepest slope on which snow lies.
[[nodiscard]] Holding holding_of(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                                 const Collider& shelter, const glm::dvec3& up, double steepest,
                                 const Executor& executor);

/// The fraction of the way from a vertex to another one at which snow ends, if snow lies on only one of them
/// because the other one is too steep or sheltered.
[[nodiscard]] std::optional<float> end_on_edge(const Holding& holding, std::span<const glm::vec3> positions,
                                               Shelter& shelter, std::size_t from, std::size_t to);

/// Of a third of a triangle, how much each corner's depth counts for in the volume of the snow on it. `ends`:
/// of the sides that leave the corners. Where snow ends within the triangle it goes down to nothing there, on
/// either side.
[[nodiscard]] std::array<double, 3> shown_parts(const std::array<std::optional<float>, 3>& ends);

}  // namespace motus::snow
