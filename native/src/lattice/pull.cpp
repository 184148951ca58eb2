#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "motus/core/numeric.hpp"
#include "motus/lattice/lattice.hpp"
#include "symmetric_function.hpp"

namespace motus::lattice {
namespace {

// Greatest number of weights of all pulls together; with two numbers each, 200 MB.
constexpr std::size_t most_weights = std::size_t{1} << 24;

/// How the lattice points move the point of one pull: a row of Hsu's matrix B, without its zeros.
struct Row {
    std::vector<std::uint32_t> points;  ///< ascending
    std::vector<double> weights;
};

/// A row with its zeros, for one row after the other.
using WholeRow = std::vector<double>;

[[nodiscard]] Row without_zeros(const WholeRow& whole) {
    Row row;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (whole[i] == 0.0) continue;
        row.points.push_back(static_cast<std::uint32_t>(i));
        row.weights.push_back(whole[i]);
    }
    return row;
}

[[nodiscard]] double dot(const Row& row, const WholeRow& whole) {
    double sum = 0.0;
    for (std::size_t i = 0; i < row.points.size(); ++i) sum += row.weights[i] * whole[row.points[i]];
    return sum;
}

/// Two opposite points of the outside, and the share of the way from the first to the second where a point
/// inside is.
struct Between {
    std::size_t first = 0, second = 0;
    double share = 0.0;
};

/// Calls with_inner(point, opposite) for each inner point of the lattice; opposite: the three pairs of outer
/// points in line with it. If the inside follows the outside, an inner point is the mean of its three places
/// between these, as in Blender.
template <class WithInner>
void for_inside(const Lattice& lattice, WithInner&& with_inner) {
    const std::array<int, 3> count = lattice.resolution;
    const std::array<std::size_t, 3> stride{
        1, static_cast<std::size_t>(count[0]),
        static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1])};
    std::array<int, 3> at{};
    for (at[2] = 1; at[2] + 1 < count[2]; ++at[2]) {
        for (at[1] = 1; at[1] + 1 < count[1]; ++at[1]) {
            for (at[0] = 1; at[0] + 1 < count[0]; ++at[0]) {
                std::size_t point = 0;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    point += static_cast<std::size_t>(at[axis]) * stride[axis];
                std::array<Between, 3> opposite{};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::size_t first = point - static_cast<std::size_t>(at[axis]) * stride[axis];
                    const auto last = static_cast<std::size_t>(count[axis] - 1);
                    opposite[axis] = {first, first + last * stride[axis],
                                      static_cast<double>(at[axis]) / static_cast<double>(last)};
                }
                with_inner(point, opposite);
            }
        }
    }
}

/// Adds the weights of inner points to the outer points that they follow.
void move_to_outside(const Lattice& lattice, WholeRow& row) {
    for_inside(lattice, [&](std::size_t point, const std::array<Between, 3>& opposite) {
        const double third = row[point] / 3.0;
        row[point] = 0.0;
        for (const Between& pair : opposite) {
            row[pair.first] += third * (1.0 - pair.share);
            row[pair.second] += third * pair.share;
        }
    });
}

/// Moves each inner point to the mean of its places between outer points.
void follow_outside(const Lattice& lattice, std::span<glm::dvec3> displacements) {
    for_inside(lattice, [&](std::size_t point, const std::array<Between, 3>& opposite) {
        glm::dvec3 sum(0.0);
        for (const Between& pair : opposite)
            sum += (1.0 - pair.share) * displacements[pair.first] + pair.share * displacements[pair.second];
        displacements[point] = sum / 3.0;
    });
}

struct Rows {
    std::vector<Row> influenced;
    /// Least square of a row at full influence; infinity if no lattice point moves any of the pulled
    /// vertices.
    double weakest = std::numeric_limits<double>::infinity();
};

/// Adds a part to its pull's row, as it is and at full influence.
void add_part(const Weights& weights, const Part& part, const PullOptions& options, WholeRow& influenced,
              WholeRow& full) {
    double influence = part.influence;
    if (!options.point_weights.empty()) {
        double faded = 0.0;
        for (std::size_t i = 0; i < weights.points.size(); ++i)
            faded += weights.weights[i] * static_cast<double>(options.point_weights[weights.points[i]]);
        influence *= influence * faded;
    }
    for (std::size_t i = 0; i < weights.points.size(); ++i) {
        full[weights.points[i]] += part.share * weights.weights[i];
        influenced[weights.points[i]] += part.share * influence * weights.weights[i];
    }
}

[[nodiscard]] Rows rows_of(const Lattice& lattice, std::span<const Part> parts, std::size_t pulls,
                           const PullOptions& options) {
    std::vector<std::vector<std::size_t>> parts_of(pulls);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        require(part.pull < pulls, "parts: a pull is not there");
        constexpr double most = 1e30;
        require(std::abs(part.share) <= most && std::abs(part.influence) <= most,
                "parts: shares and influences must be finite, and 1e30 at most");
        parts_of[part.pull].push_back(i);
    }
    Rows rows;
    std::size_t weights = 0;
    WholeRow influenced(point_count(lattice)), full(point_count(lattice));
    for (const std::vector<std::size_t>& own : parts_of) {
        std::fill(influenced.begin(), influenced.end(), 0.0);
        std::fill(full.begin(), full.end(), 0.0);
        for (const std::size_t i : own)
            add_part(weights_at(lattice, parts[i].place), parts[i], options, influenced, full);
        if (options.outside_only) {
            move_to_outside(lattice, influenced);
            move_to_outside(lattice, full);
        }
        const double square = std::inner_product(full.begin(), full.end(), full.begin(), 0.0);
        if (square > 0.0) rows.weakest = std::min(rows.weakest, square);
        rows.influenced.push_back(without_zeros(influenced));
        weights += rows.influenced.back().points.size();
        if (weights > most_weights)
            throw std::invalid_argument("displacements: too many for a lattice of so many points");
    }
    return rows;
}

/// The lattice points that any row moves, ascending.
[[nodiscard]] std::vector<std::uint32_t> moved_points(const std::vector<Row>& rows, std::size_t points) {
    std::vector<bool> is_moved(points, false);
    for (const Row& row : rows) {
        for (const std::uint32_t point : row.points) is_moved[point] = true;
    }
    std::vector<std::uint32_t> moved;
    for (std::size_t i = 0; i < points; ++i) {
        if (is_moved[i]) moved.push_back(static_cast<std::uint32_t>(i));
    }
    return moved;
}

void check_count(const std::vector<Row>& rows, std::size_t points) {
    if (rows.size() > max_pulls && moved_points(rows, points).size() > max_pulls)
        throw std::invalid_argument("displacements: at most " + std::to_string(max_pulls) +
                                    " are possible where the lattice has more points");
}

/// B B^T, size rows.size().
[[nodiscard]] std::vector<double> between_pulls(const std::vector<Row>& rows, std::size_t points) {
    const std::size_t size = rows.size();
    std::vector<double> matrix(size * size);
    WholeRow whole(points, 0.0);
    for (std::size_t i = 0; i < size; ++i) {
        const Row& row = rows[i];
        for (std::size_t k = 0; k < row.points.size(); ++k) whole[row.points[k]] = row.weights[k];
        for (std::size_t j = i; j < size; ++j)
            matrix[i * size + j] = matrix[j * size + i] = dot(rows[j], whole);
        for (const std::uint32_t point : row.points) whole[point] = 0.0;
    }
    return matrix;
}

/// B^T B over the points that are moved. place_of: their places among those.
[[nodiscard]] std::vector<double> between_points(const std::vector<Row>& rows, std::size_t size,
                                                 const std::vector<std::uint32_t>& place_of) {
    std::vector<double> matrix(size * size, 0.0);
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.points.size(); ++i) {
            double* to = matrix.data() + place_of[row.points[i]] * size;
            for (std::size_t j = 0; j < row.points.size(); ++j)
                to[place_of[row.points[j]]] += row.weights[i] * row.weights[j];
        }
    }
    return matrix;
}

/// Adds B^T factors.
void add_moves(const std::vector<Row>& rows, std::span<const glm::dvec3> factors, std::span<glm::dvec3> out) {
    for (std::size_t pull = 0; pull < rows.size(); ++pull) {
        const Row& row = rows[pull];
        for (std::size_t i = 0; i < row.points.size(); ++i)
            out[row.points[i]] += row.weights[i] * factors[pull];
    }
}

/// B^T (B B^T)^-1 d = (B^T B)^-1 B^T d into `out`, which is 0, by the smaller of both matrices.
void solve(const std::vector<Row>& rows, std::span<const glm::dvec3> displacements,
           const std::function<double(double)>& inverse, std::span<glm::dvec3> out) {
    const std::vector<std::uint32_t> moved = moved_points(rows, out.size());
    if (rows.size() <= moved.size()) {
        add_moves(rows, times_function(between_pulls(rows, out.size()), displacements, inverse), out);
        return;
    }
    std::vector<std::uint32_t> place_of(out.size(), 0);
    for (std::size_t i = 0; i < moved.size(); ++i) place_of[moved[i]] = static_cast<std::uint32_t>(i);
    add_moves(rows, displacements, out);
    std::vector<glm::dvec3> pulled(moved.size());
    for (std::size_t i = 0; i < moved.size(); ++i) pulled[i] = out[moved[i]];
    const auto found = times_function(between_points(rows, moved.size(), place_of), pulled, inverse);
    for (std::size_t i = 0; i < moved.size(); ++i) out[moved[i]] = found[i];
}

}  // namespace

std::vector<glm::dvec3> pull_lattice(const Lattice& lattice, std::span<const Part> parts,
                                     std::span<const glm::dvec3> displacements, const PullOptions& options,
                                     std::span<glm::dvec3> out) {
    const std::size_t points = rest_points(lattice).size();  // which checks the lattice
    require(out.size() == points, "out: a displacement for each lattice point is wanted");
    require(options.point_weights.empty() || options.point_weights.size() == points,
            "point_weights: one for each lattice point is wanted");
    require(are_finite(options.point_weights), "point_weights: must be finite");
    require(options.max_gain > 0.0 && std::isfinite(options.max_gain), "max_gain: must be finite and > 0");
    require(std::ranges::all_of(displacements, [](const glm::dvec3& d) { return length_of(d) <= 1e100; }),
            "displacements: must be finite, and 1e100 at most");

    const Rows rows = rows_of(lattice, parts, displacements.size(), options);
    std::vector<glm::dvec3> left(displacements.begin(), displacements.end());
    if (!std::isfinite(rows.weakest)) {
        std::ranges::fill(out, glm::dvec3(0.0));
        return left;
    }
    check_count(rows.influenced, points);
    // From here on nothing is refused.
    std::ranges::fill(out, glm::dvec3(0.0));
    // For eigenvalues below `least` the inverse falls again, so that the solution stays bounded and is
    // continuous in the data.
    const double least = rows.weakest / (options.max_gain * options.max_gain);
    const auto inverse = [least](double value) {
        if (!(value > 0.0)) return 0.0;
        return value >= least ? 1.0 / value : value / least / least;
    };
    solve(rows.influenced, displacements, inverse, out);
    for (std::size_t pull = 0; pull < left.size(); ++pull) {
        const Row& row = rows.influenced[pull];
        for (std::size_t i = 0; i < row.points.size(); ++i) left[pull] -= row.weights[i] * out[row.points[i]];
    }
    if (options.outside_only) follow_outside(lattice, out);
    return left;
}

}  // namespace motus::lattice
