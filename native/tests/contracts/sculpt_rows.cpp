#include "contracts/meshes.hpp"
#include "contracts/row.hpp"
#include "motus/sculpt/pull.hpp"

namespace motus::contracts {

template <Some<sculpt::PullImage> T>
auto fields(Declared, T& v) {
    return std::tie(v.root, v.displacement);
}

namespace {

using sculpt::Dab;
using sculpt::Falloff;

[[nodiscard]] Dab sample_dab() {
    Dab dab;
    dab.root = {0.2F, 0.1F, 0.0F};
    dab.displacement = {0.0F, 0.1F, 0.5F};
    dab.radius = 1.5F;
    return dab;
}
[[nodiscard]] auto dab() {
    return of(
        sample_dab(), member("root", &Dab::root, finite()),
        member("displacement", &Dab::displacement, finite().open()),
        member("radius", &Dab::radius, above(0.0)), member("metric", &Dab::metric, finite()),
        member("minimum", &Dab::minimum,
               numbers("≤ `maximum`", [](double x) { return x < std::numeric_limits<double>::infinity(); })
                   .open()),
        member("maximum", &Dab::maximum,
               numbers("≥ `minimum`", [](double x) { return x > -std::numeric_limits<double>::infinity(); })
                   .open()),
        member("clamp_axis", &Dab::clamp_axis, from(0.0, 2.0)),
        member("mirror", &Dab::mirror, from(0.0, 7.0)));
}
[[nodiscard]] Domain distance() {
    return {"≥ 0, not checked, or infinity; NaN gives NaN", [](const Domain::Seen& seen) {
                if (std::isnan(seen.number())) return Verdict::nan_out;
                return seen.number() >= 0.0 ? Verdict::taken : Verdict::unbounded;
            }};
}
[[nodiscard]] auto positions() {
    return arg("positions", sample_positions(), finite().open(), as_many_as("`out`"));
}
[[nodiscard]] auto weights() {
    return arg("weights", std::vector<float>(5, 0.5F), from(0.0, 1.0), as_many_or_none("`positions`"));
}
[[nodiscard]] auto shape() {
    return arg("shape", sample_positions(),
               Domain{"finite", [](const Domain::Seen&) { return Verdict::open; }},
               as_many_or_none("`positions`"));
}

void add_falloffs(Table& table) {
    for (const Falloff falloff : {Falloff::classic, Falloff::smooth, Falloff::sphere, Falloff::root,
                                  Falloff::linear, Falloff::sharp, Falloff::constant, Falloff::gaussian})
        add(
            table, "sculpt::forces(profile, radius, distances, out)",
            [falloff](float scale, float radius, const auto& distances, auto found) {
                sculpt::forces({falloff, scale, {}}, radius, distances, found);
            },
            arg("scale_factor", 0.5F,
                falloff == Falloff::classic
                    ? finite()
                    : any_at_rest("finite, of `classic`").in_words("finite, of `classic`")),
            arg("radius", 1.5F, above(0.0)),
            arg("distances", std::vector<float>{0.0F, 0.5F, 1.0F, 3.0F}, distance(), as_many_as("`out`")),
            out<float>("out", 4, "`distances`"))
            .costs("O(n)")
            .adds(falloff == Falloff::classic ? "classic" : "the others");
    add(
        table, "sculpt::forces(profile, radius, distances, out)",
        [](const auto& curve, const auto& distances, auto found) {
            sculpt::forces({Falloff::curve, 0.0F, curve}, 1.5F, distances, found);
        },
        arg("curve", std::vector<float>{0.0F, 0.5F, 1.0F}, finite().open(), at_least_many(2)),
        arg("distances", std::vector<float>{0.0F, 0.5F, 1.0F, 3.0F}, distance(), as_many_as("`out`")),
        out<float>("out", 4, "`distances`"))
        .costs("O(n)")
        .adds("curve: 65536 samples at most");
    add(
        table, "sculpt::reach_of(profile, radius)",
        [](float radius) {
            return sculpt::reach_of({Falloff::classic, 0.0F, {}}, radius);
        },
        arg("radius", 1.5F, above(0.0)))
        .costs("O(1)");
}

}  // namespace

void add_sculpt(Table& table) {
    add_falloffs(table);
    add(
        table, "sculpt::images_of(dab)", [](const Dab& given) { return sculpt::images_of(given); },
        of(sample_dab(), member("root", &Dab::root, finite()),
           member("displacement", &Dab::displacement, finite()),
           member("mirror", &Dab::mirror, from(0.0, 7.0))))
        .costs("O(1)")
        .allocates(Memory::result);
    add(
        table, "sculpt::pull(positions, dab, weights, out, shape, copy, executor)",
        [](const auto& from, const Dab& given, const auto& by, auto found, const auto& on, auto copy) {
            sculpt::pull(from, given, by, found, on, copy, 1);
        },
        positions(), dab(), weights(), out<glm::vec3>("out", 5, "`positions`"), shape(),
        out<glm::vec3>("copy", 5, "`positions`, or none", true))
        .costs("O(n)")
        .allocates(Memory::scratch);
    const auto vertices = arg("vertices", std::vector<std::uint32_t>{0, 1, 2, 3, 4}, index(5, "a vertex"));
    add(
        table, "sculpt::pull_among(positions, dab, vertices, weights, out, shape, executor)",
        [](const auto& from, const Dab& given, const auto& some, const auto& by, auto found, const auto& on) {
            sculpt::pull_among(from, given, some, by, found, on, 1);
        },
        positions(), dab(), vertices, weights(), out<glm::vec3>("out", 5, "`positions`"), shape())
        .costs("O(vertices)")
        .allocates(Memory::scratch);
    add(
        table, "sculpt::pull_along(positions, dab, reaches, weights, out, executor)",
        [](const auto& from, const Dab& given, const auto& some, const auto& distances, const auto& by,
           auto found) {
            const std::vector<mesh::Reach> reaches{{some, distances}};
            sculpt::pull_along(from, given, reaches, by, found, 1);
        },
        positions(),
        of(sample_dab(), member("displacement", &Dab::displacement, finite().open()),
           member("radius", &Dab::radius, above(0.0))),
        arg("reach", std::vector<std::uint32_t>{0, 1, 2, 3, 4},
            numbers("rising indices of vertices", [](double x) { return x < 5.0; }).open()),
        arg("reach", std::vector<float>{0.0F, 0.5F, 0.7F, 1.0F, 1.2F},
            numbers("distances, ≥ 0", [](double x) { return x >= 0.0; }).open()),
        weights(), out<glm::vec3>("out", 5, "`positions`"))
        .costs("O(reached)")
        .allocates(Memory::scratch)
        .adds("one reach for each of images_of()");
}

}  // namespace motus::contracts
