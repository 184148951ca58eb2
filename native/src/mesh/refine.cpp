#include "motus/mesh/refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "motus/core/numeric.hpp"

namespace motus::mesh {
namespace {

constexpr int none = -1;

[[nodiscard]] std::uint64_t key_of(int a, int b) {
    const auto low = static_cast<std::uint64_t>(std::min(a, b));
    return (low << 32U) | static_cast<std::uint64_t>(std::max(a, b));
}

/// The middle of an edge: its ends' sum alone may be beyond single precision.
[[nodiscard]] glm::vec3 middle_of(const glm::vec3& a, const glm::vec3& b) {
    const auto half = [](float one, float other) { return static_cast<float>(0.5 * (double(one) + other)); };
    return {half(a.x, b.x), half(a.y, b.y), half(a.z, b.z)};
}

/// One round, in which each long edge is halved once.
class Round {
  public:
    Round(Refined& mesh, double longest) : mesh_(mesh), longest_(longest) {
        for (const glm::ivec3& corners : mesh_.triangles)
            for (int side = 0; side < 3; ++side)
                if (is_long(corners[side], corners[(side + 1) % 3]))
                    halved_.push_back(key_of(corners[side], corners[(side + 1) % 3]));
        std::ranges::sort(halved_);
        halved_.erase(std::unique(halved_.begin(), halved_.end()), halved_.end());
    }

    [[nodiscard]] std::size_t count() const { return halved_.size(); }

    void split() {
        first_ = static_cast<int>(mesh_.positions.size());
        for (const std::uint64_t edge : halved_) {
            const auto low = static_cast<std::uint32_t>(edge >> 32U), high = static_cast<std::uint32_t>(edge);
            mesh_.positions.push_back(middle_of(mesh_.positions[low], mesh_.positions[high]));
            mesh_.ends.emplace_back(static_cast<int>(low), static_cast<int>(high));
        }
        const std::vector<glm::ivec3> before = std::exchange(mesh_.triangles, {});
        mesh_.triangles.reserve(before.size() + 2 * halved_.size());
        for (const glm::ivec3& corners : before) split(corners);
    }

  private:
    [[nodiscard]] const glm::vec3& position(int vertex) const {
        return mesh_.positions[static_cast<std::size_t>(vertex)];
    }
    [[nodiscard]] double length(int a, int b) const {
        // The length of an edge does not depend on which of its ends is named first.
        const auto [low, high] = std::minmax(a, b);
        return length_of(glm::dvec3(position(high)) - glm::dvec3(position(low)));
    }
    /// Of an edge whose middle is one of its ends, since no position lies between them, a half is as long.
    [[nodiscard]] bool is_long(int a, int b) const {
        if (!(length(a, b) > longest_)) return false;
        const glm::vec3 middle = middle_of(position(a), position(b));
        return middle != position(a) && middle != position(b);
    }

    /// Vertex in the middle of an edge; `none` if it is not halved.
    [[nodiscard]] int middle(int a, int b) const {
        const auto at = std::ranges::lower_bound(halved_, key_of(a, b));
        if (at == halved_.end() || *at != key_of(a, b)) return none;
        return first_ + static_cast<int>(at - halved_.begin());
    }

    void add(int a, int b, int c) { mesh_.triangles.emplace_back(a, b, c); }

    void split(const glm::ivec3& corners) {
        std::array<int, 3> middles{};
        std::size_t count = 0;
        for (int side = 0; side < 3; ++side) {
            const int found = middle(corners[side], corners[(side + 1) % 3]);
            middles.at(static_cast<std::size_t>(side)) = found;
            if (found != none) ++count;
        }
        // Begin at a whole side that follows a halved one, if there is such a side.
        std::size_t start = 0;
        while (count > 0 && count < 3 && (middles.at(start) == none || middles.at((start + 2) % 3) != none))
            ++start;
        const auto corner = [&](std::size_t i) { return corners[static_cast<int>((start + i) % 3)]; };
        const int a = corner(0), b = corner(1), c = corner(2);
        const int ab = middles.at(start), bc = middles.at((start + 1) % 3), ca = middles.at((start + 2) % 3);
        if (count == 0) {
            add(a, b, c);
        } else if (count == 1) {
            add(a, ab, c);
            add(ab, b, c);
        } else if (count == 2) {
            add(ab, b, bc);
            if (length(a, bc) <= length(ab, c)) {
                add(a, ab, bc);
                add(a, bc, c);
            } else {
                add(a, ab, c);
                add(ab, bc, c);
            }
        } else {
            add(a, ab, ca);
            add(ab, b, bc);
            add(ca, bc, c);
            add(ab, bc, ca);
        }
    }

    Refined& mesh_;
    double longest_;
    int first_ = 0;                      ///< vertex in the middle of the first halved edge
    std::vector<std::uint64_t> halved_;  ///< edges, rising
};

}  // namespace

Refined refine(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
               double longest_edge, std::size_t most_vertices) {
    require(longest_edge > 0.0, "longest_edge: must be greater than 0");
    for (const glm::vec3& position : positions)
        require(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z),
                "positions: must be finite");
    for (const glm::ivec3& corners : triangles)
        for (int i = 0; i < 3; ++i)
            require(corners[i] >= 0 && static_cast<std::size_t>(corners[i]) < positions.size(),
                    "triangles: must hold indices of vertices");
    Refined mesh{{positions.begin(), positions.end()}, {triangles.begin(), triangles.end()}, {}};
    const auto check = [&](std::size_t more) {
        require(mesh.positions.size() + more <= most_vertices &&
                    mesh.triangles.size() + 2 * more <= 4 * most_vertices,
                "longest_edge: must be longer, or there would be too many vertices");
    };
    check(0);
    for (;;) {
        Round round(mesh, longest_edge);
        if (round.count() == 0) return mesh;
        check(round.count());
        round.split();
    }
}

}  // namespace motus::mesh
