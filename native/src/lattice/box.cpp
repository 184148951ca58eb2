// Boxes around points. Each axis in turn is kept while the other two are turned to the rectangle of the least
// area (which has a side along one of the convex hull: Freeman, Shapira 1975), until no axis gains; from
// several starts.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"
#include "motus/lattice/lattice.hpp"

namespace motus::lattice {
namespace {

using Plane = std::vector<glm::dvec2>;

constexpr double gain = 1.0 - 1e-9;  // less is rounding

[[nodiscard]] OrientedBox box_around(std::span<const glm::vec3> points, const glm::dmat3& axes) {
    OrientedBox box;
    box.axes = axes;
    if (points.empty()) return box;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinity), high(-infinity);
    for (const glm::vec3& point : points) {
        const glm::dvec3 at = glm::dvec3(point) * axes;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    box.center = axes * (0.5 * (low + high));
    box.size = high - low;
    return box;
}

void check(std::span<const glm::vec3> points, const glm::dmat3& axes) {
    require(std::ranges::all_of(points, [](const glm::vec3& point) { return is_finite(point); }),
            "points: must be finite");
    for (int column = 0; column < 3; ++column)
        require(std::abs(glm::dot(axes[column], axes[column]) - 1.0) < 1e-3, "axes: must be orthonormal");
}

[[nodiscard]] double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Drops what lies inside the octagon of the extreme points (Akl, Toussaint 1978): nearly all of a dense
/// mesh.
void drop_inside(Plane& points) {
    constexpr std::size_t sides = 8;
    std::array<glm::dvec2, sides> corner{};
    corner.fill(points.front());
    std::array<double, sides> reach{};
    reach.fill(-std::numeric_limits<double>::infinity());
    for (const glm::dvec2& p : points) {
        const std::array<double, sides> along{p.x,  p.x + p.y,  p.y,  p.y - p.x,
                                              -p.x, -p.x - p.y, -p.y, p.x - p.y};
        for (std::size_t i = 0; i < sides; ++i) {
            if (along[i] > reach[i]) {
                reach[i] = along[i];
                corner[i] = p;
            }
        }
    }
    const auto is_inside = [&](const glm::dvec2& p) {
        for (std::size_t i = 0; i < sides; ++i) {
            const glm::dvec2 side = corner[(i + 1) % sides] - corner[i];
            if (side != glm::dvec2(0.0) && cross(side, p - corner[i]) <= 0.0) return false;
        }
        return true;
    };
    points.erase(std::remove_if(points.begin(), points.end(), is_inside), points.end());
}

/// Corners of the convex hull in order, counter-clockwise (Andrew's monotone chain).
[[nodiscard]] Plane hull(Plane points) {
    if (points.empty()) return points;
    drop_inside(points);
    std::sort(points.begin(), points.end(), [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Plane result;
    const auto add = [&](const glm::dvec2& p, std::size_t kept) {
        while (result.size() >= kept + 2 &&
               cross(result.back() - result[result.size() - 2], p - result[result.size() - 2]) <= 0.0)
            result.pop_back();
        result.push_back(p);
    };
    for (const glm::dvec2& p : points) add(p, 0);
    const std::size_t lower = result.size() - 1;
    for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
    result.pop_back();
    return result;
}

/// Direction of a side of the smallest rectangle around the points; (1, 0) is kept if nothing is smaller.
[[nodiscard]] glm::dvec2 rectangle_side(const Plane& corners) {
    const auto area_along = [&](const glm::dvec2& x) {
        const glm::dvec2 y(-x.y, x.x);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        glm::dvec2 low(infinity), high(-infinity);
        for (const glm::dvec2& corner : corners) {
            const glm::dvec2 at(glm::dot(corner, x), glm::dot(corner, y));
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        // The girth tells flat rectangles apart, whose area is rounding.
        return std::pair((high.x - low.x) * (high.y - low.y), (high.x - low.x) + (high.y - low.y));
    };
    glm::dvec2 best(1.0, 0.0);
    if (corners.size() < 2) return best;
    auto [area, girth] = area_along(best);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
        const double length = glm::length(side);
        if (!(length > 0.0)) continue;
        const auto [tried, around] = area_along(side / length);
        const double rounding = 1e-12 * girth * girth;
        if (tried < area * gain - rounding || (tried <= area + rounding && around < girth * gain)) {
            best = side / length;
            area = tried;
            girth = around;
        }
    }
    return best;
}

[[nodiscard]] glm::dmat3 turned_about(std::span<const glm::vec3> points, const glm::dmat3& axes, int axis) {
    const glm::dvec3 x = axes[(axis + 1) % 3], y = axes[(axis + 2) % 3];
    Plane plane;
    plane.reserve(points.size());
    for (const glm::vec3& point : points) {
        const glm::dvec3 p(point);
        plane.emplace_back(glm::dot(p, x), glm::dot(p, y));
    }
    const glm::dvec2 side = rectangle_side(hull(std::move(plane)));
    glm::dmat3 result = axes;
    result[(axis + 1) % 3] = glm::normalize(side.x * x + side.y * y);
    result[(axis + 2) % 3] = glm::cross(result[axis], result[(axis + 1) % 3]);
    return result;
}

/// Smaller is better: the volume, and if that is nothing, the larger faces.
[[nodiscard]] double measure(const OrientedBox& box) {
    const glm::dvec3 s = box.size;
    const double longest = std::max({s.x, s.y, s.z});
    return s.x * s.y * s.z + 1e-3 * longest * (s.x * s.y + s.y * s.z + s.z * s.x);
}

/// The points that lie farthest in some direction or other; all of them if they are few.
[[nodiscard]] std::vector<glm::vec3> extremes(std::span<const glm::vec3> points, const Executor& executor) {
    constexpr std::size_t few = 256, directions = 64;
    if (points.size() <= few) return {points.begin(), points.end()};
    std::vector<glm::vec3> result(2 * directions, points[0]);
    in_parts(
        directions, 1,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                // Evenly over the half sphere: both ends of each line are looked for.
                const double z = (static_cast<double>(i) + 0.5) / directions, r = std::sqrt(1.0 - z * z);
                const double angle = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
                const glm::vec3 direction(r * std::cos(angle), r * std::sin(angle), z);
                const auto along = [&](const glm::vec3& point) { return glm::dot(point, direction); };
                float low = along(points[0]), high = low;
                for (const glm::vec3& point : points) {
                    const float place = along(point);
                    if (place < low) {
                        low = place;
                        result[2 * i] = point;
                    }
                    if (place > high) {
                        high = place;
                        result[2 * i + 1] = point;
                    }
                }
            }
        },
        executor);
    return result;
}

/// Adds the points that reach farthest along the box's axes, each way.
void add_reaching(std::span<const glm::vec3> points, const glm::dmat3& axes, std::vector<glm::vec3>& chosen) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinity), high(-infinity);
    std::array<glm::vec3, 6> reaching{};
    reaching.fill(points[0]);
    for (const glm::vec3& point : points) {
        const glm::dvec3 at = glm::dvec3(point) * axes;
        for (int i = 0; i < 3; ++i) {
            if (at[i] < low[i]) {
                low[i] = at[i];
                reaching[static_cast<std::size_t>(i)] = point;
            }
            if (at[i] > high[i]) {
                high[i] = at[i];
                reaching[static_cast<std::size_t>(i) + 3] = point;
            }
        }
    }
    chosen.insert(chosen.end(), reaching.begin(), reaching.end());
}

/// Orientations from which a box is shrunk, each into a smallest one of its neighbourhood: the given axes
/// first.
[[nodiscard]] std::vector<glm::dmat3> starts() {
    constexpr int steps = 3;
    constexpr double step = std::numbers::pi / (2.0 * steps);
    const auto about = [](int axis, double angle) {
        glm::dmat3 turn(1.0);
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        turn[next][next] = turn[last][last] = std::cos(angle);
        turn[next][last] = std::sin(angle);
        turn[last][next] = -std::sin(angle);
        return turn;
    };
    std::vector<glm::dmat3> result;
    result.reserve(std::size_t{steps} * steps * steps);
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            for (int k = 0; k < steps; ++k)
                result.push_back(about(1, step * i) * about(0, step * j) * about(2, step * k));
        }
    }
    return result;
}

/// The box turned about its axes one by one until none gains.
[[nodiscard]] OrientedBox shrunk(std::span<const glm::vec3> points, OrientedBox box) {
    constexpr int rounds = 12;
    for (int round = 0; round < rounds; ++round) {
        const double before = measure(box);
        for (int axis = 0; axis < 3; ++axis) {
            const OrientedBox tried = box_around(points, turned_about(points, box.axes, axis));
            if (measure(tried) < measure(box)) box = tried;
        }
        if (!(measure(box) < before * gain)) break;
    }
    return box;
}

/// The axes in the order and with the signs that are nearest to the given ones.
[[nodiscard]] glm::dmat3 named_like(const glm::dmat3& axes, const glm::dmat3& model) {
    glm::dmat3 best(1.0);
    double most = -std::numeric_limits<double>::infinity();
    std::array<int, 3> order{0, 1, 2};
    do {
        double alike = 0.0;
        glm::dmat3 tried;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 axis = axes[order[static_cast<std::size_t>(i)]];
            const double along = glm::dot(axis, model[i]);
            tried[i] = along < 0.0 ? -axis : axis;
            alike += std::abs(along);
        }
        if (glm::dot(tried[0], glm::cross(tried[1], tried[2])) > 0.0 && alike > most) {
            most = alike;
            best = tried;
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

}  // namespace

OrientedBox box_along(std::span<const glm::vec3> points, const glm::dmat3& axes) {
    check(points, axes);
    return box_around(points, axes);
}

OrientedBox small_box(std::span<const glm::vec3> points, const glm::dmat3& axes, const Executor& executor) {
    check(points, axes);
    if (points.empty()) return box_around(points, axes);
    std::vector<glm::vec3> chosen = extremes(points, executor);
    OrientedBox small = shrunk(chosen, box_around(chosen, axes));
    for (const glm::dmat3& turn : starts()) {
        const OrientedBox found = shrunk(chosen, box_around(chosen, axes * turn));
        if (measure(found) < measure(small) * gain) small = found;
    }
    // Around all points the box is larger, by points that were not among those chosen: shrunk with them once
    // more, until there are none. Then what is smallest for the chosen is so for all.
    constexpr int rounds = 20;
    OrientedBox box = box_around(points, small.axes);
    for (int round = 0; round < rounds && measure(small) < measure(box) * gain; ++round) {
        add_reaching(points, small.axes, chosen);
        small = shrunk(chosen, box_around(chosen, small.axes));
        const OrientedBox tried = box_around(points, small.axes);
        if (measure(tried) < measure(box)) box = tried;
    }
    const OrientedBox plain = box_around(points, axes);
    if (measure(plain) * gain <= measure(box)) return plain;
    return box_around(points, named_like(box.axes, axes));
}

}  // namespace motus::lattice
