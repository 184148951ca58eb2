// Strands: chains of links that hang, swing and touch, over a whole shot.
#include "motus/strand/strand.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "mesh/arrays.hpp"
#include "motus/strand/motion.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using namespace motus::strand;

constexpr double step_cost = 100.0;  // ns, rough

/// Gives a member of all structs from a number, or from an array with one for each.
template <class Struct>
void give(std::vector<Struct>& all, double Struct::*member, py::handle given, const char* name) {
    const Numbers numbers(given, name);
    const std::span<const double> values = numbers.values();
    if (!numbers.is_single() && values.size() != all.size())
        value_error(name, "must be a number, or " + std::to_string(all.size()) + " numbers");
    for (std::size_t i = 0; i < all.size(); ++i) all[i].*member = values[numbers.is_single() ? 0 : i];
}

/// An array of vectors with these rows before the last axis, which has 3.
[[nodiscard]] std::vector<glm::dvec3> vectors(py::handle given, const char* name,
                                              std::vector<std::size_t> shape, const char* wanted) {
    const DoubleArray array = doubles(given, name);
    shape.push_back(3);
    bool fits = static_cast<std::size_t>(array.ndim()) == shape.size();
    for (std::size_t axis = 0; fits && axis < shape.size(); ++axis)
        fits = static_cast<std::size_t>(array.shape(static_cast<py::ssize_t>(axis))) == shape[axis];
    if (!fits) value_error(name, std::string("must have the shape ") + wanted + ", not " + shape_of(array));
    const auto* values = reinterpret_cast<const glm::dvec3*>(array.data());
    return {values, values + array.size() / 3};
}

/// One vector for all times, or one for each; None: there is none.
[[nodiscard]] std::vector<glm::dvec3> over_time(py::handle given, const char* name) {
    if (given.is_none()) return {};
    const DoubleArray array = doubles(given, name);
    if (array.ndim() == 1) return {vector(array, name)};
    const Points points(array, name);
    return {points.values().begin(), points.values().end()};
}

struct Obstacles {
    std::vector<Obstacle> all;
    std::vector<glm::dvec3> places;
};

[[nodiscard]] Obstacles obstacles_of(py::handle shapes, py::handle places, py::handle radii,
                                     py::handle friction, std::size_t times) {
    Obstacles result;
    if (shapes.is_none()) return result;
    if (!py::isinstance<py::iterable>(shapes)) wrong_type(shapes, "obstacles", "a sequence of names");
    for (const py::handle shape : shapes)
        result.all.push_back({choice<Obstacle::Shape>(
            shape, "obstacles", {{"capsule", Obstacle::Shape::capsule}, {"plane", Obstacle::Shape::plane}})});
    if (result.all.empty()) return result;
    give(result.all, &Obstacle::radius, radii, "radii");
    give(result.all, &Obstacle::friction, friction, "friction");
    result.places = vectors(places, "obstacle_places", {times, result.all.size(), 2}, "(m, k, 2, 3)");
    return result;
}

[[nodiscard]] std::shared_ptr<Surface> surface_of(const ArrayLike& positions, const ArrayLike& triangles) {
    const Positions given_points(positions, "positions");
    const IndexRows<glm::ivec3> given_corners(triangles, "triangles");
    const std::vector<glm::vec3> points = copied(given_points.values());
    const std::vector<glm::ivec3> corners = copied(given_corners.values());
    const py::gil_scoped_release released;
    return std::make_shared<Surface>(points, corners);
}

struct Surfaces {
    std::vector<PlacedSurface> all;
    std::vector<glm::dmat4> matrices;
};

[[nodiscard]] Surfaces surfaces_of(py::handle given, py::handle matrices, py::handle distances,
                                   py::handle friction, std::size_t times) {
    Surfaces result;
    if (given.is_none()) return result;
    if (!py::isinstance<py::iterable>(given)) wrong_type(given, "surfaces", "a sequence of StrandSurface");
    for (const py::handle one : given) {
        static_cast<void>(instance<Surface>(one, "surfaces", "StrandSurface"));
        result.all.push_back({one.cast<std::shared_ptr<Surface>>()});
    }
    if (result.all.empty()) return result;
    give(result.all, &PlacedSurface::distance, distances, "surface_distances");
    give(result.all, &PlacedSurface::friction, friction, "surface_friction");
    const DoubleArray array = doubles(matrices, "surface_matrices");
    const std::vector<py::ssize_t> wanted{static_cast<py::ssize_t>(times),
                                          static_cast<py::ssize_t>(result.all.size()), 4, 4};
    if (!std::equal(wanted.begin(), wanted.end(), array.shape(), array.shape() + array.ndim()))
        value_error("surface_matrices", "must have the shape (m, s, 4, 4), not " + shape_of(array));
    const double* value = array.data();
    result.matrices.resize(times * result.all.size());
    for (glm::dmat4& one : result.matrices)
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column) one[column][row] = *value++;
    return result;
}

struct Pins {
    std::vector<std::size_t> pinned;
    std::vector<glm::dvec3> places;
    std::vector<double> weights;
};

[[nodiscard]] Pins pins_of(py::handle pinned, py::handle places, py::handle weights, std::size_t times) {
    Pins result{indices(pinned, "pinned"), {}, {}};
    if (result.pinned.empty()) return result;
    const std::size_t count = result.pinned.size();
    result.places = vectors(places, "pin_places", {times, count}, "(m, p, 3)");
    const DoubleArray given = doubles(weights, "pin_weights");
    if (given.ndim() == 0) {
        result.weights.assign(times * count, *given.data());
    } else if (given.ndim() == 2 && static_cast<std::size_t>(given.shape(0)) == times &&
               static_cast<std::size_t>(given.shape(1)) == count) {
        result.weights.assign(given.data(), given.data() + given.size());
    } else {
        value_error("pin_weights", "must be a number or have the shape (m, p), not " + shape_of(given));
    }
    return result;
}

}  // namespace

void bind_strand(py::module_& m) {
    py::class_<Surface, std::shared_ptr<Surface>>(m, "StrandSurface", py::module_local(), R"(
Triangles that strands cannot go through, from either side. Immutable.

positions: (v, 3) float32, in a space of their own.  triangles: (t, 3) int32.  Raises ValueError or TypeError that names the
argument.)")
        .def(py::init(&surface_of), "positions"_a, "triangles"_a)
        .def_property_readonly("nbytes", &Surface::bytes, "Of the memory that it takes, roughly.");
    py::class_<Motion>(m, "StrandMotion", py::module_local(), R"(
Strands over a whole shot: particles, each joined to its parent by a link, that hang, swing and touch. Solved once, by solve(), then
read at any time.

parents: (n,), index of each particle's parent, which comes before it; -1 for a root, which stays on the pose.  times: (m,), s,
strictly rising.  poses: (m, n, 3), where the animation has the particles; links are as long as there.

A number for all links, or (n,): mass: kg, > 0.  frequency: Hz, of a spring towards the pose, at most rate / 8; 0: none.  damping:
its damping ratio, 0 to 100.  response: of that spring, as SecondOrder's, -100 to 100.  drag: deceleration relative to the air a
velocity, 1/s, 0 to 1000.  stretch: by how much of its length a link is lengthened by its particle's weight, 0 to 1e6.  bend_frequency: Hz, of a
spring that keeps the pose's angle to the parent's link.  bend: rad, 0 to pi, at most this angle from where the link would be if it followed its parent's link as in the pose.  side_bend: rad,
0 to pi, the same for what goes towards the link's side or away from it, where that is less.  thickness: m, >= 0, radius in contacts.

gravity, air: acceleration, and velocity of the air: (3,), or (m, 3), one for each time; None: 0.  gravity_factor: how many times gravity
counts, -1000 to 1000: a number for all links, or (n,).
obstacles: k names, "capsule" (around the segment between both places; a ball if they are one) or "plane" (through the first
place; solid on the side away from the second).  obstacle_places: (m, k, 2, 3).  radii, friction: a number or (k,).
surfaces: s StrandSurface, which particles and the middles of links keep away from, by the thickness and surface_distances: a
number or (s,), m.  surface_matrices: (m, s, 4, 4), to world space, scaled evenly.  surface_friction: a number or (s,).
pinned: p indices of particles that are held.  pin_places: (m, p, 3).  pin_weights: a number or (m, p), 0 to 1: 1 holds fast, below
that a spring that is the softer the less.
resets: rising indices of times at which all starts anew in the pose.
sides: (m, n, 3), where the sides of links point in the pose; None: side_bend does not count.
touching: whether links keep away from each other, by the thicknesses of both, or as far as in the first pose if that is less.
touching_friction: of them.
rate: steps a second, 60 to 1e5.  settle: s, 0 to 1000: for at most so long strands come to rest before the motion begins.
loop: the times are one cycle of an endless motion, gone through up to `cycles` times until it closes.

Everything in world space and metres, linear between times.  Raises ValueError or TypeError that names the argument.)")
        .def(py::init([](const ArrayLike& parents, const ArrayLike& times, const ArrayLike& poses,
                         const ArrayLike& mass, const ArrayLike& frequency, const ArrayLike& damping,
                         const ArrayLike& response, const ArrayLike& drag, const ArrayLike& stretch,
                         const ArrayLike& bend_frequency, const ArrayLike& bend, const ArrayLike& side_bend,
                         const ArrayLike& thickness, const OptionalArrayLike& gravity,
                         const OptionalArrayLike& air, const ArrayLike& gravity_factor,
                         const OptionalTexts& obstacles, const OptionalArrayLike& obstacle_places,
                         const ArrayLike& radii, const ArrayLike& friction, const OptionalSurfaces& surfaces,
                         const OptionalArrayLike& surface_matrices, const ArrayLike& surface_distances,
                         const ArrayLike& surface_friction, const OptionalWholeNumbers& pinned,
                         const OptionalArrayLike& pin_places, const ArrayLike& pin_weights,
                         const OptionalWholeNumbers& resets, const OptionalArrayLike& sides,
                         const Flag& touching, const Number& touching_friction, const Number& rate,
                         const Number& settle, const Flag& loop, const WholeNumber& cycles) {
                 std::vector<Link> links;
                 for (const int parent : whole_numbers(parents, "parents")) {
                     Link link;
                     link.parent = parent;
                     links.push_back(link);
                 }
                 give(links, &Link::mass, mass, "mass");
                 give(links, &Link::frequency, frequency, "frequency");
                 give(links, &Link::damping, damping, "damping");
                 give(links, &Link::response, response, "response");
                 give(links, &Link::drag, drag, "drag");
                 give(links, &Link::stretch, stretch, "stretch");
                 give(links, &Link::bend_frequency, bend_frequency, "bend_frequency");
                 give(links, &Link::bend, bend, "bend");
                 give(links, &Link::side_bend, side_bend, "side_bend");
                 give(links, &Link::thickness, thickness, "thickness");
                 give(links, &Link::gravity_factor, gravity_factor, "gravity_factor");
                 const DoubleArray moments = doubles(times, "times");
                 if (moments.ndim() != 1)
                     value_error("times", "must have the shape (m,), not " + shape_of(moments));
                 const auto count = static_cast<std::size_t>(moments.size());
                 const auto pose = vectors(poses, "poses", {count, links.size()}, "(m, n, 3)");
                 const auto pulls = over_time(gravity, "gravity"), winds = over_time(air, "air");
                 const Obstacles solid = obstacles_of(obstacles, obstacle_places, radii, friction, count);
                 const Surfaces meshes =
                     surfaces_of(surfaces, surface_matrices, surface_distances, surface_friction, count);
                 const Pins pins = pins_of(pinned, pin_places, pin_weights, count);
                 const std::vector<std::size_t> jumps = indices(resets, "resets");
                 const auto across = sides.is_none()
                                         ? std::vector<glm::dvec3>()
                                         : vectors(sides, "sides", {count, links.size()}, "(m, n, 3)");
                 const Solving solving{.rate = number(rate, "rate"),
                                       .settle = number(settle, "settle"),
                                       .is_loop = flag(loop, "loop"),
                                       .cycles = whole_number(cycles, "cycles")};
                 const Inputs inputs{.times = {moments.data(), count},
                                     .poses = pose,
                                     .gravity = pulls,
                                     .air = winds,
                                     .obstacles = solid.all,
                                     .obstacle_places = solid.places,
                                     .surfaces = meshes.all,
                                     .surface_matrices = meshes.matrices,
                                     .pinned = pins.pinned,
                                     .pin_places = pins.places,
                                     .pin_weights = pins.weights,
                                     .resets = jumps,
                                     .sides = across,
                                     .are_touching = flag(touching, "touching"),
                                     .friction = number(touching_friction, "touching_friction")};
                 return Motion(links, inputs, solving);
             }),
             "parents"_a, "times"_a, "poses"_a, py::kw_only(), "mass"_a = 1.0, "frequency"_a = 0.0,
             "damping"_a = 0.3, "response"_a = 0.0, "drag"_a = 0.0, "stretch"_a = 0.0,
             "bend_frequency"_a = 0.0, "bend"_a = std::numbers::pi, "side_bend"_a = std::numbers::pi,
             "thickness"_a = 0.0, "gravity"_a = py::none(), "air"_a = py::none(), "gravity_factor"_a = 1.0,
             "obstacles"_a = py::none(), "obstacle_places"_a = py::none(), "radii"_a = 0.0,
             "friction"_a = 0.5, "surfaces"_a = py::none(), "surface_matrices"_a = py::none(),
             "surface_distances"_a = 0.0, "surface_friction"_a = 0.5, "pinned"_a = py::none(),
             "pin_places"_a = py::none(), "pin_weights"_a = 1.0, "resets"_a = py::none(),
             "sides"_a = py::none(), "touching"_a = false, "touching_friction"_a = 0.5, "rate"_a = 480.0,
             "settle"_a = 0.0, "loop"_a = false, "cycles"_a = 40)
        .def("__len__", &Motion::size)
        .def(
            "solve",
            [](Motion& self, const WholeNumber& steps) {
                const int most = whole_number(steps, "steps");
                if (most < 0) value_error("steps", "must be at least 0");
                const ReleaseGil released(self.size() * static_cast<std::size_t>(most), step_cost);
                return self.solve(static_cast<std::size_t>(most));
            },
            "steps"_a = 2147483647, R"(
Goes on for about so many steps: whether all is solved. No other thread may use this object meanwhile.)")
        .def_property_readonly("is_solved", &Motion::is_solved)
        .def_property_readonly(
            "solved_until", &Motion::solved_until,
            "Time up to which places are known, s; of a loop the first one until all is solved.")
        .def_property_readonly(
            "gap", &Motion::gap,
            "Of a loop, the largest distance of a particle at the end of its last cycle from "
            "where that began, m.")
        .def_property_readonly("nbytes", &Motion::bytes, "Of the memory that it takes.")
        .def_property_readonly(
            "near_pairs", &Motion::near_pairs,
            "Number of pairs of links that are so near each other in the first pose that they may touch.")
        .def(
            "places",
            [](const Motion& self, const Number& time) {
                const double at = number(time, "time");
                DoubleArray result = new_array({self.size(), 3});
                const std::span<glm::dvec3> out = points_of(result);
                {
                    const ReleaseGil released(self.size() * Motion::knot, step_cost);
                    self.places(at, out);
                }
                return result;
            },
            "time"_a, R"(
Where the particles are at a time, s: (n, 3). After solved_until, as at that time.)");
}

}  // namespace motus::bindings
