#include "motus/bones/products.hpp"

#include "motus/core/numeric.hpp"

namespace motus::bones {
namespace {

inline void product(const double* left, const double* right, std::size_t rows, std::size_t columns,
                    double* out) {
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            double sum = 0.0;
            for (std::size_t i = 0; i < rows; ++i) sum += left[row * rows + i] * right[i * columns + column];
            out[row * columns + column] = sum;
        }
}

/// How far it is from one matrix to the next: not at all where one stands for all.
[[nodiscard]] std::size_t step(std::span<const double> numbers, std::size_t size, std::size_t count,
                               const char* problem) {
    require(numbers.size() == size || numbers.size() == size * count, problem);
    return numbers.size() == size ? 0 : size;
}

}  // namespace

void multiply(std::span<const double> left, std::span<const double> right, const MatrixSize& size,
              std::span<double> out) {
    const auto [rows, columns] = size;
    const std::size_t each = rows * columns;
    require(each > 0 && out.size() % each == 0, "out: whole matrices are needed");
    const std::size_t count = out.size() / each;
    const std::size_t left_step =
        step(left, rows * rows, count, "left: one matrix, or one for each product, is needed");
    const std::size_t right_step =
        step(right, each, count, "right: one matrix, or one for each product, is needed");
    const double *a = left.data(), *b = right.data();
    double* to = out.data();
    const bool is_usual = rows == 4 && columns == 4;
    for (std::size_t i = 0; i < count; ++i, a += left_step, b += right_step, to += each)
        is_usual ? product(a, b, 4, 4, to) : product(a, b, rows, columns, to);
}

}  // namespace motus::bones
