#include "heaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "holding.hpp"
#include "motus/core/numeric.hpp"

namespace motus::snow {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr int rings = 32;          ///< of vertices that are near the line at which snow ends
constexpr float widest = 12.0F;    ///< cells, of the slope beside the line,
constexpr float narrowest = 2.0F;  ///< which a mesh can show without steps

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

Heaps::Heaps(const Net& net) {
    measure(net);
    link(net);
    find_shores(net);
}

/// How much snow lies on each vertex for each metre of depth.
void Heaps::measure(const Net& net) {
    std::vector<double> areas(net.positions.size());
    for (std::size_t i = 0; i < net.triangles.size(); ++i) {
        const glm::ivec3& corners = net.triangles[i];
        const auto place = [&](std::size_t corner) {
            return glm::dvec3(net.positions[vertex(corners, corner)]);
        };
        const double third = length_of(glm::cross(place(1) - place(0), place(2) - place(0))) / 6.0;
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
    areas_.reserve(areas.size());
    for (const double area : areas) areas_.push_back(area < most ? static_cast<float>(area) : 0.0F);
}

void Heaps::link(const Net& net) {
    ways_.reserve(net.edges.size());
    for (const bool is_at_end : {false, true}) {
        for (std::size_t i = 0; i < net.edges.size(); ++i) {
            if ((net.ends[i] >= 0.0F) != is_at_end) continue;
            const auto x = static_cast<std::uint32_t>(net.edges[i].x),
                       y = static_cast<std::uint32_t>(net.edges[i].y);
            const double length = length_of(glm::dvec3(net.positions[y]) - glm::dvec3(net.positions[x]));
            ways_.push_back({x, y, static_cast<float>(length)});
        }
        if (!is_at_end) whole_ = static_cast<std::uint32_t>(ways_.size());
    }
    spoke_starts_.assign(net.positions.size() + 1, 0);
    for (const Way& way : ways_)
        for (const std::uint32_t end : {way.x, way.y}) ++spoke_starts_[end + 1];
    for (std::size_t i = 1; i < spoke_starts_.size(); ++i) spoke_starts_[i] += spoke_starts_[i - 1];
    spokes_.resize(spoke_starts_.back());
    std::vector<std::uint32_t> next(spoke_starts_.begin(), spoke_starts_.end() - 1);
    for (std::uint32_t i = 0; i < ways_.size(); ++i)
        for (const std::uint32_t end : {ways_[i].x, ways_[i].y}) spokes_[next[end]++] = i;
}

/// Hands the nearest stretch of the line at which snow ends on from ring to ring of vertices.
void Heaps::find_shores(const Net& net) {
    if (whole_ == ways_.size()) return;
    std::vector<Stretch> stretches;
    std::vector<std::uint32_t> nearest(net.positions.size()), ring, next;
    std::vector<std::uint8_t> is_next(net.positions.size());
    distances_.assign(net.positions.size(), infinite);
    const auto offer = [&](std::uint32_t at, std::uint32_t stretch) {
        const float distance = stretches[stretch].distance(net.positions[at]);
        if (!(distance < distances_[at])) return;
        distances_[at] = distance;
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
            for (const std::uint32_t spoke : spokes(vertex(net.triangles[i], corner))) {
                sum += ways_[spoke].length;
                ways += 1.0F;
            }
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
            for (const std::uint32_t spoke : spokes(at))
                if (spoke < whole_) offer(ways_[spoke].beyond(at), nearest[at]);
    }
    for (std::uint32_t i = 0; i < distances_.size(); ++i) {
        if (distances_[i] == infinite) continue;
        const Stretch& stretch = stretches[nearest[i]];
        shores_.push_back({i, stretch.triangle, distances_[i], stretch.cell});
    }
    std::ranges::sort(shores_, [](const Shore& a, const Shore& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.vertex < b.vertex;
    });
    for (const Shore& shore : shores_) shore_corners_.emplace_back(net.triangles[shore.triangle]);
}

/// One settling of depths.
class Heaps::Fall {
  public:
    Fall(const Heaps& heaps, std::vector<float>& depths, float steepest)
        : heaps_(heaps),
          depths_(depths),
          steepest_(steepest),
          is_active_(heaps.ways_.size() / block + 1),
          is_left_(is_active_.size()) {}

    void run() {
        round_off();
        std::ranges::fill(is_active_, std::uint8_t{1});
        go_through(heaps_.whole_, most_spread, [&](const Way& way) { return hand_on(way); });
        lower_shores();
        for (std::size_t i = 0; i < is_active_.size(); ++i) is_active_[i] |= is_left_[i];
        for (std::size_t i = heaps_.whole_; i < heaps_.ways_.size(); ++i) is_active_[i / block] = 1;
        go_through(heaps_.ways_.size(), most_lowered, [&](const Way& way) {
            lower(way);
            return true;
        });
    }

  private:
    /// A little less steep than may be, so that there is an end to it.
    static constexpr float slack = 0.02F;
    static constexpr std::size_t block = 64;  ///< of edges
    static constexpr int most_spread = 8, most_lowered = 8;

    /// Changes the first so many edges, where they are too steep, there and back in turn; those about which
    /// nothing has changed rest.
    template <class Change>
    void go_through(std::size_t count, int most_rounds, const Change& change) {
        const std::size_t blocks = (count + block - 1) / block;
        bool has_changed = true;
        for (int round = 0; round < most_rounds && has_changed; ++round) {
            has_changed = false;
            const bool is_back = round % 2 != 0;
            for (std::size_t i = 0; i < blocks; ++i) {
                const std::size_t at = is_back ? blocks - 1 - i : i;
                if (is_active_[at] == 0) continue;
                is_active_[at] = 0;
                const std::size_t first = at * block, length = std::min(block, count - first);
                for (std::size_t j = 0; j < length; ++j) {
                    const Way& way = heaps_.ways_[first + (is_back ? length - 1 - j : j)];
                    if (!is_too_steep(way)) continue;
                    if (!change(way)) {
                        is_left_[at] = 1;
                        continue;
                    }
                    wake(way.x);
                    wake(way.y);
                    has_changed = true;
                }
            }
        }
    }
    void wake(std::uint32_t vertex) {
        for (const std::uint32_t spoke : heaps_.spokes(vertex)) is_active_[spoke / block] = 1;
    }
    [[nodiscard]] bool is_too_steep(const Way& way) const {
        return std::abs(depths_[way.x] - depths_[way.y]) > steepest_ * way.length;
    }

    /// Of the slope from the line up to a depth.
    [[nodiscard]] float width_of(const Shore& shore, float depth) const {
        return std::clamp(2.0F * depth / steepest_, narrowest * shore.cell, widest * shore.cell);
    }
    /// How deep the snow on a shore may be, without what lies on both sides of the line.
    [[nodiscard]] float rounded(const Shore& shore, float depth) const {
        const float part = shore.distance / width_of(shore, depth);
        return part < 1.0F ? depth * part * (2.0F - part) : depth;
    }

    /// Lets the snow rise from the line at which it ends as roundly as a mesh can show, and no steeper than
    /// it may be. What is too much lies on what is farther from the line, the less the farther.
    void round_off() {
        const std::size_t count = heaps_.shores_.size();
        if (count == 0) return;
        bases_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::uvec3& corners = heaps_.shore_corners_[i];
            bases_[i] =
                std::max(0.0F, std::min({depths_[corners.x], depths_[corners.y], depths_[corners.z]}));
        }
        std::vector<double> carried(depths_.size());
        for (std::size_t i = 0; i < count; ++i) {
            const Shore& shore = heaps_.shores_[i];
            const double area = static_cast<double>(heaps_.areas_[shore.vertex]);
            if (!(area > 0.0)) continue;
            const double left = take(shore, bases_[i], carried[shore.vertex] / area);
            if (left > 0.0) pass_on(shore, area * left, carried);
        }
    }
    /// Lays some of what is handed to a shore on it, m, and returns what is too much.
    [[nodiscard]] double take(const Shore& shore, float base, double more) {
        constexpr float reach = 2.0F;    // times the width of the slope: where most of it lies
        constexpr float highest = 0.2F;  // of the depth, so that nothing is heaped up where ways meet
        float& depth = depths_[shore.vertex];
        const float own = std::max(0.0F, depth - base);
        const float share = std::min(1.0F, shore.cell / (reach * width_of(shore, own)));
        const float taken = std::min(share * static_cast<float>(more), highest * own);
        const float whole = depth + taken;
        depth = whole > base ? base + rounded(shore, whole - base) : whole;
        return more - static_cast<double>(taken) + static_cast<double>(whole - depth);
    }
    void pass_on(const Shore& shore, double volume, std::vector<double>& carried) {
        const auto each = [&](const auto& use) {
            for (const std::uint32_t spoke : heaps_.spokes(shore.vertex)) {
                if (spoke >= heaps_.whole_) continue;
                const Way& way = heaps_.ways_[spoke];
                const std::uint32_t other = way.beyond(shore.vertex);
                const float farther = std::min(heaps_.distances_[other] - shore.distance, way.length);
                if (farther > 0.0F)
                    use(other, static_cast<double>(farther) * static_cast<double>(heaps_.areas_[other]));
            }
        };
        double sum = 0.0;
        each([&](std::uint32_t, double weight) { sum += weight; });
        if (sum > 0.0)
            each([&](std::uint32_t other, double weight) { carried[other] += volume * weight / sum; });
    }
    void lower_shores() {
        for (std::size_t i = 0; i < bases_.size(); ++i) {
            const Shore& shore = heaps_.shores_[i];
            const float most = bases_[i] + steepest_ * shore.distance;
            if (!(depths_[shore.vertex] > most)) continue;
            depths_[shore.vertex] = most;
            wake(shore.vertex);
        }
    }

    /// To the lower vertex of two, so that volumes stay; not over edges on which snow ends.
    [[nodiscard]] bool hand_on(const Way& way) {
        const bool is_x = depths_[way.x] > depths_[way.y];
        const std::uint32_t high = is_x ? way.x : way.y, low = is_x ? way.y : way.x;
        const float here = heaps_.areas_[high], there = heaps_.areas_[low];
        if (!(here > 0.0F) || !(there > 0.0F)) return false;
        const float over = depths_[high] - depths_[low] - (1.0F - slack) * steepest_ * way.length;
        const float moved = over / (here + there);
        depths_[high] -= there * moved;
        depths_[low] += here * moved;
        return true;
    }
    /// Leaves out what is still too high.
    void lower(const Way& way) {
        const bool is_x = depths_[way.x] > depths_[way.y];
        depths_[is_x ? way.x : way.y] = depths_[is_x ? way.y : way.x] + steepest_ * way.length;
    }

    const Heaps& heaps_;
    std::vector<float>& depths_;
    float steepest_;
    std::vector<std::uint8_t> is_active_,
        is_left_;               ///< blocks of edges, and those with some that cannot be changed
    std::vector<float> bases_;  ///< m, what lies on both sides of the line beside each shore
};

void Heaps::settle(std::vector<float>& depths, float steepest) const {
    Fall(*this, depths, steepest).run();
}

}  // namespace motus::snow
