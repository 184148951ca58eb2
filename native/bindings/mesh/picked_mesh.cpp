#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "arrays.hpp"
#include "core/arguments.hpp"
#include "motus/core/numeric.hpp"
#include "motus/mesh/surface_distance.hpp"
#include "picker.hpp"

namespace motus::bindings {
namespace {

constexpr std::size_t copy_grain = 1 << 17;  // vertices: some 50 us of copying

/// A box around positions that are all finite.
struct Box {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    void add(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void add(const Box& box) {
        low = glm::min(low, box.low);
        high = glm::max(high, box.high);
    }
};

/// Copies positions, and says what box they fill. They have been checked, but another thread may have written
/// into the caller's array since: of a vertex that is not finite any more the old position stays.
[[nodiscard]] Box take_over(std::span<const glm::vec3> from, std::vector<glm::vec3>& to) {
    to.resize(from.size());
    Box box;
    std::mutex joining;
    in_parts(from.size(), copy_grain, [&](std::size_t first, std::size_t last) {
        Box part;
        for (std::size_t i = first; i < last; ++i) {
            const glm::vec3 point = from[i];
            if (is_finite(point)) to[i] = point;
            part.add(to[i]);
        }
        const std::scoped_lock lock(joining);
        box.add(part);
    });
    return box;
}

[[nodiscard]] mesh::Reach straight_reach(std::span<const glm::vec3> positions,
                                         std::vector<std::uint32_t> vertices, const glm::vec3& root,
                                         const glm::mat3& metric) {
    mesh::Reach reach;
    reach.distances.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices)
        reach.distances.push_back(glm::length(metric * (positions[vertex] - root)));
    reach.vertices = std::move(vertices);
    return reach;
}

}  // namespace

Distance distance_argument(py::handle object) {
    return choice<Distance>(
        object, "distance",
        {{"straight", Distance::straight}, {"surface", Distance::surface}, {"edges", Distance::edges}});
}

unsigned mirror_argument(py::handle object) {
    if (!py::isinstance<py::str>(object)) wrong_type(object, "mirror", "a string");
    unsigned bits = 0;
    for (const char letter : object.cast<std::string>()) {
        if (letter != 'x' && letter != 'y' && letter != 'z')
            value_error("mirror", "must be made of the letters 'x', 'y' and 'z'");
        bits |= 1u << static_cast<unsigned>(letter - 'x');
    }
    return bits;
}

Root root_argument(py::handle object, std::size_t count) {
    const bool is_index = PyIndex_Check(object.ptr()) != 0 && !py::isinstance<py::array>(object);
    if (!is_index) return {float_vector(object, "root"), {}};
    const int index = whole_number(object, "root");
    if (index < 0 || static_cast<std::size_t>(index) >= count)
        value_error("root", "must be the index of a vertex, below " + std::to_string(count));
    return {glm::vec3(0.0f), static_cast<std::uint32_t>(index)};
}

mesh::Reach reach_along(std::span<const glm::vec3> positions, const mesh::Neighbours& neighbours,
                        std::uint32_t root, float radius, Distance distance, const glm::mat3& metric) {
    if (distance == Distance::surface)
        return mesh::surface_reach(positions, neighbours, root, radius, metric);
    constexpr float most = 1e9f;  // no mesh has as many, and an integer holds it
    return mesh::edge_reach(neighbours, root, static_cast<std::uint32_t>(std::min(radius, most)));
}

PickedMesh::PickedMesh(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                       std::optional<std::span<const glm::ivec2>> edges)
    : tree_(positions, triangles),
      triangles_(triangles.begin(), triangles.end()),
      has_edges_(edges.has_value()) {
    const Box box = take_over(positions, positions_);
    low_ = box.low;
    high_ = box.high;
    if (edges) edges_.assign(edges->begin(), edges->end());
}

std::optional<mesh::Hit> PickedMesh::ray(const glm::dvec3& origin, const glm::dvec3& direction) const {
    const std::shared_lock lock(mutex_);
    return tree_.ray(origin, direction);
}

std::optional<mesh::Hit> PickedMesh::ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                         std::span<const glm::vec3> positions, float slack) const {
    const std::shared_lock lock(mutex_);
    return tree_.ray(origin, direction, positions, slack);
}

std::optional<Pick> PickedMesh::pick(const glm::dvec3& origin, const glm::dvec3& direction,
                                     std::span<const std::uint8_t> hidden, const glm::mat3& metric,
                                     std::span<const glm::vec3> positions, std::optional<float> slack) const {
    const std::shared_lock lock(mutex_);
    const std::optional<mesh::Hit> hit =
        slack ? tree_.ray(origin, direction, positions, *slack) : tree_.ray(origin, direction);
    if (!hit) return {};
    return Pick{*hit, slack ? tree_.nearest_seen(*hit, direction, positions, *slack, hidden, metric)
                            : tree_.nearest_seen(*hit, direction, hidden, metric)};
}

std::optional<std::uint32_t> PickedMesh::nearest(const glm::vec3& point) const {
    const std::shared_lock lock(mutex_);
    return tree_.nearest(point);
}

std::vector<std::uint32_t> PickedMesh::within(const glm::vec3& point, float radius,
                                              const glm::mat3& metric) const {
    const std::shared_lock lock(mutex_);
    return tree_.within(point, radius, metric);
}

glm::vec3 PickedMesh::position(std::uint32_t vertex) const {
    const std::shared_lock lock(mutex_);
    return positions_[vertex];
}

std::vector<mesh::Reach> PickedMesh::reaches(const sculpt::Dab& dab, const Root& root,
                                             Distance distance) const {
    const mesh::Neighbours* around = distance == Distance::straight ? nullptr : &neighbours();
    const std::shared_lock lock(mutex_);
    std::vector<mesh::Reach> result;
    for (const sculpt::PullImage& image : sculpt::images_of(dab)) {
        if (distance == Distance::straight) {
            std::vector<std::uint32_t> vertices = tree_.within(image.root, dab.radius, dab.metric);
            result.push_back(straight_reach(positions_, std::move(vertices), image.root, dab.metric));
        } else {
            const std::uint32_t vertex = result.empty() ? *root.vertex : *tree_.nearest(image.root);
            result.push_back(reach_along(positions_, *around, vertex, dab.radius, distance, dab.metric));
        }
    }
    return result;
}

void PickedMesh::refit(std::span<const glm::vec3> positions) {
    const std::scoped_lock lock(mutex_);
    const Box box = take_over(positions, positions_);
    low_ = box.low;
    high_ = box.high;
    tree_.refit(positions_);
}

void PickedMesh::refit(std::span<const glm::vec3> positions, std::span<const std::uint32_t> moved) {
    const std::scoped_lock lock(mutex_);
    for (const std::uint32_t vertex : moved) {
        const glm::vec3 point = positions[vertex];
        if (is_finite(point)) positions_[vertex] = point;
        low_ = glm::min(low_, positions_[vertex]);
        high_ = glm::max(high_, positions_[vertex]);
    }
    tree_.refit(positions_, moved);
}

const mesh::Neighbours& PickedMesh::neighbours() const {
    std::call_once(neighbours_made_, [&] {
        if (has_edges_)
            neighbours_.emplace(vertex_count(), triangles_, edges_);
        else
            neighbours_ = mesh::Neighbours::of_triangles(vertex_count(), triangles_);
        triangles_ = {};
        edges_ = {};
    });
    return *neighbours_;
}

float PickedMesh::extent(const glm::mat3& metric) const {
    const std::shared_lock lock(mutex_);
    const glm::vec3 sides = high_ - low_;
    return std::max({sides.x * glm::length(metric[0]), sides.y * glm::length(metric[1]),
                     sides.z * glm::length(metric[2])});
}

}  // namespace motus::bindings
