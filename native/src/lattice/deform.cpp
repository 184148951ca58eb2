#include <vector>

#include "deform_kernel.hpp"
#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"
#include "motus/lattice/lattice.hpp"
#include "taps.hpp"

namespace motus::lattice {
namespace {

constexpr std::size_t grain = 2048;  // positions; below that a thread costs more than it saves

[[nodiscard]] std::vector<WeightedMove> weighted(std::span<const glm::vec3> displacements,
                                                 std::span<const float> weights) {
    std::vector<WeightedMove> result(displacements.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = {displacements[i], weights.empty() ? 1.0f : weights[i]};
    return result;
}

}  // namespace

Row::Row(const Taps& taps, std::size_t stride) : count(static_cast<std::size_t>(taps.count)) {
    for (std::size_t i = 0; i < count; ++i) {
        offset[i] = numbers_of_move * stride * static_cast<std::size_t>(taps.point[i]);
        weight[i] = static_cast<float>(taps.weight[i]);
    }
}

// Inlined into the loop of a newer instruction set it would be made for wider registers, which two or four
// taps do not fill.
[[gnu::noinline]] Rows::Rows(const Grid& grid, const glm::dvec3& at)
    : u(grid.taps(0, at.x), 1),
      v(grid.taps(1, at.y), static_cast<std::size_t>(grid.resolution()[0])),
      w(grid.taps(2, at.z),
        static_cast<std::size_t>(grid.resolution()[0]) * static_cast<std::size_t>(grid.resolution()[1])) {}

void deform(const Lattice& lattice, std::span<const glm::vec3> displacements, const Influence& influence,
            std::span<const glm::vec3> positions, std::span<glm::vec3> out, const Executor& executor) {
    const Grid grid(lattice);
    const std::size_t points = point_count(lattice);
    require(displacements.size() == points, "displacements: one for each lattice point is wanted");
    require(influence.points.empty() || influence.points.size() == points,
            "influence: a weight for each lattice point is wanted, or none");
    require(influence.positions.empty() || influence.positions.size() == positions.size(),
            "influence: a factor for each position is wanted, or none");
    require(out.size() == positions.size(), "out: must be as long as positions");
    in_ieee_floats([&] {
        const std::vector<WeightedMove> moves = weighted(displacements, influence.points);
        const Deformation deformation{.grid = grid,
                                      .moves = moves,
                                      .fades = !influence.points.empty(),
                                      .factors = influence.positions,
                                      .positions = positions,
                                      .out = out};
        const auto deform_part = deform_kernels().back().deform;
        in_parts(
            positions.size(), grain,
            [&](std::size_t first, std::size_t last) { deform_part(deformation, first, last); }, executor);
    });
}

}  // namespace motus::lattice
