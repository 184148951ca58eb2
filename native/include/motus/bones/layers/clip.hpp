// What an action says of a rig's bones: its F-curves, an animation clip.
//
// Costs: O(n log n) to make, O(curves log keys) to evaluate. Making one allocates it, evaluating nothing.
// Immutable: any number of threads may share one.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "motus/bones/layers/spin.hpp"
#include "motus/bones/layers/transform.hpp"
#include "motus/config.hpp"
#include "motus/core/leaves_zero.hpp"
#include "motus/fcurve/fcurve.hpp"

namespace motus::bones::layers {

/// Which number of a bone an F-curve animates.
struct ClipCurve {
    int bone = 0;
    int channel = 0;  ///< 0-2 location, 3-6 the numbers of its rotation, 7-9 scale
    int fcurve = -1;  ///< index among those of the clip; -1: the caller gives its value
    bool goes_around =
        false;  ///< whether it counts as an angle that goes beyond half a turn, whatever its keys say
};
inline constexpr int channel_count = 10;

/// Immutable. What is moved from animates no bone.
class Clip {
  public:
    /// rotations: one for each bone of the rig. Of a bone and channel that is named twice the later curve
    /// counts. std::invalid_argument where something names what is not there.
    Clip(std::span<const Rotation> rotations, std::span<const ClipCurve> curves,
         std::span<const fcurve::FCurve> fcurves);

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
    /// How many curves the caller gives the values of.
    [[nodiscard]] std::size_t given_count() const noexcept { return given_count_; }

    /// given: values of the curves that have no F-curve, in their order. out: one a bone of bones(). numbers:
    /// the same, or none: what the bones' rotations are made of. std::invalid_argument where there are more
    /// or fewer, or the frame is not finite. Values that are not finite count as 0.
    void evaluate(double frame, std::span<const double> given, std::span<Transform> out,
                  std::span<Numbers> numbers = {}) const;

  private:
    /// A Curve, sorted by bone. source: index among the F-curves, or among what is given.
    struct Track {
        int channel;
        bool is_given, goes_around;
        std::size_t source;
    };

    [[nodiscard]] bool goes_around(Rotation mode, std::span<const Track> tracks) const;

    LeavesZero<std::size_t> bone_count_, given_count_;
    LeavesZero<bool> has_spins_;
    std::vector<fcurve::FCurve> fcurves_;
    std::vector<int> bones_;
    std::vector<unsigned> channels_;
    std::vector<Rotation> rotations_, spins_;  // of bones_
    std::vector<std::size_t> ends_;            // of the tracks of each bone
    std::vector<Track> tracks_;
};

}  // namespace motus::bones::layers
