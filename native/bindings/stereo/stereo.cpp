// Stereo: parallax, depth budgets, screens, and statistics of depth samples.
#include <pybind11/pybind11.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "motus/stereo/around.hpp"
#include "motus/stereo/eyes.hpp"
#include "motus/stereo/scene_depth.hpp"
#include "motus/stereo/screen.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using namespace motus::stereo;

constexpr double point_cost = 20.0;  // ns, rough

/// A number that may be infinite.
[[nodiscard]] double distance(const py::object& object, const char* name) {
    if (PyFloat_Check(object.ptr()) != 0 && std::isinf(PyFloat_AS_DOUBLE(object.ptr())))
        return PyFloat_AS_DOUBLE(object.ptr());
    return number(object, name);
}

[[nodiscard]] ConvergenceMode mode_of(const StereoModeName& mode) {
    return choice<ConvergenceMode>(mode, "mode",
                                   {{"off_axis", ConvergenceMode::off_axis},
                                    {"parallel", ConvergenceMode::parallel},
                                    {"toe_in", ConvergenceMode::toe_in}});
}

[[nodiscard]] Eyes eyes_of(const Number& interaxial, const Number& focal_length, const Number& sensor_width,
                           const Number& convergence, const StereoModeName& mode) {
    const Eyes eyes{number(interaxial, "interaxial"), number(focal_length, "focal_length"),
                    number(sensor_width, "sensor_width"), distance(convergence, "convergence"),
                    mode_of(mode)};
    check(eyes);
    return eyes;
}

[[nodiscard]] Screen screen_of(const Number& width, const Number& viewing_distance,
                               const Number& eye_separation) {
    const Screen screen{number(width, "width"), number(viewing_distance, "viewing_distance"),
                        number(eye_separation, "eye_separation")};
    check(screen);
    return screen;
}

[[nodiscard]] Limits limits_of(const Number& near, const Number& far) {
    return {number(near, "near_parallax"), number(far, "far_parallax")};
}

[[nodiscard]] py::object points_seen(const ArrayLike& points, const Eyes& eyes) {
    const Points given(points, "points");
    const std::span<const glm::dvec3> in = given.values();
    DoubleArray result = new_array({in.size(), 2, 2});
    const std::span<double> out = values_of(result);
    {
        const ReleaseGil released(in.size(), point_cost);
        for (std::size_t i = 0; i < in.size(); ++i) {
            const Pair pair = project(eyes, in[i]);
            out[4 * i] = pair.left.x;
            out[4 * i + 1] = pair.left.y;
            out[4 * i + 2] = pair.right.x;
            out[4 * i + 3] = pair.right.y;
        }
    }
    return result;
}

[[nodiscard]] Typed<"tuple[float, float]"> violations(const ArrayLike& x, const ArrayLike& depths,
                                                      const Eyes& eyes, double tolerance) {
    const Numbers places(x, "x"), given(depths, "depths");
    if (places.values().size() != given.values().size()) value_error("depths", "must be as many as x");
    std::vector<Sample> samples(given.values().size());
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = {places.values()[i], given.values()[i]};
    const Window found = window_violations(eyes, samples, tolerance);
    return py::make_tuple(found.left, found.right);
}

[[nodiscard]] py::object smoothed(const ArrayLike& values, const WholeNumber& ahead, const Text& side) {
    const DoubleArray given = doubles(values, "values");
    if (given.ndim() != 1) value_error("values", "must have the shape (m,), not " + shape_of(given));
    const int count = whole_number(ahead, "ahead");
    if (count < 0) value_error("ahead", "must be at least 0");
    const Side bound = choice<Side>(
        side, "side", {{"either", Side::either}, {"below", Side::below}, {"above", Side::above}});
    const auto size = static_cast<std::size_t>(given.size());
    DoubleArray result = new_array({size});
    const std::span<double> out = values_of(result);
    {
        const ReleaseGil released(size, 2.0 * count);
        smooth({given.data(), size}, static_cast<std::size_t>(count), bound, out);
    }
    return result;
}

void bind_eyes(py::module_& m) {
    m.def(
        "parallax",
        [](const ArrayLike& depth, const Number& interaxial, const Number& focal_length,
           const Number& sensor_width, const Number& convergence, const StereoModeName& mode) {
            const Eyes eyes = eyes_of(interaxial, focal_length, sensor_width, convergence, mode);
            return map_numbers(Numbers(depth, "depth"), point_cost,
                               [&](double one) { return parallax(eyes, one); });
        },
        "depth"_a, "interaxial"_a, "focal_length"_a, "sensor_width"_a, "convergence"_a, "mode"_a = "off_axis",
        R"(
Parallax of a point: by how much the right eye sees it further right than the left eye, as a fraction of the image's width,
positive behind the screen. (t f / s) (1 / convergence - 1 / depth) for eyes that look the same way.

depth: > 0, a number or (m,), along the camera's axis; unit of interaxial (>= 0) and of convergence (> 0, may be math.inf).
focal_length, sensor_width: > 0, in the same unit; the width of the sensor's part that the image shows.
mode: "off_axis"; "parallel", whose convergence is infinite; "toe_in", whose parallax holds at the middle of the image.
Returns a float or (m,).  Raises ValueError if a number is outside its domain.)");
    m.def(
        "solve_depth_budget",
        [](const Number& near, const Number& far, const Number& near_parallax, const Number& far_parallax,
           const Number& focal_length, const Number& sensor_width) {
            Eyes lens;
            lens.focal_length = number(focal_length, "focal_length");
            lens.sensor_width = number(sensor_width, "sensor_width");
            check(lens);
            const Eyes eyes = fit_budget(lens, {number(near, "near"), distance(far, "far")},
                                         limits_of(near_parallax, far_parallax));
            return py::make_tuple(eyes.interaxial, eyes.convergence);
        },
        "near"_a, "far"_a, "near_parallax"_a, "far_parallax"_a, "focal_length"_a, "sensor_width"_a, R"(
Interaxial distance and convergence of off-axis eyes by which a range of depths takes exactly a range of parallax.

near, far: depths, 0 < near < far; far may be math.inf.  near_parallax, far_parallax: magnitudes >= 0 in front of and behind
the screen, fractions of the image's width, not both 0.  focal_length, sensor_width: as parallax() has them.
Returns (interaxial, convergence), unit of the depths.  Raises ValueError if a number is outside its domain.)");
    m.def(
        "depth_budget",
        [](const Number& near_parallax, const Number& far_parallax, const Number& interaxial,
           const Number& focal_length, const Number& sensor_width, const Number& convergence,
           const StereoModeName& mode) {
            const Range range =
                depths_within(eyes_of(interaxial, focal_length, sensor_width, convergence, mode),
                              limits_of(near_parallax, far_parallax));
            return py::make_tuple(range.near, range.far);
        },
        "near_parallax"_a, "far_parallax"_a, "interaxial"_a, "focal_length"_a, "sensor_width"_a,
        "convergence"_a, "mode"_a = "off_axis", R"(
The inverse of solve_depth_budget(): the depths between which parallax stays within two magnitudes >= 0; other arguments as
for parallax().
Returns (near, far); far is math.inf if no depth is too far.)");
    m.def(
        "stereo_points",
        [](const ArrayLike& points, const Number& interaxial, const Number& focal_length,
           const Number& sensor_width, const Number& convergence, const StereoModeName& mode) {
            return points_seen(points, eyes_of(interaxial, focal_length, sensor_width, convergence, mode));
        },
        "points"_a, "interaxial"_a, "focal_length"_a, "sensor_width"_a, "convergence"_a,
        "mode"_a = "off_axis", R"(
Image positions at which both eyes see points.

points: (m, 3), right, up and forward of the middle between the eyes, in front of both.  Other arguments as for parallax().
Returns (m, 2, 2): of each point left and right eye, of these x and y from the image's middle, fractions of its width.
Raises ValueError for a point that is not in front of both eyes.)");
    m.def(
        "vertical_parallax",
        [](const ArrayLike& depth, const Number& aspect, const Number& interaxial, const Number& focal_length,
           const Number& sensor_width, const Number& convergence, const StereoModeName& mode) {
            return vertical_parallax(eyes_of(interaxial, focal_length, sensor_width, convergence, mode),
                                     number(depth, "depth"), number(aspect, "aspect"));
        },
        "depth"_a, "aspect"_a, "interaxial"_a, "focal_length"_a, "sensor_width"_a, "convergence"_a,
        "mode"_a = "toe_in", R"(
Largest vertical parallax at a depth, in a corner of the image: a fraction of the image's width, 0 except for "toe_in".

aspect: the image's width / its height, > 0.  Other arguments as for parallax().  Returns a float.)");
}

void bind_around(py::module_& m) {
    m.def(
        "parallax_around",
        [](const ArrayLike& given, const Number& interaxial, const Number& convergence,
           const Number& elevation, const Number& merge_from, const Number& merge_to) {
            const EyesAround eyes{number(interaxial, "interaxial"), distance(convergence, "convergence"),
                                  number(merge_from, "merge_from"), number(merge_to, "merge_to")};
            const double row = number(elevation, "elevation");
            check(eyes);
            return map_numbers(Numbers(given, "distance"), point_cost,
                               [&](double one) { return parallax(eyes, one, row); });
        },
        "distance"_a, "interaxial"_a, "convergence"_a, "elevation"_a = 0.0,
        "merge_from"_a = EyesAround{}.merge_from, "merge_to"_a = EyesAround{}.merge_to, R"(
Parallax in a stereo panorama: by how much the right eye sees a point further right than the left eye, rad of azimuth,
positive behind the sphere of zero parallax. Of Cycles' spherical stereo: each column is seen from another place.

distance: from the centre, a number or (m,), at least half of interaxial (>= 0); same unit as convergence (> 0, may be
math.inf), the radius of the sphere.  elevation: of the picture's row, rad, -pi / 2 to pi / 2.
merge_from, merge_to: elevations, rad, between which the eyes approach each other; 0 <= merge_from <= merge_to <= pi / 2.
Returns a float or (m,).  Raises ValueError if a number is outside its domain.)");
}

void bind_screen(py::module_& m) {
    m.def(
        "seen_distance",
        [](const ArrayLike& parallax, const Number& width, const Number& viewing_distance,
           const Number& eye_separation) {
            const Screen screen = screen_of(width, viewing_distance, eye_separation);
            return map_numbers(Numbers(parallax, "parallax"), point_cost,
                               [&](double one) { return seen_distance(screen, one); });
        },
        "parallax"_a, "width"_a, "viewing_distance"_a, "eye_separation"_a = 0.065, R"(
Perceived distance from the audience, m, of a point with a parallax (a fraction of the width; a number or (m,)).

width, viewing_distance, eye_separation: of the screen, m, > 0.
Returns a float or (m,), math.inf if the eyes are parallel or would have to turn apart.)");
    m.def(
        "divergence_limit",
        [](const Number& width, const Number& eye_separation) {
            Screen screen;
            screen.width = number(width, "width");
            screen.eye_separation = number(eye_separation, "eye_separation");
            return divergence_limit(screen);
        },
        "width"_a, "eye_separation"_a = 0.065, R"(
Parallax, a fraction of a screen's width (m, > 0), above which the eyes would have to turn apart.)");
    m.def(
        "comfortable_parallax",
        [](const Number& width, const Number& viewing_distance, const Number& eye_separation,
           const Number& angle) {
            const Limits limits =
                comfortable(screen_of(width, viewing_distance, eye_separation), number(angle, "angle"));
            return py::make_tuple(limits.near, limits.far);
        },
        "width"_a, "viewing_distance"_a, "eye_separation"_a = 0.065, "angle"_a = one_degree, R"(
Parallax that differs from the screen's own vergence by an angle (rad, 0 to 1.5), not beyond divergence.

Returns (near_parallax, far_parallax), magnitudes, fractions of the screen's width.)");
    m.def(
        "roundness",
        [](const ArrayLike& depth, const Number& interaxial, const Number& focal_length,
           const Number& sensor_width, const Number& convergence, const Number& width,
           const Number& viewing_distance, const Number& eye_separation, const StereoModeName& mode) {
            const Eyes eyes = eyes_of(interaxial, focal_length, sensor_width, convergence, mode);
            const Screen screen = screen_of(width, viewing_distance, eye_separation);
            return map_numbers(Numbers(depth, "depth"), point_cost,
                               [&](double one) { return roundness(screen, eyes, one); });
        },
        "depth"_a, "interaxial"_a, "focal_length"_a, "sensor_width"_a, "convergence"_a, "width"_a,
        "viewing_distance"_a, "eye_separation"_a = 0.065, "mode"_a = "off_axis", R"(
How deep a small ball at a depth seems, as a part of how wide it seems: 1 is round, less is flat, more is long.

Arguments as for parallax() and seen_distance(). On the screen V t / (e convergence).
Returns a float or (m,), math.inf if the eyes would have to turn apart.)");
}

void bind_scene(py::module_& m) {
    m.def(
        "depth_range",
        [](const ArrayLike& depths, const Number& low, const Number& high) -> py::object {
            const Numbers given(depths, "depths");
            const double from = number(low, "low"), to = number(high, "high");
            std::optional<Range> found;
            {
                const ReleaseGil released(given.values().size(), point_cost);
                found = depth_range(given.values(), from, to);
            }
            if (!found) return py::none();
            return py::make_tuple(found->near, found->far);
        },
        "depths"_a, "low"_a = 0.01, "high"_a = 0.99, R"(
Near and far depth of a scene: the depths below which the fractions low and high (0 to 1, low < high) of the samples lie.

depths: (m,); depths not above 0 do not count.  Returns (near, far), or None without samples.)");
    m.def(
        "window_violations",
        [](const ArrayLike& x, const ArrayLike& depths, const Number& interaxial, const Number& focal_length,
           const Number& sensor_width, const Number& convergence, const Number& tolerance,
           const StereoModeName& mode) {
            return violations(x, depths, eyes_of(interaxial, focal_length, sensor_width, convergence, mode),
                              number(tolerance, "tolerance"));
        },
        "x"_a, "depths"_a, "interaxial"_a, "focal_length"_a, "sensor_width"_a, "convergence"_a,
        "tolerance"_a = 0.0, "mode"_a = "off_axis", R"(
Largest parallax by which something in front of the screen is cut off in one eye's image alone, at each edge.

x: (m,), position at which the middle between the eyes sees each sample, fractions of the width from the image's middle.
depths: (m,); depths not above 0 do not count.  tolerance: parallax too small to be noticed, >= 0.
Returns (left, right), magnitudes, 0 if nothing is cut off.)");
    m.def("smooth_ahead", &smoothed, "values"_a, "ahead"_a, "side"_a = "either", R"(
Values at equal times, smoothed without lag by the values up to `ahead` (a whole number, 0 to 10000) before and behind.

side: "either"; "below" or "above": the side of all the values on which the curve stays; then values twice as far count.
Returns (m,).)");
}

}  // namespace

void bind_stereo(py::module_& m) {
    bind_eyes(m);
    bind_around(m);
    bind_screen(m);
    bind_scene(m);
}

}  // namespace motus::bindings
