// What a strand is made of, and what moves it: chains of particles and links that hang, swing and touch, such
// as tails, ropes, hair and strips of cloth.
//
// Costs: none, these are values.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"
#include "motus/mesh/picker.hpp"

namespace motus::strand {

/// A particle, and the link from its parent to it. The link's rest length at each time is the distance of
/// both particles in the pose.
struct Link {
    int parent = -1;         ///< index of a particle before this one; -1: a root, which stays on the pose
    double mass = 1.0;       ///< kg, (0, 1e12]; counts as at least a thousandth of the strand's heaviest
    double frequency = 0.0;  ///< Hz, 0 to an eighth of the rate: of the spring towards the pose; 0: none
    double damping = 0.3;    ///< damping ratio of that spring, [0, 100]
    double response = 0.0;   ///< of that spring, [-100, 100], as SecondOrder's: 0 damps the velocity, 2 the
                             ///< velocity relative to the pose
    double drag = 0.0;       ///< 1/s, [0, 1000], deceleration a velocity relative to the air
    double stretch = 0.0;    ///< strain of the link under its own particle's weight (at 9.80665 m/s^2), [0,
                             ///< 1e6]; 0: rigid
    /// Hz, 0 to an eighth of the rate: of a spring, with `damping`, that keeps the pose's angle to the
    /// parent's link; 0: none. Not of links that hang on a root.
    double bend_frequency = 0.0;
    double bend = std::numbers::pi;  ///< rad, [0, pi], largest angle between the link and the direction that
                                     ///< it would have if it kept the pose's angle to its parent's link
    double thickness = 0.0;          ///< m, [0, 1e6], radius of the link and its particle in contacts
    /// rad, [0, pi], largest angle towards the link's side or away from it, where that is less than `bend`;
    /// the limit between is an ellipse. Without Inputs::sides it does not count.
    double side_bend = std::numbers::pi;
    double gravity_factor = 1.0;  ///< [-1000, 1000], how many times Inputs::gravity pulls the particle
};

/// A solid that strands cannot enter, given by two points at each time.
struct Obstacle {
    enum class Shape : std::uint8_t {
        capsule,  ///< around the segment between both places, a ball if these are one
        plane,    ///< through the first place; solid on the side away from the second one
    };
    Shape shape = Shape::capsule;
    double radius = 0.0;    ///< m, [0, 1e6], of a capsule; added to the plane's height
    double friction = 0.5;  ///< Coulomb's coefficient, [0, 100]
};

/// An immutable mesh that strands cannot go through, from either side, in a space of its own. It can be moved
/// but not copied.
class Surface {
  public:
    /// Throws std::invalid_argument as mesh::Picker does. `executor` works for the constructor alone.
    Surface(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
            const Executor& executor = {});

    [[nodiscard]] const mesh::Picker& picker() const noexcept { return picker_; }
    [[nodiscard]] std::span<const glm::vec3> positions() const noexcept { return positions_; }
    /// Size of the memory in use, roughly.
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    mesh::Picker picker_;
    std::vector<glm::vec3> positions_;
};

/// A surface in a shot. Particles, and the middles of links, keep away from it.
struct PlacedSurface {
    std::shared_ptr<const Surface> surface;
    double distance = 0.0;  ///< m, [0, 1e6], added to the strand's thickness; both together are 1e-5 at least
    double friction = 0.5;  ///< Coulomb's coefficient, [0, 100]
};

/// Everything over time, in world space, metres and seconds, coordinates at most 1e9 in size; linear between
/// the times, and as at the nearest time outside them.
struct Inputs {
    std::span<const double> times;          ///< strictly rising
    std::span<const glm::dvec3> poses;      ///< where the pose has the particles: a row for each time
    std::span<const glm::dvec3> gravity{};  ///< acceleration: one, or one for each time; none: 0
    std::span<const glm::dvec3> air{};      ///< its velocity: one, or one for each time; none: 0

    std::span<const Obstacle> obstacles{};
    std::span<const glm::dvec3> obstacle_places{};  ///< two for each obstacle: a row for each time

    std::span<const PlacedSurface> surfaces{};
    /// To world space: turn, move and evenly scale by [1e-6, 1e6], may mirror; the last row is not read. A
    /// row of all surfaces for each time.
    std::span<const glm::dmat4> surface_matrices{};

    std::span<const std::size_t> pinned{};     ///< indices of particles that are held, each at most once
    std::span<const glm::dvec3> pin_places{};  ///< where they are held: a row for each time
    /// [0, 1], a row for each time. 1: the particle is at the pin. Below 1: a critically damped spring,
    /// softer for smaller weights; a root is between the pose and the pin. 0: no pin.
    std::span<const double> pin_weights{};
    std::span<const std::size_t> resets{};  ///< rising indices of times, not the first, at which all starts
                                            ///< anew, such as cuts
    /// Where the sides of links point in the pose, with any length: a row for each time. What of a side is
    /// along its link does not count; a link without a side has none of `side_bend`.
    std::span<const glm::dvec3> sides{};
    /// Whether links keep away from each other, by the thicknesses of both, or as far as they are apart in
    /// the first pose if that is less. Links that hang on each other do not, and each with 64 others at most.
    bool are_touching = false;
    double friction = 0.5;  ///< Coulomb's coefficient of links with each other, [0, 100]
};

}  // namespace motus::strand
