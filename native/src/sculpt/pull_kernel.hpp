// The inner loops of pull(): blocks of vertices, compiled for several instruction sets. Private to the
// library.
#pragma once
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "motus/core/unfilled.hpp"
#include "motus/sculpt/falloff.hpp"

namespace motus::sculpt {

/// Number of vertices per block: their intermediate values stay in the fastest cache.
inline constexpr std::size_t pull_block = 512;

/// One value of type T for each vertex of a block.
template <class T>
using PerVertex = Unfilled<T, pull_block>;

/// A profile with its radius, as numbers for the loops.
struct ForceTerms {
    Falloff falloff = Falloff::smooth;
    bool of_squares = false;         ///< the falloff is one of d^2, which is all that is measured then
    float limit = 1.0f;              ///< reach_of(profile, radius), or its square: forces are 0 from there on
    float scale = 1.0f;              ///< 1 / R, or 1 / R^2 of squares; of `classic` 1 / (R + 1)
    float exponent = 1.0f;           ///< 1 + |k|
    const float* samples = nullptr;  ///< of `curve`
    int last_sample = 1;
};

/// The terms of a profile that was checked: see forces().
[[nodiscard]] ForceTerms force_terms(const Profile& profile, float radius);

/// Numbers by which one mirror image of a dab moves vertices.
struct MoveTerms {
    glm::vec3 displacement{0.0f};
    float minimum = 0.0f;
    float maximum = 0.0f;
    int clamp_axis = 2;
};

/// The effect of several images on a block, summed up from clear() on.
struct Shares {
    PerVertex<float> x, y, z;
    PerVertex<float> total;    ///< of the forces' sizes
    PerVertex<float> largest;  ///< of the forces' sizes

    void clear() noexcept {
        for (PerVertex<float>* numbers : {&x, &y, &z, &total, &largest}) numbers->fill(0.0f);
    }
};

/// Loops over `count` <= pull_block vertices for one instruction set; all sets give the same bits. Positions
/// are x, y, z after each other, and finite.
struct PullKernel {
    const char* name;
    /// Whether all numbers are finite.
    bool (*are_finite)(const float* numbers, std::size_t count);
    /// Whether all weights lie in [0, 1].
    bool (*are_weights)(const float* weights, std::size_t count);
    /// Distances from `root`, or their squares, as `force` takes them. metric: distances are
    /// |metric (p - root)|; null for straight ones. False if no vertex is within reach.
    bool (*measure)(const ForceTerms& force, const glm::mat3* metric, const glm::vec3& root,
                    const float* positions, std::size_t count, float* values);
    /// Replaces distances by forces.
    void (*force)(const ForceTerms& terms, float* values, std::size_t count);
    /// Multiplies forces by weights.
    void (*weigh)(const float* weights, std::size_t count, float* forces);
    /// Moves the vertices by one image of the dab.
    void (*move)(const MoveTerms& terms, const float* forces, std::size_t count, float* positions);
    /// Pulls any number of vertices by one image without limits. measured: different positions on which
    /// distances are measured, or null. weights: one for each vertex, or null.
    void (*pull)(const ForceTerms& force, const MoveTerms& move, const glm::vec3& root,
                 const glm::mat3* metric, std::size_t count, const float* measured, const float* weights,
                 float* positions);
    /// Adds an image to the shares, then moves by all of them.
    void (*share)(const glm::vec3& displacement, const float* forces, std::size_t count, Shares& shares);
    void (*move_by)(const MoveTerms& terms, const Shares& shares, std::size_t count, float* positions);
};

/// The kernels that this processor can run, the fastest last.
[[nodiscard]] std::span<const PullKernel> pull_kernels();

}  // namespace motus::sculpt
