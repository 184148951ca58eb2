// Orientation along a curve: which way is up at every distance.
// Quaternions turn +Y to the tangent and +Z to up.
//
// Costs: O(n) adaptive steps to make, which allocates tables; O(log n) to ask, which allocates nothing.
// Immutable: any number of threads may share one.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "motus/config.hpp"
#include "motus/curve/arc_length.hpp"

namespace motus::path {

enum class FrameMode {
    world_up,   ///< world up across the tangent; led through smoothly where the tangent nears the vertical
    minimal,    ///< rotation-minimising from world up at the start; closes without a seam on a cyclic curve
    banking,    ///< along the apparent gravity g z + k a, a = speed^2 * curvature towards the centre of the
                ///< bend
    curvature,  ///< towards the centre of the first bend; its axis is carried on through inflexions without a
                ///< flip
    tilt,       ///< world up, turned about the tangent (right-handed) by tilt values at the curve's points
    rail,       ///< towards a second curve; its direction is led through where it lies along the tangent
};

/// Which point of the rail belongs to a place on the path.
enum class RailPoint {
    share,    ///< at the same share of its length
    nearest,  ///< the nearest one to the place; jumps where the rail comes near in two places
};

/// Where the rail lies, seen along the path.
enum class RailSide { above, right, left };

/// What the modes need beyond the curve; a mode reads only its own fields.
struct FrameSettings {
    FrameMode mode = FrameMode::minimal;
    bool outward = false;   ///< curvature: up away from the centre of the bend instead of towards it
    double gravity = 9.81;  ///< banking: length unit / s^2, > 0
    double strength = 1.0;  ///< banking: k; 1 is the turn an aircraft would fly, < 0 leans outward
    double limit = 3.2;     ///< banking: largest roll away from world up, rad, >= 0; >= pi means none.
                            ///< Approached smoothly over its last fifth; upside down counts as no roll
    double smoothing =
        0.0;  ///< banking, curvature: width of the symmetric filter along the arc, length unit, >= 0
    std::vector<double> tilt;  ///< tilt: rad, one per point of the curve (segment_count() + 1, or
                               ///< segment_count() if cyclic), linear in t between
    std::shared_ptr<const curve::ArcLength> rail{};  ///< rail: the second curve, never null
    RailPoint rail_point = RailPoint::share;         ///< rail
    RailSide rail_side = RailSide::above;            ///< rail
};

/// A place and an orientation.
struct Pose {
    glm::dvec3 location{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
};

class FrameTables;

/// Frames of one curve under one set of settings: a table of rotation-minimising frames (double reflection:
/// Wang, Juettler, Zheng, Liu, "Computation of Rotation Minimizing Frames", ACM TOG 27 (2008)) and, for the
/// modes that need it, of directions that bridge the places where the mode defines none. Immutable, safe
/// to share between threads; a copy shares the tables, and to move one is to copy it. Continuous in s for
/// every mode wherever the tangent is; at a corner the frame turns by the least rotation that takes one
/// tangent to the other, at a reversal about up. The identity on a curve of zero length.
class Frames {
  public:
    /// Builds the tables. Throws std::invalid_argument if a setting that the mode reads is outside its
    /// domain, or there is no path.
    Frames(std::shared_ptr<const curve::ArcLength> path, FrameSettings settings);
    ~Frames() = default;
    Frames(const Frames&) noexcept = default;
    Frames& operator=(const Frames&) noexcept = default;
    // An object that is moved from keeps its frames.
    // NOLINTNEXTLINE(performance-move-constructor-init): copying is what it is for, and costs two counters
    Frames(Frames&& other) noexcept : Frames(std::as_const(other)) {}
    Frames& operator=(Frames&& other) noexcept { return *this = std::as_const(other); }

    /// Orientation at distance s (clamped), moving at `speed` (length unit / s; only banking reads it). NaN
    /// if s is NaN.
    [[nodiscard]] glm::dquat at(double s, double speed) const;
    /// Orientation, as at() gives it, and position at distance s.
    [[nodiscard]] Pose pose(double s, double speed) const;
    [[nodiscard]] const curve::ArcLength& path() const noexcept;
    /// Frames in the table; no more than 2 degrees of turning lie between neighbours, corners and cusps
    /// apart.
    [[nodiscard]] std::size_t station_count() const noexcept;

  private:
    friend Frames shared_frames(std::shared_ptr<const curve::ArcLength> path, FrameSettings settings);
    Frames(std::shared_ptr<const FrameTables> tables, FrameSettings settings);

    std::shared_ptr<const FrameTables> tables_;      ///< never null
    std::shared_ptr<const FrameSettings> settings_;  ///< never null
};

/// Frames with tables from the process's cache, or built and then cached. The tables depend on the curve, the
/// mode and the smoothing alone, so that the other settings may change from frame to frame.
[[nodiscard]] Frames shared_frames(std::shared_ptr<const curve::ArcLength> path, FrameSettings settings);

}  // namespace motus::path
