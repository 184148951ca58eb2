// Memory for the poses that a solver computes at each frame, and for the numbers that it tells beside them.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/arrays.hpp"
#include "core/typed.hpp"

namespace motus::bindings {

/// Rows of locations, rotations and scales in one piece of memory, which Python sees as arrays: of the
/// rotations, rows of w, x, y, z.
class PoseBuffer {
  public:
    PoseBuffer(const WholeNumber& count, const Float64Array& outputs);

    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    [[nodiscard]] std::span<double> outputs() { return values_of(outputs_); }
    [[nodiscard]] std::span<glm::dvec3> locations();
    /// The rotations' memory for quaternions of GLM's own layout, until rows_from_quaternions() puts it in
    /// order.
    [[nodiscard]] std::span<glm::dquat> rotations();

    /// Sets all poses to ones that change nothing.
    void reset();

    /// Whether all numbers are finite, and stay so when squared and added.
    [[nodiscard]] bool is_ordinary() const;

    /// Has the next poses count as new.
    void forget() { last_.clear(); }

    /// The poses as 4 x 4 matrices; None if they are those of the call before.
    [[nodiscard]] py::object matrices(bool has_scales);

    /// Writes the poses into slots of an outbox, unless they are those of the call before; whether it wrote.
    bool write_slots(const Float64Array& slots, bool has_scales);

    [[nodiscard]] std::span<double> numbers() { return block_; }
    [[nodiscard]] std::span<double> location_numbers() { return numbers().first(3 * count_); }
    [[nodiscard]] std::span<double> rotation_numbers() { return numbers().subspan(3 * count_, 4 * count_); }
    [[nodiscard]] std::span<double> scale_numbers() { return numbers().last(3 * count_); }

  private:
    /// Whether the poses differ from those of the call before, of which this keeps a copy.
    [[nodiscard]] bool are_new();

    std::size_t count_;
    std::vector<double> block_;
    std::vector<double> last_{};  // block_ when it was last written; empty if it never was
    DoubleArray outputs_;
    py::array_t<float, py::array::c_style> matrices_;
};

}  // namespace motus::bindings
