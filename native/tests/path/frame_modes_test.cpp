// Known answers, mode by mode.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "curve/samples.hpp"
#include "frame_checks.hpp"
#include "motus/path/frames.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::path;
using namespace motus::path::checks;
using std::numbers::pi;

TEST_CASE("frames of mode world_up have a level side axis", "[frames]") {
    const samples::Path path = samples::helix(4.0, 3.0, 2.0);
    const Frames frames(path, mode(FrameMode::world_up));
    for (int i = 0; i <= 50; ++i) {
        const glm::dquat q = frames.at(path->length() * i / 50.0, 0.0);
        CHECK(std::abs((q * glm::dvec3(1, 0, 0)).z) < 1e-12);
        CHECK(up(q).z > 0.0);
    }
}

TEST_CASE("frames of mode world_up are defined on straight and vertical lines", "[frames]") {
    const Frames level(samples::straight({0, 0, 0}, {0, 5, 0}), mode(FrameMode::world_up));
    CHECK(angle_between(level.at(2.0, 0.0), glm::dquat(1, 0, 0, 0)) < 1e-12);

    for (const double direction : {1.0, -1.0}) {
        for (const FrameMode which :
             {FrameMode::world_up, FrameMode::minimal, FrameMode::banking, FrameMode::curvature}) {
            const Frames vertical(samples::straight({1, 1, 0}, {1, 1, direction * 5.0}), mode(which));
            const glm::dquat q = vertical.at(0.0, speed);
            CHECK(forward(q).z == Approx(direction));
            CHECK(up(q).y == Approx(-direction));  // pitched up or down from +Y
            CHECK(angle_between(q, vertical.at(4.0, speed)) < 1e-12);
        }
    }
}

TEST_CASE("frames of mode world_up stay upright through a vertical loop and never snap", "[frames]") {
    const samples::Path path = samples::vertical_loop(10.0);
    const Frames frames(path, mode(FrameMode::world_up));
    CHECK(up(frames.at(0.0, 0.0)).z == Approx(1.0));
    CHECK(up(frames.at(0.5 * path->length(), 0.0)).z == Approx(1.0));
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) {
        const double turned = angle_between(frames.at(path->length() * i / steps, 0.0),
                                            frames.at(path->length() * (i + 1) / steps, 0.0));
        REQUIRE(turned < 0.04);
    }
}

TEST_CASE("minimal frames turn against the Frenet frame by the integral of the torsion", "[frames]") {
    const double radius = 2.0;
    const double rise = 3.0;  // per turn
    const samples::Path path = samples::helix(radius, rise, 2.0);
    const double pitch = rise / (2.0 * pi);
    const double torsion = pitch / (radius * radius + pitch * pitch);
    const Frames frames(path, mode(FrameMode::minimal));
    const auto normal_angle = [&](double s) {
        const glm::dquat q = frames.at(s, 0.0);
        const double a = s / std::hypot(radius, pitch);
        const glm::dvec3 inward(-std::cos(a), -std::sin(a), 0.0);
        return std::atan2(glm::dot(inward, glm::cross(forward(q), up(q))), glm::dot(inward, up(q)));
    };
    for (int i = 1; i <= 20; ++i) {
        const double s = path->length() * i / 20.0;
        CHECK(std::remainder(normal_angle(s) - normal_angle(0.0) - torsion * s, 2.0 * pi) ==
              Approx(0.0).margin(1e-5));
    }
}

TEST_CASE("minimal frames close on a trefoil and spin no more than they must", "[frames]") {
    const samples::Path path = samples::trefoil();
    const Frames frames(path, mode(FrameMode::minimal));
    CHECK(angle_between(frames.at(0.0, 0.0), frames.at(path->length(), 0.0)) < 1e-9);
    // About the tangent they turn at one rate all the way.
    double least = 1e9;
    double most = -1e9;
    for (int i = 0; i < 200; ++i) {
        const double h = 1e-3;
        const double s = (path->length() - h) * i / 200.0;
        const glm::dquat a = frames.at(s, 0.0);
        const glm::dquat b = frames.at(s + h, 0.0);
        const glm::dquat d = b * glm::conjugate(a);
        const double spin =
            2.0 * glm::dot(glm::dvec3(d.x, d.y, d.z) * (d.w < 0.0 ? -1.0 : 1.0), forward(a)) / h;
        least = std::min(least, spin);
        most = std::max(most, spin);
    }
    CHECK(most - least < 1e-3);
    CHECK(std::abs(least) * path->length() <= pi + 1e-3);
}

TEST_CASE("a corner turns the frame by the least rotation", "[frames]") {
    const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 2, 0}, {0, 2, 0}, {2, 2, 2}};
    const samples::Path path = samples::path(Curve::chain(1, points, false));
    const Frames frames(path, mode(FrameMode::minimal));
    const glm::dquat before = frames.at(1.999, 0.0);
    const glm::dquat behind = frames.at(2.0, 0.0);
    CHECK(angle_between(before, behind) ==
          Approx(angle_between(forward(before), forward(behind))).margin(1e-9));
}

TEST_CASE("a reversal turns the frame about up", "[frames]") {
    const std::vector<glm::dvec3> back{{0, 0, 0}, {0, 3, 1}, {0, 3, 1}, {0, 1, 1.0 / 3.0}};
    const std::vector<glm::dvec3> cusp{{0, 0, 0}, {6, 6, 0}, {0, 6, 0}, {6, 0, 0}};
    for (const samples::Path& path :
         {samples::path(Curve::chain(1, back, false)), samples::path(Curve::bezier(cusp))}) {
        const Frames frames(path, mode(FrameMode::minimal));
        const glm::dvec3 first = up(frames.at(0.0, 0.0));
        for (int i = 0; i <= 40; ++i) {
            const glm::dvec3 now = up(frames.at(path->length() * i / 40.0, 0.0));
            CHECK(glm::length(now - first) < 1e-6);
        }
    }
}

TEST_CASE("banking on a circle is the angle of a coordinated turn", "[frames]") {
    const Frames frames(samples::level_circle(20.0), mode(FrameMode::banking));
    const double expected = std::atan(10.0 * 10.0 / (20.0 * 9.81));
    CHECK(expected * 180.0 / pi == Approx(27.0).margin(0.02));
    for (int i = 0; i < 10; ++i) {
        const double s = 12.0 * i;
        const glm::dquat q = frames.at(s, 10.0);
        CHECK(std::acos(up(q).z) == Approx(expected).epsilon(1e-5));
        const double a = s / 20.0;
        CHECK(glm::dot(up(q), glm::dvec3(-std::cos(a), -std::sin(a), 0.0)) > 0.0);
        CHECK(up(frames.at(s, 0.0)).z == Approx(1.0));
    }
    FrameSettings limited = mode(FrameMode::banking);
    limited.limit = 0.3;
    CHECK(std::acos(up(Frames(samples::level_circle(20.0), limited).at(3.0, 10.0)).z) < 0.3);
    limited.limit = 0.0;
    CHECK(up(Frames(samples::level_circle(20.0), limited).at(3.0, 10.0)).z == Approx(1.0));
    limited.limit = 1.0;
    CHECK(std::acos(up(Frames(samples::level_circle(20.0), limited).at(3.0, 10.0)).z) ==
          Approx(expected).epsilon(1e-5));
}

TEST_CASE("banking agrees with its definition on any smooth curve", "[frames]") {
    motus::test::Random random(5);
    const double v = 12.0;
    for (int round = 0; round < 20; ++round) {
        const samples::Path path = samples::random_bezier(random, 4);
        FrameSettings settings = mode(FrameMode::banking);
        settings.strength = 0.8;
        const Frames frames(path, settings);
        for (int i = 0; i <= 20; ++i) {
            const double s = path->length() * i / 20.0;
            const Jet at = jet(path->curve(), path->t_at_length(s));
            const glm::dvec3 t = glm::normalize(at.d1);
            const glm::dvec3 bend = (at.d2 - glm::dot(at.d2, t) * t) / glm::dot(at.d1, at.d1);
            glm::dvec3 apparent = 9.81 * z + 0.8 * v * v * bend;
            apparent -= glm::dot(apparent, t) * t;
            if (glm::length(apparent) < 0.1 * 9.81) continue;
            CHECK(glm::length(up(frames.at(s, v)) - glm::normalize(apparent)) < 1e-6);
        }
    }
}

TEST_CASE("a fast loop is flown upside down through its top", "[frames]") {
    const samples::Path path = samples::vertical_loop(10.0);
    const Frames banking(path, mode(FrameMode::banking));
    const Frames bend(path, mode(FrameMode::curvature));
    const double fast = std::sqrt(1.5 * 9.81 * 10.0);
    for (int i = 0; i <= 100; ++i) {
        const double s = path->length() * i / 100.0;
        const double a = s / 10.0;
        const glm::dvec3 inward(-std::sin(a), 0.0, std::cos(a));
        CHECK(glm::length(up(banking.at(s, fast)) - inward) < 1e-3);
        CHECK(glm::length(up(bend.at(s, fast)) - inward) < 1e-3);
    }
}

TEST_CASE("curvature points inward or outward, and keeps its side through an inflexion", "[frames]") {
    FrameSettings settings = mode(FrameMode::curvature);
    CHECK(up(Frames(samples::level_circle(3.0), settings).at(0.0, 0.0)).x == Approx(-1.0));
    settings.outward = true;
    CHECK(up(Frames(samples::level_circle(3.0), settings).at(0.0, 0.0)).x == Approx(1.0));

    // Bends left, then right: up stays on the left.
    const samples::Path path = samples::s_curve();
    const Frames frames(path, mode(FrameMode::curvature));
    const glm::dvec3 first = jet(path->curve(), 0.01).d2;
    for (int i = 0; i <= 100; ++i) {
        const glm::dquat q = frames.at(path->length() * i / 100.0, 0.0);
        const glm::dvec3 left = glm::cross(z, forward(q));
        const double side = glm::dot(glm::cross(jet(path->curve(), 0.0).d1, first), z) > 0.0 ? 1.0 : -1.0;
        CHECK(glm::length(up(q) - side * left) < 1e-9);
    }
}

TEST_CASE("frames of mode curvature agree with their definition on a curve that bends everywhere",
          "[frames]") {
    const samples::Path path = samples::helix(2.0, 4.0, 2.0);
    const Frames frames(path, mode(FrameMode::curvature));
    for (int i = 0; i <= 40; ++i) {
        const double s = path->length() * i / 40.0;
        const double a = 2.0 * pi * 2.0 * i / 40.0;
        CHECK(glm::length(up(frames.at(s, 0.0)) - glm::dvec3(-std::cos(a), -std::sin(a), 0.0)) < 2e-3);
    }
}

TEST_CASE("smoothing leaves a circle's curvature as it is and evens out corners", "[frames]") {
    FrameSettings settings = mode(FrameMode::banking);
    settings.smoothing = 4.0;
    const Frames circle(samples::level_circle(20.0), settings);
    CHECK(std::acos(up(circle.at(30.0, 10.0)).z) == Approx(std::atan(100.0 / (20.0 * 9.81))).epsilon(1e-3));

    // A square ridden round and round: its corners alone bend, and the mean curvature is a circle's.
    const std::vector<glm::dvec3> square{{0, 0, 0}, {9, 0, 0}, {9, 0, 0}, {9, 9, 0},
                                         {9, 9, 0}, {0, 9, 0}, {0, 9, 0}, {0, 0, 0}};
    settings.smoothing = 100.0;
    const Frames even(samples::path(Curve::chain(1, square, true)), settings);
    const double curvature = 2.0 * pi / 36.0;
    for (const double s : {1.0, 4.5, 20.0, 35.0}) {
        CHECK(std::acos(up(even.at(s, 5.0)).z) == Approx(std::atan(25.0 * curvature / 9.81)).epsilon(1e-2));
    }
}

TEST_CASE("smoothing has no lag", "[frames]") {
    FrameSettings settings = mode(FrameMode::banking);
    settings.smoothing = 1.5;
    const samples::Path path = samples::s_curve();
    const Frames frames(path, settings);
    const double length = path->length();
    for (int i = 0; i <= 20; ++i) {
        const glm::dquat a = frames.at(length * i / 20.0, speed);
        const glm::dquat b = frames.at(length * (20 - i) / 20.0, speed);
        CHECK((a * glm::dvec3(1, 0, 0)).z == Approx(-(b * glm::dvec3(1, 0, 0)).z).margin(1e-6));
    }
}

TEST_CASE("tilt rolls the world-up frame, linearly in t, right-handed about the tangent", "[frames]") {
    const samples::Path path = samples::helix(4.0, 3.0, 1.0);
    FrameSettings settings = mode(FrameMode::tilt);
    for (std::size_t i = 0; i <= path->curve().segment_count(); ++i)
        settings.tilt.push_back(i % 2 == 0 ? 0.2 : 0.8);
    const Frames tilted(path, settings);
    const Frames level(path, mode(FrameMode::world_up));
    const double s = path->length_at(3.25);
    const glm::dquat expected = glm::angleAxis(0.65, tangent(path->curve(), 3.25)) * level.at(s, 0.0);
    CHECK(angle_between(tilted.at(s, 0.0), expected) < 1e-9);

    settings.tilt.pop_back();
    CHECK_THROWS_AS(Frames(path, settings), std::invalid_argument);
}

TEST_CASE("a filter much wider than the path gives the mean of its bend", "[frames]") {
    const double radius = 5.0;
    const samples::Path path = samples::level_circle(radius);
    FrameSettings settings = mode(FrameMode::banking);
    for (const double smoothing : {1e3, 1e7, 1e12, 1e20, 1e308}) {
        CAPTURE(smoothing);
        settings.smoothing = smoothing;
        const Frames frames(path, settings);
        for (const double s : {0.0, 3.0, 20.0}) {
            const double roll = angle_between(up(frames.at(s, speed)), z);
            CHECK(std::tan(roll) == Approx(speed * speed / radius / settings.gravity).epsilon(1e-5));
        }
    }
}

TEST_CASE("a filter of next to no width changes nothing", "[frames]") {
    const samples::Path path = samples::level_circle(5.0);
    FrameSettings settings = mode(FrameMode::banking);
    const Frames plain(path, settings);
    for (const double smoothing : {1e-9, 1e-100, 5e-324}) {
        settings.smoothing = smoothing;
        const Frames frames(path, settings);
        for (const double s : {0.0, 3.0, 20.0})
            CHECK(angle_between(frames.at(s, speed), plain.at(s, speed)) < 1e-3);
    }
}

TEST_CASE("banking at any speed keeps its direction", "[frames]") {
    FrameSettings settings = mode(FrameMode::banking);
    for (const double gravity : {9.81, 5e-324, 1e300}) {
        settings.gravity = gravity;
        const Frames frames(samples::level_circle(5.0), settings);
        for (const double fast : {0.0, 1e20, 1e160, 1e308}) {
            CAPTURE(gravity, fast);
            const glm::dquat q = frames.at(1.0, fast);
            CHECK(glm::length(q) == Approx(1.0));
            CHECK(angle_between(q, frames.at(1.0, -fast)) == 0.0);
        }
    }
}

TEST_CASE("up points to a rail, above, to the right or to the left", "[frames]") {
    constexpr double radius = 10.0;
    // A second circle, wider by 2 and higher by 1, and one that is not round.
    const samples::Path path = samples::level_circle(radius);
    const samples::Path rail = samples::sampled(
        [](double u) {
            const double a = samples::turn * u;
            return glm::dvec3((radius + 2.0) * std::cos(a), (radius + 2.0) * std::sin(a), 1.0);
        },
        64, true);
    const glm::dvec2 slope = glm::normalize(glm::dvec2(2.0, 1.0));
    for (const RailPoint point : {RailPoint::share, RailPoint::nearest}) {
        for (const RailSide side : {RailSide::above, RailSide::right, RailSide::left}) {
            FrameSettings settings = mode(FrameMode::rail);
            settings.rail = rail;
            settings.rail_point = point;
            settings.rail_side = side;
            const Frames frames(path, settings);
            for (const double angle : {0.0, 1.0, 3.0, 6.0}) {
                const glm::dquat q = frames.at(angle * radius, 0.0);
                const glm::dvec3 out(std::cos(angle), std::sin(angle), 0.0);
                const glm::dvec3 towards = slope.x * out + slope.y * z;
                const glm::dvec3 shown = side == RailSide::above   ? up(q)
                                         : side == RailSide::right ? q * glm::dvec3(1, 0, 0)
                                                                   : q * glm::dvec3(-1, 0, 0);
                CHECK(glm::length(shown - towards) < 1e-5);
            }
        }
    }
}

TEST_CASE("a rail that crosses the path, or is the path, turns nothing by a jump", "[frames]") {
    const samples::Path path = samples::straight({0, 0, 0}, {0, 10, 0});
    const samples::Path crossing = samples::straight({1, 0, 0}, {-1, 10, 0.0});
    for (const samples::Path& rail : {path, crossing}) {
        FrameSettings settings = mode(FrameMode::rail);
        settings.rail = rail;
        const Frames frames(path, settings);
        glm::dquat last = frames.at(0.0, 0.0);
        for (double s = 0.0; s <= 10.0; s += 0.001) {
            const glm::dquat next = frames.at(s, 0.0);
            CHECK(angle_between(last, next) < 0.03);
            last = next;
        }
    }
    FrameSettings settings = mode(FrameMode::rail);
    CHECK_THROWS_AS(Frames(path, settings), std::invalid_argument);
    settings.rail = crossing;
    CHECK(angle_between(shared_frames(path, settings).at(2.0, 0.0), Frames(path, settings).at(2.0, 0.0)) ==
          0.0);
    settings.rail_point = RailPoint::nearest;
    CHECK(angle_between(shared_frames(path, settings).at(2.0, 0.0), Frames(path, settings).at(2.0, 0.0)) ==
          0.0);
}
