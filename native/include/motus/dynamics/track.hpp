// Outputs of second-order dynamics for sampled inputs, at any time and in any order.
//
// Costs: O(n) to make a track, which allocates it; O(log n) to evaluate one, which allocates nothing.
// Immutable: any number of threads may share one.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/dynamics/second_order.hpp"

namespace motus::dynamics {

/// The input before its first sample.
enum class Start {
    at_rest,  ///< the output rests on the first sample
    loop,     ///< the samples are one cycle of an endless motion; the last sample is the first of the next
              ///< cycle, and each cycle is offset by the difference between the last sample and the first
};

/// An output of any number of dimensions. Holds the state at each sample of the input, from which one exact
/// step leads to any time. Immutable.
class Track {
  public:
    /// times: s, strictly rising. inputs: row by row, times.size() * dimensions; linear between samples.
    /// resets: rising indices of samples to which the input jumps (teleports): until then it keeps its
    /// value, and at the jump the output starts anew, at rest on the input.
    /// Throws std::invalid_argument, naming the argument, if sizes do not fit, times do not rise, a number
    /// is not finite, or there is no sample; with Start::loop if there are resets or less than 2 samples,
    /// if damping is 0 and the cycle is a whole number of periods long, for which no closed motion exists;
    /// and if inputs are so large, or change so fast, that outputs could overflow.
    Track(const SecondOrder& filter, std::span<const double> times, std::span<const double> inputs,
          std::size_t dimensions, std::span<const std::size_t> resets = {}, Start start = Start::at_rest);

    [[nodiscard]] std::size_t dimensions() const noexcept { return dimensions_; }

    /// Output at a time, dimensions() values. After the last sample the input rests there, unless it loops.
    /// A loop whose cycles add up is followed up to 1e308, beyond which numbers end.
    void evaluate(double time, std::span<double> out) const;
    /// Output at a time, and its derivative by time, 1/s.
    void evaluate(double time, std::span<double> out, std::span<double> velocity) const;
    /// The output less the input at a time: exactly 0 if the input has never moved.
    void offset(double time, std::span<double> out) const;
    /// Outputs at the samples, row by row.
    void outputs(std::span<double> out) const;
    /// Size of the memory in use.
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    void run();
    void close_loop();
    /// Calls visit(dimension, input, offset, velocity) of each dimension at a time.
    template <class Visit>
    void at(double time, const Visit& visit) const;
    [[nodiscard]] double* state(std::size_t sample) { return states_.data() + 2 * dimensions_ * sample; }
    [[nodiscard]] const double* state(std::size_t sample) const {
        return states_.data() + 2 * dimensions_ * sample;
    }

    SecondOrder filter_;
    std::size_t dimensions_;
    std::vector<double> times_;
    std::vector<double> inputs_;
    std::vector<std::size_t> resets_;
    std::vector<double> states_;  ///< of each sample: the output less the input, then the output's derivative
    bool is_loop_;
};

/// Outputs at the samples alone, written to `out`, of the size of `inputs`, which it may be. Allocates
/// nothing. Arguments and errors as Track's, at rest at first.
void second_order(const SecondOrder& filter, std::span<const double> times, std::span<const double> inputs,
                  std::size_t dimensions, std::span<double> out);

/// Rotations that follow rotations. The output is the input turned by a rotation vector, and this is filtered
/// in the tangent space of the input, which is carried along the shortest way from sample to sample. About
/// one fixed axis it is the filter of the angle. Immutable.
class RotationTrack {
  public:
    /// inputs: unit quaternions, one for each time; each is taken the shorter way from the one before (q and
    /// -q are the same rotation). Other arguments, and errors, as Track's; with Start::loop the last input
    /// has to be the first one again.
    RotationTrack(const SecondOrder& filter, std::span<const double> times,
                  std::span<const glm::dquat> inputs, std::span<const std::size_t> resets = {},
                  Start start = Start::at_rest);

    [[nodiscard]] glm::dquat evaluate(double time) const;
    /// The turn from the input to the output at a time, in the input's own frame: input * turn is the output,
    /// and exactly no turn if the input has never moved.
    [[nodiscard]] glm::dquat offset(double time) const;
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    /// In the body frame of the input: the rotation vector from input to output, and the output's angular
    /// velocity, 1/s.
    struct State {
        glm::dvec3 offset{0.0};
        glm::dvec3 velocity{0.0};
    };
    /// The state so many seconds after a sample, by the step of that length.
    [[nodiscard]] State advanced(std::size_t sample, double seconds, const Step& step) const;
    [[nodiscard]] glm::dvec3 offset_after(std::size_t sample, double seconds) const;
    void run();
    void close_loop();

    SecondOrder filter_;
    std::vector<double> times_;
    std::vector<glm::dquat> inputs_;
    std::vector<glm::dvec3> turns_;  ///< from each input to the next one, in its body frame; none to a reset
    std::vector<bool> is_reset_;
    std::vector<State> states_;
    bool is_loop_;
};

}  // namespace motus::dynamics
