// Smooth noise of one, two and three variables, and gusts of wind.
#include "motus/noise/noise.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"
#include "mesh/arrays.hpp"
#include "motus/noise/gusts.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;

constexpr double noise_cost = 5.0;  // ns, rough
constexpr double gusts_cost = 50.0;

/// A copy of places as rows of float32, in an array of the shape of the result: `rows` without the last axis
/// if a place has several coordinates.
struct Places {
    Places(const py::object& object, const char* name, py::ssize_t coordinates) {
        const FloatArray given = floats(object, name);
        if (coordinates > 1 &&
            (given.ndim() < 1 || given.ndim() > 2 || given.shape(given.ndim() - 1) != coordinates))
            value_error(name, "must have the shape (" + std::to_string(coordinates) + ",) or (m, " +
                                  std::to_string(coordinates) + "), not " + shape_of(given));
        if (coordinates == 1 && given.ndim() > 1)
            value_error(name, "must be a number or (m,), not " + shape_of(given));
        is_single = given.ndim() == (coordinates == 1 ? 0 : 1);
        count = static_cast<std::size_t>(given.size() / coordinates);
        // A copy, since another thread may write into the caller's array after the values have been looked
        // at.
        rows.assign(given.data(), given.data() + given.size());
        if (!std::all_of(rows.begin(), rows.end(), [](float number) { return std::isfinite(number); }))
            value_error(name, "every value must be finite in single precision");
    }

    template <class Place>
    [[nodiscard]] std::span<const Place> as() const {
        static_assert(sizeof(Place) % sizeof(float) == 0);
        return {reinterpret_cast<const Place*>(rows.data()), count};
    }

    std::vector<float> rows;
    std::size_t count = 0;
    bool is_single = false;
};

template <class Place>
constexpr py::ssize_t coordinates_of = Place::length();
template <>
constexpr py::ssize_t coordinates_of<float> = 1;

template <class Place>
[[nodiscard]] py::object values_at(const py::object& places, const char* name, const WholeNumber& seed) {
    const std::uint32_t from = seed_of(seed);
    const Places at(places, name, coordinates_of<Place>);
    FloatArray result(static_cast<py::ssize_t>(at.count));
    {
        const std::span<float> out{result.mutable_data(), at.count};
        const ReleaseGil released(at.count, noise_cost);
        noise::values(at.as<Place>(), from, out);
    }
    if (at.is_single) return py::float_(*result.data());
    return result;
}

}  // namespace

void bind_noise(py::module_& m) {
    m.def(
        "noise1",
        [](const ArrayLike& x, const WholeNumber& seed, const WholeNumber& period) -> py::object {
            const double units = number(period, "period");
            if (units != 0.0) {
                if (!(units >= 1.0 && units <= noise::longest_period) || units != std::floor(units))
                    value_error("period", "must be a whole number from 0 to 2^28");
                const auto whole = static_cast<std::uint32_t>(units);
                return map_numbers(Numbers(x, "x"), noise_cost * 20.0, [&, from = seed_of(seed)](double at) {
                    return static_cast<double>(noise::looped(at, whole, from));
                });
            }
            // A single number keeps its precision: seconds times a speed grow large.
            if (PyFloat_Check(x.ptr()) != 0) return py::float_(noise::value(number(x, "x"), seed_of(seed)));
            return values_at<float>(x, "x", seed);
        },
        "x"_a, "seed"_a = 0, "period"_a = 0, R"(
Smooth noise of one variable, in [-1, 1]: two continuous derivatives, no period, most of its power below one wave a unit.

x: a float, taken in double precision, or (m,), taken in float32.  seed: a whole number from 0 to 2^32 - 1; different
seeds give independent noises.  period: 0, or whole units after which the noise repeats without a seam, to 2^28; x is
then taken in double precision, and the result is float64.
Returns a float or (m,) float32; beyond 2^30 the noise is constant. The same bits by the same compiler.
Raises ValueError if a value is not finite, also as float32, or a shape is wrong.)");
    m.def(
        "steps",
        [](const ArrayLike& x, const WholeNumber& seed, const Number& blend) {
            const double share = number(blend, "blend");
            return map_numbers(Numbers(x, "x"), noise_cost * 2.0, [&, from = seed_of(seed)](double at) {
                return noise::steps(at, share, from);
            });
        },
        "x"_a, "seed"_a = 0, "blend"_a = 0.0, R"(
A random number in [-1, 1] for each unit of x, held until the next one.

x: a number or (m,).  seed: a whole number from 0 to 2^32 - 1.  blend: fraction of a unit, from 0 to 1, in which it
goes over from the number before by a smooth step.
Returns a float or (m,) float64.  Raises ValueError if a value is not finite or outside its domain.)");
    m.def(
        "noise2",
        [](const ArrayLike& xy, const WholeNumber& seed) { return values_at<glm::vec2>(xy, "xy", seed); },
        "xy"_a, "seed"_a = 0, R"(
Smooth noise of two variables, as noise1().  xy: (2,) or (m, 2), taken in float32.  Returns a float or (m,) float32.)");
    m.def(
        "noise3",
        [](const ArrayLike& xyz, const WholeNumber& seed) { return values_at<glm::vec3>(xyz, "xyz", seed); },
        "xyz"_a, "seed"_a = 0, R"(
Smooth noise of three variables, as noise1().  xyz: (3,) or (m, 3), taken in float32.  Returns a float or (m,) float32.)");
    m.def(
        "gusts",
        [](const ArrayLike& times, const Number& frequency, const Number& period) {
            const noise::Gusts of(number(frequency, "frequency"), number(period, "period"));
            const DoubleArray at = doubles(times, "times");
            if (at.ndim() != 1) value_error("times", "must be (m,), not " + shape_of(at));
            const auto count = static_cast<std::size_t>(at.size());
            const std::span<const double> given{at.data(), count};
            DoubleArray result(static_cast<py::ssize_t>(count));
            const std::span<double> out{result.mutable_data(), count};
            const ReleaseGil released(count, gusts_cost);
            noise::values(of, given, out);
            return result;
        },
        "times"_a, "frequency"_a, "period"_a = 0.0, R"(
How much the wind rises and falls in gusts, in [-1, 1]: four sine waves whose rates have no common period.

times: (m,), s.  frequency: of the first and highest wave, 1/s, above 0, at most 1000.  period: time after which the gusts
begin again, s, from 1e-6 to 1e30, for which the frequencies are changed a little; 0 for none.
Returns (m,) float64, the gusts of snow's wind if times are those since its start. The same bits by the same compiler.
Raises ValueError if a number is outside of its domain, or a shape is wrong.)");
}

}  // namespace motus::bindings
