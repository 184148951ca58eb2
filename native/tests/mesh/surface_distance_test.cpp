#include "motus/mesh/surface_distance.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "random.hpp"
#include "sample_surfaces.hpp"

using namespace motus;
using namespace motus::mesh;
using namespace motus::mesh::checks;

namespace {

constexpr float everything = std::numeric_limits<float>::infinity();
using Exact = std::function<double(std::uint32_t root, std::uint32_t vertex)>;

[[nodiscard]] Neighbours neighbours_of(const Surface& surface) {
    return Neighbours::of_triangles(surface.positions.size(), surface.triangles);
}

[[nodiscard]] Reach reach_of(const Surface& surface, std::uint32_t root, float radius = everything) {
    return surface_reach(surface.positions, neighbours_of(surface), root, radius);
}

[[nodiscard]] std::vector<std::uint32_t> some_roots(const Surface& surface, int count, unsigned seed) {
    test::Random random(seed);
    std::vector<std::uint32_t> roots{0, static_cast<std::uint32_t>(surface.positions.size() - 1)};
    for (int i = 0; i < count; ++i)
        roots.push_back(static_cast<std::uint32_t>(random.below(surface.positions.size())));
    return roots;
}

struct Errors {
    double below = 0.0;  ///< largest shortfall, a fraction of the exact distance
    double above = 0.0;
};

/// Errors of all vertices but the root within `within` of the exact distance; all of them have to be reached.
[[nodiscard]] Errors errors(const Surface& surface, const std::vector<std::uint32_t>& roots,
                            const Exact& exact, double within = everything) {
    const Neighbours neighbours = neighbours_of(surface);
    Errors found;
    for (const std::uint32_t root : roots) {
        const Reach reach = surface_reach(surface.positions, neighbours, root, everything);
        REQUIRE(reach.vertices.size() == surface.positions.size());
        for (std::size_t i = 0; i < reach.vertices.size(); ++i) {
            if (reach.vertices[i] == root) {
                CHECK(reach.distances[i] == 0.0f);
                continue;
            }
            const double wanted = exact(root, reach.vertices[i]);
            if (wanted > within) continue;
            const double error = static_cast<double>(reach.distances[i]) / wanted - 1.0;
            found.below = std::max(found.below, -error);
            found.above = std::max(found.above, error);
        }
    }
    return found;
}

[[nodiscard]] Exact on_sphere(const Surface& surface) {
    return [&surface](std::uint32_t root, std::uint32_t vertex) {
        const double chord =
            glm::distance(glm::dvec3(surface.positions[root]), glm::dvec3(surface.positions[vertex]));
        return 2.0 * std::asin(std::min(1.0, 0.5 * chord));
    };
}

/// Distances on the flat sheet, before it was folded, are straight.
[[nodiscard]] Exact on_sheet(const Surface& flat) {
    return [&flat](std::uint32_t root, std::uint32_t vertex) {
        return glm::distance(glm::dvec3(flat.positions[root]), glm::dvec3(flat.positions[vertex]));
    };
}

}  // namespace

TEST_CASE("distances on a sphere are those of great circles", "[surface]") {
    struct Sample {
        const char* name;
        Surface surface;
    };
    // Coarse enough that the flat triangles themselves take 0.1 % off.
    const std::vector<Sample> samples{{"64 x 32", uv_sphere(64, 32)}, {"128 x 64", uv_sphere(128, 64)},
                                      {"icosphere", icosphere(4)},    {"fine icosphere", icosphere(5)},
                                      {"cube", cube_sphere(16)},      {"fine cube", cube_sphere(48)}};
    for (const auto& [name, surface] : samples) {
        INFO(name);
        std::vector<std::uint32_t> roots = some_roots(surface, 12, 3);
        for (std::uint32_t v = 1; v < 4; ++v) roots.push_back(v);
        const Errors all = errors(surface, roots, on_sphere(surface));
        CHECK(all.below <= 0.015);
        CHECK(all.above <= 0.015);
        // On the root's half of the sphere the curvature is followed to next to nothing.
        const Errors near = errors(surface, roots, on_sphere(surface), 0.5 * std::numbers::pi);
        CHECK(near.below <= 0.003);
        CHECK(near.above <= 0.003);
    }
}

TEST_CASE("distances on a coarse sphere are within two hundredths to far behind it", "[surface]") {
    for (const Surface& surface : {uv_sphere(32, 16), uv_sphere(24, 128), icosphere(2), icosphere(3)}) {
        const Errors found =
            errors(surface, some_roots(surface, 12, 3), on_sphere(surface), 0.85 * std::numbers::pi);
        CHECK(found.below <= 0.02);
        CHECK(found.above <= 0.02);
    }
}

TEST_CASE("distances on a coarse sphere are within two hundredths up to the point opposite", "[surface]") {
    // On spheres with some hundred vertices the flat triangles alone make an error of 1 %.
    for (const Surface& surface : {uv_sphere(24, 12), uv_sphere(32, 16), uv_sphere(64, 16), icosphere(2),
                                   icosphere(3), cube_sphere(6), cube_sphere(8)}) {
        const Errors found = errors(surface, some_roots(surface, 40, 3), on_sphere(surface));
        INFO(surface.positions.size() << " vertices");
        CHECK(found.below <= 0.02);
        CHECK(found.above <= 0.02);
    }
}

TEST_CASE("distances on a folded sheet are straight ones of the sheet unfolded", "[surface]") {
    struct Sample {
        const char* name;
        Surface flat;
        double bound;
    };
    const std::vector<Sample> samples{
        {"regular", sheet(60, 60, 2.0f, 2.0f), 1e-5},
        {"crossed", sheet(60, 60, 2.0f, 2.0f, Cut::crossed), 1e-5},
        {"thin along the folds", sheet(200, 20, 2.0f, 2.0f), 1e-5},
        {"thin across the folds", sheet(20, 200, 2.0f, 2.0f, Cut::crossed), 1e-5},
        {"needles", sheet(20, 1000, 2.0f, 2.0f), 1e-5},
        {"random", sheet(60, 60, 2.0f, 2.0f, Cut::random, 15, 1), 2e-3},
        {"random and thin", sheet(20, 200, 2.0f, 2.0f, Cut::random, 5, 2), 4e-3},
        {"random and thin the other way", sheet(200, 20, 2.0f, 2.0f, Cut::random, 50, 3), 6e-3},
    };
    for (const auto& [name, flat, bound] : samples)
        for (const float angle : {0.0f, 1.5f, 2.9f}) {
            INFO(name << ", folded by " << angle);
            const Surface bent = folded(flat, 0.5f, angle);
            const Errors found = errors(bent, some_roots(flat, 6, 5), on_sheet(flat));
            CHECK(found.below <= 1e-5);
            CHECK(found.above <= bound);
        }
}

TEST_CASE("the way around a hole bends at its corners", "[surface]") {
    // 60 x 60 squares of side 1 with a hole of 20 x 20 in the middle; the root is left of it.
    constexpr int n = 60;
    Surface surface = sheet(n, n, n, n, Cut::crossed);
    std::erase_if(surface.triangles, [&](const glm::ivec3& t) {
        const glm::vec3 centre = (surface.positions[static_cast<std::size_t>(t.x)] +
                                  surface.positions[static_cast<std::size_t>(t.y)] +
                                  surface.positions[static_cast<std::size_t>(t.z)]) /
                                 3.0f;
        return std::abs(centre.x - 30.0f) < 10.0f && std::abs(centre.y - 30.0f) < 10.0f;
    });
    const glm::dvec2 low(20.0), high(40.0);
    const auto is_free = [&](glm::dvec2 a, glm::dvec2 b) {
        double enters = 0.0, leaves = 1.0;
        for (int i = 0; i < 2; ++i) {
            const double way = b[i] - a[i];
            if (way == 0.0) {
                if (a[i] <= low[i] || a[i] >= high[i]) return true;
                continue;
            }
            const double s = (low[i] - a[i]) / way, t = (high[i] - a[i]) / way;
            enters = std::max(enters, std::min(s, t));
            leaves = std::min(leaves, std::max(s, t));
        }
        return leaves - enters < 1e-9;
    };
    const glm::dvec2 corners[4] = {{20, 20}, {40, 20}, {40, 40}, {20, 40}};
    for (const int row : {30, 25, 12}) {
        const auto root = static_cast<std::uint32_t>(row * (n + 1) + 8);
        const glm::dvec2 from(surface.positions[root]);
        // Shortest ways by the corners: three rounds, as no way bends oftener than twice.
        double by_corner[4];
        for (int i = 0; i < 4; ++i)
            by_corner[i] = is_free(from, corners[i]) ? glm::distance(from, corners[i]) : 1e9;
        for (int round = 0; round < 3; ++round)
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j)
                    if (is_free(corners[j], corners[i]))
                        by_corner[i] =
                            std::min(by_corner[i], by_corner[j] + glm::distance(corners[i], corners[j]));
        const Reach reach = reach_of(surface, root);
        double below = 0.0, above = 0.0;
        for (std::size_t i = 0; i < reach.vertices.size(); ++i) {
            const glm::dvec2 to(surface.positions[reach.vertices[i]]);
            double exact = is_free(from, to) ? glm::distance(from, to) : 1e9;
            for (int c = 0; c < 4; ++c)
                if (is_free(corners[c], to))
                    exact = std::min(exact, by_corner[c] + glm::distance(corners[c], to));
            if (exact == 0.0) continue;
            below = std::max(below, 1.0 - reach.distances[i] / exact);
            above = std::max(above, reach.distances[i] / exact - 1.0);
        }
        CHECK(reach.vertices.size() == (n + 1) * (n + 1) - 19 * 19);
        // Behind the hole, where the ways around its two sides meet, a triangle takes them for one wave.
        CHECK(below <= 0.005);
        CHECK(above <= 0.02);
    }
}

TEST_CASE("a search radius leaves out farther vertices and changes no distance within it", "[surface]") {
    const std::vector<Surface> surfaces{icosphere(4), uv_sphere(64, 32), sheet(200, 10, 2.0f, 2.0f),
                                        sheet(40, 40, 2.0f, 2.0f, Cut::random, 1 << 20, 4)};
    for (const Surface& surface : surfaces) {
        const std::uint32_t root = static_cast<std::uint32_t>(surface.positions.size() / 2);
        const Reach all = reach_of(surface, root);
        for (const float radius : {0.0f, 0.05f, 0.3f, 0.9f}) {
            const Reach part = reach_of(surface, root, radius);
            std::size_t at = 0, missed = 0;
            for (std::size_t i = 0; i < all.vertices.size(); ++i) {
                if (at < part.vertices.size() && part.vertices[at] == all.vertices[i]) {
                    CHECK(part.distances[at] == Approx(all.distances[i]).epsilon(2e-3));
                    CHECK(part.distances[at] <= radius);
                    ++at;
                } else if (all.distances[i] < 0.998f * radius) {
                    ++missed;
                }
            }
            CHECK(at == part.vertices.size());
            CHECK(missed == 0);
        }
    }
}

TEST_CASE("no distance along a surface is shorter than the straight line", "[surface]") {
    test::Random random(8);
    Surface rough = sheet(50, 50, 2.0f, 2.0f);
    for (glm::vec3& p : rough.positions) p += random.in_cube(0.4f);
    for (const std::uint32_t root : some_roots(rough, 5, 9)) {
        const Reach reach = reach_of(rough, root);
        REQUIRE(reach.vertices.size() == rough.positions.size());
        for (std::size_t i = 0; i < reach.vertices.size(); ++i) {
            const float straight = glm::distance(rough.positions[root], rough.positions[reach.vertices[i]]);
            CHECK(reach.distances[i] >= straight * (1.0f - 1e-6f));
            CHECK(reach.distances[i] < 1e3f);
        }
    }
}

TEST_CASE("distances do not depend on the order of vertices and triangles", "[surface]") {
    for (const Surface& surface : {icosphere(4), sheet(50, 50, 2.0f, 2.0f, Cut::random, 1 << 20, 6)}) {
        std::vector<std::uint32_t> place;
        const Surface other = shuffled(surface, place, 7);
        const Reach one = reach_of(surface, 321);
        const Reach two = reach_of(other, place[321]);
        REQUIRE(one.vertices.size() == two.vertices.size());
        for (std::size_t v = 0; v < one.vertices.size(); ++v)
            CHECK(two.distances[place[v]] == Approx(one.distances[v]).epsilon(2e-3).margin(1e-6));
        const Reach again = reach_of(surface, 321);
        CHECK(again.vertices == one.vertices);
        CHECK(again.distances == one.distances);
    }
}

TEST_CASE("with a metric distances are those of the surface transformed", "[surface]") {
    const glm::mat3 metric(2.0f, 0.3f, 0.0f, 0.0f, 0.5f, 0.1f, -0.4f, 0.0f, 3.0f);
    const Surface surface = icosphere(4);
    Surface transformed = surface;
    for (glm::vec3& p : transformed.positions) p = metric * p;
    const Reach with = surface_reach(surface.positions, neighbours_of(surface), 17, 2.0f, metric);
    const Reach without = reach_of(transformed, 17, 2.0f);
    CHECK(with.vertices == without.vertices);
    for (std::size_t i = 0; i < with.vertices.size(); ++i)
        CHECK(with.distances[i] == Approx(without.distances[i]).epsilon(1e-4));
}

TEST_CASE("sheets near each other in space are far apart along the surface", "[surface]") {
    // Two sheets joined at the far end only.
    const Surface flat = sheet(200, 20, 2.0f, 0.2f);
    const Surface bent = folded(flat, 1.0f, 3.13f);
    const Reach reach = reach_of(bent, 10 * 201, 0.5f);
    for (const std::uint32_t vertex : reach.vertices) CHECK(flat.positions[vertex].x <= 0.5001f);
    CHECK(reach.vertices.size() > 500);
}

TEST_CASE("vertices that are not connected to the root have no distance", "[surface]") {
    Surface two = icosphere(2);
    const auto count = static_cast<int>(two.positions.size());
    const Surface one = two;
    for (const glm::vec3& p : one.positions) two.positions.push_back(p);
    for (const glm::ivec3& t : one.triangles) two.triangles.push_back(t + count);
    two.positions.emplace_back(0.0f, 0.0f, 1.0f);  // a loose vertex
    CHECK(reach_of(two, 0).vertices.size() == one.positions.size());
    CHECK(reach_of(two, 0).vertices.back() == static_cast<std::uint32_t>(count - 1));
    const Reach loose = reach_of(two, static_cast<std::uint32_t>(2 * count));
    CHECK(loose.vertices == std::vector<std::uint32_t>{static_cast<std::uint32_t>(2 * count)});
    CHECK(loose.distances == std::vector<float>{0.0f});
}

TEST_CASE("distances run along edges without faces too", "[surface]") {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 3, 0}, {4, 3, 0}};
    const std::vector<glm::ivec3> triangles{{0, 1, 2}, {0, 2, 3}};
    const std::vector<glm::ivec2> edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {3, 4}, {4, 5}};
    const Reach reach = surface_reach(positions, Neighbours(6, triangles, edges), 1, everything);
    REQUIRE(reach.vertices.size() == 6);
    CHECK(reach.distances[3] == Approx(std::sqrt(2.0f)));
    CHECK(reach.distances[4] == Approx(std::sqrt(2.0f) + 2.0f));
    CHECK(reach.distances[5] == Approx(std::sqrt(2.0f) + 6.0f));
}

TEST_CASE("three sheets at one edge, sheets turned inside out and doubled triangles are all surface",
          "[surface]") {
    // A book of three pages, one of them the other way round, one twice there.
    Surface book;
    const auto page = [&](glm::vec3 across, bool is_turned) {
        const auto base = static_cast<int>(book.positions.size());
        for (int j = 0; j <= 10; ++j)
            for (int i = 1; i <= 10; ++i)
                book.positions.push_back(0.1f * static_cast<float>(i) * across +
                                         glm::vec3(0, 0.1f * static_cast<float>(j), 0));
        const auto at = [&](int i, int j) { return i == 0 ? j : base + j * 10 + i - 1; };
        for (int j = 0; j < 10; ++j)
            for (int i = 0; i < 10; ++i) {
                glm::ivec3 t(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                glm::ivec3 u(at(i, j), at(i + 1, j + 1), at(i, j + 1));
                if (is_turned) {
                    std::swap(t.x, t.y);
                    std::swap(u.y, u.z);
                }
                book.triangles.insert(book.triangles.end(), {t, u});
            }
    };
    for (int j = 0; j <= 10; ++j) book.positions.emplace_back(0.0f, 0.1f * static_cast<float>(j), 0.0f);
    page({1, 0, 0}, false);
    page({-0.6f, 0, 0.8f}, true);
    page({-0.6f, 0, -0.8f}, false);
    const std::vector<glm::ivec3> once = book.triangles;
    book.triangles.insert(book.triangles.end(), once.end() - 200, once.end());
    // From a corner of the first page, to every vertex of the other two: unfolded, a straight line.
    const std::uint32_t root = 11 + 9;
    const Reach reach = reach_of(book, root);
    REQUIRE(reach.vertices.size() == book.positions.size());
    for (std::uint32_t v = 11 + 110; v < book.positions.size(); ++v) {
        const glm::vec3 p = book.positions[v];
        const double exact = std::hypot(1.0 + std::hypot(p.x, p.z), p.y);
        CHECK(reach.distances[v] == Approx(exact).epsilon(1e-4));
    }
}

TEST_CASE("triangles without area, coincident vertices and vertices at NaN leave all other distances right",
          "[surface]") {
    Surface surface = sheet(20, 20, 2.0f, 2.0f);
    for (int i = 0; i < 21; ++i)
        surface.positions[static_cast<std::size_t>(10 * 21 + i)] =
            surface.positions[static_cast<std::size_t>(9 * 21 + i)];
    const Reach squeezed = reach_of(surface, 0);
    REQUIRE(squeezed.vertices.size() == surface.positions.size());
    for (std::size_t i = 1; i < squeezed.vertices.size(); ++i) {
        const double exact = glm::distance(surface.positions[0], surface.positions[squeezed.vertices[i]]);
        CHECK(squeezed.distances[i] == Approx(exact).epsilon(0.02));
    }

    surface.positions[5 * 21 + 5] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    surface.positions[6 * 21 + 6].x = everything;
    const Reach holes = reach_of(surface, 0);
    CHECK(holes.vertices.size() == surface.positions.size() - 2);
    for (const float distance : holes.distances) CHECK(std::isfinite(distance));
    const Reach nowhere = reach_of(surface, 5 * 21 + 5);
    CHECK(nowhere.vertices == std::vector<std::uint32_t>{5 * 21 + 5});

    for (glm::vec3& p : surface.positions) p = glm::vec3(1.0f);
    const Reach point = reach_of(surface, 3, 0.0f);
    CHECK(point.vertices.size() == surface.positions.size());
    for (const float distance : point.distances) CHECK(distance == 0.0f);
}

TEST_CASE("a surface may be tiny, huge or far from the origin", "[surface]") {
    const Surface unit = icosphere(3);
    const Reach wanted = reach_of(unit, 5);
    for (const float scale : {1e-12f, 1e-4f, 1e5f, 1e15f}) {
        Surface scaled = unit;
        for (glm::vec3& p : scaled.positions) p *= scale;
        const Reach reach = reach_of(scaled, 5);
        REQUIRE(reach.vertices.size() == unit.positions.size());
        for (std::size_t i = 0; i < reach.vertices.size(); ++i)
            CHECK(reach.distances[i] / scale == Approx(wanted.distances[i]).epsilon(2e-3));
    }
    Surface far = unit;
    for (glm::vec3& p : far.positions) p += glm::vec3(1000.0f, -2000.0f, 500.0f);
    const Reach reach = reach_of(far, 5);
    for (std::size_t i = 0; i < reach.vertices.size(); ++i)
        CHECK(reach.distances[i] == Approx(wanted.distances[i]).epsilon(1e-2));
}

TEST_CASE("edges are counted along the mesh's edges", "[surface]") {
    constexpr int n = 12;
    const Surface surface = sheet(n, n, 1.0f, 1.0f);
    std::vector<glm::ivec2> edges;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            if (i < n) edges.emplace_back(j * (n + 1) + i, j * (n + 1) + i + 1);
            if (j < n) edges.emplace_back(j * (n + 1) + i, (j + 1) * (n + 1) + i);
        }
    const Neighbours neighbours(surface.positions.size(), surface.triangles, edges);
    constexpr int root_i = 4, root_j = 7;
    for (const std::uint32_t steps : {0u, 1u, 5u, 1000u, std::numeric_limits<std::uint32_t>::max()}) {
        const Reach reach = edge_reach(neighbours, root_j * (n + 1) + root_i, steps);
        std::size_t at = 0;
        for (int v = 0; v < (n + 1) * (n + 1); ++v) {
            const auto away =
                static_cast<std::uint32_t>(std::abs(v % (n + 1) - root_i) + std::abs(v / (n + 1) - root_j));
            if (away > steps) continue;
            REQUIRE(at < reach.vertices.size());
            CHECK(reach.vertices[at] == static_cast<std::uint32_t>(v));
            CHECK(reach.distances[at] == static_cast<float>(away));
            ++at;
        }
        CHECK(at == reach.vertices.size());
    }
    // Without edges of its own the mesh's diagonals count.
    const Reach diagonal = edge_reach(neighbours_of(surface), 0, 1000);
    CHECK(diagonal.distances.back() == static_cast<float>(n));
}

TEST_CASE("surface distances refuse invalid arguments", "[surface]") {
    const Surface surface = icosphere(0);
    const Neighbours neighbours = neighbours_of(surface);
    const std::span<const glm::vec3> few(surface.positions.data(), 5);
    CHECK_THROWS_AS(surface_reach(surface.positions, neighbours, 12, 1.0f), std::invalid_argument);
    CHECK_THROWS_AS(surface_reach(surface.positions, neighbours, 0, -1.0f), std::invalid_argument);
    CHECK_THROWS_AS(surface_reach(surface.positions, neighbours, 0, std::nanf("")), std::invalid_argument);
    CHECK_THROWS_AS(surface_reach(few, neighbours, 0, 1.0f), std::invalid_argument);
    CHECK_THROWS_AS(edge_reach(neighbours, 12, 1), std::invalid_argument);
}
