#include "motus/bones/layers/stack.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "motus/bones/layers/mask.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::layers {

/// The room that all layers of one call share.
class Stack::Solver {
  public:
    Solver(const Stack& stack, std::size_t most, std::span<Transform> bones, std::span<char> changed)
        : stack_(stack), source_(most), angles_(most), bones_(bones), changed_(changed) {}

    void lay(double frame, const Layer& layer) {
        const Moment moment = moment_of(layer.timing, frame);
        const double weight = layer.weight * moment.weight;
        if (!(weight > 0.0)) return;
        const Clip& clip = *layer.clip;
        const std::span<Transform> source = std::span(source_).first(clip.bones().size());
        clip.evaluate(moment.frame, layer.given, source, std::span(angles_).first(source.size()));
        if (layer.in_armature) {
            turn_in_armature(layer, source, weight);
            blend(layer, source, weight, location | scale);
        } else {
            blend(layer, source, weight, location | rotation | scale);
        }
    }

  private:
    [[nodiscard]] static Transform reference_of(const Layer& layer, std::size_t i) {
        return layer.reference.empty() ? Transform{} : layer.reference[i];
    }

    void set(std::size_t bone, const Transform& result) {
        if (!is_finite(result)) return;
        bones_[bone] = result;
        changed_[bone] = 1;
    }

    /// Bone by bone, each in its own axes.
    void blend(const Layer& layer, std::span<const Transform> source, double weight, unsigned wanted) {
        const Clip& clip = *layer.clip;
        for (std::size_t i = 0; i < source.size(); ++i) {
            const auto bone = static_cast<std::size_t>(clip.bones()[i]);
            const double share = weight * layer.mask[bone];
            const unsigned channels = clip.channels()[i] & wanted;
            if (!(share > 0.0) || channels == no_channel) continue;
            const Transform& base = bones_[bone];
            Transform result = layer.mode == Mode::override
                                   ? overridden(base, source[i], share, channels)
                                   : added(base, source[i], reference_of(layer, i), share, channels);
            if ((channels & rotation) != 0 && clip.spins()[i].is_on() && share < 1.0)
                result.rotation =
                    normalized_product(layer.mode == Mode::override
                                           ? clip.spins()[i].towards(base.rotation, angles_[i], share)
                                           : base.rotation * spun(layer, i, share));
            set(bone, result);
        }
    }

    /// The share of the turn from the reference's angles of a bone that spins to those of the clip, after the
    /// reference.
    [[nodiscard]] glm::dquat spun(const Layer& layer, std::size_t i, double share) const {
        const Spin& spin = layer.clip->spins()[i];
        const glm::dquat reference = reference_of(layer, i).rotation;
        const glm::dvec3 from = layer.reference_angles.empty()
                                    ? angles_near(spin.mode, reference, spin.first)
                                    : layer.reference_angles[i];
        return glm::conjugate(reference) * of_angles(spin.mode, glm::mix(from, angles_[i], share));
    }

    /// What the bone's own rotation turns on: its parent's, and how it lies on that at rest.
    [[nodiscard]] glm::dquat carried(std::size_t bone, const std::vector<glm::dquat>& turned) const {
        const glm::dquat& rest = stack_.from_parent_[bone];
        if (stack_.follows_[bone] == 0) return rest;
        return turned[static_cast<std::size_t>(stack_.parents_[bone])] * rest;
    }

    /// The rotations alone, blended as they are in the armature.
    void turn_in_armature(const Layer& layer, std::span<const Transform> source, double weight) {
        const Clip& clip = *layer.clip;
        const std::size_t count = stack_.size();
        beneath_.resize(count);
        above_.resize(count);
        said_.assign(count, no_turn);
        said_reference_.assign(count, no_turn);
        share_.assign(count, 0.0);
        spinning_.assign(count, none);
        for (std::size_t i = 0; i < source.size(); ++i) {
            if ((clip.channels()[i] & rotation) == 0) continue;
            const auto bone = static_cast<std::size_t>(clip.bones()[i]);
            said_[bone] = source[i].rotation;
            said_reference_[bone] = reference_of(layer, i).rotation;
            share_[bone] = weight * layer.mask[bone];
            if (clip.spins()[i].is_on() && share_[bone] < 1.0) spinning_[bone] = i;
        }
        for (const int next : stack_.order_) {
            const auto bone = static_cast<std::size_t>(next);
            const glm::dquat own = bones_[bone].rotation;
            beneath_[bone] = normalized_product(carried(bone, beneath_) * own);
            const glm::dquat carries = carried(bone, said_), carries_reference = carried(bone, said_reference_);
            said_[bone] = normalized_product(carries * said_[bone]);
            said_reference_[bone] = normalized_product(carries_reference * said_reference_[bone]);
            const glm::dquat on = carried(bone, above_);
            if (!(share_[bone] > 0.0)) {
                above_[bone] = normalized_product(on * own);
                continue;
            }
            above_[bone] = spinning_[bone] == none ? in_armature(layer.mode, bone)
                                                   : spinning(layer, bone, carries, carries_reference);
            Transform result = bones_[bone];
            result.rotation = normalized_product(glm::conjugate(on) * above_[bone]);
            set(bone, result);
        }
    }

    [[nodiscard]] glm::dquat in_armature(Mode mode, std::size_t bone) const {
        const glm::dquat& base = beneath_[bone];
        if (mode == Mode::override)
            return share_[bone] >= 1.0
                       ? said_[bone]
                       : normalized_product(part_of_turn(said_[bone] * glm::conjugate(base), share_[bone]) *
                                            base);
        return normalized_product(
            part_of_turn(said_[bone] * glm::conjugate(said_reference_[bone]), share_[bone]) * base);
    }

    /// The same of a bone that spins. carries, carries_reference: what its own rotation turns on, as the clip
    /// and the reference have it.
    [[nodiscard]] glm::dquat spinning(const Layer& layer, std::size_t bone, const glm::dquat& carries,
                                      const glm::dquat& carries_reference) const {
        const std::size_t i = spinning_[bone];
        const double share = share_[bone];
        const glm::dquat& base = beneath_[bone];
        if (layer.mode == Mode::override)
            return normalized_product(
                carries *
                layer.clip->spins()[i].towards(glm::conjugate(carries) * base, angles_[i], share));
        const glm::dquat reference = glm::conjugate(carries_reference) * said_reference_[bone];
        const glm::dquat own = reference * spun(layer, i, share) * glm::conjugate(reference);
        const glm::dquat above = part_of_turn(carries * glm::conjugate(carries_reference), share);
        return normalized_product(carries * own * glm::conjugate(carries) * above * base);
    }

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    const Stack& stack_;
    std::vector<Transform> source_;
    std::vector<glm::dvec3> angles_;  // of source_
    std::span<Transform> bones_;
    std::span<char> changed_;
    // Rotations in the armature: beneath the layer, with it, as the clip and the reference have them.
    std::vector<glm::dquat> beneath_, above_, said_, said_reference_;
    std::vector<double> share_;
    std::vector<std::size_t> spinning_;  // which bone of the clip spins, of those that take a share below 1
};

Stack::Stack(std::span<const int> parents, std::span<const glm::dquat> rest, std::span<const char> inherits)
    : parents_(parents.begin(), parents.end()), order_(parents_first(parents)) {
    require(rest.size() == parents.size(), "rest: one rotation for each bone is needed");
    require(inherits.size() == parents.size(), "inherits: one for each bone is needed");
    for (std::size_t bone = 0; bone < parents.size(); ++bone) {
        const bool follows = parents[bone] >= 0 && inherits[bone] != 0;
        follows_.push_back(follows ? 1 : 0);
        from_parent_.push_back(follows ? glm::conjugate(rest[static_cast<std::size_t>(parents[bone])]) *
                                             rest[bone]
                                       : rest[bone]);
    }
}

void Stack::solve(double frame, std::span<const Layer> layers, std::span<const Transform> base,
                  std::span<Transform> result, std::span<char> changed) const {
    require(base.size() == size() && result.size() == size() && changed.size() == size(),
            "base: one transform for each bone is needed");
    std::size_t most = 0;
    for (const Layer& layer : layers) {
        require(layer.clip != nullptr && layer.clip->bone_count() == size(),
                "clips: another number of bones");
        require(layer.mask.size() == size(), "masks: one weight for each bone is needed");
        require(layer.reference.empty() || layer.reference.size() == layer.clip->bones().size(),
                "references: one transform for each bone of the clip is needed");
        require(layer.reference_angles.empty() ||
                    layer.reference_angles.size() == layer.clip->bones().size(),
                "references: three angles for each bone of the clip are needed");
        most = std::max(most, layer.clip->bones().size());
    }
    if (result.data() != base.data()) std::ranges::copy(base, result.begin());
    std::ranges::fill(changed, 0);
    Solver solver(*this, most, result, changed);
    for (const Layer& layer : layers) solver.lay(frame, layer);
}

}  // namespace motus::bones::layers
