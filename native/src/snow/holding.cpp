#include "holding.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "motus/core/parallel.hpp"

namespace motus::snow {
namespace {

/// A fraction of an edge that leaves no slivers.
[[nodiscard]] float within(double fraction) {
    constexpr double least = 0.02;
    return static_cast<float>(std::clamp(fraction, least, 1.0 - least));
}

}  // namespace

bool Shelter::is_over(const glm::dvec3& place) {
    const glm::dvec3 start = place + clear * up_;
    if (last_ && is_last_over(start)) return true;
    const auto found = collider_->below(start, up_);
    if (!found) return false;
    last_ = found->triangle;
    return true;
}

/// Whether the last triangle is over a place beyond doubt, and not by a rounding.
bool Shelter::is_last_over(const glm::dvec3& start) const {
    constexpr double least_share = 1e-6;
    const glm::ivec3& corners = collider_->triangles()[*last_];
    const auto off = [&](int corner) {
        return glm::dvec3(collider_->positions()[static_cast<std::size_t>(corner)]) - start;
    };
    const glm::dvec3 a = off(corners.x), b = off(corners.y), c = off(corners.z);
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double whole = glm::dot(across, up_);
    const auto has_share = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(from, to), up_) / whole > least_share;
    };
    return whole != 0.0 && has_share(a, b) && has_share(b, c) && has_share(c, a) &&
           glm::dot(a, across) / whole > clear;
}

Holding holding_of(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                   const Collider& shelter, const glm::dvec3& up, double steepest, const Executor& executor) {
    const auto place = [&](int vertex) { return glm::dvec3(positions[static_cast<std::size_t>(vertex)]); };
    std::vector<glm::dvec3> normals(positions.size());
    for (const glm::ivec3& corners : triangles) {
        glm::dvec3 across =
            glm::cross(place(corners.y) - place(corners.x), place(corners.z) - place(corners.x));
        if (glm::dot(across, up) < 0.0) across = -across;
        for (int corner = 0; corner < 3; ++corner)
            normals[static_cast<std::size_t>(corners[corner])] += across;
    }
    Holding found{std::vector<double>(positions.size()), std::vector<std::uint8_t>(positions.size())};
    constexpr std::size_t grain = 1024;
    in_parts(
        positions.size(), grain,
        [&](std::size_t first, std::size_t last) {
            Shelter above(shelter, up);
            for (std::size_t i = first; i < last; ++i) {
                // Squares of what comes from floats are within the range of doubles.
                const double length = glm::length(normals[i]);
                const double along = glm::dot(normals[i], up);
                const double aside = glm::length(normals[i] - along * up);
                found.margins[i] = length > 0.0 ? (steepest * along - aside) / length : 0.0;
                if (!(along > 0.0)) found.margins[i] = std::min(found.margins[i], 0.0);
                if (found.holds(i)) found.is_sheltered[i] = above.is_over(glm::dvec3(positions[i])) ? 1 : 0;
            }
        },
        executor);
    return found;
}

std::optional<float> end_on_edge(const Holding& holding, std::span<const glm::vec3> positions,
                                 Shelter& shelter, std::size_t from, std::size_t to) {
    const double a = holding.margins[from], b = holding.margins[to];
    if (!(a > 0.0) && !(b > 0.0)) return {};
    if (!(a > 0.0) || !(b > 0.0)) return within(a / (a - b));
    if (holding.is_sheltered[from] == holding.is_sheltered[to]) return {};
    const glm::dvec3 start(positions[from]), way = glm::dvec3(positions[to]) - start;
    double least = 0.0, most = 1.0;
    constexpr int halvings = 12;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (least + most);
        const bool is_as_start = shelter.is_over(start + middle * way) == (holding.is_sheltered[from] != 0);
        (is_as_start ? least : most) = middle;
    }
    return within(0.5 * (least + most));
}

std::array<double, 3> shown_parts(const std::array<std::optional<float>, 3>& ends) {
    std::array<double, 3> parts{1.0, 1.0, 1.0};
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t next = (corner + 1) % 3, last = (corner + 2) % 3;
        const auto after = ends.at(corner), across = ends.at(next), before = ends.at(last);
        if (after && before) {  // alone on its side
            parts.at(corner) = static_cast<double>(*after) * (1.0 - static_cast<double>(*before));
        } else if (before && across) {  // with the next corner: the first of a quadrilateral's
            const double reach = 1.0 - static_cast<double>(*before);
            parts.at(corner) = static_cast<double>(*across) + reach * (1.0 - static_cast<double>(*across));
        } else if (after && across) {  // with the one before
            parts.at(corner) = static_cast<double>(*after);
        }
    }
    return parts;
}

}  // namespace motus::snow
