// Where on the way at which time.
#include "motus/path/timing.hpp"

#include <pybind11/pybind11.h>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr double timing_cost = 10.0;  // ns, rough

[[nodiscard]] path::AfterEase after_option(const Text& after) {
    return choice<path::AfterEase>(after, "after",
                                   {{"rest", path::AfterEase::rest},
                                    {"go_on", path::AfterEase::go_on},
                                    {"repeat", path::AfterEase::repeat}});
}

/// The two columns of a profile; the library checks their values.
template <class Make>
[[nodiscard]] path::Timing profile(const py::object& keys, const char* keys_name, const py::object& values,
                                   const char* values_name, Make make) {
    const Numbers first(keys, keys_name);
    const Numbers second(values, values_name);
    return make(first.values(), second.values());
}

void bind_ease(py::module_& m) {
    m.def(
        "ease",
        [](const ArrayLike& u, const Number& ease_in, const Number& ease_out) {
            const double in = number(ease_in, "ease_in");
            const double out = number(ease_out, "ease_out");
            return map_numbers(Numbers(u, "u"), timing_cost,
                               [&](double at) { return path::ease(at, in, out); });
        },
        "u"_a, "ease_in"_a, "ease_out"_a, R"(
Fraction of the path at the fraction u of the time: constant acceleration, constant speed, constant deceleration.

u: a number or (m,), clamped to [0, 1].  ease_in, ease_out: fractions of the time, each in [0, 1], their sum <= 1.
Returns a float or (m,); 0 at u = 0, 1 at u = 1, with a continuous derivative if ease_in and ease_out are above 0.
Raises ValueError if a value is not finite or outside its domain.)");
    m.def(
        "ease_derivative",
        [](const ArrayLike& u, const Number& ease_in, const Number& ease_out) {
            const double in = number(ease_in, "ease_in");
            const double out = number(ease_out, "ease_out");
            return map_numbers(Numbers(u, "u"), timing_cost,
                               [&](double at) { return path::ease_derivative(at, in, out); });
        },
        "u"_a, "ease_in"_a, "ease_out"_a, R"(
Derivative of ease() with respect to u: a float or (m,); 0 outside [0, 1].  Arguments and errors as ease().)");
}

}  // namespace

void bind_timing(py::module_& m) {
    bind_ease(m);
    py::class_<path::Timing>(m, "Timing", py::module_local(), R"(
Distance as a function of time, for follow(): seconds, and the curve's unit of length. Immutable.

Made by Timing.eased, .constant, .pins, .speeds or .speeds_by_distance, which raise ValueError if a value is not finite
or outside its domain, TypeError if one is not a real number.)")
        .def_static(
            "eased",
            [](const Number& duration, const Number& length, const Number& ease_in, const Number& ease_out,
               const Text& after) {
                return path::Timing::eased(number(duration, "duration"), number(length, "length"),
                                           number(ease_in, "ease_in"), number(ease_out, "ease_out"),
                                           after_option(after));
            },
            "duration"_a, "length"_a, "ease_in"_a = 0.0, "ease_out"_a = 0.0, "after"_a = "rest", R"(
`length` in `duration` seconds (> 0) with ease() at both ends; at rest before 0.

after: the motion after duration: 'rest'; 'go_on' with the last speed; 'repeat', lap after lap from where the last one ended.
Laps cost nothing, however many they are.)")
        .def_static(
            "constant", [](const Number& speed) { return path::Timing::constant(number(speed, "speed")); },
            "speed"_a,
            R"(
speed * time, for all times.)")
        .def_static(
            "pins",
            [](const ArrayLike& times, const ArrayLike& distances) {
                return profile(times, "times", distances, "distances", &path::Timing::pins);
            },
            "times"_a, "distances"_a, R"(
Through pins: at times (k,), strictly increasing, k >= 1, at distances (k,); at rest outside.

Monotone cubics in between (Fritsch and Carlson 1980): no overshoot, at rest between pins of equal distance.)")
        .def_static(
            "speeds",
            [](const ArrayLike& times, const ArrayLike& speeds) {
                return profile(times, "times", speeds, "speeds", &path::Timing::speeds);
            },
            "times"_a, "speeds"_a, R"(
The exact integral of speeds (k,) given at times (k,), strictly increasing, k >= 1: linear in between, held outside; 0 at
time 0. A negative speed goes backwards.)")
        .def_static(
            "speeds_by_distance",
            [](const ArrayLike& distances, const ArrayLike& speeds, const OptionalNumber& lap) {
                return profile(distances, "distances", speeds, "speeds",
                               [&lap](std::span<const double> places, std::span<const double> values) {
                                   return lap.is_none() ? path::Timing::speeds_by_distance(places, values)
                                                        : path::Timing::speeds_by_distance(
                                                              places, values, number(lap, "lap"));
                               });
            },
            "distances"_a, "speeds"_a, "lap"_a = py::none(), R"(
Motion that has speeds (k,), all > 0, at distances (k,), strictly increasing, k >= 1: linear in between, held outside;
at distance 0 at time 0.  lap: > 0, way after which the speeds come again; the distances lie within one lap then.)")
        .def(
            "distance",
            [](const path::Timing& self, const ArrayLike& time) {
                return map_numbers(Numbers(time, "time"), timing_cost,
                                   [&](double t) { return self.distance(t); });
            },
            "time"_a, R"(
Distance at a time (a number or (m,), s): a float or (m,).)")
        .def(
            "speed",
            [](const path::Timing& self, const ArrayLike& time) {
                return map_numbers(Numbers(time, "time"), timing_cost,
                                   [&](double t) { return self.speed(t); });
            },
            "time"_a, R"(
Derivative of distance() at a time (a number or (m,), s): a float or (m,); at a jump the speed after it.)");
}

}  // namespace motus::bindings
