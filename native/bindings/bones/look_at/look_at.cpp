// Look-at: the shares of a turn, and the bones of rigs.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "areas.hpp"
#include "bones/rig_arrays.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "motus/bones/look_at/eyes.hpp"
#include "motus/bones/look_at/gaze.hpp"
#include "motus/bones/look_at/plan.hpp"

namespace motus::bindings {
namespace {

namespace look_at = bones::look_at;

using namespace pybind11::literals;
using std::numbers::pi;

constexpr double turn_cost = 300.0;    // ns, rough
constexpr double entry_cost = 1500.0;  // ns, rough
constexpr double eyes_cost = 100.0;    // ns, rough

// --- look_at ---------------------------------------------------------------------------------------------

[[nodiscard]] double fraction(const Number& object, const char* name) {
    const double value = number(object, name);
    if (value < 0.0 || value > 1.0) value_error(name, "must lie in [0, 1]");
    return value;
}

[[nodiscard]] double limit(const Number& object, const char* name) {
    const double value = number(object, name);
    if (value < 0.0) value_error(name, "must be >= 0");
    return value;
}

/// (4,) rad: left, right, up, down; no limits if None.
[[nodiscard]] look_at::SideLimits side_limits(const OptionalArrayLike& object, const char* name) {
    if (object.is_none()) return {};
    const DoubleArray given = doubles(object, name);
    if (given.ndim() != 1 || given.shape(0) != 4)
        value_error(name, "must have the shape (4,), not " + shape_of(given));
    const std::span<const double, 4> sides(given.data(), 4);
    if (!std::ranges::all_of(sides, [](double side) { return side >= 0.0; }))
        value_error(name, "must be >= 0");
    return {sides[0], sides[1], sides[2], sides[3]};
}

[[nodiscard]] glm::dvec3 unit(const glm::dvec3& v, const char* name) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0.0) value_error(name, "must have a length");
    return v / (largest * glm::length(v / largest));
}

/// The result as Python sees it: values for one target, arrays for many.
struct Turns {
    DoubleArray body, head, eyes;
    py::object residual, reason;
};

Turns look_at_targets(const py::object& reason_type, const ArrayLike& forward, const ArrayLike& targets,
                      const OptionalArrayLike& chest, const ArrayLike& up, const Number& weight,
                      const Number& body_weight, const Number& head_weight, const Number& eyes_weight,
                      const Number& clamp, const Number& body_limit, const Number& head_limit,
                      const Number& eyes_limit, const OptionalArrayLike& head_sides,
                      const OptionalArrayLike& eyes_sides) {
    const glm::dvec3 animated = unit(vector(forward, "forward"), "forward");
    const glm::dvec3 ahead = chest.is_none() ? animated : unit(vector(chest, "chest"), "chest");
    const glm::dvec3 above = unit(vector(up, "up"), "up");
    constexpr double least_sine = 1e-6;
    if (glm::length(glm::cross(above, ahead)) < least_sine)
        value_error("up", std::string("must not lie along ") + (chest.is_none() ? "forward" : "chest"));
    const look_at::GazeSettings settings{fraction(weight, "weight"),
                                         fraction(body_weight, "body_weight"),
                                         fraction(head_weight, "head_weight"),
                                         fraction(eyes_weight, "eyes_weight"),
                                         fraction(clamp, "clamp"),
                                         limit(body_limit, "body_limit"),
                                         limit(head_limit, "head_limit"),
                                         limit(eyes_limit, "eyes_limit"),
                                         side_limits(head_sides, "head_sides"),
                                         side_limits(eyes_sides, "eyes_sides")};
    const DoubleArray given = doubles(targets, "targets");
    const bool is_single = given.ndim() == 1;
    if (given.ndim() < 1 || given.ndim() > 2 || given.shape(given.ndim() - 1) != 3)
        value_error("targets", "must have the shape (m, 3) or (3,), not " + shape_of(given));
    const std::size_t count = is_single ? 1 : static_cast<std::size_t>(given.shape(0));
    std::vector<glm::dvec3> directions;
    directions.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double* row = given.data() + 3 * i;
        directions.push_back(unit({row[0], row[1], row[2]}, "targets"));
    }

    const auto rows = [&] { return is_single ? new_array({4}) : new_array({count, 4}); };
    DoubleArray body = rows(), head = rows(), eyes = rows();
    DoubleArray residual = new_array({count});
    py::array_t<std::int64_t> reason(static_cast<py::ssize_t>(count));
    const std::span<double> residuals = values_of(residual);
    std::int64_t* const reasons = reason.mutable_data();
    const std::span<glm::dquat> body_out = quaternions_in(body.mutable_data(), count);
    const std::span<glm::dquat> head_out = quaternions_in(head.mutable_data(), count);
    const std::span<glm::dquat> eyes_out = quaternions_in(eyes.mutable_data(), count);
    {
        const ReleaseGil released(count, turn_cost);
        const look_at::GazeChart chart(ahead, above, look_at::level_for(settings));
        for (std::size_t i = 0; i < count; ++i) {
            const look_at::Turns turns = turns_to(chart, animated, directions[i], settings);
            body_out[i] = turns.body;
            head_out[i] = turns.head;
            eyes_out[i] = turns.eyes;
            residuals[i] = turns.residual;
            reasons[i] = static_cast<std::int64_t>(turns.reason);
        }
        rows_from_quaternions(body_out);
        rows_from_quaternions(head_out);
        rows_from_quaternions(eyes_out);
    }
    if (!is_single) return {body, head, eyes, residual, reason};
    return {body, head, eyes, py::float_(residuals[0]), reason_type(static_cast<int>(reasons[0]))};
}

// --- Plan ------------------------------------------------------------------------------------------

enum Column : std::size_t {
    weight,
    body_weight,
    head_weight,
    eyes_weight,
    clamp_column,
    body_limit,
    head_limit,
    eyes_limit,
    head_left_limit,
    head_right_limit,
    head_up_limit,
    head_down_limit,
    eyes_left_limit,
    eyes_right_limit,
    eyes_up_limit,
    eyes_down_limit,
    is_on,
    column_count
};
constexpr std::size_t report_count = 4;

[[nodiscard]] Typed<"tuple[str, ...]"> setting_names() {
    return py::make_tuple("weight", "body_weight", "head_weight", "eyes_weight", "clamp", "body_limit",
                          "head_limit", "eyes_limit", "head_left_limit", "head_right_limit", "head_up_limit",
                          "head_down_limit", "eyes_left_limit", "eyes_right_limit", "eyes_up_limit",
                          "eyes_down_limit", "is_on");
}

[[nodiscard]] Typed<"tuple[str, ...]"> report_names() {
    return py::make_tuple("angle", "reason", "yaw", "pitch");
}

[[nodiscard]] std::vector<std::vector<int>> bone_lists(const py::object& lists, const char* name) {
    if (PySequence_Check(lists.ptr()) == 0) wrong_type(lists, name, "a list of lists of bones");
    std::vector<std::vector<int>> result;
    for (const py::handle list : lists) result.push_back(whole_numbers(list, name));
    return result;
}

[[nodiscard]] look_at::GazePlan make_plan(const ArrayLike& parents, const ArrayLikes& bodies,
                                          const ArrayLike& heads, const ArrayLikes& eyes) {
    const std::vector<int> parent_of = whole_numbers(parents, "parents");
    std::vector<std::vector<int>> body_bones = bone_lists(bodies, "bodies");
    const std::vector<int> head_bones = whole_numbers(heads, "heads");
    std::vector<std::vector<int>> eye_bones = bone_lists(eyes, "eyes");
    if (body_bones.size() != head_bones.size()) value_error("bodies", "must have as many rows as heads");
    if (eye_bones.size() != head_bones.size()) value_error("eyes", "must have as many rows as heads");
    std::vector<look_at::GazeBones> entries;
    entries.reserve(head_bones.size());
    for (std::size_t i = 0; i < head_bones.size(); ++i)
        entries.push_back({std::move(body_bones[i]), head_bones[i], std::move(eye_bones[i])});
    return {parent_of, entries};
}

[[nodiscard]] look_at::GazeInput input_at(std::size_t entry, std::span<const double> settings,
                                          std::span<const double> head_forward, std::span<const double> up) {
    const std::span<const double> row = settings.subspan(entry * column_count, column_count);
    const auto vector_at = [entry](std::span<const double> rows) {
        return glm::dvec3(rows[3 * entry], rows[3 * entry + 1], rows[3 * entry + 2]);
    };
    look_at::GazeInput input;
    input.settings = {row[weight],       row[body_weight], row[head_weight], row[eyes_weight],
                      row[clamp_column], row[body_limit],  row[head_limit],  row[eyes_limit]};
    input.settings.head_sides = {row[head_left_limit], row[head_right_limit], row[head_up_limit],
                                 row[head_down_limit]};
    input.settings.eyes_sides = {row[eyes_left_limit], row[eyes_right_limit], row[eyes_up_limit],
                                 row[eyes_down_limit]};
    input.head_forward = vector_at(head_forward);
    if (!up.empty()) input.up = vector_at(up);
    input.is_on = row[is_on] != 0.0;
    return input;
}

DoubleArray solve_plan(const look_at::GazePlan& plan, const Float32Array& rest, const Float32Array& poses,
                       const Float32Array& basis, const Int32Array& inheritance, const ArrayLike& world,
                       const Float64Array& settings, const Float64Array& targets,
                       const Float64Array& head_forward, const Float64Array& eyes_forward,
                       const OptionalFloat64Array& rotations, const OptionalFloat64Array& up,
                       const OptionalFloat64Array& target_weights, const OptionalArrayLike& target_counts,
                       const OptionalFloat64Array& eyes_beside) {
    const std::size_t count = plan.size();
    const CopiedRig rig(plan.parents(), rest, poses, basis, inheritance);
    const glm::dmat4 to_world = matrix_of_columns(world, "world");
    const std::span<const double> setting_rows =
        elements<double>(settings, "settings", {count, column_count});
    const std::vector<int> targets_of =
        target_counts.is_none() ? std::vector<int>(count, 1) : whole_numbers(target_counts, "target_counts");
    if (targets_of.size() != count) value_error("target_counts", "must have as many rows as settings");
    if (!std::ranges::all_of(targets_of, [](int targets_of_one) { return targets_of_one >= 1; }))
        value_error("target_counts", "must be >= 1");
    const auto target_count =
        std::accumulate(targets_of.begin(), targets_of.end(), std::size_t{0},
                        [](std::size_t sum, int one) { return sum + static_cast<std::size_t>(one); });
    const std::span<const double> target_rows = elements<double>(targets, "targets", {target_count, 3});
    const std::span<const double> weight_rows =
        target_weights.is_none() ? std::span<const double>()
                                 : elements<double>(target_weights, "target_weights", {target_count});
    const std::span<const double> head_axes = elements<double>(head_forward, "head_forward", {count, 3});
    const std::size_t eye_count =
        std::accumulate(plan.eye_counts().begin(), plan.eye_counts().end(), std::size_t{0});
    const std::span<const double> eyes_axes = elements<double>(eyes_forward, "eyes_forward", {eye_count, 3});
    const std::span<const double> ups =
        up.is_none() ? std::span<const double>() : elements<double>(up, "up", {count, 3});
    const std::span<const double> beside = eyes_beside.is_none()
                                               ? std::span<const double>()
                                               : elements<double>(eyes_beside, "eyes_beside", {count, 2});
    const std::size_t row_count = plan.rows().size();
    auto rows = output<double>(rotations, "rotations", {static_cast<py::ssize_t>(row_count), 4});
    const std::span<double> row_values = values_of(rows);
    require_apart(setting_rows, "settings", row_values, "rotations");
    require_apart(target_rows, "targets", row_values, "rotations");
    require_apart(weight_rows, "target_weights", row_values, "rotations");
    require_apart(head_axes, "head_forward", row_values, "rotations");
    require_apart(eyes_axes, "eyes_forward", row_values, "rotations");
    require_apart(ups, "up", row_values, "rotations");
    require_apart(beside, "eyes_beside", row_values, "rotations");

    DoubleArray report = new_array({count, report_count});
    const std::span<double> report_values = values_of(report);
    const std::span<glm::dquat> out = quaternions_in(rows.mutable_data(), row_count);
    std::vector<glm::dvec3> eyes;
    for (std::size_t i = 0; i < eye_count; ++i)
        eyes.emplace_back(eyes_axes[3 * i], eyes_axes[3 * i + 1], eyes_axes[3 * i + 2]);
    std::vector<look_at::GazeInput> inputs;
    inputs.reserve(count);
    std::vector<look_at::GazeTarget> aims;
    for (std::size_t i = 0; i < target_count; ++i) {
        aims.push_back({{target_rows[3 * i], target_rows[3 * i + 1], target_rows[3 * i + 2]},
                        weight_rows.empty() ? 1.0 : weight_rows[i]});
    }
    std::span<const glm::dvec3> later_eyes = eyes;
    std::span<const look_at::GazeTarget> later_aims = aims;
    for (std::size_t i = 0; i < count; ++i) {
        look_at::GazeInput& input = inputs.emplace_back(input_at(i, setting_rows, head_axes, ups));
        if (!beside.empty()) input.eyes_beside = {beside[2 * i], beside[2 * i + 1]};
        input.eyes_forward = later_eyes.first(plan.eye_counts()[i]);
        later_eyes = later_eyes.subspan(plan.eye_counts()[i]);
        const auto own = static_cast<std::size_t>(targets_of[i]);
        input.target = later_aims.front().place;
        input.target_weight = later_aims.front().weight;
        input.further = later_aims.subspan(1, own - 1);
        later_aims = later_aims.subspan(own);
    }
    {
        const ReleaseGil released(count, entry_cost);
        std::vector<look_at::GazeDiagnostics> reports(count);
        plan.solve(rig.view(), to_world, inputs, out, reports);
        rows_from_quaternions(out);
        for (std::size_t i = 0; i < count; ++i) {
            const look_at::GazeDiagnostics& one = reports[i];
            const std::span<double> row = report_values.subspan(i * report_count, report_count);
            row[0] = one.angle;
            row[1] = one.reason ? static_cast<double>(*one.reason) : -1.0;
            row[2] = one.yaw;
            row[3] = one.pitch;
        }
    }
    return report;
}

// --- Eyes ------------------------------------------------------------------------------------------

DoubleArray saccades_at(const ArrayLike& seconds, const ArrayLike& amplitude, const Number& rate,
                        const WholeNumber& seed) {
    const Numbers times(seconds, "seconds");
    const Numbers amplitudes(amplitude, "amplitude");
    const std::size_t count = times.values().size();
    if (!amplitudes.is_single() && amplitudes.values().size() != count)
        value_error("amplitude", "must be a number or have as many rows as seconds");
    if (!std::ranges::all_of(amplitudes.values(), [](double one) { return one >= 0.0; }))
        value_error("amplitude", "must be >= 0");
    look_at::Saccades saccades;
    saccades.rate = limit(rate, "rate");
    saccades.seed = seed_of(seed);
    DoubleArray result = times.is_single() ? new_array({2}) : new_array({count, 2});
    const std::span<double> out = values_of(result);
    for (std::size_t i = 0; i < count; ++i) {
        saccades.amplitude = amplitudes.values()[amplitudes.is_single() ? 0 : i];
        const glm::dvec2 place = saccade(saccades, times.values()[i]);
        out[2 * i] = place.x;
        out[2 * i + 1] = place.y;
    }
    return result;
}

void bind_eyes(py::module_& m) {
    m.def("saccades", &saccades_at, "seconds"_a, "amplitude"_a, "rate"_a = 2.0, "seed"_a = 0, R"(
Where eyes look beside their target at times: small jumps between random places, as long as those of people.

seconds: a number or (m,).  amplitude: a number or (m,), farthest from the target, rad, >= 0.  rate: jumps a second on average,
>= 0, at most 100 count.  seed: a whole number from 0 to 2^32 - 1.
Returns (2,) or (m, 2): rad to the left and up.  Raises ValueError or TypeError that names the argument.)");
    m.def(
        "blink",
        [](const ArrayLike& since) {
            return map_numbers(Numbers(since, "since"), eyes_cost,
                               [](double seconds) { return look_at::blink(seconds); });
        },
        "since"_a, R"(
How far a blink has shut the eyes, 0 to 1.  since: a number or (m,), seconds after its beginning; it takes 0.3.
Returns a float or (m,).  Raises ValueError or TypeError that names the argument.)");
    m.def(
        "blinks",
        [](const ArrayLike& seconds, const Number& rate, const WholeNumber& seed) {
            return map_numbers(Numbers(seconds, "seconds"), eyes_cost,
                               [often = limit(rate, "rate"), from = seed_of(seed)](double time) {
                                   return look_at::blinks(often, from, time);
                               });
        },
        "seconds"_a, "rate"_a = 0.25, "seed"_a = 0, R"(
How far blinks have shut the eyes at times, 0 to 1: one at a random time in each 1 / rate.

seconds: a number or (m,).  rate: blinks a second, >= 0, at most 100 count.  seed: a whole number from 0 to 2^32 - 1.
Returns a float or (m,).  Raises ValueError or TypeError that names the argument.)");
}

void bind_turns(py::module_& m) {
    py::class_<Turns>(m, "LookAtTurns", py::module_local(), R"(
How a gaze turns to its target, from look_at(): of one target values, of m targets arrays with m rows.

body, head and eyes are quaternions (m, 4) or (4,), w, x, y, z; each comes on top of the one before: eyes * head * body.)")
        .def_readonly("body", &Turns::body, "(4,) or (m, 4).")
        .def_readonly("head", &Turns::head, "(4,) or (m, 4).")
        .def_readonly("eyes", &Turns::eyes, "(4,) or (m, 4).")
        .def_readonly("residual", &Turns::residual,
                      "A float or (m,): angle between the turned gaze and the target, rad.")
        .def_readonly("reason", &Turns::reason, R"(
A Reason or (m,) int64 of their codes: LIMIT if the clamp or a limit keeps the gaze off; REACHED if nothing but the
weights does.)");
}

}  // namespace

void bind_look_at(py::module_& m) {
    bind_turns(m);
    bind_eyes(m);
    m.def(
        "look_at",
        [reason_type = py::object(m.attr("Reason"))](
            const ArrayLike& forward, const ArrayLike& targets, const OptionalArrayLike& chest,
            const ArrayLike& up, const Number& weight, const Number& body_weight, const Number& head_weight,
            const Number& eyes_weight, const Number& clamp, const Number& body_limit,
            const Number& head_limit, const Number& eyes_limit, const OptionalArrayLike& head_sides,
            const OptionalArrayLike& eyes_sides) {
            return look_at_targets(reason_type, forward, targets, chest, up, weight, body_weight, head_weight,
                                   eyes_weight, clamp, body_limit, head_limit, eyes_limit, head_sides,
                                   eyes_sides);
        },
        "forward"_a, "targets"_a, "chest"_a = py::none(), "up"_a = py::make_tuple(0.0, 0.0, 1.0),
        "weight"_a = 1.0, "body_weight"_a = 0.3, "head_weight"_a = 1.0, "eyes_weight"_a = 0.0,
        "clamp"_a = 0.5, "body_limit"_a = pi, "head_limit"_a = pi, "eyes_limit"_a = pi,
        "head_sides"_a = py::none(), "eyes_sides"_a = py::none(),
        R"(
How body, head and eyes share the turn of a gaze to a target far away.

forward: (3,), direction in which the head looks before the turn.  targets: (m, 3) or (3,), directions to look in.  chest: (3,), direction of the
chest; forward if None.  up: (3,), the chest's up; its part across chest counts.  All in one space, of any length but 0.
weight: of the whole turn.  body_weight: share of the turn.  head_weight: share of what the body leaves.  eyes_weight:
share of what the head leaves.  clamp: 0 free, 0.5 90 degrees to each side, 1 no turn.  All in [0, 1].
body_limit, head_limit, eyes_limit: greatest turn of the gaze by each, rad, >= 0; from pi on none.
head_sides, eyes_sides: (4,), greatest parts of that turn to the left, to the right, up and down; None: none.
A turn adds no roll if both gazes lie within 37 degrees of the horizon (and, unless clamp is 0 and head_limit pi, within
73 degrees of chest).  With a clamp >= 0.5, or limits for all that turn, the result is a continuous function of the target;
else it changes sides if the target passes straight behind the chest.
Returns a LookAtTurns.
Raises ValueError or TypeError that names the argument.)");

    py::class_<look_at::GazePlan> plan(m, "LookAtPlan", py::module_local(), R"(
Bones of one rig that look at targets. The hierarchy is checked once.

parents: (B,), index of each bone's parent, -1 for none.  bodies: for each entry (n,) bones from the lowest up, below the
head; may be empty.  heads: (C,) bones.  eyes: for each entry (k,) bones above the head; may be empty.
rows: the bones of the result's rows: body, head, eyes of each entry.  SETTINGS, REPORT: names of columns.
Raises ValueError or TypeError that names the argument.)");
    plan.def(py::init(&make_plan), "parents"_a, "bodies"_a, "heads"_a, "eyes"_a);
    plan.def_property_readonly(
        "rows", [](const look_at::GazePlan& self) -> Typed<"tuple[int, ...]"> {
            const std::span<const int> rows = self.rows();
            py::tuple result(rows.size());
            for (std::size_t i = 0; i < rows.size(); ++i) result[i] = rows[i];
            return result;
        });
    plan.attr("SETTINGS") = setting_names();
    plan.attr("REPORT") = report_names();
    plan.def("solve", &solve_plan, "rest"_a, "poses"_a, "basis"_a, "inheritance"_a, "world"_a, "settings"_a,
             "targets"_a, "head_forward"_a, "eyes_forward"_a, "rotations"_a = py::none(), "up"_a = py::none(),
             "target_weights"_a = py::none(), "target_counts"_a = py::none(), "eyes_beside"_a = py::none(),
             R"(
Rotations that turn body, head and eyes of each entry to its target.

rest, poses, basis: (B, 16) float32: Bone.matrix_local, PoseBone.matrix, PoseBone.matrix_basis, column by column; of poses
only the parent of each entry's first bone is read.  inheritance: (B,) int32: Bone.inherit_scale | 8 use_inherit_rotation
| 16 use_local_location.  world: (16,), the rig's matrix_world, column by column.
settings: (C, 17), see SETTINGS and look_at().  targets: (T, 3), world space.  head_forward: (C, 3), eyes_forward: (E, 3) of
the eyes of all entries, axes of the bones that point where they look, of any length but 0.  up: (C, 3), the rig's upward
direction at rest, in armature space, of any length but 0; None: Z.
target_counts: (C,), how many of the targets, in order, each entry has, at least one; None: one each.  target_weights: (T,), less
than 0 counts as 0; None: 1.  An entry looks in the mean by weight of its targets' directions; of weights that sum up to less than 1
the animated gaze takes the rest.  eyes_beside: (C, 2), how far beside that direction the eyes look, rad to the left and up, times
weight, within their limits; see saccades(); None: 0.
rotations: a C-contiguous float64 array (rows, 4) to write into, which shares no memory with other arguments; None: only the
report.  Its rows are w, x, y, z and come on top of each bone's own rotation; the identity if nothing turns.
Returns (C, 4), see REPORT: angle between gaze and target, rad; reason (a Reason: REACHED or LIMIT; -1 if an input is not
finite or a bone that looks has no size); yaw (positive to the left) and pitch (positive up) of the target, rad.
Raises ValueError or TypeError that names the argument; numbers that are not finite do not raise.)");
}

}  // namespace motus::bindings
