// Meshes of any positions and triangles: what is found exists, and is what is found by looking at all.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "bytes.hpp"
#include "motus/core/numeric.hpp"
#include "motus/mesh/neighbours.hpp"
#include "motus/mesh/picker.hpp"
#include "motus/mesh/refine.hpp"
#include "motus/mesh/surface_distance.hpp"
#include "reads_mesh.hpp"
#include "targets.hpp"

namespace motus::fuzzers {

namespace {

void pick(Bytes& bytes, const Mesh& mesh, const mesh::Picker& picker) {
    const glm::dvec3 origin = bytes.place(), direction = bytes.place(1.0);
    const auto hit = picker.ray(origin, direction);
    if (hit) {
        expect(hit->triangle < mesh.triangles.size(), "ray: a triangle that there is");
        expect(is_finite(hit->point), "ray: a finite place");
        expect(std::isfinite(hit->distance) && hit->distance >= 0.0, "ray: a finite distance");
        expect(picker.nearest_seen(*hit, direction) < mesh.positions.size(),
               "nearest_seen: a vertex that there is");
    }
    const mesh::Picker anew(mesh.positions, mesh.triangles, 1);
    const auto again = anew.ray(origin, direction);
    expect(hit.has_value() == again.has_value(), "ray: the same by a tree that is new");
    if (hit)
        expect(hit->triangle == again->triangle && hit->distance == again->distance,
               "ray: the same triangle");
}

void look_around(Bytes& bytes, const Mesh& mesh, const mesh::Picker& picker) {
    const glm::vec3 point = bytes.single_place();
    const auto nearest = picker.nearest(point);
    if (nearest) expect(is_finite(mesh.positions.at(*nearest)), "nearest: a vertex that is somewhere");
    const float radius = bytes.single(0.0, 3.0);
    const std::vector<std::uint32_t> within = picker.within(point, radius);
    expect(std::ranges::is_sorted(within), "within: rising");
    for (const std::uint32_t vertex : within)
        expect(is_finite(mesh.positions.at(vertex)), "within: vertices that are somewhere");
    if (!is_finite(point) || !std::isfinite(radius) || radius < 0.0F) return;
    for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        const double distance = length_of(glm::dvec3(mesh.positions[vertex]) - glm::dvec3(point));
        if (distance < radius * 0.999)
            expect(std::ranges::binary_search(within, vertex), "within: all of them");
    }
}

void measure(Bytes& bytes, const Mesh& mesh) {
    const mesh::Neighbours around(mesh.positions.size(), mesh.triangles, mesh.wires, 1);
    const std::uint32_t root = bytes.byte() % 16;
    const float radius = bytes.single(0.0, 5.0);
    const std::uint32_t steps = bytes.byte() % 8;
    for (const bool along_edges : {false, true})
        returns([&] {
            const mesh::Reach reach = along_edges ? edge_reach(around, root, steps)
                                                  : surface_reach(mesh.positions, around, root, radius);
            expect(reach.vertices.size() == reach.distances.size(), "reach: a distance for each vertex");
            expect(std::ranges::is_sorted(reach.vertices), "reach: rising");
            for (const std::uint32_t vertex : reach.vertices)
                expect(vertex < mesh.positions.size(), "reach: vertices that there are");
            for (const float distance : reach.distances)
                expect(std::isfinite(distance) && distance >= 0.0F, "reach: finite distances");
        });
}

}  // namespace

void try_mesh(std::span<const std::uint8_t> data) {
    Bytes bytes(data);
    Mesh mesh(bytes);
    returns([&] {
        mesh::Picker picker(mesh.positions, mesh.triangles, 1);
        pick(bytes, mesh, picker);
        look_around(bytes, mesh, picker);
        for (glm::vec3& position : mesh.positions)
            if (bytes.byte() % 4 == 1) position = bytes.single_place();
        picker.refit(mesh.positions);
        for (int round = 0; round < 3; ++round) pick(bytes, mesh, picker);
        look_around(bytes, mesh, picker);
    });
    returns([&] { measure(bytes, mesh); });
    const double longest = bytes.number(0.0, 3.0);
    returns([&] {
        const mesh::Refined refined = mesh::refine(mesh.positions, mesh.triangles, longest, 500);
        expect(refined.positions.size() <= 500, "refine: no more vertices than are allowed");
        for (const glm::vec3& position : refined.positions)
            expect(is_finite(position), "refine: finite places");
    });
}

}  // namespace motus::fuzzers
