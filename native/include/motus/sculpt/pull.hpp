// Pulling a mesh at a vertex, the root: vertices near the root follow (soft selection, a grab brush).
//
// Costs: O(n), pull_among() and pull_along() O(n) of the vertices listed. Allocates some memory for its
// work. Any number of threads at once, each with an `out` of its own.
#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "motus/config.hpp"
#include "motus/core/executor.hpp"
#include "motus/mesh/reach.hpp"
#include "motus/sculpt/falloff.hpp"

namespace motus::sculpt {

/// One pull, in the space of the positions. All numbers are finite, except the two limits.
struct Dab {
    glm::vec3 root{0.0f};          ///< the point that is pulled
    glm::vec3 displacement{0.0f};  ///< the root's movement
    float radius = 1.0f;           ///< > 0, in the metric's unit; for edge counts a number of edges
    Profile profile{};
    glm::mat3 metric{1.0f};  ///< distances are |metric (p - root)|: an object's matrix gives world units
    float minimum =
        -std::numeric_limits<float>::infinity();             ///< <= maximum; a vertex that moves ends between
    float maximum = std::numeric_limits<float>::infinity();  ///< the two on clamp_axis
    int clamp_axis = 2;                                      ///< 0 x, 1 y, 2 z
    unsigned mirror = 0;  ///< bits x 1, y 2, z 4: also acts mirrored about these planes through the origin
};

/// One image of a dab: the dab itself, or its reflection.
struct PullImage {
    glm::vec3 root;
    glm::vec3 displacement;
};

/// The dab itself first, then its reflections, in the order of the bits: 1, 2, 4 or 8 of them. Throws
/// std::invalid_argument if the root or the displacement is not finite, or `mirror` has other bits.
[[nodiscard]] std::vector<PullImage> images_of(const Dab& dab);

/// Moves vertices by force * weight * displacement, and clamps those that it moves. Where several images
/// reach a vertex, with the forces f_i and displacements D_i, it moves by sum(f_i D_i) max|f_i| / sum|f_i|:
/// one image alone gives f D, two that meet on the plane of symmetry give their mean, and in between it is
/// continuous. A vertex whose force or weight is 0 keeps its bits.
///
/// positions.size() == out.size(); `out` may be `positions`. weights: one in [0, 1] for each vertex, or none
/// at all. shape: positions that distances are measured on instead, of as many vertices, or empty; with
/// it all dabs of a stroke can act on the shape that the mesh had when the stroke began. copy: gets the same
/// values as `out`, in the same pass; or empty. Results do not depend on the number of threads or on the
/// processor. Throws std::invalid_argument, before anything is written, if sizes differ or something is
/// outside its domain.
void pull(std::span<const glm::vec3> positions, const Dab& dab, std::span<const float> weights,
          std::span<glm::vec3> out, std::span<const glm::vec3> shape = {}, std::span<glm::vec3> copy = {},
          const Executor& executor = {});

/// pull() for few vertices, such as those that a tree finds, with the same bits: `vertices` has all within
/// reach of an image, each once, in any order; vertices out of reach among them do no harm. If `out` is
/// `positions`, nothing else is written. Positions, shape and weights of vertices that are not listed are not
/// read.
void pull_among(std::span<const glm::vec3> positions, const Dab& dab, std::span<const std::uint32_t> vertices,
                std::span<const float> weights, std::span<glm::vec3> out,
                std::span<const glm::vec3> shape = {}, const Executor& executor = {});

/// pull() by distances that are given: `reaches` has one Reach for each of images_of(dab), each vertex at
/// most once in a Reach. The dab's root and metric are not read. Of vertices in no Reach neither positions
/// nor weights are read.
void pull_along(std::span<const glm::vec3> positions, const Dab& dab, std::span<const mesh::Reach> reaches,
                std::span<const float> weights, std::span<glm::vec3> out, const Executor& executor = {});

}  // namespace motus::sculpt
