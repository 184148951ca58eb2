#include "contracts/meshes.hpp"
#include "contracts/row.hpp"
#include "motus/lattice/lattice.hpp"

namespace motus::contracts {

template <Some<lattice::Weights> T>
auto fields(Declared, T& v) {
    return std::tie(v.points, v.weights);
}
template <Some<lattice::OrientedBox> T>
auto fields(Declared, T& v) {
    return std::tie(v.center, v.axes, v.size);
}

namespace {

using lattice::Lattice;

[[nodiscard]] Lattice sample_lattice() {
    Lattice made;
    made.axes = glm::dmat3(3.0);
    made.resolution = {2, 3, 2};
    return made;
}
[[nodiscard]] Domain orthonormal() {
    return {"orthonormal", [](const Domain::Seen& seen) {
                double square = 0.0;
                for (std::size_t i = 0; i < 3; ++i)
                    square += std::pow(seen.all[seen.changed / 3 * 3 + i], 2.0);
                const double off = std::abs(square - 1.0);
                return off < 5e-4 ? Verdict::taken : off < 2e-3 ? Verdict::open : Verdict::refused;
            }};
}
[[nodiscard]] auto grid() {
    return of(
        sample_lattice(), member("origin", &Lattice::origin, up_to(1e100).open()),
        member("axes", &Lattice::axes, up_to(1e100).open().in_words("at most 1e100 in size, independent")),
        member("resolution", &Lattice::resolution, from(1.0, 64.0).open().tested_to(64.0)));
}
[[nodiscard]] auto grid_alone() {
    return of(
        sample_lattice(), member("origin", &Lattice::origin, up_to(1e100).open()),
        member("axes", &Lattice::axes, up_to(1e100).open().in_words("at most 1e100 in size, independent")),
        member("resolution", &Lattice::resolution, from(1.0, 64.0)));
}

}  // namespace

void add_lattice(Table& table) {
    add(
        table, "lattice::point_count(lattice)", [](const Lattice& given) { return point_count(given); },
        of(sample_lattice(), member("resolution", &Lattice::resolution, from(1.0, 64.0))))
        .costs("O(1)");
    add(
        table, "lattice::rest_points(lattice)", [](const Lattice& given) { return rest_points(given); },
        grid_alone())
        .costs("O(points)")
        .allocates(Memory::result);
    add(
        table, "lattice::weights_at(lattice, place)",
        [](const Lattice& given, const glm::dvec3& place) { return weights_at(given, place); }, grid_alone(),
        arg("place", glm::dvec3(0.5, 1.0, 2.0), finite()))
        .costs("O(taps)")
        .allocates(Memory::result);
    const Domain passed = any_passed_on();
    add(
        table, "lattice::deform(lattice, displacements, influence, positions, out, executor)",
        [](const Lattice& given, const auto& moved, const auto& factors, const auto& weights,
           const auto& positions, auto found) {
            deform(given, moved, {factors, weights}, positions, found, 1);
        },
        grid(),
        arg("displacements", std::vector<glm::vec3>(12, glm::vec3(0.1F)),
            passed.in_words("any; NaN gives NaN"), as_many_as("the points")),
        arg("influence", std::vector<float>(5, 0.5F), passed, as_many_or_none("`positions`")),
        arg("influence", std::vector<float>(12, 0.5F), passed, as_many_or_none("the points")),
        arg("positions", sample_positions(), passed, as_many_as("`out`")),
        out<glm::vec3>("out", 5, "`positions`"))
        .costs("O(n taps)")
        .allocates(Memory::scratch);
    add(
        table, "lattice::pull_lattice(lattice, parts, displacements, options, out)",
        [](const Lattice& given, const glm::dvec3& place, double share, double influence, std::size_t pull,
           const auto& displacements, double gain, const auto& weights, auto found) {
            const std::vector<lattice::Part> parts{{pull, place, share, influence},
                                                   {1, {2.0, 1.0, 0.5}, 1.0, 1.0}};
            return pull_lattice(given, parts, displacements, {gain, false, weights}, found);
        },
        grid(), arg("place", glm::dvec3(0.5, 1.0, 2.0), finite().open()),
        arg("parts", 1.0, up_to(1e30).in_words("share, at most 1e30 in size").open()),
        arg("parts", 1.0, up_to(1e30).in_words("influence, at most 1e30 in size").open()),
        arg("parts", std::size_t{0}, index(2, "a pull")),
        arg("displacements", std::vector<glm::dvec3>(2, glm::dvec3(0.1)), up_to(1e100).open()),
        arg("max_gain", 32.0, above(0.0).open()),
        arg("point_weights", std::vector<float>(12, 1.0F), finite().open(), as_many_or_none("the points")),
        out<glm::dvec3>("out", 12, "the points"))
        .costs("O(m³), m the smaller of the numbers of pulls and of points that they move")
        .allocates(Memory::scratch)
        .adds("1000 pulls at most, if they move as many points");
    const auto axes = arg("axes", glm::dmat3(1.0), orthonormal());
    add(
        table, "lattice::box_along(points, axes)",
        [](const auto& points, const auto& given) { return lattice::box_along(points, given); },
        arg("points", sample_positions(), finite()), axes)
        .costs("O(n)");
    add(
        table, "lattice::small_box(points, axes, executor)",
        [](const auto& points, const auto& given) { return lattice::small_box(points, given, 1); },
        arg("points", sample_positions(), finite()), axes)
        .costs("O(n), some 100 passes")
        .allocates(Memory::scratch);
}

}  // namespace motus::contracts
