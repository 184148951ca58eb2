// Followers that two bogies carry: rigid wagons on a curved path.
#pragma once
#include <glm/vec3.hpp>

#include "motus/path/frames.hpp"

namespace motus::path {

/// A path without ends: round and round a cyclic curve, or along the tangents of the ends beyond them. Two
/// places are never farther apart than the arc between them, but for gaps between segments.
class EndlessPath {
  public:
    /// goes_round: whether a cyclic curve is closed on itself. `frames` must outlive this.
    EndlessPath(const Frames& frames, bool goes_round);

    [[nodiscard]] bool is_closed() const noexcept { return is_closed_; }
    [[nodiscard]] double length() const noexcept { return frames_.path().length(); }
    [[nodiscard]] glm::dvec3 position(double s) const;
    [[nodiscard]] Pose pose(double s, double speed) const;

  private:
    const Frames& frames_;
    bool is_closed_;
};

/// The arc between two bogies that stand equal arcs before and behind `middle`, the least one at which they
/// are `wheelbase` (> 0) apart, to 1e-12 of it; the wheelbase itself if there is none. Turns of the path that
/// come so far apart for less than 1/256 of the wheelbase may be passed over.
[[nodiscard]] double arc_between(const EndlessPath& path, double middle, double wheelbase);

/// Pose of a follower on two bogies whose middle is at distance `middle`.
[[nodiscard]] Pose on_bogies(const EndlessPath& path, double middle, double wheelbase, double speed);

}  // namespace motus::path
