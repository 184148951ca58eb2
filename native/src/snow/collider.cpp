#include "motus/snow/collider.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>
#include <utility>

#include "motus/core/ieee_floats.hpp"
#include "motus/core/numeric.hpp"
#include "motus/mesh/picker.hpp"

namespace motus::snow {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::int32_t>::max();

/// A triangle beyond an edge, if there is one.
class Neighbour {
  public:
    Neighbour() = default;
    Neighbour(std::uint32_t triangle, bool is_turned) : both_(2 * triangle + (is_turned ? 1 : 0)) {}

    [[nodiscard]] std::uint32_t triangle() const { return both_ / 2; }
    /// Whether its normal points to the other side.
    [[nodiscard]] bool is_turned() const { return both_ % 2 != 0; }

  private:
    std::uint32_t both_ = 2 * none;
};
/// By triangle, the ones beyond its edges: from corner i to corner i + 1. None where an edge is of one
/// triangle or of more than two. Triangles with a vertex twice count as none.
using Beyond = std::vector<std::array<Neighbour, 3>>;

[[nodiscard]] Beyond beyond_edges(std::span<const glm::ivec3> triangles) {
    struct Edge {
        std::uint64_t ends = 0;
        std::uint32_t triangle = 0;
        std::uint8_t side = 0;
        bool is_falling = false;  ///< its first end has the larger number
    };
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const glm::ivec3& corners = triangles[i];
        if (corners.x == corners.y || corners.y == corners.z || corners.z == corners.x) continue;
        for (int side = 0; side < 3; ++side) {
            const auto a = static_cast<std::uint64_t>(triangles[i][side]);
            const auto b = static_cast<std::uint64_t>(triangles[i][(side + 1) % 3]);
            edges.push_back({std::min(a, b) << 32U | std::max(a, b), static_cast<std::uint32_t>(i),
                             static_cast<std::uint8_t>(side), a > b});
        }
    }
    std::ranges::sort(edges, {}, &Edge::ends);
    Beyond beyond(triangles.size());
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
        if (end - i == 2) {
            const Edge &one = edges[i], &other = edges[i + 1];
            const bool is_turned = one.is_falling == other.is_falling;
            beyond[one.triangle].at(one.side) = {other.triangle, is_turned};
            beyond[other.triangle].at(other.side) = {one.triangle, is_turned};
        }
        i = end;
    }
    return beyond;
}

/// From a point to the straight way between two.
[[nodiscard]] double distance_to(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& point) {
    const glm::dvec3 way = b - a;
    const double square = glm::dot(way, way);
    const double share = square > 0.0 ? std::clamp(glm::dot(point - a, way) / square, 0.0, 1.0) : 0.0;
    return length_of(point - (a + share * way));
}

[[nodiscard]] mesh::Picker picker_of(std::span<const glm::vec3> positions,
                                     std::span<const glm::ivec3> triangles, const Executor& executor) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    require(positions.size() < most, "collider_positions: must be fewer");
    require(triangles.size() < most, "collider_triangles: must be fewer");
    for (const glm::vec3& position : positions)
        require(is_finite(position), "collider_positions: must be finite");
    for (const glm::ivec3& triangle : triangles)
        for (int i = 0; i < 3; ++i)
            require(triangle[i] >= 0 && static_cast<std::size_t>(triangle[i]) < positions.size(),
                    "collider_triangles: must name vertices of collider_positions");
    return {positions, triangles, executor};
}

}  // namespace

struct Collider::Mesh {
    Mesh(std::span<const glm::vec3> given_positions, std::span<const glm::ivec3> given_triangles,
         const Executor& executor)
        : picker(picker_of(given_positions, given_triangles, executor)),
          positions(given_positions.begin(), given_positions.end()),
          triangles(given_triangles.begin(), given_triangles.end()) {
        for (const glm::ivec3& triangle : triangles) {
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 corner(positions[static_cast<std::size_t>(triangle[i])]);
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        }
        for (int axis = 0; axis < 3 && !triangles.empty(); ++axis)
            rounding = std::max(rounding, 0x1p-22 * std::max(-low[axis], high[axis]));
    }

    [[nodiscard]] std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const {
        const glm::ivec3& t = triangles[triangle];
        const auto corner = [&](int i) { return glm::dvec3(positions[static_cast<std::size_t>(t[i])]); };
        return {corner(0), corner(1), corner(2)};
    }

    /// Made when it is first asked for.
    [[nodiscard]] const Beyond& neighbours() const {
        std::call_once(once, [&] { beyond = beyond_edges(triangles); });
        return beyond;
    }

    [[nodiscard]] glm::dvec3 normal(std::uint32_t triangle) const {
        const auto [a, b, c] = corners(triangle);
        return unit_vector(glm::cross(b - a, c - a));
    }

    /// What lies beyond a triangle's edge where something crosses it at a point. Triangles without area,
    /// which have no slope, are passed: each by the edge that is nearest to the point.
    [[nodiscard]] Neighbour across(std::uint32_t triangle, std::size_t side, const glm::dvec3& point) const;

    mesh::Picker picker;
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    double rounding = 0.0;

  private:
    mutable std::once_flag once;
    mutable Beyond beyond;
};

Neighbour Collider::Mesh::across(std::uint32_t triangle, std::size_t side, const glm::dvec3& point) const {
    constexpr int most_passed = 16;
    const Beyond& all = neighbours();
    Neighbour next = all[triangle].at(side);
    std::uint32_t from = triangle;
    for (int passed = 0; next.triangle() != none && normal(next.triangle()) == glm::dvec3(0.0); ++passed) {
        if (passed == most_passed) return {};
        const std::uint32_t flat = next.triangle();
        const std::array<glm::dvec3, 3> places = corners(flat);
        double least = std::numeric_limits<double>::infinity();
        Neighbour nearest;
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const Neighbour other = all[flat].at(edge);
            if (other.triangle() == from) continue;
            const double distance = distance_to(places.at(edge), places.at((edge + 1) % 3), point);
            if (distance >= least) continue;
            least = distance;
            nearest = other;
        }
        next = {nearest.triangle(), nearest.is_turned() != next.is_turned()};
        if (nearest.triangle() == none) return {};
        from = flat;
    }
    return next;
}

Collider::Collider(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                   const Executor& executor)
    : mesh_(in_ieee_floats([&] { return std::make_unique<const Mesh>(positions, triangles, executor); })) {}
Collider::~Collider() = default;

std::span<const glm::vec3> Collider::positions() const noexcept {
    return mesh_->positions;
}
std::span<const glm::ivec3> Collider::triangles() const noexcept {
    return mesh_->triangles;
}

double Collider::rounding() const noexcept {
    return mesh_->rounding;
}

std::optional<Collider::Hit> Collider::first_hit(const glm::dvec3& start, const glm::dvec3& end) const {
    for (int axis = 0; axis < 3; ++axis)
        if (std::min(start[axis], end[axis]) > mesh_->high[axis] ||
            std::max(start[axis], end[axis]) < mesh_->low[axis])
            return {};
    const glm::dvec3 way = end - start;
    const double length = length_of(way);
    const auto hit = mesh_->picker.ray(start, way, length);
    if (!hit) return {};
    return Hit{hit->triangle, std::min(1.0, hit->distance / length), hit->point};
}

glm::dvec3 Collider::normal(std::uint32_t triangle) const {
    require(triangle < mesh_->triangles.size(), "triangle: must be one of the collider");
    return mesh_->normal(triangle);
}

std::optional<Collider::Place> Collider::below(const glm::dvec3& point, const glm::dvec3& direction) const {
    const auto hit = mesh_->picker.ray(point, direction);
    if (!hit) return {};
    return Place{hit->triangle, glm::dot(normal(hit->triangle), direction) > 0.0, hit->point};
}

Collider::Rest Collider::slide(const Place& first, const glm::dvec3& velocity, const glm::dvec3& pull,
                               double friction, std::vector<Slide>& out) const {
    require(first.triangle < mesh_->triangles.size() && is_finite(first.point),
            "first: must be on a triangle of the collider");
    require(is_finite(velocity), "velocity: must be finite");
    require(is_finite(pull), "pull: must be finite");
    require(friction >= 0.0 && std::isfinite(friction), "friction: must be at least 0 and finite");
    Place at = first;
    glm::dvec3 moving = velocity;
    double time = 0.0;
    std::uint32_t before = none;
    const auto rest = [&](const std::optional<glm::dvec3>& over = {}) {
        out.push_back({time, at.point, {}, 0.0, 0.0});
        return Rest{at, over};
    };
    const auto up_from = [&](std::uint32_t triangle, bool is_behind) {
        return is_behind ? -normal(triangle) : normal(triangle);
    };
    // What slides is so far off the surface to what stands in its way, m.
    constexpr double clear = 1e-3;
    // Less than this is no slope.
    constexpr double level = 1e-6;
    const double least = level * length_of(pull);
    for (std::size_t i = 0; i < most_slides; ++i) {
        const glm::dvec3 up = up_from(at.triangle, at.is_behind);
        const glm::dvec3 down = pull - up * glm::dot(up, pull);
        const double steepness = length_of(down), weight = std::max(0.0, -glm::dot(up, pull));
        // On the level it goes on as it came.
        const bool is_level = steepness <= least;
        const glm::dvec3 direction = unit_vector(is_level ? moving - up * glm::dot(up, moving) : down);
        const double speed = std::max(0.0, glm::dot(moving, direction));
        const double acceleration = (is_level ? 0.0 : steepness) - friction * weight;
        if (direction == glm::dvec3(0.0) || (speed == 0.0 && acceleration <= 0.0)) return rest();

        const std::array<glm::dvec3, 3> corners = mesh_->corners(at.triangle);
        double length = std::numeric_limits<double>::infinity();
        std::size_t side = 0;
        glm::dvec3 outwards(0.0);
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const glm::dvec3 along = corners.at((edge + 1) % 3) - corners.at(edge);
            const glm::dvec3 away = unit_vector(glm::cross(along, normal(at.triangle)));
            const double rate = glm::dot(away, direction);
            if (!(rate > 0.0)) continue;
            const double to_edge = std::max(0.0, glm::dot(away, corners.at(edge) - at.point)) / rate;
            if (to_edge >= length) continue;
            length = to_edge;
            side = edge;
            outwards = away;
        }
        if (length == std::numeric_limits<double>::infinity()) return rest();
        const Neighbour next = mesh_->across(at.triangle, side, at.point + length * direction);
        const bool is_back = next.triangle() == before && before != none;
        // What stands in its way, but for what begins at the edge.
        const glm::dvec3 start = at.point + clear * up;
        std::optional<Hit> hit = first_hit(start, start + length * direction);
        if (hit && (hit->triangle == next.triangle() || hit->triangle == at.triangle)) hit.reset();
        if (hit) length *= hit->part;
        const double square = speed * speed + 2.0 * acceleration * length;
        if (square > 0.0 && is_back && !hit) return rest();
        out.push_back({time, at.point, direction, speed, acceleration});
        if (!(square > 0.0)) {
            time -= speed / acceleration;
            at.point = out.back().position(time);
            return rest();
        }
        const double faster = std::sqrt(square);
        if (length > 0.0) time += 2.0 * length / (speed + faster);
        if (hit) {
            moving = faster * direction;
            before = none;
            at = {hit->triangle, glm::dot(normal(hit->triangle), direction) > 0.0, hit->point};
            continue;
        }
        at.point += length * direction;
        if (next.triangle() == none) return rest(outwards);
        const bool is_behind = at.is_behind != next.is_turned();
        if (glm::dot(up_from(next.triangle(), is_behind), pull) > least) return rest(outwards);
        moving = faster * direction;
        before = at.triangle;
        at.triangle = next.triangle();
        at.is_behind = is_behind;
    }
    return rest();
}

}  // namespace motus::snow
