#include "motus/sculpt/pull.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"
#include "puller.hpp"

namespace motus::sculpt {
namespace {

// Vertices that are worth a thread: some 50 us of work.
constexpr std::size_t grain = 1 << 16;            // next to each other
constexpr std::size_t scattered_grain = 1 << 14;  // from all over the mesh

// Vertices that are copied after they have moved, while they are in the fastest cache.
constexpr std::size_t part = pull_block / 2;

[[nodiscard]] const float* pointer(std::span<const float> weights) {
    return weights.empty() ? nullptr : weights.data();
}

[[nodiscard]] Shapes shapes_of(std::span<const glm::vec3> positions, std::span<const glm::vec3> shape) {
    if (shape.empty()) return {positions.data(), positions.data()};
    if (shape.size() != positions.size()) throw std::invalid_argument("shape: must be as long as positions");
    return {positions.data(), shape.data()};
}

/// Prefetches memory that is written soon: the processor foresees only some of several arrays by itself.
void ask_for(std::span<const glm::vec3> positions) {
    constexpr std::size_t cache_line = 64;
    const std::span<const std::byte> bytes = std::as_bytes(positions);
    for (std::size_t i = 0; i < bytes.size(); i += cache_line) __builtin_prefetch(&bytes[i], 1, 2);
}

void bring(std::span<const glm::vec3> positions, std::span<glm::vec3> out, const Executor& executor) {
    if (out.data() == positions.data()) return;
    in_parts(
        positions.size(), grain,
        [&](std::size_t first, std::size_t last) {
            std::copy(positions.begin() + static_cast<std::ptrdiff_t>(first),
                      positions.begin() + static_cast<std::ptrdiff_t>(last),
                      out.begin() + static_cast<std::ptrdiff_t>(first));
        },
        executor);
}

void check_among(const Puller& puller, const Shapes& shapes, std::span<const float> weights,
                 std::span<const std::uint32_t> vertices, const Executor& executor) {
    in_parts(
        vertices.size(), scattered_grain,
        [&](std::size_t first, std::size_t last) {
            puller.check_among(shapes, pointer(weights), vertices.subspan(first, last - first));
        },
        executor);
}

void check(std::span<const mesh::Reach> reaches, std::size_t images, std::size_t vertex_count) {
    if (reaches.size() != images) throw std::invalid_argument("reach: there must be one for each image");
    for (const mesh::Reach& reach : reaches) {
        if (reach.vertices.size() != reach.distances.size())
            throw std::invalid_argument("reach: there must be a distance for each vertex");
        if (!std::ranges::all_of(reach.distances, [](float distance) { return distance >= 0.0F; }))
            throw std::invalid_argument("reach: every distance must be >= 0");
        const bool ascends = std::adjacent_find(reach.vertices.begin(), reach.vertices.end(),
                                                std::greater_equal<>()) == reach.vertices.end();
        if (!ascends) throw std::invalid_argument("reach: its vertices must ascend, each of them once");
        if (!reach.vertices.empty() && reach.vertices.back() >= vertex_count)
            throw std::invalid_argument("reach: every vertex must be below the number of positions");
    }
}

[[nodiscard]] std::vector<std::uint32_t> united(std::span<const mesh::Reach> reaches) {
    std::vector<std::uint32_t> all = reaches.front().vertices;
    for (const mesh::Reach& reach : reaches.subspan(1)) {
        std::vector<std::uint32_t> both;
        both.reserve(all.size() + reach.vertices.size());
        std::set_union(all.begin(), all.end(), reach.vertices.begin(), reach.vertices.end(),
                       std::back_inserter(both));
        all.swap(both);
    }
    return all;
}

}  // namespace

std::vector<PullImage> images_of(const Dab& dab) {
    require(is_finite(dab.root), "root: must be finite");
    require(is_finite(dab.displacement), "displacement: must be finite");
    require(dab.mirror < 8, "mirror: must be bits of x 1, y 2, z 4");
    std::vector<PullImage> images;
    for (unsigned mirrored = 0; mirrored < 8; ++mirrored) {
        if ((mirrored & ~dab.mirror) != 0) continue;
        const glm::vec3 signs((mirrored & 1u) != 0 ? -1.0f : 1.0f, (mirrored & 2u) != 0 ? -1.0f : 1.0f,
                              (mirrored & 4u) != 0 ? -1.0f : 1.0f);
        images.push_back({signs * dab.root, signs * dab.displacement});
    }
    return images;
}

void pull(std::span<const glm::vec3> positions, const Dab& dab, std::span<const float> weights,
          std::span<glm::vec3> out, std::span<const glm::vec3> shape, std::span<glm::vec3> copy,
          const Executor& executor) {
    in_ieee_floats([&] {
        const Puller puller(dab, positions.size(), weights.size(), out.size());
        const Shapes shapes = shapes_of(positions, shape);
        if (!copy.empty() && copy.size() != positions.size())
            throw std::invalid_argument("copy: must be as long as positions");
        in_parts(
            positions.size(), grain,
            [&](std::size_t first, std::size_t last) {
                puller.check_whole(shapes, pointer(weights), first, last);
            },
            executor);
        in_parts(
            positions.size(), grain,
            [&](std::size_t first, std::size_t last) {
                for (std::size_t begin = first; begin < last; begin += part) {
                    const std::size_t end = std::min(begin + part, last);
                    if (!copy.empty()) ask_for(copy.subspan(end, std::min(part, last - end)));
                    puller.act_whole(shapes, pointer(weights), begin, end, out.data());
                    if (!copy.empty()) std::copy_n(out.data() + begin, end - begin, copy.data() + begin);
                }
            },
            executor);
    });
}

void pull_among(std::span<const glm::vec3> positions, const Dab& dab, std::span<const std::uint32_t> vertices,
                std::span<const float> weights, std::span<glm::vec3> out, std::span<const glm::vec3> shape,
                const Executor& executor) {
    in_ieee_floats([&] {
        const Puller puller(dab, positions.size(), weights.size(), out.size());
        const Shapes shapes = shapes_of(positions, shape);
        check_among(puller, shapes, weights, vertices, executor);
        bring(positions, out, executor);
        in_parts(
            vertices.size(), scattered_grain,
            [&](std::size_t first, std::size_t last) {
                puller.act_among(shapes, pointer(weights), vertices.subspan(first, last - first), out.data());
            },
            executor);
    });
}

void pull_along(std::span<const glm::vec3> positions, const Dab& dab, std::span<const mesh::Reach> reaches,
                std::span<const float> weights, std::span<glm::vec3> out, const Executor& executor) {
    in_ieee_floats([&] {
        const Puller puller(dab, positions.size(), weights.size(), out.size());
        check(reaches, puller.images().size(), positions.size());
        const std::vector<std::uint32_t> several =
            reaches.size() > 1 ? united(reaches) : std::vector<std::uint32_t>{};
        const std::span<const std::uint32_t> vertices =
            reaches.size() > 1 ? several : reaches.front().vertices;
        check_among(puller, {positions.data(), positions.data()}, weights, vertices, executor);
        bring(positions, out, executor);
        in_parts(
            vertices.size(), scattered_grain,
            [&](std::size_t first, std::size_t last) {
                puller.act_along(positions.data(), pointer(weights), vertices.subspan(first, last - first),
                                 reaches, out.data());
            },
            executor);
    });
}

}  // namespace motus::sculpt
