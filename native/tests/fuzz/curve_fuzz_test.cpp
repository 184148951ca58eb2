// Curves, ways along them and noise with numbers that nobody expects.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "extremes.hpp"
#include "motus/core/numeric.hpp"
#include "motus/core/sine.hpp"
#include "motus/curve/arc_length.hpp"
#include "motus/curve/bezier.hpp"
#include "motus/curve/bspline.hpp"
#include "motus/curve/nearest.hpp"
#include "motus/noise/noise.hpp"
#include "motus/path/follow.hpp"

using namespace motus;
using namespace motus::test;

namespace {

constexpr std::array all_extends{curve::Extend::clamp, curve::Extend::extrapolate, curve::Extend::loop,
                                 curve::Extend::ping_pong};

[[nodiscard]] curve::Curve plain_curve(Dice& dice) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) points.push_back(dice.in_cube(3.0));
    return curve::Curve::chain(3, points, dice.chance(0.5));
}

/// A curve of extremes, if they make one.
[[nodiscard]] std::optional<curve::Curve> any_curve(Dice& dice) {
    std::optional<curve::Curve> made;
    const int degree = dice.whole(1, 5);
    std::vector<glm::dvec3> points = dice.places(static_cast<std::size_t>(2 * (degree + 1)));
    if (dice.chance(0.2)) points[1] = points[0];
    returns([&] { made = curve::Curve::chain(degree, points, dice.chance(0.3)); });
    return made;
}

}  // namespace

TEST_CASE("vectors have a length and a direction whatever their numbers", "[fuzz]") {
    Dice dice(1, 0.6);
    for (int round = 0; round < 3000; ++round) {
        const glm::dvec3 v = dice.place();
        const auto direction = direction_of(v);
        if (direction) CHECK(length_of(*direction) == Approx(1.0));
        CHECK(direction.has_value() == (is_finite(v) && v != glm::dvec3(0.0)));
        if (is_finite(v)) CHECK(length_of(v) >= 0.0);
        const double step = smooth_step(dice.number());
        CHECK((std::isnan(step) || (step >= 0.0 && step <= 1.0)));
    }
}

TEST_CASE("sine and cosine stay within 1 for every finite angle", "[fuzz]") {
    Dice dice(2, 0.5);
    for (int round = 0; round < 3000; ++round) {
        const double angle = dice.number() * std::exp(dice.between(0.0, 60.0));
        const SineCosine<double> found = sine_cosine(angle), back = sine_cosine(-angle);
        if (!std::isfinite(angle)) {
            CHECK(std::isnan(found.sine));
            continue;
        }
        // Compared with the system's functions, which reduce by all digits
        // of pi; the rounding of the angle itself is allowed for.
        const double rounding = 1e-15 + 2e-16 * std::abs(angle);
        CHECK(std::abs(found.sine) <= 1.0 + 1e-15);
        CHECK(std::abs(back.cosine) <= 1.0 + 1e-15);
        if (rounding < 1.0) {
            CHECK(std::abs(found.sine - std::sin(angle)) <= rounding);
            CHECK(std::abs(back.cosine - std::cos(angle)) <= rounding);
        }
    }
}

TEST_CASE("a parameter that is NaN gives a position that is NaN", "[fuzz]") {
    Dice dice(3, 0.0);
    const curve::Curve plain = plain_curve(dice);
    const curve::Curve dot = curve::Curve::chain(1, std::vector<glm::dvec3>(2, glm::dvec3(1.0)), false);
    for (const curve::Curve& curve : {plain, dot}) {
        const curve::ArcLength path(curve);
        CHECK(std::isnan(position(curve, not_a_number).x));
        CHECK(std::isnan(tangent(curve, not_a_number).x));
        CHECK(std::isnan(curvature(curve, not_a_number)));
        CHECK(std::isnan(torsion(curve, not_a_number)));
        CHECK(std::isnan(path.length_at(not_a_number)));
        CHECK(std::isnan(path.t_at_length(not_a_number)));
        for (const curve::Extend extend : all_extends) {
            CHECK(std::isnan(position(curve, not_a_number, extend).x));
            CHECK((curve.degree() == 1 || std::isnan(derivative(curve, not_a_number, 1, extend).x)));
            CHECK(std::isnan(tangent(curve, not_a_number, extend).y));
            CHECK(std::isnan(position_at_length(path, not_a_number, extend).x));
            CHECK(std::isnan(t_at_length(path, not_a_number, extend).value));
        }
        for (const path::FrameMode mode : {path::FrameMode::minimal, path::FrameMode::world_up}) {
            const path::Frames frames(std::make_shared<const curve::ArcLength>(curve),
                                      path::FrameSettings{.mode = mode, .tilt = {}});
            CHECK(std::isnan(frames.pose(not_a_number, 0.0).location.x));
            CHECK(std::isnan(frames.at(not_a_number, 0.0).w));
        }
        CHECK(is_refused([&] { (void)split(curve, not_a_number); }, "t"));
        CHECK(is_refused([&] { (void)path.segment_start(curve.segment_count() + 1); }, "index"));
        CHECK(is_refused([&] { (void)transformed(curve, glm::dmat4(1e101)); }, "matrix"));
    }
}

TEST_CASE("curves of arbitrary numbers are refused or give finite results", "[fuzz]") {
    Dice dice(4, 0.25);
    for (int round = 0; round < 400; ++round) {
        const auto made = any_curve(dice);
        if (!made) continue;
        const curve::Curve& curve = *made;
        const double t = dice.number();
        const glm::dvec3 place = position(curve, t);
        CHECK((std::isnan(t) || is_finite(place)));
        for (const curve::Extend extend : all_extends) {
            const glm::dvec3 way = tangent(curve, t, extend);
            if (std::isfinite(t)) CHECK(length_of(way) == Approx(1.0));
            (void)position(curve, t, extend);
            (void)derivative(curve, t, dice.whole(1, 3), extend);
            (void)curvature(curve, t, extend);
            (void)torsion(curve, t, extend);
        }
        returns([&] { (void)split(curve, t); });
        returns([&] { (void)transformed(curve, dice.matrix()); });
        returns([&] { (void)elevated(curve, dice.whole(-1, 70)); });
        const curve::Box box = bounds(reversed(curve));
        CHECK((is_finite(box.min) && is_finite(box.max)));
        returns([&] {
            const curve::Nearest found = nearest(curve, dice.place());
            CHECK((is_finite(found.position) && std::isfinite(found.distance)));
        });
    }
    for (int round = 0; round < 200; ++round) {
        const std::vector<glm::dvec3> points = dice.places(dice.below(7));
        returns([&] { (void)curve::Curve::bezier(points); });
        returns([&] {
            (void)curve::Curve::spline(points, dice.places(points.size()), points, dice.chance(0.5));
        });
        const curve::BSplineSettings settings{dice.whole(1, 7), dice.chance(0.5), dice.chance(0.5),
                                              dice.chance(0.5)};
        returns([&] { (void)curve::bspline(points, settings); });
        returns([&] { (void)curve::bspline_knots(points.size(), settings); });
        returns([&] { (void)curve::poly_line(points, dice.chance(0.5)); });
    }
}

TEST_CASE("arc lengths and frames of arbitrary numbers are refused or finite", "[fuzz]") {
    Dice dice(5, 0.12);
    for (int round = 0; round < 60; ++round) {
        const auto made = any_curve(dice);
        if (!made) continue;
        const auto path = std::make_shared<const curve::ArcLength>(*made);
        CHECK(std::isfinite(path->length()));
        const double s = dice.number() * (dice.chance(0.5) ? path->length() : 1.0);
        if (std::isfinite(s)) {
            CHECK(std::isfinite(path->length_at(s)));
            CHECK(std::isfinite(path->t_at_length(s)));
            for (const curve::Extend extend :
                 {curve::Extend::clamp, curve::Extend::loop, curve::Extend::ping_pong})
                CHECK(is_finite(position_at_length(*path, s, extend)));
        }
        path::FrameSettings settings;
        settings.mode = static_cast<path::FrameMode>(dice.whole(0, 5));
        if (settings.mode == path::FrameMode::rail) settings.rail = path;
        settings.rail_point = static_cast<path::RailPoint>(dice.whole(0, 1));
        settings.rail_side = static_cast<path::RailSide>(dice.whole(0, 2));
        settings.gravity = dice.number(0.1, 10.0);
        settings.strength = dice.number();
        settings.limit = dice.number(0.0, 4.0);
        settings.smoothing = dice.chance(0.5) ? 0.0 : dice.number(0.0, 1.0);
        settings.tilt = dice.numbers(path->curve().segment_count() + (path->curve().cyclic() ? 0 : 1));
        const double speed = dice.number();
        returns([&] {
            const path::Frames frames(path, settings);
            const path::Pose pose = frames.pose(s, speed);
            if (std::isfinite(s) && std::isfinite(speed)) {
                CHECK(is_finite(pose.location));
                CHECK(is_finite(pose.rotation));
            }
        });
    }
    CHECK(is_refused([] { (void)path::Frames(std::shared_ptr<const curve::ArcLength>(), {}); }, "path"));
}

TEST_CASE("timings and followers of arbitrary numbers are refused or finite", "[fuzz]") {
    Dice dice(6, 0.2);
    Dice ordinary(7, 0.0);
    const auto frames =
        path::shared_frames(std::make_shared<const curve::ArcLength>(plain_curve(ordinary)),
                            path::FrameSettings{.mode = path::FrameMode::banking, .tilt = {}});
    for (int round = 0; round < 300; ++round) {
        returns([&] { (void)path::ease(dice.number(), dice.number(0.0, 0.6), dice.number(0.0, 0.6)); });
        returns([&] {
            (void)path::ease_derivative(dice.number(), dice.number(0.0, 0.6), dice.number(0.0, 0.6));
        });
        std::optional<path::Timing> timing;
        const std::size_t count = dice.below(5);
        const auto keys = dice.rising(count), values = dice.numbers(count, 0.1, 3.0);
        returns([&] {
            switch (round % 5) {
                case 0:
                    timing = path::Timing::eased(dice.number(0.1, 9.0), dice.number(), dice.number(0.0, 0.5),
                                                 dice.number(0.0, 0.5),
                                                 static_cast<path::AfterEase>(dice.whole(0, 2)));
                    break;
                case 1:
                    timing = path::Timing::constant(dice.number());
                    break;
                case 2:
                    timing = path::Timing::pins(keys, values);
                    break;
                case 3:
                    timing = path::Timing::speeds(keys, values);
                    break;
                default:
                    timing = path::Timing::speeds_by_distance(keys, values);
            }
        });
        if (!timing) continue;
        const double time = dice.number(-5.0, 20.0);
        (void)timing->distance(time);
        (void)timing->speed(time);
        std::vector<glm::dvec3> locations(3);
        std::vector<glm::dquat> rotations(3);
        const path::FollowSettings settings{.extend = all_extends.at(dice.below(4)),
                                            .line_up = dice.chance(0.3),
                                            .lag_rate = dice.chance(0.9) ? 0.0 : dice.number(0.0, 5.0),
                                            .side = dice.chance(0.5) ? 0.0 : dice.number(),
                                            .height = dice.chance(0.5) ? 0.0 : dice.number()};
        std::vector<path::Follower> followers(3);
        for (path::Follower& one : followers)
            one = {dice.number(), dice.chance(0.5) ? 0.0 : dice.number(),
                   dice.chance(0.5) ? 0.0 : dice.number(0.0, 9.0)};
        returns([&] {
            path::follow(frames, *timing, time, followers, settings, locations, rotations);
            for (const glm::dquat& rotation : rotations) CHECK(is_finite(rotation));
        });
        returns([&] { (void)path::follower_axes(dice.place(), dice.place()); });
    }
}

TEST_CASE("noise is within its bounds at every finite place, and NaN at a place that is not finite",
          "[fuzz]") {
    Dice dice(8, 0.4);
    for (int round = 0; round < 2000; ++round) {
        const glm::dvec3 place = dice.place();
        const glm::dvec2 flat(place);
        const bool is_number = !std::isnan(place.x), is_flat = is_number && !std::isnan(place.y),
                   is_place = is_flat && !std::isnan(place.z);
        const float one = noise::value(place.x, 3), two = noise::value(flat, 3),
                    three = noise::value(place, 3);
        CHECK((is_number ? std::abs(one) <= 1.0F : std::isnan(one)));
        CHECK((is_flat ? std::abs(two) <= 1.0F : std::isnan(two)));
        CHECK((is_place ? std::abs(three) <= 1.0F : std::isnan(three)));
        CHECK(std::isfinite(noise::gradient(place.x, 3)) == is_number);
        CHECK(is_finite(noise::gradient(flat, 3)) == is_flat);
        CHECK(is_finite(noise::gradient(place, 3)) == is_place);
    }
    std::vector<float> places(70);
    for (float& place : places) place = dice.single();
    std::vector<float> found(places.size());
    noise::values(std::span<const float>(places), 3, found);
    const std::vector<glm::vec3> spots = dice.single_places(70);
    noise::values(std::span<const glm::vec3>(spots), 3, found);
    std::vector<float> longer(71);
    CHECK(is_refused([&] { noise::values(std::span<const float>(places), 3, longer); }, "out"));
    CHECK(is_refused([&] { noise::values(std::span<const glm::vec3>(spots), 3, longer); }, "out"));
}

TEST_CASE("moved-from frames and timings can still be called", "[fuzz]") {
    Dice dice(9, 0.0);
    path::Frames frames(std::make_shared<const curve::ArcLength>(plain_curve(dice)), {});
    const path::Frames taken = std::move(frames);
    // NOLINTBEGIN(bugprone-use-after-move): what this is about
    CHECK(frames.at(1.0, 0.0) == taken.at(1.0, 0.0));
    CHECK(frames.station_count() == taken.station_count());
    const std::vector<double> times{0.0, 1.0, 2.0};
    for (path::Timing timing : {path::Timing::pins(times, times), path::Timing::speeds(times, times),
                                path::Timing::eased(2.0, 5.0, 0.0, 0.0)}) {
        path::Timing moved = std::move(timing);
        CHECK(moved.distance(1.0) > 0.0);
        CHECK(timing.distance(1.0) == 0.0);
        CHECK(timing.speed(1.0) == 0.0);
        timing = std::move(moved);
        CHECK(timing.distance(1.0) > 0.0);
        CHECK(moved.distance(1.0) == 0.0);
    }
    // NOLINTEND(bugprone-use-after-move)
}
