// One dab, checked and ready to be applied to blocks of vertices. Private to the library.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "motus/sculpt/pull.hpp"
#include "pull_kernel.hpp"

namespace motus::sculpt {

static_assert(sizeof(glm::vec3) == 3 * sizeof(float), "positions are read as x, y, z after each other");

/// The positions that are moved, and those that distances are measured on, which may be the same.
struct Shapes {
    const glm::vec3* positions;
    const glm::vec3* measured;

    [[nodiscard]] bool is_one() const noexcept { return positions == measured; }
};

/// Several threads may call the const members at once. Arguments of act_...() have to be checked before.
class Puller {
  public:
    /// Throws std::invalid_argument if a number is outside its domain, or sizes differ.
    Puller(const Dab& dab, std::size_t vertex_count, std::size_t weight_count, std::size_t out_count,
           const PullKernel& kernel = pull_kernels().back());

    [[nodiscard]] std::span<const PullImage> images() const noexcept { return images_; }

    /// Throw std::invalid_argument if a position is not finite, or a weight lies outside [0, 1]: of all
    /// vertices in [first, last), or of those that are named. weights: one for each vertex, or null.
    void check_whole(const Shapes& shapes, const float* weights, std::size_t first, std::size_t last) const;
    void check_among(const Shapes& shapes, const float* weights,
                     std::span<const std::uint32_t> vertices) const;

    /// The vertices of [first, last), from `positions` to `out`, which may be the same.
    void act_whole(const Shapes& shapes, const float* weights, std::size_t first, std::size_t last,
                   glm::vec3* out) const;
    /// Some vertices, by straight distance. `out` holds their positions already.
    void act_among(const Shapes& shapes, const float* weights, std::span<const std::uint32_t> vertices,
                   glm::vec3* out) const;
    /// Pulls vertices by the distances of one Reach an image; `vertices` is a part of their union, ascending.
    void act_along(const glm::vec3* positions, const float* weights, std::span<const std::uint32_t> vertices,
                   std::span<const mesh::Reach> reaches, glm::vec3* out) const;

  private:
    struct Gathered;

    [[nodiscard]] const glm::mat3* metric() const noexcept { return is_plain_ ? nullptr : &metric_; }
    [[nodiscard]] bool measure(const PullImage& image, const glm::vec3* positions, std::size_t count,
                               float* distances) const;
    static void gather(const Shapes& shapes, const float* weights, std::span<const std::uint32_t> vertices,
                       Gathered& block);
    void check(const glm::vec3* positions, const glm::vec3* measured, const float* weights,
               std::size_t count) const;

    template <class Distances>
    [[nodiscard]] bool act(const ForceTerms& force, const glm::vec3* positions, const float* weights,
                           std::size_t count, Distances&& distances, glm::vec3* out) const;

    ForceTerms force_;     ///< of distances in the metric's unit
    ForceTerms straight_;  ///< terms for straight distances, with the metric's scale if it has one
    MoveTerms move_;
    glm::mat3 metric_;
    bool is_plain_;  ///< the metric need not be looked at any more
    std::size_t vertex_count_;
    const PullKernel& kernel_;
    std::vector<PullImage> images_;
};

}  // namespace motus::sculpt
