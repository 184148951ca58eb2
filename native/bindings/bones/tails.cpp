// Bones that turn so that their tails point to places.
#include "motus/bones/tails.hpp"

#include <pybind11/pybind11.h>

#include <vector>

#include "areas.hpp"
#include "bones/rig_arrays.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr double bone_cost = 300.0;  // ns, rough

[[nodiscard]] DoubleArray solve_tails(const bones::TailPlan& plan, const Float32Array& rest,
                                      const Float32Array& poses, const Float32Array& basis,
                                      const Int32Array& inheritance, const ArrayLike& world,
                                      const Float64Array& targets, const Float64Array& weights) {
    const std::size_t count = plan.size();
    const CopiedRig rig(plan.parents(), rest, poses, basis, inheritance);
    const glm::dmat4 to_world = matrix_of_columns(world, "world");
    const std::span<const double> places = elements<double>(targets, "targets", {count, 3});
    const std::vector<double> shares = copied(elements<double>(weights, "weights", {count}));
    std::vector<glm::dvec3> points;
    points.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        points.emplace_back(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    DoubleArray result = new_array({count, 4});
    const std::span<glm::dquat> out = quaternions_in(result.mutable_data(), count);
    {
        const ReleaseGil released(count, bone_cost);
        plan.solve(rig.view(), to_world, points, shares, out);
        rows_from_quaternions(out);
    }
    return result;
}

}  // namespace

void bind_tails(py::module_& m) {
    py::class_<bones::TailPlan>(m, "TailPlan", py::module_local(), R"(
Bones of one rig that turn so that their tails point to places. The hierarchy is checked once. Each bone turns about its own
head, after the bones above have moved that head.

parents: (B,), index of each bone's parent, -1 for none.  bones: (n,), the bones that turn, in any order.
Raises ValueError or TypeError that names the argument.)")
        .def(py::init([](const ArrayLike& parents, const ArrayLike& bones) {
                 return bones::TailPlan(whole_numbers(parents, "parents"), whole_numbers(bones, "bones"));
             }),
             "parents"_a, "bones"_a)
        .def("solve", &solve_tails, "rest"_a, "poses"_a, "basis"_a, "inheritance"_a, "world"_a, "targets"_a,
             "weights"_a, R"(
Rotations (n, 4), w, x, y, z, of the bones on top of their own: the identity if a tail points to its place already.

rest, poses, basis, inheritance, world: as those of LookAtPlan.solve; of poses only the parents of the topmost bones are
read.  targets: (n, 3) float64, world space.  weights: (n,) float64, the share of each turn, 0 to 1.
Raises ValueError or TypeError that names the argument; numbers that are not finite do not raise.)");
}

}  // namespace motus::bindings
