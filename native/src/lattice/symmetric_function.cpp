// Golub, Van Loan, "Matrix Computations" (4th ed., 2013), section 8.3; the QL method as in EISPACK's tql2.
#include "symmetric_function.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace motus::lattice {
namespace {

/// Reflection v -> v - factor u (u . v) with u = (1 at `first`, then `rest`).
struct Reflection {
    std::size_t first = 0;
    double factor = 0.0;
    std::vector<double> rest;

    void apply(std::span<glm::dvec3> columns) const {
        glm::dvec3 sum = columns[first];
        for (std::size_t i = 0; i < rest.size(); ++i) sum += rest[i] * columns[first + 1 + i];
        sum *= factor;
        columns[first] -= sum;
        for (std::size_t i = 0; i < rest.size(); ++i) columns[first + 1 + i] -= rest[i] * sum;
    }
};

/// Rotation of the rows `row` and row + 1.
struct Rotation {
    std::size_t row = 0;
    double cosine = 1.0, sine = 0.0;

    void apply(std::span<glm::dvec3> columns) const {
        const glm::dvec3 upper = columns[row], lower = columns[row + 1];
        columns[row] = cosine * upper - sine * lower;
        columns[row + 1] = sine * upper + cosine * lower;
    }
    void apply_back(std::span<glm::dvec3> columns) const {
        const glm::dvec3 upper = columns[row], lower = columns[row + 1];
        columns[row] = cosine * upper + sine * lower;
        columns[row + 1] = cosine * lower - sine * upper;
    }
};

struct Tridiagonal {
    std::vector<double> diagonal;
    std::vector<double> beside;  ///< beside[i] between i and i + 1; the last is 0
};

/// Reflects row k's part right of the diagonal into its first number, and the matrix with it.
[[nodiscard]] Reflection reflect(std::vector<double>& matrix, std::size_t size, std::size_t k) {
    const std::size_t first = k + 1, count = size - first;
    const std::span<const double> row(matrix.data() + k * size + first, count);
    double square = 0.0;
    for (std::size_t i = 1; i < count; ++i) square += row[i] * row[i];
    Reflection reflection{first, 0.0, std::vector<double>(count - 1, 0.0)};
    if (square == 0.0) return reflection;
    const double reflected = -std::copysign(std::sqrt(row[0] * row[0] + square), row[0]);
    const double pivot = row[0] - reflected;
    for (std::size_t i = 1; i < count; ++i) reflection.rest[i - 1] = row[i] / pivot;
    reflection.factor = -pivot / reflected;

    std::vector<double> u(count, 1.0), w(count);
    std::copy(reflection.rest.begin(), reflection.rest.end(), u.begin() + 1);
    double along = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double* from = matrix.data() + (first + i) * size + first;
        double sum = 0.0;
        for (std::size_t j = 0; j < count; ++j) sum += from[j] * u[j];
        w[i] = reflection.factor * sum;
        along += w[i] * u[i];
    }
    for (std::size_t i = 0; i < count; ++i) w[i] -= 0.5 * reflection.factor * along * u[i];
    for (std::size_t i = 0; i < count; ++i) {
        double* to = matrix.data() + (first + i) * size + first;
        for (std::size_t j = 0; j < count; ++j) to[j] -= u[i] * w[j] + w[i] * u[j];
    }
    matrix[k * size + first] = reflected;
    return reflection;
}

/// Makes the diagonal the eigenvalues; the columns are rotated along.
[[nodiscard]] std::vector<Rotation> diagonalise(Tridiagonal& matrix, std::span<glm::dvec3> columns) {
    constexpr int most_turns = 60;  // for one eigenvalue; two are the rule
    std::vector<double>&d = matrix.diagonal, &e = matrix.beside;
    double largest = 0.0;
    for (std::size_t i = 0; i < d.size(); ++i) largest = std::max(largest, std::abs(d[i]) + std::abs(e[i]));
    const double small = std::numeric_limits<double>::epsilon() * largest;
    std::vector<Rotation> rotations;
    for (std::size_t low = 0; low < d.size(); ++low) {
        for (int turn = 0; turn < most_turns; ++turn) {
            std::size_t high = low;
            while (high + 1 < d.size() && std::abs(e[high]) > small) ++high;
            if (high == low) break;
            const double shift = (d[low + 1] - d[low]) / (2.0 * e[low]);
            double g = d[high] - d[low] + e[low] / (shift + std::copysign(std::hypot(shift, 1.0), shift));
            double sine = 1.0, cosine = 1.0, lost = 0.0;
            bool parted = false;
            for (std::size_t i = high; i-- > low;) {
                const double f = sine * e[i], b = cosine * e[i];
                const double r = std::hypot(f, g);
                e[i + 1] = r;
                if (r == 0.0) {
                    d[i + 1] -= lost;
                    e[high] = 0.0;
                    parted = true;
                    break;
                }
                sine = f / r;
                cosine = g / r;
                g = d[i + 1] - lost;
                const double change = (d[i] - g) * sine + 2.0 * cosine * b;
                lost = sine * change;
                d[i + 1] = g + lost;
                g = cosine * change - b;
                rotations.push_back({i, cosine, sine});
                rotations.back().apply(columns);
            }
            if (parted) continue;
            d[low] -= lost;
            e[low] = g;
            e[high] = 0.0;
        }
    }
    return rotations;
}

}  // namespace

std::vector<glm::dvec3> times_function(std::vector<double> matrix, std::span<const glm::dvec3> columns,
                                       const std::function<double(double)>& function) {
    const std::size_t size = columns.size();
    std::vector<glm::dvec3> result(columns.begin(), columns.end());
    std::vector<Reflection> reflections;
    for (std::size_t k = 0; k + 2 < size; ++k) {
        reflections.push_back(reflect(matrix, size, k));
        reflections.back().apply(result);
    }
    Tridiagonal tridiagonal{std::vector<double>(size), std::vector<double>(size, 0.0)};
    for (std::size_t i = 0; i < size; ++i) {
        tridiagonal.diagonal[i] = matrix[i * size + i];
        if (i + 1 < size) tridiagonal.beside[i] = matrix[i * size + i + 1];
    }
    const std::vector<Rotation> rotations = diagonalise(tridiagonal, result);
    for (std::size_t i = 0; i < size; ++i) result[i] *= function(tridiagonal.diagonal[i]);
    for (auto one = rotations.rbegin(); one != rotations.rend(); ++one) one->apply_back(result);
    for (auto one = reflections.rbegin(); one != reflections.rend(); ++one) one->apply(result);
    return result;
}

}  // namespace motus::lattice
