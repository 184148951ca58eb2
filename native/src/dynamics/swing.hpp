// The undamped single pendulum in closed form. Private to the library.
#pragma once
#include "motus/dynamics/pendulum.hpp"

namespace motus::dynamics {

/// Everything about a motion that does not depend on the time.
class Swing {
  public:
    /// pendulum: valid; its damping is not looked at.
    Swing(const Pendulum& pendulum, const PendulumState& start);

    [[nodiscard]] PendulumState at(double time) const;
    [[nodiscard]] double period() const;

  private:
    enum class Kind {
        drifts,   ///< without gravity that matters, or at rest hanging or upright
        swings,   ///< back and forth
        rotates,  ///< over the top, again and again; or just up to it
    };

    Kind kind_ = Kind::drifts;
    PendulumState start_;
    double rate_ = 0.0;        ///< of the elliptic functions' argument, rad/s
    double modulus_ = 0.0;     ///< of the elliptic functions
    double complement_ = 1.0;  ///< sqrt(1 - modulus^2)
    double phase_ = 0.0;       ///< argument at time 0
    double quarter_ = 0.0;     ///< K
    double turns_ = 0.0;       ///< rad: the angle about which all this is
    double side_ = 1.0;        ///< -1: rotates clockwise
};

}  // namespace motus::dynamics
