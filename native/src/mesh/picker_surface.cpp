// The place of a mesh's surface that is nearest to a point.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "motus/core/numeric.hpp"
#include "picker_tree.hpp"

namespace motus::mesh {
namespace {

/// The place of a segment that is nearest to the origin.
[[nodiscard]] glm::dvec3 nearest_to_origin(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 way = b - a;
    const double square = glm::dot(way, way);
    return square > 0.0 ? a + way * std::clamp(-glm::dot(a, way) / square, 0.0, 1.0) : a;
}

/// The place of a triangle that is nearest to the origin: Ericson, "Real-Time Collision Detection" (2005),
/// 5.1.5. A triangle without area counts as its three edges.
[[nodiscard]] glm::dvec3 nearest_to_origin(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto on_edges = [&] {
        glm::dvec3 nearest = nearest_to_origin(a, b);
        for (const glm::dvec3& place : {nearest_to_origin(b, c), nearest_to_origin(c, a)})
            if (glm::dot(place, place) < glm::dot(nearest, nearest)) nearest = place;
        return nearest;
    };
    const glm::dvec3 ab = b - a, ac = c - a;
    const glm::dvec3 across = glm::cross(ab, ac);
    if (!(glm::dot(across, across) > 0.0)) return on_edges();
    const double d1 = -glm::dot(ab, a), d2 = -glm::dot(ac, a);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const double d3 = -glm::dot(ab, b), d4 = -glm::dot(ac, b);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double d5 = -glm::dot(ab, c), d6 = -glm::dot(ac, c);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double beside_c = d1 * d4 - d3 * d2;
    if (beside_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
    const double beside_b = d5 * d2 - d1 * d6;
    if (beside_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
    const double beside_a = d3 * d6 - d5 * d4;
    const double along = d4 - d3, back = d5 - d6;
    if (beside_a <= 0.0 && along >= 0.0 && back >= 0.0) return b + (c - b) * (along / (along + back));
    const double sum = beside_a + beside_b + beside_c;
    return sum > 0.0 ? a + ab * (beside_b / sum) + ac * (beside_c / sum) : on_edges();
}

/// The nearest place so far, and the search for nearer ones.
class Search {
  public:
    Search(const RayTree& tree, const glm::dvec3& point, double farthest)
        : tree_(tree),
          point_(point),
          best_(std::min(farthest * farthest, std::numeric_limits<double>::max())) {}

    void descend(std::size_t level, std::size_t node) {
        std::array<double, fan_out> squares{};
        std::size_t nearest = 0;
        for (std::size_t lane = 0; lane < fan_out; ++lane) {
            squares[lane] = square_to(tree_.boxes.node(level, node), lane);
            if (squares[lane] < squares[nearest]) nearest = lane;
        }
        // The nearest one first: after it, hardly any other is worth a visit.
        if (squares[nearest] <= best_) visit(level, node * fan_out + nearest);
        for (std::size_t lane = 0; lane < fan_out; ++lane)
            if (lane != nearest && squares[lane] <= best_) visit(level, node * fan_out + lane);
    }
    [[nodiscard]] const std::optional<Hit>& found() const { return found_; }

  private:
    /// Squared distance to the box of a lane; infinite if it is empty.
    [[nodiscard]] double square_to(const PickerNode& node, std::size_t lane) const {
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = point_[static_cast<glm::length_t>(axis)];
            const double low = node.low[axis][lane], high = node.high[axis][lane];
            if (!(low <= high)) return std::numeric_limits<double>::infinity();
            const double gap = at < low ? low - at : at > high ? at - high : 0.0;
            sum += gap * gap;
        }
        return sum;
    }

    void visit(std::size_t level, std::size_t child) {
        if (level > 0) return descend(level - 1, child);
        for (std::uint32_t slot = tree_.starts[child]; slot < tree_.starts[child + 1]; ++slot) consider(slot);
    }

    void consider(std::uint32_t slot) {
        const auto& corners = tree_.corners[slot];
        // Points that are not finite are NaN.
        if (std::ranges::any_of(corners,
                                [&](std::uint32_t place) { return std::isnan(tree_.points[place][0]); }))
            return;
        const auto corner = [&](std::size_t which) {
            const PickerPoint& p = tree_.points[corners[which]];
            return glm::dvec3(p[0], p[1], p[2]) - point_;
        };
        const glm::dvec3 place = nearest_to_origin(corner(0), corner(1), corner(2));
        const double square = glm::dot(place, place);
        const std::uint32_t triangle = tree_.names[slot];
        if (!(square < best_ || (square == best_ && (!found_ || triangle < found_->triangle)))) return;
        best_ = square;
        found_ = {triangle,
                  point_ + place,
                  std::sqrt(square),
                  {tree_.order[corners[0]], tree_.order[corners[1]], tree_.order[corners[2]]}};
    }

    const RayTree& tree_;
    glm::dvec3 point_;
    double best_;
    std::optional<Hit> found_;
};

}  // namespace

std::optional<Hit> Picker::nearest_on_surface(const glm::dvec3& point, double farthest) const {
    const RayTree tree_of = tree().for_rays();
    constexpr double most = 1e100;  // of which the squares are still numbers
    if (tree_of.boxes.empty() || !is_finite(point) || !(farthest >= 0.0) ||
        glm::dot(point, point) > most * most)
        return std::nullopt;
    Search search(tree_of, point, farthest);
    search.descend(tree_of.boxes.top(), 0);
    return search.found();
}

}  // namespace motus::mesh
