#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "motus/lattice.hpp"

namespace motus {
namespace {

/// How the lattice points move the point of one pull: a row of Hsu's matrix B. With every point of the
/// lattice in it.
using Row = std::vector<double>;

[[nodiscard]] double dot(const Row& a, const Row& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

[[nodiscard]] bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Two opposite points of the outside, and the share of the way from the first to the second where a point
/// inside is.
struct Between {
    std::size_t first = 0, second = 0;
    double share = 0.0;
};

/// Calls with_inner(point, opposite) for each point inside: opposite are the three pairs in line with it.
/// Where the inside follows the outside, it stands in the mean of its places between them, as in Blender.
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

/// Gives the weights of the points inside to those of the outside that they follow.
void move_to_outside(const Lattice& lattice, Row& row) {
    for_inside(lattice, [&](std::size_t point, const std::array<Between, 3>& opposite) {
        const double third = row[point] / 3.0;
        row[point] = 0.0;
        for (const Between& pair : opposite) {
            row[pair.first] += third * (1.0 - pair.share);
            row[pair.second] += third * pair.share;
        }
    });
}

/// Lets the points inside follow.
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
    std::vector<Row> full;  ///< the same parts, each at full influence
};

[[nodiscard]] Rows rows_of(const Lattice& lattice, std::span<const LatticePart> parts, std::size_t pulls,
                           const LatticePullOptions& options) {
    const std::size_t points = point_count(lattice);
    Rows rows{std::vector<Row>(pulls, Row(points, 0.0)), std::vector<Row>(pulls, Row(points, 0.0))};
    for (const LatticePart& part : parts) {
        if (part.pull >= pulls) throw std::invalid_argument("a part of a pull that is not there");
        if (!std::isfinite(part.share) || !std::isfinite(part.influence))
            throw std::invalid_argument("shares and influences must be finite");
        const LatticeWeights weights = lattice_weights(lattice, part.place);
        double influence = part.influence;
        if (!options.point_weights.empty()) {
            double faded = 0.0;
            for (std::size_t i = 0; i < weights.points.size(); ++i)
                faded += weights.weights[i] * static_cast<double>(options.point_weights[weights.points[i]]);
            influence *= influence * faded;
        }
        for (std::size_t i = 0; i < weights.points.size(); ++i) {
            rows.full[part.pull][weights.points[i]] += part.share * weights.weights[i];
            rows.influenced[part.pull][weights.points[i]] += part.share * influence * weights.weights[i];
        }
    }
    if (options.outside_only) {
        for (Row& row : rows.full) move_to_outside(lattice, row);
        for (Row& row : rows.influenced) move_to_outside(lattice, row);
    }
    return rows;
}

/// Eigenvalues of a symmetric matrix (size * size, row by row) and its eigenvectors as columns, by Jacobi's
/// rotations (Golub, Van Loan, section 8.5). `matrix` is overwritten; its diagonal holds the eigenvalues.
[[nodiscard]] std::vector<double> diagonalise(std::vector<double>& matrix, std::size_t size) {
    constexpr int sweeps = 60;
    constexpr double small = 1e-32;  // of the sum of squares
    std::vector<double> vectors(size * size, 0.0);
    for (std::size_t i = 0; i < size; ++i) vectors[i * size + i] = 1.0;
    const double total = dot(matrix, matrix);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        double off = 0.0;
        for (std::size_t p = 0; p < size; ++p) {
            for (std::size_t q = p + 1; q < size; ++q) off += matrix[p * size + q] * matrix[p * size + q];
        }
        if (off <= small * total) break;
        for (std::size_t p = 0; p < size; ++p) {
            for (std::size_t q = p + 1; q < size; ++q) {
                const double apq = matrix[p * size + q];
                if (apq == 0.0) continue;
                const double theta = (matrix[q * size + q] - matrix[p * size + p]) / (2.0 * apq);
                const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(1.0, theta));
                const double c = 1.0 / std::hypot(1.0, t), s = t * c;
                for (std::size_t k = 0; k < size; ++k) {
                    const double kp = matrix[k * size + p], kq = matrix[k * size + q];
                    matrix[k * size + p] = c * kp - s * kq;
                    matrix[k * size + q] = s * kp + c * kq;
                }
                for (std::size_t k = 0; k < size; ++k) {
                    const double pk = matrix[p * size + k], qk = matrix[q * size + k];
                    matrix[p * size + k] = c * pk - s * qk;
                    matrix[q * size + k] = s * pk + c * qk;
                    const double kp = vectors[k * size + p], kq = vectors[k * size + q];
                    vectors[k * size + p] = c * kp - s * kq;
                    vectors[k * size + q] = s * kp + c * kq;
                }
            }
        }
    }
    return vectors;
}

/// (B B^T)^-1 d, where eigenvalues below `least` count as least^2 / eigenvalue: the solution stays bounded
/// there, and follows the data continuously.
[[nodiscard]] std::vector<glm::dvec3> multipliers(const std::vector<Row>& rows,
                                                  std::span<const glm::dvec3> displacements, double least) {
    const std::size_t size = rows.size();
    std::vector<double> matrix(size * size);
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = i; j < size; ++j)
            matrix[i * size + j] = matrix[j * size + i] = dot(rows[i], rows[j]);
    }
    const std::vector<double> vectors = diagonalise(matrix, size);
    std::vector<glm::dvec3> result(size, glm::dvec3(0.0));
    for (std::size_t e = 0; e < size; ++e) {
        const double value = matrix[e * size + e];
        if (!(value > 0.0)) continue;
        const double inverse = value >= least ? 1.0 / value : value / least / least;
        glm::dvec3 part(0.0);
        for (std::size_t i = 0; i < size; ++i) part += vectors[i * size + e] * displacements[i];
        for (std::size_t i = 0; i < size; ++i) result[i] += inverse * vectors[i * size + e] * part;
    }
    return result;
}

}  // namespace

std::vector<glm::dvec3> pull_lattice(const Lattice& lattice, std::span<const LatticePart> parts,
                                     std::span<const glm::dvec3> displacements,
                                     const LatticePullOptions& options, std::span<glm::dvec3> out) {
    const std::size_t points = rest_points(lattice).size();  // which checks the lattice
    if (out.size() != points) throw std::invalid_argument("a displacement for each lattice point is wanted");
    if (!options.point_weights.empty() && options.point_weights.size() != points)
        throw std::invalid_argument("a weight for each lattice point is wanted");
    if (!(options.max_gain > 0.0) || !std::isfinite(options.max_gain))
        throw std::invalid_argument("max_gain must be finite and > 0");
    if (!std::all_of(displacements.begin(), displacements.end(), is_finite))
        throw std::invalid_argument("displacements must be finite");

    const Rows rows = rows_of(lattice, parts, displacements.size(), options);
    double weakest =
        std::numeric_limits<double>::infinity();  // of the pulls at full influence, by themselves
    for (const Row& row : rows.full) {
        const double square = dot(row, row);
        if (square > 0.0) weakest = std::min(weakest, square);
    }
    std::fill(out.begin(), out.end(), glm::dvec3(0.0));
    std::vector<glm::dvec3> left(displacements.begin(), displacements.end());
    if (!std::isfinite(weakest)) return left;
    const double least = weakest / (options.max_gain * options.max_gain);
    const std::vector<glm::dvec3> factors = multipliers(rows.influenced, displacements, least);
    for (std::size_t pull = 0; pull < factors.size(); ++pull) {
        for (std::size_t i = 0; i < points; ++i) out[i] += rows.influenced[pull][i] * factors[pull];
    }
    for (std::size_t pull = 0; pull < left.size(); ++pull) {
        for (std::size_t i = 0; i < points; ++i) left[pull] -= rows.influenced[pull][i] * out[i];
    }
    if (options.outside_only) follow_outside(lattice, out);
    return left;
}

}  // namespace motus
