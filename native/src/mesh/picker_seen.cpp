// The vertex nearest to a hit, measured along the surface that was hit.
//
// A walk from triangle to triangle over the edges nearest to the hit: an edge farther away than the nearest
// vertex so far does not lead to a nearer one. The boxes of the tree tell which triangles lie beside an edge.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "motus/core/numeric.hpp"
#include "picker_tree.hpp"

namespace motus::mesh {
namespace {

/// Triangles after which the walk ends: long thin ones around a hit may be many, with all vertices far away.
constexpr std::size_t most_triangles = 256;

/// An edge with its ends in the order of the triangle from which the walk comes; the triangle behind it has
/// them in reverse order.
struct Side {
    double square = 0.0;  ///< of its distance to the hit
    std::uint32_t a = 0, b = 0;

    [[nodiscard]] bool operator>(const Side& other) const noexcept {
        return std::tie(square, a, b) > std::tie(other.square, other.a, other.b);
    }
};

/// Squared distance of the origin to the segment.
double square_to(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length = glm::dot(along, along);
    const double share = length > 0.0 ? std::clamp(-glm::dot(a, along) / length, 0.0, 1.0) : 0.0;
    const glm::dvec3 foot = a + share * along;
    return glm::dot(foot, foot);
}

/// points(vertex): where it is; the boxes of the tree may be wrong by `slack`.
template <class Tree, class Points>
class Walk {
  public:
    Walk(const Tree& tree, const Points& points, const Hit& hit, const glm::dvec3& direction,
         std::span<const std::uint8_t> hidden, const glm::dmat3& metric, double slack)
        : tree_(tree),
          points_(points),
          centre_(hit.point),
          direction_(metric * direction),
          hidden_(hidden),
          metric_(metric),
          slack_(slack) {}

    /// Walks from the triangle with these corners; returns the nearest vertex.
    [[nodiscard]] std::uint32_t run(std::uint32_t triangle, std::array<std::uint32_t, 3> corners) {
        for (const std::uint32_t corner : corners) consider(corner);
        if (facing(corners[0], corners[1], corners[2]) < 0.0) std::swap(corners[1], corners[2]);
        visited_.push_back(triangle);
        for (std::size_t i = 0; i < 3; ++i) add(corners[i], corners[(i + 1) % 3]);
        while (!sides_.empty() && sides_.front().square < best_ && visited_.size() < most_triangles) {
            std::ranges::pop_heap(sides_, std::greater<>());
            const Side side = sides_.back();
            sides_.pop_back();
            cross(side);
        }
        return found_ ? *found_ : nearest_of(corners);
    }

  private:
    [[nodiscard]] glm::dvec3 away(std::uint32_t vertex) const {
        return metric_ * (points_(vertex) - centre_);
    }

    /// Number whose sign tells whether the corners are clockwise or counter-clockwise as the ray sees the
    /// triangle.
    [[nodiscard]] double facing(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const glm::dvec3 at_a = away(a);
        return glm::dot(glm::cross(away(b) - at_a, away(c) - at_a), direction_);
    }

    [[nodiscard]] bool has_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const glm::dvec3 at_a = away(a);
        return glm::cross(away(b) - at_a, away(c) - at_a) != glm::dvec3(0.0);
    }

    [[nodiscard]] std::uint32_t nearest_of(const std::array<std::uint32_t, 3>& corners) const {
        return *std::ranges::min_element(corners, {}, [this](std::uint32_t corner) {
            const glm::dvec3 way = away(corner);
            return std::pair(glm::dot(way, way), corner);
        });
    }

    void consider(std::uint32_t vertex) {
        if (!hidden_.empty() && hidden_[vertex] != 0) return;
        const glm::dvec3 way = away(vertex);
        const double square = glm::dot(way, way);
        if (square < best_ || (square == best_ && found_ && vertex < *found_)) {
            best_ = square;
            found_ = vertex;
        }
    }

    void add(std::uint32_t a, std::uint32_t b) {
        const double square = square_to(away(a), away(b));
        if (!(square < best_)) return;
        sides_.push_back({square, a, b});
        std::ranges::push_heap(sides_, std::greater<>());
    }

    /// Walks on to the other triangles at an edge.
    void cross(const Side& side) {
        const glm::dvec3 a = points_(side.a), b = points_(side.b);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            // A box that has both ends in it. Rounded so that it is never missed.
            const auto of_axis = static_cast<std::size_t>(axis);
            highest_low_[of_axis] = std::nextafter(static_cast<float>(std::min(a[axis], b[axis]) + slack_),
                                                   std::numeric_limits<float>::infinity());
            lowest_high_[of_axis] = std::nextafter(static_cast<float>(std::max(a[axis], b[axis]) - slack_),
                                                   -std::numeric_limits<float>::infinity());
        }
        descend(tree_.around_triangles.top(), 0, side);
    }

    void descend(std::size_t level, std::size_t node, const Side& side) {
        const PickerNode& boxes = tree_.around_triangles.node(level, node);
        std::array<bool, fan_out> holds{};
        for (std::size_t lane = 0; lane < fan_out; ++lane) {
            holds[lane] = boxes.low[0][lane] <= highest_low_[0] && boxes.high[0][lane] >= lowest_high_[0] &&
                          boxes.low[1][lane] <= highest_low_[1] && boxes.high[1][lane] >= lowest_high_[1] &&
                          boxes.low[2][lane] <= highest_low_[2] && boxes.high[2][lane] >= lowest_high_[2];
        }
        for (std::size_t lane = 0; lane < fan_out; ++lane) {
            if (!holds[lane]) continue;
            if (level > 0)
                descend(level - 1, node * fan_out + lane, side);
            else
                try_leaf(node * fan_out + lane, side);
        }
    }

    void try_leaf(std::size_t leaf, const Side& side) {
        const std::uint32_t a = tree_.places[side.a], b = tree_.places[side.b];
        for (std::size_t slot = tree_.starts[leaf]; slot < tree_.starts[leaf + 1]; ++slot) {
            const auto& corners = tree_.corners[slot];
            std::size_t tip = 3, sides = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                if (corners[i] == a || corners[i] == b)
                    ++sides;
                else
                    tip = i;
            }
            if (sides == 2 && tip < 3) step(tree_.names[slot], side, tree_.order[corners[tip]]);
        }
    }

    /// Walks on to a triangle, and looks at its vertices and edges beyond the side that was crossed.
    void step(std::uint32_t triangle, const Side& side, std::uint32_t tip) {
        if (std::ranges::find(visited_, triangle) != visited_.end()) return;
        const double seen = facing(side.b, side.a, tip);
        if (!(seen > 0.0) && (std::isnan(seen) || has_area(side.b, side.a, tip))) return;
        visited_.push_back(triangle);
        consider(tip);
        add(side.a, tip);
        add(tip, side.b);
    }

    const Tree& tree_;
    const Points& points_;
    glm::dvec3 centre_, direction_;
    std::span<const std::uint8_t> hidden_;
    glm::dmat3 metric_;
    double slack_;
    double best_ = std::numeric_limits<double>::infinity();
    std::optional<std::uint32_t> found_;
    std::vector<Side> sides_;  ///< a heap, the nearest first
    std::vector<std::uint32_t> visited_;
    std::array<float, 3> highest_low_{}, lowest_high_{};
};

void check_hit(const Hit& hit, const Picker& picker) {
    require(
        hit.triangle < picker.triangle_count() &&
            std::ranges::all_of(hit.corners, [&](std::uint32_t one) { return one < picker.vertex_count(); }),
        "hit: must be one of this mesh");
}

void check_hidden(std::span<const std::uint8_t> hidden, std::size_t vertex_count) {
    if (!hidden.empty() && hidden.size() != vertex_count)
        throw std::invalid_argument("hidden: there must be one for each vertex of the mesh");
}

}  // namespace

std::uint32_t Picker::nearest_seen(const Hit& hit, const glm::dvec3& direction,
                                   std::span<const std::uint8_t> hidden, const glm::mat3& metric) const {
    check_hidden(hidden, vertex_count());
    check_hit(hit, *this);
    const auto points = [this](std::uint32_t vertex) {
        const PickerPoint& point = tree().points[tree().places[vertex]];
        return glm::dvec3(point[0], point[1], point[2]);
    };
    return Walk(tree(), points, hit, direction, hidden, glm::dmat3(metric), 0.0)
        .run(hit.triangle, hit.corners);
}

std::uint32_t Picker::nearest_seen(const Hit& hit, const glm::dvec3& direction,
                                   std::span<const glm::vec3> positions, float slack,
                                   std::span<const std::uint8_t> hidden, const glm::mat3& metric) const {
    check_hidden(hidden, vertex_count());
    if (positions.size() != vertex_count())
        throw std::invalid_argument("positions: there must be one for each vertex of the mesh");
    require(slack >= 0.0f && std::isfinite(slack), "slack: must be finite and >= 0");
    check_hit(hit, *this);
    const auto points = [&](std::uint32_t vertex) { return glm::dvec3(positions[vertex]); };
    return Walk(tree(), points, hit, direction, hidden, glm::dmat3(metric), static_cast<double>(slack))
        .run(hit.triangle, hit.corners);
}

}  // namespace motus::mesh
