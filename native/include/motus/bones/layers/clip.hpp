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
    bool goes_on = false;  ///< beyond its keys as a straight line; else it holds
};
inline constexpr int channel_count = 10;

/// Value of an F-curve at a frame, as Blender 3.4 to 5.2 evaluate it, but in double precision. keys: at least
/// one, their frames rising.
[[nodiscard]] double value_at(std::span<const Key> keys, bool goes_on, double frame);

/// A unit quaternion of up to four numbers in a rotation mode. Of no length: half a turn about X, of an axis
/// without one no turn, as Blender has them.
[[nodiscard]] glm::dquat rotation_of(Rotation mode, std::span<const double, 4> numbers);

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
    /// How each of them turns; on where a key of its Euler angles lies beyond half a turn.
    [[nodiscard]] std::span<const Spin> spins() const noexcept { return spins_; }
    /// How many curves have no keys.
    [[nodiscard]] std::size_t given_count() const noexcept { return given_count_; }

    /// given: values of the curves without keys, in their order. out: one a bone of bones(). angles: the same,
    /// or none: what the Euler angles are of bones that spin. std::invalid_argument where there are more or
    /// fewer.
    void evaluate(double frame, std::span<const double> given, std::span<Transform> out,
                  std::span<glm::dvec3> angles = {}) const;

  private:
    /// A Curve, sorted by bone; given: which of those without keys it is.
    struct Track {
        int channel, first, count;
        bool goes_on;
        std::size_t given;
    };

    /// How a bone with these F-curves turns.
    [[nodiscard]] Spin spin_of(Rotation mode, std::span<const Track> tracks) const;

    std::size_t bone_count_, given_count_ = 0;
    std::vector<Key> keys_;
    std::vector<int> bones_;
    std::vector<unsigned> channels_;
    std::vector<Rotation> rotations_;  // of bones_
    std::vector<Spin> spins_;
    std::vector<std::size_t> ends_;    // of the tracks of each bone
    std::vector<Track> tracks_;
};

}  // namespace motus::bones::layers
