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

/// Whether a colour is one that a picture can be keyed by: green or blue above the other channels, and these
/// below 1.
[[nodiscard]] bool is_screen_color(const glm::dvec3& color);

/// Alpha of a pixel, in [0, 1], as Blender's node Keying has it: 0 for the screen's colour and for what has
/// more of its hue, 1 for what has none of it. balance: in [0, 1], share of the smaller of the two other
/// channels in the mixture that the screen's channel is compared with.
[[nodiscard]] double matte(const glm::dvec3& pixel, const glm::dvec3& screen, double balance = 0.5);

/// How well a picture can be keyed by a colour.
struct Report {
    double share = 0.0;             ///< of the picture's pixels that are of the screen
    double luminance_spread = 0.0;  ///< 5th to 95th percentile of the screen's luminance, over its median
    double chroma_spread =
        0.0;  ///< 95th percentile of the distance from the median chromaticity (r, g, b sum to 1)
    double spill =
        0.0;  ///< mean excess of the screen's channel on the subject, 1 for as much as the screen's
    double black = 0.0;  ///< level of the matte that clears the screen, in [0, 0.9]
    double white = 1.0;  ///< level of the matte at which the subject is opaque, in [black + 0.1, 1]
};

/// color: one that is_screen_color(). Numbers of what is not in the picture, screen or subject, are the
/// defaults.
[[nodiscard]] Report judge_screen(const Picture& picture, const glm::dvec3& color);

}  // namespace motus::colour
