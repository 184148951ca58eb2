#include "motus/path/frames.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "frame_tables.hpp"
#include "motus/core/numeric.hpp"
#include "motus/path/frame_tables_cache.hpp"
#include "polish.hpp"

namespace motus::path {
namespace {

using std::numbers::pi;

constexpr double most = 1e30;  // of speed and of strength over gravity: up is across long before, squares fit
constexpr double weightless = 0.1;  // of gravity: apparent gravity below it no longer shows a direction

bool reads_smoothing(FrameMode mode) {
    return mode == FrameMode::banking || mode == FrameMode::curvature;
}

FrameSettings checked(FrameSettings settings, const curve::ArcLength* path) {
    require(path != nullptr, "path: must be there");
    const curve::Curve& curve = path->curve();
    if (settings.mode == FrameMode::banking) {
        require(std::isfinite(settings.gravity) && settings.gravity > 0.0,
                "gravity: must be finite and above 0");
        require(std::isfinite(settings.strength), "strength: must be finite");
        require(settings.limit >= 0.0, "limit: must be 0 or more");
    }
    if (reads_smoothing(settings.mode)) {
        require(std::isfinite(settings.smoothing) && settings.smoothing >= 0.0,
                "smoothing: must be finite and 0 or more");
    }
    if (settings.mode == FrameMode::tilt) {
        require(settings.tilt.size() == curve.segment_count() + (curve.cyclic() ? 0 : 1),
                "tilt: must have one value per point of the curve");
        require(are_finite(settings.tilt), "tilt: must be finite");
    }
    if (settings.mode == FrameMode::rail) require(settings.rail != nullptr, "rail: must be there");
    return settings;
}

/// A roll (rad, -pi to pi) kept below `limit`: unchanged up to four fifths of it, and back to 0 upside down,
/// if it could not tell left from right.
double limited(double roll, double limit) {
    const double size = std::abs(roll);
    const double free = 0.8 * limit;
    const double rest = limit - free;
    const double kept =
        size <= free ? size : free + rest * (rest > 0.0 ? std::tanh((size - free) / rest) : 0.0);
    return std::copysign(kept * (1.0 - smooth_step(4.0 * size / pi - 3.0)), roll);
}

/// Unit vector along `apparent`, the apparent gravity perpendicular to the tangent, in units of g. Near
/// weightlessness the vector is led past 0: along `upright` if nothing is left, and over one side if it comes
/// out upside down (the crest of a hill taken too fast), so that the follower rolls.
Across apparent_up(Across apparent, Across upright) {
    const double closeness = 1.0 - std::norm(apparent) / (weightless * weightless);
    if (closeness > 0.0) {
        const double hanging = -std::real(apparent * std::conj(upright));
        const double roll = 0.5 * pi * smooth_step(2.0 * hanging / weightless);
        apparent += weightless * closeness * closeness * upright * std::polar(1.0, roll);
    }
    const double size = size_of(apparent);
    return size > 0.0 ? apparent / size : upright;
}

Across banked(const FrameTables& tables, const FrameSettings& settings, const Place& place, double speed) {
    const Across upright = tables.upright(place);
    const double lean = std::clamp(settings.strength / settings.gravity, -most, most);
    const double moving = std::min(std::abs(speed), most);
    const Across pull = lean * moving * moving * tables.bend(place);
    const Across up = apparent_up(FrameTables::world_up(place) + pull, upright);
    if (settings.limit >= pi) return up;
    return upright * std::polar(1.0, limited(std::arg(up * std::conj(upright)), settings.limit));
}

/// A tilt value at t; the last point of a cyclic curve is its first.
double tilt_at(const std::vector<double>& tilt, const curve::Curve& curve, double t) {
    const curve::Location at = locate(curve, t);
    const double from = tilt[at.segment];
    const double to = tilt[(at.segment + 1) % tilt.size()];
    return std::lerp(from, to, at.t);
}

/// Up if the rail lies in a direction on a side. Right is up turned back by a quarter about the tangent.
Across up_with(Across rail, RailSide side) {
    constexpr Across quarter(0.0, 1.0);
    switch (side) {
        case RailSide::right:
            return -quarter * rail;
        case RailSide::left:
            return quarter * rail;
        case RailSide::above:
            break;
    }
    return rail;
}

Across up_across(const FrameTables& tables, const FrameSettings& settings, const Place& place, double speed) {
    switch (settings.mode) {
        case FrameMode::world_up:
            return tables.upright(place);
        case FrameMode::banking:
            return banked(tables, settings, place, speed);
        case FrameMode::curvature:
            return (settings.outward ? -1.0 : 1.0) * tables.bend_direction(place);
        case FrameMode::tilt:
            return tables.upright(place) *
                   std::polar(1.0, tilt_at(settings.tilt, tables.frames().path().curve(), place.t));
        case FrameMode::rail:
            return up_with(tables.rail_direction(place), settings.rail_side);
        case FrameMode::minimal:
            break;
    }
    return tables.minimal(place);
}

glm::dquat rotation_to(const Place& place, Across up) {
    const glm::dvec3 x = up.real() * place.side - up.imag() * place.up;
    const glm::dvec3 z = up.real() * place.up + up.imag() * place.side;
    return polished(glm::quat_cast(glm::dmat3(x, place.tangent, z)));
}

}  // namespace

Frames::Frames(std::shared_ptr<const curve::ArcLength> path, FrameSettings settings)
    : settings_(std::make_shared<const FrameSettings>(checked(std::move(settings), path.get()))) {
    tables_ = std::make_shared<const FrameTables>(std::move(path), *settings_);
}

Frames::Frames(std::shared_ptr<const FrameTables> tables, FrameSettings settings)
    : tables_(std::move(tables)), settings_(std::make_shared<const FrameSettings>(std::move(settings))) {}

glm::dquat Frames::at(double s, double speed) const {
    return pose(s, speed).rotation;
}

Pose Frames::pose(double s, double speed) const {
    if (std::isnan(s)) return {glm::dvec3(s), {s, s, s, s}};
    const Place place = tables_->frames().at(s);
    if (std::isnan(speed) && settings_->mode == FrameMode::banking)
        return {place.position, {speed, speed, speed, speed}};
    if (tables_->frames().length() <= 0.0) return {place.position, {1.0, 0.0, 0.0, 0.0}};
    return {place.position, rotation_to(place, up_across(*tables_, *settings_, place, speed))};
}

const curve::ArcLength& Frames::path() const noexcept {
    return tables_->frames().path();
}

std::size_t Frames::station_count() const noexcept {
    return tables_->frames().distances().size();
}

Frames shared_frames(std::shared_ptr<const curve::ArcLength> path, FrameSettings settings) {
    settings = checked(std::move(settings), path.get());
    FrameTablesKey key{path->curve(), settings.mode,
                       reads_smoothing(settings.mode) ? settings.smoothing : 0.0};
    if (settings.mode == FrameMode::rail) {
        key.rail = settings.rail->curve();
        key.rail_point = settings.rail_point;
    }
    auto tables = frame_tables_cache().get(key, [&path, &settings](const FrameTablesKey&) {
        return std::make_shared<const FrameTables>(path, settings);
    });
    return {std::move(tables), std::move(settings)};
}

}  // namespace motus::path
