// Layers of animation over the pose that a rig has by itself.
//
// Costs: O(bones) to make, O(layers (curves + bones)) to solve and to find a source. All allocate. Immutable:
// any number of threads may share one.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "motus/bones/layers/clip.hpp"
#include "motus/bones/layers/timing.hpp"
#include "motus/bones/layers/transform.hpp"
#include "motus/config.hpp"

namespace motus::bones::layers {

/// How a layer acts on what lies beneath it.
enum class LayerMode : int {
    override = 0,  ///< takes its place
    additive = 1   ///< adds the difference between its action and the reference pose
};

/// Where a bone that goes around begins, and what it has come to at the end of a lap.
struct Lap {
    Numbers from{};  ///< of the first pose that the layer plays; of an additive one's reference, if that is a
                     ///< pose of the clip
    Numbers gained{};  ///< from the first pose to the last one that is played
};

/// One layer at one moment; views of somebody's memory.
struct Layer {
    const Clip* clip = nullptr;
    std::span<const double> given;  ///< values of the clip's curves without keys
    std::span<const double> mask;   ///< one for each bone of the rig, 0 to 1
    std::span<const Transform>
        reference;  ///< one for each bone of the clip, or none: the rest pose; of an additive layer
    std::span<const Lap> laps;  ///< one for each bone of the clip, or none: all rotations go the shorter way
    LayerTiming timing;
    double weight = 1.0;  ///< 0 to 1
    LayerMode mode = LayerMode::override;
    /// Rotations are laid over each other as they are in the armature, so that bones outside of the mask do
    /// not turn those inside: bones above that the clip does not rotate count as being at rest.
    bool in_armature = false;
};

/// What the bones of one rig hang on. Immutable.
class Stack {
  public:
    /// parents: index of each bone's parent, -1 for none. rest: rotation of each bone in the armature at
    /// rest, unit quaternions. inherits: whether each bone turns along with its parent; not 0: it does.
    /// std::invalid_argument where there are more or fewer, or a parent is none.
    Stack(std::span<const int> parents, std::span<const glm::dquat> rest, std::span<const char> inherits);

    [[nodiscard]] std::size_t size() const noexcept { return parents_.size(); }
    [[nodiscard]] std::span<const int> parents() const noexcept { return parents_; }
    [[nodiscard]] std::span<const int> order() const noexcept { return order_; }

    /// Lays the layers, the lowest first, over the bones' own transforms, at a frame of the scene. base and
    /// result: one for each bone of the rig; result may be base. changed: for each bone not 0 where a layer
    /// has laid something on it; all others are bit for bit what they were. A bone with numbers that are not
    /// finite stays as it is. std::invalid_argument, before anything is written, where sizes do not fit, or
    /// the frame, a layer's weight or a number of its timing is not finite or outside its domain.
    void solve(double frame, std::span<const Layer> layers, std::span<const Transform> base,
               std::span<Transform> result, std::span<char> changed) const;

    /// What the clip of layers[edited] has to say at a frame of the scene, so that solve() gives the pose
    /// `wanted`. base and wanted: one for each bone of the rig. chosen: bones of which the clip is to say
    /// something. said: for each of these what that is. reached: for each of these the Channels in which
    /// solve() then gives what is wanted. Others are hidden by a layer above, have no share in the layer, or
    /// would have to turn by more than half a turn, to go around at a part of the weight, or to scale what is
    /// 0; of these `said` is as near as can be, and finite. A bone that the clip does not animate has its
    /// reference at rest. std::invalid_argument as of solve(), and where there is no such layer or bone.
    void find_source(double frame, std::span<const Layer> layers, std::size_t edited,
                     std::span<const Transform> base, std::span<const Transform> wanted,
                     std::span<const int> chosen, std::span<Transform> said,
                     std::span<unsigned> reached) const;

  private:
    class Solver;
    class Finder;
    /// The greatest number of bones in a layer's clip. std::invalid_argument where arguments do not fit.
    [[nodiscard]] std::size_t checked(double frame, std::span<const Layer> layers,
                                      std::span<const Transform> base) const;
    std::vector<int> parents_, order_;
    std::vector<glm::dquat>
        from_parent_;  ///< rest in the parent's axes; of what does not turn with it, in the armature's
    std::vector<char> follows_;  ///< whether the bone turns along with a parent
};

}  // namespace motus::bones::layers
