#include "motus/bones/layers/clip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "motus/core/numeric.hpp"
#include "trigonometry.hpp"

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
        // Handles longer than the way are shortened, or there would be several values for a frame.
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

/// a + b t + c t^2 + d t^3 of four control numbers.
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

/// Where on [0, 1] a cubic that rises from p[0] to p[3] has a value between: Newton's method in a bracket.
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

/// The parameter of the last piece, which curves of a bone most often share.
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

/// Beyond the first or last key. handle: of the key, towards `neighbour`, which is the key itself where there
/// is no other.
double beyond(const Key& end, const Key& neighbour, const glm::dvec2& handle, double frame) {
    if (end.interpolation == Interpolation::constant) return end.place.y;
    const glm::dvec2 to = end.interpolation == Interpolation::linear ? neighbour.place : handle;
    const glm::dvec2 way = to - end.place;
    return way.x == 0.0 ? end.place.y : end.place.y + (frame - end.place.x) * (way.y / way.x);
}

double value_of(std::span<const Key> keys, bool goes_on, double frame, Parameters& parameters) {
    const Key& first = keys.front();
    const Key& last = keys.back();
    if (frame <= first.place.x) {
        if (!goes_on || frame == first.place.x) return first.place.y;
        return beyond(first, keys[keys.size() > 1 ? 1 : 0], first.left, frame);
    }
    if (frame >= last.place.x) {
        if (!goes_on || frame == last.place.x) return last.place.y;
        return beyond(last, keys[keys.size() > 1 ? keys.size() - 2 : 0], last.right, frame);
    }
    const auto after = std::ranges::upper_bound(keys, frame, {}, [](const Key& key) { return key.place.x; });
    const Key& to = *after;
    const Key& from = *(after - 1);
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

void check(const Curve& curve, std::size_t bone_count, std::span<const Key> keys) {
    require(curve.bone >= 0 && static_cast<std::size_t>(curve.bone) < bone_count,
            "curves: a bone is not there");
    require(curve.channel >= 0 && curve.channel < channel_count, "curves: a channel must be 0 to 9");
    require(curve.first >= 0 && curve.count >= 0 &&
                static_cast<std::size_t>(curve.first) + static_cast<std::size_t>(curve.count) <= keys.size(),
            "curves: keys are not there");
    for (int i = curve.first + 1; i < curve.first + curve.count; ++i)
        require(keys[static_cast<std::size_t>(i) - 1].place.x <= keys[static_cast<std::size_t>(i)].place.x,
                "keys: the frames of a curve must rise");
}

}  // namespace

double value_at(std::span<const Key> keys, bool goes_on, double frame) {
    Parameters parameters;
    return value_of(keys, goes_on, frame, parameters);
}

glm::dquat rotation_of(Rotation mode, std::span<const double, 4> numbers) {
    if (mode == Rotation::axis_angle) {
        const glm::dvec3 axis = direction_or({numbers[1], numbers[2], numbers[3]}, glm::dvec3(0.0));
        if (axis == glm::dvec3(0.0)) return no_turn;
        const Angle half = angle_of(0.5 * numbers[0]);
        return {half.cosine, half.sine * axis.x, half.sine * axis.y, half.sine * axis.z};
    }
    if (mode != Rotation::quaternion) return of_angles(mode, {numbers[0], numbers[1], numbers[2]});
    const glm::dquat q{numbers[0], numbers[1], numbers[2], numbers[3]};
    const double square = glm::dot(q, q);
    constexpr double vanished = 1e-280;
    if (!(square > vanished)) return {0.0, 1.0, 0.0, 0.0};
    return q * (1.0 / std::sqrt(square));
}

Clip::Clip(std::span<const Rotation> rotations, std::span<const Curve> curves, std::span<const Key> keys)
    : bone_count_(rotations.size()), keys_(keys.begin(), keys.end()) {
    for (const Key& key : keys)
        require(motus::is_finite(key.place) && motus::is_finite(key.left) && motus::is_finite(key.right),
                "keys: every number must be finite");
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
        spins_.push_back(spin_of(rotations[bone], of_bones[bone]));
        tracks_.insert(tracks_.end(), of_bones[bone].begin(), of_bones[bone].end());
        ends_.push_back(tracks_.size());
    }
}

Spin Clip::spin_of(Rotation mode, std::span<const Track> tracks) const {
    Spin spin{mode, glm::dvec3(0.0)};
    if (!is_euler(mode)) return {};
    constexpr double half_turn = 3.1415928;  // as single precision may have it
    bool is_beyond = false;
    for (const Track& track : tracks) {
        const int axis = track.channel - 3;
        if (axis < 0 || axis > 2 || track.count == 0) continue;
        const std::span<const Key> keys =
            std::span(keys_).subspan(static_cast<std::size_t>(track.first), static_cast<std::size_t>(track.count));
        spin.first[axis] = keys.front().place.y;
        is_beyond = is_beyond || std::ranges::any_of(keys, [](const Key& key) {
                        return std::abs(key.place.y) > half_turn;
                    });
    }
    return is_beyond ? spin : Spin{};
}

void Clip::evaluate(double frame, std::span<const double> given, std::span<Transform> out,
                    std::span<glm::dvec3> angles) const {
    require(given.size() == given_count_, "given: one value for each curve without keys is needed");
    require(out.size() == bones_.size(), "out: one transform for each bone of the clip is needed");
    require(angles.empty() || angles.size() == bones_.size(),
            "angles: three numbers for each bone of the clip are needed");
    Parameters parameters;
    std::size_t track = 0;
    for (std::size_t i = 0; i < bones_.size(); ++i) {
        std::array<double, channel_count> numbers = at_rest;
        // Euler angles have no number that is 1 at rest.
        if (rotations_[i] != Rotation::quaternion) numbers[3] = 0.0;
        if (rotations_[i] == Rotation::axis_angle) numbers[5] = 1.0;
        for (; track < ends_[i]; ++track) {
            const Track& one = tracks_[track];
            numbers[static_cast<std::size_t>(one.channel)] =
                one.count == 0 ? given[one.given]
                               : value_of(std::span(keys_).subspan(static_cast<std::size_t>(one.first),
                                                                   static_cast<std::size_t>(one.count)),
                                          one.goes_on, frame, parameters);
        }
        out[i].location = {numbers[0], numbers[1], numbers[2]};
        if ((channels_[i] & rotation) != 0)
            out[i].rotation = rotation_of(rotations_[i], std::span(numbers).subspan<3, 4>());
        else
            out[i].rotation = no_turn;
        out[i].scale = {numbers[7], numbers[8], numbers[9]};
        if (!angles.empty())
            angles[i] = spins_[i].is_on() ? glm::dvec3(numbers[3], numbers[4], numbers[5]) : glm::dvec3(0.0);
    }
}

}  // namespace motus::bones::layers
