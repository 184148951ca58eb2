// Second-order dynamics: an output y that follows an input x by  y + k1 y' + k2 y'' = x + k3 x'.
//
// Between two samples the input is taken as linear, for which the step is exact whatever its length: there is
// no limit of stability, and the frame rate matters only by how the input is sampled. Linear systems with
// constant coefficients: Hirsch, Smale, Devaney, "Differential Equations, Dynamical Systems" (3rd ed., 2013),
// ch. 6.
//
// Costs: O(1), some 100 steps of a search at most. Allocates nothing. Any number of threads at once.
#pragma once
namespace motus::dynamics {

/// The three numbers of the equation: k1 in s, k2 in s^2, k3 in s.
struct Coefficients {
    double k1 = 0.0;
    double k2 = 0.0;
    double k3 = 0.0;
};

/// How an output follows its input. Immutable; times in seconds.
class SecondOrder {
  public:
    /// frequency f: Hz, > 0. damping zeta: >= 0; 0 rings for ever, 1 is critical. response r: 0 starts
    /// slowly, up to 1 responds at once, above 1 overshoots, below 0 anticipates. k1 = zeta / (pi f), k2 = 1
    /// / (2 pi f)^2, k3 = r zeta / (2 pi f). Throws std::invalid_argument, naming the argument, if one is
    /// not finite, above 1e100 in size, or outside its domain.
    SecondOrder(double frequency, double damping, double response);

    /// k1 >= 0, k2 > 0, any k3. Throws as the constructor does.
    [[nodiscard]] static SecondOrder from_coefficients(const Coefficients& coefficients);

    /// A mass (kg, > 0) on a spring (stiffness, N/m, > 0) and a damper (resistance, N s/m, >= 0) whose other
    /// ends the input moves: y + (b/k) y' + (m/k) y'' = x + (b/k) x'. Throws as the
    /// constructor does.
    [[nodiscard]] static SecondOrder from_mass_spring(double mass, double stiffness, double resistance);

    /// The filter whose step response, with the given `response`, overshoots by `overshoot` (a fraction of
    /// the step, 0 < overshoot < 1) and stays within `tolerance` of its end after `settling` seconds (> 0).
    /// Throws std::invalid_argument for values outside these domains, and if no damping up to 100 gives
    /// that overshoot: response > 2 always overshoots by some.
    [[nodiscard]] static SecondOrder from_overshoot(double overshoot, double settling, double response = 0.0,
                                                    double tolerance = 0.02);

    [[nodiscard]] double frequency() const noexcept;  ///< f, Hz
    [[nodiscard]] double damping() const noexcept { return damping_; }
    /// r; 0 if damping is 0, since k3 is then 0 for every r (except a k3 that was given as a coefficient).
    [[nodiscard]] double response() const noexcept;
    [[nodiscard]] Coefficients coefficients() const noexcept;
    [[nodiscard]] double rate() const noexcept { return rate_; }  ///< 2 pi f, rad/s
    [[nodiscard]] double lead() const noexcept { return lead_; }  ///< k3, s

    [[nodiscard]] friend bool operator==(const SecondOrder&, const SecondOrder&) = default;

  private:
    struct Raw {};
    SecondOrder(Raw raw, double rate, double damping, double lead);

    double rate_;
    double damping_;
    double lead_;
};

/// Response to a unit step of the input at time 0, and its derivative (1/s). At 0 the value is 0 and the
/// derivative k3 / k2; before it both are 0.
struct Response {
    double value = 0.0;
    double derivative = 0.0;
};
[[nodiscard]] Response step_response(const SecondOrder& filter, double time);

/// The most by which the step response passes its final value, as a fraction of the step: 0 if it never does.
[[nodiscard]] double overshoot(const SecondOrder& filter);

/// Last time, s, at which the step response is further than `tolerance` (> 0, a fraction of the step) from
/// its final value; infinity if damping is 0.
[[nodiscard]] double settling_time(const SecondOrder& filter, double tolerance = 0.02);

/// The effect of one step of a given length on the state of one dimension, equal for all dimensions.
///
/// With xd the slope of the input, L = (k3 - k1) xd, e = y - x - L and u = y' - xd, the pair (e, u) is
/// multiplied by this matrix, which is exp(A h).
struct Step {
    double length = 0.0;  ///< h, s
    double lag = 0.0;     ///< k3 - k1, s
    double ee = 1.0, eu = 0.0, ue = 0.0, uu = 1.0;
};
/// length: s, >= 0. Throws std::invalid_argument if it is not, or not finite.
[[nodiscard]] Step make_step(const SecondOrder& filter, double length);

}  // namespace motus::dynamics
