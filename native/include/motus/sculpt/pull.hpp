// Pulling a mesh at a vertex: what is near the root follows.
#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "motus/mesh/reach.hpp"
#include "motus/sculpt/falloff.hpp"

namespace motus::sculpt {

/// One pull, in the space of the positions. All numbers finite, but for the two limits.
struct Dab {
    glm::vec3 root{0.0f};          ///< where it is pulled
    glm::vec3 displacement{0.0f};  ///< how far the root goes
    float radius = 1.0f;           ///< > 0, in the metric's unit; for edge counts a number of edges
    Profile profile{};
    glm::mat3 metric{1.0f};  ///< distances are |metric (p - root)|: an object's matrix gives world units
    float minimum =
        -std::numeric_limits<float>::infinity();             ///< <= maximum; a vertex that moves ends between
    float maximum = std::numeric_limits<float>::infinity();  ///< the two on clamp_axis
    int clamp_axis = 2;                                      ///< 0 x, 1 y, 2 z
    unsigned mirror = 0;  ///< bits x 1, y 2, z 4: acts also mirrored, about planes through the origin
};

/// Where a dab acts, and how.
struct PullImage {
    glm::vec3 root;
    glm::vec3 displacement;
};

/// The dab's own image first, then those mirrored, in the order of the bits: 1, 2, 4 or 8 of them.
[[nodiscard]] std::vector<PullImage> images_of(const Dab& dab);

/// Moves vertices by force * weight * displacement, and clamps those that it moves. Where several images
/// reach a vertex, with the forces f_i and displacements D_i, it moves by sum(f_i D_i) max|f_i| / sum|f_i|:
/// one image alone gives f D, two that meet on the plane of symmetry give their mean, and in between it is
/// continuous. A vertex whose force or weight is 0 keeps its bits.
///
/// positions.size() == out.size(); `out` may be `positions`. weights: one in [0, 1] for each vertex, or none
/// at all. shape: what distances are measured on in place of `positions`, of as many vertices, or nothing; so
/// the dabs of a stroke may all act on the shape with which it began. copy: filled with the same as `out`, in
/// the same pass, or nothing. Results do not depend on the number of threads or on the processor. Throws
/// std::invalid_argument, before anything is written, where sizes differ or something is outside its domain.
void pull(std::span<const glm::vec3> positions, const Dab& dab, std::span<const float> weights,
          std::span<glm::vec3> out, std::span<const glm::vec3> shape = {}, std::span<glm::vec3> copy = {});

/// The same, bit for bit, if `vertices` has all that are within reach of an image, each once, in any order:
/// what a tree finds. Others among them do no harm. In place it touches nothing else; positions, shape and
/// weights of other vertices are not looked at.
void pull_among(std::span<const glm::vec3> positions, const Dab& dab, std::span<const std::uint32_t> vertices,
                std::span<const float> weights, std::span<glm::vec3> out,
                std::span<const glm::vec3> shape = {});

/// The same by distances measured elsewhere: `reaches` has one Reach for each of images_of(dab), each vertex
/// at most once in a Reach. The dab's root and metric play no part. Of vertices that are in no Reach neither
/// positions nor weights are looked at.
void pull_along(std::span<const glm::vec3> positions, const Dab& dab, std::span<const mesh::Reach> reaches,
                std::span<const float> weights, std::span<glm::vec3> out);

}  // namespace motus::sculpt
