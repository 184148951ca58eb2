#include "motus/path/follow.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "allocations.hpp"
#include "curve/samples.hpp"

using namespace motus;
using namespace motus::test;
using namespace motus::curve;
using namespace motus::path;

namespace {

Pose follow_one(const Frames& frames, const Timing& timing, double time, double offset,
                const FollowSettings& settings) {
    Pose pose;
    const Follower follower{offset};
    follow(frames, timing, time, {&follower, 1}, settings, {&pose.location, 1}, {&pose.rotation, 1});
    return pose;
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat d = glm::conjugate(a) * b;
    return 2.0 * std::atan2(glm::length(glm::dvec3(d.x, d.y, d.z)), std::abs(d.w));
}

FrameSettings mode(FrameMode which) {
    FrameSettings settings;
    settings.mode = which;
    return settings;
}

}  // namespace

TEST_CASE("followers keep their gaps along the arc", "[follow]") {
    const samples::Path path = samples::s_curve();
    const Frames frames(path, mode(FrameMode::world_up));
    const Timing timing = Timing::constant(2.0);
    const std::vector<Follower> followers{{0.0}, {-0.5}, {-1.0}, {3.0}};
    std::vector<glm::dvec3> locations(followers.size());
    std::vector<glm::dquat> rotations(followers.size());
    follow(frames, timing, 1.5, followers, {}, locations, rotations);
    for (std::size_t i = 0; i < followers.size(); ++i) {
        const double s = 3.0 + followers[i].offset;
        CHECK(glm::length(locations[i] - position_at_length(*path, s)) < 1e-12);
        CHECK(angle_between(rotations[i], frames.at(s, 2.0)) < 1e-12);
    }
}

TEST_CASE("a train lines up behind the first, which stops at the ends", "[follow]") {
    const samples::Path path = samples::s_curve();
    const double length = path->length();
    const Frames frames(path, mode(FrameMode::minimal));
    FollowSettings settings;
    settings.extend = Extend::extrapolate;
    settings.line_up = true;
    const Timing timing = Timing::constant(2.0);
    const double first = GENERATE(0.0, -0.25, 0.5);
    const std::vector<Follower> followers{{first}, {first - 0.5}, {first - 1.0}};
    std::vector<glm::dvec3> locations(followers.size());
    std::vector<glm::dquat> rotations(followers.size());
    for (const double time : {-1.0, 0.0, 0.2, 1.0, 100.0}) {
        follow(frames, timing, time, followers, settings, locations, rotations);
        const double front = std::clamp(2.0 * time + first, 0.0, length);
        for (std::size_t i = 0; i < followers.size(); ++i) {
            const double s = front - 0.5 * static_cast<double>(i);
            CHECK(glm::length(locations[i] - position_at_length(*path, s, Extend::extrapolate)) < 1e-12);
            CHECK(angle_between(rotations[i], frames.at(std::max(s, 0.0), 2.0)) < 1e-12);
        }
    }
    settings.lag_rate = 0.3;
    follow(frames, timing, 1000.0, followers, settings, locations, rotations);
    CHECK(angle_between(rotations[0], frames.at(length, 2.0)) < 1e-9);  // it has stood there for long
}

TEST_CASE("followers beyond the ends of a curve are where the extend mode says", "[follow]") {
    const samples::Path path = samples::s_curve();
    const double length = path->length();
    const Frames frames(path, mode(FrameMode::minimal));
    const Timing still = Timing::constant(0.0);
    FollowSettings settings;

    CHECK(follow_one(frames, still, 0.0, length + 2.0, settings).location == position(path->curve(), 1.0));

    settings.extend = Extend::extrapolate;
    const Pose ahead = follow_one(frames, still, 0.0, length + 2.0, settings);
    CHECK(glm::length(ahead.location - position(path->curve(), 1.0) - 2.0 * tangent(path->curve(), 1.0)) <
          1e-12);
    CHECK(angle_between(ahead.rotation, frames.at(length, 0.0)) < 1e-12);
    const Pose behind = follow_one(frames, still, 0.0, -2.0, settings);
    CHECK(glm::length(behind.location - position(path->curve(), 0.0) + 2.0 * tangent(path->curve(), 0.0)) <
          1e-12);

    settings.extend = Extend::loop;
    CHECK(glm::length(follow_one(frames, still, 0.0, length + 2.0, settings).location -
                      position_at_length(*path, 2.0)) < 1e-9);
    settings.extend = Extend::ping_pong;
    CHECK(glm::length(follow_one(frames, still, 0.0, length + 2.0, settings).location -
                      position_at_length(*path, length - 2.0)) < 1e-9);
}

TEST_CASE("the bank follows the speed of the timing", "[follow]") {
    const samples::Path path = samples::level_circle(20.0);
    const Frames frames(path, mode(FrameMode::banking));
    const Timing timing = Timing::eased(10.0, path->length(), 0.3, 0.3);
    for (double time = 0.0; time <= 10.0; time += 0.5) {
        const glm::dquat q = follow_one(frames, timing, time, 0.0, {}).rotation;
        const double v = timing.speed(time);
        CHECK(std::acos(std::min(1.0, (q * glm::dvec3(0, 0, 1)).z)) ==
              Approx(std::atan(v * v / (20.0 * 9.81))).margin(1e-5));
    }
}

TEST_CASE("the chosen axes of a follower point along the frame's tangent and up", "[follow]") {
    const std::vector<glm::dvec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (const glm::dvec3& forward : axes) {
        for (const glm::dvec3& up : axes) {
            if (glm::dot(forward, up) != 0.0) {
                CHECK_THROWS_AS(follower_axes(forward, up), std::invalid_argument);
                continue;
            }
            const glm::dquat q = follower_axes(forward, up);
            CHECK(glm::length(q * forward - glm::dvec3(0, 1, 0)) < 1e-12);
            CHECK(glm::length(q * up - glm::dvec3(0, 0, 1)) < 1e-12);
        }
    }
    CHECK_THROWS_AS(follower_axes({0, 0.6, 0.4}, {1, 0, 0}), std::invalid_argument);

    // A camera looks along its -Z, with +Y up.
    const samples::Path path = samples::s_curve();
    FollowSettings settings;
    settings.axes = follower_axes({0, 0, -1}, {0, 1, 0});
    const Frames frames(path, mode(FrameMode::world_up));
    const glm::dquat q = follow_one(frames, Timing::constant(1.0), 2.0, 0.0, settings).rotation;
    CHECK(glm::length(q * glm::dvec3(0, 0, -1) - tangent(path->curve(), path->t_at_length(2.0))) < 1e-9);
    CHECK((q * glm::dvec3(0, 1, 0)).z == Approx(1.0));
}

TEST_CASE("an orientation that lags on a circle trails it by rate and speed", "[follow]") {
    // Target turning at w, followed at the rate r: a steady angle a with r sin-like pull; for the shortest
    // arc a = w / r.
    const double radius = 5.0;
    const samples::Path path = samples::level_circle(radius);
    const Frames frames(path, mode(FrameMode::world_up));
    const Timing timing = Timing::constant(2.0);
    FollowSettings settings;
    settings.extend = Extend::loop;
    settings.lag_by = LagBy::curvature;
    settings.lag_rate = 20.0;  // 4 per second at curvature 1/5
    const double w = 2.0 / radius;
    for (const double time : {5.0, 9.37, 40.0}) {
        const glm::dquat lagging = follow_one(frames, timing, time, 0.0, settings).rotation;
        FollowSettings rigid = settings;
        rigid.lag_rate = 0.0;
        const glm::dquat target = follow_one(frames, timing, time, 0.0, rigid).rotation;
        CHECK(angle_between(lagging, target) == Approx(w / 4.0).epsilon(1e-3));
    }
}

TEST_CASE("a lagging orientation is continuous in time and starts on its target", "[follow]") {
    const samples::Path path = samples::s_curve();
    const Frames frames(path, mode(FrameMode::banking));
    const Timing timing = Timing::eased(200.0, path->length(), 0.2, 0.2);
    FollowSettings settings;
    settings.lag_rate = 0.002;
    for (const LagBy by : {LagBy::acceleration, LagBy::curvature}) {
        settings.lag_by = by;
        CHECK(angle_between(follow_one(frames, timing, 0.0, 1.0, settings).rotation, frames.at(1.0, 0.0)) <
              1e-12);
        CHECK(angle_between(follow_one(frames, timing, -3.0, 1.0, settings).rotation, frames.at(1.0, 0.0)) <
              1e-12);
        // Across grid points, and where the memory begins to move.
        for (const double time :
             {1e-9, 1.0 / 120.0, 2.5, 17.0 / 120.0, lag_memory, lag_memory + 0.5, 180.0}) {
            CAPTURE(time);
            const glm::dquat a = follow_one(frames, timing, time - 1e-7, 1.0, settings).rotation;
            const glm::dquat b = follow_one(frames, timing, time + 1e-7, 1.0, settings).rotation;
            CHECK(angle_between(a, b) < 1e-6);
        }
    }
}

TEST_CASE("a lagging orientation converges as its steps shrink, with the square of the step", "[follow]") {
    // k times the time at a k-th of the speed and of the rate is the same motion in steps a k-th as long.
    const samples::Path path = samples::s_curve();
    const Frames frames(path, mode(FrameMode::world_up));
    const double time = 5.0;
    const auto refined = [&](double k) {
        FollowSettings settings;
        settings.lag_rate = 0.02 / k;
        const Timing timing = Timing::constant(0.8 * path->length() / time / k);
        return follow_one(frames, timing, k * time, 0.0, settings).rotation;
    };
    const glm::dquat limit = refined(16.0);
    const double coarse = angle_between(refined(1.0), limit);
    const double middle = angle_between(refined(2.0), limit);
    const double fine = angle_between(refined(4.0), limit);
    CHECK(coarse < 1e-3);
    CHECK(coarse > 1e-9);
    CHECK(middle < 0.3 * coarse);
    CHECK(fine < 0.3 * middle);
    CHECK(angle_between(limit, frames.at(0.8 * path->length(), 0.0)) > 0.01);
}

TEST_CASE("a slow lag takes few steps, and goes where steps of 1/120 s go", "[follow]") {
    struct Way {
        const char* name;
        samples::Path path;
        Extend extend;
        double speed, tolerance;
    };
    // Four arches around a square, with corners of some 60 degrees between them.
    std::vector<glm::dvec3> arches;
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 from = corners[i], to = corners[(i + 1) % corners.size()], third = (to - from) / 3.0;
        const glm::dvec3 out = 0.27 * glm::dvec3(third.y, -third.x, 0.0);
        arches.insert(arches.end(), {from, from + third + out, to - third + out, to});
    }
    const auto square = std::make_shared<const ArcLength>(Curve::chain(3, arches, true));
    const std::vector<Way> ways{{"circle", samples::level_circle(5.0), Extend::loop, 1.5, 1e-4},
                                {"forth and back", samples::s_curve(), Extend::ping_pong, 0.7, 1e-4},
                                {"corners", square, Extend::loop, 0.31, 1e-2}};
    for (const Way& way : ways) {
        const Frames frames(way.path, mode(FrameMode::world_up));
        const Timing timing = Timing::constant(way.speed);
        for (const double rate : {10.0, 1.0, 0.3, 0.03, 1e-6}) {
            for (const double time : {9.99, 25.0, 118.0, 500.0}) {
                CAPTURE(way.name, rate, time);
                FollowSettings settings;
                settings.extend = way.extend;
                settings.lag_by = LagBy::curvature;
                settings.lag_rate = rate;
                Pose found;
                const std::size_t bytes = test::bytes_allocated_by(
                    [&] { found = follow_one(frames, timing, time, 0.25, settings); });
                CHECK(bytes <= 140'000);  // 520 kB if all steps are 1/120 s
                // Itself by steps of 1/120 s.
                const auto at = [&](double when) {
                    return extended(way.speed * when + 0.25, way.path->length(), way.extend).value;
                };
                const double oldest = std::max(0.0, time - lag_memory);
                const double first = std::floor(oldest * 120.0);
                glm::dquat slow = frames.at(at(oldest), way.speed);
                for (double step = first; step / 120.0 < time; ++step) {
                    const double begin = std::max(step / 120.0, oldest);
                    const double end = std::min((step + 1.0) / 120.0, time);
                    const double s = at(0.5 * (begin + end));
                    const double bend = curvature(way.path->curve(), way.path->t_at_length(s));
                    slow =
                        glm::slerp(slow, frames.at(s, way.speed), -std::expm1(-rate * bend * (end - begin)));
                }
                const double apart = angle_between(found.rotation, slow);
                // The circle's target runs ahead of slow ones by more than half a turn.
                const bool turns_over =
                    way.extend == Extend::loop && way.tolerance < 1e-3 && way.speed > std::numbers::pi * rate;
                CHECK(apart <= (time <= 10.0 ? 1e-9 : turns_over ? 0.3 : way.tolerance));
            }
        }
    }
}

TEST_CASE("a lag of a very high rate has no effect", "[follow]") {
    const samples::Path path = samples::level_circle(5.0);
    const Frames frames(path, mode(FrameMode::world_up));
    const Timing timing = Timing::constant(1.0);
    FollowSettings settings;
    settings.lag_rate = 1e9;
    const glm::dquat q = follow_one(frames, timing, 3.0, 0.0, settings).rotation;
    CHECK(angle_between(q, frames.at(3.0, 1.0)) < 2.0 / 120.0 / 5.0);
}

TEST_CASE("a curve of zero length gives its point", "[follow]") {
    const glm::dvec3 point(1, 2, 3);
    const Frames frames(samples::straight(point, point), {});
    for (const Extend extend : {Extend::clamp, Extend::extrapolate, Extend::loop, Extend::ping_pong}) {
        FollowSettings settings;
        settings.extend = extend;
        settings.lag_rate = 1.0;
        const Pose pose = follow_one(frames, Timing::constant(1.0), 4.0, 1.0, settings);
        CHECK(pose.location == point);
        CHECK(angle_between(pose.rotation, glm::dquat(1, 0, 0, 0)) == 0.0);
    }
}

TEST_CASE("the progress of a follower counts what lies beyond the ends as its extend mode says", "[follow]") {
    const samples::Path path = samples::s_curve();
    const double length = path->length();
    const auto at = [&](double distance, Extend extend) {
        return progress(*path, Timing::constant(2.0), 1.0, distance - 5.0, 3.0, extend);
    };
    for (const Extend extend : {Extend::clamp, Extend::loop, Extend::ping_pong, Extend::extrapolate}) {
        const Progress inside = at(0.25 * length, extend);
        CHECK(inside.parameter == path->t_at_length(inside.distance));
        CHECK(std::abs(inside.distance - 0.25 * length) < 1e-12 * length);
        CHECK(std::abs(inside.fraction - 0.25) < 1e-12);
        CHECK(inside.speed == 2.0);
        CHECK(inside.length == length);
    }
    CHECK(at(1.5 * length, Extend::clamp).distance == length);
    CHECK(at(-length, Extend::clamp).distance == 0.0);
    CHECK(std::abs(at(1.5 * length, Extend::loop).fraction - 0.5) < 1e-12);
    CHECK(std::abs(at(1.5 * length, Extend::loop).distance - 1.5 * length) < 1e-12 * length);
    CHECK(std::abs(at(-0.25 * length, Extend::loop).fraction - 0.75) < 1e-12);
    CHECK(std::abs(at(1.25 * length, Extend::ping_pong).fraction - 0.75) < 1e-12);
    CHECK(std::abs(at(-0.25 * length, Extend::ping_pong).fraction - 0.25) < 1e-12);
    CHECK(std::abs(at(1.5 * length, Extend::extrapolate).fraction - 1.5) < 1e-12);
    CHECK(at(1.5 * length, Extend::extrapolate).parameter == path->t_at_length(length));
}

TEST_CASE("follow refuses invalid arguments", "[follow]") {
    const Frames frames(samples::s_curve(), {});
    const Timing timing = Timing::constant(1.0);
    const std::vector<Follower> followers{{0.0}, {1.0}};
    std::vector<glm::dvec3> locations(2);
    std::vector<glm::dquat> rotations(2);
    CHECK_THROWS_AS(follow(frames, timing, 0.0, followers, {}, {locations.data(), 1}, rotations),
                    std::invalid_argument);
    CHECK_THROWS_AS(follow(frames, timing, std::nan(""), followers, {}, locations, rotations),
                    std::invalid_argument);
    FollowSettings settings;
    settings.lag_rate = -1.0;
    CHECK_THROWS_AS(follow(frames, timing, 0.0, followers, settings, locations, rotations),
                    std::invalid_argument);
    settings = {};
    settings.side = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(follow(frames, timing, 0.0, followers, settings, locations, rotations),
                    std::invalid_argument);
    const auto is_refused = [&](const Follower& one) {
        CHECK_THROWS_AS(
            follow(frames, timing, 0.0, std::vector{one, one}, FollowSettings{}, locations, rotations),
            std::invalid_argument);
    };
    is_refused({0.0, 0.0, -1.0});
    is_refused({0.0, std::nan(""), 0.0});
    is_refused({std::nan(""), 0.0, 0.0});
}

TEST_CASE("follow ends at any time, and refuses one at which the distance overflows", "[follow]") {
    const Frames frames(samples::level_circle(5.0), mode(FrameMode::world_up));
    FollowSettings settings;
    settings.extend = Extend::loop;
    settings.lag_rate = 0.01;
    for (const double time : {1e13, 1e15, 1e17, 1e18, 1e19, 1e300}) {
        CAPTURE(time);
        const Pose pose = follow_one(frames, Timing::constant(1.0), time, 0.0, settings);
        CHECK(glm::length(pose.rotation) == Approx(1.0));
    }
    CHECK_THROWS_AS(follow_one(frames, Timing::constant(1e200), 1e200, 0.0, settings), std::invalid_argument);
}

TEST_CASE("a follower with a delay is where one without was so long ago, to the bit", "[follow]") {
    const Frames frames(samples::s_curve(), mode(FrameMode::banking));
    const std::vector<double> times{0.0, 2.0, 3.0}, speeds{1.0, 4.0, 2.0};
    const Timing timing = Timing::speeds(times, speeds);
    FollowSettings settings;
    settings.lag_rate = GENERATE(0.0, 0.5);
    settings.start = GENERATE(-std::numeric_limits<double>::infinity(), 0.0);
    for (const double time : {0.25, 1.0, 2.75, 9.0}) {
        const std::vector<Follower> followers{{0.5}, {0.5, 0.75}};
        std::vector<glm::dvec3> locations(2);
        std::vector<glm::dquat> rotations(2);
        follow(frames, timing, time, followers, settings, locations, rotations);
        const Pose before = follow_one(frames, timing, std::max(time - 0.75, settings.start), 0.5, settings);
        CHECK(locations[1] == before.location);
        CHECK(rotations[1] == before.rotation);
    }
}

TEST_CASE("followers stand aside along their own frames, or along level ones", "[follow]") {
    constexpr double radius = 20.0, speed = 10.0, side = 1.5, height = 0.5;
    const samples::Path path = samples::level_circle(radius);
    const Frames frames(path, mode(FrameMode::banking));
    const Timing timing = Timing::constant(speed);
    FollowSettings settings;
    settings.extend = Extend::loop;
    settings.side = side;
    settings.height = height;
    const bool is_level = GENERATE(false, true);
    if (is_level) settings.aside.emplace(path, mode(FrameMode::world_up));
    settings.rotate = GENERATE(false, true);
    const double lean = is_level ? 0.0 : std::atan(speed * speed / (radius * 9.81));
    // The bend is to the left: right is outwards, and up leans inwards.
    const double out = radius + side * std::cos(lean) - height * std::sin(lean);
    const double up = side * std::sin(lean) + height * std::cos(lean);
    for (const double time : {0.0, 0.7, 3.1}) {
        const double angle = speed * time / radius;
        const glm::dvec3 wanted(out * std::cos(angle), out * std::sin(angle), up);
        CHECK(glm::length(follow_one(frames, timing, time, 0.0, settings).location - wanted) < 1e-4);
    }
}
