#include "motus/mesh/neighbours.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "motus/core/parallel.hpp"

namespace motus::mesh {
namespace {

/// work(first, last) for ranges of vertices. Every range reads the whole mesh: few ranges, so that none of
/// many threads waits for memory.
template <class Work>
void in_ranges(std::size_t vertex_count, const Work& work, const Executor& executor) {
    const std::size_t ranges = std::min<std::size_t>(executor.threads(), 8);
    const std::size_t grain = std::max<std::size_t>(20'000, (vertex_count + ranges - 1) / ranges);
    in_parts(vertex_count, grain, work, executor);
}

template <class Element>
void check_indices(std::span<const Element> elements, std::size_t vertex_count, const char* message,
                   const Executor& executor) {
    in_parts(
        elements.size(), 200'000,
        [&](std::size_t first, std::size_t last) {
            for (const Element& element : elements.subspan(first, last - first))
                for (int i = 0; i < Element::length(); ++i)
                    if (element[i] < 0 || static_cast<std::size_t>(element[i]) >= vertex_count)
                        throw std::invalid_argument(message);
        },
        executor);
}

/// Packs what each_of(tell) tells by tell(vertex, value), vertex after vertex, in the order it is told.
template <class Value, class EachOf>
void pack(std::size_t vertex_count, const EachOf& each_of, std::vector<std::uint32_t>& starts,
          std::vector<Value>& values, const Executor& executor) {
    starts.assign(vertex_count + 1, 0);
    in_ranges(
        vertex_count,
        [&](std::size_t first, std::size_t last) {
            each_of([&](std::uint32_t vertex, const Value&) {
                if (vertex >= first && vertex < last) ++starts[vertex + 1];
            });
        },
        executor);
    std::uint64_t sum = 0;
    for (std::uint32_t& start : starts) {
        sum += start;
        if (sum > std::numeric_limits<std::uint32_t>::max())
            throw std::invalid_argument("triangles: must be fewer, or the edges");
        start = static_cast<std::uint32_t>(sum);
    }
    values.resize(sum);
    in_ranges(
        vertex_count,
        [&](std::size_t first, std::size_t last) {
            std::vector<std::uint32_t> next(starts.data() + first, starts.data() + last);
            each_of([&](std::uint32_t vertex, const Value& value) {
                if (vertex >= first && vertex < last) values[next[vertex - first]++] = value;
            });
        },
        executor);
}

template <class Tell>
void tell_triangles(std::span<const glm::ivec3> triangles, const Tell& tell) {
    for (const glm::ivec3& corners : triangles) {
        const glm::uvec3 t(corners);
        if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
        tell(t.x, glm::uvec2(t.y, t.z));
        tell(t.y, glm::uvec2(t.z, t.x));
        tell(t.z, glm::uvec2(t.x, t.y));
    }
}

template <class Tell>
void tell_edges(std::span<const glm::ivec2> edges, const Tell& tell) {
    for (const glm::ivec2& ends : edges) {
        const glm::uvec2 e(ends);
        if (e.x == e.y) continue;
        tell(e.x, e.y);
        tell(e.y, e.x);
    }
}

}  // namespace

Neighbours::Neighbours(std::size_t vertex_count, std::span<const glm::ivec3> triangles,
                       std::span<const glm::ivec2> edges, const Executor& executor) {
    check_indices(triangles, vertex_count, "triangles: must hold indices of vertices", executor);
    check_indices(edges, vertex_count, "edges: must hold indices of vertices", executor);
    const auto each_triangle = [&](const auto& tell) { tell_triangles(triangles, tell); };
    pack(vertex_count, each_triangle, fan_starts_, fans_, executor);
    pack(
        vertex_count, [&](const auto& tell) { tell_edges(edges, tell); }, end_starts_, ends_, executor);

    std::vector<std::uint8_t> is_wire(edges.size());
    in_parts(
        edges.size(), 50'000,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                glm::uvec2 e(edges[i]);
                if (fan(e.y).size() < fan(e.x).size()) std::swap(e.x, e.y);
                const bool is_wired =
                    e.x != e.y && std::ranges::none_of(fan(e.x), [&](const glm::uvec2& others) {
                        return others.x == e.y || others.y == e.y;
                    });
                is_wire[i] = is_wired ? 1 : 0;
            }
        },
        executor);
    if (std::ranges::find(is_wire, 1) == is_wire.end()) return;
    std::vector<glm::ivec2> wires;
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (is_wire[i] != 0) wires.push_back(edges[i]);
    const auto each_triangle_and_wire = [&](const auto& tell) {
        tell_triangles(triangles, tell);
        tell_edges(wires, [&](std::uint32_t vertex, std::uint32_t end) { tell(vertex, glm::uvec2(end)); });
    };
    pack(vertex_count, each_triangle_and_wire, fan_starts_, fans_, executor);
}

Neighbours Neighbours::of_triangles(std::size_t vertex_count, std::span<const glm::ivec3> triangles,
                                    const Executor& executor) {
    check_indices(triangles, vertex_count, "triangles: must hold indices of vertices", executor);
    Neighbours made;
    pack(
        vertex_count, [&](const auto& tell) { tell_triangles(triangles, tell); }, made.fan_starts_,
        made.fans_, executor);

    // At most two ends a triangle; what several triangles share is squeezed out afterwards.
    std::vector<std::uint32_t> ends(2 * made.fans_.size());
    made.end_starts_.assign(vertex_count + 1, 0);
    in_ranges(
        vertex_count,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t vertex = first; vertex < last; ++vertex) {
                const auto begin = ends.begin() + 2 * static_cast<std::ptrdiff_t>(made.fan_starts_[vertex]);
                auto end = begin;
                for (const glm::uvec2& others : made.fan(static_cast<std::uint32_t>(vertex))) {
                    *end++ = others.x;
                    *end++ = others.y;
                }
                std::sort(begin, end);
                made.end_starts_[vertex + 1] = static_cast<std::uint32_t>(std::unique(begin, end) - begin);
            }
        },
        executor);
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex)
        made.end_starts_[vertex + 1] += made.end_starts_[vertex];
    made.ends_.resize(made.end_starts_.back());
    in_ranges(
        vertex_count,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t vertex = first; vertex < last; ++vertex)
                std::copy_n(ends.begin() + 2 * static_cast<std::ptrdiff_t>(made.fan_starts_[vertex]),
                            made.end_starts_[vertex + 1] - made.end_starts_[vertex],
                            made.ends_.begin() + made.end_starts_[vertex]);
        },
        executor);
    return made;
}

}  // namespace motus::mesh
