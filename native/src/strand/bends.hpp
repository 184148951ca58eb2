// Holds the angles between links within their limits. Private to the library.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/strand/strand.hpp"
#include "state.hpp"

namespace motus::strand {

class Bends {
  public:
    explicit Bends(std::span<const Link> links);

    /// Turns links that are bent too far, from the roots to the tips, together with the links they hang on,
    /// and takes away the speed at which they bend farther. Lengths stay. pose, sides: of all particles at
    /// the step's end; there may be no sides.
    void hold(const Stepped& step, std::span<const glm::dvec3> pose, std::span<const glm::dvec3> sides);

  private:
    template <class Visit>
    void visit(const Stepped& step, std::span<const glm::dvec3> pose, std::span<const std::size_t> links,
               const Visit& visit);
    [[nodiscard]] bool straighten(const Stepped& step, std::size_t particle, const glm::dvec3& straight);
    void lay(const Stepped& step, std::span<const glm::dvec3> pose);
    [[nodiscard]] double most(std::size_t particle, const glm::dvec3& straight, const glm::dvec3& axis) const;

    std::vector<int> parents_;
    std::vector<double> most_, most_sideways_;  ///< angles
    std::span<const glm::dvec3> sides_;         ///< in the pose, within hold()
    std::vector<glm::dquat> turns_;             ///< of each link, from where the pose has it
    std::vector<char> is_moved_;
    std::vector<double> lengths_;       ///< before links are turned
    std::vector<std::size_t> order_;    ///< of links, parents first
    std::vector<std::size_t> limited_;  ///< the same, of those up to the last one with a limit
};

}  // namespace motus::strand
