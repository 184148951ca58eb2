#include "motus/path/frames.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "curve/samples.hpp"
#include "frame_checks.hpp"
#include "motus/path/frame_tables_cache.hpp"
#include "random.hpp"

using namespace motus;
using namespace motus::curve;
using namespace motus::path;
using namespace motus::path::checks;

namespace {

/// Every mode, with every setting that changes the kind of thing it does.
std::vector<FrameSettings> all_settings(const Curve& curve) {
    std::vector<FrameSettings> all;
    for (const FrameMode which :
         {FrameMode::world_up, FrameMode::minimal, FrameMode::banking, FrameMode::curvature}) {
        all.push_back(mode(which));
    }
    all.push_back(mode(FrameMode::banking));
    all.back().smoothing = 0.7;
    all.back().limit = 0.6;
    all.push_back(mode(FrameMode::curvature));
    all.back().smoothing = 0.7;
    all.back().outward = true;
    all.push_back(mode(FrameMode::tilt));
    for (std::size_t i = 0; i < curve.segment_count() + (curve.cyclic() ? 0 : 1); ++i) {
        all.back().tilt.push_back(std::sin(3.0 * static_cast<double>(i)));
    }
    return all;
}

/// Largest turn of the frame over a step at which it is not explained by halving the step: what stays of a
/// jump. Looks at `count` places and zooms in on the quickest of them.
double largest_jump(const Frames& frames, std::size_t count = 400) {
    const double length = frames.path().length();
    const bool cyclic = frames.path().curve().cyclic();
    double worst = cyclic ? angle_between(frames.at(0.0, speed), frames.at(length, speed)) : 0.0;
    double low = 0.0;
    double high = length;
    double quickest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double s0 = length * static_cast<double>(i) / static_cast<double>(count);
        const double s1 = length * static_cast<double>(i + 1) / static_cast<double>(count);
        const double turned = angle_between(frames.at(s0, speed), frames.at(s1, speed));
        if (turned > quickest) {
            quickest = turned;
            low = s0;
            high = s1;
        }
    }
    // A bank that changes sides by a strong curvature takes a millionth of the length for it.
    for (int i = 0; i < 36; ++i) {
        const double middle = 0.5 * (low + high);
        const glm::dquat q = frames.at(middle, speed);
        const bool first = angle_between(frames.at(low, speed), q) > angle_between(q, frames.at(high, speed));
        (first ? high : low) = middle;
    }
    return std::max(worst, angle_between(frames.at(low, speed), frames.at(high, speed)));
}

}  // namespace

TEST_CASE("frames are rotations with +Y on the tangent", "[frames]") {
    motus::test::Random random(11);
    for (int round = 0; round < 12; ++round) {
        const samples::Path path = round % 2 == 0 ? samples::random_bezier(random, 2 + round)
                                                  : samples::random_spline(random, 5, round % 4 == 1);
        for (const FrameSettings& settings : all_settings(path->curve())) {
            const Frames frames(path, settings);
            for (int i = 0; i <= 60; ++i) {
                const double s = path->length() * i / 60.0;
                const glm::dquat q = frames.at(s, speed);
                CAPTURE(round, static_cast<int>(settings.mode), s);
                REQUIRE(glm::length(q) == Approx(1.0).epsilon(1e-12));
                const double t =
                    std::min(path->t_at_length(s), static_cast<double>(path->curve().segment_count()));
                CHECK(glm::length(forward(q) - tangent(path->curve(), t)) < 1e-9);
            }
        }
    }
}

TEST_CASE("the tangent is met to rounding", "[frames]") {
    const samples::Path path = samples::s_curve();
    const Frames frames(path, mode(FrameMode::minimal));
    for (int i = 0; i <= 200; ++i) {
        const double s = path->length() * i / 200.0;
        CHECK(glm::length(forward(frames.at(s, 0.0)) - tangent(path->curve(), path->t_at_length(s))) < 1e-12);
    }
}

TEST_CASE("no mode jumps where the tangent doesn't", "[frames]") {
    motus::test::Random random(2024);
    for (int round = 0; round < 60; ++round) {
        samples::Path path =
            round % 2 == 0
                ? samples::random_bezier(random, 2 + round % 7)
                : samples::random_spline(random, 4 + static_cast<std::size_t>(round % 3), round % 4 == 1);
        if (round % 5 == 3)
            path = samples::squeezed(path, {1.0, 0.0, 1.0});  // hills, loops and vertical tangents
        if (round % 5 == 4) path = samples::squeezed(path, {1.0, 1.0, 0.0});
        for (const FrameSettings& settings : all_settings(path->curve())) {
            CAPTURE(round, static_cast<int>(settings.mode), settings.smoothing);
            CHECK(largest_jump(Frames(path, settings)) < 1e-3);
        }
    }
}

TEST_CASE("no mode jumps on curves in one plane", "[frames]") {
    for (const samples::Path& path :
         {samples::level_circle(5.0), samples::vertical_loop(5.0), samples::figure_eight(),
          samples::s_curve(), samples::trefoil(), samples::helix(2.0, 1.0, 3.0)}) {
        for (const FrameSettings& settings : all_settings(path->curve())) {
            CAPTURE(path->length(), static_cast<int>(settings.mode), settings.smoothing);
            CHECK(largest_jump(Frames(path, settings)) < 1e-3);
        }
    }
}

TEST_CASE("turning the curve about the vertical turns its frames", "[frames]") {
    motus::test::Random random(17);
    const glm::dquat turn = glm::angleAxis(1.1, z);
    for (int round = 0; round < 10; ++round) {
        const samples::Path path = samples::random_spline(random, 5, round % 2 == 0);
        std::vector<glm::dvec3> moved;
        for (const glm::dvec3& p : path->curve().control_points())
            moved.push_back(turn * p + glm::dvec3(5, -3, 2));
        const samples::Path turned = samples::path(Curve::chain(3, moved, path->curve().cyclic()));
        for (const FrameSettings& settings : all_settings(path->curve())) {
            const Frames a(path, settings);
            const Frames b(turned, settings);
            for (int i = 0; i <= 30; ++i) {
                const double s = path->length() * i / 30.0;
                CAPTURE(round, static_cast<int>(settings.mode), s);
                CHECK(angle_between(turn * a.at(s, speed), b.at(s, speed)) < 1e-6);
            }
        }
    }
}

TEST_CASE("frames don't depend on the unit of length", "[frames]") {
    motus::test::Random random(18);
    for (int round = 0; round < 6; ++round) {
        const samples::Path path = samples::random_bezier(random, 5);
        std::vector<glm::dvec3> scaled;
        for (const glm::dvec3& p : path->curve().control_points()) scaled.push_back(1000.0 * p);
        const samples::Path large = samples::path(Curve::bezier(scaled));
        for (FrameSettings settings : all_settings(path->curve())) {
            const Frames a(path, settings);
            settings.gravity *= 1000.0;
            settings.smoothing *= 1000.0;
            const Frames b(large, settings);
            for (int i = 0; i <= 30; ++i) {
                const double s = path->length() * i / 30.0;
                CAPTURE(round, static_cast<int>(settings.mode), s);
                CHECK(angle_between(a.at(s, speed), b.at(1000.0 * s, 1000.0 * speed)) < 1e-6);
            }
        }
    }
}

TEST_CASE("a curve ridden backwards has the same up if up is no matter of history", "[frames]") {
    const samples::Path path = samples::helix(4.0, 3.0, 1.0);
    std::vector<glm::dvec3> reversed(path->curve().control_points().rbegin(),
                                     path->curve().control_points().rend());
    const samples::Path back = samples::path(Curve::chain(3, reversed, false));
    for (const FrameMode which : {FrameMode::world_up, FrameMode::banking, FrameMode::curvature}) {
        const Frames a(path, mode(which));
        const Frames b(back, mode(which));
        for (int i = 0; i <= 30; ++i) {
            const double s = path->length() * i / 30.0;
            CHECK(glm::length(up(a.at(s, speed)) - up(b.at(path->length() - s, speed))) < 1e-6);
        }
    }
}

TEST_CASE("degenerate curves have frames", "[frames]") {
    const glm::dvec3 point(1, 2, 3);
    const std::vector<glm::dvec3> same{point, point, point, point};
    const std::vector<glm::dvec3> collapsed_handles{{0, 0, 0}, {0, 0, 0}, {3, 3, 1}, {3, 3, 1}};
    const std::vector<glm::dvec3> gap{{0, 0, 0}, {0, 1, 0}, {5, 5, 5}, {6, 5, 5}};
    for (const samples::Path& path :
         {samples::path(Curve::bezier(same)), samples::path(Curve::bezier(collapsed_handles)),
          samples::path(Curve::chain(1, gap, false))}) {
        for (const FrameSettings& settings : all_settings(path->curve())) {
            const Frames frames(path, settings);
            for (int i = -1; i <= 11; ++i) {
                const glm::dquat q = frames.at(path->length() * i / 10.0, speed);
                CHECK(glm::length(q) == Approx(1.0));
                if (path->length() == 0.0) CHECK(q == glm::dquat(1, 0, 0, 0));
            }
        }
    }
    CHECK(Frames(samples::path(Curve::bezier(same)), {}).pose(0.0, 0.0).location == point);
}

TEST_CASE("the table of frames has a bounded size", "[frames]") {
    CHECK(Frames(samples::straight({0, 0, 0}, {0, 5, 0}), {}).station_count() <= 17);
    // 2 pi at 2 degrees and at least 16 a segment, halvings included.
    CHECK(Frames(samples::level_circle(5.0), {}).station_count() <= 64 * 17);
    const std::vector<glm::dvec3> cusp{{0, 0, 0}, {6, 6, 0}, {0, 6, 0}, {6, 0, 0}};
    CHECK(Frames(samples::path(Curve::bezier(cusp)), {}).station_count() < 1000);
}

TEST_CASE("settings outside their domain throw if the mode reads them", "[frames]") {
    const samples::Path path = samples::s_curve();
    FrameSettings settings = mode(FrameMode::banking);
    settings.gravity = 0.0;
    CHECK_THROWS_AS(Frames(path, settings), std::invalid_argument);
    settings.mode = FrameMode::world_up;
    CHECK_NOTHROW(Frames(path, settings));
    settings = mode(FrameMode::curvature);
    settings.smoothing = -1.0;
    CHECK_THROWS_AS(Frames(path, settings), std::invalid_argument);
    settings = mode(FrameMode::banking);
    settings.limit = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(Frames(path, settings), std::invalid_argument);
}

TEST_CASE("frames are the same with the cache and without", "[frames]") {
    motus::test::Random random(23);
    const samples::Path path = samples::random_spline(random, 5, true);
    FrameTablesCache& cache = frame_tables_cache();
    const std::size_t capacity = cache.capacity();
    for (const FrameSettings& settings : all_settings(path->curve())) {
        const Frames held = shared_frames(path, settings);
        const Frames again = shared_frames(path, settings);
        cache.set_capacity(0);
        const Frames built = shared_frames(path, settings);
        cache.set_capacity(capacity);
        for (int i = 0; i <= 20; ++i) {
            const double s = path->length() * i / 20.0;
            CHECK(held.at(s, speed) == built.at(s, speed));
            CHECK(held.at(s, speed) == again.at(s, speed));
        }
    }
}
