// Weights of the lattice points along one axis at a place. Private to the library.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "motus/core/unfilled.hpp"
#include "motus/lattice/lattice.hpp"

namespace motus::lattice {

/// Lattice points along one axis that have a weight at a place; several taps may name the same point.
struct Taps {
    int count = 0;
    Unfilled<int, max_resolution> point;
    Unfilled<double, max_resolution> weight;

    void add(int index, double value) {
        point[static_cast<std::size_t>(count)] = index;
        weight[static_cast<std::size_t>(count)] = value;
        ++count;
    }
};

/// A lattice that was checked, with the way from a place to coordinates along its axes, 0 at rest's first
/// point and 1 at the last.
class Grid {
  public:
    explicit Grid(const Lattice& lattice);

    [[nodiscard]] glm::dvec3 coordinates(const glm::dvec3& place) const {
        return to_coordinates_ * (place - origin_);
    }
    [[nodiscard]] Taps taps(std::size_t axis, double coordinate) const;
    [[nodiscard]] const std::array<int, 3>& resolution() const noexcept { return resolution_; }

  private:
    glm::dvec3 origin_;
    glm::dmat3 to_coordinates_;
    std::array<int, 3> resolution_;
    std::array<Basis, 3> basis_;
};

}  // namespace motus::lattice
