#include "motus/mesh/weld.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "motus/core/numeric.hpp"
#include "motus/mesh/picker.hpp"

namespace motus::mesh {

std::vector<std::uint32_t> weld(std::span<const glm::vec3> positions, float distance, const glm::mat3& metric,
                                const Executor& executor) {
    if (!(distance >= 0.0f) || !std::isfinite(distance))
        throw std::invalid_argument("distance: must be at least 0 and finite");
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    const Picker near(positions, {}, executor);
    std::vector<std::uint32_t> leaders(positions.size(), none);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (leaders[i] != none) continue;
        const auto leader = static_cast<std::uint32_t>(i);
        leaders[i] = leader;
        if (!is_finite(positions[i])) continue;
        for (const std::uint32_t vertex : near.within(positions[i], distance, metric))
            if (leaders[vertex] == none) leaders[vertex] = leader;
    }
    return leaders;
}

}  // namespace motus::mesh
