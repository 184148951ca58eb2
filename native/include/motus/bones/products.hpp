// Products of many matrices at once (batched multiplication).
//
// Costs: O(rows^2 columns) a product. Allocates nothing. Any number of threads at once, each with an `out`
// of its own.
#pragma once
#include <cstddef>
#include <span>

namespace motus::bones {

/// Size of the matrices on the right of a product. Those on the left are square, with as many rows.
struct MatrixSize {
    std::size_t rows, columns;
};

/// Products left * right of matrices, whose numbers lie row by row. On either side there may be one matrix
/// alone, which stands for all. out: a matrix of `size` for each product. Each number is summed up from the
/// first term on, without fused multiplications: results do not depend on where the matrices lie in memory.
/// std::invalid_argument if a length does not fit.
void multiply(std::span<const double> left, std::span<const double> right, const MatrixSize& size,
              std::span<double> out);

}  // namespace motus::bones
