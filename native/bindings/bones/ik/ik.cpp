// Inverse kinematics of a rig's chains, and the bone spaces beneath it.
#include "motus/bones/ik/ik.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "areas.hpp"
#include "bones/goals.hpp"
#include "bones/rig_arrays.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "motus/bones/ik/floor.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bindings {
namespace {

namespace chains = bones::chains;
namespace ik = bones::ik;

using namespace pybind11::literals;

constexpr double chain_bone_cost = 500.0;  // ns, rough

enum SettingsColumn : std::size_t {
    position_weight,
    rotation_weight,
    softness,
    stretch,
    volume,
    pole_angle,
    bend,
    hinge_angle,
    tolerance,
    iterations,
    use_limits,
    is_on,
    left_out
};
constexpr std::array settings_columns{
    "position_weight", "rotation_weight", "softness",   "stretch",    "volume", "pole_angle", "bend",
    "hinge_angle",     "tolerance",       "iterations", "use_limits", "is_on",  "left_out"};
using SettingsRow = std::span<const double, settings_columns.size()>;
constexpr std::array report_columns{"residual", "angle", "reason", "iterations", "distance",
                                    "reach",    "tip_x", "tip_y",  "tip_z"};

static_assert(sizeof(glm::dmat4) == 16 * sizeof(double) && sizeof(chains::JointLimits) == 6 * sizeof(double));

template <class Names>
Typed<"tuple[str, ...]"> names_of(const Names& names) {
    py::tuple result(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) result[i] = names[i];
    return result;
}

/// The settings of a row of the table. A chain with a number that is not finite stays in its FK pose, as one
/// whose weight is not.
[[nodiscard]] ik::ChainSettings settings_of(SettingsRow row) {
    constexpr double most_iterations = 1e6,
                     most_left_out = chains::most_bones;  // more is the same to the library
    const bool is_finite = are_finite(std::span<const double>(row));
    ik::ChainSettings settings;
    settings.position_weight = is_finite ? row[position_weight] : std::numeric_limits<double>::quiet_NaN();
    settings.rotation_weight = row[rotation_weight];
    settings.softness = row[softness];
    settings.stretch = row[stretch];
    settings.volume = row[volume];
    settings.pole_angle = row[pole_angle];
    settings.bend = row[bend] < 0.0 ? -1 : 1;
    settings.hinge_angle = row[hinge_angle];
    settings.tolerance = row[tolerance];
    if (is_finite) {
        settings.max_iterations = static_cast<int>(std::clamp(row[iterations], 0.0, most_iterations));
        settings.left_out = static_cast<std::size_t>(std::clamp(row[left_out], 0.0, most_left_out));
    }
    settings.use_limits = row[use_limits] != 0.0;
    settings.is_on = row[is_on] != 0.0;
    return settings;
}

[[nodiscard]] std::vector<ik::ChainSettings> settings_of(const Float64Array& table, std::size_t count) {
    const std::span<const double> numbers =
        elements<double>(table, "settings", {count, settings_columns.size()});
    std::vector<ik::ChainSettings> settings(count);
    for (std::size_t i = 0; i < count; ++i)
        settings[i] =
            settings_of(numbers.subspan(i * settings_columns.size()).first<settings_columns.size()>());
    return settings;
}

[[nodiscard]] DoubleArray table_of(std::span<const ik::ChainDiagnostics> report) {
    DoubleArray table = new_array({report.size(), report_columns.size()});
    double* next = table.mutable_data();
    for (const ik::ChainDiagnostics& one : report) {
        const double reason = one.reason ? static_cast<double>(*one.reason) : -1.0;
        for (const double number : {one.residual, one.angle, reason, static_cast<double>(one.iterations),
                                    one.distance, one.reach, one.tip.x, one.tip.y, one.tip.z})
            *next++ = number;
    }
    return table;
}

/// Rows of an array of doubles as structures of so many doubles.
template <class Row>
std::span<const Row> rows_of(py::handle object, std::string_view name, std::size_t count) {
    const std::span<const double> values =
        elements<double>(object, name, {count, sizeof(Row) / sizeof(double)});
    return {reinterpret_cast<const Row*>(values.data()), count};
}

template <class Row>
std::span<Row> new_rows(DoubleArray& array, std::size_t count) {
    array = new_array({count, sizeof(Row) / sizeof(double)});
    return {reinterpret_cast<Row*>(array.mutable_data()), count};
}

std::unique_ptr<ik::ChainPlan> new_plan(const ArrayLike& parents, const ArrayLikes& chains,
                                        const ArrayLike& effectors, const ArrayLike& guards) {
    if (!py::isinstance<py::sequence>(chains)) type_error("chains", "must be a list of lists of bones");
    const auto list = py::reinterpret_borrow<py::sequence>(chains);
    const std::vector<int> ends = whole_numbers(effectors, "effectors");
    if (ends.size() != py::len(list)) value_error("effectors", "must have one bone for each chain");
    std::vector<ik::ChainBones> bones;
    for (std::size_t i = 0; i < ends.size(); ++i)
        bones.push_back({whole_numbers(list[i], "chains"), ends[i]});

    const auto pairs = py::array_t<int, py::array::c_style | py::array::forcecast>::ensure(guards);
    if (!pairs) type_error("guards", "must be rows of whole numbers: bone, chain");
    const bool is_empty = pairs.size() == 0;
    if (!is_empty && (pairs.ndim() != 2 || pairs.shape(1) != 2))
        value_error("guards", "must have the shape (g, 2), not " + shape_of(pairs));
    std::vector<ik::Guard> kept;
    for (py::ssize_t i = 0; !is_empty && i < pairs.shape(0); ++i)
        kept.push_back({pairs.at(i, 0), pairs.at(i, 1)});
    return std::make_unique<ik::ChainPlan>(whole_numbers(parents, "parents"), std::move(bones), kept);
}

Typed<"tuple[int, ...]"> tuple_of(std::span<const int> numbers) {
    py::tuple result(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) result[i] = numbers[i];
    return result;
}

Typed<"tuple[bool, ...]"> flags_of(std::span<const unsigned char> flags) {
    py::tuple result(flags.size());
    for (std::size_t i = 0; i < flags.size(); ++i) result[i] = flags[i] != 0;
    return result;
}

ik::RestBones read_rest(const ik::ChainPlan& plan, const Float32Array& rest, const Float32Array& lengths,
                        const Int32Array& inheritance) {
    const std::size_t bones = plan.parents().size();
    bones::RigArrays rig = rig_at_rest(plan.parents(), rest, inheritance);
    rig.lengths = elements<float>(lengths, "lengths", {bones});
    return {plan, rig};
}

ik::AnimatedBones read_bones(const ik::ChainPlan& plan, const Typed<"motus_native.IkRest">& rest,
                             const Float32Array& basis) {
    return {plan, instance<ik::RestBones>(rest, "rest", "an IkRest"),
            elements<float>(basis, "basis", {plan.parents().size(), 16})};
}

/// A copy of the arguments of solve() and match(), which check
/// values and read them again without the interpreter's lock.
struct CopiedInput {
    std::vector<float> poses;
    std::vector<ik::ChainSettings> settings;
    std::vector<glm::dmat4> targets;
    std::vector<glm::dvec3> poles;
    std::vector<chains::JointLimits> limits;
    ik::ChainInput input;  ///< of the above

    /// The arguments that solve() and match() have in common.
    CopiedInput(const ik::ChainPlan& plan, const ik::AnimatedBones& bones, const Float32Array& given_poses,
                const ArrayLike& world, const Float64Array& given_settings)
        : poses(copied(elements<float>(given_poses, "poses", {plan.parents().size(), 16}))),
          settings(settings_of(given_settings, plan.chain_count())) {
        input.bones = bones;
        input.poses = poses;
        input.world = matrix_of_columns(world, "world");
        input.settings = settings;
    }
    ~CopiedInput() = default;
    CopiedInput(const CopiedInput&) = delete;
    CopiedInput& operator=(const CopiedInput&) = delete;
    CopiedInput(CopiedInput&&) = delete;
    CopiedInput& operator=(CopiedInput&&) = delete;
};

py::object solve(const ik::ChainPlan& plan, const Typed<"motus_native.IkBones">& bones,
                 const Float32Array& poses, const ArrayLike& world, const Float64Array& settings,
                 const Float64Array& targets, const Float64Array& poles, const OptionalFloat64Array& limits,
                 const OptionalFloat64Array& rotations, const OptionalFloat64Array& scales) {
    const std::size_t chains = plan.chain_count();
    const std::size_t rows = plan.rows().size();
    CopiedInput given(plan, instance<ik::AnimatedBones>(bones, "bones", "an IkBones"), poses, world,
                      settings);
    given.targets = copied(rows_of<glm::dmat4>(targets, "targets", chains));
    given.poles = copied(rows_of<glm::dvec3>(poles, "poles", chains));
    if (!limits.is_none())
        given.limits = copied(rows_of<chains::JointLimits>(limits, "limits", plan.chain_bone_count()));
    given.input.targets = given.targets;
    given.input.poles = given.poles;
    given.input.limits = given.limits;
    auto rotation_rows = output<double>(rotations, "rotations", {static_cast<py::ssize_t>(rows), 4});
    auto scale_rows = output<double>(scales, "scales", {static_cast<py::ssize_t>(rows), 3});
    require_apart(values_of(rotation_rows), "rotations", values_of(scale_rows), "scales");
    std::vector<ik::ChainDiagnostics> report(chains);
    ik::ChainOutput result;
    result.rotations = quaternions_in(rotation_rows.mutable_data(), rows);
    result.scales = points_of(scale_rows);
    result.report = report;
    {
        const ReleaseGil released(plan.chain_bone_count(), chain_bone_cost);
        ik::solve(plan, given.input, result);
        rows_from_quaternions(result.rotations);
    }
    return table_of(report);
}

Typed<"tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]"> match(
    const ik::ChainPlan& plan, const Typed<"motus_native.IkBones">& bones, const Float32Array& poses,
    const ArrayLike& world, const Float64Array& settings) {
    const std::size_t chains = plan.chain_count();
    const CopiedInput given(plan, instance<ik::AnimatedBones>(bones, "bones", "an IkBones"), poses, world,
                            settings);
    DoubleArray targets, poles;
    const std::span<glm::dmat4> target_rows = new_rows<glm::dmat4>(targets, chains);
    const std::span<glm::dvec3> pole_rows = new_rows<glm::dvec3>(poles, chains);
    {
        const ReleaseGil released(plan.chain_bone_count(), chain_bone_cost);
        ik::match(plan, given.input, target_rows, pole_rows);
    }
    return py::make_tuple(targets, poles);
}

DoubleArray above_floor(const ArrayLike& target, const ArrayLike& place, const ArrayLike& up,
                        const Number& height, const Number& margin) {
    const ik::Floor floor{vector(place, "place"), vector(up, "up"), number(height, "height"),
                          number(margin, "margin")};
    return to_array(ik::above_floor(vector(target, "target"), floor));
}

bones::Rest bone_argument(const ArrayLike& rest, const OptionalArrayLike& parent_rest,
                          const InheritScaleName& scale, const Flag& rotation, const Flag& location) {
    bones::Rest bone;
    bone.matrix = matrix(rest, "rest");
    bone.has_parent = !parent_rest.is_none();
    if (bone.has_parent) bone.parent_matrix = matrix(parent_rest, "parent_rest");
    bone.inherit_scale = choice<bones::InheritScale>(scale, "inherit_scale",
                                                     {{"FULL", bones::InheritScale::full},
                                                      {"FIX_SHEAR", bones::InheritScale::fix_shear},
                                                      {"ALIGNED", bones::InheritScale::aligned},
                                                      {"AVERAGE", bones::InheritScale::average},
                                                      {"NONE", bones::InheritScale::none},
                                                      {"NONE_LEGACY", bones::InheritScale::none_legacy}});
    bone.inherit_rotation = flag(rotation, "inherit_rotation");
    bone.local_location = flag(location, "local_location");
    return bone;
}

bones::ParentSpace space_argument(const bones::Rest& bone, const OptionalArrayLike& parent_pose) {
    if (bone.has_parent && parent_pose.is_none()) value_error("parent_pose", "is needed with parent_rest");
    return bones::parent_space(bone, bone.has_parent ? matrix(parent_pose, "parent_pose") : glm::dmat4(1.0));
}

py::object matrix_array(const glm::dmat4& matrix) {
    DoubleArray result = new_array({4, 4});
    double* next = result.mutable_data();
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) *next++ = matrix[column][row];
    }
    return result;
}

py::object bone_to_pose(const ArrayLike& rest, const OptionalArrayLike& parent_rest,
                        const OptionalArrayLike& parent_pose, const ArrayLike& basis,
                        const InheritScaleName& inherit_scale, const Flag& inherit_rotation,
                        const Flag& local_location) {
    const bones::Rest bone =
        bone_argument(rest, parent_rest, inherit_scale, inherit_rotation, local_location);
    return matrix_array(to_pose(space_argument(bone, parent_pose), matrix(basis, "basis")));
}

py::object pose_to_bone(const ArrayLike& rest, const OptionalArrayLike& parent_rest,
                        const OptionalArrayLike& parent_pose, const ArrayLike& pose,
                        const InheritScaleName& inherit_scale, const Flag& inherit_rotation,
                        const Flag& local_location) {
    const bones::Rest bone =
        bone_argument(rest, parent_rest, inherit_scale, inherit_rotation, local_location);
    return matrix_array(to_basis(space_argument(bone, parent_pose), matrix(pose, "pose")));
}

}  // namespace

void bind_rig_ik(py::module_& m) {
    bind_goals(m);
    const py::class_<ik::RestBones> rest(m, "IkRest", py::module_local(),
                                         "Bones at rest, of one IkPlan; made by IkPlan.rest(). Immutable.");
    const py::class_<ik::AnimatedBones> bones(
        m, "IkBones", py::module_local(),
        "Bones as they are animated, of one IkPlan; made by IkPlan.bones(). Immutable.");
    py::class_<ik::ChainPlan> plan(m, "IkPlan", py::module_local(), R"(
Chains of one rig's bones, solved together. Immutable.

parents: (b,) parent of each bone, -1 for none.  chains: lists of bones from root to tip, each a child of the one before,
1 to 255.  effectors: (c,) the bone that each chain brings to its target: its last bone, whose tail is then the tip, or a
child of its last bone, whose head is then the tip.  guards: (g, 2) bone and chain: children of chain bones, outside the chain, that are not
stretched with it.
If a chain with guards has an effector outside the chain, the effector's row is in pose space; the effector may be listed as
a guard too.
Raises ValueError or TypeError that names the argument.)");
    plan.def(py::init(&new_plan), "parents"_a, "chains"_a, "effectors"_a, "guards"_a);
    plan.def_property_readonly(
        "rows", [](const ik::ChainPlan& self) { return tuple_of(self.rows()); },
        "Bone of each result row: all chain bones, chain by chain; effectors that are no chain bones; "
        "guards.");
    plan.def_property_readonly(
        "absolute", [](const ik::ChainPlan& self) { return flags_of(self.is_absolute()); },
        "Whether each row is rotation and scale in pose space; else they come on top of the bone's own.");
    plan.attr("SETTINGS") = names_of(settings_columns);
    plan.attr("REPORT") = names_of(report_columns);
    plan.def("rest", &read_rest, "rest"_a, "lengths"_a, "inheritance"_a, R"(
Reads the plan's bones at rest: an IkRest, valid until the armature is edited.

rest: (b, 16) float32, Bone.matrix_local as foreach_get gives it.  lengths: (b,) float32.  inheritance: (b,) int32, the
number of Bone.inherit_scale (FULL 0, FIX_SHEAR 1, ALIGNED 2, AVERAGE 3, NONE 4, NONE_LEGACY 5), + 8 if it inherits
rotation, + 16 if its location is local.  Wrong shapes and types raise ValueError or TypeError that names the argument.)");
    plan.def("bones", &read_bones, "rest"_a, "basis"_a, R"(
Reads the plan's bones as they are animated: an IkBones, valid until a bone's own transform changes.

rest: a result of rest().  basis: (b, 16) float32, PoseBone.matrix_basis as foreach_get gives it.
Wrong shapes and types raise ValueError or TypeError that names the argument.)");
    plan.def("solve", &solve, "bones"_a, "poses"_a, "world"_a, "settings"_a, "targets"_a, "poles"_a,
             "limits"_a = py::none(), "rotations"_a = py::none(), "scales"_a = py::none(), R"(
Turns the chains from their animated (FK) pose to their targets.

bones: a result of bones().  poses: (b, 16) float32, PoseBone.matrix as foreach_get gives it; only the parents of chains are read.
All float64 from here on.  world: (16,) the rig's matrix_world, column by column.
settings: (c, len(SETTINGS)).  targets: (c, 16) world matrices, column by column.  poles: (c, 3) world, NaN for none.
limits: (chain bones, 6) rad, least x, y, z and greatest x, y, z of swing (x, z) and twist (y), or None.
rotations, scales: (rows, 4) w, x, y, z and (rows, 3) to write into; C-contiguous, apart in memory.
Settings: position_weight, rotation_weight, stretch 0 to 1; volume the share, 0 to 1, that stretched bones keep of theirs; softness a fraction of the chain's length; pole_angle,
hinge_angle rad; bend < 0 away from the pole; tolerance a fraction of the length; use_limits, is_on 0 or not; left_out how many of
the chain's first bones stay as they are animated.
Returns (c, len(REPORT)): residual, distance, reach and tip in the world, of the solution with position_weight 1; angle left
between effector and target, rad; reason a code of Reason, or -1.
Numbers that are not finite are allowed: such a chain's rows are neutral and its reason is -1. Wrong shapes and types
raise ValueError or TypeError that names the argument.)");
    plan.def("match", &match, "bones"_a, "poses"_a, "world"_a, "settings"_a, R"(
Targets and poles for which the solution is the animated pose: ((c, 16), (c, 3)), as solve() takes them.

The targets are rigid. A chain with numbers that are not finite gets the identity and no pole (NaN).)");

    m.def("above_floor", &above_floor, "target"_a, "place"_a, "up"_a, "height"_a = 0.0, "margin"_a = 0.0, R"(
A chain's target, or the place above a floor that takes its stead.

target: (3,).  place: (3,), a point of the floor's plane.  up: (3,), away from the floor; of no length: there is no floor.
height: of the lowest target above the plane.  margin: within it, above and below that height, targets are held back softly.
Returns (3,).  Raises ValueError or TypeError that names the argument.)");
    m.def("bone_to_pose", &bone_to_pose, "rest"_a, "parent_rest"_a, "parent_pose"_a, "basis"_a,
          "inherit_scale"_a = "FULL", "inherit_rotation"_a = true, "local_location"_a = true, R"(
A bone's pose in armature space, as Blender makes it from the bone's own transform (Bone.convert_local_to_pose).

rest, basis, parent_rest, parent_pose: (4, 4) in rows; the last two None without a parent.
inherit_scale: 'FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE' or 'NONE_LEGACY'.  Returns (4, 4).)");
    m.def("pose_to_bone", &pose_to_bone, "rest"_a, "parent_rest"_a, "parent_pose"_a, "pose"_a,
          "inherit_scale"_a = "FULL", "inherit_rotation"_a = true, "local_location"_a = true, R"(
The inverse of bone_to_pose(): a bone's own transform from its pose. Arguments as there.)");
}

}  // namespace motus::bindings
