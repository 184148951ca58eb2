#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"
#include "motus/core/unfilled.hpp"
#include "motus/lattice/lattice.hpp"
#include "taps.hpp"

namespace motus::lattice {
namespace {

constexpr std::size_t grain = 2048;  // positions; below that a thread costs more than it saves

/// Four floats that are multiplied and added at once.
using Four = float __attribute__((vector_size(16)));

/// Displacements of the lattice points with their weights as the fourth number: one load and one sum for
/// both.
[[nodiscard]] std::vector<Four> packed(std::span<const glm::vec3> displacements,
                                       std::span<const float> weights) {
    std::vector<Four> result(displacements.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const glm::vec3& d = displacements[i];
        result[i] = Four{d.x, d.y, d.z, weights.empty() ? 1.0f : weights[i]};
    }
    return result;
}

/// Taps as the inner loop wants them: offsets into the points, single precision.
struct Row {
    std::size_t count = 0;
    Unfilled<std::size_t, max_resolution> offset;
    Unfilled<float, max_resolution> weight;

    Row(const Taps& taps, std::size_t stride) : count(static_cast<std::size_t>(taps.count)) {
        for (std::size_t i = 0; i < count; ++i) {
            offset[i] = static_cast<std::size_t>(taps.point[i]) * stride;
            weight[i] = static_cast<float>(taps.weight[i]);
        }
    }
};

/// Weights along all three axes, for a place.
struct Rows {
    Row u, v, w;

    Rows(const Grid& grid, const glm::dvec3& at)
        : u(grid.taps(0, at.x), 1),
          v(grid.taps(1, at.y), static_cast<std::size_t>(grid.resolution()[0])),
          w(grid.taps(2, at.z), static_cast<std::size_t>(grid.resolution()[0]) *
                                    static_cast<std::size_t>(grid.resolution()[1])) {}
};

/// Sum over the lattice points of weight * value. Taps: how many along u, if the compiler is to know; else
/// 0.
template <std::size_t Taps>
[[nodiscard]] Four blend(const Rows& rows, std::span<const Four> values) {
    const std::size_t along_u = Taps > 0 ? Taps : rows.u.count;
    Four sum{};
    for (std::size_t w = 0; w < rows.w.count; ++w) {
        Four layer{};
        for (std::size_t v = 0; v < rows.v.count; ++v) {
            const Four* const line = values.data() + rows.w.offset[w] + rows.v.offset[v];
            Four run{};
            for (std::size_t u = 0; u < along_u; ++u) run += rows.u.weight[u] * line[rows.u.offset[u]];
            layer += rows.v.weight[v] * run;
        }
        sum += rows.w.weight[w] * layer;
    }
    return sum;
}

[[nodiscard]] Four blend(const Rows& rows, std::span<const Four> values) {
    switch (rows.u.count) {
        case 2:
            return blend<2>(rows, values);
        case 4:
            return blend<4>(rows, values);
        default:
            return blend<0>(rows, values);
    }
}

}  // namespace

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
        const std::vector<Four> values = packed(displacements, influence.points);
        const bool fades = !influence.points.empty();
        in_parts(
            positions.size(), grain,
            [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                    const float factor = influence.positions.empty() ? 1.0f : influence.positions[i];
                    if (factor == 0.0f) {
                        out[i] = positions[i];
                        continue;
                    }
                    const Rows rows(grid, grid.coordinates(glm::dvec3(positions[i])));
                    Four change = factor * blend(rows, values);
                    if (fades) change *= change[3];
                    out[i] = positions[i] + glm::vec3(change[0], change[1], change[2]);
                }
            },
            executor);
    });
}

}  // namespace motus::lattice
