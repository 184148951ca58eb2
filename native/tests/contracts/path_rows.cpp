#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/path/follow.hpp"

namespace motus::contracts {

template <Some<path::Pose> T>
auto fields(Declared, T& v) {
    return std::tie(v.location, v.rotation);
}
template <Some<path::Progress> T>
auto fields(Declared, T& v) {
    return std::tie(v.parameter, v.fraction, v.distance, v.speed, v.length);
}

namespace {

using path::FrameMode;
using path::Frames;
using path::FrameSettings;
using path::Timing;

/// What a timing says about some moments.
[[nodiscard]] std::vector<double> told(const Timing& timing) {
    std::vector<double> all;
    for (const double time : {-1.0, 0.0, 0.3, 1.0, 2.5, 100.0}) {
        all.push_back(timing.distance(time));
        all.push_back(timing.speed(time));
    }
    return all;
}
[[nodiscard]] const Timing& sample_timing() {
    static const Timing made = Timing::speeds_by_distance(std::vector{0.0, 2.0}, std::vector{1.0, 2.0});
    return made;
}
[[nodiscard]] const Timing& even() {
    static const Timing made = Timing::constant(0.5);
    return made;
}
[[nodiscard]] FrameSettings settings_for(FrameMode mode) {
    FrameSettings settings;
    settings.mode = mode;
    if (mode == FrameMode::tilt) settings.tilt = {0.1, 0.2, 0.3};
    if (mode == FrameMode::rail) settings.rail = sample_path();
    return settings;
}
[[nodiscard]] const Frames& sample_frames(FrameMode mode) {
    static const std::vector<Frames> made = [] {
        std::vector<Frames> all;
        for (int i = 0; i < 5; ++i) all.emplace_back(sample_path(), settings_for(static_cast<FrameMode>(i)));
        return all;
    }();
    return made.at(static_cast<std::size_t>(mode));
}
template <class Call>
[[nodiscard]] auto for_every_mode(const Call& call) {
    return std::tuple(call(sample_frames(FrameMode::world_up)), call(sample_frames(FrameMode::minimal)),
                      call(sample_frames(FrameMode::banking)), call(sample_frames(FrameMode::curvature)),
                      call(sample_frames(FrameMode::tilt)));
}

void add_timings(Table& table) {
    const Domain share = from(0.0, 1.0).open();
    add(
        table, "path::ease(u, ease_in, ease_out)",
        [](double u, double in, double out) { return path::ease(u, in, out); }, arg("u", 0.3, finite()),
        arg("ease_in", 0.2, share), arg("ease_out", 0.3, share))
        .costs("O(1)")
        .adds("`ease_in` and `ease_out` are 1 at most together");
    add(
        table, "path::ease_derivative(u, ease_in, ease_out)",
        [](double u, double in, double out) { return path::ease_derivative(u, in, out); },
        arg("u", 0.3, finite()), arg("ease_in", 0.2, share), arg("ease_out", 0.3, share))
        .costs("O(1)")
        .adds("`ease_in` and `ease_out` are 1 at most together");
    add(
        table, "path::Timing::eased(duration, length, ease_in, ease_out, after)",
        [](double duration, double length, double in, double out) {
            return told(Timing::eased(duration, length, in, out, path::AfterEase::repeat));
        },
        arg("duration", 2.0, above(0.0).open()), arg("length", 3.0, finite().open()),
        arg("ease_in", 0.2, share), arg("ease_out", 0.3, share))
        .costs("O(1)")
        .allocates(Memory::scratch)
        .infinite()
        .adds("`ease_in` and `ease_out` are 1 at most together; the speed is finite");
    add(
        table, "path::Timing::constant(speed)", [](double speed) { return told(Timing::constant(speed)); },
        arg("speed", 2.0, finite()))
        .costs("O(1)")
        .allocates(Memory::result)
        .infinite();
    const auto keys = [](const char* name) {
        return arg(name, std::vector{0.0, 1.0, 2.0}, rising().open(), at_least_many(1));
    };
    const auto numbers = [](const char* name, const char* as, const Domain& domain) {
        return arg(name, std::vector{0.5, 1.0, 2.0}, domain, as_many_as(as));
    };
    add(
        table, "path::Timing::pins(times, distances)",
        [](const auto& times, const auto& distances) { return told(Timing::pins(times, distances)); },
        keys("times"), numbers("distances", "`times`", finite().open()))
        .costs("O(n)")
        .allocates(Memory::result)
        .adds("speeds are finite");
    add(
        table, "path::Timing::speeds(times, speeds)",
        [](const auto& times, const auto& speeds) { return told(Timing::speeds(times, speeds)); },
        keys("times"), numbers("speeds", "`times`", finite().open()))
        .costs("O(n)")
        .allocates(Memory::result)
        .infinite()
        .adds("distances at the times are finite");
    add(
        table, "path::Timing::speeds_by_distance(distances, speeds)",
        [](const auto& distances, const auto& speeds) {
            return told(Timing::speeds_by_distance(distances, speeds));
        },
        keys("distances"), numbers("speeds", "`distances`", above(0.0).open()))
        .costs("O(n)")
        .allocates(Memory::result)
        .infinite()
        .adds("times are finite");
    add(
        table, "path::Timing::speeds_by_distance(distances, speeds, lap)",
        [](const auto& distances, const auto& speeds, double lap) {
            return told(Timing::speeds_by_distance(distances, speeds, lap));
        },
        keys("distances"), numbers("speeds", "`distances`", above(0.0).open()),
        arg("lap", 5.0, above(0.0).open()))
        .costs("O(n log n)")
        .allocates(Memory::scratch)
        .infinite()
        .adds("`distances` lie within one lap; times are finite");
    add(
        table, "path::Timing::distance(time)", [](double time) { return sample_timing().distance(time); },
        arg("time", 0.3, any().unbounded()))
        .costs("O(log n)")
        .adds("far away it may be infinite");
    add(
        table, "path::Timing::speed(time)", [](double time) { return sample_timing().speed(time); },
        arg("time", 0.3, any().unbounded()))
        .costs("O(log n)");
    table.moved.push_back({"path::Timing", "at rest at distance 0", [] {
                               Timing timing = Timing::pins(std::vector{0.0, 1.0}, std::vector{0.0, 2.0});
                               const Timing taken = std::move(timing);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(timing.distance(0.5) == 0.0 && timing.speed(0.5) == 0.0, "rests");
                               timing = taken;
                               expect(timing.distance(1.0) == 2.0, "is assigned");
                           }});
}

void add_frames(Table& table) {
    for (const bool is_shared : {false, true}) {
        const auto settings = [](FrameMode mode, auto... slots) { return of(settings_for(mode), slots...); };
        const auto gravity = member("gravity", &FrameSettings::gravity, above(0.0));
        const auto strength = member("strength", &FrameSettings::strength, finite());
        const auto limit = member("limit", &FrameSettings::limit, at_least(0.0).or_infinity());
        const auto smoothing = member("smoothing", &FrameSettings::smoothing, at_least(0.0));
        const auto tilt =
            member("tilt", &FrameSettings::tilt, finite(), as_many_as("the points of the curve"));
        const char* signature =
            is_shared ? "path::shared_frames(path, settings)" : "path::Frames::Frames(path, settings)";
        const auto call = [is_shared](const FrameSettings& given) {
            const Frames made =
                is_shared ? shared_frames(sample_path(), given) : Frames(sample_path(), given);
            return std::pair(made.at(0.5, 1.0), made.at(4.0, 9.0));
        };
        const auto row = [&](auto argument, const char* also) {
            add(table, signature, call, std::move(argument))
                .costs(is_shared ? "O(n) from the cache, else as the constructor" : "O(n), adaptive")
                .allocates(Memory::scratch)
                .adds(also);
        };
        row(settings(FrameMode::banking, gravity, strength, limit, smoothing),
            "banking; `path` must be there");
        row(settings(FrameMode::curvature, smoothing), "curvature");
        row(settings(FrameMode::tilt, tilt), "tilt");
        row(settings(FrameMode::rail), "rail; `rail` must be there");
    }
    add(
        table, "path::Frames::at(s, speed)",
        [](double s) { return for_every_mode([&](const Frames& frames) { return frames.at(s, 1.0); }); },
        arg("s", 0.3, any()))
        .costs("O(log n)");
    add(
        table, "path::Frames::at(s, speed)",
        [](double of_it) { return sample_frames(FrameMode::banking).at(0.7, of_it); },
        arg("speed", 0.3, any().in_words("any; banking: NaN gives NaN")))
        .costs("O(log n)");
    add(
        table, "path::Frames::pose(s, speed)",
        [](double s) { return for_every_mode([&](const Frames& frames) { return frames.pose(s, 1.0); }); },
        arg("s", 0.3, any()))
        .costs("O(log n)");
    add(
        table, "path::Frames::pose(s, speed)",
        [](double of_it) { return sample_frames(FrameMode::banking).pose(0.7, of_it); },
        arg("speed", 0.3, any().in_words("any; banking: NaN gives NaN")))
        .costs("O(log n)");
    table.moved.push_back({"path::Frames", "the frames that they were", [] {
                               Frames frames = sample_frames(FrameMode::tilt);
                               const Frames taken = std::move(frames);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(frames.at(0.5, 1.0) == taken.at(0.5, 1.0), "is the same");
                               frames = taken;
                           }});
}

void add_followers(Table& table) {
    const Domain before_infinity{
        "below infinity", [](const Domain::Seen& seen) {
            const double infinity = std::numeric_limits<double>::infinity();
            return std::ranges::all_of(seen.all, [&](double x) { return x < infinity; }) ? Verdict::open
                                                                                         : Verdict::refused;
        }};
    for (const double rate : {0.0, 2.0}) {
        path::FollowSettings settings;
        settings.extend = curve::Extend::loop;
        settings.lag_rate = rate;
        Row& row = add(
            table, "path::follow(frames, timing, time, followers, settings, locations, rotations)",
            [](double time, const std::vector<path::Follower>& followers, const path::FollowSettings& given,
               auto locations, auto rotations) {
                path::follow(sample_frames(FrameMode::minimal), even(), time, followers, given, locations,
                             rotations);
            },
            arg("time", 1.5, finite().open().in_words("finite, as are the distance and speed at it")),
            of(std::vector<path::Follower>{{0.0}, {-0.5, 0.25}, {-1.0, 0.0, 0.5}},
               each("offset", &path::Follower::offset, finite().open()),
               each("delay", &path::Follower::delay, finite().open()),
               each("wheelbase", &path::Follower::wheelbase, at_least(0.0))),
            of(settings, member("side", &path::FollowSettings::side, up_to(curve::coordinate_limit).open()),
               member("height", &path::FollowSettings::height, up_to(curve::coordinate_limit).open()),
               member("start", &path::FollowSettings::start, before_infinity),
               member("lag_rate", &path::FollowSettings::lag_rate, at_least(0.0)),
               member("axes", &path::FollowSettings::axes, unit(1e-3).in_words("unit quaternion"))),
            out<glm::dvec3>("locations", 3, "the followers"),
            out<glm::dquat>("rotations", 3, "the followers"));
        row.costs("O(n log n)").adds(rate > 0.0 ? "with lag: 2300 steps at most" : "without lag");
        row.allocates(rate > 0.0 ? Memory::scratch : Memory::nothing);
    }
    add(
        table, "path::progress(path, timing, time, moved, offset, extend)",
        [](double time, double moved, double offset) {
            return path::progress(*sample_path(), even(), time, moved, offset, curve::Extend::loop);
        },
        arg("time", 1.5, any()), arg("moved", 0.5, any()), arg("offset", 0.2, any()))
        .costs("O(1)");
    const Domain axis{"one of ±X, ±Y, ±Z", [](const Domain::Seen& seen) {
                          double sum = 0.0, square = 0.0;
                          for (const double x : seen.all) sum += std::abs(x), square += x * x;
                          return sum == 1.0 && square == 1.0 ? Verdict::open : Verdict::refused;
                      }};
    add(
        table, "path::follower_axes(forward, up)",
        [](const glm::dvec3& forward, const glm::dvec3& up) { return path::follower_axes(forward, up); },
        arg("forward", glm::dvec3(1.0, 0.0, 0.0), axis), arg("up", glm::dvec3(0.0, 0.0, 1.0), axis))
        .costs("O(1)")
        .adds("`up` is across `forward`");
}

}  // namespace

void add_path(Table& table) {
    add_timings(table);
    add_frames(table);
    add_followers(table);
}

}  // namespace motus::contracts
