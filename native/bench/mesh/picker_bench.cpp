// The picking tree on a landscape of a million vertices, beside the plain ways: a tree halved at medians, and
// looking at everything.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "motus/mesh/picker.hpp"
#include "random.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::mesh;

namespace {

constexpr int side = 1000;
constexpr float infinity = std::numeric_limits<float>::infinity();

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
};

float height(float x, float y) {
    return 0.05f * std::sin(20.0f * x) * std::cos(17.0f * y);
}

/// A square of side 1 around the origin.
Mesh landscape() {
    Mesh mesh;
    constexpr float step = 1.0f / (side - 1);
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const float x = static_cast<float>(i) * step - 0.5f, y = static_cast<float>(j) * step - 0.5f;
            mesh.positions.emplace_back(x, y, height(x, y));
        }
    }
    for (int j = 0; j + 1 < side; ++j) {
        for (int i = 0; i + 1 < side; ++i) {
            const int a = j * side + i;
            mesh.triangles.emplace_back(a, a + 1, a + side);
            mesh.triangles.emplace_back(a + 1, a + side + 1, a + side);
        }
    }
    return mesh;
}

/// The mesh with its vertices and triangles in random order.
Mesh shuffled(const Mesh& mesh) {
    test::Random random(3);
    std::vector<std::size_t> places(mesh.positions.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    random.shuffle(std::span(places));
    Mesh result = mesh;
    for (std::size_t i = 0; i < places.size(); ++i) result.positions[places[i]] = mesh.positions[i];
    for (glm::ivec3& t : result.triangles)
        for (int corner = 0; corner < 3; ++corner)
            t[corner] = static_cast<int>(places[static_cast<std::size_t>(t[corner])]);
    random.shuffle(std::span(result.triangles));
    return result;
}

/// Rolled up two and a half times, and bulged.
std::vector<glm::vec3> rolled(const std::vector<glm::vec3>& positions) {
    std::vector<glm::vec3> result;
    for (const glm::vec3& p : positions) {
        const float turn = 15.0f * (p.x + 0.6f), radius = 0.1f + 0.3f * (p.x + 0.6f) + p.z;
        result.emplace_back(radius * std::cos(turn), p.y * (1.0f + 0.5f * std::sin(9.0f * p.x)),
                            radius * std::sin(turn));
    }
    return result;
}

float plain_hit(const Mesh& mesh, int triangle, const glm::vec3& origin, const glm::vec3& direction) {
    const glm::ivec3& t = mesh.triangles[static_cast<std::size_t>(triangle)];
    const glm::vec3& a = mesh.positions[static_cast<std::size_t>(t.x)];
    const glm::vec3 e1 = mesh.positions[static_cast<std::size_t>(t.y)] - a;
    const glm::vec3 e2 = mesh.positions[static_cast<std::size_t>(t.z)] - a;
    const glm::vec3 p = glm::cross(direction, e2), s = origin - a, q = glm::cross(s, e1);
    const float inverse = 1.0f / glm::dot(e1, p);
    const float u = glm::dot(s, p) * inverse, v = glm::dot(direction, q) * inverse;
    const float distance = glm::dot(e2, q) * inverse;
    return u >= 0.0f && v >= 0.0f && u + v <= 1.0f && distance >= 0.0f ? distance : infinity;
}

/// The plain tree: triangles halved at the median of their centres along the longest side, down to four.
class PlainTree {
  public:
    explicit PlainTree(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        nodes_.reserve(order_.size());
        build(0, order_.size());
    }

    [[nodiscard]] float hit(const glm::vec3& origin, const glm::vec3& direction) const {
        float best = infinity;
        descend(0, origin, direction, 1.0f / direction, best);
        return best;
    }

  private:
    struct Node {
        glm::vec3 low{infinity}, high{-infinity};
        std::size_t first = 0, last = 0, second_child = 0;  ///< no child: a leaf
    };

    [[nodiscard]] const glm::vec3& corner(int triangle, int of) const {
        return mesh_
            .positions[static_cast<std::size_t>(mesh_.triangles[static_cast<std::size_t>(triangle)][of])];
    }

    std::size_t build(std::size_t first, std::size_t last) {
        const std::size_t index = nodes_.size();
        nodes_.emplace_back();
        Node node{};
        node.first = first;
        node.last = last;
        for (std::size_t i = first; i < last; ++i) {
            for (int of = 0; of < 3; ++of) {
                node.low = glm::min(node.low, corner(order_[i], of));
                node.high = glm::max(node.high, corner(order_[i], of));
            }
        }
        if (last - first > 4) {
            const glm::vec3 size = node.high - node.low;
            const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
            const auto centre = [&](int t) {
                return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis];
            };
            const std::size_t middle = first + (last - first) / 2;
            const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
            std::nth_element(at(first), at(middle), at(last),
                             [&](int a, int b) { return centre(a) < centre(b); });
            build(first, middle);
            node.second_child = build(middle, last);
        }
        nodes_[index] = node;
        return index;
    }

    void descend(std::size_t index, const glm::vec3& origin, const glm::vec3& direction,
                 const glm::vec3& inverse, float& best) const {
        const Node& node = nodes_[index];
        const glm::vec3 a = (node.low - origin) * inverse, b = (node.high - origin) * inverse;
        const glm::vec3 in = glm::min(a, b), out = glm::max(a, b);
        if (std::max({in.x, in.y, in.z, 0.0f}) > std::min({out.x, out.y, out.z, best})) return;
        if (node.second_child == 0) {
            for (std::size_t i = node.first; i < node.last; ++i)
                best = std::min(best, plain_hit(mesh_, order_[i], origin, direction));
            return;
        }
        descend(index + 1, origin, direction, inverse, best);
        descend(node.second_child, origin, direction, inverse, best);
    }

    const Mesh& mesh_;
    std::vector<int> order_;
    std::vector<Node> nodes_;
};

/// Microseconds of one call by the clock, the fastest of `runs`: for work on several threads.
template <class Work>
double clocked(Work&& work, int runs = 5) {
    using Clock = std::chrono::steady_clock;
    double best = std::numeric_limits<double>::infinity();
    for (int run = 0; run < runs; ++run) {
        const auto start = Clock::now();
        work();
        best = std::min(best, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    return best;
}

/// Microseconds of processor time a call of work(place), on the average of the places.
template <class Places, class Work>
double each(const Places& places, Work&& work, int runs = 5) {
    const auto all = [&] {
        for (const auto& place : places) bench::keep(work(place));
    };
    return bench::nanoseconds(all, runs) / 1e3 / static_cast<double>(places.size());
}

void row(const bench::Table& table, const char* name, double taken, double plain = 0.0) {
    if (plain > 0.0)
        table.row(name, {taken, plain, plain / taken});
    else
        table.row(name, {taken});
}

/// Pulls what was found, as a brush would: the plain loop that a search saves from looking at all.
template <class Indices>
void dab(std::vector<glm::vec3>& positions, const Indices& vertices, const glm::vec3& root, float radius) {
    for (const auto vertex : vertices) {
        glm::vec3& p = positions[vertex];
        const float t = 1.0f - std::min(1.0f, glm::distance(p, root) / radius);
        p.z += 1e-6f * t * t * (3.0f - 2.0f * t);
    }
}

void compare_queries(const bench::Table& table, const Mesh& mesh, const Picker& picker,
                     const PlainTree& plain) {
    test::Random random(1);
    std::vector<glm::vec3> places(500);
    for (glm::vec3& p : places) {
        p.x = random.between(-0.45f, 0.45f);
        p.y = random.between(-0.45f, 0.45f);
        p.z = height(p.x, p.y);
    }
    const std::vector<glm::vec3> few(places.begin(), places.begin() + 5);
    const glm::vec3 away = glm::normalize(glm::vec3(1.0f, -2.0f, 1.5f));
    const auto pick = [&](const glm::vec3& p) { return picker.ray(p + 3.0f * away, -away); };
    row(table, "pick, beside the plain tree", each(places, pick),
        each(places, [&](const glm::vec3& p) { return plain.hit(p + 3.0f * away, -away); }));
    const auto pick_plainly = [&](const glm::vec3& p) {
        float best = infinity;
        for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
            best = std::min(best, plain_hit(mesh, t, p + 3.0f * away, -away));
        return best;
    };
    row(table, "pick, beside all triangles", each(places, pick), each(few, pick_plainly, 2));
    row(table, "pick, grazing",
        each(places,
             [&](const glm::vec3& p) {
                 return picker.ray({-3.0, p.y, 0.04}, {1.0, 0.02, 0.0});
             }),
        each(places, [&](const glm::vec3& p) {
            return plain.hit({-3.0f, p.y, 0.04f}, {1.0f, 0.02f, 1e-9f});
        }));

    const auto pick_vertex = [&](const glm::vec3& p) {
        const auto hit = picker.ray(p + 3.0f * away, -away);
        return hit ? picker.nearest_seen(*hit, -away) : 0u;
    };
    row(table, "pick with the nearest vertex seen", each(places, pick_vertex));
    const auto pick_stale = [&](const glm::vec3& p) {
        const auto hit = picker.ray(p + 3.0f * away, -away, mesh.positions, 0.001f);
        return hit ? picker.nearest_seen(*hit, -away, mesh.positions, 0.001f) : 0u;
    };
    row(table, "the same, the tree wrong by 0.1 % of the side", each(places, pick_stale));

    const auto nearest_plainly = [&](const glm::vec3& p) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < mesh.positions.size(); ++i) {
            const glm::vec3 d = mesh.positions[i] - p, e = mesh.positions[best] - p;
            if (glm::dot(d, d) < glm::dot(e, e)) best = i;
        }
        return best;
    };
    row(table, "nearest vertex to a point of the surface",
        each(places, [&](const glm::vec3& p) { return picker.nearest(p); }), each(few, nearest_plainly, 2));
    const glm::vec3 above(0.0f, 0.0f, 0.04f);
    row(table, "nearest vertex to a point 40 vertices above it",
        each(places, [&](const glm::vec3& p) { return picker.nearest(p + above); }),
        each(few, nearest_plainly, 2));

    constexpr float radius = 0.05f;
    const auto within_plainly = [&](const glm::vec3& p) {
        std::vector<std::uint32_t> found;
        for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 d = mesh.positions[i] - p;
            if (glm::dot(d, d) <= radius * radius) found.push_back(i);
        }
        return found;
    };
    row(table, "vertices within 5 % of the side",
        each(places, [&](const glm::vec3& p) { return picker.within(p, radius); }),
        each(few, within_plainly, 2));
    const glm::mat3 metric(1.0f, 0.1f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.2f);
    row(table, "the same by a metric",
        each(places, [&](const glm::vec3& p) { return picker.within(p, radius, metric); }));

    std::vector<glm::vec3> positions = mesh.positions;
    std::vector<std::uint32_t> all(positions.size());
    std::iota(all.begin(), all.end(), 0u);
    const auto dab_by_tree = [&](const glm::vec3& p) {
        dab(positions, picker.within(p, radius), p, radius);
        return positions[0];
    };
    const auto dab_on_all = [&](const glm::vec3& p) {
        dab(positions, all, p, radius);
        return positions[0];
    };
    row(table, "a dab of that radius, the search in it", each(places, dab_by_tree), each(few, dab_on_all, 2));
}

void compare(const char* name, const Mesh& mesh) {
    char title[100];
    std::snprintf(title, sizeof title, "The picking tree, %d vertices %s; one thread but where it says two",
                  side * side, name);
    const bench::Table table(title, {{"Motus", "us"}, {"plain", "us"}, {"faster by", "x", 1}}, 52);
    const PlainTree plain(mesh);
    const double plain_build = clocked([&] { bench::keep(PlainTree(mesh)); }, 1);
    Picker picker(mesh.positions, mesh.triangles, 2);
    const double build = clocked([&] { bench::keep(Picker(mesh.positions, mesh.triangles, 2)); });
    row(table, "build, two threads; plain: one", build, plain_build);
    row(table, "build, one thread",
        bench::nanoseconds([&] { bench::keep(Picker(mesh.positions, mesh.triangles, 1)); }, 3) / 1e3,
        plain_build);
    row(table, "refit, two threads; beside a build", clocked([&] { picker.refit(mesh.positions); }), build);
    Picker alone(mesh.positions, mesh.triangles, 1);
    row(table, "refit, one thread", bench::nanoseconds([&] { alone.refit(mesh.positions); }) / 1e3, build);
    const std::vector<std::uint32_t> moved = picker.within({0.1f, 0.1f, height(0.1f, 0.1f)}, 0.05f);
    row(table, "refit of what a dab of 5 % moved",
        bench::nanoseconds([&] { picker.refit(mesh.positions, moved); }) / 1e3, build);
    compare_queries(table, mesh, picker, plain);

    const std::vector<glm::vec3> bent = rolled(mesh.positions);
    const Picker anew(bent, mesh.triangles);
    picker.refit(bent);
    std::vector<glm::dvec3> places;
    for (std::size_t i = 7; i < bent.size(); i += 1999) places.emplace_back(bent[i]);
    const glm::dvec3 away(2.0, -1.5, 1.0);
    row(table, "pick after rolling it up, refitted; beside a new tree",
        each(places, [&](const glm::dvec3& p) { return picker.ray(p + away, -away); }),
        each(places, [&](const glm::dvec3& p) { return anew.ray(p + away, -away); }));
    row(table, "vertices within 5 %, the same",
        each(places, [&](const glm::dvec3& p) { return picker.within(p, 0.05f); }),
        each(places, [&](const glm::dvec3& p) { return anew.within(p, 0.05f); }));
}

}  // namespace

int main() {
    const Mesh mesh = landscape();
    compare("row by row", mesh);
    compare("and their triangles in no order", shuffled(mesh));
    return 0;
}
