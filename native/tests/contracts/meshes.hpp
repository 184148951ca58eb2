// A small mesh that several topics share.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace motus::contracts {

[[nodiscard]] inline std::vector<glm::vec3> sample_positions() {
    return {
        {0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.1F}, {0.0F, 1.0F, 0.2F}, {1.0F, 1.0F, 0.0F}, {2.0F, 0.5F, 0.3F}};
}
[[nodiscard]] inline std::vector<glm::ivec3> sample_triangles() {
    return {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}};
}
[[nodiscard]] inline std::vector<glm::ivec2> sample_edges() {
    return {{0, 1}, {1, 2}, {0, 2}, {1, 3}, {2, 3}, {1, 4}, {3, 4}};
}

}  // namespace motus::contracts
