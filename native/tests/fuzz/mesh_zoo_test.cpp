// Every function that takes a mesh, over all meshes of the zoo.
#include "mesh_zoo.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <vector>

#include "extremes.hpp"
#include "motus/core/numeric.hpp"
#include "motus/lattice/lattice.hpp"
#include "motus/mesh/neighbours.hpp"
#include "motus/mesh/picker.hpp"
#include "motus/mesh/refine.hpp"
#include "motus/mesh/surface_distance.hpp"
#include "motus/sculpt/pull.hpp"
#include "motus/snow/cover.hpp"
#include "motus/snow/layer.hpp"
#include "motus/snow/snow.hpp"
#include "motus/walker/walker.hpp"

using namespace motus;
using namespace motus::test;

namespace {

[[nodiscard]] bool all_finite(const std::vector<glm::vec3>& places) {
    return std::ranges::all_of(places, [](const glm::vec3& place) { return is_finite(place); });
}

/// Largest coordinate.
[[nodiscard]] double size_of(const ZooMesh& mesh) {
    double size = 0.0;
    for (const glm::vec3& p : mesh.positions)
        for (int axis = 0; axis < 3; ++axis) size = std::max(size, static_cast<double>(std::abs(p[axis])));
    return size;
}

/// Flakes that fall on what lies below, about as large as the mesh.
[[nodiscard]] snow::SnowSettings falling_on(const ZooMesh& mesh) {
    snow::SnowSettings settings;
    settings.rate = 15.0;
    settings.looping = false;
    settings.duration = 3.0;
    settings.lifetime = 6.0;
    settings.start_speed = -2.0;
    settings.cone_radius = 1.5;
    settings.collider = std::make_shared<const snow::Collider>(mesh.positions, mesh.triangles, 1);
    settings.collision = snow::Collision::slide;
    settings.emitter_times = {0.0};
    settings.emitter_matrices = {glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 6.0))};
    return settings;
}

void check_reach(const mesh::Reach& reach, const ZooMesh& mesh) {
    CHECK(reach.vertices.size() == reach.distances.size());
    CHECK(std::ranges::is_sorted(reach.vertices));
    for (const float distance : reach.distances) CHECK((std::isfinite(distance) && distance >= 0.0F));
    for (const std::uint32_t vertex : reach.vertices) CHECK(vertex < mesh.positions.size());
}

}  // namespace

TEST_CASE("every vertex and triangle that a picker finds on a zoo of meshes exists", "[zoo]") {
    for (const ZooMesh& mesh : mesh_zoo()) {
        CAPTURE(mesh.name);
        const bool was_made = returns([&] {
            mesh::Picker picker(mesh.positions, mesh.triangles, 1);
            Dice dice(1, 0.1);
            const double size = std::isfinite(size_of(mesh)) ? size_of(mesh) : 2.0;
            for (int round = 0; round < 60; ++round) {
                const glm::dvec3 from = 3.0 * size * dice.place(), along = dice.place();
                const auto hit = picker.ray(from, along);
                if (hit) {
                    CHECK(mesh.has_area);
                    CHECK(hit->triangle < mesh.triangles.size());
                    CHECK(is_finite(hit->point));
                    CHECK((std::isfinite(hit->distance) && hit->distance >= 0.0));
                    CHECK(picker.nearest_seen(*hit, along) < mesh.positions.size());
                    CHECK(picker.nearest_seen(*hit, along, mesh.positions, 0.0F) < mesh.positions.size());
                }
                (void)picker.ray(from, along, mesh.positions, dice.single(0.0, 1.0) >= 0.0F ? 0.5F : 0.0F);
                const auto nearest = picker.nearest(dice.single_place());
                if (nearest) CHECK(is_finite(mesh.positions[*nearest]));
                const auto within = picker.within(dice.single_place(), dice.single(0.0, 3.0));
                CHECK(std::ranges::is_sorted(within));
                for (const std::uint32_t vertex : within) CHECK(is_finite(mesh.positions[vertex]));
            }
            picker.refit(mesh.positions);
            const std::vector<std::uint32_t> moved{0};
            if (!mesh.positions.empty()) picker.refit(mesh.positions, moved);
            CHECK(is_refused([&] { picker.refit(std::vector<glm::vec3>(mesh.positions.size() + 1)); },
                             "positions"));
        });
        CHECK(was_made == mesh.are_indices);
    }
}

TEST_CASE("distances on a zoo of meshes are finite", "[zoo]") {
    for (const ZooMesh& mesh : mesh_zoo()) {
        CAPTURE(mesh.name);
        const std::vector<glm::ivec2> wires{{0, 1}};
        const bool was_made = returns([&] {
            const auto around = mesh::Neighbours::of_triangles(mesh.positions.size(), mesh.triangles);
            const auto count = static_cast<std::uint32_t>(mesh.positions.size());
            for (std::uint32_t root = 0; root < count; root += 3) {
                for (const float radius : {0.0F, 1.5F, std::numeric_limits<float>::infinity()}) {
                    check_reach(surface_reach(mesh.positions, around, root, radius), mesh);
                    check_reach(surface_reach(mesh.positions, around, root, radius, glm::mat3(1e-30F)), mesh);
                }
                check_reach(edge_reach(around, root, 3), mesh);
            }
            CHECK(is_refused([&] { (void)surface_reach(mesh.positions, around, count, 1.0F); }, "root"));
            CHECK(is_refused([&] { (void)edge_reach(around, count, 1); }, "root"));
            if (count > 1) {
                CHECK(is_refused([&] { (void)surface_reach(mesh.positions, around, 0, -1.0F); }, "radius"));
                const mesh::Neighbours wired(count, mesh.triangles, wires);
                check_reach(surface_reach(mesh.positions, wired, 1, 2.0F), mesh);
            }
        });
        CHECK(was_made == mesh.are_indices);
    }
}

TEST_CASE("a zoo of meshes is pulled, deformed and boxed to finite places", "[zoo]") {
    for (const ZooMesh& mesh : mesh_zoo()) {
        CAPTURE(mesh.name);
        std::vector<glm::vec3> out(mesh.positions.size());
        sculpt::Dab dab{.root = glm::vec3(0.1F), .displacement = {0.0F, 0.0F, 1.0F}, .radius = 2.0F};
        dab.mirror = 1;
        std::vector<std::uint32_t> all(mesh.positions.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
        for (const float radius : {1e-38F, 2.0F, 3e38F}) {
            dab.radius = radius;
            CHECK(returns([&] { sculpt::pull(mesh.positions, dab, {}, out); }) == mesh.is_finite);
            if (mesh.is_finite) CHECK(all_finite(out));
            CHECK(returns([&] { sculpt::pull_among(mesh.positions, dab, all, {}, out); }) == mesh.is_finite);
        }
        if (mesh.are_indices && mesh.is_finite && !mesh.positions.empty()) {
            const auto around = mesh::Neighbours::of_triangles(mesh.positions.size(), mesh.triangles);
            const std::vector<mesh::Reach> reaches(2, surface_reach(mesh.positions, around, 0, 3.0F));
            dab.radius = 2.0F;
            CHECK(returns([&] { sculpt::pull_along(mesh.positions, dab, reaches, {}, out); }));
            CHECK(all_finite(out));
        }

        const lattice::Lattice lattice{.axes = glm::dmat3(2.0), .resolution = {3, 3, 3}};
        const std::vector<glm::vec3> moves(27, glm::vec3(0.1F));
        lattice::deform(lattice, moves, {}, mesh.positions, out);
        if (mesh.is_finite) CHECK(all_finite(out));
        const bool was_boxed = returns([&] {
            const lattice::OrientedBox box = lattice::small_box(mesh.positions, glm::dmat3(1.0));
            CHECK((is_finite(box.center) && is_finite(box.axes) && is_finite(box.size)));
            CHECK((box.size.x >= 0.0 && box.size.y >= 0.0 && box.size.z >= 0.0));
        });
        CHECK(was_boxed == mesh.is_finite);
    }
}

TEST_CASE("a zoo of meshes is refined or refused", "[zoo]") {
    for (const ZooMesh& mesh : mesh_zoo()) {
        CAPTURE(mesh.name);
        for (const double longest : {0.3, 1e-300, infinity, 0.0, -1.0, not_a_number}) {
            const bool was_refined = returns([&] {
                const mesh::Refined refined = mesh::refine(mesh.positions, mesh.triangles, longest, 3000);
                CHECK(all_finite(refined.positions));
                CHECK(refined.positions.size() <= 3000);
            });
            if (was_refined) CHECK((mesh.is_finite && mesh.are_indices && longest > 0.0));
        }
    }
}

TEST_CASE("snow on a zoo of meshes has a finite height", "[zoo]") {
    for (const ZooMesh& mesh : mesh_zoo()) {
        CAPTURE(mesh.name);
        const bool was_made = returns([&] {
            const snow::Snow snow(falling_on(mesh));
            for (const int smoothing : {0, 5}) {
                const snow::Cover cover(
                    snow, {.end = 5.0, .flake_volume = 1e-3, .repose = 0.3, .smoothing = smoothing}, 1);
                std::vector<float> heights(cover.vertex_count());
                cover.heights(5.0, heights, 1);
                double volume = 0.0;
                for (std::size_t i = 0; i < heights.size(); ++i) {
                    CHECK((std::isfinite(heights[i]) && heights[i] >= 0.0F));
                    volume += static_cast<double>(heights[i]) * cover.areas()[i];
                }
                // Meshes so large that their heights vanish in single precision are not hit.
                if (size_of(mesh) < 1e9)
                    CHECK(volume == Approx(cover.volume(5.0)).epsilon(1e-4).margin(1e-30));
                const snow::SnowLayer layer(mesh.positions, mesh.triangles, {0.0, 0.0, 1.0});
                for (const float steepest : {1.0F, std::numeric_limits<float>::infinity()}) {
                    const snow::SnowLayer::Mesh lying = layer.at(heights, 0.01F, steepest);
                    CHECK(all_finite(lying.positions));
                }
            }
            const snow::Living living = snow.living(5.0, 1);
            std::vector<glm::vec3> places(living.count()), velocities(living.count());
            snow.evaluate(living, {.position = places, .velocity = velocities}, 1);
            CHECK(all_finite(places));
            CHECK(all_finite(velocities));
        });
        CHECK(was_made == (mesh.is_finite && mesh.are_indices));
    }
}

TEST_CASE("flakes leave a zoo of meshes at finite places", "[zoo]") {
    for (const ZooMesh& mesh : mesh_zoo()) {
        CAPTURE(mesh.name);
        snow::SnowSettings settings;
        settings.shape = snow::Shape::surface;
        settings.surface_positions = mesh.positions;
        settings.surface_triangles = mesh.triangles;
        settings.rate = 200.0;
        const bool was_made = returns([&] {
            const snow::Snow snow(settings);
            const snow::Living living = snow.living(2.0, 1);
            std::vector<glm::vec3> places(living.count());
            snow.evaluate(living, {.position = places}, 1);
            CHECK(all_finite(places));
        });
        CHECK(was_made == (mesh.is_finite && mesh.are_indices && mesh.has_area));
    }
}

TEST_CASE("a zoo of meshes is walked on", "[zoo]") {
    for (const ZooMesh& mesh : mesh_zoo()) {
        CAPTURE(mesh.name);
        const bool was_made = returns([&] {
            const walker::Ground ground(mesh.positions, mesh.triangles, std::nullopt, 1);
            walker::Way way;
            for (int i = 0; i < 20; ++i) {
                way.times.push_back(0.1 * i);
                way.poses.push_back(glm::translate(glm::dmat4(1.0), glm::dvec3(0.15 * i - 1.5, 0.0, 0.5)));
            }
            way.rest = {{0.3, 0.3, -0.5}, {-0.3, 0.3, -0.5}, {0.3, -0.3, -0.5}, {-0.3, -0.3, -0.5}};
            way.phases = {0.0, 0.5, 0.5, 0.0};
            walker::WalkSettings settings;
            settings.hips = {{0.2, 0.2, 0.0}, {-0.2, 0.2, 0.0}, {0.2, -0.2, 0.0}, {-0.2, -0.2, 0.0}};
            settings.lengths = {1.0, 1.0, 1.0, 1.0};
            const walker::Walker walker(way, settings, &ground, 1);
            for (const double time : {-1.0, 0.0, 0.55, 1.3, 9.0}) {
                for (std::size_t leg = 0; leg < 4; ++leg) {
                    const walker::Foot foot = walker.foot(leg, time);
                    CHECK((is_finite(foot.position) && is_finite(foot.normal)));
                }
                const walker::Correction body = walker.body(time);
                CHECK((is_finite(body.offset) && is_finite(body.rotation)));
            }
        });
        CHECK(was_made == mesh.are_indices);
    }
}
