#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

#include "motus/dynamics/track.hpp"
#include "samples.hpp"

namespace motus::dynamics {
namespace {

/// Rotation vector of a unit quaternion, the shorter way.
[[nodiscard]] glm::dvec3 rotation_vector(const glm::dquat& turn) {
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    const double cosine = std::abs(turn.w);
    const double scale = sine > 0.0 ? 2.0 * std::atan2(sine, cosine) / sine : 2.0;
    return axis * (turn.w < 0.0 ? -scale : scale);
}

[[nodiscard]] glm::dquat rotation(const glm::dvec3& vector) {
    const double half = 0.5 * glm::length(vector);
    const double scale = half > 0.0 ? 0.5 * std::sin(half) / half : 0.5;
    return {std::cos(half), scale * vector.x, scale * vector.y, scale * vector.z};
}

constexpr std::size_t size = 6;  // of a state: two vectors
using Row = std::array<double, size + 1>;

/// Solves the rows' equations, the last number of each being the right side; false if they have no one
/// solution.
[[nodiscard]] bool solve(std::array<Row, size>& rows) {
    constexpr double lost = 1e-12;
    for (std::size_t column = 0; column < size; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column + 1; row < size; ++row)
            if (std::abs(rows[row][column]) > std::abs(rows[pivot][column])) pivot = row;
        if (std::abs(rows[pivot][column]) < lost) return false;
        std::swap(rows[column], rows[pivot]);
        for (std::size_t row = 0; row < size; ++row) {
            const double share = rows[row][column] / rows[column][column];
            for (std::size_t i = column; row != column && i <= size; ++i)
                rows[row][i] -= share * rows[column][i];
        }
    }
    for (std::size_t row = 0; row < size; ++row) rows[row][size] /= rows[row][row];
    return true;
}

}  // namespace

RotationTrack::RotationTrack(const SecondOrder& filter, std::span<const double> times,
                             std::span<const glm::dquat> inputs, std::span<const std::size_t> resets,
                             Start start)
    : filter_(filter), is_loop_(start == Start::loop) {
    require_times(times);
    require_start(times, resets, start);
    require(inputs.size() == times.size(), "inputs: must have a rotation for each time");
    constexpr double rounding = 1e-4;  // of rotations in single precision, and a little more
    require(std::ranges::all_of(
                inputs, [](const glm::dquat& q) { return std::abs(glm::dot(q, q) - 1.0) < rounding; }),
            "inputs: must be unit quaternions");
    times_.assign(times.begin(), times.end());
    for (const glm::dquat& input : inputs) inputs_.push_back(glm::normalize(input));
    turns_.resize(times.size());
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        if (!std::ranges::binary_search(resets, k + 1))
            turns_[k] = rotation_vector(glm::conjugate(inputs_[k]) * inputs_[k + 1]);
    }
    is_reset_.resize(times.size());
    for (const std::size_t reset : resets) is_reset_[reset] = true;
    double slope = 0.0;
    for (std::size_t k = 0; k + 1 < times.size(); ++k)
        slope = std::max(slope, glm::length(turns_[k]) / (times[k + 1] - times[k]));
    require_bounded(filter, times, slope, 1.0);
    states_.resize(times.size());
    run();
    if (is_loop_) close_loop();
}

RotationTrack::State RotationTrack::advanced(std::size_t sample, double seconds, const Step& step) const {
    const glm::dvec3 slope =
        sample + 1 < times_.size() ? turns_[sample] / (times_[sample + 1] - times_[sample]) : glm::dvec3(0.0);
    State state = states_[sample];
    advance(step, slope, state.offset, state.velocity);
    // Vectors that are carried along a turn without turning about it themselves turn back by half of it, as
    // seen in the body frame.
    const glm::dquat carried = rotation(slope * (-0.5 * seconds));
    return {carried * state.offset, carried * state.velocity};
}

void RotationTrack::run() {
    Steps steps(filter_);
    for (std::size_t k = 1; k < times_.size(); ++k) {
        const double seconds = times_[k] - times_[k - 1];
        states_[k] =
            is_reset_[k] ? State{} : advanced(k - 1, seconds, steps.between(times_[k - 1], times_[k]));
    }
}

void RotationTrack::close_loop() {
    constexpr double same = 1e-6;  // rad, about the rounding of inputs in single precision
    require(glm::length(rotation_vector(glm::conjugate(inputs_.front()) * inputs_.back())) < same,
            "inputs: must end with the first one in a loop");
    // One cycle takes a state s to  M (x) Q s + b,  with the matrix M of the filter, the rotation Q by which
    // the inputs carry vectors once around, and b, to which they bring a state of zero.
    const Step cycle = make_step(filter_, times_.back() - times_.front());
    glm::dquat carried(1.0, 0.0, 0.0, 0.0);
    for (const glm::dvec3& turn : turns_) carried = rotation(-0.5 * turn) * carried;
    const glm::dmat3 q = glm::mat3_cast(carried);
    const std::array<double, 4> m{cycle.ee, cycle.eu, cycle.ue, cycle.uu};
    const State end = states_.back();
    std::array<Row, size> rows{};
    for (std::size_t row = 0; row < size; ++row) {
        for (std::size_t column = 0; column < size; ++column) {
            const double part = q[static_cast<int>(column % 3)][static_cast<int>(row % 3)];
            rows[row][column] = (row == column ? 1.0 : 0.0) - m[2 * (row / 3) + column / 3] * part;
        }
        const auto axis = static_cast<int>(row % 3);
        rows[row][size] = row < 3 ? end.offset[axis] : end.velocity[axis];
    }
    require(solve(rows), "damping: must be greater than 0 where the cycle is a whole number of periods long");
    states_.front() = {{rows[0][size], rows[1][size], rows[2][size]},
                       {rows[3][size], rows[4][size], rows[5][size]}};
    run();
}

glm::dvec3 RotationTrack::offset_after(std::size_t sample, double seconds) const {
    if (seconds == 0.0) return states_[sample].offset;
    return advanced(sample, seconds, make_step(filter_, seconds)).offset;
}

glm::dquat RotationTrack::evaluate(double time) const {
    require_time(time, times_);
    const Place place = place_of(time, times_, is_loop_);
    const std::size_t k = place.sample;
    const double seconds = place.seconds;
    const glm::dquat turn = rotation(offset_after(k, seconds));
    if (seconds == 0.0) return inputs_[k] * turn;
    glm::dquat input = inputs_[k];
    if (k + 1 < times_.size()) input = input * rotation(turns_[k] * (seconds / (times_[k + 1] - times_[k])));
    return glm::normalize(input * turn);
}

glm::dquat RotationTrack::offset(double time) const {
    require_time(time, times_);
    const Place place = place_of(time, times_, is_loop_);
    return rotation(offset_after(place.sample, place.seconds));
}

std::size_t RotationTrack::bytes() const noexcept {
    return times_.capacity() * sizeof(double) + inputs_.capacity() * sizeof(glm::dquat) +
           turns_.capacity() * sizeof(glm::dvec3) + states_.capacity() * sizeof(State) +
           is_reset_.capacity() / 8;
}

}  // namespace motus::dynamics
