// What flakes land on that goes from place to place, at any time. Private to the library.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "motus/snow/collider.hpp"
#include "motus/snow/snow.hpp"

namespace motus::snow {

class Movers {
  public:
    /// Throws std::invalid_argument, naming movers, where times do not rise, numbers differ or one is not
    /// finite.
    explicit Movers(std::vector<Mover> movers);

    [[nodiscard]] bool are_any() const noexcept { return !movers_.empty(); }

    /// To world space.
    [[nodiscard]] glm::dmat4 matrix(std::size_t mover, double time) const;
    /// The derivative of that by the time.
    [[nodiscard]] glm::dmat4 rate(std::size_t mover, double time) const;
    [[nodiscard]] glm::dquat rotation(std::size_t mover, double time) const;

    /// From world space to that of each mover, at a time.
    class Spaces {
      public:
        void set(const Movers& movers, double time);
        [[nodiscard]] glm::dvec3 local(std::size_t mover, const glm::dvec3& place) const {
            const glm::dvec4 found = inverses_[mover] * glm::dvec4(place, 1.0);
            return {found.x, found.y, found.z};
        }

      private:
        std::vector<glm::dmat4> inverses_;
    };

    struct Hit {
        std::size_t mover = 0;
        double part = 0.0;       ///< of the way
        glm::dvec3 point{0.0};   ///< in the mover's space, like
        glm::dvec3 normal{0.0};  ///< unit
    };
    /// What the straight way from one place to another, while the movers go from their spaces at its start to
    /// those at its end, meets first.
    [[nodiscard]] std::optional<Hit> first_hit(const glm::dvec3& start, const Spaces& at_start,
                                               const glm::dvec3& end, const Spaces& at_end) const;

  private:
    /// Number of the sample at which the part of the motion starts, and how far the time is in it, in [0, 1].
    struct Part {
        std::size_t sample = 0;
        double share = 0.0;
        double length = 0.0;  ///< s; 0 where nothing moves
    };
    [[nodiscard]] Part part_at(std::size_t mover, double time) const;

    std::vector<Mover> movers_;
};

}  // namespace motus::snow
