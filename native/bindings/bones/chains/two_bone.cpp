// Two bones and a target; why a chain ends where it ends.
#include "motus/bones/chains/two_bone.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "areas.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"

namespace motus::bindings {
namespace {

namespace chains = bones::chains;

using namespace pybind11::literals;

constexpr double solve_cost = 60.0;  // ns, rough
constexpr double reach_cost = 5.0;

/// Python's IntEnum, so that codes in arrays compare with it.
py::object bind_reason(py::module_& m) {
    py::dict codes;
    codes["REACHED"] = static_cast<int>(bones::Reason::reached);
    codes["TOO_FAR"] = static_cast<int>(bones::Reason::too_far);
    codes["TOO_NEAR"] = static_cast<int>(bones::Reason::too_near);
    codes["LIMIT"] = static_cast<int>(bones::Reason::limit);
    codes["ITERATIONS"] = static_cast<int>(bones::Reason::iterations);
    py::object reason =
        py::module_::import("enum").attr("IntEnum")("Reason", codes, "module"_a = m.attr("__name__"));
    reason.attr("__doc__") = R"(
Why the end of a chain is or is not on its target; an IntEnum, comparable with the codes in arrays.

REACHED: the end is on the target, within the tolerance.  TOO_FAR: the target is farther than the chain reaches,
or than softness lets it.  TOO_NEAR: the target is nearer to the root than the chain can fold.  LIMIT: a joint limit is in the way.
ITERATIONS: the iterations allowed were used up.)";
    m.attr("Reason") = reason;
    return reason;
}

/// The rows of an argument: one for all chains, or one for each.
template <class Row>
struct Column {
    std::span<const Row> rows;
    bool is_single;
    [[nodiscard]] const Row& operator[](std::size_t i) const { return rows[is_single ? 0 : i]; }
};

/// (3,) or (m, 3). Holds the array that the column points into.
class VectorArgument {
  public:
    VectorArgument(py::handle object, std::string_view name) : name_(name), array_(doubles(object, name)) {
        const bool is_rows = array_.ndim() == 2 && array_.shape(1) == 3;
        if (!is_rows && (array_.ndim() != 1 || array_.shape(0) != 3))
            value_error(name, "must have the shape (3,) or (m, 3), not " + shape_of(array_));
    }
    [[nodiscard]] std::string_view name() const noexcept { return name_; }
    [[nodiscard]] Column<glm::dvec3> column() const {
        return {
            {reinterpret_cast<const glm::dvec3*>(array_.data()), static_cast<std::size_t>(array_.size()) / 3},
            array_.ndim() == 1};
    }

  private:
    std::string_view name_;
    DoubleArray array_;
};

/// A number or (m,), every value within the domain that `allows` and `domain` say.
class NumberArgument {
  public:
    template <class Allows>
    NumberArgument(py::handle object, std::string_view name, Allows&& allows, std::string_view domain)
        : name_(name), numbers_(object, name) {
        if (!std::ranges::all_of(numbers_.values(), allows)) value_error(name, domain);
    }
    [[nodiscard]] std::string_view name() const noexcept { return name_; }
    [[nodiscard]] const Numbers& numbers() const noexcept { return numbers_; }
    [[nodiscard]] Column<double> column() const { return {numbers_.values(), numbers_.is_single()}; }

  private:
    std::string_view name_;
    Numbers numbers_;
};

[[nodiscard]] NumberArgument length_argument(py::handle object, std::string_view name) {
    return {object, name, [](double value) { return value >= 0.0; }, "must be >= 0"};
}

/// How many chains the arguments are about.
class ChainCount {
  public:
    template <class Argument>
    void add(const Argument& argument) {
        const auto column = argument.column();
        if (column.is_single) return;
        if (first_.empty()) {
            first_ = argument.name();
            count_ = column.rows.size();
        } else if (column.rows.size() != count_) {
            value_error(argument.name(), "must have as many rows as " + std::string(first_) + ": " +
                                             std::to_string(count_) + ", not " +
                                             std::to_string(column.rows.size()));
        }
    }
    [[nodiscard]] bool is_single() const noexcept { return first_.empty(); }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }

  private:
    std::string_view first_;
    std::size_t count_ = 1;
};

struct Columns {
    Column<glm::dvec3> root, target, pole, plane;
    Column<double> length1, length2, bend, softness, stretch;

    [[nodiscard]] chains::TwoBone chain(std::size_t i) const {
        return {.root = root[i],
                .target = target[i],
                .pole = pole[i],
                .length1 = length1[i],
                .length2 = length2[i],
                .softness = softness[i],
                .stretch = stretch[i],
                .plane = plane[i],
                .bend = bend[i] > 0.0 ? 1 : -1};
    }
};

/// The result as Python sees it: values for one chain, arrays for many.
struct TwoBoneSolution {
    py::object elbow, tip, normal, scale, residual, reason;
};

[[nodiscard]] TwoBoneSolution solve_one(const Columns& columns, const py::object& reason_type) {
    const chains::TwoBoneSolution at = chains::solve_two_bone(columns.chain(0));
    return {to_array(at.elbow),   to_array(at.tip),        to_array(at.normal),
            py::float_(at.scale), py::float_(at.residual), reason_type(static_cast<int>(at.reason))};
}

[[nodiscard]] TwoBoneSolution solve_many(const Columns& columns, std::size_t count) {
    DoubleArray elbow = new_array({count, 3});
    DoubleArray tip = new_array({count, 3});
    DoubleArray normal = new_array({count, 3});
    DoubleArray scale = new_array({count});
    DoubleArray residual = new_array({count});
    py::array_t<std::int64_t> reason(static_cast<py::ssize_t>(count));
    {
        std::int64_t* const reasons = reason.mutable_data();
        const auto elbows = points_of(elbow), tips = points_of(tip), normals = points_of(normal);
        const auto scales = values_of(scale), residuals = values_of(residual);
        const ReleaseGil released(count, solve_cost);
        constexpr std::size_t block = 128;  // stays in the nearest cache
        std::array<chains::TwoBone, block> chains;
        std::array<chains::TwoBoneSolution, block> solutions;
        for (std::size_t start = 0; start < count; start += block) {
            const std::size_t size = std::min(block, count - start);
            for (std::size_t i = 0; i < size; ++i) chains[i] = columns.chain(start + i);
            chains::solve_two_bones({chains.data(), size}, {solutions.data(), size});
            for (std::size_t i = 0; i < size; ++i) {
                const chains::TwoBoneSolution& at = solutions[i];
                elbows[start + i] = at.elbow;
                tips[start + i] = at.tip;
                normals[start + i] = at.normal;
                scales[start + i] = at.scale;
                residuals[start + i] = at.residual;
                reasons[start + i] = static_cast<std::int64_t>(at.reason);
            }
        }
    }
    return {elbow, tip, normal, scale, residual, reason};
}

[[nodiscard]] TwoBoneSolution solve(const py::object& reason_type, const ArrayLike& root,
                                    const ArrayLike& target, const ArrayLike& length1,
                                    const ArrayLike& length2, const ArrayLike& pole, const ArrayLike& bend,
                                    const ArrayLike& softness, const ArrayLike& stretch,
                                    const OptionalArrayLike& plane) {
    const VectorArgument roots(root, "root");
    const VectorArgument targets(target, "target");
    const NumberArgument lengths1 = length_argument(length1, "length1");
    const NumberArgument lengths2 = length_argument(length2, "length2");
    const VectorArgument poles(pole, "pole");
    const NumberArgument bends(
        bend, "bend", [](double value) { return value == 1.0 || value == -1.0; }, "must be 1 or -1");
    const NumberArgument softnesses = length_argument(softness, "softness");
    const NumberArgument stretches(
        stretch, "stretch", [](double value) { return value >= 0.0 && value <= 1.0; }, "must be from 0 to 1");
    const py::object none = py::make_tuple(0.0, 0.0, 0.0);
    const VectorArgument planes(plane.is_none() ? none : plane, "plane");

    ChainCount chains;
    chains.add(roots);
    chains.add(targets);
    chains.add(lengths1);
    chains.add(lengths2);
    chains.add(poles);
    chains.add(bends);
    chains.add(softnesses);
    chains.add(stretches);
    chains.add(planes);
    const Columns columns{roots.column(),  targets.column(),    poles.column(),
                          planes.column(), lengths1.column(),   lengths2.column(),
                          bends.column(),  softnesses.column(), stretches.column()};
    return chains.is_single() ? solve_one(columns, reason_type) : solve_many(columns, chains.count());
}

void bind_solution(py::module_& m) {
    py::class_<TwoBoneSolution>(m, "TwoBoneSolution", py::module_local(), R"(
The positions of the joints of two bones, from solve_two_bone(): of one chain values, of m chains arrays with m rows.)")
        .def_readonly("elbow", &TwoBoneSolution::elbow, "(3,) or (m, 3).")
        .def_readonly("tip", &TwoBoneSolution::tip,
                      "(3,) or (m, 3); the target itself where it is reached exactly.")
        .def_readonly("normal", &TwoBoneSolution::normal, R"(
(3,) or (m, 3), unit: across the plane of the bend; cross(normal, target - root) points to the elbow's side.)")
        .def_readonly("scale", &TwoBoneSolution::scale,
                      "A float or (m,): of both bones, > 1 if they are stretched.")
        .def_readonly("residual", &TwoBoneSolution::residual,
                      "A float or (m,): distance from the tip to the target.")
        .def_readonly("reason", &TwoBoneSolution::reason, R"(
A Reason or (m,) int64 of their codes: REACHED, if the residual is at most 1e-12 of length1 + length2 +
|target - root|; TOO_FAR or TOO_NEAR.)");
}

}  // namespace

void bind_two_bone(py::module_& m) {
    const py::object reason_type = bind_reason(m);
    bind_solution(m);
    m.def(
        "solve_two_bone",
        [reason_type](const ArrayLike& root, const ArrayLike& target, const ArrayLike& length1,
                      const ArrayLike& length2, const ArrayLike& pole, const ArrayLike& bend,
                      const ArrayLike& softness, const ArrayLike& stretch, const OptionalArrayLike& plane) {
            return solve(reason_type, root, target, length1, length2, pole, bend, softness, stretch, plane);
        },
        "root"_a, "target"_a, "length1"_a, "length2"_a, "pole"_a, "bend"_a = 1, "softness"_a = 0.0,
        "stretch"_a = 0.0, "plane"_a = py::none(), R"(
Elbow and tip of two bones whose tip goes to a target, in closed form. Any space, any unit of length.

root, target: (3,) or (m, 3).  length1, length2: root to elbow and elbow to tip, >= 0.
pole: (3,) or (m, 3), a point that the elbow bends towards, seen across the line from root to target (bend = 1), or
away from (bend = -1).
softness: the length, >= 0, before the full reach at which the arm begins to slow: see soft_reach(); one above
length1 + length2 counts as that.  stretch: the share, 0 to 1, of the missing length that both bones stretch by.
plane: (3,) or (m, 3), normal of the plane to bend in if the pole lies within 6 degrees of the line from root to
target, blended in without a jump; the elbow is then on the side of cross(plane, target - root). None: the pole
decides, except within 0.06 degrees of the line, where a fixed normal does.
Numbers may be (m,) arrays too; an argument that is given once counts for all chains.
A target out of reach gives the chain straight (too far) or folded (too near) on the line to it. Zero lengths and points
that coincide are fine: with the target on the root, the elbow is towards the pole.
Returns a TwoBoneSolution.  Raises ValueError or TypeError that names the argument.)");
    m.def(
        "soft_reach",
        [](const ArrayLike& distance, const Number& reach, const ArrayLike& softness) {
            const NumberArgument distances = length_argument(distance, "distance");
            const double longest = number(reach, "reach");
            if (longest < 0.0) value_error("reach", "must be >= 0");
            const double soft = number(softness, "softness");
            if (soft < 0.0) value_error("softness", "must be >= 0");
            return map_numbers(distances.numbers(), reach_cost,
                               [&](double d) { return chains::soft_reach(d, longest, soft); });
        },
        "distance"_a, "reach"_a, "softness"_a, R"(
Distance from the root at which the tip of a chain stands whose target is at `distance`.

distance: a number or (m,), >= 0.  reach: length of the straight chain, >= 0.  softness: >= 0; one above reach counts as
that.
Returns a float or (m,): distance up to reach - softness, from there with a slope that falls from 1 to 0, and reach from
reach + 2 * softness on.  Raises ValueError or TypeError that names the argument.)");
}

}  // namespace motus::bindings
