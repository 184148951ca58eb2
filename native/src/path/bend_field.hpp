// The curvature vector along a path, in its parallel frames, made continuous and finite.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "parallel_frames.hpp"

namespace motus::path {

/// Curvature vector kappa N (1 / length unit, towards the centre of the bend) at every place.
///
/// Without smoothing it is the curve's own, but that jumps of it at joints are led over by ramps on both
/// sides, and that it stays finite at cusps. With smoothing it is the turning of the path, corners and cusps
/// included, under the zero-lag filter k(x) = (1 + |x| / w) exp(-|x| / w) / (4 w): a critically damped filter
/// run forth and back.
class BendField {
  public:
    /// `smoothing`: w, length unit, >= 0.
    BendField(std::shared_ptr<const ParallelFrames> frames, double smoothing);

    [[nodiscard]] Across at(const Place& place) const;
    /// Turning of the whole path over its length.
    [[nodiscard]] double mean() const noexcept { return mean_; }
    /// Size in memory, without the frames.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return bytes_of(turning_) + bytes_of(stretches_) + bytes_of(stretch_of_) + bytes_of(before_) +
               bytes_of(behind_);
    }

  private:
    /// Exponentially weighted sums of the turning on one side of a station.
    struct Memory {
        Across plain{0.0};   ///< integral of e^-x K dx, x the distance over w
        Across ramped{0.0};  ///< integral of x e^-x K dx
    };
    /// A run of stations between two zero-length cells, and what is added at its ends to meet its neighbours.
    struct Stretch {
        double begin = 0.0, end = 0.0;
        Across at_begin{0.0}, at_end{0.0};
    };

    void measure_turning();
    void find_limit();
    void join_stretches();
    void join(Stretch& left, const Place& last, Stretch& right, const Place& first, Across last_to_first);
    void filter(double smoothing);
    [[nodiscard]] Memory steady(const Memory& after_lap, Across lap_turn, double lap) const;
    [[nodiscard]] Memory passed(const Memory& memory, std::size_t cell, double distance) const;
    [[nodiscard]] Across filtered(const Place& place) const;
    [[nodiscard]] Across exact(const Place& place) const;

    std::shared_ptr<const ParallelFrames> frames_;
    std::vector<Across>
        turning_;  // per cell: the angle by which the tangent turns, towards where; the last one the seam's
    double mean_ = 0.0;
    double limit_ = 0.0;  // largest curvature that counts
    std::vector<Stretch> stretches_;
    std::vector<std::uint32_t> stretch_of_;  // per station
    double width_ = 0.0;                     // of the filter; 0 without smoothing
    std::vector<Memory> before_,
        behind_;  // per station: memory of the path towards the start, towards the end
};

}  // namespace motus::path
