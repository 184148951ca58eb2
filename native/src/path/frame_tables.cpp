#include "frame_tables.hpp"

#include <limits>
#include <utility>

#include "motus/curve/arc_length_cache.hpp"
#include "motus/curve/nearest.hpp"
#include "motus/path/frame_tables_cache.hpp"

namespace motus::path {
namespace {

constexpr double upright_threshold =
    0.2;  // sine of the angle to the vertical (11.5 degrees) that shows world up
constexpr double bend_threshold = 0.02;  // of the mean curvature: from here on the bend defines a direction
constexpr double least_turning = 1e-6;   // rad over the whole length: below, the curve is straight
constexpr double rail_threshold =
    0.05;  // of the mean distance across: from here on the rail shows a direction
constexpr double rail_rounding = 1e-9;  // of the path's length: below, the rail is the path itself
constexpr std::size_t cached_tables = 64;

DirectionTrack bend_track(const ParallelFrames& frames, const BendField& bend) {
    const bool straight = bend.mean() * frames.length() < least_turning;
    const double threshold =
        straight ? std::numeric_limits<double>::infinity() : bend_threshold * bend.mean();
    return {frames, {[&bend](const Place& place) { return bend.at(place); }, threshold, true}};
}

}  // namespace

FrameTables::FrameTables(std::shared_ptr<const curve::ArcLength> path, const FrameSettings& settings)
    : frames_(std::make_shared<ParallelFrames>(std::move(path))) {
    const FrameMode mode = settings.mode;
    if (mode == FrameMode::banking || mode == FrameMode::curvature)
        bend_.emplace(frames_, settings.smoothing);
    if (mode == FrameMode::curvature) {
        track_.emplace(bend_track(*frames_, *bend_));
    } else if (mode == FrameMode::rail) {
        rail_ = settings.rail;
        rail_point_ = settings.rail_point;
        track_.emplace(rail_track());
    } else if (mode != FrameMode::minimal) {
        track_.emplace(*frames_, DirectionField{world_up, upright_threshold, false});
    }
    if (frames_->cyclic() && frames_->seam() == Cell::joint) closing_angle_ = std::arg(frames_->closing());
}

Across FrameTables::minimal(const Place& place) const {
    return std::polar(1.0, closing_angle_ == 0.0 ? 0.0 : -closing_angle_ * place.s / frames_->length());
}

Across FrameTables::towards_rail(const Place& place) const {
    if (rail_point_ == RailPoint::nearest)
        return place.across(nearest(rail_->curve(), place.position).position - place.position);
    const double share = frames_->length() > 0.0 ? place.s / frames_->length() : 0.0;
    return place.across(position_at_length(*rail_, share * rail_->length()) - place.position);
}

DirectionTrack FrameTables::rail_track() const {
    const DirectionField field{[this](const Place& place) { return towards_rail(place); }};
    const std::size_t count = frames_->distances().size();
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += size_of(field.at(frames_->station(i)));
    const double mean = sum / static_cast<double>(count);
    // A rail that is the path itself shows no direction anywhere.
    const double none = rail_rounding * frames_->length();
    return {*frames_,
            {field.at, mean > none ? rail_threshold * mean : std::numeric_limits<double>::infinity(), false}};
}

std::size_t FrameTables::bytes() const noexcept {
    return sizeof *this + frames_->bytes() + (bend_ ? bend_->bytes() : 0) + (track_ ? track_->bytes() : 0) +
           (rail_ ? rail_->bytes() : 0);
}

std::size_t FrameTablesHash::operator()(const FrameTablesKey& key) const noexcept {
    ContentHash hash;
    hash.add(static_cast<std::uint64_t>(curve::CurveHash{}(key.curve)));
    hash.add(static_cast<std::uint64_t>(key.mode));
    hash.add(key.smoothing);
    if (key.rail) hash.add(static_cast<std::uint64_t>(curve::CurveHash{}(*key.rail)));
    return hash.value();
}

std::size_t FrameTablesBytes::operator()(const FrameTablesKey& key,
                                         const FrameTables& tables) const noexcept {
    return key.curve.control_points().size_bytes() +
           (key.rail ? key.rail->control_points().size_bytes() : 0) + tables.bytes();
}

FrameTablesCache& frame_tables_cache() {
    // Never destroyed: threads may still look up tables while the program exits.
    static FrameTablesCache& cache = *new FrameTablesCache(cached_tables);
    return cache;
}

}  // namespace motus::path
