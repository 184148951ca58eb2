// A green or blue screen in a picture: its colour, how even it is, and the matte of a colour difference key.
//
// Costs: O(pixels); matte() and is_screen_color() O(1). All but matte(), mattes() and is_screen_color()
// allocate some memory for their work. Any number of threads at once.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

#include "motus/config.hpp"

namespace motus::colour {

/// Rows of pixels: red, green, blue (scene-linear, finite) and alpha. Has at least one pixel.
struct Picture {
    std::span<const glm::vec4> pixels;  ///< row by row, `width` of them each
    std::size_t width = 1;
};

/// Throws std::invalid_argument if a picture is not as described. So do all functions that take a picture.
void check(const Picture& picture);

/// Scene-linear colour of the green or blue screen: the median of the most frequent saturated hue, of which
/// pixels near the picture's border count most. None if there is none on at least a fiftieth of the picture.
[[nodiscard]] std::optional<glm::dvec3> screen_color(const Picture& picture);

/// How the amount of the screen in a pixel is measured.
struct Difference {
    double balance = 0.0;  ///< in [0, 1]: the screen's channel is compared with the larger of the others at
                           ///< 0, with their mean at 0.5, with the smaller at 1
    double gain = 1.0;     ///< >= 0, factor of the amount
};

/// Whether a picture can be keyed by a colour: a green or blue hue with a saturation of at least 0.1, of
/// which the colour difference m(C) of matte() is at least a hundredth of the larger of green and blue. Red,
/// yellow, magenta, grey and white cannot be keyed by, nor cyan at balance 0. Throws std::invalid_argument if
/// the balance is outside its domain.
[[nodiscard]] bool is_screen_color(const glm::dvec3& color, double balance = 0.0);

/// Alpha of a pixel, in [0, 1], by the colour difference m(C), the screen's channel less a mixture of the
/// others (Vlahos): clamp(1 - gain m(pixel) / m(screen)). 0 for the screen's colour and for pixels with more
/// of its hue, 1 for pixels without its hue, however bright; NaN for NaN. Throws std::invalid_argument if
/// is_screen_color() is false of the screen at the balance, or a number of the difference is outside its
/// domain.
[[nodiscard]] double matte(const glm::dvec3& pixel, const glm::dvec3& screen,
                           const Difference& difference = {});

/// matte() of many pixels. Throws as matte() does, and if the sizes differ.
void mattes(std::span<const glm::vec4> pixels, const glm::dvec3& screen, const Difference& difference,
            std::span<double> out);

/// How well a picture can be keyed by a colour.
struct ScreenQuality {
    double share = 0.0;             ///< fraction of the picture's pixels that show the screen
    double luminance_spread = 0.0;  ///< 5th to 95th percentile of the screen's luminance, over its median
    double chroma_spread =
        0.0;             ///< 95th percentile of the distance from the median chromaticity (r, g, b sum to 1)
    double spill = 0.0;  ///< mean excess of the screen's channel on the subject, 1 for as much as the screen
                         ///< has; 0 if is_screen_color() is false of the screen at balance 0
    double black = 0.0;  ///< level of the matte that clears the screen, in [0, 0.9]
    double white = 1.0;  ///< level of the matte at which the subject is opaque, in [black + 0.1, 1]
};

/// color: is_screen_color() is true of it at the balance. difference: of the matte for which the levels are.
/// Pixels of screen and subject count if those of the other are a twelfth of the picture's greater side away,
/// or a twenty-fifth if few pixels are: nearer ones may be a soft edge. If the picture has no screen or no
/// subject, the numbers about it are the defaults.
[[nodiscard]] ScreenQuality judge_screen(const Picture& picture, const glm::dvec3& color,
                                         const Difference& difference = {});

}  // namespace motus::colour
