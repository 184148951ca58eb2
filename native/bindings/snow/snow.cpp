// A particle system without a state.
#include "motus/snow/snow.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "mesh/arrays.hpp"
#include "motus/snow/cover.hpp"
#include "movers.hpp"

namespace motus::bindings {
namespace {

using OptionalFieldNames = Typed<
    "typing.Sequence[typing.Literal['position', 'velocity', 'size', 'color', 'age', 'rotation', 'id']] | "
    "None">;
/// Arrays by the names of their fields, or a function of the number of flakes that gives them.
using FieldArrays = Typed<
    "dict[str, numpy.typing.NDArray[typing.Any]] | typing.Callable[[int], dict[str, "
    "numpy.typing.NDArray[typing.Any]]] | None">;

using namespace pybind11::literals;
using snow::Collider;
using snow::Collision;
using snow::Cover;
using snow::CoverSettings;
using snow::Shape;
using snow::Snow;
using snow::SnowSettings;

constexpr double flake_cost = 10.0;  // ns, rough

[[nodiscard]] Shape shape_named(const py::object& object) {
    return choice<Shape>(object, "shape",
                         {{"square", Shape::square},
                          {"disc", Shape::disc},
                          {"box", Shape::box},
                          {"sphere", Shape::sphere},
                          {"cone", Shape::cone},
                          {"surface", Shape::surface},
                          {"frustum", Shape::frustum}});
}

[[nodiscard]] std::vector<snow::GradientStop> gradient(const py::object& object) {
    if (!py::isinstance<py::sequence>(object) || py::len(object) != 2)
        wrong_type(object, "start_color", "a pair of positions and colours");
    const py::object first = object[py::int_(0)], second = object[py::int_(1)];
    const DoubleArray positions = row(first, "start_color"), colors = doubles(second, "start_color");
    if (colors.ndim() != 2 || colors.shape(0) != positions.shape(0) || colors.shape(1) != 4)
        value_error("start_color", "its colours must have the shape (k, 4), k the number of positions, not " +
                                       shape_of(colors));
    std::vector<snow::GradientStop> stops;
    for (py::ssize_t i = 0; i < positions.size(); ++i) {
        snow::GradientStop stop{static_cast<float>(positions.at(i)), {}};
        for (int part = 0; part < 4; ++part) stop.color[part] = static_cast<float>(colors.at(i, part));
        stops.push_back(stop);
    }
    return stops;
}

[[nodiscard]] std::vector<snow::Burst> bursts(const ArrayLike& given_times, const py::object& given_counts) {
    const DoubleArray times = row(given_times, "burst_times"), counts = row(given_counts, "burst_counts");
    if (times.size() != counts.size()) value_error("burst_counts", "must be as many as burst_times");
    std::vector<snow::Burst> result;
    for (py::ssize_t i = 0; i < times.size(); ++i) {
        const double count = counts.at(i);
        if (!(count >= 0.0 && count <= 0x1p53) || count != std::floor(count))
            value_error("burst_counts", "must be whole numbers of at least 0");
        result.push_back({times.at(i), static_cast<std::uint64_t>(count)});
    }
    return result;
}

void set_surface(const py::object& positions, const py::object& triangles, SnowSettings& settings) {
    if (!positions.is_none()) {
        const Points points(positions, "surface_positions");
        settings.surface_positions.assign(points.values().begin(), points.values().end());
    }
    if (!triangles.is_none()) {
        const Points corners(triangles, "surface_triangles");
        for (const glm::dvec3& corner : corners.values()) {
            const glm::ivec3 whole(glm::clamp(corner, -1.0, 0x1p31 - 1.0));
            if (glm::dvec3(whole) != corner) value_error("surface_triangles", "must be indices of vertices");
            settings.surface_triangles.push_back(whole);
        }
    }
}

void set_emitter(const ArrayLike& times, const py::object& poses, SnowSettings& settings) {
    const DoubleArray at = row(times, "emitter_times");
    settings.emitter_times.assign(at.data(), at.data() + at.size());
    if (!poses.is_none()) settings.emitter_matrices = matrices(poses, "emitter_matrices");
}

void set_frustum(const py::object& angles, const py::object& least, const WholeNumber& most,
                 SnowSettings& settings) {
    const DoubleArray both = row(angles, "frustum_angles");
    if (both.size() != 2) value_error("frustum_angles", "must have the shape (2,), not " + shape_of(both));
    settings.frustum_angles = {both.at(0), both.at(1)};
    settings.frustum_near = number(least, "frustum_near");
    settings.frustum_far = number(most, "frustum_far");
}

void set_wind(const ArrayLike& wind, const ArrayLike& times, const py::object& values,
              SnowSettings& settings) {
    settings.wind = vector(wind, "wind");
    const DoubleArray at = row(times, "wind_times");
    settings.wind_times.assign(at.data(), at.data() + at.size());
    if (values.is_none()) return;
    const Points winds(values, "wind_values");
    settings.wind_values = copied(winds.values());
}

void set_rate(const Number& rate, const OptionalArrayLike& times, const OptionalArrayLike& values,
              SnowSettings& settings) {
    settings.rate = number(rate, "rate");
    const DoubleArray at = row(times, "rate_times"), of = row(values, "rate_values");
    settings.rate_keys = {{at.data(), at.data() + at.size()}, {of.data(), of.data() + of.size()}};
}

[[nodiscard]] std::shared_ptr<Collider> collider_of(const ArrayLike& positions, const ArrayLike& triangles) {
    const Positions given_points(positions, "collider_positions");
    const IndexRows<glm::ivec3> given_corners(triangles, "collider_triangles");
    const std::vector<glm::vec3> points = copied(given_points.values());
    const std::vector<glm::ivec3> corners = copied(given_corners.values());
    const py::gil_scoped_release released;
    return std::make_shared<Collider>(points, corners);
}

void set_collisions(const OptionalNumber& ground, const py::object& collider, const CollisionName& collision,
                    const OptionalNumber& rest_time, const Number& melt_time, const Number& friction,
                    SnowSettings& settings) {
    if (!ground.is_none()) settings.ground = number(ground, "ground");
    if (!collider.is_none()) {
        static_cast<void>(instance<Collider>(collider, "collider", "a SnowCollider or None"));
        settings.collider = collider.cast<std::shared_ptr<Collider>>();
    }
    settings.collision = choice<Collision>(
        collision, "collision",
        {{"stay", Collision::stay}, {"slide", Collision::slide}, {"melt", Collision::melt}});
    if (!rest_time.is_none()) settings.rest_time = number(rest_time, "rest_time");
    settings.melt_time = number(melt_time, "melt_time");
    settings.friction = number(friction, "friction");
}

[[nodiscard]] Snow snow_of(
    const Number& start_speed, const Number& lifetime, const Number& start_size,
    const Typed<"tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike] | None">& start_color,
    const Number& rate, const OptionalArrayLike& rate_times, const OptionalArrayLike& rate_values,
    const Number& delay, const Number& duration, const Flag& looping, const OptionalArrayLike& burst_times,
    const OptionalArrayLike& burst_counts, const EmitterShapeName& shape,
    const OptionalArrayLike& surface_positions, const OptionalArrayLike& surface_triangles,
    const ArrayLike& frustum_angles, const Number& frustum_near, const Number& frustum_far,
    const Number& cone_angle, const Number& cone_radius, const Flag& random_speed,
    const Flag& random_orientation, const Flag& random_lifetime, const Flag& random_size,
    const Flag& random_color, const Flag& snow, const Number& max_angle, const Number& snow_frequency,
    const Flag& snow_offsets, const Flag& gravity, const ArrayLike& acceleration, const Number& drag,
    const ArrayLike& wind, const OptionalArrayLike& wind_times, const OptionalArrayLike& wind_values,
    const Number& gusts, const Number& gust_frequency, const Number& period, const Number& turbulence,
    const Number& turbulence_size, const Number& tumble, const OptionalNumber& ground,
    const Typed<"motus_native.SnowCollider | None">& collider, const CollisionName& collision,
    const OptionalNumber& rest_time, const Number& melt_time, const Number& friction, const MoverList& movers,
    const WholeNumber& seed, const OptionalArrayLike& emitter_times,
    const OptionalArrayLike& emitter_matrices, const Number& inherited) {
    SnowSettings settings;
    settings.start_speed = number(start_speed, "start_speed");
    settings.lifetime = number(lifetime, "lifetime");
    settings.start_size = number(start_size, "start_size");
    if (!start_color.is_none()) settings.start_color = gradient(start_color);
    set_rate(rate, rate_times, rate_values, settings);
    settings.delay = number(delay, "delay");
    settings.duration = number(duration, "duration");
    settings.looping = flag(looping, "looping");
    settings.bursts = bursts(burst_times, burst_counts);
    settings.shape = shape_named(shape);
    set_surface(surface_positions, surface_triangles, settings);
    set_frustum(frustum_angles, frustum_near, frustum_far, settings);
    settings.cone_angle = number(cone_angle, "cone_angle");
    settings.cone_radius = number(cone_radius, "cone_radius");
    settings.random_speed = flag(random_speed, "random_speed");
    settings.random_orientation = flag(random_orientation, "random_orientation");
    settings.random_lifetime = flag(random_lifetime, "random_lifetime");
    settings.random_size = flag(random_size, "random_size");
    settings.random_color = flag(random_color, "random_color");
    settings.snow = flag(snow, "snow");
    settings.max_angle = number(max_angle, "max_angle");
    settings.snow_frequency = number(snow_frequency, "snow_frequency");
    settings.snow_offsets = flag(snow_offsets, "snow_offsets");
    settings.gravity = flag(gravity, "gravity");
    settings.acceleration = vector(acceleration, "acceleration");
    settings.drag = number(drag, "drag");
    set_wind(wind, wind_times, wind_values, settings);
    settings.gusts = number(gusts, "gusts");
    settings.gust_frequency = number(gust_frequency, "gust_frequency");
    settings.period = number(period, "period");
    settings.turbulence = number(turbulence, "turbulence");
    settings.turbulence_size = number(turbulence_size, "turbulence_size");
    settings.tumble = number(tumble, "tumble");
    set_collisions(ground, collider, collision, rest_time, melt_time, friction, settings);
    settings.movers = movers_of(movers);
    settings.seed = seed_of(seed);
    set_emitter(emitter_times, emitter_matrices, settings);
    settings.inherited = number(inherited, "inherited");
    return Snow(settings);
}

[[nodiscard]] Typed<"dict[str, numpy.typing.NDArray[typing.Any]]"> landings(const Snow& self,
                                                                            const Number& given_end) {
    const double end = number(given_end, "end");
    const std::vector<snow::Touchdown> downs = [&] {
        const py::gil_scoped_release released;
        return self.touchdowns(end);
    }();
    const auto count = static_cast<py::ssize_t>(downs.size());
    py::array_t<double> times(count);
    py::array_t<std::int64_t> ids(count), triangles(count);
    py::array_t<float> positions({count, py::ssize_t{3}});
    for (std::size_t i = 0; i < downs.size(); ++i) {
        const snow::Touchdown& down = downs[i];
        times.mutable_data()[i] = down.time;
        ids.mutable_data()[i] = static_cast<std::int64_t>(down.id);
        triangles.mutable_data()[i] = down.triangle;
        for (int axis = 0; axis < 3; ++axis)
            positions.mutable_data()[3 * i + static_cast<std::size_t>(axis)] = down.point[axis];
    }
    return py::dict("time"_a = times, "id"_a = ids, "position"_a = positions, "triangle"_a = triangles);
}

[[nodiscard]] Cover cover_of(const Typed<"motus_native.Snow">& given_snow, const Number& end,
                             const Number& flake_volume, const Number& repose, const WholeNumber& smoothing) {
    const Snow& snow = instance<Snow>(given_snow, "snow", "a Snow");
    const CoverSettings settings{number(end, "end"), number(flake_volume, "flake_volume"),
                                 number(repose, "repose"), whole_number(smoothing, "smoothing")};
    const py::gil_scoped_release released;
    return {snow, settings};
}

[[nodiscard]] py::bytes bytes_of_cover(const Cover& self) {
    const std::vector<std::byte> found = self.bytes();
    return {reinterpret_cast<const char*>(found.data()), found.size()};
}

[[nodiscard]] Cover cover_of_bytes(const Typed<"bytes">& data) {
    if (!py::isinstance<py::bytes>(data)) type_error("data", "must be bytes");
    const std::string_view found = py::reinterpret_borrow<py::bytes>(data);
    const py::gil_scoped_release released;
    return Cover::restored(std::as_bytes(std::span(found)));
}

[[nodiscard]] py::array heights(const Cover& self, const Number& given_time,
                                const OptionalFloat32Array& out) {
    const double time = number(given_time, "time");
    const auto count = static_cast<py::ssize_t>(self.vertex_count());
    py::array array = py::array_t<float>(count);
    if (!out.is_none()) {
        if (!py::isinstance<py::array_t<float>>(out)) wrong_type(out, "out", "a float32 array");
        array = py::reinterpret_borrow<py::array>(out);
        if (array.ndim() != 1 || array.shape(0) != count)
            value_error("out",
                        "must have the shape (" + std::to_string(count) + ",), not " + shape_of(array));
        if (!array.writeable() || (array.flags() & py::array::c_style) == 0 || !is_aligned(array))
            value_error("out", "must be C-contiguous and writable");
    }
    constexpr double vertex_cost = 100.0;  // ns, rough
    const std::span<float> rows(static_cast<float*>(array.mutable_data()), self.vertex_count());
    const ReleaseGil released(self.vertex_count(), vertex_cost);
    self.heights(time, rows);
    return array;
}

/// What evaluate() gives: the array of a field, and where its rows are.
struct Field {
    std::string_view name;
    py::ssize_t columns;  ///< 1: rows are numbers
    bool is_whole;        ///< int64, else float32
};
constexpr std::array<Field, 7> all_fields{{{"position", 3, false},
                                           {"velocity", 3, false},
                                           {"size", 1, false},
                                           {"color", 4, false},
                                           {"age", 1, false},
                                           {"rotation", 4, false},
                                           {"id", 1, true}}};

[[nodiscard]] const Field& field_of(py::handle name) {
    if (!py::isinstance<py::str>(name)) wrong_type(name, "fields", "a sequence of names");
    const auto text = name.cast<std::string>();
    for (const Field& field : all_fields)
        if (field.name == text) return field;
    value_error("fields", "there is no field '" + text + "'");
}

[[nodiscard]] py::array new_field(const Field& field, py::ssize_t count) {
    std::vector<py::ssize_t> shape{count};
    if (field.columns > 1) shape.push_back(field.columns);
    if (field.is_whole) return py::array_t<std::int64_t>(shape);
    return py::array_t<float>(shape);
}

/// The first `count` rows of the caller's array.
[[nodiscard]] py::array given_field(const Field& field, py::handle object, py::ssize_t count) {
    const std::string name = "out['" + std::string(field.name) + "']";
    if (!py::isinstance<py::array>(object)) wrong_type(object, name, "an array");
    const auto array = py::reinterpret_borrow<py::array>(object);
    const bool is_right_type = field.is_whole ? py::isinstance<py::array_t<std::int64_t>>(array)
                                              : py::isinstance<py::array_t<float>>(array);
    if (!is_right_type) type_error(name, field.is_whole ? "must be int64" : "must be float32");
    const bool has_rows =
        field.columns == 1 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == field.columns;
    if (!has_rows || array.shape(0) < count)
        value_error(
            name, "must have the shape (" + std::to_string(count) +
                      (field.columns == 1 ? std::string(",)") : ", " + std::to_string(field.columns) + ")") +
                      " or more rows, not " + shape_of(array));
    if (!array.writeable() || (array.flags() & py::array::c_style) == 0 || !is_aligned(array))
        value_error(name, "must be C-contiguous and writable");
    return py::reinterpret_borrow<py::array>(array[py::slice(0, count, 1)]);
}

template <class Row>
[[nodiscard]] std::span<Row> rows_of(py::array& array) {
    return {static_cast<Row*>(array.mutable_data()), static_cast<std::size_t>(array.shape(0))};
}

void set_field(std::string_view name, py::array& array, snow::Fields& fields) {
    if (name == "position") fields.position = rows_of<glm::vec3>(array);
    if (name == "velocity") fields.velocity = rows_of<glm::vec3>(array);
    if (name == "size") fields.size = rows_of<float>(array);
    if (name == "color") fields.color = rows_of<glm::vec4>(array);
    if (name == "age") fields.age = rows_of<float>(array);
    if (name == "rotation") fields.rotation = rows_of<glm::vec4>(array);
    if (name == "id") fields.id = rows_of<std::int64_t>(array);
}

/// Those asked for, else those that there are arrays for, else all.
[[nodiscard]] std::vector<Field> wanted(const py::object& fields, const py::object& out) {
    std::vector<Field> result;
    if (fields.is_none() && out.is_none()) return {all_fields.begin(), all_fields.end()};
    const py::object names = fields.is_none() ? out : fields;
    if (py::isinstance<py::str>(names) || !py::isinstance<py::iterable>(names))
        wrong_type(names, "fields", "a sequence of names");
    for (const py::handle name : names) result.push_back(field_of(name));
    return result;
}

[[nodiscard]] Typed<"dict[str, numpy.typing.NDArray[typing.Any]]"> evaluate(const Snow& self,
                                                                            const Number& given_time,
                                                                            const OptionalFieldNames& fields,
                                                                            const FieldArrays& given_out,
                                                                            bool known) {
    const double time = number(given_time, "time");
    const snow::Living living = [&] {
        const py::gil_scoped_release released;
        return known ? self.known(time) : self.living(time);
    }();
    const auto count = static_cast<py::ssize_t>(living.count());
    py::object out = given_out;
    if (PyCallable_Check(given_out.ptr()) != 0) out = given_out(count);
    if (!out.is_none() && !py::isinstance<py::dict>(out)) wrong_type(out, "out", "a dict of arrays");
    const std::vector<Field> names = wanted(fields, out);
    py::dict result;
    snow::Fields rows;
    for (const Field& field : names) {
        const py::str key(field.name.data(), field.name.size());
        const bool is_given = !out.is_none() && out.contains(key);
        py::array array = is_given ? given_field(field, out[key], count) : new_field(field, count);
        set_field(field.name, array, rows);
        result[key] = array;
    }
    {
        const ReleaseGil released(living.count(), flake_cost);
        self.evaluate(living, rows);
    }
    return result;
}

[[nodiscard]] std::size_t find_landings(const Snow& self, const Number& given_time,
                                        const WholeNumber& given_most) {
    const double time = number(given_time, "time");
    const int most = whole_number(given_most, "most");
    if (most < 0) value_error("most", "must be at least 0");
    const py::gil_scoped_release released;
    return self.find_landings(time, static_cast<std::size_t>(most));
}

}  // namespace

void bind_snow(py::module_& m) {
    py::class_<Collider, std::shared_ptr<Collider>>(m, "SnowCollider", py::module_local(), R"(
Triangles that flakes land on, from either side; they stand still. Immutable: made once, for any number of Snows. A million
triangles take some 70 MB, and 36 MB more where flakes slide.

collider_positions (v, 3), world space.  collider_triangles (t, 3): indices of vertices.
Raises ValueError or TypeError that names the argument.)")
        .def(py::init(&collider_of), "collider_positions"_a, "collider_triangles"_a)
        .def_property_readonly(
            "vertex_count", [](const Collider& self) { return self.positions().size(); },
            "How many vertices it has.")
        .def_property_readonly(
            "triangle_count", [](const Collider& self) { return self.triangles().size(); },
            "How many triangles it has.");

    py::class_<Snow>(m, "Snow", py::module_local(), R"(
Flakes at any time, in any order of times, without a state or a cache. Immutable. Metres, seconds, radians, world space.

start_speed, start_size: of each flake.  lifetime: s, >= 0.  start_color: a gradient, a pair of positions (k,), rising, and
colours (k, 4); None is white. Flakes have its first colour.
rate: flakes a second, >= 0; flake i of a steady stream is born at delay + (i + 1) / rate.  rate_times (r,), s, rising,
rate_values (r,), >= 0: in place of it a rate that goes evenly from each value to the next; flake i is born when its integral
from the delay on is i + 1.  delay, duration: s, >= 0; the stream ends after `duration`, unless looping.
burst_times (s after the delay), burst_counts: (b,), flakes that come all at once, numbered where they are born.
shape: 'square', 'disc', 'box', 'sphere', 'cone' in the emitter's space, of half width or radius cone_radius, >= 0; flakes
leave along its +Z, of a sphere away from the middle, of a cone leaning outwards, at the edge by cone_angle, [0, pi]; or
'surface': surface_positions (v, 3), surface_triangles (t, 3), evenly over their area, along their normals; or
'frustum': what a camera at the emitter's place sees that looks along its -Z, between frustum_near, >= 0, and frustum_far, m,
by frustum_angles (2,), half those in X and Y, [0, pi / 2); down along the world's -Z.
random_speed: start_speed +-1.  random_orientation: anywhere within cone_angle of where they would leave.  random_lifetime:
lifetime +-1 s, at least 0.  random_size: +-10 %.  random_color: anywhere on the gradient.
snow: as it flies, a flake turns by up to max_angle about the world's X and Y, as noise of its age says that changes about
snow_frequency times a second; snow_offsets: each flake has a time of its own in the noise.
gravity: adds acceleration (3,).  drag: 1/s, [0, 1000], with which a flake takes on the velocity of the air, wind (3,) m/s; with
wind_times (w,), s, rising, and wind_values (w, 3) it goes evenly from each of these to the next, and is held before and after.
It varies by the fraction `gusts`, >= 0, about gust_frequency times a second.  period: s, after which gusts and eddies are as
they were, for which their frequencies are changed a little; 0: never.  turbulence: m/s, root
mean square, of air in eddies of turbulence_size m that flakes are carried along by.  tumble: rad/s up to which they spin.
ground: height that flakes land on from above; None: they do not.  collider: a SnowCollider or None.  A flake lands once, on
what it meets first after birth, of a collider rather than the ground at the same height; a way between looks counts as
straight, which are 1/32 s apart, or lifetime / 4096 to twice that of lives over 128 s.  collision: 'stay', where it landed and
as it was turned; 'slide', straight down the triangle and those beyond its edges, of a collider, as acceleration pulls it
(with gravity or without) and friction, >= 0, slows it, until it stops, at a loose edge, or where two lead down to one edge;
'melt', smaller and smaller over melt_time, s, and then gone.  rest_time: s after which a landed flake is gone; None: when its
lifetime ends, as it does anyway. Where flakes land is found once and kept, for 18 million of all Snows at most (1 GB).
movers: colliders that go from place to place, (SnowCollider in its own space, times (k,), s, rising, matrices (k, 4, 4) to world
space, between which they go evenly) each; flakes that land on one are carried along, and do not slide.
seed: 0 to 2^32 - 1; random numbers belong to flake and seed.
emitter_times (k,), rising, emitter_matrices (k, 4, 4): the emitter's poses; a flake is born at the pose of that moment.
inherited: share of the velocity of the emitter's origin that a flake leaves with, beside its own.
Raises ValueError or TypeError that names the argument, also where more than 1e8 flakes would live at once.)")
        .def(py::init(&snow_of), py::kw_only(), "start_speed"_a = 5.0, "lifetime"_a = 2.0,
             "start_size"_a = 1.0, "start_color"_a = py::none(), "rate"_a = 5.0, "rate_times"_a = py::none(),
             "rate_values"_a = py::none(), "delay"_a = 0.0, "duration"_a = 5.0, "looping"_a = true,
             "burst_times"_a = py::none(), "burst_counts"_a = py::none(), "shape"_a = "square",
             "surface_positions"_a = py::none(), "surface_triangles"_a = py::none(),
             "frustum_angles"_a = py::make_tuple(0.4, 0.25), "frustum_near"_a = 0.1, "frustum_far"_a = 20.0,
             "cone_angle"_a = 0.0, "cone_radius"_a = 1.0, "random_speed"_a = false,
             "random_orientation"_a = false, "random_lifetime"_a = false, "random_size"_a = false,
             "random_color"_a = false, "snow"_a = false, "max_angle"_a = 1.3962634015954636,
             "snow_frequency"_a = 1.0, "snow_offsets"_a = false, "gravity"_a = false,
             "acceleration"_a = py::make_tuple(0.0, 0.0, -9.81), "drag"_a = 0.0,
             "wind"_a = py::make_tuple(0.0, 0.0, 0.0), "wind_times"_a = py::none(),
             "wind_values"_a = py::none(), "gusts"_a = 0.0, "gust_frequency"_a = 0.3, "period"_a = 0.0,
             "turbulence"_a = 0.0, "turbulence_size"_a = 1.0, "tumble"_a = 0.0, "ground"_a = py::none(),
             "collider"_a = py::none(), "collision"_a = "stay", "rest_time"_a = py::none(),
             "melt_time"_a = 1.0, "friction"_a = 0.5, "movers"_a = py::make_tuple(), "seed"_a = 0,
             "emitter_times"_a = py::none(), "emitter_matrices"_a = py::none(), "inherited"_a = 0.0)
        .def("landings", &landings, "end"_a, R"(
Where flakes land until `end`, s, but for movers, by time and then number, as a dict: float64 time (n,), int64 id (n,), float32 position
(n, 3), int64 triangle (n,) of the collider, -1 for the ground. Looks at all flakes born until then, some 10 us each.

Raises ValueError that names the argument, also where more than 1e7 flakes are born until then.)")
        .def("find_landings", &find_landings, "time"_a, "most"_a, R"(
Finds where flakes land of up to `most` blocks of 256 of those that live at `time`, s: some 3 ms a block. Returns how many
blocks remain. evaluate() finds it for all.)")
        .def("evaluate", &evaluate, "time"_a, "fields"_a = py::none(), "out"_a = py::none(),
             "known"_a = false, R"(
The flakes that live at `time`, s, as a dict of arrays in the order of their numbers: float32 position (m, 3), velocity
(m, 3), size (m,), color (m, 4), age (m,), rotation (m, 4), which turns +Z to where the flake heads, and int64 id (m,).

fields: names of those wanted; None: those in out, or all.
out: a dict of C-contiguous arrays of m rows or more, written into, or a function that is called with m and gives one; the
result has views of their first m rows.
known: leave out flakes of which nobody has found yet where they land; otherwise that is found now.
The same bits for any number of threads, and by the same compiler. Raises ValueError or TypeError that names the argument.)");

    py::class_<Cover>(m, "SnowCover", py::module_local(), R"(
How deep snow lies on each vertex of what its flakes land on, its collider, at any time, in any order of times. Immutable.

snow: a Snow with a collider.  end: s; flakes that land later are left out.  flake_volume: m^3 of lying snow that a flake
stands for, > 0: the heights times the vertices' areas add up to that of the flakes that have landed, but for those that fell
from the collider.  repose: angle of slopes up to which all flakes lie where they land, [0, pi / 2); the steeper the more of
them slide down and fall from edges to what is below; all do where the slope's tangent is 1.5 times as large.  smoothing: 0 to
1000 rounds in which neighbouring vertices even out their heights, not with those that are under something or too steep.
Takes some 11 us and 200 bytes for each flake that is born until `end` (32 bytes once it is made).
Raises ValueError or TypeError that names the argument, also where more than 1e7 flakes are born until then.)")
        .def(py::init(&cover_of), "snow"_a, py::kw_only(), "end"_a, "flake_volume"_a = 1e-4, "repose"_a = 0.9,
             "smoothing"_a = 4)
        .def_property_readonly("vertex_count", &Cover::vertex_count, "How many vertices the collider has.")
        .def_property_readonly(
            "areas",
            [](const Cover& self) {
                return py::array_t<double>(static_cast<py::ssize_t>(self.areas().size()),
                                           self.areas().data());
            },
            "(v,) float64, m^2: a third of the triangles around each vertex.")
        .def("heights", &heights, "time"_a, "out"_a = py::none(), R"(
(v,) float32: how deep snow lies on each vertex of the collider at `time`, s, in m across the surface.

out: an array of that kind to write into, which is returned.)")
        .def(
            "volume", [](const Cover& self, const Number& time) { return self.volume(number(time, "time")); },
            "time"_a, "m^3 that lie on the collider at `time`, s.")
        .def("bytes", &bytes_of_cover, R"(
All that the cover is, for restored() in another process or another day. Some 40 bytes a flake, and 60 a vertex.)")
        .def_static("restored", &cover_of_bytes, "data"_a, R"(
The cover whose bytes() these are. Raises ValueError or TypeError that names the argument, where they are not the bytes of a
cover.)");
}

}  // namespace motus::bindings
