// What drag, gravity and wind do to a flake by its age, at one time for all. Private to the library.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "kernel.hpp"
#include "motus/noise/gusts.hpp"

namespace motus::snow {

/// After an age a with drag k: e^{-ka}, the integral of that from 0 to a, the integral of the latter, and the
/// integral of that.
struct Relaxation {
    double decay = 1.0;
    double first = 0.0;
    double second = 0.0;
    double third = 0.0;
};
[[nodiscard]] Relaxation relaxation(double age, double drag);

/// Solves c' = g + k (W(t) - c), c = 0 at birth, with W(t) = wind (1 + gusts n(t)), n that of
/// noise::Gusts. The wind is one for all times, or goes evenly from key to key. With keys c = F(t) - e^{-ka}
/// F(birth), F a solution for all times, which is known at each key, and so is its integral.
class Air {
  public:
    /// period: of the gusts, s, 0 for none, as noise::Gusts has it.
    Air(const glm::dvec3& acceleration, double drag, const glm::dvec3& wind, double gusts, double frequency,
        double period = 0.0);
    /// times: rising, one for each wind; held before the first and after the last.
    Air(const glm::dvec3& acceleration, double drag, std::span<const double> times,
        std::span<const glm::dvec3> winds, double gusts, double frequency, double period = 0.0);

    /// n, from -1 to 1.
    [[nodiscard]] double gust(double time) const;

    /// At `time`, of flakes of an age: the way since birth and the velocity c, and how both grow with the
    /// age.
    struct State {
        glm::dvec3 way{0.0}, way_slope{0.0};
        glm::dvec3 velocity{0.0}, velocity_slope{0.0};
        Relaxation relaxation;
    };
    [[nodiscard]] State at(double time, double age) const { return at(time, age, relaxation(age, drag_)); }
    /// The same by what relaxation() gives for the age.
    [[nodiscard]] State at(double time, double age, const Relaxation& r) const;

  private:
    struct Gusts {
        double value = 0.0;     ///< n
        double integral = 0.0;  ///< of n
        double relaxed = 0.0;   ///< b with b' = n - k b
    };
    [[nodiscard]] Gusts gusts_at(double time) const;

    /// F, its integral, and the wind with its gusts.
    struct Flow {
        glm::dvec3 velocity{0.0}, way{0.0}, wind{0.0};
    };
    /// Wind that changes evenly from a time on.
    struct Key {
        double time = 0.0;
        glm::dvec3 wind{0.0}, slope{0.0};
        Flow flow;        ///< of the wind without gusts
        Flow gusty;       ///< of gusts, at the key by all that was before,
        Flow gusty_base;  ///< and by what these gusts alone would have it
    };
    [[nodiscard]] Flow flow_at(double time) const;
    [[nodiscard]] Flow steady_flow(const Key& key, double time) const;
    [[nodiscard]] Flow gusty_flow(const Key& key, double time) const;
    [[nodiscard]] Flow gusty_formula(const Key& key, double time) const;

    glm::dvec3 steady_;  ///< g + k W
    double drag_;
    glm::dvec3 gusty_;  ///< wind times gusts
    noise::Gusts waves_;
    double gusts_ = 0.0;
    std::vector<Key> keys_;
};

}  // namespace motus::snow
