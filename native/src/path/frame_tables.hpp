// The tables of a path for its frames, which do not depend on speed and banking.
#pragma once
#include <memory>
#include <optional>

#include "bend_field.hpp"
#include "direction_track.hpp"
#include "motus/path/frames.hpp"
#include "parallel_frames.hpp"

namespace motus::path {

class FrameTables {
  public:
    /// Of the settings the mode is read, the smoothing in the modes banking and curvature, and the rail and
    /// its point in the mode rail.
    FrameTables(std::shared_ptr<const curve::ArcLength> path, const FrameSettings& settings);

    [[nodiscard]] const ParallelFrames& frames() const noexcept { return *frames_; }
    /// The world's up across the tangent.
    [[nodiscard]] static Across world_up(const Place& place) { return place.across({0.0, 0.0, 1.0}); }
    /// Unit vector along world up, led through where the tangent nears the vertical (world_up, banking,
    /// tilt).
    [[nodiscard]] Across upright(const Place& place) const { return track_->at(place.s, world_up(place)); }
    /// Curvature vector (banking, curvature).
    [[nodiscard]] Across bend(const Place& place) const { return bend_->at(place); }
    /// Unit vector along the curvature, its axis carried on through inflexions (curvature).
    [[nodiscard]] Across bend_direction(const Place& place) const {
        return track_->at(place.s, bend_->at(place));
    }
    /// Unit vector towards the rail (rail).
    [[nodiscard]] Across rail_direction(const Place& place) const {
        return track_->at(place.s, towards_rail(place));
    }
    /// Unit vector along a rotation-minimising up that closes on a cyclic curve.
    [[nodiscard]] Across minimal(const Place& place) const;
    /// Size in memory, the path included.
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    /// From the place to the rail's point, across the tangent, length unit.
    [[nodiscard]] Across towards_rail(const Place& place) const;
    [[nodiscard]] DirectionTrack rail_track() const;

    std::shared_ptr<const ParallelFrames> frames_;
    std::shared_ptr<const curve::ArcLength> rail_;  // in the mode rail
    RailPoint rail_point_ = RailPoint::share;
    std::optional<BendField> bend_;
    std::optional<DirectionTrack> track_;  // of the bend, towards the rail, or of world up
    double closing_angle_ = 0.0;  // rad, by which the parallel frames of a cyclic curve fail to close
};

}  // namespace motus::path
