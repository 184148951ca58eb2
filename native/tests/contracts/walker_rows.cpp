#include <numbers>

#include "contracts/meshes.hpp"
#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/walker/walker.hpp"

namespace motus::contracts {

template <Some<walker::Contact> T>
auto fields(Declared, T& v) {
    return std::tie(v.point, v.normal, v.distance);
}
template <Some<walker::Pattern> T>
auto fields(Declared, T& v) {
    return std::tie(v.phases, v.duty);
}
template <Some<walker::Axes> T>
auto fields(Declared, T& v) {
    return std::tie(v.side, v.ahead, v.up);
}
template <Some<walker::Foot> T>
auto fields(Declared, T& v) {
    return std::tie(v.position, v.normal, v.swing, v.turn);
}
template <Some<walker::Correction> T>
auto fields(Declared, T& v) {
    return std::tie(v.offset, v.rotation);
}

namespace {

using namespace walker;

[[nodiscard]] glm::dmat4 pose_at(double x) {
    glm::dmat4 pose(1.0);
    pose[3] = {x, 0.0, 0.5, 1.0};
    return pose;
}
[[nodiscard]] Way sample_way() {
    Way way;
    way.times = {0.0, 0.5, 1.0, 1.5};
    way.poses = {pose_at(0.0), pose_at(0.2), pose_at(0.5), pose_at(0.9)};
    way.rest = {{0.3, 0.3, -0.5}, {-0.3, 0.3, -0.5}};
    way.phases = {0.0, 0.5};
    way.jump = 5.0;
    way.strides = {0.5, 0.5, 0.4, 0.4};
    way.cadences = {1.0, 1.0, 0.8, 0.8};
    way.duties = {0.5, 0.5, 0.6, 0.6};
    way.changes = {{2, {0.5, 0.25}, 0.6}};
    return way;
}
/// The last row of a matrix is not read.
[[nodiscard]] Domain affine() {
    return {"at most 1e12 in size", [](const Domain::Seen& seen) {
                if (seen.changed % 4 == 3) return Verdict::open;
                return std::abs(seen.number()) <= 1e12 ? Verdict::open : Verdict::refused;
            }};
}
[[nodiscard]] auto way() {
    return of(
        sample_way(),
        member("times", &Way::times,
               rising().open().in_words("at most 1e12 in size, each 1e-12 or more after the one before"),
               as_many_as("`poses`")),
        member("poses", &Way::poses, up_to(1e12).open(), as_many_as("`times`")),
        member("rest", &Way::rest, up_to(1e12).open(), as_many_as("`phases`")),
        member("phases", &Way::phases, finite().open(), as_many_as("`rest`")),
        member("duty", &Way::duty, from(0.05, 0.95)), member("stride", &Way::stride, from(1e-6, 1e6).open()),
        member("cadence", &Way::cadence, from(1e-3, 1e3)),
        member("up", &Way::up, direction().open().in_words("up to 1e12 in size, not 0")),
        member("transition", &Way::transition, from(1.0, 1e3)),
        member("hip_height", &Way::hip_height, from(0.0, 1e6)),
        member("strides", &Way::strides, from(1e-6, 1e6).open(), as_many_or_none("`times`")),
        member("cadences", &Way::cadences, from(1e-3, 1e3), as_many_or_none("`times`")),
        member("duties", &Way::duties, from(0.05, 0.95), as_many_or_none("`times`")),
        member("jump", &Way::jump, numbers("> 0, or infinity", [](double x) { return x > 0.0; })));
}
[[nodiscard]] const BodyTrajectory& sample_trajectory() {
    static const BodyTrajectory made(sample_way());
    return made;
}
[[nodiscard]] const Walker& sample_walker() {
    static const Walker made(sample_way(), {}, nullptr, 1);
    return made;
}

void add_trajectories(Table& table) {
    add(
        table, "walker::BodyTrajectory::BodyTrajectory(way)",
        [](const Way& given) {
            const BodyTrajectory made(given);
            return std::tuple(made.pose(0, 0.7), made.phase(0, 0.7), made.last_phase(0));
        },
        way())
        .costs("O(samples legs)")
        .allocates(Memory::scratch)
        .adds("1 to 100,000 samples, 1 to 256 legs; `resets`: rising indices; `changes`: by rising indices");
    const auto stretch = arg("stretch", std::size_t{0}, index(1, "a stretch"));
    const Domain time = any();
    add(
        table, "walker::BodyTrajectory::stretch_at(time)",
        [](double at) { return sample_trajectory().stretch_at(at); },
        arg("time", 0.7, any_at_rest("any; 0 for NaN")))
        .costs("O(log n)");
    add(
        table, "walker::BodyTrajectory::first_sample(stretch)",
        [](std::size_t of_it) { return sample_trajectory().first_sample(of_it); }, stretch)
        .costs("O(1)");
    add(
        table, "walker::BodyTrajectory::last_sample(stretch)",
        [](std::size_t of_it) { return sample_trajectory().last_sample(of_it); }, stretch)
        .costs("O(1)");
    add(
        table, "walker::BodyTrajectory::last_phase(stretch)",
        [](std::size_t of_it) { return sample_trajectory().last_phase(of_it); }, stretch)
        .costs("O(1)");
    add(
        table, "walker::BodyTrajectory::starts_slowly(stretch)",
        [](std::size_t of_it) { return sample_trajectory().starts_slowly(of_it); }, stretch)
        .costs("O(1)");
    add(
        table, "walker::BodyTrajectory::pose(stretch, time)",
        [](std::size_t of_it, double at) { return sample_trajectory().pose(of_it, at); }, stretch,
        arg("time", 0.7, time.unbounded()))
        .costs("O(log n)");
    add(
        table, "walker::BodyTrajectory::phase(stretch, time)",
        [](std::size_t of_it, double at) { return sample_trajectory().phase(of_it, at); }, stretch,
        arg("time", 0.7, time.unbounded()))
        .costs("O(log n)");
    add(
        table, "walker::BodyTrajectory::time_at(stretch, phase)",
        [](std::size_t of_it, double at) { return sample_trajectory().time_at(of_it, at); }, stretch,
        arg("phase", 0.7, time.unbounded()))
        .costs("O(log n)");
    const auto of_leg = arg("leg", std::size_t{0}, index(2, "a leg"));
    add(
        table, "walker::BodyTrajectory::first_phase(stretch, leg)",
        [](std::size_t of_it, std::size_t leg) { return sample_trajectory().first_phase(of_it, leg); },
        stretch, of_leg)
        .costs("O(1)");
    add(
        table, "walker::BodyTrajectory::cycles(stretch, leg, time)",
        [](std::size_t of_it, std::size_t leg, double at) {
            return sample_trajectory().cycles(of_it, leg, at);
        },
        stretch, of_leg, arg("time", 0.7, time.unbounded()))
        .costs("O(log n)");
    add(
        table, "walker::BodyTrajectory::time_after(stretch, leg, cycles)",
        [](std::size_t of_it, std::size_t leg, double cycles) {
            return sample_trajectory().time_after(of_it, leg, cycles);
        },
        stretch, of_leg, arg("cycles", 0.7, time.unbounded()))
        .costs("O(log n)");
    const Domain finds = any_at_rest("any");
    add(
        table, "walker::BodyTrajectory::duty(stretch, time)",
        [](std::size_t of_it, double at) { return sample_trajectory().duty(of_it, at); }, stretch,
        arg("time", 0.7, finds))
        .costs("O(log n)");
    add(
        table, "walker::BodyTrajectory::stride(stretch, time)",
        [](std::size_t of_it, double at) { return sample_trajectory().stride(of_it, at); }, stretch,
        arg("time", 0.7, finds))
        .costs("O(log n)");
    add(
        table, "walker::BodyTrajectory::axes(pose)",
        [](const glm::dmat4& pose) { return sample_trajectory().axes(pose); },
        arg("pose", pose_at(0.3),
            Domain{"any; what a NaN is a part of is NaN",
                   [](const Domain::Seen&) { return Verdict::unbounded; }}))
        .costs("O(1)")
        .infinite();
    add(
        table, "walker::in_world(pose, point)",
        [](const glm::dmat4& pose, const glm::dvec3& point) { return in_world(pose, point); },
        arg("pose", pose_at(0.3),
            Domain{"any; what a NaN is a part of is NaN",
                   [](const Domain::Seen&) { return Verdict::unbounded; }}),
        arg("point", glm::dvec3(0.1), any_passed_on()))
        .costs("O(1)");
    table.moved.push_back({"walker::BodyTrajectory", "refuses to be asked", [] {
                               BodyTrajectory from = sample_trajectory();
                               const BodyTrajectory taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect_refusal([&] { (void)from.pose(0, 0.5); });
                               expect(from.stretch_count() == 0, "has no stretches");
                               (void)from.stretch_at(0.5);
                               from = taken;
                               (void)from.pose(0, 0.5);
                           }});
}

void add_grounds(Table& table) {
    add(
        table, "walker::pattern_of(gait, rest, forward, up)",
        [](const auto& rest, const glm::dvec3& forward, const glm::dvec3& up) {
            return pattern_of(Gait::ripple, rest, forward, up);
        },
        arg("rest", std::vector<glm::dvec3>{{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}, finite(),
            at_least_many(1)),
        arg("forward", glm::dvec3(0.0, 1.0, 0.0), direction().open()),
        arg("up", glm::dvec3(0.0, 0.0, 1.0), direction().open()))
        .costs("O(n log n)")
        .allocates(Memory::scratch)
        .adds("256 legs at most; `up` is not along `forward`");
    const Domain size = from(0.0, 1e12);
    add(
        table, "walker::natural_stride(speed, hip_height)",
        [](double speed, double height) { return natural_stride(speed, height); }, arg("speed", 1.5, size),
        arg("hip_height", 0.9, size))
        .costs("O(1)");
    const auto cast = [](const Ground& ground) {
        return ground.ray({0.3, 0.3, 5.0}, {0.0, 0.0, -1.0}, 20.0);
    };
    const Plane plane{{0.0, 0.0, -0.5}, {0.0, 0.1, 1.0}};
    const auto planes = of(plane, member("plane", &Plane::point, finite().open()),
                           member("plane", &Plane::normal, direction().open()));
    add(
        table, "walker::Ground::Ground(positions, triangles, plane, executor)",
        [cast](const auto& positions, const auto& triangles, const Plane& below) {
            return cast(Ground(positions, triangles, below, 1));
        },
        arg("positions", sample_positions(), any_at_rest("any; what is not finite is never met")),
        arg("triangles", sample_triangles(), index(5, "a vertex")), planes)
        .costs("O(n log n)")
        .allocates(Memory::scratch);
    static const Ground ground(sample_positions(), sample_triangles(), plane, 1);
    add(
        table, "walker::Ground::with_plane(plane)",
        [cast](const Plane& below) { return cast(ground.with_plane(below)); }, planes)
        .costs("O(1)");
    const Domain finds = any_at_rest("any; where it is NaN nothing is met");
    add(
        table, "walker::Ground::ray(origin, direction, farthest)",
        [](const glm::dvec3& origin, const glm::dvec3& to, double farthest) {
            return ground.ray(origin, to, farthest);
        },
        arg("origin", glm::dvec3(0.3, 0.3, 5.0), finds),
        arg("direction", glm::dvec3(0.0, 0.0, -1.0),
            Domain{"unit, not checked; where it is not finite nothing is met",
                   [](const Domain::Seen& seen) {
                       return std::isfinite(seen.number()) ? Verdict::unbounded : Verdict::at_rest;
                   }}),
        arg("farthest", 9.0, finds))
        .costs("O(log n)")
        .allocates(Memory::scratch);
    table.moved.push_back({"walker::Ground", "the ground that it was", [] {
                               Ground from = ground;
                               const Ground taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect(from.vertex_count() == 5 && taken.vertex_count() == 5, "is the same");
                               from = taken;
                           }});
}

void add_steps(Table& table) {
    add(
        table, "walker::along(u)", [](double u) { return walker::along(u); },
        arg("u", 0.3, any().unbounded().in_words("0 to 1, not checked; NaN gives NaN")))
        .costs("O(1)");
    add(
        table, "walker::above(u)", [](double u) { return walker::above(u); },
        arg("u", 0.3, any().unbounded().in_words("0 to 1, not checked; NaN gives NaN")))
        .costs("O(1)");
    Footstep step;
    step.touch = 1.0;
    step.upwards = 0.1;
    add(
        table, "walker::Footstep::through(time)", [step](double time) { return step.through(time); },
        arg("time", 0.3, any()))
        .costs("O(1)");
    add(
        table, "walker::Footstep::share(u)", [step](double u) { return step.share(u); }, arg("u", 0.3, any()))
        .costs("O(1)");
    const std::vector<Footstep> steps(3, step);
    static const Footsteps footsteps = [](const std::vector<Footstep>& all) {
        Footsteps made;
        made.add(all);
        made.add(all);
        return made;
    }(steps);
    add(table, "walker::Footsteps::add(steps)",
        [steps] {
            Footsteps made;
            made.add(steps);
            return made.bytes();
        })
        .costs("O(n)")
        .allocates(Memory::scratch)
        .alone();
    add(
        table, "walker::Footsteps::of(row)", [](std::size_t row) { return footsteps.of(row).size(); },
        arg("row", std::size_t{0}, index(2, "a row")))
        .costs("O(1)");
    add(
        table, "walker::Footsteps::between(first_row, last_row)",
        [](std::size_t first, std::size_t last) { return footsteps.between(first, last).size(); },
        arg("row", std::size_t{0}, from(0.0, 2.0)), arg("row", std::size_t{2}, from(0.0, 2.0)))
        .costs("O(1)")
        .adds("`first_row` ≤ `last_row`");
    add(
        table, "walker::step_at(steps, time)", [steps](double time) { return step_at(steps, time).touch; },
        arg("time", 0.3, any_at_rest("any")))
        .costs("O(log n)")
        .adds("one step at least");
    table.moved.push_back({"walker::Footsteps", "of no rows", [] {
                               Footsteps from = footsteps;
                               const Footsteps taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect_refusal([&] { (void)from.of(0); });
                               from = taken;
                               expect(from.of(1).size() == 3, "is assigned");
                           }});
}

void add_walkers(Table& table) {
    const Domain size = from(0.0, 1e12);
    WalkSettings settings;
    settings.hips = {{0.2, 0.2, 0.0}, {-0.2, 0.2, 0.0}};
    settings.lengths = {1.0, 1.0};
    settings.bodies.assign(4, glm::dmat4(1.0));
    const Soles soles{{0.0, 1.0, 0.0}, 0.1, 0.1, 0.2, 0.3, 0.8};
    const Domain pitch = from(0.0, 0.5 * std::numbers::pi).in_words("0 to π/2");
    const ChosenStep chosen{0, 0.5, {0.1, 0.0, 0.0}, 0.2, std::nullopt, 0.45, 0.9};
    const Stand stand{{0.2, 0.3, 0.4}, {0.8, 0.0, 0.0, 0.6}};
    const Domain turn = direction().open().in_words("finite, not 0");
    add(
        table, "walker::Walker::Walker(way, settings, ground, executor)",
        [](const Way& given, const WalkSettings& by, const Soles& on, const ChosenStep& moved,
           const Stand& there) {
            WalkSettings all = by;
            all.soles = on;
            all.chosen = {moved, moved};
            all.chosen.back().leg = 1;
            all.chosen.back().fixed = there;
            const Walker made(given, all, nullptr, 1);
            return std::tuple(made.foot(0, 0.7), made.body(0.7), made.phase(0.7), made.settled());
        },
        way(),
        of(settings, member("clearance", &WalkSettings::clearance, size),
           member("reach_up", &WalkSettings::reach_up, size),
           member("reach_down", &WalkSettings::reach_down, size),
           member("minimum_step", &WalkSettings::minimum_step, size),
           member("hips", &WalkSettings::hips, up_to(1e12).open(),
                  Size{Size::Rule::any, 0, "as many as the legs and `lengths`, or none"}),
           member("bodies", &WalkSettings::bodies, affine(), as_many_or_none("`times`")),
           member("lengths", &WalkSettings::lengths, size.open(), as_many_as("`hips`")),
           member("height", &WalkSettings::height, from(0.0, 1.0)),
           member("tilt", &WalkSettings::tilt, from(0.0, 1.0))),
        of(soles, member("forward", &Soles::forward, finite().open()), member("ankle", &Soles::ankle, size),
           member("heel", &Soles::heel, size), member("toe", &Soles::toe, size),
           member("strike", &Soles::strike, pitch), member("push", &Soles::push, pitch)),
        of(chosen, member("chosen", &ChosenStep::time, finite()),
           member("chosen", &ChosenStep::offset, up_to(1e12).open()),
           member("chosen", &ChosenStep::turn, up_to(1e12).open()),
           member("chosen", &ChosenStep::touch, finite()), member("chosen", &ChosenStep::until, finite())),
        of(stand, member("chosen", &Stand::place, up_to(1e12).open()), member("chosen", &Stand::turn, turn)))
        .costs("O(steps) rays")
        .allocates(Memory::scratch)
        .adds("1,000,000 steps at most");
    const auto leg = arg("leg", std::size_t{0}, index(2, "a leg"));
    const auto time = arg("time", 0.7, finite());
    add(
        table, "walker::Walker::foot(leg, time)",
        [](std::size_t of_it, double at) { return sample_walker().foot(of_it, at); }, leg, time)
        .costs("O(log steps)");
    add(
        table, "walker::Walker::body(time)", [](double at) { return sample_walker().body(at); }, time)
        .costs("O(log samples)");
    add(
        table, "walker::Walker::phase(time)", [](double at) { return sample_walker().phase(at); }, time)
        .costs("O(log samples)");
    add(
        table, "walker::Walker::steps(leg)",
        [](std::size_t of_it) { return sample_walker().steps(of_it).size(); }, leg)
        .costs("O(1)");
    table.moved.push_back({"walker::Walker", "refuses to be asked", [] {
                               Walker from = sample_walker();
                               const Walker taken = std::move(from);
                               // NOLINTBEGIN(bugprone-use-after-move)
                               expect(from.leg_count() == 0, "has no legs");
                               expect_refusal([&] { (void)from.foot(0, 0.5); });
                               expect_refusal([&] { (void)from.phase(0.5); });
                               // NOLINTEND(bugprone-use-after-move)
                               from = taken;
                               (void)from.foot(0, 0.5);
                           }});
}

}  // namespace

void add_walker(Table& table) {
    add_grounds(table);
    add_trajectories(table);
    add_steps(table);
    add_walkers(table);
}

}  // namespace motus::contracts
