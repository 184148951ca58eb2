// How one layer is laid over a pose: what laying layers and looking back through them share.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "motus/bones/layers/stack.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bones::layers {

/// Memory and work that all layers of one call share.
class Stack::Solver {
  public:
    Solver(const Stack& stack, std::size_t most, std::span<Transform> bones, std::span<char> changed)
        : stack_(stack), sources_(most), numbers_(most), spins_(most), bones_(bones), changed_(changed) {}

    void lay(double frame, const Layer& layer) {
        const double weight = read(frame, layer);
        if (!(weight > 0.0)) return;
        if (layer.in_armature) {
            turn_in_armature(layer, weight);
            blend(layer, weight, location | scale);
        } else {
            blend(layer, weight, location | rotation | scale);
        }
    }

  protected:
    /// Reads what the clip of a layer says at a frame of the scene into source_ and spins_. Returns the
    /// weight of the layer there; where it is not above 0 nothing is read.
    [[nodiscard]] double read(double frame, const Layer& layer) {
        const Moment moment = moment_of(layer.timing, frame);
        const double weight = layer.weight * moment.weight;
        if (!(weight > 0.0)) return weight;
        const Clip& clip = *layer.clip;
        source_ = std::span(sources_).first(clip.bones().size());
        clip.evaluate(moment.frame, layer.given, source_, std::span(numbers_).first(source_.size()));
        find_spins(layer, moment.laps);
        return weight;
    }

    [[nodiscard]] static Transform reference_of(const Layer& layer, std::size_t i) {
        return layer.reference.empty() ? Transform{} : layer.reference[i];
    }

    void find_spins(const Layer& layer, double laps) {
        std::ranges::fill(spins_, Spin{});
        if (layer.laps.empty() || !layer.clip->has_spins()) return;
        const std::span<const Rotation> modes = layer.clip->spins();
        for (std::size_t i = 0; i < modes.size(); ++i) {
            if (modes[i] == Rotation::quaternion) continue;
            const Lap& lap = layer.laps[i];
            spins_[i] = {modes[i], lap.from, with_laps(modes[i], numbers_[i], lap.gained, laps)};
        }
    }

    void set(std::size_t bone, const Transform& result) {
        if (!is_finite(result)) return;
        bones_[bone] = result;
        changed_[bone] = 1;
    }

    /// Blends a layer bone by bone, each bone in its own axes.
    void blend(const Layer& layer, double weight, unsigned wanted) {
        const Clip& clip = *layer.clip;
        for (std::size_t i = 0; i < source_.size(); ++i) {
            const auto bone = static_cast<std::size_t>(clip.bones()[i]);
            const double share = weight * layer.mask[bone];
            const unsigned channels = clip.channels()[i] & wanted;
            if (!(share > 0.0) || channels == no_channel) continue;
            const Transform& base = bones_[bone];
            const bool spins = spins_[i].is_on() && share < 1.0;
            Transform said = source_[i];
            if (spins) said.rotation = spins_[i].start();
            Transform result = layer.mode == LayerMode::override
                                   ? overridden(base, said, share, channels)
                                   : added(base, said, reference_of(layer, i), share, channels);
            if (spins && (channels & rotation) != 0) spin(layer, i, share, base, result);
            set(bone, result);
        }
    }

    /// Appends the turns that a bone has gone around since its first pose to the blended first pose of the
    /// bone.
    void spin(const Layer& layer, std::size_t i, double share, const Transform& base,
              Transform& result) const {
        const glm::dquat turn = spins_[i].turn(share);
        if (layer.mode == LayerMode::override) {
            result.rotation = normalized_product(turn * result.rotation);
            return;
        }
        const glm::dquat from_reference = base.rotation * glm::conjugate(reference_of(layer, i).rotation);
        result.rotation =
            normalized_product(from_reference * turn * glm::conjugate(from_reference) * result.rotation);
    }

    /// The rotation that the bone's own rotation is applied to: the parent's, times the bone's rest rotation
    /// relative to the parent.
    [[nodiscard]] glm::dquat carried(std::size_t bone, const std::vector<glm::dquat>& turned) const {
        const glm::dquat& rest = stack_.from_parent_[bone];
        if (stack_.follows_[bone] == 0) return rest;
        return turned[static_cast<std::size_t>(stack_.parents_[bone])] * rest;
    }

    /// Fills what turn_in_armature() and the like need for each bone of the rig with what the layer says.
    void read_rotations(const Layer& layer, double weight) {
        const Clip& clip = *layer.clip;
        const std::size_t count = stack_.size();
        beneath_.resize(count);
        above_.resize(count);
        carries_.resize(count);
        spinning_.resize(count);
        next_spinning_.resize(count);
        said_.assign(count, no_turn);
        said_reference_.assign(count, no_turn);
        share_.assign(count, 0.0);
        spin_of_.assign(count, none);
        for (std::size_t i = 0; i < source_.size(); ++i) {
            if ((clip.channels()[i] & rotation) == 0) continue;
            const auto bone = static_cast<std::size_t>(clip.bones()[i]);
            said_[bone] = spins_[i].is_on() ? spins_[i].start() : source_[i].rotation;
            if (spins_[i].is_on()) spin_of_[bone] = static_cast<int>(i);
            said_reference_[bone] = reference_of(layer, i).rotation;
            share_[bone] = weight * layer.mask[bone];
        }
    }

    /// Blends the rotations of a layer, as they are in the armature.
    void turn_in_armature(const Layer& layer, double weight) {
        read_rotations(layer, weight);
        for (const int next : stack_.order_) {
            const auto bone = static_cast<std::size_t>(next);
            const glm::dquat own = bones_[bone].rotation;
            beneath_[bone] = normalized_product(carried(bone, beneath_) * own);
            stand(bone);
            const glm::dquat on = carried(bone, above_);
            if (!(share_[bone] > 0.0)) {
                above_[bone] = normalized_product(on * own);
                continue;
            }
            above_[bone] = in_armature(layer.mode, bone);
            if (spinning_[bone] != none)
                above_[bone] = normalized_product(turned(bone, share_[bone]) * above_[bone]);
            Transform result = bones_[bone];
            result.rotation = normalized_product(glm::conjugate(on) * above_[bone]);
            set(bone, result);
        }
    }

    /// Turns what the clip and the reference say of a bone, the bones above having been turned, into
    /// rotations in the armature.
    void stand(std::size_t bone) {
        note_spinning(bone, carried(bone, said_));
        said_[bone] = normalized_product(carried(bone, said_) * said_[bone]);
        said_reference_[bone] = normalized_product(carried(bone, said_reference_) * said_reference_[bone]);
    }

    [[nodiscard]] glm::dquat in_armature(LayerMode mode, std::size_t bone) const {
        const glm::dquat& base = beneath_[bone];
        if (mode == LayerMode::override)
            return share_[bone] >= 1.0
                       ? said_[bone]
                       : normalized_product(part_of_turn(said_[bone] * glm::conjugate(base), share_[bone]) *
                                            base);
        return normalized_product(
            part_of_turn(said_[bone] * glm::conjugate(said_reference_[bone]), share_[bone]) * base);
    }

    /// Notes the nearest bone that goes around among a bone and the bones with which it turns. carries: the
    /// rotation that the bone's own rotation is applied to, in the clip's pose.
    void note_spinning(std::size_t bone, const glm::dquat& carries) {
        carries_[bone] = carries;
        next_spinning_[bone] =
            stack_.follows_[bone] != 0 ? spinning_[static_cast<std::size_t>(stack_.parents_[bone])] : none;
        spinning_[bone] = spin_of_[bone] != none ? static_cast<int>(bone) : next_spinning_[bone];
    }

    /// The rotation, in the armature, by which bones that go around turn a bone, for a share of their turns.
    [[nodiscard]] glm::dquat turned(std::size_t bone, double share) const {
        glm::dquat result = no_turn;
        for (int next = spinning_[bone]; next != none;) {
            const auto one = static_cast<std::size_t>(next);
            const glm::dquat turn = spins_[static_cast<std::size_t>(spin_of_[one])].turn(share);
            result = normalized_product(carries_[one] * turn * glm::conjugate(carries_[one]) * result);
            next = next_spinning_[one];
        }
        return result;
    }

    static constexpr int none = -1;

    const Stack& stack_;
    std::vector<Transform> sources_;
    std::span<Transform> source_;   // of them: of each bone of the clip what it says
    std::vector<Numbers> numbers_;  // of source_
    std::vector<Spin> spins_;       // of source_
    std::span<Transform> bones_;
    std::span<char> changed_;
    // Rotations in the armature: beneath the layer, with it, as the clip and the reference have them. What
    // goes around is said to stand where it begins.
    std::vector<glm::dquat> beneath_, above_, said_, said_reference_, carries_;
    std::vector<double> share_;
    // Of bones: which of spins_ is theirs; the nearest bone that goes around, of themselves and what they
    // turn with; and the one above that.
    std::vector<int> spin_of_, spinning_, next_spinning_;
};

}  // namespace motus::bones::layers
