// A direction across the tangent that never jumps, from a vector field with holes.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "parallel_frames.hpp"

namespace motus::path {

/// A vector across the tangent at every place, which shows a direction where it is long enough.
struct DirectionField {
    std::function<Across(const Place&)> at;
    double threshold = 0.0;  ///< the least length at which the direction is meant
    bool axis = false;  ///< the direction is meant but for its sign, which is carried on through the gaps
};

/// The field's direction where it is long enough, and through the gaps between an angle against the parallel
/// frames that goes smoothly (C1) the shortest way from one side to the other; held in gaps at the ends of
/// the path. On a cyclic path it closes; if an axis comes back the other way round, half a turn is spread
/// over the whole path.
class DirectionTrack {
  public:
    DirectionTrack(const ParallelFrames& frames, const DirectionField& field);

    /// Unit direction at distance s in [0, length], where the field is `value`.
    [[nodiscard]] Across at(double s, Across value) const;
    [[nodiscard]] std::size_t bytes() const noexcept { return bytes_of(gaps_); }

  private:
    struct Gap {
        double begin = 0.0, end = 0.0;
        double angle_begin = 0.0, angle_end = 0.0;  // rad, against the parallel frames
        double slope_begin = 0.0, slope_end = 0.0;  // rad / length unit
        double sign_after = 1.0;                    // of the axis behind the gap

        [[nodiscard]] Across at(double s) const;
    };
    struct Edges {
        std::optional<Place> before, behind;  // the places on both sides if the direction is meant
    };
    class Survey;

    void add(const Survey& survey, const Edges& edges);
    void close(const Survey& survey, const Edges& over_seam);
    [[nodiscard]] Across without_half_turn(double s, Across value) const;

    double length_ = 0.0;
    std::vector<Gap> gaps_;    // by distance, apart from each other
    std::optional<Gap> seam_;  // from begin <= length to end >= length
    Across closing_{1.0, 0.0};
    bool half_turn_ = false;
};

}  // namespace motus::path
