// The inner loop of deform(), compiled for several instruction sets. Private to the library.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "motus/core/unfilled.hpp"
#include "motus/lattice/lattice.hpp"
#include "taps.hpp"

namespace motus::lattice {

/// The displacement of a lattice point, and the weight of that point: both are summed at once.
struct alignas(16) WeightedMove {
    glm::vec3 move{0.0f};
    float weight = 1.0f;
};

inline constexpr std::size_t numbers_of_move = 4;
static_assert(sizeof(WeightedMove) == numbers_of_move * sizeof(float));

/// Taps as the inner loop wants them: offsets into the moves' numbers, single precision.
struct Row {
    std::size_t count = 0;
    Unfilled<std::size_t, max_resolution> offset;
    Unfilled<float, max_resolution> weight;

    Row(const Taps& taps, std::size_t stride);
};

/// Weights along all three axes, for a place.
struct Rows {
    Row u, v, w;

    Rows(const Grid& grid, const glm::dvec3& at);
};

/// What is to be deformed. Sizes fit.
struct Deformation {
    const Grid& grid;
    std::span<const WeightedMove> moves;  ///< of the lattice points
    bool fades = false;                   ///< whether the weights of the moves count
    std::span<const float> factors;       ///< of the positions, or empty: all 1
    std::span<const glm::vec3> positions;
    std::span<glm::vec3> out;
};

/// deform() of the positions from `first` to before `last` for one instruction set; all sets give the same
/// bits.
struct DeformKernel {
    const char* name;
    void (*deform)(const Deformation& deformation, std::size_t first, std::size_t last);
};

/// The kernels that this processor can run, the fastest last.
[[nodiscard]] std::span<const DeformKernel> deform_kernels();

}  // namespace motus::lattice
