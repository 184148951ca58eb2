#include "puller.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <stdexcept>

#include "motus/core/numeric.hpp"

namespace motus::sculpt {
namespace {

[[nodiscard]] const float* numbers(const glm::vec3* positions) {
    return reinterpret_cast<const float*>(positions);
}

[[nodiscard]] float* numbers(glm::vec3* positions) {
    return reinterpret_cast<float*>(positions);
}

/// Factor by which a metric lengthens vectors, if it turns and scales all directions alike; 0 for other
/// metrics, and for factors that might leave the range of float.
[[nodiscard]] double uniform_scale(const glm::mat3& metric) {
    const glm::dmat3 axes(metric);
    const glm::dmat3 products = glm::transpose(axes) * axes;
    const double square = products[0][0];
    constexpr double least = 1e-8, most = 1e8;  // squared
    if (!(square > least && square < most)) return 0.0;
    constexpr double alike = 1e-6;  // single precision's rounding of a rotation
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            const double wanted = column == row ? square : 0.0;
            if (std::abs(products[column][row] - wanted) > alike * square) return 0.0;
        }
    }
    return std::sqrt(square);
}

constexpr float infinity = std::numeric_limits<float>::infinity();
/// Distance of vertices of a block that are not in another image's Reach.
constexpr float out_of_reach = infinity;

}  // namespace

/// Values of vertices from all over the mesh, side by side in memory.
struct Puller::Gathered {
    PerVertex<glm::vec3> positions;
    PerVertex<glm::vec3> measured;  ///< if that is another shape
    PerVertex<float> weights;
};

Puller::Puller(const Dab& dab, std::size_t vertex_count, std::size_t weight_count, std::size_t out_count,
               const PullKernel& kernel)
    : force_(force_terms(dab.profile, dab.radius)),
      move_{dab.displacement, dab.minimum, dab.maximum, dab.clamp_axis},
      metric_(dab.metric),
      is_plain_(dab.metric == glm::mat3(1.0f)),
      vertex_count_(vertex_count),
      kernel_(kernel) {
    require(is_finite(dab.root), "root: must be finite");
    require(is_finite(dab.displacement), "displacement: must be finite");
    require(is_finite(dab.metric), "metric: must be finite");
    require(!std::isnan(dab.maximum) && dab.maximum > -std::numeric_limits<float>::infinity(),
            "maximum: must be a number above -infinity");
    require(dab.minimum <= dab.maximum && dab.minimum < std::numeric_limits<float>::infinity(),
            "minimum: must be <= maximum, and below infinity");
    require(dab.clamp_axis >= 0 && dab.clamp_axis <= 2, "clamp_axis: must be 0, 1 or 2");
    require(dab.mirror < 8, "mirror: must be bits of x 1, y 2, z 4");
    require(weight_count == 0 || weight_count == vertex_count, "weights: must be one for each vertex");
    require(out_count == vertex_count, "out: must be as long as positions");
    require(vertex_count <= std::numeric_limits<std::uint32_t>::max(), "positions: are too many");
    images_ = images_of(dab);
    const double size = is_plain_ ? 1.0 : uniform_scale(dab.metric);
    straight_ = force_;
    if (size > 0.0) {
        const auto share = static_cast<float>(force_.of_squares ? size * size : size);
        // Also for radii so small that their squares vanish: the root stays within reach, and 0 * scale is 0.
        straight_.limit = std::max(force_.limit / share, std::numeric_limits<float>::denorm_min());
        straight_.scale = std::min(force_.scale * share, std::numeric_limits<float>::max());
        is_plain_ = true;
    }
}

/// measured: positions on which distances are measured; null if these are the moved positions.
void Puller::check(const glm::vec3* positions, const glm::vec3* measured, const float* weights,
                   std::size_t count) const {
    const bool are_positions = kernel_.are_finite(numbers(positions), 3 * count) &&
                               (measured == nullptr || kernel_.are_finite(numbers(measured), 3 * count));
    require(are_positions, "positions: every value must be finite");
    require(weights == nullptr || kernel_.are_weights(weights, count),
            "weights: every value must lie in [0, 1]");
}

void Puller::check_whole(const Shapes& shapes, const float* weights, std::size_t first,
                         std::size_t last) const {
    check(shapes.positions + first, shapes.is_one() ? nullptr : shapes.measured + first,
          weights != nullptr ? weights + first : nullptr, last - first);
}

void Puller::check_among(const Shapes& shapes, const float* weights,
                         std::span<const std::uint32_t> vertices) const {
    Gathered block;
    for (std::size_t begin = 0; begin < vertices.size(); begin += pull_block) {
        const auto part = vertices.subspan(begin, std::min(pull_block, vertices.size() - begin));
        for (const std::uint32_t vertex : part)
            require(vertex < vertex_count_, "vertices: every index must be below the number of positions");
        gather(shapes, weights, part, block);
        check(block.positions.data(), shapes.is_one() ? nullptr : block.measured.data(), block.weights.data(),
              part.size());
    }
}

bool Puller::measure(const PullImage& image, const glm::vec3* positions, std::size_t count,
                     float* distances) const {
    return kernel_.measure(straight_, metric(), image.root, numbers(positions), count, distances);
}

/// distances(image, values) fills in the distances to the image with that number; false if all are out of
/// reach. False if nothing moves: then `out` is as it was.
template <class Distances>
bool Puller::act(const ForceTerms& force, const glm::vec3* positions, const float* weights, std::size_t count,
                 Distances&& distances, glm::vec3* out) const {
    PerVertex<float> numbers_of_block;
    float* const values = numbers_of_block.data();
    const auto make_forces = [&](std::size_t image) {
        if (!distances(image, values)) return false;
        kernel_.force(force, values, count);
        if (weights != nullptr) kernel_.weigh(weights, count, values);
        return true;
    };
    if (images_.size() == 1) {
        if (!make_forces(0)) return false;
        if (out != positions) std::copy_n(positions, count, out);
        kernel_.move(move_, values, count, numbers(out));
        return true;
    }
    Shares shares;
    bool is_near = false;
    for (std::size_t image = 0; image < images_.size(); ++image) {
        if (!make_forces(image)) continue;
        if (!is_near) shares.clear();
        is_near = true;
        kernel_.share(images_[image].displacement, values, count, shares);
    }
    if (!is_near) return false;
    if (out != positions) std::copy_n(positions, count, out);
    kernel_.move_by(move_, shares, count, numbers(out));
    return true;
}

void Puller::act_whole(const Shapes& shapes, const float* weights, std::size_t first, std::size_t last,
                       glm::vec3* out) const {
    const bool is_free = move_.minimum == -infinity && move_.maximum == infinity;
    const bool is_simple = is_free && images_.size() == 1;
    const glm::vec3* const positions = shapes.positions;
    for (std::size_t begin = first; begin < last; begin += pull_block) {
        const std::size_t count = std::min(pull_block, last - begin);
        const glm::vec3* from = positions + begin;
        const float* const weight = weights != nullptr ? weights + begin : nullptr;
        if (is_simple) {
            if (out != positions) std::copy_n(from, count, out + begin);
            kernel_.pull(straight_, move_, images_[0].root, metric(), count,
                         shapes.is_one() ? nullptr : numbers(shapes.measured + begin), weight,
                         numbers(out + begin));
            continue;
        }
        const auto distances = [&](std::size_t image, float* values) {
            return measure(images_[image], shapes.measured + begin, count, values);
        };
        const bool moved = act(straight_, from, weight, count, distances, out + begin);
        if (!moved && out != positions) std::copy_n(from, count, out + begin);
    }
}

void Puller::gather(const Shapes& shapes, const float* weights, std::span<const std::uint32_t> vertices,
                    Gathered& block) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        block.positions[i] = shapes.positions[vertices[i]];
        if (!shapes.is_one()) block.measured[i] = shapes.measured[vertices[i]];
        block.weights[i] = weights != nullptr ? weights[vertices[i]] : 1.0f;
    }
}

void Puller::act_among(const Shapes& shapes, const float* weights, std::span<const std::uint32_t> vertices,
                       glm::vec3* out) const {
    Gathered block;
    for (std::size_t begin = 0; begin < vertices.size(); begin += pull_block) {
        const auto part = vertices.subspan(begin, std::min(pull_block, vertices.size() - begin));
        gather(shapes, weights, part, block);
        const glm::vec3* const measured = (shapes.is_one() ? block.positions : block.measured).data();
        const auto distances = [&](std::size_t image, float* values) {
            return measure(images_[image], measured, part.size(), values);
        };
        glm::vec3* moved = block.positions.data();
        if (!act(straight_, moved, weights != nullptr ? block.weights.data() : nullptr, part.size(),
                 distances, moved))
            continue;
        for (std::size_t i = 0; i < part.size(); ++i) out[part[i]] = moved[i];
    }
}

void Puller::act_along(const glm::vec3* positions, const float* weights,
                       std::span<const std::uint32_t> vertices, std::span<const mesh::Reach> reaches,
                       glm::vec3* out) const {
    if (vertices.empty()) return;
    Gathered block;
    std::array<std::size_t, 8> next{};  // of each Reach, index of the first vertex that is not done
    for (std::size_t image = 0; image < reaches.size(); ++image) {
        const auto& all = reaches[image].vertices;
        next[image] = static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), vertices.front()) -
                                               all.begin());
    }
    for (std::size_t begin = 0; begin < vertices.size(); begin += pull_block) {
        const auto part = vertices.subspan(begin, std::min(pull_block, vertices.size() - begin));
        gather({positions, positions}, weights, part, block);
        const auto distances = [&](std::size_t image, float* values) {
            const mesh::Reach& reach = reaches[image];
            std::size_t& at = next[image];
            const std::size_t first = at;
            for (std::size_t i = 0; i < part.size(); ++i) {
                const bool is_held = at < reach.vertices.size() && reach.vertices[at] == part[i];
                values[i] = out_of_reach;
                if (!is_held) continue;
                const float distance = reach.distances[at];
                values[i] = force_.of_squares ? distance * distance : distance;
                ++at;
            }
            return at > first;
        };
        glm::vec3* moved = block.positions.data();
        if (!act(force_, moved, weights != nullptr ? block.weights.data() : nullptr, part.size(), distances,
                 moved))
            continue;
        for (std::size_t i = 0; i < part.size(); ++i) out[part[i]] = moved[i];
    }
}

}  // namespace motus::sculpt
