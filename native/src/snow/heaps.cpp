#include "heaps.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "heaps_kernel.hpp"
#include "holding.hpp"

namespace motus::snow {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr int rings = 32;  ///< of vertices that are near the line at which snow ends

[[nodiscard]] std::uint32_t vertex(const glm::ivec3& corners, std::size_t corner) {
    return static_cast<std::uint32_t>(corners[static_cast<int>(corner % 3)]);
}

/// A part of the line at which snow ends, in a triangle.
struct Stretch {
    glm::vec3 start, way;
    std::uint32_t triangle = 0;
    float cell = 0.0F;

    [[nodiscard]] float distance(const glm::vec3& place) const {
        const glm::vec3 off = place - start;
        const float square = glm::dot(way, way);
        const float part = square > 0.0F ? std::clamp(glm::dot(off, way) / square, 0.0F, 1.0F) : 0.0F;
        return glm::length(off - part * way);
    }
};

}  // namespace

/// Puts the edges into their order (Net::ranks) four by four, those on which snow ends last. An edge is in
/// the first Ways with room after all that have one of its vertices, so that the four have none in common. As
/// far as the order leaves it open, edges near each other on the surface are near each other in memory.
class Heaps::Linker {
  public:
    Linker(Heaps& heaps, const Net& net)
        : net_(net), ways_(heaps.plan_.ways), nowhere_(static_cast<std::uint32_t>(net.positions.size())) {
        find_spokes();
        next_.assign(starts_.begin(), starts_.end() - 1);
        ways_.reserve(net.edges.size() / HeapPlan::width + 2 * HeapPlan::block);
        open_.reserve(ways_.capacity());
        for (const bool is_at_end : {false, true}) {
            free_.assign(nowhere_, static_cast<std::uint32_t>(ways_.size()));
            for (std::uint32_t i = 0; i < nowhere_; ++i)
                while (next_[i] < starts_[i + 1] && is_end(spokes_[next_[i]]) == is_at_end)
                    add_with_those_before(spokes_[next_[i]]);
            while (ways_.size() % HeapPlan::block != 0) add_ways();
            if (!is_at_end) heaps.plan_.whole = ways_.size();
        }
    }

    /// The edges of a vertex, in their order; `use`: of the vertex at the other end, and whether snow ends on
    /// the edge.
    template <class Use>
    void each_spoke(std::uint32_t vertex, const Use& use) const {
        for (std::uint32_t i = starts_[vertex]; i < starts_[vertex + 1]; ++i)
            use(other_end(spokes_[i], vertex), is_end(spokes_[i]));
    }
    /// m, of the edge between two vertices.
    [[nodiscard]] float length(std::uint32_t x, std::uint32_t y) const {
        return static_cast<float>(glm::length(glm::dvec3(net_.positions[y]) - glm::dvec3(net_.positions[x])));
    }

  private:
    static constexpr std::uint32_t end_bit = std::uint32_t{1} << 31U;  // of spokes; edges are fewer
    [[nodiscard]] static bool is_end(std::uint32_t spoke) { return (spoke & end_bit) != 0; }
    [[nodiscard]] glm::uvec2 ends_of(std::uint32_t spoke) const {
        const glm::uvec2 ends(net_.edges[spoke & ~end_bit]);
        return ends;
    }
    [[nodiscard]] std::uint32_t other_end(std::uint32_t spoke, std::uint32_t vertex) const {
        const glm::uvec2 ends = ends_of(spoke);
        return ends.x == vertex ? ends.y : ends.x;
    }

    void find_spokes() {
        starts_.assign(std::size_t{nowhere_} + 1, 0);
        for (const glm::ivec2& edge : net_.edges)
            for (const int end : {edge.x, edge.y}) ++starts_[static_cast<std::size_t>(end) + 1];
        for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        spokes_.resize(starts_.back());
        for (std::size_t i = 0; i < net_.edges.size(); ++i) {
            const auto spoke = static_cast<std::uint32_t>(i) | (net_.ends[i] >= 0.0F ? end_bit : 0);
            for (const int end : {net_.edges[i].x, net_.edges[i].y})
                spokes_[next[static_cast<std::size_t>(end)]++] = spoke;
        }
        std::vector<std::uint64_t> around;  // where snow ends last, then by ranks
        for (std::uint32_t i = 0; i < nowhere_; ++i) {
            around.clear();
            for (std::uint32_t j = starts_[i]; j < starts_[i + 1]; ++j) {
                const std::uint64_t rank = net_.ranks[other_end(spokes_[j], i)];
                around.push_back(((rank | (spokes_[j] & end_bit)) << 32U) | spokes_[j]);
            }
            std::ranges::sort(around);
            for (std::uint32_t j = starts_[i]; const std::uint64_t one : around)
                spokes_[j++] = static_cast<std::uint32_t>(one);
        }
    }
    void add_with_those_before(std::uint32_t last) {
        waiting_.push_back(last);
        while (!waiting_.empty()) {
            const std::uint32_t spoke = waiting_.back();
            const glm::uvec2 ends = ends_of(spoke);
            if (const std::uint32_t first = spokes_[next_[ends.x]]; first != spoke) {
                waiting_.push_back(first);
            } else if (const std::uint32_t other = spokes_[next_[ends.y]]; other != spoke) {
                waiting_.push_back(other);
            } else {
                waiting_.pop_back();
                ++next_[ends.x];
                ++next_[ends.y];
                if (ends.x != ends.y) add(ends);
            }
        }
    }
    void add(const glm::uvec2& ends) {
        const std::uint32_t at = first_open(std::max(free_[ends.x], free_[ends.y]));
        free_[ends.x] = free_[ends.y] = at + 1;
        Ways& ways = ways_[at];
        std::size_t place = 0;
        while (ways.x.at(place) != nowhere_) ++place;
        ways.x.at(place) = ends.x;
        ways.y.at(place) = ends.y;
        ways.lengths.at(place) = length(ends.x, ends.y);
        if (place + 1 == HeapPlan::width) open_[at] = at + 1;
    }
    void add_ways() {
        open_.push_back(static_cast<std::uint32_t>(ways_.size()));
        Ways ways;
        ways.x.fill(nowhere_);
        ways.y.fill(nowhere_);
        ways_.push_back(ways);
    }
    /// The first Ways with room for another edge, from these on.
    [[nodiscard]] std::uint32_t first_open(std::uint32_t at) {
        while (at < ways_.size() && open_[at] != at) {
            if (open_[at] < ways_.size()) open_[at] = open_[open_[at]];
            at = open_[at];
        }
        if (at == ways_.size()) add_ways();
        return at;
    }

    const Net& net_;
    std::vector<Ways>& ways_;
    std::uint32_t nowhere_;               ///< a vertex that there is not
    std::vector<std::uint32_t> starts_;   ///< of each vertex's spokes
    std::vector<std::uint32_t> spokes_;   ///< edges, those on which snow ends with the end bit
    std::vector<std::uint32_t> next_;     ///< of each vertex's spokes the first that is not yet added
    std::vector<std::uint32_t> waiting_;  ///< spokes, each for the one behind it
    std::vector<std::uint32_t> free_;     ///< the first Ways from which on none has an edge of each vertex
    std::vector<std::uint32_t> open_;  ///< each Ways itself; of a full one, a later one up to that with room
};

Heaps::Heaps(const Net& net) {
    measure(net);
    Linker linker(*this, net);
    gather_groups();
    find_shores(net, linker);
}

/// How much snow lies on each vertex for each metre of depth.
void Heaps::measure(const Net& net) {
    std::vector<double> areas(net.positions.size());
    for (std::size_t i = 0; i < net.triangles.size(); ++i) {
        const glm::ivec3& corners = net.triangles[i];
        const auto place = [&](std::size_t corner) {
            return glm::dvec3(net.positions[vertex(corners, corner)]);
        };
        const double third = glm::length(glm::cross(place(1) - place(0), place(2) - place(0))) / 6.0;
        std::array<std::optional<float>, 3> ends;
        bool is_whole = true;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto side = static_cast<std::size_t>(net.sides[i][static_cast<int>(corner)]);
            const float end = net.ends[side];
            if (end < 0.0F) continue;
            is_whole = false;
            const bool is_along = static_cast<std::uint32_t>(net.edges[side].x) == vertex(corners, corner);
            ends.at(corner) = is_along ? end : 1.0F - end;
        }
        const std::array<double, 3> parts =
            is_whole ? std::array<double, 3>{1.0, 1.0, 1.0} : shown_parts(ends);
        for (std::size_t corner = 0; corner < 3; ++corner)
            areas[vertex(corners, corner)] += parts.at(corner) * third;
    }
    // Over what is so large that floats cannot tell how large nothing goes.
    constexpr double most = 1e30;
    plan_.areas.reserve(areas.size() + 1);
    for (const double area : areas) plan_.areas.push_back(area < most ? static_cast<float>(area) : 0.0F);
    plan_.areas.push_back(0.0F);
}

void Heaps::gather_groups() {
    std::vector<std::uint32_t> last_block(plan_.areas.size() / HeapPlan::group +
                                          1);  // of each group, from 1 on
    plan_.group_starts.assign(1, 0);
    for (std::size_t first = 0; first < plan_.ways.size(); first += HeapPlan::block) {
        for (const Ways& ways : std::span(plan_.ways).subspan(first, HeapPlan::block)) {
            for (const auto& ends : {ways.x, ways.y}) {
                for (const std::uint32_t end : ends) {
                    if (end + 1 == plan_.areas.size()) continue;  // a missing edge's
                    std::uint32_t& last = last_block[end / HeapPlan::group];
                    if (last == plan_.group_starts.size()) continue;
                    last = static_cast<std::uint32_t>(plan_.group_starts.size());
                    plan_.groups.push_back(static_cast<std::uint32_t>(end / HeapPlan::group));
                }
            }
        }
        plan_.group_starts.push_back(static_cast<std::uint32_t>(plan_.groups.size()));
    }
}

/// Hands the nearest stretch of the line at which snow ends on from ring to ring of vertices.
void Heaps::find_shores(const Net& net, const Linker& linker) {
    if (plan_.whole == plan_.ways.size()) return;
    std::vector<Stretch> stretches;
    std::vector<std::uint32_t> nearest(net.positions.size()), ring, next;
    std::vector<std::uint8_t> is_next(net.positions.size());
    std::vector<float> distances(net.positions.size(), infinite);
    const auto offer = [&](std::uint32_t at, std::uint32_t stretch) {
        if (distances[at] < infinite && nearest[at] == stretch) return;
        const float distance = stretches[stretch].distance(net.positions[at]);
        if (!(distance < distances[at])) return;
        distances[at] = distance;
        nearest[at] = stretch;
        if (is_next[at] == 0) next.push_back(at);
        is_next[at] = 1;
    };
    for (std::uint32_t i = 0; i < net.triangles.size(); ++i) {
        std::array<glm::vec3, 3> cuts{};
        std::size_t count = 0;
        for (int side = 0; side < 3; ++side) {
            const auto edge = static_cast<std::size_t>(net.sides[i][side]);
            if (net.ends[edge] < 0.0F) continue;
            cuts.at(count++) =
                glm::mix(net.positions[static_cast<std::size_t>(net.edges[edge].x)],
                         net.positions[static_cast<std::size_t>(net.edges[edge].y)], net.ends[edge]);
        }
        if (count < 2) continue;
        float sum = 0.0F, ways = 0.0F;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t at = vertex(net.triangles[i], corner);
            linker.each_spoke(at, [&](std::uint32_t other, bool) {
                sum += linker.length(at, other);
                ways += 1.0F;
            });
        }
        for (std::size_t one = 1; one < count; ++one) {
            stretches.push_back({cuts.at(one - 1), cuts.at(one) - cuts.at(one - 1), i, sum / ways});
            for (std::size_t corner = 0; corner < 3; ++corner)
                offer(vertex(net.triangles[i], corner), static_cast<std::uint32_t>(stretches.size() - 1));
        }
    }
    for (int count = 1; count < rings; ++count) {
        ring.swap(next);
        next.clear();
        for (const std::uint32_t at : ring) is_next[at] = 0;
        for (const std::uint32_t at : ring)
            linker.each_spoke(at, [&](std::uint32_t other, bool is_at_end) {
                if (!is_at_end) offer(other, nearest[at]);
            });
    }
    // Distances are not negative, so that their bits have the same order.
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;  // of distances, then of ranks; the vertex
    for (std::uint32_t i = 0; i < distances.size(); ++i)
        if (distances[i] < infinite)
            order.emplace_back(
                (std::uint64_t{std::bit_cast<std::uint32_t>(distances[i])} << 32U) | net.ranks[i], i);
    std::ranges::sort(order);
    plan_.shores.reserve(order.size());
    for (const auto& [key, at] : order) {
        const Stretch& stretch = stretches[nearest[at]];
        plan_.shores.push_back(
            {at, distances[at], stretch.cell, glm::uvec3(net.triangles[stretch.triangle])});
    }
    find_handings(distances, linker);
}

/// What is too much for a shore lies on what is farther from the line, in proportion to how much farther that
/// is and to its area; what would lie on vertices that are no shores is gone.
void Heaps::find_handings(std::span<const float> distances, const Linker& linker) {
    std::vector<std::uint32_t> places(distances.size());  // among plan_.shores
    for (std::uint32_t i = 0; i < plan_.shores.size(); ++i) places[plan_.shores[i].vertex] = i;
    plan_.handing_starts.assign(1, 0);
    for (Shore& shore : plan_.shores) {
        linker.each_spoke(shore.vertex, [&](std::uint32_t other, bool is_at_end) {
            if (is_at_end || !(distances[other] > shore.distance)) return;
            const float farther =
                std::min(distances[other] - shore.distance, linker.length(shore.vertex, other));
            if (!(farther > 0.0F)) return;
            const double weight = static_cast<double>(farther) * static_cast<double>(plan_.areas[other]);
            shore.weights += weight;
            if (distances[other] < infinite && weight > 0.0)
                plan_.handings.push_back({places[other], weight});
        });
        plan_.handing_starts.push_back(static_cast<std::uint32_t>(plan_.handings.size()));
    }
}

void Heaps::settle(std::vector<float>& depths, float steepest) const {
    depths.push_back(0.0F);
    heap_kernels().back().settle(plan_, depths, steepest);
    depths.pop_back();
}

}  // namespace motus::snow
