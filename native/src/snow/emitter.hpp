// The emitter's pose at any time, between samples of it. Private to the library.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "kernel.hpp"

namespace motus::snow {

/// Between samples locations and stretches change evenly, and rotations by an even turn the shorter way.
class Emitter {
  public:
    /// Throws std::invalid_argument where times do not rise, numbers differ or one is not finite.
    Emitter(std::span<const double> times, std::span<const glm::dmat4> matrices);

    /// Parts of the motion: before the first sample, between samples, after the last one.
    [[nodiscard]] std::size_t part_at(double time) const;
    /// When the part ends; infinity for the last one.
    [[nodiscard]] double end_of(std::size_t part) const;
    /// The pose over flakes of a part, born at `birth` at u = 0 and so much earlier at u = 1.
    [[nodiscard]] Glide glide(std::size_t part, double birth, double earlier) const;

  private:
    struct Pose {
        double time = 0.0;
        glm::dvec3 location{0.0};
        glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
        glm::dmat3 stretch{1.0};
    };
    struct Part {
        Glide glide;
        double start = 0.0;
        double length = 1.0;
    };
    [[nodiscard]] static Glide still(const Pose& pose);
    [[nodiscard]] static Glide between(const Pose& a, const Pose& b);

    std::vector<double> times_;
    std::vector<Part> parts_;
};

}  // namespace motus::snow
