// Time and error of distances along a surface, compared with Dijkstra's algorithm along edges.
#include <chrono>
#include <cstdio>
#include <functional>
#include <queue>
#include <vector>

#include "mesh/sample_surfaces.hpp"
#include "motus/mesh/neighbours.hpp"
#include "motus/mesh/surface_distance.hpp"
#include "stopwatch.hpp"
#include "table.hpp"

using namespace motus;
using namespace motus::mesh;
using namespace motus::mesh::checks;

namespace {

/// The plain way: the shortest path along edges, in an array as large as the mesh.
[[nodiscard]] Reach dijkstra(const std::vector<glm::vec3>& positions, const Neighbours& neighbours,
                             std::uint32_t root, float radius) {
    std::vector<float> distances(positions.size(), std::numeric_limits<float>::infinity());
    using Due = std::pair<float, std::uint32_t>;
    std::priority_queue<Due, std::vector<Due>, std::greater<>> open;
    distances[root] = 0.0f;
    open.emplace(0.0f, root);
    Reach reach;
    while (!open.empty()) {
        const auto [distance, vertex] = open.top();
        open.pop();
        if (distance > distances[vertex]) continue;
        reach.vertices.push_back(vertex);
        reach.distances.push_back(distance);
        for (const std::uint32_t end : neighbours.edge_ends(vertex)) {
            const float there = distance + glm::distance(positions[vertex], positions[end]);
            if (there > radius || there >= distances[end]) continue;
            distances[end] = there;
            open.emplace(there, end);
        }
    }
    return reach;
}

using Exact = std::function<double(std::uint32_t vertex)>;

[[nodiscard]] double worst_error(const Reach& reach, const Exact& exact) {
    double worst = 0.0;
    for (std::size_t i = 0; i < reach.vertices.size(); ++i) {
        const double wanted = exact(reach.vertices[i]);
        if (wanted > 0.0) worst = std::max(worst, std::abs(reach.distances[i] / wanted - 1.0));
    }
    return worst;
}

template <class Work>
void row(const bench::Table& table, const char* name, const Exact& exact, const Work& work) {
    Reach reach;
    const double time = bench::nanoseconds([&] { reach = work(); });
    const double count = static_cast<double>(reach.vertices.size());
    table.row(name, {count, 1e-6 * time, time / count,
                     exact ? bench::Cell(100.0 * worst_error(reach, exact)) : std::nullopt});
}

void run(const char* name, const Surface& surface, std::uint32_t root, float radius, const Exact& exact) {
    const auto neighbours = Neighbours::of_triangles(surface.positions.size(), surface.triangles);
    char title[100];
    std::snprintf(title, sizeof title, "Distances along a %s of %zu vertices, radius %g", name,
                  surface.positions.size(), static_cast<double>(radius));
    const bench::Table table(
        title, {{"reached", "", 0}, {"all", "ms"}, {"a vertex", "ns", 0}, {"worst error", "%", 3}}, 26);
    row(table, "along the surface", exact,
        [&] { return surface_reach(surface.positions, neighbours, root, radius); });
    row(table, "Dijkstra along edges", exact,
        [&] { return dijkstra(surface.positions, neighbours, root, radius); });
    row(table, "a tenth of the radius", exact,
        [&] { return surface_reach(surface.positions, neighbours, root, 0.1f * radius); });
    row(table, "edges counted", {}, [&] { return edge_reach(neighbours, root, 178); });
}

/// Wall time: several threads share this work.
void build(const bench::Table& table, const char* name, const Surface& surface) {
    double best = 1e9;
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const auto neighbours = Neighbours::of_triangles(surface.positions.size(), surface.triangles);
        bench::keep(neighbours);
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        best = std::min(best, time.count());
    }
    table.row(name, {static_cast<double>(surface.positions.size()), best});
}

}  // namespace

int main() {
    constexpr int n = 1000;
    const std::uint32_t middle = n / 2 * (n + 1) + n / 2;
    const auto on_sheet = [](const Surface& flat, std::uint32_t root) {
        return [&flat, root](std::uint32_t vertex) {
            return glm::distance(glm::dvec3(flat.positions[root]), glm::dvec3(flat.positions[vertex]));
        };
    };
    const Surface regular = sheet(n, n, 1.0f, 1.0f);
    const Surface bent = folded(regular, 0.05f, 2.5f);
    run("sheet with sharp folds", bent, middle, 0.1784f, on_sheet(regular, middle));
    const Surface random = sheet(n, n, 1.0f, 1.0f, Cut::random);
    run("sheet of random triangles", random, middle, 0.1784f, on_sheet(random, middle));
    std::vector<std::uint32_t> place;
    const Surface mixed = shuffled(regular, place, 5);
    run("sheet, vertices in random order", mixed, place[middle], 0.1784f, on_sheet(mixed, place[middle]));
    const Surface sphere = icosphere(8);
    const std::uint32_t root = 1234;
    run("icosphere", sphere, root, 0.8f, [&](std::uint32_t vertex) {
        const double chord =
            glm::distance(glm::dvec3(sphere.positions[root]), glm::dvec3(sphere.positions[vertex]));
        return 2.0 * std::asin(std::min(1.0, 0.5 * chord));
    });
    const bench::Table table("Neighbours of all vertices, all threads",
                             {{"vertices", "", 0}, {"built", "ms", 1}}, 26);
    build(table, "a sheet", regular);
    build(table, "a sheet in random order", mixed);
}
