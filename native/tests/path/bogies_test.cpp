#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "allocations.hpp"
#include "curve/samples.hpp"
#include "frame_checks.hpp"
#include "motus/curve/nearest.hpp"
#include "motus/path/follow.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::test;
using namespace motus::curve;
using namespace motus::path;
using namespace motus::path::checks;

namespace {

/// A wagon at a distance along the path.
Pose wagon(const Frames& frames, double s, double wheelbase, Extend extend = Extend::loop) {
    FollowSettings settings;
    settings.extend = extend;
    const Follower follower{s, 0.0, wheelbase};
    static const Timing still = Timing::constant(0.0);
    Pose pose;
    follow(frames, still, 0.0, {&follower, 1}, settings, {&pose.location, 1}, {&pose.rotation, 1});
    return pose;
}

glm::dvec3 front(const Pose& pose, double wheelbase) {
    return pose.location + 0.5 * wheelbase * forward(pose.rotation);
}
glm::dvec3 rear(const Pose& pose, double wheelbase) {
    return pose.location - 0.5 * wheelbase * forward(pose.rotation);
}

double off_the_path(const Frames& frames, const glm::dvec3& bogie) {
    return nearest(frames.path().curve(), bogie).distance;
}

}  // namespace

TEST_CASE("a wagon on a circle cuts it as its chord does", "[bogies]") {
    constexpr double radius = 20.0;
    const Frames frames(samples::level_circle(radius), mode(FrameMode::world_up));
    for (const double wheelbase : {0.5, 4.0, 12.0, 25.0, 39.0}) {
        for (const double s : {0.0, 1.0, 31.4, 70.0, frames.path().length() - 0.25}) {
            CAPTURE(wheelbase, s);
            const Pose pose = wagon(frames, s, wheelbase);
            const double inner = std::sqrt(radius * radius - 0.25 * wheelbase * wheelbase);
            const double angle = s / radius;
            CHECK(glm::length(pose.location - inner * glm::dvec3(std::cos(angle), std::sin(angle), 0.0)) <
                  1e-5);
            CHECK(glm::length(forward(pose.rotation) - glm::dvec3(-std::sin(angle), std::cos(angle), 0.0)) <
                  1e-5);
            CHECK(glm::length(up(pose.rotation) - z) < 1e-9);
        }
    }
}

TEST_CASE("both bogies stand on the path, in a straight line of exactly the wheelbase", "[bogies]") {
    Random random(11);
    for (int round = 0; round < 20; ++round) {
        const samples::Path path = samples::random_spline(random, 5, round % 2 == 0);
        const Frames frames(path, mode(FrameMode::minimal));
        const double wheelbase = path->length() * random.between(0.01, 0.06);
        for (int i = 1; i < 40; ++i) {
            const double s = path->length() * i / 40.0;
            const Pose pose = wagon(frames, s, wheelbase, Extend::clamp);
            CAPTURE(round, s, wheelbase);
            if (!path->curve().cyclic() && (i < 5 || i > 35)) continue;  // one bogie may be beyond the end
            CHECK(off_the_path(frames, front(pose, wheelbase)) < 1e-10 * path->length());
            CHECK(off_the_path(frames, rear(pose, wheelbase)) < 1e-10 * path->length());
            const double ahead = path->length_at(nearest(path->curve(), front(pose, wheelbase)).t);
            const double behind = path->length_at(nearest(path->curve(), rear(pose, wheelbase)).t);
            const double lap = path->length();
            CHECK(std::abs(std::remainder(ahead + behind - 2.0 * s, lap)) < 1e-8 * lap);
        }
    }
}

TEST_CASE("beyond the ends of an open path the bogies run along the tangents", "[bogies]") {
    const samples::Path path = samples::s_curve();
    const Frames frames(path, mode(FrameMode::world_up));
    constexpr double wheelbase = 0.5;
    const double length = path->length();
    const Curve& curve = path->curve();
    const auto on_tangent = [&](const glm::dvec3& bogie, double t) {
        const glm::dvec3 from = bogie - position(curve, t);
        return glm::length(glm::cross(from, tangent(curve, t)));
    };
    for (const Extend extend : {Extend::clamp, Extend::extrapolate, Extend::loop, Extend::ping_pong}) {
        const Pose at_start = wagon(frames, 0.0, wheelbase, extend);
        CHECK(on_tangent(rear(at_start, wheelbase), 0.0) < 1e-12);
        CHECK(off_the_path(frames, front(at_start, wheelbase)) < 1e-12);
        const Pose at_end = wagon(frames, length, wheelbase, extend);
        CHECK(on_tangent(front(at_end, wheelbase), 1.0) < 1e-12);
        CHECK(off_the_path(frames, rear(at_end, wheelbase)) < 1e-12);
    }
    const Pose far = wagon(frames, length + 3.0, wheelbase, Extend::extrapolate);
    CHECK(glm::length(far.location - position(curve, 1.0) - 3.0 * tangent(curve, 1.0)) < 1e-12);
    CHECK(angle_between(far.rotation, frames.at(length, 0.0)) < 1e-9);
}

TEST_CASE("a wagon goes over the seam of a closed path as over any other place", "[bogies]") {
    const Frames frames(samples::level_circle(5.0), mode(FrameMode::banking));
    const double lap = frames.path().length();
    for (const Extend extend : {Extend::clamp, Extend::loop, Extend::ping_pong}) {
        const Pose before = wagon(frames, 0.0, 3.0, extend), behind = wagon(frames, lap, 3.0, extend);
        CHECK(glm::length(before.location - behind.location) < 1e-9);
        CHECK(angle_between(before.rotation, behind.rotation) < 1e-9);
    }
}

TEST_CASE("a wagon that fits nowhere on the path has its wheelbase along the arc", "[bogies]") {
    constexpr double radius = 1.0, wheelbase = 2.5;
    const Frames frames(samples::level_circle(radius), mode(FrameMode::world_up));
    const Pose pose = wagon(frames, 2.0, wheelbase);
    const double inner = radius * std::cos(0.5 * wheelbase / radius);
    CHECK(glm::length(pose.location - inner * glm::dvec3(std::cos(2.0), std::sin(2.0), 0.0)) < 1e-5);
    // As long as the whole circle: the bogies are in one place.
    const Pose whole = wagon(frames, 2.0, frames.path().length());
    CHECK(glm::length(whole.rotation) == Approx(1.0));
}

TEST_CASE("the search for bogies ends on any path, and allocates nothing", "[bogies]") {
    const Frames point(samples::straight(glm::dvec3(1.0), glm::dvec3(1.0)), {});
    CHECK(wagon(point, 0.0, 2.0).location == glm::dvec3(1.0));
    const Frames coil(samples::helix(0.5, 0.001, 300.0), mode(FrameMode::minimal));
    for (const double wheelbase : {1e-9, 0.3, 0.999, 1.01, 1e3, 1e9}) {
        CAPTURE(wheelbase);
        (void)wagon(coil, 400.0, wheelbase);
        Pose pose;
        CHECK(bytes_allocated_by([&] { pose = wagon(coil, 400.0, wheelbase); }) == 0);
        CHECK(glm::length(pose.rotation) == Approx(1.0));
        CHECK(std::isfinite(pose.location.x));
    }
}

TEST_CASE("the up axis of a wagon is midway between those of its bogies", "[bogies]") {
    // Along a straight line whose tilt grows evenly.
    const samples::Path path = samples::straight({0, 0, 0}, {0, 10, 0});
    FrameSettings settings = mode(FrameMode::tilt);
    settings.tilt = {0.0, 2.0};
    const Frames frames(path, settings);
    for (const double s : {2.0, 5.0, 7.5}) {
        const Pose pose = wagon(frames, s, 3.0, Extend::clamp);
        CHECK(glm::length(pose.location - glm::dvec3(0.0, s, 0.0)) < 1e-12);
        CHECK(angle_between(pose.rotation, frames.at(s, 0.0)) < 1e-9);
    }
}

TEST_CASE("the orientation of a wagon lags behind its line", "[bogies]") {
    constexpr double radius = 20.0;
    const Frames frames(samples::level_circle(radius), mode(FrameMode::world_up));
    FollowSettings settings;
    settings.extend = Extend::loop;
    settings.lag_rate = 40.0;
    settings.lag_by = LagBy::curvature;
    const Follower follower{0.0, 0.0, 6.0};
    Pose pose;
    follow(frames, Timing::constant(10.0), 30.0, {&follower, 1}, settings, {&pose.location, 1},
           {&pose.rotation, 1});
    // A turn at an even rate w under a rate r of lag trails by about w / r.
    const double wanted = (10.0 / radius) / (40.0 / radius);
    CHECK(angle_between(pose.rotation, wagon(frames, 300.0, 6.0).rotation) == Approx(wanted).margin(0.01));
}
