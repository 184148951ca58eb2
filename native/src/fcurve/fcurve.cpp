#include "motus/fcurve/fcurve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>

#include "easing.hpp"
#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"

namespace motus::fcurve {
namespace {

/// Places of keys and handles.
template <class Real>
using Place = glm::vec<2, Real>;

template <class Real>
constexpr Real same_frame{1e-4f};  // Blender's: nearer than that a frame is the key's
template <class Real>
constexpr Real flat{std::numeric_limits<float>::epsilon()};

// --- Bezier pieces ---------------------------------------------------------------------------------------

/// Frames and values of a Bezier piece. Handles longer than the way are shortened, or there would be several
/// values for a frame.
template <class Real>
struct Piece {
    std::array<Real, 4> frames, values;

    Piece(const Key& from, const Key& to)
        : frames{from.place.x, from.right.x, to.left.x, to.place.x},
          values{from.place.y, from.right.y, to.left.y, to.place.y} {}

    [[nodiscard]] bool is_flat() const {
        return std::abs(values[0] - values[3]) < flat<Real> && std::abs(values[1] - values[2]) < flat<Real> &&
               std::abs(values[2] - values[3]) < flat<Real>;
    }

    void shorten_handles() {
        shorten(0, 1);
        shorten(3, 2);
    }

  private:
    void shorten(std::size_t key, std::size_t handle) {
        const Place<Real> way(frames[key] - frames[handle], values[key] - values[handle]);
        const Real length = frames[3] - frames[0];
        if (!(std::abs(way.x) > length)) return;
        const Real share = length / std::abs(way.x);
        frames[handle] = frames[key] - share * way.x;
        values[handle] = values[key] - share * way.y;
    }
};

template <class Real>
[[nodiscard]] Real bezier(const Key& from, const Key& to, Real frame, Root<Real>& root) {
    Piece<Real> piece(from, to);
    if (piece.is_flat()) return Real{from.place.y};
    piece.shorten_handles();
    const std::optional<Real> found = root.find(piece.frames, frame);
    if (!found) return Real{0};  // Blender's
    const Real t = *found;
    const auto& p = piece.values;
    const Real three{3};
    const Real c1 = three * (p[1] - p[0]);
    const Real c2 = three * (p[0] - Real{2} * p[1] + p[2]);
    const Real c3 = p[3] - p[0] + three * (p[1] - p[2]);
    return p[0] + t * c1 + t * t * c2 + t * t * t * c3;
}

// --- keys ------------------------------------------------------------------------------------------------

template <class Real>
[[nodiscard]] Real between(const Key& from, const Key& to, Real frame, Root<Real>& root) {
    const Place<Real> begin(from.place), way = Place<Real>(to.place) - begin;
    const Real time = frame - begin.x;
    switch (from.interpolation) {
        case Interpolation::constant:
            return begin.y;
        case Interpolation::linear:
            return way.y * time / way.x + begin.y;
        case Interpolation::bezier:
            return bezier(from, to, frame, root);
        default:
            return Real{eased(from, {static_cast<float>(time), from.place.y, static_cast<float>(way.y),
                                     static_cast<float>(way.x)})};
    }
}

/// Beyond the first or last key, along a straight line. handle: of the key, on that side; neighbour: the next
/// key, none where there is no other.
template <class Real>
[[nodiscard]] Real beyond(const Key& end, const Key* neighbour, const glm::vec2& handle, Real frame) {
    const Place<Real> place(end.place);
    if (end.interpolation == Interpolation::constant) return place.y;
    const bool is_line = end.interpolation == Interpolation::linear;
    if (is_line && neighbour == nullptr) return place.y;
    // Blender's signs: the same line, but not the same bits with others.
    const Place<Real> way = is_line ? Place<Real>(neighbour->place) - place : place - Place<Real>(handle);
    if (way.x == Real{0}) return place.y;
    return place.y - way.y / way.x * (place.x - frame);
}

/// The value of the keys at a frame that is a number.
template <class Real>
[[nodiscard]] Real keyed(std::span<const Key> keys, bool goes_on, Real frame, Root<Real>& root) {
    const Key& first = keys.front();
    const Key& last = keys.back();
    const bool has_others = keys.size() > 1;
    if (frame <= Real{first.place.x})
        return goes_on ? beyond(first, has_others ? &keys[1] : nullptr, first.left, frame)
                       : Real{first.place.y};
    if (Real{last.place.x} <= frame)
        return goes_on ? beyond(last, has_others ? &keys[keys.size() - 2] : nullptr, last.right, frame)
                       : Real{last.place.y};
    const auto inner = keys.subspan(1, keys.size() - 2);
    const auto after =
        std::ranges::upper_bound(inner, frame, {}, [](const Key& key) { return Real{key.place.x}; });
    const std::size_t next = static_cast<std::size_t>(after - inner.begin()) + 1;
    const Key& to = keys[next];
    const Key& from = keys[next - 1];
    if (frame - Real{from.place.x} <= same_frame<Real>) return Real{from.place.y};
    if (Real{to.place.x} - frame <= same_frame<Real>) return Real{to.place.y};
    return between(from, to, frame, root);
}

// --- Cycles ----------------------------------------------------------------------------------------------

[[nodiscard]] float mixed(float to, float from, float share) {
    return to * share + from * (1.0f - share);
}

[[nodiscard]] float influence_at(const Cycles& cycles, float frame) {
    if (frame < cycles.start || frame > cycles.end) return 0.0f;
    if (cycles.blend_in != 0.0f && frame <= cycles.start + cycles.blend_in)
        return cycles.influence * (frame - cycles.start) / (cycles.start + cycles.blend_in - cycles.start);
    if (cycles.blend_out != 0.0f && frame >= cycles.end - cycles.blend_out)
        return cycles.influence * (frame - cycles.end) / (cycles.end - cycles.blend_out - cycles.end);
    return cycles.influence;
}

/// Where between the keys a frame is played, and what is added to the value there. NaN where products of
/// the modifier's numbers overflow.
struct Played {
    float frame, offset;
};

/// Whether the whole part of a number is odd. Beyond the range of an int Blender's conversion gives an even
/// one.
template <class Real>
[[nodiscard]] bool is_odd(Real number) {
    constexpr Real range = 2147483648.0;
    return std::abs(number) < range && static_cast<int>(number) % 2 != 0;
}

/// How many laps a frame lies beyond the keys.
struct Laps {
    double count;
    bool is_odd, is_next_odd;  ///< its whole part, and that of one more
};

/// distance: in frames from the nearer of the end keys. Real: precision of the division and of the sum, which
/// decides where a frame is nearly a whole number of laps away.
template <class Real>
[[nodiscard]] Laps laps_of(Real distance, float period) {
    const Real count = distance / static_cast<Real>(period);
    return {static_cast<double>(count), is_odd(count), is_odd(count + Real{1})};
}

/// What the modifier does on one side of the keys.
struct Side {
    Repeat mode;
    int count;
    bool is_before, is_exact;  ///< is_exact: Cycles::is_exact
};

/// A frame on that side.
[[nodiscard]] Played cycled(const Key& first, const Key& last, const Side& side, float frame) {
    const float edge = side.is_before ? first.place.x : last.place.x;
    const float period = last.place.x - first.place.x;
    if (side.mode == Repeat::none || period == 0.0f) return {frame, 0.0f};
    const Laps beyond =
        side.is_exact ? laps_of(std::abs(static_cast<double>(frame) - static_cast<double>(edge)), period)
                      : laps_of(std::abs(frame - edge), period);
    if (side.count != 0 && beyond.count > side.count) return {frame, 0.0f};
    float offset = 0.0f;
    if (side.mode == Repeat::with_offset) {
        const float laps = (frame - edge) / period;
        offset = (side.is_before ? std::floor(laps) : std::ceil(laps)) * (last.place.y - first.place.y);
    }
    const float rest = std::fmod(frame - edge, period);
    const bool is_mirrored = side.mode == Repeat::mirror;
    float found = first.place.x + rest;
    if (rest == 0.0f)
        found = side.is_before == (is_mirrored && beyond.is_odd) ? last.place.x : first.place.x;
    else if (is_mirrored && beyond.is_next_odd)
        found = edge - rest;
    if (found < first.place.x) found += period;
    return {found, offset};
}

[[nodiscard]] Played played(std::span<const Key> keys, const Cycles& cycles, float frame) {
    const Key& first = keys.front();
    const Key& last = keys.back();
    if (frame < cycles.start || frame > cycles.end) return {frame, 0.0f};
    Played found{frame, 0.0f};
    if (frame < first.place.x)
        found = cycled(first, last, {cycles.before, cycles.before_count, true, cycles.is_exact}, frame);
    else if (frame > last.place.x)
        found = cycled(first, last, {cycles.after, cycles.after_count, false, cycles.is_exact}, frame);
    found.frame = mixed(found.frame, frame, influence_at(cycles, frame));
    return found;
}

[[nodiscard]] bool is_sound(const Key& key) {
    return is_finite(key.place) && is_finite(key.left) && is_finite(key.right) &&
           are_finite(key.overshoot, key.amplitude, key.period);
}

void check(std::span<const Key> keys) {
    require(!keys.empty(), "keys: one at least is needed");
    require(std::ranges::all_of(keys, is_sound), "keys: every number must be finite");
    const bool rise = std::ranges::is_sorted(keys, {}, [](const Key& key) { return key.place.x; });
    require(rise, "keys: the frames of a curve must rise");
}

void check(const Cycles& cycles) {
    require(!std::isnan(cycles.start) && !std::isnan(cycles.end) &&
                are_finite(cycles.blend_in, cycles.blend_out, cycles.influence),
            "cycles: every number must be finite");
    require(cycles.before_count >= 0 && cycles.after_count >= 0, "cycles: a count must be >= 0");
}

}  // namespace

FCurve::FCurve(std::vector<Key> keys, bool goes_on, const std::optional<Cycles>& cycles) {
    check(keys);
    if (cycles) check(*cycles);
    const bool has_easings =
        std::ranges::any_of(keys, [](const Key& key) { return key.interpolation > Interpolation::bezier; });
    data_ = std::make_shared<const Data>(Data{std::move(keys), goes_on, !cycles && !has_easings, cycles});
}

float FCurve::value(double frame) const {
    Root<float> root;
    return value(frame, root);
}

double FCurve::precise_value(double frame, Roots& roots) const {
    if (!is_plain() || !std::isfinite(frame)) return static_cast<double>(value(frame, roots.single));
    return keyed(data_->keys, data_->goes_on, frame, roots.precise);
}

float FCurve::value(double frame, Root<float>& root) const {
    if (!std::isfinite(frame)) return std::numeric_limits<float>::quiet_NaN();
    constexpr auto farthest = static_cast<double>(std::numeric_limits<float>::max());
    const auto at = static_cast<float>(std::clamp(frame, -farthest, farthest));
    const std::optional<Cycles>& cycles = data_->cycles;
    if (!cycles) return keyed(data_->keys, data_->goes_on, at, root);
    const Played found = played(data_->keys, *cycles, at);
    if (std::isnan(found.frame)) return found.frame;
    const float value = keyed(data_->keys, data_->goes_on, found.frame, root);
    // Blender asks for the influence on the value at the frame that is played.
    const float influence = influence_at(*cycles, found.frame);
    return influence == 0.0f ? value : mixed(value + found.offset, value, influence);
}

void FCurve::values(std::span<const double> frames, std::span<double> out) const {
    require(out.size() == frames.size(), "out: one value for each frame is needed");
    require(are_finite(frames), "frames: every frame must be finite");
    in_ieee_floats([&] {
        Root<float> root;
        for (std::size_t i = 0; i < frames.size(); ++i) out[i] = static_cast<double>(value(frames[i], root));
    });
}

}  // namespace motus::fcurve
