#include "motus/colour/screen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <vector>

#include "motus/core/numeric.hpp"

namespace motus::colour {
namespace {

constexpr double least_share = 0.02;
constexpr double least_saturation = 0.25;
constexpr double least_value = 0.01;

/// Hue, saturation and value; the hue in degrees, [0, 360), 0 for grey.
struct Hsv {
    double hue = 0.0;
    double saturation = 0.0;
    double value = 0.0;
};

[[nodiscard]] Hsv hsv_of(const glm::dvec3& color) {
    const double most = std::max({color.x, color.y, color.z}), least = std::min({color.x, color.y, color.z});
    const double range = most - least;
    if (!(range > 0.0) || !(most > 0.0)) return {.value = most};
    double hue = color.x == most   ? (color.y - color.z) / range
                 : color.y == most ? 2.0 + (color.z - color.x) / range
                                   : 4.0 + (color.x - color.y) / range;
    if (hue < 0.0) hue += 6.0;
    return {60.0 * hue, std::min(range / most, 1.0), most};
}

/// Degrees between two hues, [0, 180].
[[nodiscard]] double hue_distance(double a, double b) {
    const double apart = std::abs(a - b);
    return std::min(apart, 360.0 - apart);
}

[[nodiscard]] double luminance(const glm::dvec3& color) {
    return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;  // Rec. 709
}

/// The amount by which the screen's channel, 1 or 2, is above a mixture of the others.
[[nodiscard]] double excess(const glm::dvec3& color, glm::length_t channel, double balance) {
    const double one = color.x, other = color[3 - channel];
    return color[channel] - (balance * std::min(one, other) + (1.0 - balance) * std::max(one, other));
}

[[nodiscard]] glm::length_t channel_of(const glm::dvec3& screen) {
    return screen.y >= screen.z ? 1 : 2;
}

/// Weight of a pixel in the search for the screen: subjects stand in the middle.
[[nodiscard]] double border_weight(std::size_t index, const Picture& picture) {
    const std::size_t height = picture.pixels.size() / picture.width;
    const auto off_middle = [](std::size_t place, std::size_t count) {
        return std::abs(2.0 * (static_cast<double>(place) + 0.5) / static_cast<double>(count) - 1.0);
    };
    const double farthest =
        std::max(off_middle(index % picture.width, picture.width), off_middle(index / picture.width, height));
    return 0.25 + 0.75 * smooth_step((farthest - 0.4) / 0.5);
}

/// A value with a weight: how often it counts.
struct Weighted {
    double value = 0.0;
    double weight = 1.0;
};

/// The value below which half of the weight lies. Orders the values, of which there is at least one.
[[nodiscard]] double median(std::span<Weighted> values) {
    std::ranges::sort(values, {}, &Weighted::value);
    double half = 0.0;
    for (const Weighted& one : values) half += 0.5 * one.weight;
    for (const Weighted& one : values) {
        half -= one.weight;
        if (half <= 0.0) return one.value;
    }
    return values.back().value;
}

/// The value of which `share` of the values are smaller. Orders the values, of which there is at least one.
[[nodiscard]] double quantile(std::vector<double>& values, double share) {
    const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + index, values.end());
    return values[static_cast<std::size_t>(index)];
}

constexpr std::size_t bins = 72;
constexpr double degrees_a_bin = 360.0 / bins;

/// The hue of most weight among green and blue ones, in degrees; none if there is none of these.
[[nodiscard]] std::optional<double> screen_hue(std::span<const Weighted> hues) {
    std::array<double, bins> histogram{};
    for (const Weighted& one : hues)
        histogram[static_cast<std::size_t>(one.value / degrees_a_bin) % bins] += one.weight;
    std::size_t best = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < bins; ++i) {
        // Three bins at once: a hue on the border between two of them is no less frequent.
        const double here = histogram[(i + bins - 1) % bins] + 2.0 * histogram[i] + histogram[(i + 1) % bins];
        if (here > most) {
            most = here;
            best = i;
        }
    }
    if (most == 0.0) return std::nullopt;
    return (static_cast<double>(best) + 0.5) * degrees_a_bin;
}

[[nodiscard]] bool is_green_or_blue(const Hsv& hsv) {
    constexpr double first_green = 75.0, last_blue = 270.0;
    return hsv.hue >= first_green && hsv.hue <= last_blue;
}

[[nodiscard]] bool is_candidate(const Hsv& hsv) {
    return hsv.saturation > least_saturation && hsv.value > least_value && is_green_or_blue(hsv);
}

/// What a pixel of a judged picture shows.
enum class Kind : std::uint8_t { screen, subject };

[[nodiscard]] Kind kind_of(const glm::dvec3& pixel, const glm::dvec3& screen) {
    constexpr double same_hue = 25.0;
    const Hsv here = hsv_of(pixel), wanted = hsv_of(screen);
    const bool is_alike = hue_distance(here.hue, wanted.hue) < same_hue &&
                          here.saturation > 0.7 * wanted.saturation && here.value > 0.3 * wanted.value;
    return is_alike ? Kind::screen : Kind::subject;
}

/// How many pixels of a kind lie left of and below each place, in rows of width + 1.
[[nodiscard]] std::vector<std::size_t> summed(std::span<const Kind> kinds, std::size_t width, Kind kind) {
    const std::size_t height = kinds.size() / width, row = width + 1;
    std::vector<std::size_t> sums(row * (height + 1), 0);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            sums[(y + 1) * row + x + 1] = sums[y * row + x + 1] + sums[(y + 1) * row + x] -
                                          sums[y * row + x] + (kinds[y * width + x] == kind ? 1U : 0U);
    return sums;
}

/// Whether no pixel that is summed lies at most `reach` away, along rows or columns, from a pixel.
[[nodiscard]] bool is_far(std::span<const std::size_t> sums, std::size_t width, std::size_t index,
                          std::size_t reach) {
    const std::size_t row = width + 1, height = sums.size() / row - 1, x = index % width, y = index / width;
    const std::size_t left = x - std::min(x, reach), right = std::min(x + reach + 1, width);
    const std::size_t below = y - std::min(y, reach), above = std::min(y + reach + 1, height);
    return sums[above * row + right] + sums[below * row + left] ==
           sums[above * row + left] + sums[below * row + right];
}

/// Means of the colours at most `reach` away along a line of `count` pixels, of which each stands a `step`
/// behind the one before.
void smooth_line(std::span<glm::dvec3> colors, std::size_t step, std::size_t count, std::size_t reach) {
    std::vector<glm::dvec3> sums(count + 1, glm::dvec3(0.0));
    for (std::size_t i = 0; i < count; ++i) sums[i + 1] = sums[i] + colors[i * step];
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = i - std::min(i, reach), to = std::min(i + reach + 1, count);
        colors[i * step] = (sums[to] - sums[from]) / static_cast<double>(to - from);
    }
}

/// The kind of each pixel, by the mean colour around it, which noise does not change.
[[nodiscard]] std::vector<Kind> kinds_of(const Picture& picture, const glm::dvec3& color, std::size_t reach) {
    const std::size_t height = picture.pixels.size() / picture.width;
    std::vector<glm::dvec3> smoothed(picture.pixels.begin(), picture.pixels.end());
    for (std::size_t row = 0; row < height; ++row)
        smooth_line(std::span(smoothed).subspan(row * picture.width), 1, picture.width, reach);
    for (std::size_t column = 0; column < picture.width; ++column)
        smooth_line(std::span(smoothed).subspan(column), picture.width, height, reach);
    std::vector<Kind> kinds(smoothed.size());
    for (std::size_t i = 0; i < kinds.size(); ++i)
        kinds[i] = picture.pixels[i].w < 0.5F ? Kind::subject : kind_of(smoothed[i], color);
    return kinds;
}

/// The pixels that certainly show the screen or the subject: a soft edge between them is neither.
class Inside {
  public:
    Inside(const Picture& picture, const glm::dvec3& color)
        : width_(picture.width),
          kinds_(kinds_of(picture, color, least_)),
          screens_(summed(kinds_, width_, Kind::screen)),
          subjects_(summed(kinds_, width_, Kind::subject)) {
        const std::size_t side = std::max(width_, kinds_.size() / width_);
        const std::size_t wide = std::max(least_, side / 12), narrow = std::max(least_, side / 25);
        subject_reach_ = leaves_enough(Kind::subject, wide) ? wide : narrow;
        screen_reach_ = leaves_enough(Kind::screen, wide)     ? wide
                        : leaves_enough(Kind::screen, narrow) ? narrow
                                                              : least_;
    }

    [[nodiscard]] std::size_t screen_count() const { return screens_.back(); }
    [[nodiscard]] bool is_screen(std::size_t index) const {
        return is_inside(Kind::screen, index, screen_reach_);
    }
    [[nodiscard]] bool is_subject(std::size_t index) const {
        return is_inside(Kind::subject, index, subject_reach_);
    }

  private:
    [[nodiscard]] bool is_inside(Kind kind, std::size_t index, std::size_t reach) const {
        return kinds_[index] == kind &&
               is_far(kind == Kind::screen ? subjects_ : screens_, width_, index, reach);
    }

    /// Whether an eighth of a kind's pixels lie so far from the other kind: thin things have few.
    [[nodiscard]] bool leaves_enough(Kind kind, std::size_t reach) const {
        std::size_t far = 0;
        for (std::size_t i = 0; i < kinds_.size(); ++i) far += is_inside(kind, i, reach) ? 1U : 0U;
        return 8 * far >= (kind == Kind::screen ? screens_ : subjects_).back();
    }

    static constexpr std::size_t least_ = 2;
    std::size_t width_;
    std::vector<Kind> kinds_;
    std::vector<std::size_t> screens_, subjects_;
    std::size_t subject_reach_ = least_, screen_reach_ = least_;
};

/// Numbers of all pixels of the screen.
struct ScreenNumbers {
    std::vector<double> luminances, reds, greens, mattes;
};

void judge_evenness(ScreenNumbers& found, ScreenQuality& report) {
    const double middle = quantile(found.luminances, 0.5);
    if (middle > 0.0)
        report.luminance_spread =
            (quantile(found.luminances, 0.95) - quantile(found.luminances, 0.05)) / middle;
    std::vector<double> reds = found.reds, greens = found.greens;
    const double red = quantile(reds, 0.5), green = quantile(greens, 0.5);
    std::vector<double> distances(found.reds.size());
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double r = found.reds[i] - red, g = found.greens[i] - green;
        distances[i] = std::sqrt(r * r + g * g + (r + g) * (r + g));
    }
    report.chroma_spread = quantile(distances, 0.95);
}

/// matte() of what is checked.
[[nodiscard]] double matte_of(const glm::dvec3& pixel, const glm::dvec3& screen,
                              const Difference& difference) {
    const double sum = pixel.x + pixel.y + pixel.z;
    if (std::isnan(sum)) return sum;
    const glm::length_t channel = channel_of(screen);
    const double share =
        excess(pixel, channel, difference.balance) / excess(screen, channel, difference.balance);
    return std::clamp(1.0 - difference.gain * share, 0.0, 1.0);
}

void check_balance(double balance) {
    require(balance >= 0.0 && balance <= 1.0, "balance: must be from 0 to 1");
}

void check(const Difference& difference) {
    check_balance(difference.balance);
    require(difference.gain >= 0.0 && std::isfinite(difference.gain), "gain: must be at least 0 and finite");
}

}  // namespace

void check(const Picture& picture) {
    require(picture.width > 0 && !picture.pixels.empty() && picture.pixels.size() % picture.width == 0,
            "picture: must have whole rows of pixels, and one pixel at least");
    require(std::ranges::all_of(picture.pixels, [](const glm::vec4& pixel) { return is_finite(pixel); }),
            "picture: must be finite");
}

std::optional<glm::dvec3> screen_color(const Picture& picture) {
    check(picture);
    std::vector<Weighted> hues;
    std::vector<std::size_t> places;
    double whole = 0.0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const double weight = border_weight(i, picture);
        whole += weight;
        const Hsv hsv = hsv_of(glm::dvec3(picture.pixels[i]));
        // Pixels that are already transparent do not count as screen.
        if (picture.pixels[i].w < 0.5F || !is_candidate(hsv)) continue;
        hues.push_back({hsv.hue, weight * hsv.saturation});
        places.push_back(i);
    }
    const std::optional<double> hue = screen_hue(hues);
    if (!hue) return std::nullopt;

    constexpr double same_hue = 20.0;
    std::array<std::vector<Weighted>, 3> channels;
    double found = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (hue_distance(hues[i].value, *hue) > same_hue) continue;
        found += border_weight(places[i], picture);
        for (glm::length_t channel = 0; channel < 3; ++channel)
            channels[static_cast<std::size_t>(channel)].push_back(
                {static_cast<double>(picture.pixels[places[i]][channel]), hues[i].weight});
    }
    if (found < least_share * whole) return std::nullopt;
    const glm::dvec3 color{median(channels[0]), median(channels[1]), median(channels[2])};
    constexpr double any_balance = 1.0;  // by which each green or blue can be keyed
    if (!is_screen_color(color, any_balance)) return std::nullopt;
    return color;
}

bool is_screen_color(const glm::dvec3& color, double balance) {
    constexpr double palest = 0.1, least_excess = 0.01;  // of the value
    check_balance(balance);
    if (!is_finite(color)) return false;
    const Hsv hsv = hsv_of(color);
    return hsv.saturation >= palest && is_green_or_blue(hsv) &&
           excess(color, channel_of(color), balance) >= least_excess * hsv.value;
}

double matte(const glm::dvec3& pixel, const glm::dvec3& screen, const Difference& difference) {
    check(difference);
    require(is_screen_color(screen, difference.balance), "screen: must be a green or a blue at the balance");
    return matte_of(pixel, screen, difference);
}

void mattes(std::span<const glm::vec4> pixels, const glm::dvec3& screen, const Difference& difference,
            std::span<double> out) {
    require(out.size() == pixels.size(), "out: must have a number for each pixel");
    check(difference);
    require(is_screen_color(screen, difference.balance), "screen: must be a green or a blue at the balance");
    for (std::size_t i = 0; i < pixels.size(); ++i)
        out[i] = matte_of(glm::dvec3(pixels[i]), screen, difference);
}

ScreenQuality judge_screen(const Picture& picture, const glm::dvec3& color, const Difference& difference) {
    check(picture);
    check(difference);
    require(is_screen_color(color, difference.balance), "color: must be a green or a blue at the balance");
    const glm::length_t channel = channel_of(color);
    const Inside inside(picture, color);
    ScreenNumbers screen;
    std::vector<double> subject;
    double spill = 0.0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        if (picture.pixels[i].w < 0.5F) continue;
        const glm::dvec3 pixel(picture.pixels[i]);
        if (inside.is_subject(i)) {
            subject.push_back(matte_of(pixel, color, difference));
            spill += std::max(0.0, excess(pixel, channel, 0.0));
        }
        if (!inside.is_screen(i)) continue;
        // Only positive light counts: colours beyond the gamut have parts below 0.
        const glm::dvec3 light = glm::max(pixel, glm::dvec3(0.0));
        const double sum = light.x + light.y + light.z;
        screen.luminances.push_back(luminance(pixel));
        screen.reds.push_back(sum > 0.0 ? light.x / sum : 0.0);
        screen.greens.push_back(sum > 0.0 ? light.y / sum : 0.0);
        screen.mattes.push_back(matte(pixel, color, difference));
    }

    ScreenQuality report;
    report.share = static_cast<double>(inside.screen_count()) / static_cast<double>(picture.pixels.size());
    if (!screen.mattes.empty()) {
        judge_evenness(screen, report);
        report.black = std::min(quantile(screen.mattes, 0.98), 0.9);
    }
    if (!subject.empty()) {
        if (is_screen_color(color))
            report.spill = spill / static_cast<double>(subject.size()) / excess(color, channel, 0.0);
        report.white = quantile(subject, 0.02);
    }
    report.white = std::clamp(report.white, report.black + 0.1, 1.0);
    return report;
}

}  // namespace motus::colour
