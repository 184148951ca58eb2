// The inverse of laying layers: which source makes a wanted pose. A wanted pose is taken down through the
// layers above the edited one, and what the edited one adds to the pose beneath is divided by its share.
#include <algorithm>

#include "motus/bones/layers/stack.hpp"
#include "motus/core/numeric.hpp"
#include "solver.hpp"

namespace motus::bones::layers {
namespace {

constexpr unsigned every_channel = location | rotation | scale;

/// A rotation, and whether it gives exactly what was asked for.
struct Found {
    glm::dquat turn;
    bool is_exact;
};

/// The base over which an override by `share`, less than 1, of `source` gives `result`. All in the same axes.
Found base_in_armature(const glm::dquat& result, const glm::dquat& source, double share) {
    const glm::dquat left = source * glm::conjugate(result);
    return {normalized_product(glm::conjugate(whole_turn(left, 1.0 - share)) * source),
            has_whole_turn(left, 1.0 - share)};
}

/// The source of which an override by `share` over `base` gives `result`, in the axes of the armature.
Found source_in_armature(const glm::dquat& result, const glm::dquat& base, double share) {
    if (share >= 1.0) return {result, true};
    const glm::dquat way = result * glm::conjugate(base);
    return {normalized_product(whole_turn(way, share) * base), has_whole_turn(way, share)};
}

/// The same of an override in the bone's own axes, where turns come after the base.
Found base_of(const glm::dquat& result, const glm::dquat& source, double share) {
    const glm::dquat left = glm::conjugate(result) * source;
    return {normalized_product(source * glm::conjugate(whole_turn(left, 1.0 - share))),
            has_whole_turn(left, 1.0 - share)};
}

Found source_of(const glm::dquat& result, const glm::dquat& base, double share) {
    if (share >= 1.0) return {result, true};
    const glm::dquat way = glm::conjugate(base) * result;
    return {normalized_product(base * whole_turn(way, share)), has_whole_turn(way, share)};
}

}  // namespace

/// Looks back through layers. bones_ is the pose beneath the edited layer; wanted_ the pose above the layer
/// in hand.
class Stack::Finder : public Stack::Solver {
  public:
    Finder(const Stack& stack, std::size_t most, std::span<Transform> bones, std::span<char> changed,
           std::span<const Transform> wanted)
        : Solver(stack, most, bones, changed),
          wanted_(wanted.begin(), wanted.end()),
          reached_(wanted.size(), every_channel) {}

    /// Takes a layer off wanted_.
    void take_off(double frame, const Layer& layer) {
        const double weight = read(frame, layer);
        if (!(weight > 0.0)) return;
        const std::span<const int> bones = layer.clip->bones();
        for (std::size_t i = 0; i < bones.size(); ++i) {
            const auto bone = static_cast<std::size_t>(bones[i]);
            const double share = weight * layer.mask[bone];
            if (!(share > 0.0)) continue;
            const unsigned channels = layer.clip->channels()[i];
            const Transform reference = reference_of(layer, i);
            Transform base = wanted_[bone];
            unsigned lost = no_channel;
            if (layer.mode == LayerMode::override) {
                if (share >= 1.0) {
                    lost = channels & (location | scale);
                } else {
                    if ((channels & location) != 0)
                        base.location = (base.location - share * source_[i].location) / (1.0 - share);
                    if ((channels & scale) != 0)
                        base.scale = (base.scale - share * source_[i].scale) / (1.0 - share);
                }
            } else {
                if ((channels & location) != 0)
                    base.location -= share * (source_[i].location - reference.location);
                if ((channels & scale) != 0) lost |= unscale(base.scale, source_[i], reference, share);
            }
            if ((channels & rotation) != 0 && !layer.in_armature)
                lost |= keep(take_off_turn(layer, i, share, base.rotation), base.rotation);
            give(bone, base, lost);
        }
        if (layer.in_armature) take_off_in_armature(layer, weight);
    }

    /// What the clip of a layer over bones_ has to say of a bone that wanted_ asks for: of the chosen bones.
    void find(double frame, const Layer& layer, std::span<const int> chosen, std::span<Transform> said,
              std::span<unsigned> reached) {
        const double weight = read(frame, layer);
        places_.assign(stack_.size(), none);
        const std::span<const int> bones = layer.clip->bones();
        if (weight > 0.0)
            for (std::size_t i = 0; i < bones.size(); ++i)
                places_[static_cast<std::size_t>(bones[i])] = static_cast<int>(i);
        turns_.assign(stack_.size(), {no_turn, false});
        if (layer.in_armature && weight > 0.0) find_in_armature(layer, weight, chosen);
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const auto bone = static_cast<std::size_t>(chosen[i]);
            const double share = std::max(0.0, weight) * layer.mask[bone];
            said[i] = is_finite(bones_[bone]) ? bones_[bone] : Transform{};
            reached[i] = no_channel;
            if (!(share > 0.0)) continue;
            Transform found = said[i];
            unsigned lost = find_moves(layer, bone, share, found);
            const Found turn = layer.in_armature ? turns_[bone] : turn_of(layer, bone, share);
            lost |= keep(turn, found.rotation);
            if (!is_finite(found)) continue;
            said[i] = found;
            reached[i] = reached_[bone] & ~lost;
        }
    }

  private:
    /// Writes what was found; returns the channel that was not reached.
    static unsigned keep(const Found& found, glm::dquat& turn) {
        turn = found.turn;
        return found.is_exact ? no_channel : rotation;
    }

    void give(std::size_t bone, const Transform& base, unsigned lost) {
        reached_[bone] &= ~lost;
        if (is_finite(base))
            wanted_[bone] = base;
        else
            reached_[bone] = no_channel;
    }

    /// Divides a scale by what an additive layer has multiplied it by.
    static unsigned unscale(glm::dvec3& scaled, const Transform& source, const Transform& reference,
                            double share) {
        unsigned lost = no_channel;
        for (int i = 0; i < 3; ++i) {
            if (reference.scale[i] == 0.0) continue;
            const double factor = 1.0 + share * (source.scale[i] / reference.scale[i] - 1.0);
            if (factor == 0.0)
                lost = scale;
            else
                scaled[i] /= factor;
        }
        return lost;
    }

    [[nodiscard]] Found take_off_turn(const Layer& layer, std::size_t i, double share,
                                      const glm::dquat& result) const {
        const bool spins = spins_[i].is_on() && share < 1.0;
        const glm::dquat said = spins ? spins_[i].start() : source_[i].rotation;
        const glm::dquat turn = spins ? spins_[i].turn(share) : no_turn;
        if (layer.mode == LayerMode::override) {
            if (share >= 1.0) return {result, false};
            return base_of(normalized_product(glm::conjugate(turn) * result), said, share);
        }
        const glm::dquat reference = reference_of(layer, i).rotation;
        const glm::dquat added = glm::conjugate(reference) * turn * reference *
                                 part_of_turn(glm::conjugate(reference) * said, share);
        return {normalized_product(result * glm::conjugate(added)), true};
    }

    void take_off_in_armature(const Layer& layer, double weight) {
        read_rotations(layer, weight);
        for (const int next : stack_.order_) {
            const auto bone = static_cast<std::size_t>(next);
            const glm::dquat own = wanted_[bone].rotation;
            above_[bone] = normalized_product(carried(bone, above_) * own);
            stand(bone);
            const glm::dquat on = carried(bone, beneath_);
            if (!(share_[bone] > 0.0)) {
                beneath_[bone] = normalized_product(on * own);
                continue;
            }
            const Found base = base_beneath(layer.mode, bone);
            beneath_[bone] = base.turn;
            Transform taken = wanted_[bone];
            taken.rotation = normalized_product(glm::conjugate(on) * base.turn);
            give(bone, taken, base.is_exact ? no_channel : rotation);
        }
    }

    [[nodiscard]] Found base_beneath(LayerMode mode, std::size_t bone) const {
        const double share = share_[bone];
        const glm::dquat result =
            spinning_[bone] == none ? above_[bone]
                                    : normalized_product(glm::conjugate(turned(bone, share)) * above_[bone]);
        if (mode == LayerMode::override)
            return share >= 1.0 ? Found{result, false} : base_in_armature(result, said_[bone], share);
        const glm::dquat added = part_of_turn(said_[bone] * glm::conjugate(said_reference_[bone]), share);
        return {normalized_product(glm::conjugate(added) * result), true};
    }

    [[nodiscard]] Transform reference_at(const Layer& layer, std::size_t bone) const {
        return places_[bone] == none ? Transform{}
                                     : reference_of(layer, static_cast<std::size_t>(places_[bone]));
    }

    [[nodiscard]] bool goes_around(std::size_t bone) const {
        return places_[bone] != none && spins_[static_cast<std::size_t>(places_[bone])].is_on();
    }

    /// Sets location and scale of `found`, which is the base.
    unsigned find_moves(const Layer& layer, std::size_t bone, double share, Transform& found) const {
        const Transform &base = bones_[bone], &wanted = wanted_[bone];
        if (layer.mode == LayerMode::override) {
            found.location =
                share >= 1.0 ? wanted.location : base.location + (wanted.location - base.location) / share;
            found.scale = share >= 1.0 ? wanted.scale : base.scale + (wanted.scale - base.scale) / share;
            return no_channel;
        }
        const Transform reference = reference_at(layer, bone);
        found.location = reference.location + (wanted.location - base.location) / share;
        unsigned lost = no_channel;
        for (int i = 0; i < 3; ++i) {
            found.scale[i] = reference.scale[i];
            if (base.scale[i] == 0.0 || reference.scale[i] == 0.0)
                lost |= wanted.scale[i] == base.scale[i] ? no_channel : scale;
            else
                found.scale[i] *= 1.0 + (wanted.scale[i] / base.scale[i] - 1.0) / share;
        }
        return lost;
    }

    [[nodiscard]] Found turn_of(const Layer& layer, std::size_t bone, double share) const {
        const glm::dquat &base = bones_[bone].rotation, &wanted = wanted_[bone].rotation;
        const bool is_known = share >= 1.0 || !goes_around(bone);
        if (layer.mode == LayerMode::override) {
            const Found source = source_of(wanted, base, share);
            return {source.turn, source.is_exact && is_known};
        }
        const glm::dquat way = glm::conjugate(base) * wanted;
        return {normalized_product(reference_at(layer, bone).rotation * whole_turn(way, share)),
                has_whole_turn(way, share) && is_known};
    }

    void find_in_armature(const Layer& layer, double weight, std::span<const int> chosen) {
        read_rotations(layer, weight);
        for (const int one : chosen) {
            const auto bone = static_cast<std::size_t>(one);
            share_[bone] = weight * layer.mask[bone];
            turns_[bone].is_exact = share_[bone] > 0.0;
        }
        for (const int next : stack_.order_) {
            const auto bone = static_cast<std::size_t>(next);
            const glm::dquat on = carried(bone, said_);
            beneath_[bone] = normalized_product(carried(bone, beneath_) * bones_[bone].rotation);
            above_[bone] = normalized_product(carried(bone, above_) * wanted_[bone].rotation);
            stand(bone);
            if (!turns_[bone].is_exact) continue;
            const Found said = said_above(layer.mode, bone);
            said_[bone] = said.turn;
            turns_[bone] = {normalized_product(glm::conjugate(on) * said.turn),
                            said.is_exact && spinning_[bone] == none};
        }
    }

    [[nodiscard]] Found said_above(LayerMode mode, std::size_t bone) const {
        const double share = share_[bone];
        if (mode == LayerMode::override) return source_in_armature(above_[bone], beneath_[bone], share);
        const glm::dquat way = above_[bone] * glm::conjugate(beneath_[bone]);
        return {normalized_product(whole_turn(way, share) * said_reference_[bone]),
                has_whole_turn(way, share)};
    }

    std::vector<Transform> wanted_;
    std::vector<unsigned> reached_;
    std::vector<int> places_;   // of each bone of the rig: its index in the edited layer's clip, or none
    std::vector<Found> turns_;  // of the chosen bones, while rotations are found in the armature
};

void Stack::find_source(double frame, std::span<const Layer> layers, std::size_t edited,
                        std::span<const Transform> base, std::span<const Transform> wanted,
                        std::span<const int> chosen, std::span<Transform> said,
                        std::span<unsigned> reached) const {
    const std::size_t most = checked(frame, layers, base);
    require(edited < layers.size(), "edited: there is no such layer");
    require(wanted.size() == size(), "wanted: one transform for each bone is needed");
    require(said.size() == chosen.size(), "said: one transform for each chosen bone is needed");
    require(reached.size() == chosen.size(), "reached: one for each chosen bone is needed");
    for (const int bone : chosen)
        require(bone >= 0 && static_cast<std::size_t>(bone) < size(), "chosen: a bone is not there");
    std::vector<Transform> beneath(base.begin(), base.end());
    std::vector<char> changed(size());
    Finder finder(*this, most, beneath, changed, wanted);
    for (std::size_t i = 0; i < edited; ++i) finder.lay(frame, layers[i]);
    for (std::size_t i = layers.size() - 1; i > edited; --i) finder.take_off(frame, layers[i]);
    finder.find(frame, layers[edited], chosen, said, reached);
}

}  // namespace motus::bones::layers
