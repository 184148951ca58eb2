// Chains of any number of bones, with and without joint limits.
#include "motus/bones/chains/chain.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "motus/bones/chains/limited.hpp"

namespace motus::bindings {
namespace {

namespace chains = bones::chains;

using namespace pybind11::literals;

constexpr double free_cost = 200.0;      // ns a bone, rough
constexpr double limited_cost = 2000.0;  // at its shortest

constexpr double largest_coordinate = 1e300;  // that both solvers know

void check_size(std::span<const glm::dvec3> points, std::string_view name) {
    for (const glm::dvec3& point : points)
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(point[axis]) > largest_coordinate) value_error(name, "must be 1e300 at most");
}

/// The result as Python sees it.
struct ChainSolution {
    DoubleArray joints;
    py::object rotations;
    double residual;
    int iterations;
    py::object reason;
};

chains::SolverSettings settings_of(const Number& tolerance, const WholeNumber& max_iterations,
                                   const OptionalArrayLike& pole, const OptionalArrayLike& plane) {
    chains::SolverSettings settings;
    settings.tolerance = number(tolerance, "tolerance");
    if (!(settings.tolerance > 0.0)) value_error("tolerance", "must be > 0");
    settings.max_iterations = whole_number(max_iterations, "max_iterations");
    if (settings.max_iterations < 0) value_error("max_iterations", "must be >= 0");
    if (!pole.is_none()) settings.pole = vector(pole, "pole");
    if (!plane.is_none()) settings.plane = vector(plane, "plane");
    return settings;
}

/// (n, 6): min x, y, z, max x, y, z; -inf and inf say free.
std::vector<chains::JointLimits> limits_argument(const OptionalArrayLike& object, std::size_t bones) {
    const std::string_view name = "limits";
    const py::array given = py::array::ensure(object);
    if (!given) value_error(name, "must be an array of numbers, all rows of one length");
    const char kind = given.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u') type_error(name, "must hold real numbers");
    const DoubleArray array = DoubleArray::ensure(given);
    if (!array) type_error(name, "cannot be converted to float64");
    if (array.ndim() != 2 || array.shape(1) != 6 || static_cast<std::size_t>(array.shape(0)) != bones)
        value_error(name, "must have the shape (" + std::to_string(bones) + ", 6), one row a bone, not " +
                              shape_of(array));
    std::vector<chains::JointLimits> limits(bones);
    for (std::size_t i = 0; i < bones; ++i) {
        const auto row = static_cast<py::ssize_t>(i);
        for (int axis = 0; axis < 3; ++axis) {
            limits[i].min[axis] = array.at(row, axis);
            limits[i].max[axis] = array.at(row, axis + 3);
            if (!(limits[i].min[axis] <= limits[i].max[axis]))
                value_error(name, "every minimum must be no more than its maximum");
            if (limits[i].min[axis] == chains::JointLimits::free ||
                limits[i].max[axis] == -chains::JointLimits::free)
                value_error(name, "every minimum must be below inf and every maximum above -inf");
        }
    }
    return limits;
}

std::vector<glm::dquat> frames_argument(const OptionalArrayLike& object, std::span<const glm::dvec3> joints) {
    if (object.is_none()) {
        std::vector<glm::dquat> frames(joints.size() - 1);
        chains::bone_frames(joints, frames);
        return frames;
    }
    const Rotations given(object, "frames");
    if (given.is_single() || given.values().size() != joints.size() - 1)
        value_error("frames",
                    "must have the shape (" + std::to_string(joints.size() - 1) + ", 4), one row a bone");
    return {given.values().begin(), given.values().end()};
}

/// The chain with the given pose as its rest: rotations are relative to it.
struct LimitedInput {
    std::vector<glm::dquat> rest;
    std::vector<glm::dvec3> offsets;
    std::vector<chains::JointLimits> limits;
    std::vector<glm::dquat> rotations;
    chains::Limited chain;

    LimitedInput(std::span<const glm::dvec3> joints, std::span<const glm::dquat> frames,
                 std::vector<chains::JointLimits> given)
        : limits(std::move(given)), rotations(frames.size(), {1.0, 0.0, 0.0, 0.0}) {
        for (std::size_t i = 0; i < frames.size(); ++i) {
            rest.push_back(i == 0 ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                  : glm::normalize(glm::conjugate(frames[i - 1]) * frames[i]));
            offsets.push_back(glm::conjugate(frames[i]) * (joints[i + 1] - joints[i]));
        }
        chain = {.root = joints[0], .base = frames[0], .rest = rest, .offsets = offsets, .limits = limits};
    }
};

ChainSolution solve(const py::object& reason_type, const ArrayLike& joints, const ArrayLike& target,
                    const Number& tolerance, const WholeNumber& max_iterations, const OptionalArrayLike& pole,
                    const OptionalArrayLike& limits, const OptionalArrayLike& plane,
                    const OptionalArrayLike& frames) {
    const Points given(joints, "joints");
    const std::span<const glm::dvec3> pose = given.values();
    if (pose.size() < 2 || pose.size() > chains::most_bones + 1)
        value_error("joints", "must have 2 to 256 rows, not " + std::to_string(pose.size()));
    const glm::dvec3 to = vector(target, "target");
    const chains::SolverSettings settings = settings_of(tolerance, max_iterations, pole, plane);
    check_size(pose, "joints");
    check_size({&to, 1}, "target");
    if (limits.is_none() && !frames.is_none()) value_error("frames", "are read with limits only");

    DoubleArray result = to_array(pose);
    const std::span<glm::dvec3> out = points_of(result);
    chains::Convergence report;
    py::object rotations = py::none();
    if (limits.is_none()) {
        const ReleaseGil released(out.size(), free_cost);
        report = chains::solve(out, to, settings);
    } else {
        LimitedInput input(pose, frames_argument(frames, pose), limits_argument(limits, pose.size() - 1));
        {
            const ReleaseGil released(out.size(), limited_cost);
            report = chains::solve_limited(input.chain, to, settings, input.rotations);
            chains::joints_of(input.chain, input.rotations, out);
        }
        DoubleArray rows = new_array({input.rotations.size(), 4});
        const std::span<glm::dquat> quaternions = quaternions_in(rows.mutable_data(), input.rotations.size());
        std::ranges::copy(input.rotations, quaternions.begin());
        rows_from_quaternions(quaternions);
        rotations = rows;
    }
    return {result, rotations, report.residual, report.iterations,
            reason_type(static_cast<int>(report.reason))};
}

void bind_solution(py::module_& m) {
    py::class_<ChainSolution>(m, "ChainSolution", py::module_local(), R"(
The positions of a chain's joints, from solve_chain().)")
        .def_readonly("joints", &ChainSolution::joints, "(n + 1, 3), the root first.")
        .def_readonly("rotations", &ChainSolution::rotations, R"(
(n, 4): each bone's rotation relative to the given pose, seen from the bone before it, for which the limits hold.
None without limits.)")
        .def_readonly("residual", &ChainSolution::residual, "Distance from the tip to the target.")
        .def_readonly("iterations", &ChainSolution::iterations,
                      "Steps taken; with limits those of all starts.")
        .def_readonly("reason", &ChainSolution::reason, R"(
A Reason: REACHED if the residual is within the tolerance; TOO_FAR or TOO_NEAR if no chain of these lengths
reaches the target; LIMIT if the limits do not let it; ITERATIONS if there were too few of them.)");
}

}  // namespace

void bind_chain(py::module_& m) {
    const py::object reason_type = m.attr("Reason");
    bind_solution(m);
    m.def(
        "solve_chain",
        [reason_type](const ArrayLike& joints, const ArrayLike& target, const Number& tolerance,
                      const WholeNumber& max_iterations, const OptionalArrayLike& pole,
                      const OptionalArrayLike& limits, const OptionalArrayLike& plane,
                      const OptionalArrayLike& frames) {
            return solve(reason_type, joints, target, tolerance, max_iterations, pole, limits, plane, frames);
        },
        "joints"_a, "target"_a, "tolerance"_a = 1e-6, "max_iterations"_a = 100, "pole"_a = py::none(),
        "limits"_a = py::none(), "plane"_a = py::none(), "frames"_a = py::none(), R"(
Brings the last joint of a chain of 1 to 255 bones to a target. Any space, any unit of length; coordinates up to 1e300.

joints: (n + 1, 3), the pose to start from, the root first. Root and lengths are kept, and the
shape of the pose and the plane that it bends in as far as possible. Straight and folded poses and bones without length are fine.
target: (3,).  tolerance: residual that counts as reached, > 0, a fraction of the chain's length.
max_iterations: >= 0; with limits those of one start of several.
pole: (3,), a point that the chain bends towards, seen across the line from root to target, or None. Fades out if it
lies within 6 degrees of that line. With limits it only leads the start.
plane: (3,), normal of the plane to bend in if the pose is straight, or None for a fixed one; the bend is then on the
side of cross(plane, target - root).
limits: (n, 6), rows of min x, y, z, max x, y, z in rad, -inf and inf for free: how far each bone may turn from the given
pose, seen from the bone before it. The turn is split into a twist about the bone (y) and a swing about x and z within
the ellipse that the four limits span; an interval that does not contain 0 bounds its axis by itself.
frames: (n, 4), each bone's frame in the given pose, whose Y is along the bone and whose X and Z are the axes of the limits; read
with limits only. None: the first is +Y turned to the first bone by the smallest rotation, each of the others is the frame before it
turned by the smallest rotation from bone to bone; half a turn about X if bones are opposite.
A target out of reach gives, without limits, the chain straight or folded on the line to it, else the nearest place that
several starts find.
Returns a ChainSolution.  Raises ValueError or TypeError that names the argument.)");
}

}  // namespace motus::bindings
