#include "motus/lattice/lattice.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "motus/core/numeric.hpp"
#include "taps.hpp"

namespace motus::lattice {
namespace {

constexpr double cardinal_tension = 0.71;
constexpr double catmull_rom_tension = 0.5;

[[nodiscard]] bool is_small(const glm::dvec3& v) {
    constexpr double most = 1e100;
    return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

/// Whether the volume that the columns span is more than rounding of their lengths.
[[nodiscard]] bool are_independent(const glm::dmat3& axes) {
    constexpr double least = 1e-12;
    const glm::dvec3 u = axes[0] / glm::length(axes[0]);
    const glm::dvec3 v = axes[1] / glm::length(axes[1]);
    const glm::dvec3 w = axes[2] / glm::length(axes[2]);
    return std::abs(glm::dot(u, glm::cross(v, w))) > least;  // false for NaN, the direction of no length
}

/// Weights of the four points around a place at t in [0, 1] between the middle two.
[[nodiscard]] std::array<double, 4> cubic_weights(Basis basis, double t) {
    const double s = 1.0 - t;
    if (basis == Basis::linear) return {0.0, s, t, 0.0};
    if (basis == Basis::bspline) {
        constexpr double sixth = 1.0 / 6.0;
        return {sixth * s * s * s, sixth * (4.0 - 6.0 * t * t + 3.0 * t * t * t),
                sixth * (4.0 - 6.0 * s * s + 3.0 * s * s * s), sixth * t * t * t};
    }
    // Hermite's cubic whose tangents are c times the way from the point before to the one after.
    const double c = basis == Basis::cardinal ? cardinal_tension : catmull_rom_tension;
    const double from = s * s * (1.0 + 2.0 * t), to = t * t * (1.0 + 2.0 * s);
    const double leave = c * t * s * s, arrive = c * t * t * s;
    return {-leave, from + arrive, to + leave, -arrive};
}

void add_bernstein(Taps& taps, int points, double coordinate) {
    const double t = std::clamp(coordinate, 0.0, 1.0), s = 1.0 - t;
    std::array<double, max_resolution> value{1.0};
    for (std::size_t degree = 1; degree < static_cast<std::size_t>(points); ++degree) {
        value[degree] = t * value[degree - 1];
        for (std::size_t i = degree - 1; i > 0; --i) value[i] = s * value[i] + t * value[i - 1];
        value[0] *= s;
    }
    for (int i = 0; i < points; ++i) taps.add(i, value[static_cast<std::size_t>(i)]);
}

}  // namespace

Grid::Grid(const Lattice& lattice)
    : origin_(lattice.origin), to_coordinates_(1.0), resolution_(lattice.resolution), basis_(lattice.basis) {
    for (const int points : resolution_) {
        require(points >= 1 && points <= max_resolution, "resolution: must be 1 to 64 points along an axis");
    }
    require(is_small(lattice.origin), "origin: must be finite, and 1e100 at most");
    require(is_small(lattice.axes[0]) && is_small(lattice.axes[1]) && is_small(lattice.axes[2]) &&
                are_independent(lattice.axes),
            "axes: must be finite, 1e100 at most, and independent");
    to_coordinates_ = glm::inverse(lattice.axes);
}

Taps Grid::taps(std::size_t axis, double coordinate) const {
    Taps taps;
    const int points = resolution_[axis];
    if (points == 1) {
        taps.add(0, 1.0);
        return taps;
    }
    if (basis_[axis] == Basis::bernstein) {
        add_bernstein(taps, points, coordinate);
        return taps;
    }
    // Farther out all four points are the last one. The comparison first: what is NaN becomes 0.
    const double far = points + 2.0;
    const double place = std::min(std::max(-far, coordinate * (points - 1)), far);
    const double cell = std::floor(place);
    const std::array<double, 4> weight = cubic_weights(basis_[axis], place - cell);
    const int first = static_cast<int>(cell) - 1;
    const bool linear = basis_[axis] == Basis::linear;
    for (int i = linear ? 1 : 0; i < (linear ? 3 : 4); ++i)
        taps.add(std::clamp(first + i, 0, points - 1), weight[static_cast<std::size_t>(i)]);
    return taps;
}

std::size_t point_count(const Lattice& lattice) {
    std::size_t count = 1;
    for (const int points : lattice.resolution) {
        require(points >= 1 && points <= max_resolution, "resolution: must be 1 to 64 points along an axis");
        count *= static_cast<std::size_t>(points);
    }
    return count;
}

std::vector<glm::dvec3> rest_points(const Lattice& lattice) {
    const Grid grid(lattice);
    const auto share = [&](std::size_t axis, int index) {
        const int points = grid.resolution()[axis];
        return points > 1 ? static_cast<double>(index) / (points - 1) : 0.0;
    };
    std::vector<glm::dvec3> result;
    result.reserve(point_count(lattice));
    for (int w = 0; w < lattice.resolution[2]; ++w) {
        for (int v = 0; v < lattice.resolution[1]; ++v) {
            for (int u = 0; u < lattice.resolution[0]; ++u)
                result.push_back(lattice.origin +
                                 lattice.axes * glm::dvec3(share(0, u), share(1, v), share(2, w)));
        }
    }
    return result;
}

Weights weights_at(const Lattice& lattice, const glm::dvec3& place) {
    const Grid grid(lattice);
    require(is_finite(place), "place: must be finite");
    const glm::dvec3 at = grid.coordinates(place);
    // Add up the weights by axis for each point: points beyond the ends are the last point.
    std::array<std::array<double, max_resolution>, 3> sums{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Taps taps = grid.taps(axis, at[static_cast<int>(axis)]);
        for (std::size_t i = 0; i < static_cast<std::size_t>(taps.count); ++i)
            sums[axis][static_cast<std::size_t>(taps.point[i])] += taps.weight[i];
    }
    Weights result;
    std::uint32_t index = 0;
    for (std::size_t w = 0; w < static_cast<std::size_t>(grid.resolution()[2]); ++w) {
        for (std::size_t v = 0; v < static_cast<std::size_t>(grid.resolution()[1]); ++v) {
            for (std::size_t u = 0; u < static_cast<std::size_t>(grid.resolution()[0]); ++u, ++index) {
                const double weight = sums[0][u] * sums[1][v] * sums[2][w];
                if (weight == 0.0) continue;
                result.points.push_back(index);
                result.weights.push_back(weight);
            }
        }
    }
    return result;
}

}  // namespace motus::lattice
