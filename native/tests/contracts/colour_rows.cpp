#include "contracts/row.hpp"
#include "motus/colour/screen.hpp"

namespace motus::contracts {

template <Some<colour::ScreenQuality> T>
auto fields(Declared, T& v) {
    return std::tie(v.share, v.luminance_spread, v.chroma_spread, v.spill, v.black, v.white);
}

namespace {

using colour::Difference;

[[nodiscard]] std::vector<glm::vec4> sample_pixels() {
    std::vector<glm::vec4> all(48, {0.1F, 0.7F, 0.15F, 1.0F});
    for (std::size_t i = 0; i < 12; ++i) all[18 + i] = {0.6F, 0.4F, 0.3F, 1.0F};
    return all;
}
[[nodiscard]] auto pixels() {
    return arg("picture", sample_pixels(), finite().open(), {Size::Rule::exactly, 0, "rows of `width`"});
}
[[nodiscard]] auto width() {
    return arg("picture", std::size_t{8}, numbers("width ≥ 1, of which there are whole rows", [](double x) {
                                              return x == 1.0 || x == 2.0 || x == 3.0;
                                          }).open());
}
[[nodiscard]] auto difference() {
    return of(Difference{}, member("balance", &Difference::balance, from(0.0, 1.0)),
              member("gain", &Difference::gain, at_least(0.0)));
}
[[nodiscard]] Domain key() {
    return finite().open().in_words("finite, a green or a blue at the balance");
}

}  // namespace

void add_colour(Table& table) {
    add(
        table, "colour::check(picture)",
        [](const auto& given, std::size_t wide) {
            check(colour::Picture{given, wide});
        },
        pixels(), width())
        .costs("O(pixels)");
    add(
        table, "colour::screen_color(picture)",
        [](const auto& given, std::size_t wide) {
            return colour::screen_color({given, wide});
        },
        pixels(), width())
        .costs("O(pixels)")
        .allocates(Memory::scratch);
    add(
        table, "colour::is_screen_color(color, balance)",
        [](const glm::dvec3& color, double balance) { return colour::is_screen_color(color, balance); },
        arg("color", glm::dvec3(0.1, 0.7, 0.1), any_at_rest("any; false of what is not finite")),
        arg("balance", 0.0, from(0.0, 1.0)))
        .costs("O(1)");
    add(
        table, "colour::matte(pixel, screen, difference)",
        [](const glm::dvec3& pixel, const glm::dvec3& screen, const Difference& by) {
            return colour::matte(pixel, screen, by);
        },
        arg("pixel", glm::dvec3(0.2, 0.5, 0.1), any()), arg("screen", glm::dvec3(0.1, 0.7, 0.1), key()),
        difference())
        .costs("O(1)");
    add(
        table, "colour::mattes(pixels, screen, difference, out)",
        [](const auto& given, const glm::dvec3& screen, const Difference& by, auto found) {
            colour::mattes(given, screen, by, found);
        },
        arg("pixels", sample_pixels(),
            Domain{"any; NaN gives NaN",
                   [](const Domain::Seen& seen) {
                       if (std::isfinite(seen.number())) return Verdict::taken;
                       return seen.changed % 4 == 3 ? Verdict::taken : Verdict::unbounded;
                   }},
            as_many_as("`out`")),
        arg("screen", glm::dvec3(0.1, 0.7, 0.1), key()), difference(), out<double>("out", 48, "`pixels`"))
        .costs("O(pixels)");
    add(
        table, "colour::judge_screen(picture, color, difference)",
        [](const auto& given, std::size_t wide, const glm::dvec3& color, const Difference& by) {
            return colour::judge_screen({given, wide}, color, by);
        },
        pixels(), width(), arg("color", glm::dvec3(0.1, 0.7, 0.1), key()), difference())
        .costs("O(pixels)")
        .allocates(Memory::scratch);
}

}  // namespace motus::contracts
