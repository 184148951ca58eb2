#include "contracts/row.hpp"
#include "contracts/samples.hpp"
#include "motus/dynamics/double_pendulum.hpp"
#include "motus/dynamics/spherical_pendulum.hpp"
#include "motus/dynamics/track.hpp"
#include "motus/dynamics/wave.hpp"

namespace motus::contracts {

template <Some<dynamics::PendulumState> T>
auto fields(Declared, T& v) {
    return std::tie(v.angle, v.velocity);
}
template <Some<dynamics::SphericalState> T>
auto fields(Declared, T& v) {
    return std::tie(v.direction, v.velocity);
}
template <Some<dynamics::DoublePendulumState> T>
auto fields(Declared, T& v) {
    return std::tie(v.theta1, v.theta2, v.omega1, v.omega2);
}
template <Some<dynamics::Response> T>
auto fields(Declared, T& v) {
    return std::tie(v.value, v.derivative);
}
template <Some<dynamics::Step> T>
auto fields(Declared, T& v) {
    return std::tie(v.length, v.lag, v.ee, v.eu, v.ue, v.uu);
}

namespace {

using namespace dynamics;

/// Refused beyond what the motion can be followed for, which depends on all of its numbers.
[[nodiscard]] Domain time_of_motion() {
    return finite().open().tested_to(1e3).in_words("finite, as far as the motion can be followed");
}

void add_single(Table& table) {
    const auto pendulum = [](double damping) {
        return of(Pendulum{1.0, 9.81, damping}, member("length", &Pendulum::length, above(0.0).open()),
                  member("gravity", &Pendulum::gravity, at_least(0.0).open()),
                  member("damping", &Pendulum::damping, at_least(0.0).open()));
    };
    const auto start = of(PendulumState{1.0, 0.5}, member("angle", &PendulumState::angle, finite().open()),
                          member("velocity", &PendulumState::velocity, finite().open()));
    for (const double damping : {0.0, 0.1})
        add(
            table, "dynamics::single_pendulum(pendulum, start, times, out)",
            [](const Pendulum& given, const PendulumState& from, const auto& times, auto found) {
                single_pendulum(given, from, times, found);
            },
            pendulum(damping), start,
            arg("times", std::vector{0.1, 0.5}, time_of_motion(), as_many_as("`out`")),
            out<PendulumState>("out", 2, "`times`"))
            .costs(damping > 0.0 ? "damped: O(1) a time, from a cached table of steps"
                                 : "undamped: O(1) a time")
            .allocates(Memory::scratch);
    add(
        table, "dynamics::pendulum_period(pendulum, start)",
        [](const Pendulum& given, const PendulumState& from) { return pendulum_period(given, from); },
        pendulum(0.0), start)
        .costs("O(1)")
        .infinite()
        .adds("infinite if it never repeats itself");
    add(
        table, "dynamics::single_pendulum(pendulum, start, pivot, times, out)",
        [](const Pendulum& given, const PendulumState& from, double step, const auto& accelerations,
           const auto& times, auto found) {
            single_pendulum(given, from, PivotMotion{step, accelerations}, times, found);
        },
        pendulum(0.1), start, arg("step", 0.1, above(0.0).open()),
        arg("accelerations", std::vector{0.0, 0.0, 1.0, 0.0}, finite().open(), {Size::Rule::any, 0, "pairs"}),
        arg("times", std::vector{0.1, 0.5}, at_least(0.0).open().tested_to(1e3), as_many_as("`out`")),
        out<PendulumState>("out", 2, "`times`"))
        .costs("O(1) a time, from a cached table of steps")
        .allocates(Memory::scratch);
    add(
        table, "dynamics::pivot_accelerations(step, positions, out)",
        [](double step, const auto& positions, auto found) { pivot_accelerations(step, positions, found); },
        arg("step", 0.1, above(0.0).open()),
        arg("positions", std::vector{0.0, 0.0, 0.1, 0.0, 0.3, 0.1, 0.2, 0.0}, finite().open(),
            as_many_as("`out`, pairs")),
        out<double>("out", 8, "`positions`"))
        .costs("O(n)")
        .allocates(Memory::scratch);
}

void add_spherical(Table& table) {
    const auto pendulum = of(Pendulum{1.0, 9.81, 0.1}, member("length", &Pendulum::length, above(0.0).open()),
                             member("gravity", &Pendulum::gravity, at_least(0.0).open()),
                             member("damping", &Pendulum::damping, at_least(0.0).open()));
    const auto start =
        of(SphericalStart{1.0, 0.5, 0.1, 0.2}, member("angle", &SphericalStart::angle, up_to(1e9).open()),
           member("heading", &SphericalStart::heading, up_to(1e9).open()),
           member("velocity", &SphericalStart::velocity, finite().open().tested_to(1e4)),
           member("across", &SphericalStart::across, finite().open().tested_to(1e4)));
    const char* cost = "O(1) a time, from a cached table of steps";
    add(
        table, "dynamics::spherical_pendulum(pendulum, start, times, out)",
        [](const auto& given, const auto& from, const auto& at, auto found) {
            spherical_pendulum(given, from, at, found);
        },
        pendulum, start,
        arg("times", std::vector{0.1, 0.2}, time_of_motion().tested_to(10.0), as_many_as("`out`")),
        out<SphericalState>("out", 2, "`times`"))
        .costs(cost)
        .allocates(Memory::scratch);
    add(
        table, "dynamics::spherical_pendulum(pendulum, start, pivot, times, out)",
        [](const auto& from, double step, const auto& accelerations, const auto& at, auto found) {
            spherical_pendulum({}, from, PivotMotion{step, accelerations}, at, found);
        },
        start, arg("step", 0.1, above(0.0).open()),
        arg("accelerations", std::vector{0.0, 0.0, 0.0, 1.0, 0.0, 0.0}, finite().open(),
            {Size::Rule::any, 0, "triples"}),
        arg("times", std::vector{0.1, 0.2}, at_least(0.0).open().tested_to(10.0), as_many_as("`out`")),
        out<SphericalState>("out", 2, "`times`"))
        .costs(cost)
        .allocates(Memory::scratch);
}

void add_double(Table& table) {
    const auto pendulum = of(DoublePendulum{}, member("mass1", &DoublePendulum::mass1, above(0.0).open()),
                             member("mass2", &DoublePendulum::mass2, above(0.0).open()),
                             member("length1", &DoublePendulum::length1, above(0.0).open()),
                             member("length2", &DoublePendulum::length2, above(0.0).open()),
                             member("gravity", &DoublePendulum::gravity, at_least(0.0).open()),
                             member("damping", &DoublePendulum::damping, at_least(0.0).open()),
                             member("most_acceleration", &DoublePendulum::most_acceleration,
                                    numbers("> 0", [](double x) { return x > 0.0; }).open()),
                             member("most_velocity", &DoublePendulum::most_velocity,
                                    numbers("> 0", [](double x) { return x > 0.0; }).open()));
    const auto state = of(DoublePendulumState{1.0, 0.5, 0.1, 0.0},
                          member("theta1", &DoublePendulumState::theta1, up_to(1e9).open()),
                          member("theta2", &DoublePendulumState::theta2, up_to(1e9).open()),
                          member("omega1", &DoublePendulumState::omega1, finite().open().tested_to(1e4)),
                          member("omega2", &DoublePendulumState::omega2, finite().open().tested_to(1e4)));
    const auto times =
        arg("times", std::vector{0.1, 0.2}, time_of_motion().tested_to(10.0), as_many_as("`out`"));
    const char* cost = "O(1) a time, from a cached table of steps";
    add(
        table, "dynamics::double_pendulum(pendulum, start, times, out)",
        [](const auto& given, const auto& from, const auto& at, auto found) {
            double_pendulum(given, from, at, found);
        },
        pendulum, state, times, out<DoublePendulumState>("out", 2, "`times`"))
        .costs(cost)
        .allocates(Memory::scratch);
    add(
        table, "dynamics::double_pendulum(pendulum, start, pivot, times, out)",
        [](const auto& from, double step, const auto& accelerations, const auto& at, auto found) {
            double_pendulum({}, from, PivotMotion{step, accelerations}, at, found);
        },
        state, arg("step", 0.1, above(0.0).open()),
        arg("accelerations", std::vector{0.0, 0.0, 1.0, 0.0}, finite().open(), {Size::Rule::any, 0, "pairs"}),
        arg("times", std::vector{0.1, 0.2}, at_least(0.0).open().tested_to(10.0), as_many_as("`out`")),
        out<DoublePendulumState>("out", 2, "`times`"))
        .costs(cost)
        .allocates(Memory::scratch);
    const auto time = arg("time", 0.2, time_of_motion().tested_to(10.0));
    const std::vector<DoublePendulumState> two(2, {1.0, 0.5, 0.1, 0.0});
    const auto starts =
        of(two, each("theta1", &DoublePendulumState::theta1, up_to(1e9).open(), as_many_as("`out`")),
           each("omega2", &DoublePendulumState::omega2, finite().open().tested_to(1e4)));
    add(
        table, "dynamics::double_pendulums(pendulum, starts, time, out)",
        [](const auto& given, const auto& from, double at, auto found) {
            double_pendulums(given, from, at, found);
        },
        pendulum, starts, time, out<DoublePendulumState>("out", 2, "`starts`"))
        .costs("O(n), two thirds of n calls of double_pendulum")
        .allocates(Memory::scratch)
        .adds("2048 starts at most");
    add(
        table, "dynamics::double_pendulums(pendulum, starts, pivot, time, out)",
        [](const auto& from, double step, double at, auto found) {
            const std::vector<double> accelerations{0.0, 0.0, 1.0, 0.0};
            double_pendulums({}, from, PivotMotion{step, accelerations}, at, found);
        },
        starts, arg("step", 0.1, above(0.0).open()),
        arg("time", 0.2,
            finite().open().tested_to(10.0).in_words("≥ 0, as far as the motion can be followed")),
        out<DoublePendulumState>("out", 2, "`starts`"))
        .costs("O(n)")
        .allocates(Memory::scratch)
        .adds("2048 starts at most");
    add(
        table, "dynamics::longest_time(pendulum, start)",
        [](const auto& given, const auto& from) { return longest_time(given, from); }, pendulum, state)
        .costs("O(1)");
    add(
        table, "dynamics::energy(pendulum, state)",
        [](const auto& given, const auto& of_it) { return energy(given, of_it); }, pendulum, state)
        .costs("O(1)");
}

[[nodiscard]] const SecondOrder& sample_filter() {
    static const SecondOrder made(2.0, 0.5, 0.3);
    return made;
}
[[nodiscard]] auto told(const SecondOrder& filter) {
    const Coefficients k = filter.coefficients();
    return std::tuple(filter.frequency(), filter.damping(), filter.response(), filter.rate(), filter.lead(),
                      k.k1, k.k2, k.k3);
}

void add_filters(Table& table) {
    add(
        table, "dynamics::SecondOrder::SecondOrder(frequency, damping, response)",
        [](double f, double zeta, double r) { return told(SecondOrder(f, zeta, r)); },
        arg("frequency", 2.0, from(1e-100, 1e100)), arg("damping", 0.5, from(0.0, 1e100)),
        arg("response", 0.3, up_to(1e100)))
        .costs("O(1)");
    add(
        table, "dynamics::SecondOrder::from_coefficients(coefficients)",
        [](const Coefficients& k) { return told(SecondOrder::from_coefficients(k)); },
        of(Coefficients{0.1, 0.01, 0.1},
           member("k1", &Coefficients::k1, at_least(0.0).open().in_words("0 to 1e100 times the root of k2")),
           member("k2", &Coefficients::k2, from(1e-100, 1e100).open()),
           member("k3", &Coefficients::k3, finite().open().in_words("up to 1e100 times the root of k2"))))
        .costs("O(1)")
        .infinite()
        .adds("its response may be infinite");
    add(
        table, "dynamics::SecondOrder::from_mass_spring(mass, stiffness, resistance)",
        [](double mass, double stiffness, double resistance) {
            return told(SecondOrder::from_mass_spring(mass, stiffness, resistance));
        },
        arg("mass", 1.0, above(0.0).open()), arg("stiffness", 9.0, above(0.0).open()),
        arg("resistance", 0.5, at_least(0.0).open()))
        .costs("O(1)")
        .adds("`mass` / `stiffness` from 1e-100 to 1e100");
    add(
        table, "dynamics::SecondOrder::from_overshoot(overshoot, settling, response, tolerance)",
        [](double overshoot, double settling, double response, double tolerance) {
            return told(SecondOrder::from_overshoot(overshoot, settling, response, tolerance));
        },
        arg("overshoot", 0.2, within(0.0, 1.0).open()), arg("settling", 1.5, above(0.0).open()),
        arg("response", 0.3, up_to(1e100).open()), arg("tolerance", 0.02, within(0.0, 1.0).open()))
        .costs("O(1), some 100 steps");
    add(
        table, "dynamics::step_response(filter, time)",
        [](double time) { return step_response(sample_filter(), time); }, arg("time", 0.3, any()))
        .costs("O(1)");
    add(table, "dynamics::overshoot(filter)", [] { return overshoot(sample_filter()); }).costs("O(1)");
    add(
        table, "dynamics::settling_time(filter, tolerance)",
        [](double tolerance) { return settling_time(sample_filter(), tolerance); },
        arg("tolerance", 0.02, above(0.0)))
        .costs("O(1), some 100 steps")
        .adds("infinite without damping");
    add(
        table, "dynamics::make_step(filter, length)",
        [](double length) { return make_step(sample_filter(), length); }, arg("length", 0.1, at_least(0.0)))
        .costs("O(1)");
}

void add_tracks(Table& table) {
    const auto times = arg("times", std::vector{0.0, 0.1, 0.2}, rising().open(), at_least_many(1));
    const auto inputs = arg("inputs", std::vector{0.0, 1.0, 1.0, 2.0, 0.5, 0.5}, finite().open(),
                            as_many_as("`times`, times `dimensions`"));
    const auto dimensions =
        arg("dimensions", std::size_t{2}, numbers("≥ 1", [](double x) { return x >= 1.0; }).open());
    const auto resets = arg("resets", std::vector<std::size_t>{2},
                            numbers("rising indices of samples", [](double x) { return x < 3.0; }).open());
    add(
        table, "dynamics::Track::Track(filter, times, inputs, dimensions, resets, start)",
        [](const auto& at, const auto& given, std::size_t count, const auto& jumps) {
            const Track track(sample_filter(), at, given, count, jumps);
            std::vector<double> found(track.dimensions());
            track.evaluate(0.15, found);
            return found;
        },
        times, inputs, dimensions, resets)
        .costs("O(n)")
        .allocates(Memory::result)
        .adds("in a loop: two samples, no resets, and no resonance");
    add(
        table, "dynamics::second_order(filter, times, inputs, dimensions, out)",
        [](const auto& at, const auto& given, std::size_t count, auto found) {
            second_order(sample_filter(), at, given, count, found);
        },
        times, inputs, dimensions, out<double>("out", 6, "`inputs`"))
        .costs("O(n)");
    static const Track track(sample_filter(), std::vector{0.0, 0.1, 0.2},
                             std::vector{0.0, 1.0, 1.0, 2.0, 0.5, 0.5}, 2);
    const auto time = arg("time", 0.15, finite());
    add(
        table, "dynamics::Track::evaluate(time, out)",
        [](double at, auto found) { track.evaluate(at, found); }, time, out<double>("out", 2, "dimensions"))
        .costs("O(log n)");
    add(
        table, "dynamics::Track::evaluate(time, out, velocity)",
        [](double at, auto found, auto velocity) { track.evaluate(at, found, velocity); }, time,
        out<double>("out", 2, "dimensions"), out<double>("velocity", 2, "dimensions, or none", true))
        .costs("O(log n)");
    add(
        table, "dynamics::Track::offset(time, out)", [](double at, auto found) { track.offset(at, found); },
        time, out<double>("out", 2, "dimensions"))
        .costs("O(log n)");
    add(
        table, "dynamics::Track::outputs(out)", [](auto found) { track.outputs(found); },
        out<double>("out", 6, "the inputs"))
        .costs("O(n)");
    const std::vector<glm::dquat> turns{{1.0, 0.0, 0.0, 0.0}, {0.8, 0.6, 0.0, 0.0}, {0.6, 0.8, 0.0, 0.0}};
    add(
        table, "dynamics::RotationTrack::RotationTrack(filter, times, inputs, resets, start)",
        [](const auto& at, const auto& given, const auto& jumps) {
            return RotationTrack(sample_filter(), at, given, jumps).evaluate(0.15);
        },
        times, arg("inputs", turns, unit(1e-4).in_words("unit quaternions"), as_many_as("`times`")), resets)
        .costs("O(n)")
        .allocates(Memory::result)
        .adds("in a loop: the last input is the first again");
    static const RotationTrack rotations(sample_filter(), std::vector{0.0, 0.1, 0.2}, turns);
    add(
        table, "dynamics::RotationTrack::evaluate(time)", [](double at) { return rotations.evaluate(at); },
        time)
        .costs("O(log n)");
    add(
        table, "dynamics::RotationTrack::offset(time)", [](double at) { return rotations.offset(at); }, time)
        .costs("O(log n)");
    table.moved.push_back({"dynamics::Track", "refuses to be asked", [] {
                               Track from = track;
                               const Track taken = std::move(from);
                               double found[2];
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect_refusal([&] { from.evaluate(0.1, found); });
                               from = taken;
                               from.evaluate(0.1, found);
                           }});
    table.moved.push_back({"dynamics::RotationTrack", "refuses to be asked", [] {
                               RotationTrack from = rotations;
                               const RotationTrack taken = std::move(from);
                               // NOLINTNEXTLINE(bugprone-use-after-move)
                               expect_refusal([&] { (void)from.evaluate(0.1); });
                               from = taken;
                               (void)from.evaluate(0.1);
                           }});
}

}  // namespace

void add_dynamics(Table& table) {
    add(
        table, "dynamics::wave(shape, place, share)",
        [](double place, double share) { return wave(Wave::square, place, share); }, arg("place", 0.3, any()),
        arg("share", 0.5, from(0.0, 1.0)))
        .costs("O(1)");
    add_single(table);
    add_spherical(table);
    add_double(table);
    add_filters(table);
    add_tracks(table);
}

}  // namespace motus::contracts
