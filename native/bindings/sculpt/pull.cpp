// Pulling a mesh at a vertex.
#include "motus/sculpt/pull.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "mesh/arrays.hpp"
#include "mesh/picker.hpp"
#include "mesh/reach_arrays.hpp"

namespace motus::bindings {
namespace {

/// A result of Picker.reach() or Picker.reaches().
using OptionalReaches = Typed<
    "tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.float32]] | "
    "list[tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.float32]]] | None">;

using namespace pybind11::literals;

constexpr double vertex_cost = 0.5;     // ns, rough, if all are looked at
constexpr double surface_cost = 300.0;  // ns, rough, neighbours and distances

// Beyond this share of the mesh's extent, and below this number of vertices, it takes less time to look at
// all vertices one after the other than to have the tree find those in reach.
constexpr float tree_share = 0.12f;
constexpr std::size_t tree_count = 20000;

// Greatest ratio, by rounding, of a distance as the tree and as pull() compute it.
constexpr float rounding = 1.0f + 1e-5f;

[[nodiscard]] sculpt::Falloff falloff_argument(const FalloffName& falloff) {
    return choice<sculpt::Falloff>(falloff, "falloff",
                                   {{"classic", sculpt::Falloff::classic},
                                    {"smooth", sculpt::Falloff::smooth},
                                    {"sphere", sculpt::Falloff::sphere},
                                    {"root", sculpt::Falloff::root},
                                    {"linear", sculpt::Falloff::linear},
                                    {"sharp", sculpt::Falloff::sharp},
                                    {"constant", sculpt::Falloff::constant},
                                    {"gaussian", sculpt::Falloff::gaussian},
                                    {"curve", sculpt::Falloff::curve}});
}

/// A falloff, and the samples that it points into, copied.
struct ProfileArgument {
    sculpt::Profile profile;
    std::vector<float> samples;

    ProfileArgument(const FalloffName& falloff, const Number& scale_factor, const OptionalArrayLike& curve) {
        profile.falloff = falloff_argument(falloff);
        profile.scale_factor = float_number(scale_factor, "scale_factor");
        if (curve.is_none()) {
            if (profile.falloff == sculpt::Falloff::curve)
                value_error("curve", "must be given for the falloff 'curve'");
            return;
        }
        const FloatArray array = floats(curve, "curve");
        if (array.ndim() != 1) value_error("curve", "must have the shape (n,), not " + shape_of(array));
        samples.assign(array.data(), array.data() + array.size());
        profile.curve = samples;
    }
    ProfileArgument(const ProfileArgument&) = delete;
    ProfileArgument& operator=(const ProfileArgument&) = delete;
    ProfileArgument(ProfileArgument&&) = delete;
    ProfileArgument& operator=(ProfileArgument&&) = delete;
    ~ProfileArgument() = default;
};

[[nodiscard]] float positive_radius(const Number& radius) {
    const float result = float_number(radius, "radius");
    if (result <= 0.0f) value_error("radius", "must be > 0");
    return result;
}

/// (v,) float32, or none at all. Values are checked by pull().
class Weights {
  public:
    Weights(const py::object& object, std::size_t count) {
        if (object.is_none()) return;
        array_ = floats(object, "weights");
        if (array_.ndim() != 1 || static_cast<std::size_t>(array_.size()) != count)
            value_error("weights",
                        "must have the shape (" + std::to_string(count) + ",), not " + shape_of(array_));
    }
    [[nodiscard]] std::span<const float> values() const {
        return {array_.data(), static_cast<std::size_t>(array_.size())};
    }

  private:
    FloatArray array_{py::ssize_t{0}};
};

/// Reaches measured earlier: a tuple (indices, distances), or a list with one such for each image.
[[nodiscard]] std::vector<mesh::Reach> reaches_argument(const OptionalReaches& reach, std::size_t images,
                                                        std::size_t count) {
    std::vector<mesh::Reach> result;
    const auto add = [&](const py::handle& pair) {
        if (!py::isinstance<py::tuple>(pair)) wrong_type(pair, "reach", "a tuple of indices and distances");
        result.push_back(from_pair(py::reinterpret_borrow<py::tuple>(pair), count));
    };
    if (py::isinstance<py::list>(reach)) {
        for (const py::handle& pair : py::reinterpret_borrow<py::list>(reach)) add(pair);
    } else {
        add(reach);
    }
    if (result.size() != images)
        value_error("reach", "must be a list of " + std::to_string(images) + ", one for each mirror image");
    return result;
}

/// A mesh and how it is connected, for one call of pull().
struct PulledMesh {
    std::span<const glm::vec3> positions;  ///< positions that distances are measured on
    std::span<const glm::ivec3> triangles;
    std::span<const glm::ivec2> edges;
    bool has_edges;
    const PickedMesh* picker;  ///< or null
};

[[nodiscard]] mesh::Neighbours neighbours_of(const PulledMesh& mesh) {
    if (mesh.has_edges) return {mesh.positions.size(), mesh.triangles, mesh.edges};
    return mesh::Neighbours::of_triangles(mesh.positions.size(), mesh.triangles);
}

/// The lowest index of the nearest vertices.
[[nodiscard]] std::uint32_t nearest(const PulledMesh& mesh, const glm::vec3& point) {
    if (mesh.picker != nullptr) {
        if (const auto found = mesh.picker->nearest(point)) return *found;
    }
    float least = std::numeric_limits<float>::infinity();
    std::size_t best = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 away = mesh.positions[i] - point;
        const float square = glm::dot(away, away);
        if (square < least) {
            least = square;
            best = i;
        }
    }
    return static_cast<std::uint32_t>(best);
}

/// Along the surface or by edges, on the positions given: the picker's own may be those of an earlier shape.
[[nodiscard]] std::vector<mesh::Reach> measure(const PulledMesh& mesh, const sculpt::Dab& dab,
                                               std::uint32_t root, Distance distance) {
    if (!are_finite(mesh.positions)) throw std::invalid_argument("positions: every value must be finite");
    std::optional<mesh::Neighbours> own;
    if (mesh.picker == nullptr) own.emplace(neighbours_of(mesh));
    const mesh::Neighbours& neighbours = own ? *own : mesh.picker->neighbours();
    const float reach = reach_of(dab.profile, dab.radius);
    std::vector<mesh::Reach> result;
    for (const sculpt::PullImage& image : sculpt::images_of(dab)) {
        const std::uint32_t vertex = result.empty() ? root : nearest(mesh, image.root);
        result.push_back(reach_along(mesh.positions, neighbours, vertex, reach, distance, dab.metric));
    }
    return result;
}

/// Pulls by straight distance, with the tree if that takes less time.
void pull_straight(const PulledMesh& mesh, std::span<const glm::vec3> positions, const sculpt::Dab& dab,
                   std::span<const float> weights, std::span<glm::vec3> out, std::span<glm::vec3> copy) {
    const float reach = reach_of(dab.profile, dab.radius) * rounding;
    const bool use_tree = mesh.picker != nullptr && mesh.positions.size() >= tree_count &&
                          reach <= tree_share * mesh.picker->extent(dab.metric);
    if (!use_tree) return pull(positions, dab, weights, out, mesh.positions, copy);
    std::vector<std::uint32_t> vertices;
    for (const sculpt::PullImage& image : sculpt::images_of(dab)) {
        const std::vector<std::uint32_t> found = mesh.picker->within(image.root, reach, dab.metric);
        if (vertices.empty()) {
            vertices = found;
            continue;
        }
        std::vector<std::uint32_t> both;
        both.reserve(vertices.size() + found.size());
        std::set_union(vertices.begin(), vertices.end(), found.begin(), found.end(),
                       std::back_inserter(both));
        vertices.swap(both);
    }
    pull_among(positions, dab, vertices, weights, out, mesh.positions);
    std::copy_n(out.begin(), copy.size(), copy.begin());
}

[[nodiscard]] sculpt::Dab dab_argument(const sculpt::Profile& profile, const ArrayLike& displacement,
                                       const Number& radius, const OptionalNumber& minimum,
                                       const OptionalNumber& maximum, const WholeNumber& clamp_axis,
                                       const Text& mirror, const OptionalArrayLike& metric) {
    sculpt::Dab dab;
    dab.profile = profile;
    dab.displacement = float_vector(displacement, "displacement");
    dab.radius = positive_radius(radius);
    dab.metric = metric_argument(metric, "metric");
    if (!minimum.is_none()) dab.minimum = float_number(minimum, "minimum");
    if (!maximum.is_none()) dab.maximum = float_number(maximum, "maximum");
    if (dab.minimum > dab.maximum) value_error("minimum", "must be <= maximum");
    dab.clamp_axis = whole_number(clamp_axis, "clamp_axis");
    if (dab.clamp_axis < 0 || dab.clamp_axis > 2) value_error("clamp_axis", "must be 0, 1 or 2");
    dab.mirror = mirror_argument(mirror);
    return dab;
}

[[nodiscard]] const PickedMesh* picker_argument(const Typed<"motus_native.Picker | None">& picker,
                                                std::size_t count) {
    if (picker.is_none()) return nullptr;
    const PickedMesh& mesh = instance<PickedMesh>(picker, "picker", "a Picker");
    if (mesh.vertex_count() != count)
        value_error("picker",
                    "must be of a mesh with " + std::to_string(count) + " vertices, as positions has");
    return &mesh;
}

/// (v, 3) to be filled, or nothing.
[[nodiscard]] std::span<glm::vec3> copy_argument(const OptionalFloat32Array& copy, std::size_t count) {
    if (copy.is_none()) return {};
    FloatArray array = output<float>(copy, "copy", {static_cast<py::ssize_t>(count), 3});
    return {reinterpret_cast<glm::vec3*>(array.mutable_data()), count};
}

FloatArray pull_positions(const ArrayLike& positions, const IndexOrArrayLike& root,
                          const ArrayLike& displacement, const Number& radius, const FalloffName& falloff,
                          const DistanceName& distance, const OptionalArrayLike& triangles,
                          const OptionalArrayLike& weights, const Number& scale_factor,
                          const OptionalNumber& minimum, const OptionalNumber& maximum,
                          const OptionalArrayLike& curve, const WholeNumber& clamp_axis, const Text& mirror,
                          const OptionalArrayLike& metric, const OptionalArrayLike& edges,
                          const Typed<"motus_native.Picker | None">& picker, const OptionalFloat32Array& out,
                          const OptionalReaches& reach, const OptionalArrayLike& shape,
                          const OptionalFloat32Array& copy) {
    const Positions points(positions, "positions");
    const std::span<const glm::vec3> from = points.values();
    const std::size_t count = from.size();
    const py::object& measured_on = shape.is_none() ? static_cast<const py::object&>(positions) : shape;
    const Positions other(measured_on, "shape");
    const std::span<const glm::vec3> measured = shape.is_none() ? from : other.values();
    if (measured.size() != count)
        value_error("shape", "must be of " + std::to_string(count) + " vertices, as positions is");
    const ProfileArgument profile(falloff, scale_factor, curve);
    const Distance way = distance_argument(distance);
    sculpt::Dab dab =
        dab_argument(profile.profile, displacement, radius, minimum, maximum, clamp_axis, mirror, metric);
    const Root start = root_argument(root, count);
    dab.root = start.vertex ? measured[*start.vertex] : start.point;
    if (!are_finite({&dab.root, 1})) value_error("positions", "every value must be finite");
    const Weights factors(weights, count);
    const IndexRows<glm::ivec3> faces(triangles, "triangles");
    const IndexRows<glm::ivec2> lines(edges, "edges");
    PulledMesh mesh{measured, faces.values(), lines.values(), !edges.is_none(),
                    picker_argument(picker, count)};
    std::vector<mesh::Reach> reaches;
    if (!reach.is_none()) reaches = reaches_argument(reach, sculpt::images_of(dab).size(), count);
    const bool has_to_measure = reach.is_none() && way != Distance::straight;
    if (has_to_measure && !start.vertex)
        value_error("root", "must be the index of a vertex, unless the distance is 'straight'");
    if (has_to_measure && mesh.picker == nullptr && triangles.is_none())
        value_error("triangles", "must be given for the distances 'surface' and 'edges', or a picker");

    // A copy of the positions to walk along, which must stay as they were checked; pull() itself is safe for
    // any numbers.
    std::vector<glm::vec3> steady_positions;
    std::vector<glm::ivec3> steady_faces;
    std::vector<glm::ivec2> steady_lines;
    if (has_to_measure) {
        mesh.positions = steady_positions = copied(mesh.positions);
        mesh.triangles = steady_faces = copied(mesh.triangles);
        mesh.edges = steady_lines = copied(mesh.edges);
    }

    FloatArray result = output<float>(out, "out", {static_cast<py::ssize_t>(count), 3});
    const std::span<glm::vec3> to{reinterpret_cast<glm::vec3*>(result.mutable_data()), count};
    if (to.data() != from.data()) require_apart(from, "positions", to, "out");
    if (measured.data() != from.data()) require_apart(measured, "shape", to, "out");
    require_apart(factors.values(), "weights", to, "out");
    const std::span<glm::vec3> also = copy_argument(copy, count);
    require_apart(from, "positions", also, "copy");
    require_apart(measured, "shape", also, "copy");
    require_apart(factors.values(), "weights", also, "copy");
    require_apart(std::span<const glm::vec3>(to), "out", also, "copy");
    {
        const ReleaseGil released(has_to_measure || mesh.picker == nullptr ? count : count / 10,
                                  has_to_measure ? surface_cost : vertex_cost);
        if (has_to_measure) reaches = measure(mesh, dab, *start.vertex, way);
        if (reaches.empty()) {
            pull_straight(mesh, from, dab, factors.values(), to, also);
        } else {
            pull_along(from, dab, reaches, factors.values(), to);
            std::copy_n(to.begin(), also.size(), also.begin());
        }
    }
    return result;
}

[[nodiscard]] FloatArray forces_at(const ArrayLike& distances, const Number& radius,
                                   const FalloffName& falloff, const Number& scale_factor,
                                   const OptionalArrayLike& curve) {
    const ProfileArgument profile(falloff, scale_factor, curve);
    const float most = positive_radius(radius);
    const FloatArray at = floats(distances, "distances");
    if (at.ndim() > 1) value_error("distances", "must be a number or (n,), not " + shape_of(at));
    const std::span<const float> values{at.data(), static_cast<std::size_t>(at.size())};
    if (!std::all_of(values.begin(), values.end(), [](float distance) { return distance >= 0.0f; }))
        value_error("distances", "every value must be >= 0");
    FloatArray result(std::vector<py::ssize_t>(at.shape(), at.shape() + at.ndim()));
    forces(profile.profile, most, values, {result.mutable_data(), values.size()});
    return result;
}

}  // namespace

void bind_pull(py::module_& m) {
    m.def("pull", &pull_positions, "positions"_a, "root"_a, "displacement"_a, "radius"_a,
          "falloff"_a = "smooth", "distance"_a = "straight", "triangles"_a = py::none(),
          "weights"_a = py::none(), "scale_factor"_a = 0.0, "minimum"_a = py::none(),
          "maximum"_a = py::none(), py::kw_only(), "curve"_a = py::none(), "clamp_axis"_a = 2,
          "mirror"_a = "", "metric"_a = py::none(), "edges"_a = py::none(), "picker"_a = py::none(),
          "out"_a = py::none(), "reach"_a = py::none(), "shape"_a = py::none(), "copy"_a = py::none(), R"(
Pulls a mesh at a vertex, the root: vertices near the root follow by force * weight * displacement.

positions: (v, 3) float32 (other real numbers are converted, which takes time).
root: index of a vertex; for the distance 'straight' also a point (3,).  displacement: (3,), in the positions' space.
radius: > 0, where the force ends sharply: at and beyond it nothing moves. For 'edges' a number of edges.
falloff, over t = 1 - d / radius: 'smooth' 3t^2 - 2t^3, 'sphere' sqrt(2t - t^2), 'root' sqrt(t), 'linear' t, 'sharp' t^2,
'constant' 1, 'gaussian' (e^(-4.5 d^2 / radius^2) - e^-4.5) / (1 - e^-4.5), 'curve' (samples), 'classic'
(1 - d^2 / (radius + 1))^(1 + |scale_factor|) for d^2 < radius. Errors of a force <= 1e-6 if |scale_factor| <= 10.
distance: 'straight'; 'surface', along triangles and loose edges; 'edges', counted. The last two need triangles or picker.
triangles: (t, 3) int32.  edges: (e, 2) int32, the mesh's own (None: all sides of triangles).
weights: (v,) in [0, 1]; 0 leaves a vertex alone.  curve: 2 to 65536 samples at equal steps of t from 0 to 1.
minimum, maximum: vertices that move are clamped to them on clamp_axis (0 x, 1 y, 2 z).
mirror: letters of 'xyz': the pull also acts mirrored about these planes through the origin; where images meet, their mean acts.
metric: (3, 3) in rows: distances are |metric (p - root)|, such as by an object's world matrix; None: the identity.
picker: a Picker of the mesh; its tree, refitted to positions, finds the vertices, and its neighbours are used.
reach: a result of Picker.reach(), for instance of the begin of a stroke; with mirror, of Picker.reaches(). Then root,
distance and metric are not read.
shape: (v, 3) float32, positions on which distances, also the root's place, are measured instead: with it all dabs of a stroke
can act on the shape that the mesh had when the stroke began. A picker has to be of that shape.
out: (v, 3) float32, C-contiguous, written into; positions itself may be given.
copy: a float32 array as out, which gets the same values in the same pass; this takes less time than to copy out later.
Returns out, or a new array. Raises ValueError or TypeError that names the argument, before anything is written. With picker
or reach only positions and weights of vertices in reach are read.)");
    m.def("pull_forces", &forces_at, "distances"_a, "radius"_a, "falloff"_a = "smooth",
          "scale_factor"_a = 0.0, "curve"_a = py::none(), R"(
Forces of a falloff at distances >= 0, a number or (n,): float32 of that shape. Arguments and errors as pull().)");
}

}  // namespace motus::bindings
