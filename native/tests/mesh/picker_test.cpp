#include "motus/mesh/picker.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "motus/core/numeric.hpp"
#include "picker_leaves.hpp"
#include "picker_meshes.hpp"
#include "picker_near.hpp"
#include "picker_ray.hpp"

using namespace motus;
using namespace motus::mesh;
using namespace motus::mesh::checks;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr PickerPoint nowhere{not_a_number, not_a_number, not_a_number, not_a_number};

const std::vector<Mesh>& meshes() {
    static const std::vector<Mesh> all = troubling_meshes();
    return all;
}

Picker picker_of(const Mesh& mesh, std::size_t threads = 2) {
    return Picker(mesh.positions, mesh.triangles, threads);
}

/// Points on vertices, near the mesh and far from it.
std::vector<glm::vec3> points_around(const Mesh& mesh, int count, Dice& dice) {
    const auto [centre, size] = extent(mesh);
    std::vector<glm::vec3> points{centre, centre + 50.0f * size * glm::vec3(1, -1, 0.5f)};
    for (int i = 0; i < count; ++i) {
        points.push_back(centre + dice.in_cube(1.5f * size));
        if (mesh.positions.empty()) continue;
        const glm::vec3& vertex = mesh.positions[static_cast<std::size_t>(dice.index(mesh.positions.size()))];
        if (!is_finite(vertex)) continue;
        points.push_back(vertex);
        points.push_back(vertex + dice.in_cube(0.02f * size));
    }
    return points;
}

/// No triangle is nearer than what was found, and what was found is there.
void check_ray(const Mesh& mesh, const Picker& picker, const glm::dvec3& origin,
               const glm::dvec3& direction) {
    const glm::dvec3 unit = glm::normalize(direction);
    const std::optional<Hit> hit = picker.ray(origin, direction);
    constexpr double clear = 1e-9;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto plain = plain_hit(mesh, i, origin, unit);
        if (plain && plain->least_weight > clear && plain->distance > 0.0)
            nearest = std::min(nearest, plain->distance);
    }
    const auto [centre, size] = extent(mesh);
    const double rounding = 1e-12 * (size + glm::length(glm::dvec3(centre) - origin));
    if (!hit) {
        CHECK(nearest == std::numeric_limits<double>::infinity());
        return;
    }
    CHECK(hit->distance >= 0.0);
    CHECK(hit->distance <= nearest + 1e3 * rounding);
    const std::optional<Hit> within_reach = picker.ray(origin, direction, hit->distance);
    REQUIRE(within_reach.has_value());
    CHECK(within_reach->triangle == hit->triangle);
    CHECK_FALSE(picker.ray(origin, direction, std::nextafter(hit->distance, -1.0)).has_value());
    CHECK(glm::distance(hit->point, origin + hit->distance * unit) <= 1e3 * rounding);
    const auto plain = plain_hit(mesh, hit->triangle, origin, unit);
    if (plain) CHECK(plain->least_weight >= -1e-6);
}

void check_same(const std::optional<Hit>& hit, const std::optional<Hit>& again) {
    REQUIRE(hit.has_value() == again.has_value());
    if (!hit) return;
    CHECK(hit->triangle == again->triangle);
    CHECK(hit->point == again->point);
    CHECK(hit->distance == again->distance);
}

/// All answers of the two agree, to the bit.
void check_same(const Mesh& mesh, const Picker& one, const Picker& other, unsigned seed) {
    Dice dice(seed);
    const auto [centre, size] = extent(mesh);
    for (const glm::vec3& point : points_around(mesh, 12, dice)) {
        CHECK(one.nearest(point) == other.nearest(point));
        const float radius = size * dice.between(0.0f, 1.0f);
        CHECK(one.within(point, radius) == other.within(point, radius));
        const glm::dvec3 towards = glm::dvec3(centre + dice.in_cube(size)) - glm::dvec3(point);
        check_same(one.ray(point, towards), other.ray(point, towards));
    }
}

void bend(Mesh& mesh, Dice& dice, float amount) {
    const auto [centre, size] = extent(mesh);
    const glm::vec3 wave = 4.0f * dice.in_cube(1.0f) / size, along = amount * dice.in_cube(size);
    for (glm::vec3& p : mesh.positions) p += std::sin(glm::dot(wave, p - centre)) * along;
}

}  // namespace

TEST_CASE("no vertex is nearer than the nearest", "[picker]") {
    Dice dice(1);
    for (const Mesh& mesh : meshes()) {
        INFO(mesh.name);
        const Picker picker = picker_of(mesh);
        CHECK(picker.vertex_count() == mesh.positions.size());
        CHECK(picker.triangle_count() == mesh.triangles.size());
        for (const glm::vec3& point : points_around(mesh, 30, dice)) {
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < mesh.positions.size(); ++i)
                if (is_finite(mesh.positions[i])) least = std::min(least, distance_to(mesh, i, point));
            const auto found = picker.nearest(point);
            REQUIRE(found.has_value() == (least < std::numeric_limits<double>::infinity()));
            if (found) CHECK(distance_to(mesh, *found, point) <= least * (1.0 + 1e-6));
        }
    }
}

TEST_CASE("Picker.within finds each vertex within the radius once, in ascending order", "[picker]") {
    Dice dice(2);
    const glm::mat3 shear(2.0f, 0.3f, 0.0f, -0.5f, 0.7f, 1.1f, 0.0f, 0.4f, -1.3f);
    const std::array metrics{glm::mat3(1.0f), glm::mat3(3, 0, 0, 0, 0.5f, 0, 0, 0, 1), shear,
                             glm::mat3(1, 0, 0, 0, 0, 0, 0, 0, 1)};
    for (const Mesh& mesh : meshes()) {
        INFO(mesh.name);
        const Picker picker = picker_of(mesh);
        const float size = extent(mesh).size;
        for (const glm::vec3& point : points_around(mesh, 8, dice)) {
            for (const glm::mat3& metric : metrics) {
                for (const float radius : {0.0f, 0.1f * size, 0.7f * size, 5.0f * size, 1e3f * size}) {
                    const std::vector<std::uint32_t> found = picker.within(point, radius, metric);
                    std::size_t wrong = 0, next = 0;
                    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
                        const bool is_found = next < found.size() && found[next] == i;
                        next += is_found ? 1 : 0;
                        const double distance = distance_to(mesh, i, point, metric);
                        const bool in = distance < radius * (1.0 - 1e-6) || distance == 0.0;
                        const bool out = !is_finite(mesh.positions[i]) || distance > radius * (1.0 + 1e-6);
                        wrong += (in && !is_found) || (out && is_found) ? 1 : 0;
                    }
                    CAPTURE(radius);
                    CHECK(next == found.size());
                    CHECK(wrong == 0);
                }
            }
        }
    }
}

TEST_CASE("the triangle that a ray finds is the first one that it meets", "[picker]") {
    Dice dice(3);
    for (const Mesh& mesh : meshes()) {
        INFO(mesh.name);
        const Picker picker = picker_of(mesh);
        const auto [centre, size] = extent(mesh);
        for (const glm::vec3& from : points_around(mesh, 25, dice)) {
            check_ray(mesh, picker, from, dice.in_cube(1.0f));
            check_ray(mesh, picker, from,
                      1e-3 * glm::dvec3(centre + dice.in_cube(size) - from) / double(size));
            glm::dvec3 axis(0.0);
            const double sign = dice.chance(0.5) ? 1.0 : -1.0;
            axis[dice.index(3)] = sign;
            check_ray(mesh, picker, from, axis);
        }
    }
}

TEST_CASE("no ray slips through the edges and vertices of a closed mesh", "[picker]") {
    for (const Mesh& mesh : {sphere(20, 31), sphere(5, 4), sphere(64, 128)}) {
        const Picker picker = picker_of(mesh);
        Dice dice(4);
        std::size_t lost = 0;
        for (int trial = 0; trial < 20; ++trial) {
            const glm::dvec3 inside = trial == 0 ? glm::dvec3(0.0) : glm::dvec3(dice.in_cube(0.3f));
            const auto aim = [&](const glm::dvec3& at) { lost += picker.ray(inside, at - inside) ? 0 : 1; };
            for (const glm::vec3& p : mesh.positions) aim(p);
            for (const glm::ivec3& t : mesh.triangles) {
                const glm::dvec3 a(mesh.positions[static_cast<std::size_t>(t.x)]);
                const glm::dvec3 b(mesh.positions[static_cast<std::size_t>(t.y)]);
                aim(0.5 * (a + b));
                aim(glm::mix(a, b, static_cast<double>(dice.between(0.0f, 1.0f))));
            }
        }
        CHECK(lost == 0);
    }
}

TEST_CASE("a ray straight at a vertex of a flat sheet meets the lowest of its triangles", "[picker]") {
    const Mesh mesh = sheet(9);
    for (int axis = 0; axis < 3; ++axis) {
        Mesh turned = mesh;
        for (glm::vec3& p : turned.positions) p = {p[(3 - axis) % 3], p[(4 - axis) % 3], p[(5 - axis) % 3]};
        const Picker picker = picker_of(turned);
        for (std::size_t vertex = 0; vertex < turned.positions.size(); ++vertex) {
            const auto touches = [&](const glm::ivec3& t) {
                const int v = static_cast<int>(vertex);
                return t.x == v || t.y == v || t.z == v;
            };
            const auto lowest = std::find_if(turned.triangles.begin(), turned.triangles.end(), touches);
            glm::dvec3 normal(0.0);
            normal[(axis + 2) % 3] = 2.0;
            for (const double side : {-1.0, 1.0}) {
                const auto hit =
                    picker.ray(glm::dvec3(turned.positions[vertex]) + side * normal, -side * normal);
                REQUIRE(hit);
                CHECK(hit->triangle == lowest - turned.triangles.begin());
                CHECK(hit->point == glm::dvec3(turned.positions[vertex]));
                CHECK(hit->distance == 2.0);
            }
        }
    }
}

TEST_CASE("a ray finds nothing behind its origin", "[picker]") {
    const Mesh mesh = sphere(30, 40);
    const Picker picker = picker_of(mesh);
    const glm::dvec3 aside(0.2, 0.1, 0.0);
    const auto from_inside = picker.ray(aside, {0, 0, 5});
    REQUIRE(from_inside);
    CHECK(from_inside->point.z > 0.9);
    CHECK(from_inside->distance == Approx(from_inside->point.z));
    CHECK_FALSE(picker.ray(aside + glm::dvec3(0, 0, 2), {0, 0, 5}));
    CHECK(picker.ray(aside + glm::dvec3(0, 0, 2), {0, 0, -5})->distance ==
          Approx(2.0 - from_inside->point.z));

    const Picker flat = picker_of(sheet(5));
    CHECK(flat.ray({1.3, 1.2, 0.0}, {0, 0, 1})->distance == 0.0);
    CHECK_FALSE(flat.ray({-3.0, 1.2, 0.0}, {1, 0, 0}));
    CHECK_FALSE(flat.ray({1.3, 1.2, 1.0}, {1, 0, 0}));
}

TEST_CASE("the hit of a ray from far away is exact to rounding", "[picker]") {
    const Mesh mesh = blob();
    const Picker picker = picker_of(mesh);
    Dice dice(5);
    const glm::dvec3 away = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
    for (int trial = 0; trial < 200; ++trial) {
        const glm::dvec3 at(dice.in_cube(0.5f));
        const auto near = picker.ray(at + 20.0 * away, -away), far = picker.ray(at + 2e4 * away, -away);
        REQUIRE(near.has_value() == far.has_value());
        if (near) CHECK(glm::distance(near->point, far->point) < 1e-9);
    }
}

TEST_CASE("a triangle without area is never met", "[picker]") {
    // Collinear and coincident corners, in whole numbers and in thirds, in the way of every ray.
    const float third = 1.0f / 3.0f;
    const Mesh mesh{"lines and dots",
                    {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {third, third, third}, {0, 0, 0}, {1, 1, 1}},
                    {{0, 1, 2}, {0, 3, 1}, {0, 4, 1}, {0, 0, 1}, {5, 1, 5}, {2, 2, 2}}};
    const Picker picker = picker_of(mesh);
    for (const glm::vec3& at : mesh.positions)
        for (const glm::dvec3 way :
             {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(1, 1, 1), glm::dvec3(1, -2, 1)})
            CHECK_FALSE(picker.ray(glm::dvec3(at) - 4.0 * way, way));
}

TEST_CASE("of vertices or triangles at equal distances the one with the lowest index is found", "[picker]") {
    Mesh mesh = sheet(8);
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    const auto triangles = static_cast<std::uint32_t>(mesh.triangles.size());
    const Mesh once = mesh;
    for (int copy = 1; copy < 4; ++copy) {
        mesh.positions.insert(mesh.positions.end(), once.positions.begin(), once.positions.end());
        for (const glm::ivec3& t : once.triangles)
            mesh.triangles.push_back(t + static_cast<int>(vertices) * copy);
    }
    const Picker picker = picker_of(mesh);
    for (std::uint32_t i = 0; i < vertices; ++i)
        CHECK(picker.nearest(once.positions[i] + glm::vec3(0, 0, 0.25f)) == i);
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 7; ++x) {
            CHECK(picker.nearest({float(x) + 0.5f, float(y) + 0.5f, 1.0f}) ==
                  static_cast<std::uint32_t>(8 * y + x));
            CHECK(picker.ray({x + 0.25, y + 0.25, 1}, {0, 0, -1})->triangle < triangles);
        }
    }
}

TEST_CASE("a picker after a refit answers as a new picker does", "[picker]") {
    for (const Mesh& mesh : meshes()) {
        INFO(mesh.name);
        Mesh bent = mesh;
        Picker picker = picker_of(mesh);
        Dice dice(8);
        for (const float amount : {0.05f, 1.0f, 3.0f}) {
            bend(bent, dice, amount);
            picker.refit(bent.positions);
            check_same(bent, picker, picker_of(bent), 80);
        }
        std::fill(bent.positions.begin(), bent.positions.end(), glm::vec3(1.0f));
        picker.refit(bent.positions);
        check_same(bent, picker, picker_of(bent), 81);
        picker.refit(mesh.positions);
        check_same(mesh, picker, picker_of(mesh), 82);
    }
}

TEST_CASE("a refit of the moved vertices alone equals a refit of all vertices", "[picker]") {
    for (const Mesh& mesh : meshes()) {
        if (mesh.positions.empty()) continue;
        INFO(mesh.name);
        Mesh bent = mesh;
        Picker picker = picker_of(mesh);
        Dice dice(9);
        const float size = extent(mesh).size;
        for (int pull = 0; pull < 6; ++pull) {
            // Two regions and a vertex of their own, moved ever farther, so that boxes of one reach into the
            // other.
            std::vector<std::uint32_t> moved{static_cast<std::uint32_t>(dice.index(mesh.positions.size()))};
            for (int region = 0; region < 2; ++region) {
                const auto root = static_cast<std::size_t>(dice.index(mesh.positions.size()));
                const auto near = picker.within(bent.positions[root], 0.3f * size);
                moved.insert(moved.end(), near.rbegin(), near.rend());
            }
            const glm::vec3 way = dice.in_cube(static_cast<float>(1 + pull) * size);
            for (const std::uint32_t vertex : moved) bent.positions[vertex] += way;
            // Positions of vertices that are not named are not read.
            std::vector<glm::vec3> given(bent.positions.size(), glm::vec3(1e30f));
            for (const std::uint32_t vertex : moved) given[vertex] = bent.positions[vertex];
            picker.refit(given, moved);
            check_same(bent, picker, picker_of(bent), 90);
        }
    }
}

TEST_CASE("a ray at given other positions of the vertices finds what it would find after a refit to these",
          "[picker]") {
    for (const Mesh& mesh : meshes()) {
        if (mesh.positions.empty()) continue;
        INFO(mesh.name);
        const Picker picker = picker_of(mesh);
        Dice dice(12);
        const float size = extent(mesh).size;
        for (const float amount : {0.0f, 0.01f, 0.3f, 2.0f}) {
            Mesh bent = mesh;
            bend(bent, dice, amount);
            float slack = 0.0f;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i)
                slack = std::max(slack, glm::distance(mesh.positions[i], bent.positions[i]));
            const Picker fresh = picker_of(bent);
            for (const glm::vec3& point : points_around(bent, 40, dice)) {
                const glm::dvec3 towards =
                    glm::dvec3(extent(bent).centre + dice.in_cube(size)) - glm::dvec3(point);
                check_same(picker.ray(point, towards, bent.positions, 1.00001f * slack),
                           fresh.ray(point, towards));
            }
        }
    }
}

TEST_CASE("a vertex at NaN is not found, and is found again at its next finite position", "[picker]") {
    Mesh mesh = blob();
    Picker picker = picker_of(mesh);
    const std::vector<glm::vec3> before = mesh.positions;
    const std::vector<std::uint32_t> moved{17, 400, 401, 2000};
    for (const std::uint32_t vertex : moved)
        mesh.positions[vertex].y = std::numeric_limits<float>::quiet_NaN();
    picker.refit(mesh.positions, moved);
    check_same(mesh, picker, picker_of(mesh), 100);
    CHECK(picker.within(glm::vec3(0.0f), 1e9f).size() == before.size() - moved.size());
    // The vertices move to places outside all boxes.
    for (const std::uint32_t vertex : moved) mesh.positions[vertex] = before[vertex] + glm::vec3(30.0f);
    picker.refit(mesh.positions, moved);
    for (const std::uint32_t vertex : moved) {
        CHECK(picker.nearest(mesh.positions[vertex]) == vertex);
        CHECK(picker.within(mesh.positions[vertex], 1e-3f) == std::vector{vertex});
    }
    check_same(mesh, picker, picker_of(mesh), 102);
    picker.refit(before, moved);
    mesh.positions = before;
    check_same(mesh, picker, picker_of(mesh), 101);
    CHECK(picker.within(glm::vec3(0.0f), 1e9f).size() == before.size());
}

TEST_CASE("picker results do not depend on the number of threads", "[picker]") {
    Mesh mesh = sphere(130, 150);
    const Picker alone = picker_of(mesh, 1);
    Picker shared = picker_of(mesh, 5);
    check_same(mesh, alone, shared, 110);
    shared.refit(mesh.positions);
    check_same(mesh, alone, shared, 111);
}

TEST_CASE("all instruction sets compute the same boxes, and find the same vertices and triangles",
          "[picker]") {
    Dice dice(77);
    for (const Mesh& mesh : meshes()) {
        INFO(mesh.name);
        // A tree of one leaf for each eight vertices, in the order in which they are given.
        Array<PickerPoint> points((mesh.positions.size() + fan_out - 1) / fan_out * fan_out, nowhere);
        Array<std::uint32_t> order(mesh.positions.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const glm::vec3& p = mesh.positions[i];
            order[i] = static_cast<std::uint32_t>(i);
            points[i] = is_finite(p) ? PickerPoint{p.x, p.y, p.z, 0.0f} : nowhere;
        }
        std::vector<std::array<std::uint32_t, 3>> corners;
        for (const glm::ivec3& t : mesh.triangles)
            corners.push_back({static_cast<std::uint32_t>(t.x), static_cast<std::uint32_t>(t.y),
                               static_cast<std::uint32_t>(t.z)});
        std::vector<std::uint32_t> names(corners.size()), starts{0};
        std::iota(names.begin(), names.end(), 0U);
        const std::size_t leaves = points.size() / fan_out;
        for (std::size_t leaf = 1; leaf <= leaves; ++leaf)
            starts.push_back(
                static_cast<std::uint32_t>(corners.size() * leaf / std::max<std::size_t>(leaves, 1)));
        const PickerLeaves of_leaves{points, starts, corners};
        PickerBoxes around_vertices(leaves), around_triangles(leaves);
        const LeafKernel& first = leaf_kernels().front();
        const auto refit = [&](PickerBoxes& boxes, LeafKernel::Boxes kernel) {
            boxes.refit(
                [&](std::size_t from, std::size_t to, PickerBox* out) { kernel(of_leaves, from, to, out); },
                1);
        };
        refit(around_vertices, first.around_vertices);
        refit(around_triangles, first.around_triangles);
        for (const LeafKernel& kernel : leaf_kernels()) {
            INFO(kernel.name);
            for (const auto part : {&LeafKernel::around_vertices, &LeafKernel::around_triangles}) {
                std::vector<PickerBox> expected(leaves), found(leaves);
                (first.*part)(of_leaves, 0, leaves, expected.data());
                (kernel.*part)(of_leaves, 0, leaves, found.data());
                for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
                    CHECK(found[leaf].low == expected[leaf].low);
                    CHECK(found[leaf].high == expected[leaf].high);
                }
            }
        }
        const NearTree near{around_vertices, false, order, points};
        glm::mat3 metric(1.0f);
        metric[0][1] = 0.3f;
        for (const glm::vec3& point : points_around(mesh, 20, dice)) {
            const float radius = dice.between(0.0f, 1.0f) * extent(mesh).size;
            for (const NearKernel& kernel : near_kernels()) {
                INFO(kernel.name);
                const NearKernel& one = near_kernels().front();
                CHECK(kernel.nearest(near, point) == one.nearest(near, point));
                for (const glm::mat3& way : {glm::mat3(1.0f), metric})
                    CHECK(kernel.within(near, point, radius, way) == one.within(near, point, radius, way));
            }
        }
        for (const std::span<const glm::vec3> moved :
             {std::span<const glm::vec3>(), std::span(mesh.positions)}) {
            const RayTree rays{around_triangles, 0.0, starts, names, corners, order, points, moved};
            for (int i = 0; i < 50; ++i) {
                const auto [centre, size] = extent(mesh);
                const glm::dvec3 origin = glm::dvec3(centre) + dice.in_cube(2.0 * size);
                const glm::dvec3 way = glm::dvec3(centre) + dice.in_cube(0.5 * size) - origin;
                const auto expected = ray_kernels().front().first_met(rays, origin, way, 1e30);
                for (const RayKernel& kernel : ray_kernels()) {
                    INFO(kernel.name);
                    const auto hit = kernel.first_met(rays, origin, way, 1e30);
                    REQUIRE(hit.has_value() == expected.has_value());
                    if (!hit) continue;
                    CHECK(hit->triangle == expected->triangle);
                    CHECK(hit->distance == expected->distance);
                    CHECK(hit->point == expected->point);
                }
            }
        }
    }
}

TEST_CASE("a picker can be moved from one variable to another", "[picker]") {
    const Mesh mesh = blob();
    Picker first = picker_of(mesh), second = std::move(first);
    CHECK(first.vertex_count() == 0);
    CHECK(first.triangle_count() == 0);
    CHECK(!first.ray({0, 0, 9}, {0, 0, -1}));
    CHECK(!first.nearest({0, 0, 0}));
    CHECK(first.within({0, 0, 0}, 9.0f).empty());
    first.refit({});
    first.refit({}, {});
    CHECK_THROWS_AS(first.refit(mesh.positions), std::invalid_argument);
    first = picker_of(sheet(3));
    CHECK(first.vertex_count() == 9);
    check_same(mesh, second, picker_of(mesh), 120);
}

TEST_CASE("a picker refuses invalid arguments, and finds nothing for degenerate rays and points",
          "[picker]") {
    const Mesh mesh = sheet(4);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    inf = std::numeric_limits<float>::infinity();
    const std::vector<glm::ivec3> too_high{{0, 1, 16}}, negative{{0, -1, 2}};
    CHECK_THROWS_AS(Picker(mesh.positions, too_high), std::invalid_argument);
    CHECK_THROWS_AS(Picker(mesh.positions, negative), std::invalid_argument);
    CHECK_THROWS_AS(Picker({}, too_high), std::invalid_argument);

    Picker picker = picker_of(mesh);
    const std::vector<glm::vec3> fewer(15);
    const std::vector<std::uint32_t> no_vertex{3, 16};
    CHECK_THROWS_AS(picker.refit(fewer), std::invalid_argument);
    CHECK_THROWS_AS(picker.refit(fewer, {}), std::invalid_argument);
    CHECK_THROWS_AS(picker.refit(mesh.positions, no_vertex), std::invalid_argument);
    CHECK_THROWS_AS(picker.ray({1, 1, 1}, {0, 0, -1}, fewer, 0.0f), std::invalid_argument);
    for (const float slack : {-1e-9f, nan, inf})
        CHECK_THROWS_AS(picker.ray({1, 1, 1}, {0, 0, -1}, mesh.positions, slack), std::invalid_argument);
    check_same(mesh, picker, picker_of(mesh), 130);

    CHECK_FALSE(picker.ray({1, 1, 1}, {0, 0, 0}));
    CHECK_FALSE(picker.ray({1, 1, 1}, {0, 0, -std::numeric_limits<double>::infinity()}));
    CHECK_FALSE(picker.ray({1, nan, 1}, {0, 0, -1}));
    CHECK(picker.ray({1.2, 1.3, 1}, {0, 0, -1e-300})->distance == 1.0);
    CHECK(picker.ray({1.2, 1.3, 1}, {0, 0, -1e300})->distance == 1.0);
    CHECK_FALSE(picker.nearest({nan, 0, 0}));
    CHECK_FALSE(picker.nearest({0, inf, 0}));
    CHECK(picker.within({1, 1, 0}, -1.0f).empty());
    CHECK(picker.within({1, 1, 0}, nan).empty());
    CHECK(picker.within({nan, 1, 0}, 9.0f).empty());
    CHECK(picker.within({1, 1, 0}, 1.0f, glm::mat3(nan)).empty());
    CHECK(picker.within({1, 1, 0}, inf).size() == 16);
}
