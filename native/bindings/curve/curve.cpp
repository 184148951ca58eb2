// Curves: construction, evaluation, arc length, and operations that return new curves.
#include "curve.hpp"

#include <pybind11/pybind11.h>

#include <string>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "motus/curve/bezier.hpp"
#include "motus/curve/bspline.hpp"
#include "motus/curve/nearest.hpp"
#include "path/options.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

// The classes that Python sees: one curve, told apart by how it was made.
class Bezier : public BoundCurve {
    using BoundCurve::BoundCurve;
};
class Spline : public BoundCurve {
    using BoundCurve::BoundCurve;
};
class Chain : public BoundCurve {
    using BoundCurve::BoundCurve;
};
class BSpline : public BoundCurve {
    using BoundCurve::BoundCurve;
};
class PolyLine : public BoundCurve {
    using BoundCurve::BoundCurve;
};

/// Rough cost of one evaluation, ns: it only decides whether the interpreter's lock is given away.
[[nodiscard]] double evaluation_cost(const BoundCurve& self) {
    const double degree = self.curve().degree();
    return 10.0 + degree * degree;
}

/// A curve made from `source`: a Bezier of a Bezier, else a Chain.
[[nodiscard]] Typed<"motus_native.Curve"> like(const py::object& source, curve::Curve curve) {
    if (py::isinstance<Bezier>(source)) return py::cast(Bezier(std::move(curve)));
    return py::cast(Chain(std::move(curve)));
}

[[nodiscard]] const BoundCurve& bound(const py::object& self) {
    return self.cast<const BoundCurve&>();
}

[[nodiscard]] py::array control_points(const py::object& self) {
    const curve::Curve& curve = bound(self).curve();
    DoubleArray flat = to_array(curve.control_points());
    if (py::isinstance<Bezier>(self)) return flat;
    return py::array(flat).reshape({static_cast<py::ssize_t>(curve.segment_count()),
                                    static_cast<py::ssize_t>(curve.degree()) + 1, py::ssize_t{3}});
}

[[nodiscard]] curve::Curve chain_of(py::handle object, bool cyclic) {
    const DoubleArray array = doubles(object, "control_points");
    if (array.ndim() != 3 || array.shape(2) != 3)
        value_error("control_points",
                    "must have the shape (segments, degree + 1, 3), not " + shape_of(array));
    if (array.shape(1) < 2 || array.shape(1) > curve::max_degree + 1)
        value_error("control_points", "the degree must lie in 1 to " + std::to_string(curve::max_degree));
    const std::span<const glm::dvec3> points(reinterpret_cast<const glm::dvec3*>(array.data()),
                                             static_cast<std::size_t>(array.shape(0) * array.shape(1)));
    return curve::Curve::chain(static_cast<int>(array.shape(1)) - 1, points, cyclic);
}

[[nodiscard]] Typed<"tuple[typing.Any, numpy.typing.NDArray[numpy.float64], typing.Any]"> nearest_to(
    const BoundCurve& self, const ArrayLike& object) {
    const DoubleArray points = doubles(object, "point");
    if (points.ndim() < 1 || points.ndim() > 2 || points.shape(points.ndim() - 1) != 3)
        value_error("point", "must have the shape (3,) or (m, 3), not " + shape_of(points));
    const std::span<const glm::dvec3> in(reinterpret_cast<const glm::dvec3*>(points.data()),
                                         static_cast<std::size_t>(points.size()) / 3);
    DoubleArray t = new_array({in.size()});
    DoubleArray positions = new_array({in.size(), 3});
    DoubleArray distances = new_array({in.size()});
    const std::span<double> t_out = values_of(t);
    const std::span<glm::dvec3> positions_out = points_of(positions);
    const std::span<double> distances_out = values_of(distances);
    {
        const auto segments = static_cast<double>(self.curve().segment_count());
        const ReleaseGil released(in.size(), 100.0 * (evaluation_cost(self) + segments));
        for (std::size_t i = 0; i < in.size(); ++i) {
            const curve::Nearest found = nearest(self.curve(), in[i]);
            t_out[i] = found.t;
            positions_out[i] = found.position;
            distances_out[i] = found.distance;
        }
    }
    if (points.ndim() == 2) return py::make_tuple(t, positions, distances);
    return py::make_tuple(t_out[0], to_array(positions_out[0]), distances_out[0]);
}

void bind_bends(py::class_<BoundCurve>& curve) {
    curve.def(
        "curvature",
        [](const BoundCurve& self, const ArrayLike& t, const ExtendName& extend) {
            const curve::Extend how = extend_option(extend);
            return map_numbers(Numbers(t, "t"), 2.0 * evaluation_cost(self),
                               [&](double at) { return curvature(self.curve(), at, how); });
        },
        "t"_a, "extend"_a = "clamp", R"(
Curvature |C' x C''| / |C'|^3 at t (a number or (m,)), 1 / unit of length: a float or (m,).

Where C' vanishes, the limit: infinity at a cusp, 0 on a straight stretch.  extend: what a t outside means, as in
position(); 0 if it goes straight on.  Raises as position().)");
    curve.def(
        "torsion",
        [](const BoundCurve& self, const ArrayLike& t, const ExtendName& extend) {
            const curve::Extend how = extend_option(extend);
            return map_numbers(Numbers(t, "t"), 2.0 * evaluation_cost(self),
                               [&](double at) { return torsion(self.curve(), at, how); });
        },
        "t"_a, "extend"_a = "clamp", R"(
Torsion (C' x C'') . C''' / |C' x C''|^2 at t (a number or (m,)), 1 / unit of length: a float or (m,).

Positive where the curve turns as a right-handed screw, forth and back; 0 where the curvature is 0 or infinite.
extend: as in curvature().  Raises as position().)");
}

void bind_evaluation(py::class_<BoundCurve>& curve) {
    curve.def(
        "position",
        [](const BoundCurve& self, const ArrayLike& t, const ExtendName& extend) {
            const curve::Extend how = extend_option(extend);
            return map_points(Numbers(t, "t"), evaluation_cost(self),
                              [&](double at) { return position(self.curve(), at, how); });
        },
        "t"_a, "extend"_a = "clamp", R"(
Position at the parameter t.

t: a number or (m,), in [0, segment_count].  extend: the meaning of a t outside: 'clamp' the nearest end; 'extrapolate' on
along the end's derivative; 'loop' modulo the interval; 'ping_pong' forth and back.
Returns (3,) or (m, 3), in the curve's space and unit. De Casteljau's scheme (cubics: the Bernstein form): Farin,
"Curves and Surfaces for CAGD" (2002).  Raises ValueError if t is not finite or extend is none of these names,
TypeError if t does not hold real numbers.)");
    curve.def(
        "derivative",
        [](const BoundCurve& self, const ArrayLike& t, const WholeNumber& order, const ExtendName& extend) {
            const int times = whole_number(order, "order");
            if (times < 1 || times > 3) value_error("order", "must be 1, 2 or 3");
            const curve::Extend how = extend_option(extend);
            return map_points(Numbers(t, "t"), evaluation_cost(self),
                              [&](double at) { return derivative(self.curve(), at, times, how); });
        },
        "t"_a, "order"_a = 1, "extend"_a = "clamp", R"(
Derivative of the position with respect to t.

t: a number or (m,), in [0, segment_count]; at a joint the segment that begins there counts.  order: 1, 2 or 3.
extend: outside, the derivative of position(t, extend): 'loop' repeats it; on the way back of 'ping_pong' odd orders
change their sign; 'extrapolate' keeps the end's first derivative, the others are 0; 'clamp' gives the end's derivative.
Returns (3,) or (m, 3).  Raises ValueError if t is not finite or order is not 1, 2 or 3, TypeError as position().)");
    curve.def(
        "tangent",
        [](const BoundCurve& self, const ArrayLike& t, const ExtendName& extend) {
            const curve::Extend how = extend_option(extend);
            return map_points(Numbers(t, "t"), 2.0 * evaluation_cost(self),
                              [&](double at) { return tangent(self.curve(), at, how); });
        },
        "t"_a, "extend"_a = "clamp", R"(
Unit tangent at t (a number or (m,)): (3,) or (m, 3).

Where the first derivative vanishes (cusp, handle on its point): its limit from the right, or at the end of the curve from
the left; (0, 1, 0) on a curve of zero length.  extend: as in derivative(), order 1.  Raises as position().)");
    bind_bends(curve);
}

void bind_arc_length(py::class_<BoundCurve>& curve) {
    constexpr double look_up_cost = 20.0;
    curve.def(
        "length", [](const BoundCurve& self) { return self.path()->length(); }, R"(
Length of the curve in its unit; gaps between segments do not count; 0 if all points coincide.

Adaptive Clenshaw-Curtis quadrature of |C'|; error <= 1e-12 of the length, cusps included.)");
    curve.def(
        "length_at",
        [](const BoundCurve& self, const ArrayLike& t, const ExtendName& extend) {
            const curve::Extend how = extend_option(extend);
            const Numbers at(t, "t");
            const curve::ArcLength& path = *self.path();
            return map_numbers(at, 2.0 * look_up_cost,
                               [&](double value) { return length_at(path, value, how); });
        },
        "t"_a, "extend"_a = "clamp", R"(
Distance along the curve from its start to t (a number or (m,)): a float or (m,).

extend: outside [0, segment_count] the distance at which position_at_length(s, extend) is position(t, extend): 'loop' and
'ping_pong' add whole lengths, 'extrapolate' goes on by |C'| of that end.
Error <= 1e-12 of the length.  Raises as position().)");
    curve.def(
        "t_at_length",
        [](const BoundCurve& self, const ArrayLike& s, const ExtendName& extend) {
            const curve::Extend how = extend_option(extend);
            const Numbers at(s, "s");
            const curve::ArcLength& path = self.path_by_length();
            return map_numbers(at, look_up_cost,
                               [&](double value) { return t_at_length(path, value, how).value; });
        },
        "s"_a, "extend"_a = "clamp", R"(
Parameter at the distance s along the curve: the inverse of length_at().

s: a number or (m,), in [0, length()].  extend: what an s outside means, as in position(); 'extrapolate' gives the end's
parameter, since no parameter lies beyond.
Returns a float or (m,); the distance at it differs from s by <= 1e-10 of the length (measured: 1e-12). Where the curve
rests (a segment of zero length), one of its parameters.  Raises as position().)");
    curve.def(
        "position_at_length",
        [](const BoundCurve& self, const ArrayLike& s, const ExtendName& extend) {
            const curve::Extend how = extend_option(extend);
            const Numbers at(s, "s");
            const curve::ArcLength& path = self.path_by_length();
            return map_points(at, look_up_cost + evaluation_cost(self),
                              [&](double value) { return position_at_length(path, value, how); });
        },
        "s"_a, "extend"_a = "clamp", R"(
Position at the distance s along the curve: equal steps of s are equal steps on the curve.

s: a number or (m,), in [0, length()].  extend: what an s outside means, as in position(); 'extrapolate' goes on straight
along the unit tangent of that end.
Returns (3,) or (m, 3), right to 1e-10 of the length.  Raises as position().)");
}

void bind_operations(py::class_<BoundCurve>& curve) {
    curve.def("nearest", &nearest_to, "point"_a, R"(
The nearest of all points of the curve.

point: (3,) or (m, 3), in the curve's space.  Returns (t, position, distance): float, (3,), float, or (m,), (m, 3), (m,).
Branch and bound, then Newton's method; the distance is right to 1e-12 of itself.  Raises ValueError for another shape,
if a value is not finite, or above 1e100.)");
    curve.def(
        "bounds",
        [](const BoundCurve& self) {
            const curve::Box box = bounds(self.curve());
            return py::make_tuple(to_array(box.min), to_array(box.max));
        },
        R"(
Corners (min, max) of the smallest axis-aligned box that holds the curve, each (3,).)");
    curve.def(
        "split",
        [](const py::object& self,
           const Number& t) -> Typed<"tuple[motus_native.Curve, motus_native.Curve]"> {
            auto [before, after] = split(bound(self).curve(), number(t, "t"));
            return py::make_tuple(like(self, std::move(before)), like(self, std::move(after)));
        },
        "t"_a, R"(
The parts (before, after) of the curve cut at t (a number, clamped): two Bezier of a Bezier, else two Chain.

Cut at an end, one part has zero length.  Raises ValueError if t is not finite, TypeError if it is no number.)");
    curve.def(
        "elevate",
        [](const py::object& self, const WholeNumber& times) {
            return like(self, elevated(bound(self).curve(), whole_number(times, "times")));
        },
        "times"_a = 1, R"(
The same curve written with a degree higher by `times`: a Bezier of a Bezier, else a Chain.

Raises ValueError if times < 0 or the degree would pass 64, TypeError if it is no whole number.)");
    curve.def(
        "reversed", [](const py::object& self) { return like(self, reversed(bound(self).curve())); }, R"(
The same points run through from the end to the start: a Bezier of a Bezier, else a Chain.)");
    curve.def(
        "transformed",
        [](const py::object& self, const ArrayLike& m) {
            return like(self, transformed(bound(self).curve(), matrix(m, "matrix")));
        },
        "matrix"_a, R"(
The curve moved by an affine matrix, (4, 4) in rows as Blender's: a Bezier of a Bezier, else a Chain.

Raises ValueError for another shape or if a value is not finite.)");
}

void bind_constructors(py::module_& m) {
    py::class_<Bezier, BoundCurve>(m, "Bezier", py::module_local(), R"(
A Bezier curve of any degree n, 1 to 64, t in [0, 1].)")
        .def(py::init([](const ArrayLike& points) {
                 return Bezier(curve::Curve::bezier(Points(points, "control_points").values()));
             }),
             "control_points"_a, R"(
control_points: (n + 1, 3), 2 to 65 rows.  Raises ValueError for another shape or if a value is not finite,
TypeError if they are not real numbers.)");
    py::class_<Spline, BoundCurve>(m, "Spline", py::module_local(), R"(
Cubic segments through points with two handles each, as Blender's Bezier splines; t in [0, segment_count].)")
        .def(py::init([](const ArrayLike& points, const ArrayLike& left, const ArrayLike& right,
                         const Flag& cyclic) {
                 return Spline(curve::Curve::spline(
                     Points(points, "points").values(), Points(left, "handles_left").values(),
                     Points(right, "handles_right").values(), flag(cyclic, "cyclic")));
             }),
             "points"_a, "handles_left"_a, "handles_right"_a, "cyclic"_a = false, R"(
points, handles_left, handles_right: (k, 3), k >= 2.  cyclic: adds the segment from the last point to the first.
Raises ValueError for another shape, different k, or if a value is not finite, TypeError if they are not real
numbers.)");
    py::class_<Chain, BoundCurve>(m, "Chain", py::module_local(), R"(
Bezier segments of one degree, each with its own control points, so that neighbours may be apart; t in
[0, segment_count].)")
        .def(py::init([](const ArrayLike& points, const Flag& cyclic) {
                 return Chain(chain_of(points, flag(cyclic, "cyclic")));
             }),
             "control_points"_a, "cyclic"_a = false, R"(
control_points: (segments, degree + 1, 3), degree 1 to 64.  cyclic: says that the end is the start; adds no segment.
Raises ValueError for another shape or if a value is not finite, TypeError if they are not real numbers.)");
    py::class_<BSpline, BoundCurve>(m, "BSpline", py::module_local(), R"(
Blender's NURBS spline with all weights 1, as Bezier segments of degree order - 1, exactly; one a knot span.)")
        .def(py::init([](const ArrayLike& points, const WholeNumber& order, const Flag& cyclic,
                         const Flag& use_endpoint, const Flag& use_bezier) {
                 return BSpline(
                     curve::bspline(Points(points, "points").values(),
                                    {whole_number(order, "order"), flag(cyclic, "cyclic"),
                                     flag(use_endpoint, "use_endpoint"), flag(use_bezier, "use_bezier")}));
             }),
             "points"_a, "order"_a = 4, "cyclic"_a = false, "use_endpoint"_a = false, "use_bezier"_a = false,
             R"(
points: (k, 3), k >= 2.  order: 2 to 6.  The flags are Blender's (use_cyclic_u, use_endpoint_u, use_bezier_u) and decide
the knots; combinations that Blender shows as the bare control polygon give that polygon.
Raises ValueError for another shape or order or if a value is not finite, TypeError if they are not real numbers.)");
    py::class_<PolyLine, BoundCurve>(m, "PolyLine", py::module_local(), R"(
Straight segments from point to point, as Blender's poly splines; t in [0, segment_count].)")
        .def(py::init([](const ArrayLike& points, const Flag& cyclic) {
                 return PolyLine(curve::poly_line(Points(points, "points").values(), flag(cyclic, "cyclic")));
             }),
             "points"_a, "cyclic"_a = false, R"(
points: (k, 3), k >= 2.  cyclic: adds the segment from the last point to the first.
Raises ValueError for another shape or if a value is not finite, TypeError if they are not real numbers.)");
}

}  // namespace

void bind_curve(py::module_& m) {
    py::class_<BoundCurve> curve(m, "Curve", py::module_local(), R"(
A curve of Bezier segments of one degree; the base of Bezier, Spline, Chain, BSpline and PolyLine. Immutable.

The parameter t runs over [0, segment_count], segment i over [i, i + 1].)");
    curve.def_property_readonly(
        "degree", [](const BoundCurve& self) { return self.curve().degree(); },
        "Degree of the segments, 1 to 64.");
    curve.def_property_readonly(
        "segment_count", [](const BoundCurve& self) { return self.curve().segment_count(); },
        "Number of segments: the end of the parameter's interval.");
    curve.def_property_readonly(
        "cyclic", [](const BoundCurve& self) { return self.curve().cyclic(); },
        "Whether the curve's end is its start.");
    curve.def_property_readonly("control_points", &control_points, R"(
A copy of the control points: (degree + 1, 3) of a Bezier, else (segment_count, degree + 1, 3).)");
    curve.def("__repr__", [](const py::object& self) {
        const curve::Curve& of = bound(self).curve();
        return "<" + py::str(py::type::handle_of(self).attr("__name__")).cast<std::string>() + " of degree " +
               std::to_string(of.degree()) + ", " + std::to_string(of.segment_count()) +
               (of.segment_count() == 1 ? " segment" : " segments") + (of.cyclic() ? ", cyclic>" : ">");
    });
    bind_evaluation(curve);
    bind_arc_length(curve);
    bind_operations(curve);
    bind_constructors(m);
}

}  // namespace motus::bindings
