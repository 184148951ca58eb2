// Meshes to pick from, and the plain way to find what a Picker finds.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "motus/core/numeric.hpp"
#include "motus/mesh/picker.hpp"
#include "random.hpp"

namespace motus::mesh::checks {

class Dice : public test::Random {
  public:
    using Random::Random;
    [[nodiscard]] int index(std::size_t count) { return static_cast<int>(below(count)); }
};

struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::ivec3> triangles;
};

/// A sheet of side x side vertices at whole numbers, z = 0.
[[nodiscard]] inline Mesh sheet(int side) {
    Mesh mesh{"flat sheet", {}, {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) mesh.positions.emplace_back(x, y, 0);
    for (int y = 0; y + 1 < side; ++y) {
        for (int x = 0; x + 1 < side; ++x) {
            const int i = y * side + x;
            mesh.triangles.emplace_back(i, i + 1, i + side);
            mesh.triangles.emplace_back(i + side + 1, i + side, i + 1);
        }
    }
    return mesh;
}

/// A closed sphere around the origin with two poles.
[[nodiscard]] inline Mesh sphere(int rings, int around) {
    Mesh mesh{"sphere", {}, {}};
    constexpr double pi = 3.14159265358979323846;
    for (int ring = 1; ring < rings; ++ring) {
        for (int i = 0; i < around; ++i) {
            const double polar = pi * ring / rings, turn = 2.0 * pi * i / around;
            mesh.positions.emplace_back(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                        std::cos(polar));
        }
    }
    const int top = static_cast<int>(mesh.positions.size()), bottom = top + 1, last = top - around;
    mesh.positions.emplace_back(0, 0, 1);
    mesh.positions.emplace_back(0, 0, -1);
    for (int i = 0; i < around; ++i) {
        const int next = (i + 1) % around;
        mesh.triangles.emplace_back(top, i, next);
        mesh.triangles.emplace_back(bottom, last + next, last + i);
        for (int ring = 0; ring + 2 < rings; ++ring) {
            const int a = ring * around + i, b = ring * around + next;
            mesh.triangles.emplace_back(a, a + around, b);
            mesh.triangles.emplace_back(b, a + around, b + around);
        }
    }
    return mesh;
}

/// The sphere with two ears, a brow and hollows: overhangs, and triangles of very different sizes.
[[nodiscard]] inline Mesh blob() {
    Mesh mesh = sphere(40, 60);
    mesh.name = "blob with ears";
    for (glm::vec3& p : mesh.positions) {
        const glm::vec3 side(std::copysign(1.0f, p.x), 0, 0);
        const float ear = std::max(0.0f, std::abs(p.x) - 0.8f);
        const float eye =
            std::exp(-40.0f * glm::dot(p - glm::vec3(0.3f, -0.9f, 0.3f), p - glm::vec3(0.3f, -0.9f, 0.3f)));
        p = p * (1.0f + 0.1f * std::sin(9.0f * p.z) - 0.7f * eye) + 5.0f * ear * side +
            glm::vec3(0, 12.0f * ear * ear, 0);
    }
    return mesh;
}

/// All that should not trouble a Picker.
[[nodiscard]] inline std::vector<Mesh> troubling_meshes() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    inf = std::numeric_limits<float>::infinity();
    Dice dice(7);
    std::vector<Mesh> meshes;
    meshes.push_back({"nothing", {}, {}});
    meshes.push_back({"one vertex", {{1, 2, 3}}, {}});
    meshes.push_back({"one triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    meshes.push_back({"a triangle of one vertex", {{0, 0, 0}, {1, 0, 0}}, {{1, 1, 1}, {0, 1, 0}}});
    meshes.push_back(sheet(24));
    for (const int axis : {0, 1}) {
        Mesh turned = sheet(17);
        turned.name = axis == 0 ? "sheet across x" : "sheet across y";
        for (glm::vec3& p : turned.positions) std::swap(p[axis], p.z);
        meshes.push_back(turned);
    }
    meshes.push_back(sphere(20, 31));
    meshes.push_back(blob());

    Mesh soup{"soup", {}, {}};
    for (int i = 0; i < 500; ++i) soup.positions.push_back(dice.in_cube(1.0f));
    for (int i = 0; i < 900; ++i)
        soup.triangles.push_back({dice.index(500), dice.index(500), dice.index(500)});
    meshes.push_back(soup);

    Mesh folded = sheet(40);
    folded.name = "sheet folded in layers";
    for (glm::vec3& p : folded.positions) {
        const int layer = static_cast<int>(p.x) / 10;
        const float along = p.x - 10.0f * static_cast<float>(layer);
        p = {layer % 2 == 0 ? along : 10.0f - along, p.y, 0.01f * static_cast<float>(layer)};
    }
    meshes.push_back(folded);

    Mesh book = sheet(9);
    book.name = "pages on one edge, some twice";
    for (int page = 0; page < 20; ++page) {
        book.positions.emplace_back(dice.in_cube(4.0f));
        const int tip = static_cast<int>(book.positions.size()) - 1;
        book.triangles.emplace_back(40, 41, tip);
        book.triangles.emplace_back(tip, 41, 40);
    }
    meshes.push_back(book);

    Mesh fan{"fan around a hub", {{0, 0, 1}}, {}};
    for (int i = 0; i < 700; ++i)
        fan.positions.emplace_back(std::cos(0.009f * static_cast<float>(i)),
                                   std::sin(0.009f * static_cast<float>(i)), 0);
    for (int i = 1; i < 700; ++i) fan.triangles.emplace_back(0, i, i + 1);
    meshes.push_back(fan);

    Mesh loose = sheet(12);
    loose.name = "sheet among loose vertices";
    for (int i = 0; i < 300; ++i) loose.positions.push_back(dice.in_cube(20.0f));
    std::reverse(loose.positions.begin(), loose.positions.end());
    for (glm::ivec3& t : loose.triangles) t = glm::ivec3(static_cast<int>(loose.positions.size()) - 1) - t;
    meshes.push_back(loose);

    Mesh flattened = sheet(20);
    flattened.name = "sheet with rows squeezed to nothing";
    for (glm::vec3& p : flattened.positions) p.y = std::floor(p.y / 3.0f);
    meshes.push_back(flattened);

    Mesh doubled = blob();
    doubled.name = "blob twice in one place";
    const auto count = static_cast<int>(doubled.positions.size());
    doubled.positions.insert(doubled.positions.end(), doubled.positions.begin(),
                             doubled.positions.begin() + count);
    for (std::size_t i = 0, end = doubled.triangles.size(); i < end; ++i)
        doubled.triangles.push_back(doubled.triangles[i] + count);
    meshes.push_back(doubled);

    Mesh dot = sphere(10, 12);
    dot.name = "all in one point";
    for (glm::vec3& p : dot.positions) p = {3, 4, 5};
    meshes.push_back(dot);

    for (const float scale : {1e15f, 1e-15f}) {
        Mesh scaled = blob();
        scaled.name = scale > 1.0f ? "huge" : "tiny";
        for (glm::vec3& p : scaled.positions) p *= scale;
        meshes.push_back(scaled);
    }
    Mesh far = blob();
    far.name = "far from the origin";
    for (glm::vec3& p : far.positions) p += glm::vec3(1e4f, -2e4f, 5e3f);
    meshes.push_back(far);

    Mesh stray = blob();
    stray.name = "blob with a stray vertex";
    stray.positions.emplace_back(1e9f, -1e9f, 1e9f);
    meshes.push_back(stray);

    Mesh broken = blob();
    broken.name = "with vertices that are not finite";
    for (std::size_t i = 5; i < broken.positions.size(); i += 37)
        broken.positions[i][dice.index(3)] = i % 3 == 0 ? nan : i % 3 == 1 ? inf : -inf;
    meshes.push_back(broken);
    return meshes;
}

/// The bounding cube's centre and half its side, of what is finite.
struct Extent {
    glm::vec3 centre{0.0f};
    float size = 1.0f;
};
[[nodiscard]] inline Extent extent(const Mesh& mesh) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : mesh.positions) {
        if (!is_finite(p)) continue;
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    if (!(low.x <= high.x)) return {};
    const glm::vec3 half = 0.5f * high - 0.5f * low;
    const float size = std::max({half.x, half.y, half.z});
    return {0.5f * low + 0.5f * high, size > 0.0f ? size : 1.0f};
}

[[nodiscard]] inline double distance_to(const Mesh& mesh, std::size_t vertex, const glm::vec3& point,
                                        const glm::mat3& metric = glm::mat3(1.0f)) {
    return glm::length(glm::dmat3(metric) * (glm::dvec3(mesh.positions[vertex]) - glm::dvec3(point)));
}

/// Barycentric weights and distance (of a direction of length 1) by Cramer's rule in long double; nothing for
/// a ray in the triangle's plane and triangles without area.
struct PlainHit {
    double least_weight;  ///< >= 0 inside
    double distance;
};
[[nodiscard]] inline std::optional<PlainHit> plain_hit(const Mesh& mesh, std::size_t triangle,
                                                       const glm::dvec3& origin,
                                                       const glm::dvec3& direction) {
    using Vector = glm::vec<3, long double>;
    const glm::ivec3& t = mesh.triangles[triangle];
    const auto corner = [&](int i) { return Vector(mesh.positions[static_cast<std::size_t>(t[i])]); };
    const Vector a = corner(0), e1 = corner(1) - a, e2 = corner(2) - a, d(direction), o(origin);
    const Vector p = glm::cross(d, e2);
    const long double det = glm::dot(e1, p), size = glm::length(e1) * glm::length(e2);
    if (!(std::abs(det) > 1e-9L * size)) return {};
    const Vector s = o - a, q = glm::cross(s, e1);
    const long double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
    return PlainHit{static_cast<double>(std::min({u, v, 1.0L - u - v})),
                    static_cast<double>(glm::dot(e2, q) / det)};
}

}  // namespace motus::mesh::checks
