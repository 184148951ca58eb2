// A function of a symmetric matrix, times vectors. Private to the library.
#pragma once
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace motus::lattice {

/// Q function(L) Q^T columns, if Q L Q^T is the matrix with its eigenvalues L: columns.size() rows of as
/// many numbers, symmetric. By Householder's reflections to tridiagonal form and the implicit QL method,
/// whose rotations turn the columns instead of a matrix of eigenvectors: 4/3 size^3 multiplications, and room
/// for three numbers a rotation, some size^2 of them. Eigenvalues are right to 1e-14 of the largest.
[[nodiscard]] std::vector<glm::dvec3> times_function(std::vector<double> matrix,
                                                     std::span<const glm::dvec3> columns,
                                                     const std::function<double(double)>& function);

}  // namespace motus::lattice
