#include "parallel_frames.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "polish.hpp"

namespace motus::path {
namespace {

constexpr double radians(double degrees) {
    return degrees * 3.14159265358979323846 / 180.0;
}

constexpr double cell_turning = radians(2.0);     // a smooth cell turns by no more
constexpr double corner_turning = radians(20.0);  // a cell that still does is a cusp
constexpr double joint_turning = 1e-4;  // tangents at a joint that differ by less are meant to be the same
constexpr double reversal = 1e-3;       // and from opposite, the tangent turns back on itself
constexpr double vertical = 1e-6;       // nearer to the vertical than this, the tangent has no upright side
constexpr double least_grain = 1e-150;  // length unit: squares of shorter lengths underflow
constexpr int fewest_halvings = 4;      // of a segment: 16 cells, so that no inflexion hides in one
constexpr int most_halvings = 40;

/// Angle between unit vectors, accurate near 0 and pi.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
}

/// `v` made a unit vector across the unit vector `tangent`.
glm::dvec3 made_across(const glm::dvec3& v, const glm::dvec3& tangent) {
    return glm::normalize(v - glm::dot(v, tangent) * tangent);
}

/// Up after the least rotation that takes one tangent to the other. If they are opposite there is no such
/// one: up stays, and the tangent turns about it.
glm::dvec3 carried_round_corner(const Station& from, const glm::dvec3& tangent) {
    const glm::dvec3 sum = from.tangent + tangent;
    if (glm::length(sum) < reversal) return made_across(from.up, tangent);
    // Rodrigues' formula for the rotation in the plane of both, on a vector across the first.
    const double factor = 2.0 * glm::dot(from.up, sum) / glm::dot(sum, sum);
    return made_across(from.up - factor * sum, tangent);
}

/// Up after the two reflections that take one place's position and tangent to another's.
template <class To>
glm::dvec3 double_reflected(const Station& from, const To& to) {
    const glm::dvec3 v1 = to.position - from.position;
    const double c1 = glm::dot(v1, v1);
    const glm::dvec3 up = from.up - 2.0 / c1 * glm::dot(v1, from.up) * v1;
    const glm::dvec3 tangent = from.tangent - 2.0 / c1 * glm::dot(v1, from.tangent) * v1;
    const glm::dvec3 v2 = to.tangent - tangent;
    const glm::dvec3 reflected = up - 2.0 / glm::dot(v2, v2) * glm::dot(v2, up) * v2;
    return polished(reflected - glm::dot(reflected, to.tangent) * to.tangent);
}

/// Up at `to` by the frame that `from` becomes across a cell of the given kind. Steps shorter than `grain`
/// have no chord to reflect in; there both ways agree.
template <class To>
void carry(const Station& from, Cell cell, double grain, To& to) {
    const glm::dvec3 step = to.position - from.position;
    const bool chord = cell == Cell::smooth && glm::dot(step, step) > grain * grain;
    to.up = chord ? double_reflected(from, to) : carried_round_corner(from, to.tangent);
}

/// Curvature vector, where the first derivative, 1 / per_speed long, does not vanish.
glm::dvec3 bend_of(const curve::Jet& all, double per_speed, const glm::dvec3& tangent) {
    return per_speed * (per_speed * (all.d2 - glm::dot(all.d2, tangent) * tangent));
}

/// Position, tangent and bend of a curve at t; the frame is left as it is.
Place place_at(const curve::Curve& curve, double s, double t, double grain) {
    const curve::Jet all = jet(curve, t);
    const double speed = glm::length(all.d1);
    Place place;
    place.s = s;
    place.t = t;
    place.position = all.position;
    if (speed > grain) {
        const double per_speed = 1.0 / speed;
        place.tangent = per_speed * all.d1;
        place.bend = bend_of(all, per_speed, place.tangent);
    } else {
        place.tangent = tangent(curve, t);
        place.bend = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    }
    return place;
}

double largest_coordinate(const curve::Curve& curve) {
    double largest = 0.0;
    for (const glm::dvec3& p : curve.control_points()) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return largest;
}

/// The stations of one segment: halved until a cell turns by no more than cell_turning.
class SegmentStations {
  public:
    SegmentStations(const curve::ArcLength& path, std::size_t index, double grain, std::vector<Station>& out,
                    std::vector<double>& distances)
        : path_(path),
          index_(index),
          curve_(curve::Curve::bezier(path.curve().segment(index))),
          grain_(grain),
          out_(out),
          distances_(distances) {}

    void append() {
        const Place first = at(0.0);
        const Place last = at(1.0);
        add(first);
        halve(0.0, first, 1.0, last, 0);
        out_.back().t =
            std::nextafter(out_.back().t, 0.0);  // still this segment's, for those who ask the whole curve
    }

  private:
    [[nodiscard]] Place at(double local) const {
        const double t = static_cast<double>(index_) + local;
        const double s = local >= 1.0 ? path_.segment_start(index_ + 1) : path_.length_at(t);
        Place place = place_at(curve_, s, local, grain_);
        place.t = t;
        return place;
    }

    void halve(double t0, const Place& from, double t1, const Place& to, int depth) {
        const double t = 0.5 * (t0 + t1);
        const Place middle = at(t);
        const double turning =
            angle_between(from.tangent, middle.tangent) + angle_between(middle.tangent, to.tangent);
        const bool worth_it = depth < most_halvings && to.s - from.s > 2.0 * grain_;
        if (worth_it && (depth < fewest_halvings || turning > cell_turning)) {
            halve(t0, from, t, middle, depth + 1);
            halve(t, middle, t1, to, depth + 1);
        } else {
            add(to);
        }
    }

    void add(const Place& place) {
        out_.push_back({place.t, place.position, place.tangent, place.up});
        distances_.push_back(place.s);
    }

    const curve::ArcLength& path_;
    std::size_t index_;
    curve::Curve curve_;  // the segment alone, whose tangent at its end is not the next segment's
    double grain_;
    std::vector<Station>& out_;
    std::vector<double>& distances_;
};

}  // namespace

Across Place::across(const glm::dvec3& v) const {
    return {glm::dot(v, up), glm::dot(v, side)};
}

glm::dvec3 upright(const glm::dvec3& tangent) {
    const glm::dvec3 z{0.0, 0.0, 1.0};
    if (std::hypot(tangent.x, tangent.y) > vertical) return made_across(z, tangent);
    return made_across({0.0, tangent.z > 0.0 ? -1.0 : 1.0, 0.0}, tangent);
}

ParallelFrames::ParallelFrames(std::shared_ptr<const curve::ArcLength> path) : path_(std::move(path)) {
    const curve::Curve& curve = path_->curve();
    grain_ = std::max({1e-9 * length(), 1e-12 * largest_coordinate(curve), least_grain});
    for (std::size_t i = 0; i < curve.segment_count(); ++i) {
        if (path_->segment_start(i + 1) > path_->segment_start(i)) add_segment(i);
    }
    if (stations_.empty()) {
        stations_.emplace_back().position = curve::position(curve, 0.0);
        distances_.push_back(0.0);
    }
    carry_frames();
    if (curve.cyclic() && length() > 0.0) close();
    stations_.shrink_to_fit();
    distances_.shrink_to_fit();
    cells_.shrink_to_fit();
}

void ParallelFrames::add_segment(std::size_t index) {
    if (!stations_.empty()) cells_.push_back(Cell::joint);
    SegmentStations(*path_, index, grain_, stations_, distances_).append();
    cells_.resize(stations_.size() - 1, Cell::smooth);
}

void ParallelFrames::carry_frames() {
    stations_.front().up = upright(stations_.front().tangent);
    for (std::size_t i = 0; i + 1 < stations_.size(); ++i) {
        const Station& from = stations_[i];
        Station& to = stations_[i + 1];
        const double most = cells_[i] == Cell::joint ? joint_turning : corner_turning;
        if (angle_between(from.tangent, to.tangent) > most) cells_[i] = Cell::corner;
        carry(from, cells_[i], grain_, to);
    }
}

void ParallelFrames::close() {
    cyclic_ = true;
    const Station& last = stations_.back();
    const Place first = station(0);
    seam_ = angle_between(last.tangent, first.tangent) > joint_turning ? Cell::corner : Cell::joint;
    Station again = stations_.front();
    carry(last, seam_, grain_, again);
    const Across closing = first.across(again.up);
    closing_ = closing / std::abs(closing);
}

// Not into at(), which each follower calls and which seldom falls on a station.
[[gnu::noinline]] Place ParallelFrames::station(std::size_t index) const {
    const Station& kept = stations_[index];
    Place place;
    place.s = distances_[index];
    place.t = kept.t;
    place.cell = index;
    place.position = kept.position;
    place.tangent = kept.tangent;
    place.up = kept.up;
    place.side = glm::cross(place.tangent, place.up);
    if (length() <= 0.0) return place;
    // A station at the end of a segment belongs to it, by the last parameter before the next one's.
    curve::Location at = locate(path_->curve(), place.t);
    const double end = static_cast<double>(at.segment) + 1.0;
    if (std::nextafter(place.t, end) == end) at.t = 1.0;
    const curve::Jet all = jet(path_->curve(), at);
    const double speed = glm::length(all.d1);
    place.bend = speed > grain_ ? bend_of(all, 1.0 / speed, place.tangent)
                                : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    return place;
}

Place ParallelFrames::at(double s) const {
    const auto after = std::upper_bound(distances_.begin(), distances_.end(), s);
    const std::size_t cell =
        after == distances_.begin() ? 0 : static_cast<std::size_t>(after - distances_.begin()) - 1;
    if (cell + 1 == stations_.size() || s <= distances_[cell]) [[unlikely]]
        return station(cell);
    const Station& from = stations_[cell];
    const double t = std::clamp(path_->t_at_length(s), from.t, stations_[cell + 1].t);
    Place place = place_at(path_->curve(), s, t, grain_);
    place.cell = cell;
    carry(from, cells_[cell], grain_, place);
    place.side = glm::cross(place.tangent, place.up);
    return place;
}

}  // namespace motus::path
