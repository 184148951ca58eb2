// Where the things stand that bones of a rig reach for.
#include "goals.hpp"

#include <pybind11/pybind11.h>

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "bones/rig_arrays.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "motus/bones/rig.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

static_assert(sizeof(glm::dmat4) == 16 * sizeof(double), "rows of 16 are written as matrices");

/// A goal, and the row of the array that has its matrix.
struct Place {
    std::size_t goal = 0;
    std::size_t row = 0;
};

class Goals {
  public:
    Goals(const WholeNumber& count, const ArrayLike& own, const ArrayLike& others)
        : count_(counted(count)), own_(places(own, "own")), others_(places(others, "others")) {}

    [[nodiscard]] DoubleArray matrices(const Float32Array& poses, const ArrayLike& world,
                                       const Float32Array& things) const {
        DoubleArray result = new_array({count_, 16});
        const std::span<glm::dmat4> out{reinterpret_cast<glm::dmat4*>(result.mutable_data()), count_};
        for (glm::dmat4& matrix : out) matrix = glm::dmat4(1.0);
        visit(poses, world, things,
              [&out](std::size_t goal, const glm::dmat4& matrix) { out[goal] = matrix; });
        return result;
    }

    [[nodiscard]] DoubleArray points(const Float32Array& poses, const ArrayLike& world,
                                     const Float32Array& things) const {
        DoubleArray result = new_array({count_, 3});
        const std::span<glm::dvec3> out = points_of(result);
        for (glm::dvec3& point : out) point = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
        visit(poses, world, things,
              [&out](std::size_t goal, const glm::dmat4& matrix) { out[goal] = glm::dvec3(matrix[3]); });
        return result;
    }

  private:
    [[nodiscard]] static std::size_t counted(const WholeNumber& given) {
        const int count = whole_number(given, "count");
        if (count < 0) value_error("count", "must be 0 or more");
        return static_cast<std::size_t>(count);
    }

    [[nodiscard]] std::vector<Place> places(const ArrayLike& given, const char* name) const {
        const auto pairs = py::array_t<long long, py::array::c_style | py::array::forcecast>::ensure(given);
        if (!pairs) type_error(name, "must be rows of whole numbers: goal, row");
        std::vector<Place> result;
        if (pairs.size() == 0) return result;
        if (pairs.ndim() != 2 || pairs.shape(1) != 2)
            value_error(name, "must have the shape (k, 2), not " + shape_of(pairs));
        for (py::ssize_t i = 0; i < pairs.shape(0); ++i) {
            if (pairs.at(i, 0) < 0 || pairs.at(i, 1) < 0 || !std::in_range<std::size_t>(pairs.at(i, 1)) ||
                static_cast<std::size_t>(pairs.at(i, 0)) >= count_)
                value_error(name, "there is no such goal or row");
            result.push_back(
                {static_cast<std::size_t>(pairs.at(i, 0)), static_cast<std::size_t>(pairs.at(i, 1))});
        }
        return result;
    }

    template <class Take>
    void visit(const Float32Array& poses, const ArrayLike& world, const Float32Array& things,
               const Take& take) const {
        if (!own_.empty()) {
            const glm::dmat4 to_world = matrix_of_columns(world, "world");
            const std::span<const float> rows = matrix_rows(poses, "poses");
            for (const Place& place : own_) take(place.goal, to_world * matrix_in(rows, place, "poses"));
        }
        if (!others_.empty()) {
            const std::span<const float> rows = matrix_rows(things, "things");
            for (const Place& place : others_) take(place.goal, matrix_in(rows, place, "things"));
        }
    }

    [[nodiscard]] static std::span<const float> matrix_rows(const Float32Array& given,
                                                            std::string_view name) {
        const bool has_rows =
            py::isinstance<py::array>(given) && py::reinterpret_borrow<py::array>(given).ndim() == 2;
        const auto count = has_rows ? py::reinterpret_borrow<py::array>(given).shape(0) : 0;
        return elements<float>(given, name, {static_cast<std::size_t>(count), 16});
    }

    [[nodiscard]] static glm::dmat4 matrix_in(std::span<const float> rows, const Place& place,
                                              std::string_view name) {
        if (place.row >= rows.size() / 16) value_error(name, "has too few rows");
        return bones::matrix_at(rows, place.row);
    }

    std::size_t count_;
    std::vector<Place> own_, others_;
};

}  // namespace

void bind_goals(py::module_& m) {
    py::class_<Goals>(m, "RigGoals", py::module_local(), R"(
Goals that bones of a rig reach for: bones of the rig itself, and things whose world matrices are given. Immutable.

count: of the goals.  own: (k, 2) goal and bone of the rig.  others: (m, 2) goal and row of `things`. A goal that is in neither
is nowhere.
Raises ValueError or TypeError that names the argument.)")
        .def(py::init<const WholeNumber&, const ArrayLike&, const ArrayLike&>(), "count"_a, "own"_a,
             "others"_a)
        .def("matrices", &Goals::matrices, "poses"_a, "world"_a, "things"_a, R"(
World matrices of the goals, (count, 16) float64, column by column; the identity for one that is nowhere.

poses: (b, 16) float32, PoseBone.matrix as foreach_get gives it.  world: the rig's matrix_world, as in IkPlan.solve().  Both are read
if a goal is a bone of the rig.  things: (n, 16) float32, world matrices, column by column.
Raises ValueError or TypeError that names the argument; numbers that are not finite do not raise.)")
        .def("points", &Goals::points, "poses"_a, "world"_a, "things"_a, R"(
World positions of the goals, (count, 3) float64; NaN for one that is nowhere. Arguments as in matrices().)");
}

}  // namespace motus::bindings
