// Distance along a path as a function of time: ease, constant speed, sampled motion profiles.
//
// Costs: O(n) to make, which allocates the pieces; O(log n) to ask, which allocates nothing. Immutable: any
// number of threads may share one.
#pragma once
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace motus::path {

/// Fraction of the path at fraction u of the time (clamped to [0, 1]): constant acceleration up to ease_in,
/// constant deceleration from 1 - ease_out. Throws std::invalid_argument if a fraction is outside [0, 1],
/// their sum is above 1 (by more than rounding), or a value is not finite.
[[nodiscard]] double ease(double u, double ease_in, double ease_out);

/// d ease / d u; 0 at an end with ease, and outside [0, 1].
[[nodiscard]] double ease_derivative(double u, double ease_in, double ease_out);

/// What follows after an eased motion. rest: it stays at the end. go_on: it keeps its last speed. repeat: the
/// motion begins again from where it has ended, so that the distance keeps growing.
enum class AfterEase { rest, go_on, repeat };

/// Distance as a function of time: seconds from the start, and the curve's unit of length. Value type,
/// immutable. distance(NaN) and speed(NaN) are NaN; far away a distance may be infinite.
///
/// Every factory throws std::invalid_argument if a value is not finite or outside the stated domain,
/// or a speed or a time that follows from the values overflows.
class Timing {
  public:
    /// `length` in `duration` seconds (> 0) with ease; at rest before time 0; later than `duration` as
    /// `after` says.
    [[nodiscard]] static Timing eased(double duration, double length, double ease_in, double ease_out,
                                      AfterEase after = AfterEase::rest);
    /// distance = speed * time, for all times.
    [[nodiscard]] static Timing constant(double speed);
    /// Monotone cubic through (time, distance) pins, times strictly increasing, >= 1 pin; at rest before and
    /// after. Between pins of equal distance the distance is constant. Fritsch and Carlson, "Monotone
    /// Piecewise Cubic Interpolation", SIAM J. Numer. Anal. 17 (1980); slopes by Fritsch and Butland's
    /// harmonic mean, SIAM J. Sci. Stat. Comput. 5 (1984).
    [[nodiscard]] static Timing pins(std::span<const double> times, std::span<const double> distances);
    /// Exact integral of a speed given at strictly increasing times (linear in between, held outside), 0 at
    /// time 0. A negative speed moves backwards.
    [[nodiscard]] static Timing speeds(std::span<const double> times, std::span<const double> speeds);
    /// Solution of ds/dt = v(s) for a speed > 0 given at strictly increasing distances (linear in between,
    /// held outside), distance 0 at time 0. Exact: exponentials between the samples.
    [[nodiscard]] static Timing speeds_by_distance(std::span<const double> distances,
                                                   std::span<const double> speeds);
    /// The same with speeds that come again each `lap` (> 0) of the way: linear also from the last sample of
    /// a lap to the first one of the next. The samples lie within one lap.
    [[nodiscard]] static Timing speeds_by_distance(std::span<const double> distances,
                                                   std::span<const double> speeds, double lap);

    ~Timing() = default;
    Timing(const Timing&) = default;
    Timing& operator=(const Timing&) = default;
    // An object that is moved from rests at distance 0. No alternative of the variant throws when it is
    // moved, so that the variant does not either; clang-tidy takes the check that libstdc++ makes of its
    // index for one that may. NOLINTBEGIN(bugprone-exception-escape)
    Timing(Timing&& other) noexcept : profile_(std::exchange(other.profile_, Eased{})) {}
    Timing& operator=(Timing&& other) noexcept {
        profile_ = std::exchange(other.profile_, Eased{});
        return *this;
    }
    // NOLINTEND(bugprone-exception-escape)

    [[nodiscard]] double distance(double time) const;
    /// d distance / d time; at a jump of the speed the speed after the jump.
    [[nodiscard]] double speed(double time) const;

  private:
    struct Eased {
        double duration = 1.0, length = 0.0, ease_in = 0.0, ease_out = 0.0;
        AfterEase after = AfterEase::rest;
        [[nodiscard]] double distance(double time) const;
        [[nodiscard]] double speed(double time) const;
    };

    /// distance = value + slope h + bend h^2 + twist h^3 with h the time since `time`.
    struct Cubic {
        double time, value, slope, bend, twist;
    };
    /// Piece i is valid from its time to the next piece's; the first piece also before, the last one also
    /// after.
    struct Cubics {
        std::vector<Cubic> pieces;
        [[nodiscard]] const Cubic& at(double time) const;
        [[nodiscard]] double distance(double time) const;
        [[nodiscard]] double speed(double time) const;
    };
    /// Throws std::invalid_argument if the numbers given were too far apart for the pieces to be finite.
    [[nodiscard]] static Cubics checked(Cubics cubics, const char* message);

    /// ds/dt = speed + growth (s - start) with s = start at `time`.
    struct Exponential {
        double time, start, speed, growth;
    };
    struct Exponentials {
        std::vector<Exponential> pieces;
        double lap_time =
            std::numeric_limits<double>::infinity();  // the pieces begin at time 0 if it is finite
        double lap = 0.0;                             // the way of it
        [[nodiscard]] const Exponential& at(double time) const;
        [[nodiscard]] double distance(double time) const;
        [[nodiscard]] double speed(double time) const;
    };

    using Profile = std::variant<Eased, Cubics, Exponentials>;
    explicit Timing(Profile profile);

    Profile profile_;
};

}  // namespace motus::path
