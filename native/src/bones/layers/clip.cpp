#include "motus/bones/layers/clip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "motus/core/numeric.hpp"

namespace motus::bones::layers {
namespace {

constexpr double same_frame = 1e-4;  // Blender's: nearer than that a frame is the key's
constexpr double flat = 1.1920929e-7;
constexpr std::array<double, channel_count> at_rest{0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0};

/// What lies between two keys with handles, as a Bezier curve over frames that never turns back.
struct Piece {
    std::array<double, 4> frames{}, values{};

    Piece(const Key& from, const Key& to) {
        glm::dvec2 right = from.place - from.right;
        glm::dvec2 left = to.place - to.left;
        // Handles longer than the distance of the keys are shortened: with longer ones a frame would have
        // several values.
        const double length = to.place.x - from.place.x;
        if (std::abs(right.x) > length) right *= length / std::abs(right.x);
        if (std::abs(left.x) > length) left *= length / std::abs(left.x);
        right = from.place - right;
        left = to.place - left;
        frames = {from.place.x, right.x, left.x, to.place.x};
        values = {from.place.y, right.y, left.y, to.place.y};
    }

    [[nodiscard]] bool is_flat() const {
        return std::abs(values[0] - values[3]) < flat && std::abs(values[1] - values[2]) < flat &&
               std::abs(values[2] - values[3]) < flat;
    }
};

/// The polynomial a + b t + c t^2 + d t^3 with the Bezier control numbers given.
struct Cubic {
    double a, b, c, d;

    explicit Cubic(const std::array<double, 4>& p)
        : a(p[0]),
          b(3.0 * (p[1] - p[0])),
          c(3.0 * (p[0] - 2.0 * p[1] + p[2])),
          d(p[3] - p[0] + 3.0 * (p[1] - p[2])) {}

    [[nodiscard]] double at(double t) const { return a + t * (b + t * (c + t * d)); }
    [[nodiscard]] double slope(double t) const { return b + t * (2.0 * c + t * 3.0 * d); }
};

/// Parameter in [0, 1] at which a cubic that rises from p[0] to p[3] has a value: Newton's method within a
/// bracket.
double parameter_at(const std::array<double, 4>& p, double value) {
    const Cubic cubic(p);
    double low = 0.0, high = 1.0;
    double t = (value - p[0]) / (p[3] - p[0]);
    const double close = 1e-14 * std::max({std::abs(p[0]), std::abs(p[3]), p[3] - p[0]});
    for (int step = 0; step < 100; ++step) {
        const double miss = cubic.at(t) - value;
        if (std::abs(miss) <= close) break;
        (miss > 0.0 ? high : low) = t;
        const double slope = cubic.slope(t);
        const double next = slope > 0.0 ? t - miss / slope : -1.0;
        const double last = t;
        t = next > low && next < high ? next : 0.5 * (low + high);
        if (t == last) break;
    }
    return t;
}

/// Cache of the parameter of the last piece: curves of one bone most often have their keys at the same
/// frames.
class Parameters {
  public:
    [[nodiscard]] double find(const std::array<double, 4>& frames, double frame) {
        if (frames != frames_ || frame != frame_) {
            frames_ = frames;
            frame_ = frame;
            found_ = parameter_at(frames, frame);
        }
        return found_;
    }

  private:
    std::array<double, 4> frames_{};
    double frame_ = 0.0, found_ = 0.0;
};

/// Value before the first or after the last key. handle: of the key `end`, on the side of `neighbour`, which
/// is the key itself if there is no other key.
double beyond(const Key& end, const Key& neighbour, const glm::dvec2& handle, double frame) {
    if (end.interpolation == Interpolation::constant) return end.place.y;
    const glm::dvec2 to = end.interpolation == Interpolation::linear ? neighbour.place : handle;
    const glm::dvec2 way = to - end.place;
    return way.x == 0.0 ? end.place.y : end.place.y + (frame - end.place.x) * (way.y / way.x);
}

double value_of(std::span<const Key> keys, bool goes_on, double frame, Parameters& parameters) {
    const Key& first = keys.front();
    const Key& last = keys.back();
    // Written so that a frame that is left lies between the two, whatever the numbers.
    if (!(frame > first.place.x)) {
        if (!goes_on || frame == first.place.x) return first.place.y;
        return beyond(first, keys[keys.size() > 1 ? 1 : 0], first.left, frame);
    }
    if (!(frame < last.place.x)) {
        if (!goes_on || frame == last.place.x) return last.place.y;
        return beyond(last, keys[keys.size() > 1 ? keys.size() - 2 : 0], last.right, frame);
    }
    const auto inner = keys.subspan(1, keys.size() - 2);
    const auto after = std::ranges::upper_bound(inner, frame, {}, [](const Key& key) { return key.place.x; });
    const std::size_t next = static_cast<std::size_t>(after - inner.begin()) + 1;
    const Key& to = keys[next];
    const Key& from = keys[next - 1];
    if (frame - from.place.x < same_frame) return from.place.y;
    if (to.place.x - frame < same_frame) return to.place.y;
    if (from.interpolation == Interpolation::constant) return from.place.y;
    if (from.interpolation == Interpolation::linear)
        return from.place.y +
               (to.place.y - from.place.y) * ((frame - from.place.x) / (to.place.x - from.place.x));
    const Piece piece(from, to);
    if (piece.is_flat()) return from.place.y;
    return Cubic(piece.values).at(parameters.find(piece.frames, frame));
}

[[nodiscard]] unsigned channel_of(int number) {
    return number < 3 ? location : number < 7 ? rotation : scale;
}

void check(std::span<const Key> keys) {
    for (const Key& key : keys)
        require(motus::is_finite(key.place) && motus::is_finite(key.left) && motus::is_finite(key.right),
                "keys: every number must be finite");
}

/// Checks that the keys of one curve rise.
void check_rise(std::span<const Key> keys) {
    const bool rise = std::ranges::is_sorted(keys, {}, [](const Key& key) { return key.place.x; });
    require(rise, "keys: the frames of a curve must rise");
}

void check(const Curve& curve, std::size_t bone_count, std::span<const Key> keys) {
    require(curve.bone >= 0 && static_cast<std::size_t>(curve.bone) < bone_count,
            "curves: a bone is not there");
    require(curve.channel >= 0 && curve.channel < channel_count, "curves: a channel must be 0 to 9");
    require(curve.first >= 0 && curve.count >= 0 &&
                static_cast<std::size_t>(curve.first) + static_cast<std::size_t>(curve.count) <= keys.size(),
            "curves: keys are not there");
    check_rise(keys.subspan(static_cast<std::size_t>(curve.first), static_cast<std::size_t>(curve.count)));
}

}  // namespace

double value_at(std::span<const Key> keys, bool goes_on, double frame) {
    require(!keys.empty(), "keys: one at least is needed");
    require(std::isfinite(frame), "frame: must be finite");
    check(keys);
    check_rise(keys);
    Parameters parameters;
    return value_of(keys, goes_on, frame, parameters);
}

Clip::Clip(std::span<const Rotation> rotations, std::span<const Curve> curves, std::span<const Key> keys)
    : bone_count_(rotations.size()), keys_(keys.begin(), keys.end()) {
    check(keys);
    std::vector<std::vector<Track>> of_bones(bone_count_);
    for (const Curve& curve : curves) {
        check(curve, bone_count_, keys);
        const std::size_t given = curve.count == 0 ? given_count_++ : 0;
        of_bones[static_cast<std::size_t>(curve.bone)].push_back(
            {curve.channel, curve.first, curve.count, curve.goes_on, given});
    }
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
        if (track.count == 0) return track.goes_on;
        const auto keys = std::span(keys_).subspan(static_cast<std::size_t>(track.first),
                                                   static_cast<std::size_t>(track.count));
        const auto [least, most] = std::ranges::minmax(keys, {}, [](const Key& key) { return key.place.y; });
        return std::max(-least.place.y, most.place.y) > std::numbers::pi + rounding ||
               most.place.y - least.place.y > 2.0 * std::numbers::pi - rounding;
    });
}

void Clip::evaluate(double frame, std::span<const double> given, std::span<Transform> out,
                    std::span<Numbers> numbers) const {
    require(std::isfinite(frame), "frame: must be finite");
    require(given.size() == given_count_, "given: one value for each curve without keys is needed");
    require(out.size() == bones_.size(), "out: one transform for each bone of the clip is needed");
    require(numbers.empty() || numbers.size() == bones_.size(),
            "numbers: four for each bone of the clip are needed");
    Parameters parameters;
    std::size_t track = 0;
    for (std::size_t i = 0; i < bones_.size(); ++i) {
        std::array<double, channel_count> values = at_rest;
        // Euler angles have no number that is 1 at rest.
        if (rotations_[i] != Rotation::quaternion) values[3] = 0.0;
        if (rotations_[i] == Rotation::axis_angle) values[5] = 1.0;
        for (; track < ends_[i]; ++track) {
            const Track& one = tracks_[track];
            values[static_cast<std::size_t>(one.channel)] =
                one.count == 0 ? given[one.given]
                               : value_of(std::span(keys_).subspan(static_cast<std::size_t>(one.first),
                                                                   static_cast<std::size_t>(one.count)),
                                          one.goes_on, frame, parameters);
        }
        const std::span<const double, 4> turning = std::span(values).subspan<3, 4>();
        out[i].location = {values[0], values[1], values[2]};
        out[i].rotation = (channels_[i] & rotation) != 0 ? rotation_of(rotations_[i], turning) : no_turn;
        out[i].scale = {values[7], values[8], values[9]};
        if (!numbers.empty()) std::ranges::copy(turning, numbers[i].begin());
    }
}

}  // namespace motus::bones::layers
