#include "motus/strand/strand.hpp"

namespace motus::strand {

Surface::Surface(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                 const Executor& executor)
    : picker_(positions, triangles, executor), positions_(positions.begin(), positions.end()) {}

std::size_t Surface::bytes() const noexcept {
    constexpr std::size_t of_a_vertex = 60, of_a_triangle = 20;  // in the tree, its boxes included
    return positions_.size() * of_a_vertex + picker_.triangle_count() * of_a_triangle;
}

}  // namespace motus::strand
