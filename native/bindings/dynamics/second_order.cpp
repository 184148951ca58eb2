// Second-order filters and their outputs over time.
#include "motus/dynamics/second_order.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <string>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "motus/dynamics/track.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using namespace motus::dynamics;

constexpr double step_cost = 60.0;  // ns, rough
constexpr double sample_cost = 10.0;

/// Times, and a row of numbers for each: (m,) or (m, d).
struct Samples {
    Samples(const ArrayLike& given_times, const ArrayLike& given_inputs)
        : times(doubles(given_times, "times")), inputs(doubles(given_inputs, "inputs")) {
        if (times.ndim() != 1) value_error("times", "must have the shape (m,), not " + shape_of(times));
        if (inputs.ndim() < 1 || inputs.ndim() > 2 || inputs.shape(0) != times.shape(0))
            value_error("inputs",
                        "must have the shape (m,) or (m, d), m the number of times, not " + shape_of(inputs));
        dimensions = inputs.ndim() == 1 ? 1 : static_cast<std::size_t>(inputs.shape(1));
    }
    [[nodiscard]] std::span<const double> times_span() const {
        return {times.data(), static_cast<std::size_t>(times.size())};
    }
    [[nodiscard]] std::span<const double> inputs_span() const {
        return {inputs.data(), static_cast<std::size_t>(inputs.size())};
    }

    DoubleArray times;
    DoubleArray inputs;
    std::size_t dimensions = 1;
};

[[nodiscard]] SecondOrder filter_of(const Number& frequency, const Number& damping, const Number& response) {
    return {number(frequency, "frequency"), number(damping, "damping"), number(response, "response")};
}

/// Bound as Track: whether its inputs were rows or plain numbers decides the shape of its results.
struct BoundTrack {
    Track track;
    bool is_plain;
};

void bind_filter(py::module_& m) {
    py::class_<SecondOrder>(m, "SecondOrder", py::module_local(), R"(
How an output y follows an input x: y + k1 y' + k2 y'' = x + k3 x'. Immutable; times in seconds.

frequency f: Hz, > 0.  damping zeta: >= 0; 0 rings for ever, 1 is critical.  response r: 0 starts slowly, up to 1 responds
at once, above 1 overshoots, below 0 anticipates.  k1 = zeta / (pi f), k2 = 1 / (2 pi f)^2, k3 = r zeta / (2 pi f).
Raises ValueError if a value is not finite or outside its domain.)")
        .def(py::init(&filter_of), "frequency"_a, "damping"_a, "response"_a)
        .def_static(
            "from_coefficients",
            [](const Number& k1, const Number& k2, const Number& k3) {
                return SecondOrder::from_coefficients({number(k1, "k1"), number(k2, "k2"), number(k3, "k3")});
            },
            "k1"_a, "k2"_a, "k3"_a, R"(
The filter with these coefficients: k1 >= 0 in s, k2 > 0 in s^2, any k3 in s.)")
        .def_static(
            "from_mass_spring",
            [](const Number& mass, const Number& stiffness, const Number& resistance) {
                return SecondOrder::from_mass_spring(number(mass, "mass"), number(stiffness, "stiffness"),
                                                     number(resistance, "resistance"));
            },
            "mass"_a, "stiffness"_a, "resistance"_a, R"(
A mass (kg, > 0) on a spring (N/m, > 0) and a damper (N s/m, >= 0): y + (b/k) y' + (m/k) y'' = x + (b/k) x'.)")
        .def_static(
            "from_overshoot",
            [](const Number& overshoot, const Number& settling, const Number& response,
               const Number& tolerance) {
                return SecondOrder::from_overshoot(number(overshoot, "overshoot"),
                                                   number(settling, "settling"), number(response, "response"),
                                                   number(tolerance, "tolerance"));
            },
            "overshoot"_a, "settling"_a, "response"_a = 0.0, "tolerance"_a = 0.02, R"(
The filter whose step response overshoots by a fraction of the step (between 0 and 1) and stays within `tolerance` of its
end after `settling` seconds (> 0). Raises ValueError too if no damping gives that overshoot with this response.)")
        .def_property_readonly("frequency", &SecondOrder::frequency)
        .def_property_readonly("damping", &SecondOrder::damping)
        .def_property_readonly("response", &SecondOrder::response)
        .def_property_readonly("coefficients",
                               [](const SecondOrder& self) {
                                   const auto [k1, k2, k3] = self.coefficients();
                                   return py::make_tuple(k1, k2, k3);
                               })
        .def_property_readonly("overshoot", [](const SecondOrder& self) { return overshoot(self); })
        .def(
            "settling_time",
            [](const SecondOrder& self, const Number& tolerance) {
                return settling_time(self, number(tolerance, "tolerance"));
            },
            "tolerance"_a = 0.02, R"(
Last time, s, at which the step response is further than `tolerance` (> 0) from its final value; infinity without damping.)");
    m.def(
        "step_response",
        [](const ArrayLike& times, const Number& frequency, const Number& damping, const Number& response) {
            const SecondOrder filter = filter_of(frequency, damping, response);
            return map_numbers(Numbers(times, "times"), step_cost,
                               [&](double time) { return step_response(filter, time).value; });
        },
        "times"_a, "frequency"_a, "damping"_a, "response"_a, R"(
Response of a SecondOrder to an input that jumps from 0 to 1 at time 0.

times: s, a number or (m,).  Returns a float or (m,).  Other arguments and errors as SecondOrder().)");
    m.def(
        "second_order",
        [](const ArrayLike& times, const ArrayLike& inputs, const Number& frequency, const Number& damping,
           const Number& response) {
            const SecondOrder filter = filter_of(frequency, damping, response);
            const Samples samples(times, inputs);
            DoubleArray result(std::vector<py::ssize_t>(samples.inputs.shape(),
                                                        samples.inputs.shape() + samples.inputs.ndim()));
            const std::span<double> out = values_of(result);
            {
                const ReleaseGil released(out.size(), sample_cost);
                second_order(filter, samples.times_span(), samples.inputs_span(), samples.dimensions, out);
            }
            return result;
        },
        "times"_a, "inputs"_a, "frequency"_a, "damping"_a, "response"_a, R"(
Outputs of a SecondOrder at the samples of its input, at rest on the first.

times: (m,), s, strictly rising.  inputs: (m,) or (m, d), linear between samples; there the step is exact, whatever its
length.  Returns an array of the shape of inputs.  Raises ValueError if shapes differ, times do not rise, or a value is
not finite; other arguments and errors as SecondOrder().)");
}

/// An array with a row for each time, which write(time, row) fills.
template <class Write>
[[nodiscard]] DoubleArray rows_at(const BoundTrack& bound, const ArrayLike& times, const Write& write) {
    const Numbers at(times, "times");
    const std::size_t size = bound.track.dimensions();
    const std::size_t count = at.values().size();
    std::vector<py::ssize_t> shape;
    if (!at.is_single()) shape.push_back(static_cast<py::ssize_t>(count));
    if (!bound.is_plain) shape.push_back(static_cast<py::ssize_t>(size));
    DoubleArray result(shape);
    const std::span<double> out = values_of(result);
    {
        const ReleaseGil released(out.size(), step_cost);
        for (std::size_t i = 0; i < count; ++i) write(at.values()[i], out.subspan(i * size, size));
    }
    return result;
}

/// The rotation that rotation_at(time) gives for each time.
template <class RotationAt>
[[nodiscard]] DoubleArray rotations_at(const ArrayLike& times, const RotationAt& rotation_at) {
    const Numbers at(times, "times");
    const std::size_t count = at.values().size();
    DoubleArray result = at.is_single() ? new_array({4}) : new_array({count, 4});
    const std::span<glm::dquat> out = quaternions_in(result.mutable_data(), count);
    {
        const ReleaseGil released(count, step_cost);
        std::ranges::transform(at.values(), out.begin(), rotation_at);
        rows_from_quaternions(out);
    }
    return result;
}

void bind_tracks(py::module_& m) {
    py::class_<BoundTrack>(m, "Track", py::module_local(), R"(
An output at any time, in any order, of a SecondOrder and an input over time. Immutable.

times: (m,), s, strictly rising.  inputs: (m,) or (m, d), linear between samples.  resets: rising indices of samples to
which the input jumps: until then it keeps its value, and at the jump the output starts anew.  loop: the samples are one
cycle, whose last sample is the first of the next cycle; the output closes without a seam, and each cycle is offset by the
difference between the last sample and the first.  Raises ValueError if shapes differ, times do not rise, a value is not finite, a loop has resets,
or its length is a whole number of periods without damping.)")
        .def(py::init([](const SecondOrder& filter, const ArrayLike& times, const ArrayLike& inputs,
                         const OptionalWholeNumbers& resets, bool loop) {
                 const Samples samples(times, inputs);
                 const std::vector<std::size_t> jumps = indices(resets, "resets");
                 return BoundTrack{Track(filter, samples.times_span(), samples.inputs_span(),
                                         samples.dimensions, jumps, loop ? Start::loop : Start::at_rest),
                                   samples.inputs.ndim() == 1};
             }),
             "filter"_a, "times"_a, "inputs"_a, "resets"_a = py::none(), "loop"_a = false)
        .def(
            "evaluate",
            [](const BoundTrack& self, const ArrayLike& times) {
                return rows_at(self, times,
                               [&](double time, std::span<double> row) { self.track.evaluate(time, row); });
            },
            "times"_a, R"(
Outputs at times, s, a number or (m,): of the shape of the times, followed by the inputs' d if they have one.)")
        .def(
            "value",
            [](const BoundTrack& self, double time) {
                if (!self.is_plain) value_error("inputs", "must have had the shape (m,)");
                double result = 0.0;
                self.track.evaluate(time, {&result, 1});
                return result;
            },
            "time"_a, R"(
The output of inputs (m,) at one time, s, as a float, without the cost of arrays.)")
        .def_property_readonly(
            "nbytes", [](const BoundTrack& self) { return self.track.bytes(); },
            "Of the memory that it takes.")
        .def(
            "offsets",
            [](const BoundTrack& self, const ArrayLike& times) {
                return rows_at(self, times,
                               [&](double time, std::span<double> row) { self.track.offset(time, row); });
            },
            "times"_a, R"(
Outputs less inputs at times, in the shape of evaluate(): exactly 0 if the input has never moved.)");
    py::class_<RotationTrack>(m, "RotationTrack", py::module_local(), R"(
A Track of rotations: inputs (m, 4), unit quaternions w, x, y, z, each taken by the shorter way from the one before. The
output is the input turned by a rotation vector that is filtered in its tangent space: about one fixed axis this is the filter
of the angle. With `loop` the last input has to equal the first.)")
        .def(py::init([](const SecondOrder& filter, const ArrayLike& times, const ArrayLike& inputs,
                         const OptionalWholeNumbers& resets, bool loop) {
                 const Samples samples(times, inputs);
                 if (samples.inputs.ndim() != 2 || samples.dimensions != 4)
                     value_error("inputs", "must have the shape (m, 4), not " + shape_of(samples.inputs));
                 std::vector<glm::dquat> rotations;
                 for (std::size_t i = 0; i < samples.times_span().size(); ++i) {
                     const double* row = samples.inputs.data() + 4 * i;
                     rotations.emplace_back(row[0], row[1], row[2], row[3]);
                 }
                 const std::vector<std::size_t> jumps = indices(resets, "resets");
                 return RotationTrack(filter, samples.times_span(), rotations, jumps,
                                      loop ? Start::loop : Start::at_rest);
             }),
             "filter"_a, "times"_a, "inputs"_a, "resets"_a = py::none(), "loop"_a = false)
        .def(
            "evaluate",
            [](const RotationTrack& self, const ArrayLike& times) {
                return rotations_at(times, [&](double time) { return self.evaluate(time); });
            },
            "times"_a, R"(
Rotations at times, s, a number or (m,): (4,) or (m, 4).)")
        .def(
            "offsets",
            [](const RotationTrack& self, const ArrayLike& times) {
                return rotations_at(times, [&](double time) { return self.offset(time); });
            },
            "times"_a, R"(
Turns from the inputs to the outputs at times, in the inputs' own frames, in the shape of evaluate(): exactly the identity if the
input has never moved.)")
        .def_property_readonly("nbytes", &RotationTrack::bytes, "Of the memory that it takes.");
}

}  // namespace

void bind_second_order(py::module_& m) {
    bind_filter(m);  // first: SecondOrder
    bind_tracks(m);
}

}  // namespace motus::bindings
