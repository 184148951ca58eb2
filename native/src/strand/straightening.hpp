// Springs between links that follow each other, which keep the bend that they have in the pose. Private to
// the library.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/strand/strand.hpp"
#include "state.hpp"

namespace motus::strand {

class Straightening {
  public:
    /// masses: of the particles as they count, kg.
    Straightening(std::span<const Link> links, std::span<const double> masses);

    /// Draws each link, from the roots to the tips, to where it would be if it followed its parent's link as
    /// in the pose; the parent's link is drawn the other way. pose: of all particles at the step's end.
    /// duration: of the step, s.
    void hold(const Stepped& step, std::span<const glm::dvec3> pose, std::span<const double> lengths,
              double duration) const;

  private:
    /// A particle, its parent and its parent's parent.
    struct Joint {
        std::size_t particle = 0, parent = 0, above = 0;
        double stiffness = 0.0;   ///< N/m, of the particle to where it would be
        double resistance = 0.0;  ///< N s/m
    };
    std::vector<Joint> joints_;
};

}  // namespace motus::strand
