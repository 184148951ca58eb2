// F-curves: keys, what lies between and beyond them, and the Cycles modifier, as Blender 3.4 to 5.2 evaluate
// them. A value in single precision is computed in Blender's order of operations, so that it has Blender's
// bits if both use the same mathematics library.
//
// Costs: O(n) to make a curve, which allocates it; O(log n) a frame, which allocates nothing. Immutable:
// any number of threads may share one, each with Roots of its own.
#pragma once
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motus/config.hpp"

namespace motus::fcurve {

/// How the value goes on after a key; Blender's numbers.
enum class Interpolation : int {
    constant = 0,
    linear,
    bezier,
    back,
    bounce,
    circular,
    cubic,
    elastic,
    exponential,
    quadratic,
    quartic,
    quintic,
    sinusoidal
};
inline constexpr int interpolation_count = 13;

/// At which key an eased value is slow; Blender's numbers. automatic: at the second one (out) for back,
/// bounce and elastic, at the first one (in) for all others.
enum class Easing : int { automatic = 0, in, out, in_out };
inline constexpr int easing_count = 4;

/// A key and the handles on both its sides: frame and value.
struct Key {
    glm::vec2 place{0.0f}, left{0.0f}, right{0.0f};
    Interpolation interpolation = Interpolation::bezier;
    Easing easing = Easing::automatic;
    float overshoot = 1.70158f;  ///< of back
    float amplitude = 0.0f;      ///< of elastic, as a value; 0: of the change from this key to the next one
    float period = 0.0f;         ///< of elastic, frames; 0: a share of the way to the next key
};

/// What a Cycles modifier does on one side of the keys; Blender's numbers.
enum class Repeat : int { none = 0, repeat, with_offset, mirror };
inline constexpr int repeat_count = 4;

/// The Cycles modifier of Blender.
struct Cycles {
    Repeat before = Repeat::repeat, after = Repeat::repeat;
    int before_count = 0, after_count = 0;  ///< how often; 0: for ever
    /// Frames between which it acts, and over how many of these its influence rises and falls.
    float start = -std::numeric_limits<float>::infinity(), end = std::numeric_limits<float>::infinity();
    float blend_in = 0.0f, blend_out = 0.0f;
    float influence = 1.0f;
    /// Laps are counted in double precision, as newer versions of Blender do; else in single precision, by
    /// which a frame that is nearly a whole number of laps away may count to the next lap.
    bool is_exact = true;
};

/// The parameter on [0, 1] at which the cubic Bezier polynomial of four rising frames has a frame. In single
/// precision it has Blender's bits, and none is found where rounding leaves none.
[[nodiscard]] std::optional<float> parameter_at(const std::array<float, 4>& frames, float frame);
[[nodiscard]] std::optional<double> parameter_at(const std::array<double, 4>& frames, double frame);

/// Cache of the last parameter_at(), for curves that have keys on the same frames, as those of a bone most
/// often do. Real: float or double.
template <class Real>
class Root {
  public:
    [[nodiscard]] std::optional<Real> find(const std::array<Real, 4>& frames, Real frame) {
        if (frame != frame_ || frames != frames_) {
            frames_ = frames;
            frame_ = frame;
            found_ = parameter_at(frames, frame);
        }
        return found_;
    }

  private:
    std::array<Real, 4> frames_{};
    Real frame_ = std::numeric_limits<Real>::quiet_NaN();
    std::optional<Real> found_;
};

/// A cache for each of both precisions.
struct Roots {
    Root<float> single;
    Root<double> precise;
};

/// Immutable; copies share their keys, and to move one is to copy it.
class FCurve {
  public:
    /// keys: one at least, their frames rising. goes_on: beyond them as a straight line, else the value
    /// holds. std::invalid_argument where that is not so, or a number is not finite (start and end of Cycles
    /// may be infinite).
    FCurve(std::vector<Key> keys, bool goes_on, const std::optional<Cycles>& cycles = std::nullopt);

    ~FCurve() = default;
    FCurve(const FCurve&) noexcept = default;
    FCurve& operator=(const FCurve&) noexcept = default;
    // A curve that is moved from stays the curve that it was.
    // NOLINTNEXTLINE(performance-move-constructor-init): copying is what it is for, and costs a counter
    FCurve(FCurve&& other) noexcept : FCurve(std::as_const(other)) {}
    FCurve& operator=(FCurve&& other) noexcept { return *this = std::as_const(other); }

    [[nodiscard]] std::span<const Key> keys() const noexcept { return data_->keys; }
    /// Whether it has neither easings that go by a name nor a Cycles modifier.
    [[nodiscard]] bool is_plain() const noexcept { return data_->is_plain; }

    /// At a frame, which is rounded to single precision, or to the end of its range. Infinite or NaN where
    /// Blender's value overflows, NaN where the frame is not finite.
    [[nodiscard]] float value(double frame) const;
    /// At a frame, in double precision if the curve is plain; else value(). Poses that are computed from the
    /// values of many curves do not add up their rounding then. roots: of the last curve that was asked.
    [[nodiscard]] double precise_value(double frame, Roots& roots) const;
    /// At frames, in any order. out: as many. std::invalid_argument where a frame is not finite.
    void values(std::span<const double> frames, std::span<double> out) const;

  private:
    struct Data {
        std::vector<Key> keys;
        bool goes_on, is_plain;
        std::optional<Cycles> cycles;
    };

    [[nodiscard]] float value(double frame, Root<float>& root) const;

    std::shared_ptr<const Data> data_;  ///< never null
};

}  // namespace motus::fcurve
