#include "motus/dynamics/spherical_pendulum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "motion_cache.hpp"
#include "motus/core/ieee_floats.hpp"
#include "motus/core/sine.hpp"
#include "units.hpp"

namespace motus::dynamics {
namespace {

void require_valid(const SphericalStart& start) {
    require(is_angle(start.angle), "angle: must be finite, and 1e9 at most");
    require(is_angle(start.heading), "heading: must be finite, and 1e9 at most");
    require(std::isfinite(start.velocity), "velocity: must be finite");
    require(std::isfinite(start.across), "across: must be finite");
}

[[nodiscard]] MotionSettings<SphericalSystem> settings_of(const Pendulum& pendulum,
                                                          const SphericalStart& start, const TimeUnit& unit) {
    const SineCosine<double> angle = sine_cosine(start.angle);
    const SineCosine<double> heading = sine_cosine(start.heading);
    const glm::dvec3 outward{heading.cosine, heading.sine, 0.0};
    const glm::dvec3 aside{-heading.sine, heading.cosine, 0.0};
    const glm::dvec3 up{0.0, 0.0, 1.0};
    const glm::dvec3 direction = angle.sine * outward - angle.cosine * up;
    const double along = unit.from_rate(start.velocity);
    const double across = unit.from_rate(start.across);
    const glm::dvec3 velocity = along * (angle.cosine * outward + angle.sine * up) + across * aside;
    MotionSettings<SphericalSystem> settings;
    settings.system = {unit.gravity, unit.from_rate(pendulum.damping)};
    settings.start = {direction.x, direction.y, direction.z, velocity.x, velocity.y, velocity.z};
    settings.interval = interval_for(std::max(std::abs(along), std::abs(across)));
    return settings;
}

[[nodiscard]] SphericalState state_of(const std::array<double, 6>& values, const TimeUnit& unit) {
    const glm::dvec3 place{values[0], values[1], values[2]};
    return {place / std::sqrt(glm::dot(place, place)),
            {unit.to_rate(values[3]), unit.to_rate(values[4]), unit.to_rate(values[5])}};
}

void integrate(const Pendulum& pendulum, const SphericalStart& start, const PivotMotion* pivot,
               std::span<const double> times, std::span<SphericalState> out) {
    dynamics::require_valid(pendulum);
    require_valid(start);
    require(are_finite(times), "times: must be finite");
    require(times.size() == out.size(), "out: must have a state for each time");
    in_ieee_floats([&] {
        const TimeUnit unit(pendulum.length, pendulum.gravity);
        MotionSettings<SphericalSystem> settings = settings_of(pendulum, start, unit);
        if (pivot != nullptr) drive(settings, *pivot, unit, pendulum.length);
        Motion<SphericalSystem> motion(std::move(settings));
        // Nothing is written before all states are known, since any of the times may have none.
        std::vector<SphericalState> states;
        states.reserve(times.size());
        for (const double time : times) states.push_back(state_of(motion.at(unit.from_seconds(time)), unit));
        std::ranges::copy(states, out.begin());
    });
}

}  // namespace

void spherical_pendulum(const Pendulum& pendulum, const SphericalStart& start, std::span<const double> times,
                        std::span<SphericalState> out) {
    integrate(pendulum, start, nullptr, times, out);
}

void spherical_pendulum(const Pendulum& pendulum, const SphericalStart& start, const PivotMotion& pivot,
                        std::span<const double> times, std::span<SphericalState> out) {
    integrate(pendulum, start, &pivot, times, out);
}

}  // namespace motus::dynamics
