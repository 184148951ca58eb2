// The body's pose over a shot, and the phase of its legs' cycles (a gait phase track).
//
// Costs: O(samples legs) to make, which allocates it; O(log samples) to ask, which allocates nothing.
// Immutable: any number of threads may share one.
#pragma once
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/numeric.hpp"

namespace motus::walker {

inline constexpr std::size_t most_samples = 100'000;

/// A change of the gait at a sample: from there on legs go over to it.
struct GaitChange {
    std::size_t sample = 0;
    std::vector<double> phases{};  ///< of a cycle, any: one for each leg
    double duty = 0.5;             ///< [least_duty, most_duty]
};

/// The body's sampled motion, and the settings of the gait by which legs keep up with it.
struct Way {
    std::vector<double> times;      ///< s, strictly rising, 1 to most_samples
    std::vector<glm::dmat4> poses;  ///< of the body in the world at these times, of any scale, also mirrored
    std::vector<glm::dvec3> rest;   ///< where each foot stands when the body rests, in the body's space
    std::vector<double> phases;     ///< of a cycle, any; a leg swings while frac(cycle + phase) < 1 - duty
    double duty = 0.5;              ///< part of a cycle during which a foot stands, [least_duty, most_duty]
    /// m, most that the body moves while a foot stands, [1e-6, 1e6]. From touch to touch it moves 1 / duty of
    /// that, which is natural_stride().
    double stride = 0.5;
    double cadence = 1.0;          ///< cycles a second when the body moves slowly or rests, [1e-3, 1e3]
    glm::dvec3 up{0.0, 0.0, 1.0};  ///< in the body's space, not 0
    /// Rising indices of samples to which the body jumps; until then it keeps its place.
    std::vector<std::size_t> resets;
    /// m, > 0: the body also jumps if a foot's rest place moves further from one sample to the next. None: 4
    /// strides; with `hip_height` those of a body whose Froude number is 1, 9.2 hip heights times the duty.
    std::optional<double> jump;
    /// In the order of their samples. All legs may go over to a gait earlier or later alike, so that none
    /// goes over by more of a cycle than is needed.
    std::vector<GaitChange> changes{};
    double transition = 1.0;  ///< cycles, [1, 1000], for which legs go over to a gait
    /// m, [0, 1e6]: above 0 a foot stands for its duty's share of the natural_stride() of hips of this
    /// height, in place of `stride`; never for less than 1e-6 m.
    double hip_height = 0.0;
    /// At the samples, in place of `stride`, `cadence`, and the duty of all gaits: one for each, or none.
    std::vector<double> strides{}, cadences{}, duties{};
};

/// Orthonormal vectors in the world that turn with the body.
struct Axes {
    glm::dvec3 side{1.0, 0.0, 0.0};
    glm::dvec3 ahead{0.0, 1.0, 0.0};
    glm::dvec3 up{0.0, 0.0, 1.0};
};

/// The body's motion, divided into stretches between jumps. In each the phase is the integral of the cadence,
/// from 0 at the first sample on; from a sample to the next the cadence is max(cadence, duty * speed /
/// stride) of the first of the two, with the speed of the leg whose rest place moves fastest across `up`.
/// Immutable.
class BodyTrajectory {
  public:
    /// Throws std::invalid_argument, naming the argument, if sizes differ, a number is not finite, larger
    /// than 1e12 or outside its domain, times are less than 1e-12 s apart, resets do not rise, or there are
    /// more samples or legs than may be.
    explicit BodyTrajectory(Way way);

    [[nodiscard]] const Way& way() const noexcept { return way_; }
    [[nodiscard]] std::size_t stretch_count() const noexcept { return starts_.size(); }
    /// The stretch that a time belongs to.
    [[nodiscard]] std::size_t stretch_at(double time) const;
    /// The first samples of all stretches.
    [[nodiscard]] std::span<const std::size_t> starts() const noexcept { return starts_; }
    /// Of an existing stretch, else std::invalid_argument, as in all functions below.
    [[nodiscard]] std::size_t first_sample(std::size_t stretch) const {
        require_stretch(stretch);
        return starts_[stretch];
    }
    [[nodiscard]] std::size_t last_sample(std::size_t stretch) const {
        require_stretch(stretch);
        return (stretch + 1 < starts_.size() ? starts_[stretch + 1] : way_.times.size()) - 1;
    }

    /// Directions of the axes, their lengths and the location are interpolated between samples. Before the
    /// first sample of a stretch the body moves straight on at its first velocity, or rests if that is slow;
    /// after the last sample it rests.
    [[nodiscard]] glm::dmat4 pose(std::size_t stretch, double time) const;
    /// Before the first sample the phase grows at the cadence there, after the last one at the slowest
    /// cadence.
    [[nodiscard]] double phase(std::size_t stretch, double time) const;
    /// The time at which the phase has this value.
    [[nodiscard]] double time_at(std::size_t stretch, double phase) const;
    [[nodiscard]] double last_phase(std::size_t stretch) const { return phases_[last_sample(stretch)]; }
    /// The own phase of a leg at the first sample, [0, 1). The leg is one of the way's, else
    /// std::invalid_argument, as in cycles() and time_after().
    [[nodiscard]] double first_phase(std::size_t stretch, std::size_t leg) const;
    /// The cycles that a leg goes through since the first sample: the phase, and by how much the leg's own
    /// one has changed with the gait. It swings whenever first_phase() and these are a whole number.
    [[nodiscard]] double cycles(std::size_t stretch, std::size_t leg, double time) const;
    /// The time at which cycles() has this value.
    [[nodiscard]] double time_after(std::size_t stretch, std::size_t leg, double cycles) const;
    /// Part of a cycle during which a foot stands that lifts at a time: that of the sample before it.
    [[nodiscard]] double duty(std::size_t stretch, double time) const;
    /// That of the sample before a time.
    [[nodiscard]] double stride(std::size_t stretch, double time) const;
    /// Whether a stretch begins at the slowest cadence.
    [[nodiscard]] bool starts_slowly(std::size_t stretch) const;

    /// Axes of a pose; the world's own up if the pose has no extent along up.
    [[nodiscard]] Axes axes(const glm::dmat4& pose) const;
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    void require_stretch(std::size_t stretch) const {
        require(stretch < starts_.size(),
                "stretch: must be one of the trajectory, which is not one moved from");
    }
    void require_leg(std::size_t leg) const {
        require(leg < way_.rest.size(), "leg: must be one of the way's");
    }
    /// The stride that is set.
    [[nodiscard]] double set_stride(std::size_t sample) const {
        return way_.strides.empty() ? way_.stride : way_.strides[sample];
    }
    [[nodiscard]] double stride_at(std::size_t sample) const {
        return strides_.empty() ? set_stride(sample) : strides_[sample];
    }
    [[nodiscard]] double cadence_at(std::size_t sample) const {
        return way_.cadences.empty() ? way_.cadence : way_.cadences[sample];
    }
    [[nodiscard]] double duty_at(std::size_t sample) const {
        return duties_.empty() ? way_.duty : duties_[sample];
    }
    /// A leg's own phase at a sample.
    [[nodiscard]] double own(std::size_t sample, std::size_t leg) const {
        return own_.empty() ? way_.phases[leg] : own_[sample * way_.rest.size() + leg];
    }
    [[nodiscard]] bool jumps_to(std::size_t sample) const;
    /// m/s, from a sample to the next one, of the leg whose rest place moves fastest across `up`.
    [[nodiscard]] double speed_after(std::size_t sample) const;
    [[nodiscard]] double natural_after(std::size_t sample) const;
    [[nodiscard]] double cadence_after(std::size_t sample) const;
    [[nodiscard]] std::size_t sample_before(std::size_t stretch, double time) const;
    /// Cycles a second from a sample to the next of its stretch; the slowest cadence if there is no next one.
    [[nodiscard]] double rate(std::size_t sample, std::size_t last) const;

    Way way_;
    glm::dvec3 side_;  ///< an axis of the body's space across `up`
    std::vector<std::size_t> starts_;
    std::vector<double> phases_;     ///< at the samples
    std::vector<double> own_{};      ///< of the legs at each sample; none if they stay
    std::vector<double> duties_{};   ///< at the samples; none if it stays
    std::vector<double> strides_{};  ///< at the samples; none if they are set
};

/// A point of the body's space in the world.
[[nodiscard]] inline glm::dvec3 in_world(const glm::dmat4& pose, const glm::dvec3& point) {
    return glm::dvec3(pose[0]) * point.x + glm::dvec3(pose[1]) * point.y + glm::dvec3(pose[2]) * point.z +
           glm::dvec3(pose[3]);
}

}  // namespace motus::walker
