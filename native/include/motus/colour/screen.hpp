// A green or blue screen in a picture: its colour, how even it is, and the matte of a colour difference key.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

namespace motus::colour {

/// Rows of pixels: red, green, blue (scene-linear, finite) and alpha. Has at least one pixel.
struct Picture {
    std::span<const glm::vec4> pixels;  ///< width times as many as there are rows
    std::size_t width = 1;
};

/// Throws std::invalid_argument where a picture is not as said. So do the functions of pictures.
void check(const Picture& picture);

/// Scene-linear colour of the green or blue screen: the median of the most frequent saturated hue, of which
/// pixels near the picture's border count most. None if there is none on at least a fiftieth of the picture.
[[nodiscard]] std::optional<glm::dvec3> screen_color(const Picture& picture);

/// Whether a colour is one that a picture can be keyed by: a green or blue hue of at least a tenth
/// saturation. Red, yellow, magenta, grey and white are none.
[[nodiscard]] bool is_screen_color(const glm::dvec3& color);

/// How the amount of the screen in a pixel is measured.
struct Difference {
    double balance = 0.0;  ///< in [0, 1]: the screen's channel is compared with the larger of the others at
                           ///< 0, with their mean at 0.5, with the smaller at 1
    double gain = 1.0;     ///< >= 0, what the amount is multiplied by
};

/// Alpha of a pixel, in [0, 1], by the colour difference m(C), the screen's channel less a mixture of the
/// others (Vlahos): clamp(1 - gain m(pixel) / m(screen)). 0 for the screen's colour and for what has more of
/// its hue, 1 for what has none of it, however bright.
[[nodiscard]] double matte(const glm::dvec3& pixel, const glm::dvec3& screen,
                           const Difference& difference = {});

/// How well a picture can be keyed by a colour.
struct ScreenQuality {
    double share = 0.0;             ///< of the picture's pixels that are of the screen
    double luminance_spread = 0.0;  ///< 5th to 95th percentile of the screen's luminance, over its median
    double chroma_spread =
        0.0;  ///< 95th percentile of the distance from the median chromaticity (r, g, b sum to 1)
    double spill =
        0.0;  ///< mean excess of the screen's channel on the subject, 1 for as much as the screen's
    double black = 0.0;  ///< level of the matte that clears the screen, in [0, 0.9]
    double white = 1.0;  ///< level of the matte at which the subject is opaque, in [black + 0.1, 1]
};

/// color: one that is_screen_color(). difference: of the matte that the levels are of. Pixels count if
/// the other kind is a twelfth of the picture's greater side away, or a twenty-fifth if these are few: nearer
/// ones may be a soft edge.
/// Numbers of what is not in the picture, screen or subject, are the defaults.
[[nodiscard]] ScreenQuality judge_screen(const Picture& picture, const glm::dvec3& color,
                                         const Difference& difference = {});

}  // namespace motus::colour
