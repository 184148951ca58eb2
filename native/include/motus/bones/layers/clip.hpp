// What an action says of a rig's bones: its F-curves as plain arrays.
#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "motus/bones/layers/spin.hpp"
#include "motus/bones/layers/transform.hpp"

namespace motus::bones::layers {

/// How the value goes on after a key.
enum class Interpolation : int { constant = 0, linear = 1, bezier = 2 };

/// A key of an F-curve, and the handles on both its sides: frame and value.
struct Key {
    glm::dvec2 place{0.0}, left{0.0}, right{0.0};
    Interpolation interpolation = Interpolation::bezier;
};

/// Which number of a bone an F-curve animates, and where its keys lie among those of the clip.
struct Curve {
    int bone = 0;
    int channel = 0;       ///< 0-2 location, 3-6 the numbers of its rotation, 7-9 scale
    int first = 0;         ///< index of its first key
    int count = 0;         ///< 0: no keys, the caller gives its value
    bool goes_on = false;  ///< beyond its keys as a straight line; else it holds. Without keys: it is an
                           ///< angle that goes beyond half a turn
};
inline constexpr int channel_count = 10;

/// Value of an F-curve at a frame, as Blender 3.4 to 5.2 evaluate it, but in double precision. keys: at least
/// one, their frames rising. std::invalid_argument where that is not so, or a number is not finite.
[[nodiscard]] double value_at(std::span<const Key> keys, bool goes_on, double frame);

/// Immutable.
class Clip {
  public:
    /// rotations: one for each bone of the rig. keys: of all curves. Of a bone and channel that is named
    /// twice the later curve counts. std::invalid_argument where something names what is not there, keys of a
    /// curve do not rise, or a number is not finite.
    Clip(std::span<const Rotation> rotations, std::span<const Curve> curves, std::span<const Key> keys);

    /// Bones that it animates, rising.
    [[nodiscard]] std::span<const int> bones() const noexcept { return bones_; }
    /// Channels that it says of each of these; what it does not say of a channel that it says, is as at rest.
    [[nodiscard]] std::span<const unsigned> channels() const noexcept { return channels_; }
    [[nodiscard]] std::size_t bone_count() const noexcept { return bone_count_; }
    /// Of each of these its rotation mode, if its angles go beyond half a turn, or by a whole turn from key
    /// to key; else the mode of quaternions, which know no whole turns.
    [[nodiscard]] std::span<const Rotation> spins() const noexcept { return spins_; }
    /// Whether any of them does.
    [[nodiscard]] bool has_spins() const noexcept { return has_spins_; }
    /// How many curves have no keys.
    [[nodiscard]] std::size_t given_count() const noexcept { return given_count_; }

    /// given: values of the curves without keys, in their order. out: one a bone of bones(). numbers: the
    /// same, or none: what the bones' rotations are made of. std::invalid_argument where there are more or
    /// fewer, or the frame is not finite.
    void evaluate(double frame, std::span<const double> given, std::span<Transform> out,
                  std::span<Numbers> numbers = {}) const;

  private:
    /// A Curve, sorted by bone; given: which of those without keys it is.
    struct Track {
        int channel, first, count;
        bool goes_on;
        std::size_t given;
    };

    [[nodiscard]] bool goes_around(Rotation mode, std::span<const Track> tracks) const;

    std::size_t bone_count_, given_count_ = 0;
    bool has_spins_ = false;
    std::vector<Key> keys_;
    std::vector<int> bones_;
    std::vector<unsigned> channels_;
    std::vector<Rotation> rotations_, spins_;  // of bones_
    std::vector<std::size_t> ends_;            // of the tracks of each bone
    std::vector<Track> tracks_;
};

}  // namespace motus::bones::layers
