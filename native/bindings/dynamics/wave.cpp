// Waves.
#include "motus/dynamics/wave.hpp"

#include <pybind11/pybind11.h>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"

namespace motus::bindings {

using namespace pybind11::literals;
using dynamics::Wave;

constexpr double wave_cost = 10.0;  // ns, rough

void bind_wave(py::module_& m) {
    m.def(
        "wave",
        [](const Text& shape, const ArrayLike& x, const Number& share) {
            const auto chosen = choice<Wave>(shape, "shape",
                                             {{"sine", Wave::sine},
                                              {"triangle", Wave::triangle},
                                              {"saw", Wave::saw},
                                              {"square", Wave::square}});
            const double up = number(share, "share");
            return map_numbers(Numbers(x, "x"), wave_cost,
                               [&](double at) { return dynamics::wave(chosen, at, up); });
        },
        "shape"_a, "x"_a, "share"_a = 0.5, R"(
A wave of the length 1 at x, in [-1, 1].

shape: "sine" and "triangle", which are 0 and rise where x is whole; "saw", which rises from -1 to 1; "square", which is
1, then -1.  x: a number or (m,).  share: fraction of a wave, from 0 to 1, for which a square is 1.
Returns a float or (m,).  Raises ValueError if a value is not finite or outside its domain, or the shape is unknown.)");
}

}  // namespace motus::bindings
