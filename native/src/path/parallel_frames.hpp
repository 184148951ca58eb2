// Rotation-minimising frames along a path, by double reflection.
// Wang, Juettler, Zheng, Liu, "Computation of Rotation Minimizing Frames", ACM TOG 27 (2008). Frames of this
// kind are parallel: a vector across the tangent that keeps its coordinates in them does not turn about the
// tangent.
#pragma once
#include <cmath>
#include <complex>
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "motus/core/cache.hpp"
#include "motus/curve/arc_length.hpp"

namespace motus::path {

/// A vector across the tangent in a parallel frame: real part along `up`, imaginary part along `side`.
/// Multiplying by e^(i angle) turns it by `angle` about the tangent (right-handed).
using Across = std::complex<double>;

/// |v|; a third of the time of std::abs, which guards against overflow.
[[nodiscard]] inline double size_of(Across v) {
    return std::sqrt(std::norm(v));
}

/// The part of a place that a table keeps; the rest is computed from it. A path of 10,000 segments has some
/// million.
struct Station {
    double t = 0.0;
    glm::dvec3 position{0.0};
    glm::dvec3 tangent{0.0, 1.0, 0.0};
    glm::dvec3 up{0.0, 0.0, 1.0};
};

/// A place on the path with its parallel frame. `up`, `side` and `tangent` are orthonormal, side = tangent x
/// up.
struct Place {
    double s = 0.0;
    double t = 0.0;
    std::size_t cell = 0;  ///< index of the last station at or before s
    glm::dvec3 position{0.0};
    glm::dvec3 tangent{0.0, 1.0, 0.0};
    glm::dvec3 up{0.0, 0.0, 1.0};
    glm::dvec3 side{1.0, 0.0, 0.0};
    glm::dvec3 bend{
        0.0};  ///< curvature vector kappa N, 1 / length unit; NaN where the first derivative vanishes

    [[nodiscard]] Across across(const glm::dvec3& v) const;
};

/// The kind of path between a station and the next one.
enum class Cell {
    smooth,  ///< a piece of the curve that turns by a few degrees at most
    joint,   ///< zero length: one segment ends, the next one begins along the same tangent
    corner,  ///< zero length or nearly so: the tangent jumps (a corner, a cusp)
};

/// Table of parallel frames at stations that lie close together where the path turns.
class ParallelFrames {
  public:
    explicit ParallelFrames(std::shared_ptr<const curve::ArcLength> path);

    [[nodiscard]] const curve::ArcLength& path() const noexcept { return *path_; }
    [[nodiscard]] double length() const noexcept { return path_->length(); }

    /// The place at distance s (clamped); at a corner the one behind it.
    [[nodiscard]] Place at(double s) const;

    /// Distances of the stations: at least one; the first is 0, the last the length.
    [[nodiscard]] std::span<const double> distances() const noexcept { return distances_; }
    /// station(i).s == distances()[i] and station(i).cell == i.
    [[nodiscard]] Place station(std::size_t index) const;
    /// cells()[i] lies between stations i and i + 1.
    [[nodiscard]] std::span<const Cell> cells() const noexcept { return cells_; }

    /// Whether the end of the path is its start, so that it can be ridden round and round.
    [[nodiscard]] bool cyclic() const noexcept { return cyclic_; }
    /// The kind of path between the last station and the first (cyclic only).
    [[nodiscard]] Cell seam() const noexcept { return seam_; }
    /// Factor that takes coordinates in the last station's frame to those of the same vector in the first's
    /// (cyclic only; its argument is the angle by which the frames fail to close).
    [[nodiscard]] Across closing() const noexcept { return closing_; }
    /// Size in memory, the path included.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return sizeof *this + path_->bytes() + bytes_of(stations_) + bytes_of(distances_) + bytes_of(cells_);
    }

  private:
    void add_segment(std::size_t index);
    void carry_frames();
    void close();

    std::shared_ptr<const curve::ArcLength> path_;
    std::vector<Station> stations_;
    std::vector<double> distances_;
    std::vector<Cell> cells_;
    double grain_ = 0.0;  // lengths below this are rounding
    bool cyclic_ = false;
    Cell seam_ = Cell::corner;
    Across closing_{1.0, 0.0};
};

/// The world's up across `tangent`; along a vertical tangent the limit for one that comes from +Y.
[[nodiscard]] glm::dvec3 upright(const glm::dvec3& tangent);

}  // namespace motus::path
