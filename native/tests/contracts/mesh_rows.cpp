#include "contracts/meshes.hpp"
#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/mesh/picker.hpp"
#include "motus/mesh/refine.hpp"
#include "motus/mesh/surface_distance.hpp"
#include "motus/mesh/weld.hpp"

namespace motus::contracts {

template <Some<mesh::Hit> T>
auto fields(Declared, T& v) {
    return std::tie(v.triangle, v.point, v.distance, v.corners);
}
template <Some<mesh::Reach> T>
auto fields(Declared, T& v) {
    return std::tie(v.vertices, v.distances);
}
template <Some<mesh::Refined> T>
auto fields(Declared, T& v) {
    return std::tie(v.positions, v.triangles, v.ends);
}

namespace {

using mesh::Neighbours;
using mesh::Picker;

[[nodiscard]] const Picker& sample_picker() {
    static const Picker made(sample_positions(), sample_triangles(), 1);
    return made;
}
[[nodiscard]] const Neighbours& sample_neighbours() {
    static const auto made = Neighbours::of_triangles(5, sample_triangles(), 1);
    return made;
}
[[nodiscard]] mesh::Hit sample_hit() {
    return *sample_picker().ray({0.3, 0.3, 5.0}, {0.0, 0.0, -1.0});
}
[[nodiscard]] Domain finds() {
    return any_at_rest("any; where it is not finite nothing is found");
}
/// Fewer are refused in the name of the triangles.
[[nodiscard]] Domain count_above(double last) {
    return {"above all indices", [last](const Domain::Seen& seen) {
                return seen.number() > 1e6    ? Verdict::untested
                       : seen.number() > last ? Verdict::taken
                                              : Verdict::open;
            }};
}
[[nodiscard]] auto triangles() {
    return arg("triangles", sample_triangles(), index(5, "a vertex"));
}
[[nodiscard]] auto metric() {
    return arg("metric", glm::mat3(1.0F), any_at_rest("any"));
}

void add_pickers(Table& table) {
    add(
        table, "mesh::Picker::Picker(positions, triangles, executor)",
        [](const auto& positions, const auto& given) {
            const Picker picker(positions, given, 1);
            return std::pair(picker.triangle_count(), picker.ray({0.3, 0.3, 5.0}, {0.0, 0.0, -1.0}));
        },
        arg("positions", sample_positions(), any_at_rest("any; what is not finite is never found")),
        triangles())
        .costs("O(n log n)")
        .allocates(Memory::scratch);
    add(
        table, "mesh::Picker::ray(origin, direction, farthest)",
        [](const auto& origin, const auto& direction, double farthest) {
            return sample_picker().ray(origin, direction, farthest);
        },
        arg("origin", glm::dvec3(0.3, 0.3, 5.0), finds()),
        arg("direction", glm::dvec3(0.0, 0.1, -1.0), finds()), arg("farthest", 9.0, finds()))
        .costs("O(log n)")
        .allocates(Memory::scratch);
    add(
        table, "mesh::Picker::ray(origin, direction, positions, slack)",
        [](const auto& origin, const auto& direction, const auto& positions, float slack) {
            return sample_picker().ray(origin, direction, positions, slack);
        },
        arg("origin", glm::dvec3(0.3, 0.3, 5.0), finds()),
        arg("direction", glm::dvec3(0.0, 0.1, -1.0), finds()),
        arg("positions", sample_positions(), finds(), as_many_as("the vertices")),
        arg("slack", 0.1F, at_least(0.0)))
        .costs("O(log n)")
        .allocates(Memory::scratch);
    const auto hidden = arg("hidden", std::vector<std::uint8_t>(5, 0), any_at_rest("0, or not"),
                            as_many_or_none("the vertices"));
    add(
        table, "mesh::Picker::nearest_seen(hit, direction, hidden, metric)",
        [](const auto& direction, const auto& given, const auto& by) {
            return sample_picker().nearest_seen(sample_hit(), direction, given, by);
        },
        arg("direction", glm::dvec3(0.0, 0.0, -1.0), any_at_rest("any")), hidden, metric())
        .costs("O(1), 256 triangles at most")
        .allocates(Memory::scratch);
    add(
        table, "mesh::Picker::nearest_seen(hit, direction, positions, slack, hidden, metric)",
        [](const auto& direction, const auto& positions, float slack, const auto& given, const auto& by) {
            return sample_picker().nearest_seen(sample_hit(), direction, positions, slack, given, by);
        },
        arg("direction", glm::dvec3(0.0, 0.0, -1.0), any_at_rest("any")),
        arg("positions", sample_positions(), finds(), as_many_as("the vertices")),
        arg("slack", 0.1F, at_least(0.0)), hidden, metric())
        .costs("O(1), 256 triangles at most")
        .allocates(Memory::scratch);
    // Of a hit that a caller makes up.
    add(
        table, "mesh::Picker::nearest_seen(hit, direction, hidden, metric)",
        [](const mesh::Hit& hit) {
            return sample_picker().nearest_seen(hit, {0.0, 0.0, -1.0});
        },
        of(sample_hit(), member("hit", &mesh::Hit::triangle, index(3, "a triangle")),
           member("hit", &mesh::Hit::corners, index(5, "a vertex")),
           member("hit", &mesh::Hit::point, any_at_rest("any"))))
        .costs("O(1), 256 triangles at most")
        .allocates(Memory::scratch);
    add(
        table, "mesh::Picker::nearest(point)",
        [](const auto& point) { return sample_picker().nearest(point); },
        arg("point", glm::vec3(0.3F), finds()))
        .costs("O(log n)")
        .allocates(Memory::scratch);
    add(
        table, "mesh::Picker::nearest_on_surface(point, farthest)",
        [](const auto& point, double farthest) {
            return sample_picker().nearest_on_surface(point, farthest);
        },
        arg("point", glm::dvec3(0.3), finds()), arg("farthest", 9.0, finds()))
        .costs("O(log n)");
    add(
        table, "mesh::Picker::within(point, radius, metric)",
        [](const auto& point, float radius, const auto& by) {
            return sample_picker().within(point, radius, by);
        },
        arg("point", glm::vec3(0.3F), finds()), arg("radius", 1.0F, finds()), metric())
        .costs("O(log n + found)")
        .allocates(Memory::scratch);
    const auto positions = arg("positions", sample_positions(), finds(), as_many_as("the vertices"));
    add(
        table, "mesh::Picker::refit(positions)",
        [](const auto& given) {
            Picker picker(sample_positions(), sample_triangles(), 1);
            picker.refit(given);
            return picker.ray({0.3, 0.3, 5.0}, {0.0, 0.0, -1.0});
        },
        positions)
        .costs("O(n)")
        .allocates(Memory::scratch)
        .alone();
    add(
        table, "mesh::Picker::refit(positions, moved)",
        [](const auto& given, const auto& moved) {
            Picker picker(sample_positions(), sample_triangles(), 1);
            picker.refit(given, moved);
            return picker.ray({0.3, 0.3, 5.0}, {0.0, 0.0, -1.0});
        },
        positions, arg("moved", std::vector<std::uint32_t>{1, 3}, index(5, "a vertex")))
        .costs("O(moved log n)")
        .allocates(Memory::scratch)
        .alone();
    table.moved.push_back({"mesh::Picker", "of an empty mesh", [] {
                               Picker picker(sample_positions(), sample_triangles(), 1);
                               Picker taken = std::move(picker);
                               // NOLINTBEGIN(bugprone-use-after-move)
                               expect(picker.vertex_count() == 0 && picker.triangle_count() == 0, "is empty");
                               expect(!picker.ray({0.3, 0.3, 5.0}, {0.0, 0.0, -1.0}), "meets nothing");
                               expect(!picker.nearest({0.0F, 0.0F, 0.0F}), "has no vertex");
                               expect(picker.within({0.0F, 0.0F, 0.0F}, 9.0F).empty(), "has no vertices");
                               picker.refit({});
                               expect_refusal([&] { picker.refit(sample_positions()); });
                               // NOLINTEND(bugprone-use-after-move)
                               picker = std::move(taken);
                               expect(picker.vertex_count() == 5, "is assigned");
                           }});
}

void add_neighbours(Table& table) {
    const auto told = [](const Neighbours& made) {
        std::vector<std::size_t> all{made.vertex_count()};
        for (std::uint32_t i = 0; i < made.vertex_count(); ++i)
            all.push_back(made.fan(i).size() + made.edge_ends(i).size());
        return all;
    };
    const auto corners = arg("triangles", sample_triangles(), index(5, "a vertex"));
    add(
        table, "mesh::Neighbours::Neighbours(vertex_count, triangles, edges, executor)",
        [told](std::size_t vertices, const auto& given, const auto& edges) {
            return told(Neighbours(vertices, given, edges, 1));
        },
        arg("vertex_count", std::size_t{5}, count_above(4.0)), corners,
        arg("edges", sample_edges(), index(5, "a vertex")))
        .costs("O(n)")
        .allocates(Memory::scratch);
    add(
        table, "mesh::Neighbours::of_triangles(vertex_count, triangles, executor)",
        [told](const auto& given) { return told(Neighbours::of_triangles(5, given, 1)); }, corners)
        .costs("O(n)")
        .allocates(Memory::scratch);
    add(table, "mesh::Neighbours::fan(vertex)", [] { return sample_neighbours().fan(1).size(); })
        .costs("O(1)")
        .adds("`vertex` is not checked");
    add(table, "mesh::Neighbours::edge_ends(vertex)", [] { return sample_neighbours().edge_ends(1).size(); })
        .costs("O(1)")
        .adds("`vertex` is not checked");
    table.moved.push_back({"mesh::Neighbours", "of an empty mesh", [] {
                               auto from = Neighbours::of_triangles(5, sample_triangles(), 1);
                               const Neighbours taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.vertex_count() == 0 && taken.vertex_count() == 5, "is empty");
                               expect_refusal([&] { (void)edge_reach(from, 0, 1); });
                               from = taken;
                               expect(from.fan(1).size() == 3, "is assigned");
                           }});
}

void add_surfaces(Table& table) {
    const auto root = arg("root", 0U, index(5, "a vertex"));
    add(
        table, "mesh::surface_reach(positions, neighbours, root, radius, metric)",
        [](const auto& positions, std::uint32_t from, float radius, const auto& by) {
            return surface_reach(positions, sample_neighbours(), from, radius, by);
        },
        arg("positions", sample_positions(), any_at_rest("any; what is not finite is not reached"),
            as_many_as("the vertices")),
        root, arg("radius", 1.5F, numbers("≥ 0, or infinity", [](double x) { return x >= 0.0; })), metric())
        .costs("O(k log k) of the k reached")
        .allocates(Memory::scratch);
    add(
        table, "mesh::edge_reach(neighbours, root, steps)",
        [](std::uint32_t from, std::uint32_t steps) { return edge_reach(sample_neighbours(), from, steps); },
        root, arg("steps", 2U, any_at_rest("any")))
        .costs("O(k) of the k reached")
        .allocates(Memory::scratch);
    add(
        table, "mesh::refine(positions, triangles, longest_edge, most_vertices)",
        [](const auto& positions, const auto& given, double longest, std::size_t most) {
            return mesh::refine(positions, given, longest, most);
        },
        arg("positions", sample_positions(), finite().open()), triangles(),
        arg("longest_edge", 0.5,
            numbers("> 0, so that `most_vertices` are enough", [](double x) { return x > 0.0; }).open()),
        arg("most_vertices", std::size_t{1000},
            Domain{"enough for the result", [](const Domain::Seen&) { return Verdict::open; }}))
        .costs("O(n) of the result")
        .allocates(Memory::scratch);
    add(
        table, "mesh::weld(positions, distance, metric, executor)",
        [](const auto& positions, float distance, const auto& by) {
            return mesh::weld(positions, distance, by, 1);
        },
        arg("positions", sample_positions(), any_at_rest("any; what is not finite leads itself alone")),
        arg("distance", 0.5F, at_least(0.0)), metric())
        .costs("O(n log n)")
        .allocates(Memory::scratch);
}

}  // namespace

void add_mesh(Table& table) {
    add_pickers(table);
    add_neighbours(table);
    add_surfaces(table);
}

}  // namespace motus::contracts
