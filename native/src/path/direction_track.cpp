#include "direction_track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motus/core/numeric.hpp"

namespace motus::path {
namespace {

using std::numbers::pi;

constexpr int bisections = 40;
constexpr int most_halvings = 3;     // of a cell in which the field is weak
constexpr double weak = 25.0;        // times the threshold
constexpr double slope_step = 1e-3;  // of a gap: over this much beside it the slope is measured
constexpr double most_overshoot =
    pi / 8.0;  // rad: how far an end's slope may carry the angle on into the gap

/// `value` plus the multiple of `period` that brings it within half a period of `near`.
double nearest(double value, double near, double period) {
    return near + std::remainder(value - near, period);
}

/// A function of x that begins with slope 1 and tends to `reach`.
double saturated(double x, double reach) {
    return reach > 0.0 ? reach * -std::expm1(-x / reach) : 0.0;
}

double reach_of(double slope, double width) {
    return std::abs(slope) * width > 3.0 * most_overshoot ? most_overshoot / std::abs(slope) : width / 3.0;
}

}  // namespace

/// The field's values at the table's stations, and at more places where the field is weak.
class DirectionTrack::Survey {
  public:
    Survey(const ParallelFrames& frames, const DirectionField& field) : frames_(frames), field_(field) {
        for (std::size_t i = 0; i < frames.distances().size(); ++i) {
            const Place station = frames.station(i);
            const Sample next{station, field.at(station)};
            if (i > 0 && smooth(i - 1) && field.axis) look_between(Sample(samples_.back()), next, 0);
            samples_.push_back(next);
        }
    }

    [[nodiscard]] const ParallelFrames& frames() const { return frames_; }
    [[nodiscard]] double period() const { return field_.axis ? pi : 2.0 * pi; }
    [[nodiscard]] double angle(const Place& place) const { return std::arg(field_.at(place)); }

    /// The gaps in the order of the samples; one at an end of the path has one edge, one without end has
    /// none.
    [[nodiscard]] std::vector<Edges> gaps() const {
        std::vector<Edges> found;
        const std::size_t count = samples_.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (meant(i)) {
                if (i + 1 < count && meant(i + 1)) add_reversal(samples_[i], samples_[i + 1], found);
                continue;
            }
            Edges edges;
            if (i > 0) edges.before = edge_between(samples_[i - 1], samples_[i]);
            while (i + 1 < count && !meant(i + 1)) ++i;
            if (i + 1 < count) edges.behind = edge_between(samples_[i + 1], samples_[i]);
            found.push_back(edges);
        }
        return found;
    }

    /// Slope of the angle beside a gap, taken outside it; 0 next to a corner.
    [[nodiscard]] double slope(const Place& edge, double away) const {
        const double s = edge.s + away;
        if (away == 0.0 || s < 0.0 || s > frames_.length()) return 0.0;
        const Place other = frames_.at(s);
        const auto [first, last] = std::minmax(edge.cell, other.cell);
        const auto cells = frames_.cells().subspan(first, last - first);
        if (std::any_of(cells.begin(), cells.end(), [](Cell cell) { return cell != Cell::smooth; }))
            return 0.0;
        return std::remainder(angle(other) - angle(edge), 2.0 * pi) / away;
    }

  private:
    struct Sample {
        Place place;
        Across value;
    };

    [[nodiscard]] bool meant(Across value) const { return std::abs(value) >= field_.threshold; }
    [[nodiscard]] bool meant(std::size_t sample) const { return meant(samples_[sample].value); }
    [[nodiscard]] bool smooth(std::size_t cell) const { return frames_.cells()[cell] == Cell::smooth; }

    /// Adds samples between two, so that an axis does not reverse twice between neighbours.
    void look_between(const Sample& from, const Sample& to, int depth) {
        const auto [least, most] = std::minmax({std::abs(from.value), std::abs(to.value)});
        if (depth == most_halvings || most < field_.threshold || least > weak * field_.threshold) return;
        const Place place = frames_.at(0.5 * (from.place.s + to.place.s));
        const Sample middle{place, field_.at(place)};
        look_between(from, middle, depth + 1);
        samples_.push_back(middle);
        look_between(middle, to, depth + 1);
    }

    /// The last place on the way from one to another that fulfils `condition`, as the first does.
    template <class Condition>
    [[nodiscard]] Place last_with(const Place& inside, const Place& outside, Condition condition) const {
        Place best = inside;
        double other = outside.s;
        for (int i = 0; i < bisections && best.s != other; ++i) {
            const Place middle = frames_.at(0.5 * (best.s + other));
            if (condition(field_.at(middle))) {
                best = middle;
            } else {
                other = middle.s;
            }
        }
        return best;
    }

    /// Whether what lies between two neighbouring samples, in either order, is a piece of a smooth cell.
    [[nodiscard]] bool smooth_between(const Place& a, const Place& b) const {
        return smooth(a.s < b.s || (a.s == b.s && a.cell < b.cell) ? a.cell : b.cell);
    }

    /// The edge of a gap between neighbouring samples of which `inside` shows a direction and `outside` does
    /// not.
    [[nodiscard]] Place edge_between(const Sample& inside, const Sample& outside) const {
        if (!smooth_between(inside.place, outside.place)) return inside.place;
        return last_with(inside.place, outside.place, [this](Across value) { return meant(value); });
    }

    /// An axis may change its sign between two samples that both show it.
    void add_reversal(const Sample& from, const Sample& to, std::vector<Edges>& found) const {
        const auto forward = [&from](Across value) {
            return std::real(value * std::conj(from.value)) >= 0.0;
        };
        if (!field_.axis || forward(to.value)) return;
        if (!smooth_between(from.place, to.place)) {
            found.push_back({from.place, to.place});
            return;
        }
        const Place turned = last_with(from.place, to.place, forward);
        if (meant(field_.at(turned))) return;  // a quick turn, but a turn
        const auto is_meant = [this](Across value) { return meant(value); };
        found.push_back({last_with(from.place, turned, is_meant), last_with(to.place, turned, is_meant)});
    }

    const ParallelFrames& frames_;
    const DirectionField& field_;
    std::vector<Sample> samples_;
};

Across DirectionTrack::Gap::at(double s) const {
    const double width = end - begin;
    const double from_begin = std::clamp(s - begin, 0.0, width);
    const double to_end = width - from_begin;
    const double share = width > 0.0 ? smooth_step(from_begin / width) : 0.0;
    const double departing = angle_begin + slope_begin * saturated(from_begin, reach_of(slope_begin, width));
    const double arriving = angle_end - slope_end * saturated(to_end, reach_of(slope_end, width));
    return std::polar(1.0, departing + share * (arriving - departing));
}

DirectionTrack::DirectionTrack(const ParallelFrames& frames, const DirectionField& field)
    : length_(frames.length()), closing_(frames.closing()) {
    const Survey survey(frames, field);
    Edges over_seam;
    for (const Edges& edges : survey.gaps()) {
        if (frames.cyclic() && !edges.before && edges.behind) {
            over_seam.behind = edges.behind;
        } else if (frames.cyclic() && edges.before && !edges.behind) {
            over_seam.before = edges.before;
        } else {
            add(survey, edges);
        }
    }
    const bool shown_somewhere = gaps_.empty() || gaps_.front().end - gaps_.front().begin < length_;
    if (frames.cyclic() && shown_somewhere) close(survey, over_seam);
}

void DirectionTrack::add(const Survey& survey, const Edges& edges) {
    Gap gap;
    gap.begin = edges.before ? edges.before->s : 0.0;
    gap.end = edges.behind ? edges.behind->s
                           : std::nextafter(length_, 2.0 * length_);  // the end of the path included
    const double step = slope_step * (gap.end - gap.begin);
    const double sign = gaps_.empty() ? 1.0 : gaps_.back().sign_after;
    if (edges.before) gap.angle_begin = survey.angle(*edges.before) + (sign < 0.0 ? pi : 0.0);
    if (edges.before && edges.behind) {
        const double shown = survey.angle(*edges.behind);
        gap.angle_end = nearest(shown, gap.angle_begin, survey.period());
        gap.sign_after = std::cos(gap.angle_end - shown) < 0.0 ? -1.0 : 1.0;
        gap.slope_begin = survey.slope(*edges.before, -step);
        gap.slope_end = survey.slope(*edges.behind, step);
    } else if (edges.before) {
        gap.angle_end = gap.angle_begin;
    } else if (edges.behind) {
        gap.angle_begin = gap.angle_end = survey.angle(*edges.behind);
    } else {
        gap.angle_end = -std::arg(closing_);
    }
    gaps_.push_back(gap);
}

void DirectionTrack::close(const Survey& survey, const Edges& over_seam) {
    const ParallelFrames& frames = survey.frames();
    const Place before = over_seam.before ? *over_seam.before : frames.station(frames.distances().size() - 1);
    const Place behind = over_seam.behind ? *over_seam.behind : frames.station(0);
    Gap gap;
    gap.begin = before.s;
    gap.end = behind.s + length_;
    const double step = slope_step * (gap.end - gap.begin);
    const double sign = gaps_.empty() ? 1.0 : gaps_.back().sign_after;
    gap.angle_begin = survey.angle(before) + (sign < 0.0 ? pi : 0.0);
    const double shown = survey.angle(behind) - std::arg(closing_);
    gap.angle_end = nearest(shown, gap.angle_begin, survey.period());
    gap.slope_begin = survey.slope(before, -step);
    gap.slope_end = survey.slope(behind, step);
    half_turn_ = std::cos(gap.angle_end - shown) < 0.0;
    if (over_seam.before || over_seam.behind) seam_ = gap;
}

Across DirectionTrack::without_half_turn(double s, Across value) const {
    if (seam_ && s >= seam_->begin) return seam_->at(s);
    const auto after = std::upper_bound(gaps_.begin(), gaps_.end(), s,
                                        [](double distance, const Gap& gap) { return distance < gap.begin; });
    const double sign = after == gaps_.begin() ? 1.0 : std::prev(after)->sign_after;
    if (after != gaps_.begin() && s < std::prev(after)->end) return std::prev(after)->at(s);
    const double size = size_of(value);
    return size > 0.0 ? sign / size * value : Across(1.0);
}

Across DirectionTrack::at(double s, Across value) const {
    const bool behind_seam = seam_ && s + length_ < seam_->end;
    const double along = behind_seam ? s + length_ : s;  // on the lap on which the seam's gap begins
    Across direction = behind_seam ? seam_->at(along) * closing_ : without_half_turn(s, value);
    if (half_turn_) direction *= std::polar(1.0, -pi * along / length_);
    return direction;
}

}  // namespace motus::path
