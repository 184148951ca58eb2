#include "motus/bones/layers/stack.hpp"

#include <algorithm>
#include <cmath>

#include "motus/bones/layers/mask.hpp"
#include "motus/core/numeric.hpp"
#include "solver.hpp"

namespace motus::bones::layers {

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

std::size_t Stack::checked(double frame, std::span<const Layer> layers,
                           std::span<const Transform> base) const {
    require(std::isfinite(frame), "frame: must be finite");
    require(base.size() == size(), "base: one transform for each bone is needed");
    std::size_t most = 0;
    for (const Layer& layer : layers) {
        check(layer.timing);
        require(std::isfinite(layer.weight), "weight: must be finite");
        require(layer.clip == nullptr || layer.given.size() == layer.clip->given_count(),
                "given: one value for each curve without keys is needed");
        require(layer.clip != nullptr && layer.clip->bone_count() == size(),
                "clips: another number of bones");
        require(layer.mask.size() == size(), "mask: one weight for each bone is needed");
        require(layer.reference.empty() || layer.reference.size() == layer.clip->bones().size(),
                "references: one transform for each bone of the clip is needed");
        require(layer.laps.empty() || layer.laps.size() == layer.clip->bones().size(),
                "laps: one for each bone of the clip is needed");
        most = std::max(most, layer.clip->bones().size());
    }
    return most;
}

void Stack::solve(double frame, std::span<const Layer> layers, std::span<const Transform> base,
                  std::span<Transform> result, std::span<char> changed) const {
    const std::size_t most = checked(frame, layers, base);
    require(result.size() == size(), "result: one transform for each bone is needed");
    require(changed.size() == size(), "changed: one for each bone is needed");
    if (result.data() != base.data()) std::ranges::copy(base, result.begin());
    std::ranges::fill(changed, 0);
    Solver solver(*this, most, result, changed);
    for (const Layer& layer : layers) solver.lay(frame, layer);
}

}  // namespace motus::bones::layers
