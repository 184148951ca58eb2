#include <numbers>

#include "contracts/row.hpp"
#include "motus/stereo/around.hpp"
#include "motus/stereo/scene_depth.hpp"
#include "motus/stereo/screen.hpp"

namespace motus::contracts {

template <Some<stereo::Pair> T>
auto fields(Declared, T& v) {
    return std::tie(v.left, v.right);
}
template <Some<stereo::Range> T>
auto fields(Declared, T& v) {
    return std::tie(v.near, v.far);
}
template <Some<stereo::Limits> T>
auto fields(Declared, T& v) {
    return std::tie(v.near, v.far);
}
template <Some<stereo::Window> T>
auto fields(Declared, T& v) {
    return std::tie(v.left, v.right);
}
template <Some<stereo::Sample> T>
auto fields(Declared, T& v) {
    return std::tie(v.x, v.depth);
}
template <Some<stereo::Eyes> T>
auto fields(Declared, T& v) {
    return std::tie(v.interaxial, v.focal_length, v.sensor_width, v.convergence);
}

template <Some<stereo::EyesAround> T>
auto fields(Declared, T& v) {
    return std::tie(v.interaxial, v.convergence, v.merge_from, v.merge_to);
}

namespace {

using namespace stereo;

[[nodiscard]] Domain positive() {
    return numbers("≥ 1e-30, or infinity", [](double x) { return x >= 1e-30; });
}
[[nodiscard]] Domain length() {
    return from(1e-30, 1e30);
}
constexpr double quarter = 0.5 * std::numbers::pi;  // turn, rad
[[nodiscard]] Domain share() {
    return from(0.0, 1e30);
}
[[nodiscard]] auto eyes(ConvergenceMode mode) {
    Eyes good;
    good.mode = mode;
    return of(good, member("interaxial", &Eyes::interaxial, share().open()),
              member("focal_length", &Eyes::focal_length, length().open()),
              member("sensor_width", &Eyes::sensor_width, length().open()),
              member("convergence", &Eyes::convergence, positive().open()));
}
[[nodiscard]] auto screen() {
    return of(Screen{}, member("width", &Screen::width, length().open()),
              member("viewing_distance", &Screen::viewing_distance, length().open()),
              member("eye_separation", &Screen::eye_separation, length().open()));
}
[[nodiscard]] auto limits() {
    return of(Limits{}, member("near_parallax", &Limits::near, share().open()),
              member("far_parallax", &Limits::far, share().open()));
}

void add_eyes(Table& table) {
    add(
        table, "stereo::check(eyes)", [](const Eyes& given) { check(given); },
        eyes(ConvergenceMode::off_axis))
        .costs("O(1)");
    for (const ConvergenceMode mode :
         {ConvergenceMode::off_axis, ConvergenceMode::parallel, ConvergenceMode::toe_in}) {
        add(
            table, "stereo::parallax(eyes, depth)",
            [](const Eyes& given, double depth) { return parallax(given, depth); }, eyes(mode),
            arg("depth", 3.0, positive().open()))
            .costs("O(1)");
        add(
            table, "stereo::project(eyes, point)",
            [](const Eyes& given, const glm::dvec3& point) { return project(given, point); }, eyes(mode),
            arg("point", glm::dvec3(0.1, 0.2, 3.0),
                up_to(1e30).open().in_words("at most 1e30 in size, in front of both eyes")))
            .costs("O(1)");
        add(
            table, "stereo::vertical_parallax(eyes, depth, aspect)",
            [](const Eyes& given, double depth, double aspect) {
                return vertical_parallax(given, depth, aspect);
            },
            eyes(mode),
            arg("depth", 3.0,
                positive().open().in_words("≥ 1e-30, or infinity; for eyes that toe in the corners of the "
                                           "image lie in front of both")),
            arg("aspect", 1.78, length().open()))
            .costs("O(1)");
        add(
            table, "stereo::depths_within(eyes, limits)",
            [](const Eyes& given, const Limits& within_them) { return depths_within(given, within_them); },
            eyes(mode), limits())
            .costs("O(1)")
            .infinite()
            .adds("infinite if nothing is too far");
    }
    add(
        table, "stereo::fit_budget(lens, range, limits)",
        [](const Eyes& lens, const Range& range, const Limits& given) {
            return fit_budget(lens, range, given);
        },
        of(Eyes{}, member("focal_length", &Eyes::focal_length, length().open()),
           member("sensor_width", &Eyes::sensor_width, length().open())),
        of(Range{1.0, 9.0}, member("near", &Range::near, length().open()),
           member("far", &Range::far,
                  numbers("> near, or infinity", [](double x) { return x > 1.0; }).open())),
        limits())
        .costs("O(1)")
        .adds("the limits are not both 0");
}

void add_around(Table& table) {
    const auto eyes = [] {
        return of(
            EyesAround{0.065, 1.95, 1.0, 1.3}, member("interaxial", &EyesAround::interaxial, share().open()),
            member("convergence", &EyesAround::convergence, positive().open()),
            member("merge_from", &EyesAround::merge_from, from(0.0, 1.3).in_words("from 0 to merge_to")),
            member("merge_to", &EyesAround::merge_to,
                   from(1.0, quarter).in_words("from merge_from to pi / 2")));
    };
    const auto elevation = [] { return arg("elevation", 0.5, from(-quarter, quarter)); };
    add(
        table, "stereo::check(eyes)", [](const EyesAround& given) { check(given); }, eyes())
        .costs("O(1)");
    add(
        table, "stereo::interaxial_at(eyes, elevation)",
        [](const EyesAround& given, double at) { return interaxial_at(given, at); }, eyes(), elevation())
        .costs("O(1)");
    add(
        table, "stereo::parallax(eyes, distance, elevation)",
        [](const EyesAround& given, double distance, double at) { return parallax(given, distance, at); },
        eyes(), arg("distance", 3.0, positive().open().in_words("≥ half the interaxial, or infinity")),
        elevation())
        .costs("O(1)");
}

void add_screens(Table& table) {
    const auto parallax = [] { return arg("parallax", 0.01, no_nan().open()); };
    const auto angle = [] { return arg("angle", one_degree, within(0.0, 1.5).open()); };
    add(
        table, "stereo::check(screen)", [](const Screen& given) { check(given); }, screen())
        .costs("O(1)");
    add(
        table, "stereo::vergence(screen, parallax)",
        [](const Screen& given, double at) { return vergence(given, at); }, screen(), parallax())
        .costs("O(1)");
    add(
        table, "stereo::seen_distance(screen, parallax)",
        [](const Screen& given, double at) { return seen_distance(given, at); }, screen(), parallax())
        .costs("O(1)")
        .infinite()
        .adds("infinite if the eyes are parallel or turned apart");
    add(
        table, "stereo::divergence_limit(screen)",
        [](const Screen& given) { return divergence_limit(given); }, screen())
        .costs("O(1)");
    add(
        table, "stereo::comfortable(screen, angle)",
        [](const Screen& given, double by) { return comfortable(given, by); }, screen(), angle())
        .costs("O(1)");
    add(
        table, "stereo::comfort(screen, parallax, angle)",
        [](const Screen& given, double at, double by) { return static_cast<int>(comfort(given, at, by)); },
        screen(), parallax(), angle())
        .costs("O(1)");
    add(
        table, "stereo::roundness(screen, eyes, depth)",
        [](const Screen& given, const Eyes& by, double depth) { return roundness(given, by, depth); },
        screen(), eyes(ConvergenceMode::off_axis), arg("depth", 3.0, positive().open()))
        .costs("O(1)")
        .infinite()
        .adds("infinite if the eyes are turned apart");
}

void add_depths(Table& table) {
    add(
        table, "stereo::depth_range(depths, low, high)",
        [](const auto& depths, double low, double high) { return depth_range(depths, low, high); },
        arg("depths", std::vector{1.0, 2.0, 3.0, 9.0},
            any_at_rest("any; what is not > 0 and finite does not count")),
        arg("low", 0.1, from(0.0, 1.0).open()), arg("high", 0.9, from(0.0, 1.0).open()))
        .costs("O(n)")
        .allocates(Memory::scratch)
        .adds("`low` < `high`");
    add(
        table, "stereo::window_violations(eyes, samples, tolerance)",
        [](const Eyes& given, const auto& samples, double tolerance) {
            return window_violations(given, samples, tolerance);
        },
        eyes(ConvergenceMode::off_axis),
        arg("samples", std::vector<Sample>{{0.49, 1.0}, {-0.2, 3.0}},
            any_at_rest("any; places that are NaN, and depths not > 0, do not count").open()),
        arg("tolerance", 0.001, at_least(0.0)))
        .costs("O(n)");
    add(
        table, "stereo::smooth(values, ahead, side, out)",
        [](const auto& values, std::size_t ahead, auto found) { smooth(values, ahead, Side::below, found); },
        arg("values", std::vector{1.0, 2.0, 3.0, 2.0}, up_to(1e300), as_many_as("`out`")),
        arg("ahead", std::size_t{2}, from(0.0, 10000.0)), out<double>("out", 4, "`values`"))
        .costs("O(n ahead)")
        .allocates(Memory::scratch);
}

}  // namespace

void add_stereo(Table& table) {
    add_eyes(table);
    add_around(table);
    add_screens(table);
    add_depths(table);
}

}  // namespace motus::contracts
