#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/curve/bspline.hpp"
#include "motus/curve/nearest.hpp"

namespace motus::contracts {

template <Some<curve::Jet> T>
auto fields(Declared, T& v) {
    return std::tie(v.position, v.d1, v.d2, v.d3);
}
template <Some<curve::Location> T>
auto fields(Declared, T& v) {
    return std::tie(v.segment, v.t);
}
template <Some<curve::Extended> T>
auto fields(Declared, T& v) {
    return std::tie(v.value, v.beyond, v.laps);
}
template <Some<curve::Box> T>
auto fields(Declared, T& v) {
    return std::tie(v.min, v.max);
}
template <Some<curve::Nearest> T>
auto fields(Declared, T& v) {
    return std::tie(v.t, v.position, v.distance);
}

namespace {

using curve::Curve;
using curve::Extend;

[[nodiscard]] Domain coordinates() {
    return up_to(curve::coordinate_limit);
}

/// Calls a function for every choice of what lies beyond the ends.
template <class Call>
[[nodiscard]] auto for_every_extend(const Call& call) {
    return std::tuple(call(Extend::clamp), call(Extend::extrapolate), call(Extend::loop),
                      call(Extend::ping_pong));
}

void add_curves(Table& table) {
    add(
        table, "curve::Curve::bezier(control_points)",
        [](const auto& points) { return points_of(Curve::bezier(points)); },
        arg("control_points", sample_points(), coordinates(), at_least_many(2)))
        .costs("O(n)")
        .allocates(Memory::result)
        .adds("65 points at most");
    add(
        table, "curve::Curve::spline(points, handles_left, handles_right, cyclic)",
        [](const auto& points, const auto& left, const auto& right) {
            return points_of(Curve::spline(points, left, right, true));
        },
        arg("points", sample_points(), coordinates(), at_least_many(2)),
        arg("handles_left", sample_points(), coordinates(), as_many_as("`points`")),
        arg("handles_right", sample_points(), coordinates(), as_many_as("`points`")))
        .costs("O(n)")
        .allocates(Memory::result);
    add(
        table, "curve::Curve::chain(degree, control_points, cyclic)",
        [](int degree, const auto& points) { return points_of(Curve::chain(degree, points, false)); },
        arg("degree", 3, from(1, curve::max_degree).open()),
        arg("control_points", sample_points(), coordinates(),
            {Size::Rule::exactly, 0, "segments times degree + 1"}))
        .costs("O(n)")
        .allocates(Memory::result);
    add(table, "curve::Curve::segment(index)", [] { return sample_curve().segment(1).size(); })
        .costs("O(1)")
        .adds("`index` is not checked");
    add(
        table, "curve::jet(curve, at)",
        [](double t) {
            return jet(sample_curve(), curve::Location{1, t});
        },
        arg("at", 0.3, any().in_words("0 to 1, not checked; NaN gives NaN").unbounded()))
        .costs("O(degree)")
        .adds("its segment is not checked");
    add(
        table, "curve::locate(curve, t)", [](double t) { return locate(sample_curve(), t); },
        arg("t", 0.3, any()))
        .costs("O(1)");
    add(
        table, "curve::position(curve, t)", [](double t) { return position(sample_curve(), t); },
        arg("t", 0.3, any()))
        .costs("O(degree)");
    add(
        table, "curve::position(curve, t, extend)",
        [](double t) {
            return for_every_extend([&](Extend extend) { return position(sample_curve(), t, extend); });
        },
        arg("t", 0.3, any().unbounded()))
        .costs("O(degree)")
        .adds("extrapolated it may be infinite");
    add(
        table, "curve::derivative(curve, t, order)",
        [](double t, int order) { return derivative(sample_curve(), t, order); }, arg("t", 0.3, any()),
        arg("order", 1, from(1, 3)))
        .costs("O(degree)");
    add(
        table, "curve::derivative(curve, t, order, extend)",
        [](double t, int order) {
            return for_every_extend(
                [&](Extend extend) { return derivative(sample_curve(), t, order, extend); });
        },
        arg("t", 0.3, any()), arg("order", 2, from(1, 3)))
        .costs("O(degree)");
    add(
        table, "curve::jet(curve, t)", [](double t) { return jet(sample_curve(), t); }, arg("t", 0.3, any()))
        .costs("O(degree)");
    add(
        table, "curve::tangent(curve, t)", [](double t) { return tangent(sample_curve(), t); },
        arg("t", 0.3, any()))
        .costs("O(degree)");
    add(
        table, "curve::tangent(curve, t, extend)",
        [](double t) {
            return for_every_extend([&](Extend extend) { return tangent(sample_curve(), t, extend); });
        },
        arg("t", 0.3, any()))
        .costs("O(degree)");
    add(
        table, "curve::curvature(curve, t)", [](double t) { return curvature(sample_curve(), t); },
        arg("t", 0.3, any()))
        .costs("O(degree)")
        .adds("infinite at a cusp");
    add(
        table, "curve::curvature(curve, t, extend)",
        [](double t) {
            return for_every_extend([&](Extend extend) { return curvature(sample_curve(), t, extend); });
        },
        arg("t", 0.3, any()))
        .costs("O(degree)")
        .adds("infinite at a cusp");
    add(
        table, "curve::torsion(curve, t)", [](double t) { return torsion(sample_curve(), t); },
        arg("t", 0.3, any()))
        .costs("O(degree)");
    add(
        table, "curve::torsion(curve, t, extend)",
        [](double t) {
            return for_every_extend([&](Extend extend) { return torsion(sample_curve(), t, extend); });
        },
        arg("t", 0.3, any()))
        .costs("O(degree)");
    add(
        table, "curve::extended(value, limit, extend)",
        [](double value, double limit) {
            return for_every_extend([&](Extend extend) { return curve::extended(value, limit, extend); });
        },
        arg("value", 0.3, any()), arg("limit", 2.0, any_passed_on().in_words("≥ 0, not checked")))
        .costs("O(1)")
        .infinite();
}

void add_operations(Table& table) {
    add(
        table, "curve::split(curve, t)",
        [](double t) {
            const auto parts = split(sample_curve(), t);
            return std::pair(points_of(parts.first), points_of(parts.second));
        },
        arg("t", 0.3, no_nan()))
        .costs("O(n + degree²)")
        .allocates(Memory::result);
    add(
        table, "curve::elevated(curve, times)",
        [](int times) { return points_of(elevated(sample_curve(), times)); },
        arg("times", 1,
            from(0, curve::max_degree - 3).in_words("≥ 0, of which the degree becomes 64 at most")))
        .costs("O(times n)")
        .allocates(Memory::scratch);
    add(table, "curve::reversed(curve)", [] { return points_of(reversed(sample_curve())); })
        .costs("O(n)")
        .allocates(Memory::result);
    add(
        table, "curve::transformed(curve, matrix)",
        [](const glm::dmat4& matrix) { return points_of(transformed(sample_curve(), matrix)); },
        arg("matrix", glm::dmat4(1.0),
            finite().open().in_words("affine, by which points stay finite and up to 1e100")))
        .costs("O(n)")
        .allocates(Memory::result);
    add(table, "curve::bounds(curve)", [] { return bounds(sample_curve()); })
        .costs("O(n degree²)")
        .allocates(Memory::scratch);
    add(
        table, "curve::nearest(curve, point)",
        [](const glm::dvec3& point) { return nearest(sample_curve(), point); },
        arg("point", glm::dvec3(1.0, 2.0, 3.0), coordinates()))
        .costs("O(n), some hundred parts a segment at most")
        .allocates(Memory::scratch);
    const auto settings =
        of(curve::BSplineSettings{}, member("order", &curve::BSplineSettings::order, from(2, 6)));
    add(
        table, "curve::bspline_knots(point_count, settings)",
        [](std::size_t count, const auto& given) { return curve::bspline_knots(count, given); },
        arg("point_count", std::size_t{8}, numbers("≥ 1", [](double x) { return x >= 1.0; }).tested_to(1e6)),
        settings)
        .costs("O(n)")
        .allocates(Memory::result);
    add(
        table, "curve::bspline(points, settings)",
        [](const auto& points, const auto& given) { return points_of(curve::bspline(points, given)); },
        arg("points", sample_points(), coordinates(), at_least_many(2)), settings)
        .costs("O(n order²)")
        .allocates(Memory::scratch);
    add(
        table, "curve::poly_line(points, cyclic)",
        [](const auto& points) { return points_of(curve::poly_line(points, true)); },
        arg("points", sample_points(), coordinates(), at_least_many(2)))
        .costs("O(n)")
        .allocates(Memory::scratch);
}

void add_lengths(Table& table) {
    add(table, "curve::ArcLength::ArcLength(curve)", [] { return curve::ArcLength(sample_curve()).length(); })
        .costs("O(n degree²), adaptive")
        .allocates(Memory::scratch);
    add(table, "curve::shared_arc_length(curve)", [] { return shared_arc_length(sample_curve())->length(); })
        .costs("O(n) from the cache, else as the constructor")
        .allocates(Memory::scratch);
    add(
        table, "curve::ArcLength::length_at(t)", [](double t) { return sample_path()->length_at(t); },
        arg("t", 0.3, any()))
        .costs("O(log n)");
    add(
        table, "curve::ArcLength::t_at_length(s)", [](double s) { return sample_path()->t_at_length(s); },
        arg("s", 0.3, any()))
        .costs("O(1)")
        .adds("the first call builds the inverse table");
    add(
        table, "curve::ArcLength::segment_start(index)",
        [](std::size_t index) { return sample_path()->segment_start(index); },
        arg("index", std::size_t{1}, index(3, "a segment, or their number")))
        .costs("O(1)");
    add(
        table, "curve::length_at(path, t, extend)",
        [](double t) {
            return for_every_extend([&](Extend extend) { return length_at(*sample_path(), t, extend); });
        },
        arg("t", 0.3, any().unbounded()))
        .costs("O(log n)")
        .adds("extrapolated it may be infinite");
    add(
        table, "curve::t_at_length(path, s, extend)",
        [](double s) {
            return for_every_extend([&](Extend extend) { return t_at_length(*sample_path(), s, extend); });
        },
        arg("s", 0.3, any()))
        .costs("O(1)");
    add(
        table, "curve::position_at_length(path, s, extend)",
        [](double s) {
            return for_every_extend(
                [&](Extend extend) { return position_at_length(*sample_path(), s, extend); });
        },
        arg("s", 0.3, any().unbounded()))
        .costs("O(degree)")
        .adds("extrapolated it may be infinite");
    add(
        table, "curve::positions_at_length(path, s, extend, out)",
        [](const auto& s, auto found) { positions_at_length(*sample_path(), s, Extend::loop, found); },
        arg("s", std::vector<double>{0.1, 0.2, 3.0, 7.0}, any(), as_many_as("`out`")),
        out<glm::dvec3>("out", 4, "`s`"))
        .costs("O(degree) a distance");
}

}  // namespace

void add_curve(Table& table) {
    add_curves(table);
    add_operations(table);
    add_lengths(table);
    table.moved.push_back({"curve::Curve", "the curve that it was", [] {
                               Curve curve = sample_curve();
                               const Curve taken = std::move(curve);
                               expect(curve == taken,
                                      "is the same curve");  // NOLINT(bugprone-use-after-move)
                               curve = reversed(taken);
                               expect(curve.segment_count() == 2, "is assigned");
                           }});
}

}  // namespace motus::contracts
