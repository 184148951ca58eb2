#include "holding.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "motus/core/numeric.hpp"
#include "motus/core/parallel.hpp"

namespace motus::snow {
namespace {

/// A fraction of an edge that leaves no slivers.
[[nodiscard]] float within(double fraction) {
    constexpr double least = 0.02;
    return static_cast<float>(std::clamp(fraction, least, 1.0 - least));
}

}  // namespace

Holding holding_of(std::span<const glm::vec3> positions, std::span<const glm::ivec3> triangles,
                   const Collider& shelter, const glm::dvec3& up, double steepest, std::size_t threads) {
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
            for (std::size_t i = first; i < last; ++i) {
                const double length = length_of(normals[i]);
                const double along = glm::dot(normals[i], up);
                const double aside = length_of(normals[i] - along * up);
                found.margins[i] = length > 0.0 ? (steepest * along - aside) / length : 0.0;
                if (!(along > 0.0)) found.margins[i] = std::min(found.margins[i], 0.0);
                if (found.holds(i))
                    found.is_sheltered[i] = is_under(shelter, glm::dvec3(positions[i]), up) ? 1 : 0;
            }
        },
        threads);
    return found;
}

std::optional<float> end_on_edge(const Holding& holding, std::span<const glm::vec3> positions,
                                 const Collider& shelter, const glm::dvec3& up, std::size_t from,
                                 std::size_t to) {
    const double a = holding.margins[from], b = holding.margins[to];
    if (!(a > 0.0) && !(b > 0.0)) return {};
    if (!(a > 0.0) || !(b > 0.0)) return within(a / (a - b));
    if (holding.is_sheltered[from] == holding.is_sheltered[to]) return {};
    const glm::dvec3 start(positions[from]), way = glm::dvec3(positions[to]) - start;
    double least = 0.0, most = 1.0;
    constexpr int halvings = 12;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (least + most);
        const bool is_as_start =
            is_under(shelter, start + middle * way, up) == (holding.is_sheltered[from] != 0);
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
