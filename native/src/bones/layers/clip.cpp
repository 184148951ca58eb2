#include "motus/bones/layers/clip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::layers {
namespace {

constexpr std::array<double, channel_count> at_rest{0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0};

[[nodiscard]] unsigned channel_of(int number) {
    return number < 3 ? location : number < 7 ? rotation : scale;
}

void check(const ClipCurve& curve, std::size_t bone_count, std::size_t fcurve_count) {
    require(curve.bone >= 0 && static_cast<std::size_t>(curve.bone) < bone_count,
            "curves: a bone is not there");
    require(curve.channel >= 0 && curve.channel < channel_count, "curves: a channel must be 0 to 9");
    require(curve.fcurve >= -1 && (curve.fcurve < 0 || static_cast<std::size_t>(curve.fcurve) < fcurve_count),
            "curves: an F-curve is not there");
}

[[nodiscard]] double value_of(const fcurve::Key& key) {
    return static_cast<double>(key.place.y);
}

[[nodiscard]] double or_zero(double value) {
    return std::isfinite(value) ? value : 0.0;
}

}  // namespace

Clip::Clip(std::span<const Rotation> rotations, std::span<const ClipCurve> curves,
           std::span<const fcurve::FCurve> fcurves)
    : bone_count_(rotations.size()), fcurves_(fcurves.begin(), fcurves.end()) {
    std::vector<std::vector<Track>> of_bones(bone_count_);
    std::size_t given_count = 0;
    for (const ClipCurve& curve : curves) {
        check(curve, bone_count_, fcurves.size());
        const bool is_given = curve.fcurve < 0;
        const std::size_t source = is_given ? given_count : static_cast<std::size_t>(curve.fcurve);
        if (is_given) ++given_count;
        of_bones[static_cast<std::size_t>(curve.bone)].push_back(
            {curve.channel, is_given, curve.goes_around, source});
    }
    given_count_ = given_count;
    for (std::size_t bone = 0; bone < bone_count_; ++bone) {
        if (of_bones[bone].empty()) continue;
        unsigned said = no_channel;
        for (const Track& track : of_bones[bone]) said |= channel_of(track.channel);
        bones_.push_back(static_cast<int>(bone));
        channels_.push_back(said);
        rotations_.push_back(rotations[bone]);
        spins_.push_back(goes_around(rotations[bone], of_bones[bone]) ? rotations[bone]
                                                                      : Rotation::quaternion);
        has_spins_ = has_spins_ || spins_.back() != Rotation::quaternion;
        tracks_.insert(tracks_.end(), of_bones[bone].begin(), of_bones[bone].end());
        ends_.push_back(tracks_.size());
    }
}

bool Clip::goes_around(Rotation mode, std::span<const Track> tracks) const {
    constexpr double rounding = 1e-5;  // keys have single precision
    return std::ranges::any_of(tracks, [&](const Track& track) {
        if (track.channel < 3 || static_cast<std::size_t>(track.channel) >= 3 + angle_count(mode))
            return false;
        if (track.is_given || track.goes_around) return track.goes_around;
        const auto [least, most] = std::ranges::minmax(fcurves_[track.source].keys(), {}, value_of);
        const double low = value_of(least), high = value_of(most);
        return std::max(-low, high) > std::numbers::pi + rounding ||
               high - low > 2.0 * std::numbers::pi - rounding;
    });
}

void Clip::evaluate(double frame, std::span<const double> given, std::span<Transform> out,
                    std::span<Numbers> numbers) const {
    require(std::isfinite(frame), "frame: must be finite");
    require(given.size() == given_count_, "given: one value for each curve without an F-curve is needed");
    require(out.size() == bones_.size(), "out: one transform for each bone of the clip is needed");
    require(numbers.empty() || numbers.size() == bones_.size(),
            "numbers: four for each bone of the clip are needed");
    in_ieee_floats([&] {
        fcurve::Roots roots;
        std::size_t track = 0;
        for (std::size_t i = 0; i < bones_.size(); ++i) {
            std::array<double, channel_count> values = at_rest;
            // Euler angles have no number that is 1 at rest.
            if (rotations_[i] != Rotation::quaternion) values[3] = 0.0;
            if (rotations_[i] == Rotation::axis_angle) values[5] = 1.0;
            for (; track < ends_[i]; ++track) {
                const Track& one = tracks_[track];
                values[static_cast<std::size_t>(one.channel)] =
                    one.is_given ? or_zero(given[one.source])
                                 : or_zero(fcurves_[one.source].precise_value(frame, roots));
            }
            const std::span<const double, 4> turning = std::span(values).subspan<3, 4>();
            out[i].location = {values[0], values[1], values[2]};
            out[i].rotation = (channels_[i] & rotation) != 0 ? rotation_of(rotations_[i], turning) : no_turn;
            out[i].scale = {values[7], values[8], values[9]};
            if (!numbers.empty()) std::ranges::copy(turning, numbers[i].begin());
        }
    });
}

}  // namespace motus::bones::layers
