// Green and blue screens: their colour, and how well they can be keyed.
#include "motus/colour/screen.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/typed.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using colour::Picture;

constexpr double pixel_cost = 40.0;  // ns, rough

/// A copy of a picture in single precision, checked.
struct Pixels {
    explicit Pixels(const ArrayLike& object) {
        const py::array given = py::array::ensure(object);
        if (!given) value_error("picture", "must be an array of numbers, all rows of one length");
        const char kind = given.dtype().kind();
        if (kind != 'f' && kind != 'i' && kind != 'u') type_error("picture", "must hold real numbers");
        if (given.ndim() != 3 || given.shape(2) != 4 || given.size() == 0)
            value_error("picture", "must have the shape (rows, columns, 4) and at least one pixel, not " +
                                       shape_of(given));
        const auto floats = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(given);
        if (!floats) type_error("picture", "cannot be converted to float32");
        width = static_cast<std::size_t>(floats.shape(1));
        rows.resize(static_cast<std::size_t>(floats.size()) / 4);
        const float* values = floats.data();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
            for (glm::length_t part = 0; part < 4; ++part)
                if (!std::isfinite(rows[i][part]))
                    value_error("picture", "every value must be finite in single precision");
        }
    }

    [[nodiscard]] Picture picture() const { return {rows, width}; }

    std::vector<glm::vec4> rows;
    std::size_t width = 1;
};

[[nodiscard]] colour::Difference difference_of(const Number& balance, const Number& gain) {
    const colour::Difference found{.balance = number(balance, "balance"), .gain = number(gain, "gain")};
    if (!(found.balance >= 0.0 && found.balance <= 1.0)) value_error("balance", "must be from 0 to 1");
    if (!(found.gain >= 0.0)) value_error("gain", "must not be below 0");
    return found;
}

[[nodiscard]] glm::dvec3 key_color(const ArrayLike& object, double balance) {
    const glm::dvec3 color = vector(object, "color");
    constexpr double any_balance = 1.0;
    if (!colour::is_screen_color(color, any_balance))
        value_error(
            "color",
            "must be a green or a blue: a hue from 75 to 270 degrees, of at least a tenth saturation");
    if (!colour::is_screen_color(color, balance))
        value_error("color", "must not be as green as it is blue, unless the balance is greater");
    return color;
}

[[nodiscard]] Typed<"numpy.typing.NDArray[numpy.float64] | None"> color_of_screen(const ArrayLike& picture) {
    const Pixels pixels(picture);
    std::optional<glm::dvec3> found;
    {
        const ReleaseGil released(pixels.rows.size(), pixel_cost);
        found = colour::screen_color(pixels.picture());
    }
    if (!found) return py::none();
    return to_array(*found);
}

[[nodiscard]] Typed<"dict[str, float]"> report_on_screen(const ArrayLike& picture, const ArrayLike& color,
                                                         const Number& balance, const Number& gain) {
    const Pixels pixels(picture);
    const colour::Difference difference = difference_of(balance, gain);
    const glm::dvec3 screen = key_color(color, difference.balance);
    colour::ScreenQuality report;
    {
        const ReleaseGil released(pixels.rows.size(), pixel_cost);
        report = colour::judge_screen(pixels.picture(), screen, difference);
    }
    return py::dict("share"_a = report.share, "luminance_spread"_a = report.luminance_spread,
                    "chroma_spread"_a = report.chroma_spread, "spill"_a = report.spill,
                    "black"_a = report.black, "white"_a = report.white);
}

[[nodiscard]] DoubleArray matte_of(const ArrayLike& picture, const ArrayLike& color, const Number& balance,
                                   const Number& gain) {
    const Pixels pixels(picture);
    const colour::Difference difference = difference_of(balance, gain);
    const glm::dvec3 screen = key_color(color, difference.balance);
    DoubleArray result = new_array({pixels.rows.size() / pixels.width, pixels.width});
    const std::span<double> out = values_of(result);
    {
        const ReleaseGil released(pixels.rows.size(), pixel_cost);
        colour::mattes(pixels.rows, screen, difference, out);
    }
    return result;
}

}  // namespace

void bind_colour(py::module_& m) {
    m.def("screen_color", &color_of_screen, "picture"_a, R"(
Colour of the green or blue screen in a picture, or None if there is none on at least a fiftieth of it.

The median of the most frequent saturated hue; pixels near the picture's border count most, transparent ones not at all.
picture: (rows, columns, 4), red, green, blue and alpha, scene-linear, taken in float32.
Returns (3,) float64, scene-linear. Raises ValueError if a value is not finite, or there is no pixel.)");
    m.def("screen_report", &report_on_screen, "picture"_a, "color"_a, "balance"_a = 0.0, "gain"_a = 1.0, R"(
How well a picture can be keyed by a colour.

picture: as for screen_color().  color: (3,), a green or a blue, not as green as it is blue at balance 0.  balance, gain: as for
screen_matte().
Returns a dict of floats. share: fraction of the pixels that show the screen.  luminance_spread: from the 5th to the 95th percentile of
the screen's luminance, over its median.  chroma_spread: 95th percentile of the distance from the screen's median
chromaticity, whose parts sum to 1.  spill: mean excess of the screen's channel on the subject, 1 for as much as on the screen; 0 for a
screen that is as green as it is blue.
black, white: levels of screen_matte() at which the screen is clear and the subject opaque; 0 <= black < white <= 1.)");
    m.def("screen_matte", &matte_of, "picture"_a, "color"_a, "balance"_a = 0.0, "gain"_a = 1.0, R"(
Alpha of each pixel by its colour difference: 1 - gain m(pixel) / m(color), clamped to [0, 1]. m is the screen's channel less a mixture of
the others: balance times the smaller plus (1 - balance) times the larger.

picture, color: as for screen_report().  balance: in [0, 1].  gain: not below 0.  Returns (rows, columns) float64.)");
}

}  // namespace motus::bindings
