// What drag, gravity and wind do to a flake by its age, at one time for all. Private to the library.
#pragma once
#include <array>
#include <glm/vec3.hpp>

#include "kernel.hpp"

namespace motus::snow {

/// After an age a with drag k: e^{-ka}, the integral of that from 0 to a, and the integral of the latter.
struct Relaxation {
    double decay = 1.0;
    double first = 0.0;
    double second = 0.0;
};
[[nodiscard]] Relaxation relaxation(double age, double drag);

/// Solves c' = g + k (W(t) - c), c = 0 at birth, with W(t) = wind (1 + gusts n(t)), n a sum of sines.
class Air {
  public:
    Air(const glm::dvec3& acceleration, double drag, const glm::dvec3& wind, double gusts, double frequency);

    /// n, from -1 to 1.
    [[nodiscard]] double gust(double time) const;

    /// At `time`, of flakes of an age: the way since birth and the velocity c, and how both grow with the
    /// age.
    struct State {
        glm::dvec3 way{0.0}, way_slope{0.0};
        glm::dvec3 velocity{0.0}, velocity_slope{0.0};
        Relaxation relaxation;
    };
    [[nodiscard]] State at(double time, double age) const;

  private:
    static constexpr std::size_t waves = 4;
    struct Wave {
        double height = 0.0;
        double rate = 0.0;  ///< rad/s
        double phase = 0.0;
    };
    struct Gusts {
        double value = 0.0;     ///< n
        double integral = 0.0;  ///< of n
        double relaxed = 0.0;   ///< b with b' = n - k b
    };
    [[nodiscard]] Gusts gusts_at(double time) const;

    glm::dvec3 steady_;  ///< g + k W
    double drag_;
    glm::dvec3 gusty_;  ///< wind times gusts
    std::array<Wave, waves> waves_{};
};

}  // namespace motus::snow
