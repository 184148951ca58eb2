// A green or blue screen: its colour, and the matte.
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "motus/colour/screen.hpp"
#include "web.hpp"

namespace motus::web {
namespace {

/// Red, green, blue and alpha of each pixel.
std::vector<glm::vec4> pixels_of(const double* numbers, std::size_t count) {
    std::vector<glm::vec4> pixels;
    for (std::size_t i = 0; i + 3 < count; i += 4)
        pixels.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]);
    return pixels;
}

}  // namespace

/// out: red, green and blue of the screen, scene-linear; all 0 if none is found.
MOTUS_WEB(screen_color)(const double* picture, std::size_t count, std::size_t width, double* out) {
    const std::vector<glm::vec4> pixels = pixels_of(picture, count);
    write(out, colour::screen_color({pixels, width}).value_or(glm::dvec3(0.0)));
}

/// out: the matte of each pixel.
MOTUS_WEB(screen_matte)
(const double* picture, std::size_t count, const double* color, std::size_t, double balance, double gain,
 double* out) {
    const std::vector<glm::vec4> pixels = pixels_of(picture, count);
    colour::mattes(pixels, {color[0], color[1], color[2]}, {balance, gain}, {out, pixels.size()});
}

/// out: the share of the picture that shows the screen, and the levels of the matte that clear the screen and
/// leave the subject opaque.
MOTUS_WEB(screen_report)
(const double* picture, std::size_t count, std::size_t width, const double* color, std::size_t,
 double balance, double gain, double* out) {
    const std::vector<glm::vec4> pixels = pixels_of(picture, count);
    const colour::ScreenQuality quality =
        colour::judge_screen({pixels, width}, {color[0], color[1], color[2]}, {balance, gain});
    out[0] = quality.share;
    out[1] = quality.black;
    out[2] = quality.white;
}

}  // namespace motus::web
