// Masked layers of animation: clips, masks, when they play, and what they make of a rig's pose.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "areas.hpp"
#include "bones/rig_arrays.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "fcurve/fcurve.hpp"
#include "motus/bones/layers/clip.hpp"
#include "motus/bones/layers/mask.hpp"
#include "motus/bones/layers/stack.hpp"
#include "motus/bones/layers/timing.hpp"
#include "motus/bones/turns.hpp"
#include "motus/core/numeric.hpp"

namespace motus::bindings {
namespace {

namespace layers = bones::layers;
using layers::Transform;

using namespace pybind11::literals;

constexpr double bone_cost = 200.0;  // ns, rough
constexpr std::size_t row_size = 10;

// --- LayerClip -------------------------------------------------------------------------------------------

constexpr std::size_t curve_size = 4;

[[nodiscard]] std::vector<layers::Rotation> rotation_modes(const ArrayLike& given) {
    std::vector<layers::Rotation> result;
    for (const int mode : whole_numbers(given, "rotations")) {
        if (mode < 0 || mode > 7) value_error("rotations", "a mode must be 0 to 7");
        result.push_back(static_cast<layers::Rotation>(mode));
    }
    return result;
}

[[nodiscard]] std::size_t rows_of(const py::object& given, std::string_view name) {
    const py::array array = py::array::ensure(given);
    if (!array || array.ndim() < 1) value_error(name, "must be an array of rows");
    return static_cast<std::size_t>(array.shape(0));
}

[[nodiscard]] layers::Clip make_clip(const ArrayLike& rotations, const Int32Array& curves,
                                     const FCurves& fcurves) {
    const std::size_t count = rows_of(curves, "curves");
    const std::span<const int> rows = elements<int>(curves, "curves", {count, curve_size});
    std::vector<layers::ClipCurve> read;
    read.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::span<const int> row = rows.subspan(i * curve_size, curve_size);
        read.push_back({row[0], row[1], row[2], row[3] != 0});
    }
    return {rotation_modes(rotations), read, fcurves_in(fcurves, "fcurves")};
}

constexpr double turn_cost = 60.0;  // ns, rough

DoubleArray rotations_of(const WholeNumber& mode, const ArrayLike& numbers) {
    const int index = whole_number(mode, "mode");
    if (index < 0 || index > 7) value_error("mode", "must be 0 to 7");
    const DoubleArray given = doubles(numbers, "numbers");
    if (given.ndim() != 2 || given.shape(1) != 4)
        value_error("numbers", "must have the shape (n, 4), not " + shape_of(given));
    const auto count = static_cast<std::size_t>(given.shape(0));
    DoubleArray result = new_array({count, std::size_t{4}});
    double* out = values_of(result).data();
    const double* in = given.data();
    const ReleaseGil released(count, turn_cost);
    for (std::size_t i = 0; i < count; ++i, in += 4) {
        const glm::dquat q =
            layers::rotation_of(static_cast<layers::Rotation>(index), std::span<const double, 4>(in, 4));
        for (const double part : {q.w, q.x, q.y, q.z}) *out++ = part;
    }
    return result;
}

void write_row(const Transform& transform, std::span<double> row) {
    const glm::dquat& q = transform.rotation;
    const std::array<double, row_size> numbers{
        transform.location.x, transform.location.y, transform.location.z, q.w, q.x, q.y, q.z,
        transform.scale.x,    transform.scale.y,    transform.scale.z};
    std::ranges::copy(numbers, row.begin());
}

[[nodiscard]] Transform read_row(std::span<const double> row) {
    return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}, {row[7], row[8], row[9]}};
}

[[nodiscard]] std::vector<double> given_values(const py::object& given, std::size_t count) {
    const std::string wanted = "must have the shape (" + std::to_string(count) + ",)";
    if (given.is_none()) {
        if (count > 0) value_error("given", wanted);
        return {};
    }
    const DoubleArray array = doubles(given, "given");
    if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != count) value_error("given", wanted);
    return {array.data(), array.data() + array.size()};
}

DoubleArray clip_pose(const layers::Clip& clip, const Number& frame, const OptionalArrayLike& given) {
    const std::vector<double> values = given_values(given, clip.given_count());
    std::vector<Transform> pose(clip.bones().size());
    clip.evaluate(number(frame, "frame"), values, pose);
    DoubleArray result = new_array({pose.size(), row_size});
    const std::span<double> rows = values_of(result);
    for (std::size_t i = 0; i < pose.size(); ++i) write_row(pose[i], rows.subspan(i * row_size, row_size));
    return result;
}

DoubleArray clip_numbers(const layers::Clip& clip, const Number& frame, const OptionalArrayLike& given) {
    const std::vector<double> values = given_values(given, clip.given_count());
    std::vector<Transform> pose(clip.bones().size());
    std::vector<layers::Numbers> numbers(pose.size());
    clip.evaluate(number(frame, "frame"), values, pose, numbers);
    DoubleArray result = new_array({numbers.size(), std::size_t{4}});
    double* out = values_of(result).data();
    for (const layers::Numbers& row : numbers) out = std::ranges::copy(row, out).out;
    return result;
}

// --- layer_moments, layer_mask ---------------------------------------------------------------------------

/// Columns of settings.
enum Column : std::size_t {
    start,
    first,
    last,
    speed,
    after,
    blend_in,
    blend_out,
    weight,
    mode,
    in_armature,
    column_count
};

[[nodiscard]] Typed<"tuple[str, ...]"> setting_names() {
    return py::make_tuple("start", "first", "last", "speed", "after", "blend_in", "blend_out", "weight",
                          "mode", "in_armature");
}

[[nodiscard]] layers::LayerTiming timing_of(std::span<const double> row) {
    const double kind = row[after];
    layers::LayerTiming timing{row[start],
                               row[first],
                               std::max(row[first], row[last]),
                               row[speed],
                               layers::After::nothing,
                               std::max(0.0, row[blend_in]),
                               std::max(0.0, row[blend_out])};
    if (kind == 1.0) timing.after = layers::After::hold;
    if (kind == 2.0) timing.after = layers::After::repeat;
    return timing;
}

[[nodiscard]] std::span<const double> setting_rows(const Float64Array& settings, std::size_t count) {
    const std::span<const double> rows = elements<double>(settings, "settings", {count, column_count});
    if (!are_finite(rows)) value_error("settings", "every value must be finite");
    return rows;
}

DoubleArray moments(const Float64Array& settings, const Number& frame) {
    const std::size_t count = rows_of(settings, "settings");
    const std::span<const double> rows = setting_rows(settings, count);
    const double at = number(frame, "frame");
    DoubleArray result = new_array({count, 2});
    const std::span<double> out = values_of(result);
    for (std::size_t i = 0; i < count; ++i) {
        const layers::Moment moment = layers::moment_of(timing_of(rows.subspan(i * column_count)), at);
        out[2 * i] = moment.frame;
        out[2 * i + 1] = moment.weight;
    }
    return result;
}

DoubleArray mask(const ArrayLike& parents, const ArrayLike& chosen, const WholeNumber& feather) {
    const std::vector<int> above = whole_numbers(parents, "parents");
    const DoubleArray weights = doubles(chosen, "chosen");
    if (weights.ndim() != 1 || static_cast<std::size_t>(weights.size()) != above.size())
        value_error("chosen", "must have the shape (" + std::to_string(above.size()) + ",)");
    const std::span<const double> values{weights.data(), above.size()};
    if (std::ranges::any_of(values, [](double value) { return value < 0.0 || value > 1.0; }))
        value_error("chosen", "must lie in [0, 1]");
    const int width = whole_number(feather, "feather");
    if (width < 0) value_error("feather", "must be >= 0");
    DoubleArray result = new_array({above.size()});
    layers::feathered(above, layers::parents_first(above), values, width, values_of(result));
    return result;
}

// --- LayerStack ------------------------------------------------------------------------------------------

[[nodiscard]] glm::dmat4 matrix_in(std::span<const float> matrices, std::size_t bone) {
    return bones::matrix_at(matrices, bone);
}

[[nodiscard]] layers::Stack make_stack(const ArrayLike& parents, const Float32Array& rest,
                                       const Int32Array& inheritance) {
    const std::vector<int> above = whole_numbers(parents, "parents");
    const bones::RigArrays rig = rig_at_rest(above, rest, inheritance);
    if (!are_finite(rig.rest)) value_error("rest", "every value must be finite");
    std::vector<glm::dquat> turns;
    std::vector<char> inherits;
    for (std::size_t bone = 0; bone < above.size(); ++bone) {
        turns.push_back(bones::frame_of(glm::dmat3(matrix_in(rig.rest, bone))));
        inherits.push_back((rig.inheritance[bone] & bones::inherits_rotation) != 0 ? 1 : 0);
    }
    return {above, turns, inherits};
}

/// The arguments of solve that are lists with an item a layer, copied and checked.
class Layers {
  public:
    Layers(const layers::Stack& stack, const py::list& clips, const Float64Array& settings,
           const Float64Array& masks, const py::list& references, const py::list& given,
           const Typed<"list[numpy.typing.NDArray[numpy.float64] | None] | None">& laps)
        : held_(clips) {
        const std::size_t count = held_.size();
        const py::list of_laps = laps.is_none() ? all_none(count) : list(laps, "laps");
        if (of_laps.size() != count) value_error("laps", "must have one item for each clip");
        if (references.size() != count) value_error("references", "must have one item for each clip");
        if (given.size() != count) value_error("given", "must have one item for each clip");
        const std::span<const double> rows = setting_rows(settings, count);
        masks_ = copied(elements<double>(masks, "masks", {count, stack.size()}));
        if (std::ranges::any_of(masks_, [](double value) { return !(value >= 0.0 && value <= 1.0); }))
            value_error("masks", "must lie in [0, 1]");
        for (std::size_t i = 0; i < count; ++i) {
            const py::object held = held_[i];
            const auto& clip = instance<layers::Clip>(held, "clips", "a LayerClip");
            if (clip.bone_count() != stack.size()) value_error("clips", "another number of bones");
            given_.push_back(given_values(given[i], clip.given_count()));
            references_.push_back(reference_of(references[i], clip.bones().size()));
            laps_.push_back(laps_of(of_laps[i], clip.bones().size()));
            layers_.push_back(layer_of(rows.subspan(i * column_count, column_count), clip));
        }
        for (std::size_t i = 0; i < count; ++i) {
            layers_[i].given = given_[i];
            layers_[i].reference = references_[i];
            layers_[i].laps = laps_[i];
            layers_[i].mask = std::span(masks_).subspan(i * stack.size(), stack.size());
            bones_ += layers_[i].clip->bones().size();
        }
    }

    [[nodiscard]] std::span<const layers::Layer> values() const { return layers_; }
    [[nodiscard]] std::size_t bones() const { return bones_; }

  private:
    [[nodiscard]] static layers::Layer layer_of(std::span<const double> row, const layers::Clip& clip) {
        layers::Layer layer;
        layer.clip = &clip;
        layer.timing = timing_of(row);
        layer.weight = std::clamp(row[weight], 0.0, 1.0);
        layer.mode = row[mode] != 0.0 ? layers::LayerMode::additive : layers::LayerMode::override;
        layer.in_armature = row[in_armature] != 0.0;
        return layer;
    }

    [[nodiscard]] static std::vector<Transform> reference_of(const py::object& given, std::size_t count) {
        if (given.is_none()) return {};
        const std::span<const double> rows = elements<double>(given, "references", {count, row_size});
        if (!are_finite(rows)) value_error("references", "every value must be finite");
        std::vector<Transform> result;
        for (std::size_t i = 0; i < count; ++i)
            result.push_back(read_row(rows.subspan(i * row_size, row_size)));
        return result;
    }

    [[nodiscard]] static py::list all_none(std::size_t count) {
        py::list result(count);
        for (std::size_t i = 0; i < count; ++i) result[i] = py::none();
        return result;
    }

    [[nodiscard]] static py::list list(const py::object& given, std::string_view name) {
        if (!py::isinstance<py::list>(given)) throw py::type_error(std::string(name) + ": must be a list");
        return given;
    }

    [[nodiscard]] static std::vector<layers::Lap> laps_of(const py::object& given, std::size_t count) {
        if (given.is_none()) return {};
        const std::span<const double> rows = elements<double>(given, "laps", {count, 8});
        if (!are_finite(rows)) value_error("laps", "every value must be finite");
        std::vector<layers::Lap> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            std::ranges::copy(rows.subspan(8 * i, 4), result[i].from.begin());
            std::ranges::copy(rows.subspan(8 * i + 4, 4), result[i].gained.begin());
        }
        return result;
    }

    py::tuple held_;  // the clips, which somebody may take out of the list meanwhile
    std::vector<double> masks_;
    std::vector<std::vector<double>> given_;
    std::vector<std::vector<Transform>> references_;
    std::vector<std::vector<layers::Lap>> laps_;
    std::vector<layers::Layer> layers_;
    std::size_t bones_ = 0;
};

/// Where the result goes.
struct Moves {
    py::array_t<double, py::array::c_style> locations, rotations, scales;

    Moves(const py::object& to_locations, const py::object& to_rotations, const py::object& to_scales,
          std::size_t count)
        : locations(output<double>(to_locations, "locations", {static_cast<py::ssize_t>(count), 3})),
          rotations(output<double>(to_rotations, "rotations", {static_cast<py::ssize_t>(count), 4})),
          scales(output<double>(to_scales, "scales", {static_cast<py::ssize_t>(count), 3})) {}

    void set(std::size_t i, const Transform& move) {
        const glm::dquat& q = move.rotation;
        double* const place = locations.mutable_data() + 3 * i;
        double* const turn = rotations.mutable_data() + 4 * i;
        double* const size = scales.mutable_data() + 3 * i;
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] = move.location[axis];
            size[axis] = move.scale[axis];
        }
        std::ranges::copy(std::array{q.w, q.x, q.y, q.z}, turn);
    }
};

[[nodiscard]] std::vector<int> member_rows(const ArrayLike& rows, std::size_t count) {
    std::vector<int> result = whole_numbers(rows, "rows");
    for (const int row : result)
        if (row < 0 || std::cmp_greater_equal(row, count)) value_error("rows", "a bone is not there");
    return result;
}

void solve_stack(const layers::Stack& stack, const Number& frame, const Float32Array& basis,
                 const py::list& clips, const Float64Array& settings, const Float64Array& masks,
                 const py::list& references, const py::list& given, const ArrayLike& rows,
                 const Float64Array& locations, const Float64Array& rotations, const Float64Array& scales,
                 const Float32Array& laid,
                 const Typed<"list[numpy.typing.NDArray[numpy.float64] | None] | None">& laps) {
    const std::size_t count = stack.size();
    const double at = number(frame, "frame");
    const std::vector<float> own = copied(elements<float>(basis, "basis", {count, 16}));
    const Layers all(stack, clips, settings, masks, references, given, laps);
    const std::vector<int> members = member_rows(rows, count);
    Moves moves(locations, rotations, scales, members.size());
    auto whole = output<float>(laid, "laid", {static_cast<py::ssize_t>(members.size()), 16});
    std::vector<Transform> base(count), result(count);
    std::vector<char> changed(count);
    {
        const ReleaseGil released(count + all.bones(), bone_cost);
        for (std::size_t bone = 0; bone < count; ++bone)
            base[bone] = layers::transform_of(matrix_in(own, bone));
        stack.solve(at, all.values(), base, result, changed);
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
        const auto bone = static_cast<std::size_t>(members[i]);
        const bool moves_it = changed[bone] != 0;
        moves.set(i, moves_it ? layers::between_transforms(base[bone], result[bone]) : Transform{});
        float* const columns = whole.mutable_data() + 16 * i;
        if (!moves_it) {
            std::copy_n(own.data() + 16 * bone, 16, columns);
            continue;
        }
        const glm::dmat4 matrix = layers::matrix_of(result[bone]);
        for (int k = 0; k < 16; ++k) columns[k] = static_cast<float>(matrix[k / 4][k % 4]);
    }
}

void moves_between(const Float32Array& own, const Float32Array& laid, const Float64Array& locations,
                   const Float64Array& rotations, const Float64Array& scales) {
    const std::size_t count = rows_of(own, "own");
    const std::span<const float> from = elements<float>(own, "own", {count, 16});
    const std::span<const float> to = elements<float>(laid, "laid", {count, 16});
    Moves moves(locations, rotations, scales, count);
    for (std::size_t i = 0; i < count; ++i)
        moves.set(i, layers::between_transforms(layers::transform_of(matrix_in(from, i)),
                                                layers::transform_of(matrix_in(to, i))));
}

[[nodiscard]] Typed<"tuple[numpy.typing.NDArray[numpy.float64], tuple[int, ...]]"> find_sources(
    const layers::Stack& stack, const Number& frame, const Float32Array& basis, const py::list& clips,
    const Float64Array& settings, const Float64Array& masks, const py::list& references,
    const py::list& given, const WholeNumber& edited, const Float32Array& wanted, const ArrayLike& rows,
    const Typed<"list[numpy.typing.NDArray[numpy.float64] | None] | None">& laps) {
    const std::size_t count = stack.size();
    const double at = number(frame, "frame");
    const std::vector<float> own = copied(elements<float>(basis, "basis", {count, 16}));
    const std::vector<float> asked = copied(elements<float>(wanted, "wanted", {count, 16}));
    const Layers all(stack, clips, settings, masks, references, given, laps);
    const std::vector<int> chosen = member_rows(rows, count);
    const int index = whole_number(edited, "edited");
    if (index < 0 || std::cmp_greater_equal(index, all.values().size()))
        value_error("edited", "there is no such layer");
    std::vector<Transform> base(count), pose(count), said(chosen.size());
    std::vector<unsigned> reached(chosen.size());
    {
        const ReleaseGil released(count + all.bones(), bone_cost);
        for (std::size_t bone = 0; bone < count; ++bone) {
            base[bone] = layers::transform_of(matrix_in(own, bone));
            pose[bone] = layers::transform_of(matrix_in(asked, bone));
        }
        stack.find_source(at, all.values(), static_cast<std::size_t>(index), base, pose, chosen, said,
                          reached);
    }
    DoubleArray result = new_array({said.size(), row_size});
    const std::span<double> out = values_of(result);
    py::tuple channels(reached.size());
    for (std::size_t i = 0; i < said.size(); ++i) {
        write_row(said[i], out.subspan(i * row_size, row_size));
        channels[i] = reached[i];
    }
    return py::make_tuple(result, channels);
}

[[nodiscard]] Typed<"tuple[int, ...]"> bones_of(const layers::Clip& clip) {
    py::tuple result(clip.bones().size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = clip.bones()[i];
    return result;
}

[[nodiscard]] Typed<"tuple[int, ...]"> channels_of(const layers::Clip& clip) {
    py::tuple result(clip.channels().size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = clip.channels()[i];
    return result;
}

void bind_clip(py::module_& m) {
    py::class_<layers::Clip>(m, "LayerClip", py::module_local(), R"(
What an action says of a rig's bones: its F-curves. Immutable.

rotations: (B,), rotation mode of each bone: 0 quaternion, 1-6 Euler XYZ, XZY, YXZ, YZX, ZXY, ZYX, 7 axis and angle.
curves: (C, 4) int32: bone; channel, 0-2 location, 3-6 the numbers of its rotation mode, 7-9 scale; index of its FCurve, -1 where
the caller gives its value; whether it counts as an angle that goes beyond half a turn, whatever its keys say.
fcurves: (F) FCurve.
bones: those that it animates.  channels: of each a sum of 1 location, 2 rotation, 4 scale.  spins: whether angles of any go
beyond half a turn, or by a whole turn from key to key.  given: how many curves have no FCurve.
Raises ValueError or TypeError that names the argument.)")
        .def(py::init(&make_clip), "rotations"_a, "curves"_a, "fcurves"_a)
        .def_property_readonly("bones", &bones_of)
        .def_property_readonly("channels", &channels_of)
        .def_property_readonly("spins", &layers::Clip::has_spins)
        .def_property_readonly("given", &layers::Clip::given_count)
        .def("pose", &clip_pose, "frame"_a, "given"_a = py::none(), R"(
(n, 10) of the bones at a frame of the action: location, unit quaternion w, x, y, z, scale; at rest what it says nothing of.

given: (given,), values of the curves without an FCurve.  Raises ValueError or TypeError that names the argument.)")
        .def("numbers", &clip_numbers, "frame"_a, "given"_a = py::none(), R"(
(n, 4): what the bones' rotations are made of at a frame of the action, in their modes: a quaternion, Euler angles and a number
that does not count, an angle and its axis; rad.

given: as of pose().  Raises ValueError or TypeError that names the argument.)");
}

}  // namespace

void bind_layers(py::module_& m) {
    bind_clip(m);
    m.def("layer_moments", &moments, "settings"_a, "frame"_a, R"(
When layers play what: (L, 2), frame of the action and weight, at a frame of the scene.

settings: (L, 10), see LayerStack.SETTINGS.  Raises ValueError or TypeError that names the argument.)");
    m.def("rotations_of", &rotations_of, "mode"_a, "numbers"_a, R"(
(n, 4): unit quaternions of numbers (n, 4) in a rotation mode, as Blender makes them.

mode: 0 quaternion, 1-6 Euler XYZ, XZY, YXZ, YZX, ZXY, ZYX, 7 axis and angle.  numbers: a quaternion; Euler angles about X, Y and Z
and a number that does not count; an angle and its axis; rad.  Raises ValueError or TypeError that names the argument.)");
    m.def("layer_mask", &mask, "parents"_a, "chosen"_a, "feather"_a = 0, R"(
Weights of a mask with a soft border: (B,).

parents: (B,), index of each bone's parent, -1 for none.  chosen: (B,), in [0, 1]; 0 is outside.  feather: over how many
bones from the border on, >= 0, the weight rises: at the first one it is chosen / (feather + 1).
Raises ValueError or TypeError that names the argument.)");
    m.def("layer_moves", &moves_between, "own"_a, "laid"_a, "locations"_a, "rotations"_a, "scales"_a, R"(
Writes what comes on top of bones' own transforms, so that they become others: as LayerStack.solve() does.

own and laid: (R, 16) float32, matrices column by column.  locations (R, 3), rotations (R, 4) w, x, y, z, scales (R, 3), float64:
written into.  Raises ValueError or TypeError that names the argument.)");
    py::class_<layers::Stack> stack(m, "LayerStack", py::module_local(), R"(
What the bones of one rig hang on, for layers of animation over its pose. Immutable.

parents: (B,), index of each bone's parent, -1 for none.  rest: (B, 16) float32, Bone.matrix_local, column by column.
inheritance: (B,) int32: 8 where the bone turns along with its parent.  SETTINGS: names of columns.
Raises ValueError or TypeError that names the argument.)");
    stack.def(py::init(&make_stack), "parents"_a, "rest"_a, "inheritance"_a);
    stack.attr("SETTINGS") = setting_names();
    stack.def("solve", &solve_stack, "frame"_a, "basis"_a, "clips"_a, "settings"_a, "masks"_a, "references"_a,
              "given"_a, "rows"_a, "locations"_a, "rotations"_a, "scales"_a, "laid"_a, "laps"_a = py::none(),
              R"(
Lays layers, the lowest first, over the bones' own transforms at a frame of the scene, and writes what comes on top of these.

basis: (B, 16) float32, PoseBone.matrix_basis, column by column.  clips: (L) LayerClip.  settings: (L, 10), see SETTINGS: start
frame; first and last frame of the action; speed; after: 0 it ends, 1 it holds, 2 it repeats; blend_in and blend_out, frames
of the scene; weight; mode: 0 override, 1 additive; in_armature: not 0, rotations are blended as they are in the armature.
masks: (L, B), in [0, 1].  references: of each layer the pose() that an additive one starts from, None for the rest pose.
given: of each layer the values of its clip's curves without an FCurve, or None.
rows: (R,) bones.  locations (R, 3), rotations (R, 4) w, x, y, z, scales (R, 3), float64: written into; location to add, rotation
after the bone's own, scale to multiply by.  laid: (R, 16) float32, written into: the bone's own transform with all layers.
laps: of each layer (n, 8), or None: numbers() of the first pose that it plays (of an additive one's reference, if that is a pose
of the clip), and how far numbers() come from the first pose to the last. Bones that go around, see LayerClip.spins, then do so by a
part of the way where the layer counts for a part; without it all rotations go the shorter way.
Raises ValueError or TypeError that names the argument; transforms that are not finite stay as they are.)");
    stack.def("sources", &find_sources, "frame"_a, "basis"_a, "clips"_a, "settings"_a, "masks"_a,
              "references"_a, "given"_a, "edited"_a, "wanted"_a, "rows"_a, "laps"_a = py::none(),
              R"(
The inverse of solve(): what the clip of one layer has to say, so that the layers together give a wanted pose.

edited: index of the layer.  wanted: (B, 16) float32, the bones' own transforms with all layers, column by column.  rows: (R,) bones of
which the clip is to say something, whether it animates them now or not.  The others as of solve().
Returns ((R, 10), as pose() has it, (R,) of each bone a sum of 1 location, 2 rotation, 4 scale, which the layers then give).  Channels
that are missing in the sum are hidden by a layer above, have no share in the layer, or would have to turn by more than half a turn.
Raises ValueError or TypeError that names the argument.)");
}

}  // namespace motus::bindings
