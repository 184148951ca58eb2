// Legs that walk where a body goes.
#include "motus/walker/walker.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "areas.hpp"
#include "core/arguments.hpp"
#include "core/arrays.hpp"
#include "core/rotations.hpp"
#include "core/typed.hpp"
#include "mesh/arrays.hpp"

namespace motus::bindings {
namespace {

using namespace pybind11::literals;
using walker::Gait;
using walker::Ground;
using walker::Walker;

using GaitChanges = Typed<"typing.Sequence[tuple[int, numpy.typing.ArrayLike, float]] | None">;
using ChosenSteps = Typed<
    "typing.Sequence[tuple[int, float, numpy.typing.ArrayLike, float, tuple[numpy.typing.ArrayLike, "
    "numpy.typing.ArrayLike] | None, float | None, float | None]] | None">;

constexpr double foot_cost = 60.0, body_cost = 200.0, phase_cost = 30.0;  // ns, rough

/// (m,).
[[nodiscard]] std::vector<double> numbers_argument(py::handle object, std::string_view name) {
    const DoubleArray array = doubles(object, name);
    if (array.ndim() != 1) value_error(name, "must have the shape (m,), not " + shape_of(array));
    return {array.data(), array.data() + array.size()};
}

[[nodiscard]] std::vector<glm::dvec3> points_argument(py::handle object, std::string_view name) {
    return copied(Points(object, name).values());
}

[[nodiscard]] Typed<"tuple[numpy.typing.NDArray[numpy.float64], float]"> gait(const GaitName& name,
                                                                              const ArrayLike& rest,
                                                                              const ArrayLike& forward,
                                                                              const ArrayLike& up) {
    const Gait wanted = choice<Gait>(name, "gait",
                                     {{"tripod", Gait::tripod},
                                      {"tetrapod", Gait::tetrapod},
                                      {"ripple", Gait::ripple},
                                      {"wave", Gait::wave},
                                      {"trot", Gait::trot},
                                      {"pace", Gait::pace},
                                      {"walk", Gait::walk},
                                      {"run", Gait::run},
                                      {"canter", Gait::canter},
                                      {"gallop", Gait::gallop},
                                      {"hop", Gait::hop}});
    const walker::Pattern pattern = walker::pattern_of(wanted, points_argument(rest, "rest"),
                                                       vector(forward, "forward"), vector(up, "up"));
    return py::make_tuple(array_of(pattern.phases), pattern.duty);
}

[[nodiscard]] std::optional<walker::Plane> plane_argument(const py::object& given) {
    if (given.is_none()) return std::nullopt;
    const Points rows(given, "plane");
    if (rows.values().size() != 2) value_error("plane", "must have the shape (2, 3): a point, a normal");
    return walker::Plane{rows.values()[0], rows.values()[1]};
}

[[nodiscard]] std::shared_ptr<Ground> ground_of(const OptionalArrayLike& given_positions,
                                                const OptionalArrayLike& given_triangles,
                                                const OptionalArrayLike& given_plane) {
    std::vector<glm::vec3> positions;
    if (!given_positions.is_none()) positions = copied(Positions(given_positions, "positions").values());
    const std::vector<glm::ivec3> triangles =
        copied(IndexRows<glm::ivec3>(given_triangles, "triangles").values());
    const std::optional<walker::Plane> plane = plane_argument(given_plane);
    const py::gil_scoped_release released;
    return std::make_shared<Ground>(positions, triangles, plane);
}

/// The items of a tuple or list, of which there have to be so many.
[[nodiscard]] py::sequence items_of(py::handle object, std::string_view name, std::size_t count,
                                    std::string_view wanted) {
    if (!py::isinstance<py::sequence>(object) || py::len(object) != count) wrong_type(object, name, wanted);
    return py::reinterpret_borrow<py::sequence>(object);
}

[[nodiscard]] std::vector<walker::GaitChange> changes_argument(py::handle given) {
    constexpr std::string_view name = "changes";
    std::vector<walker::GaitChange> result;
    if (given.is_none()) return result;
    if (!py::isinstance<py::iterable>(given)) wrong_type(given, name, "a sequence of tuples");
    for (const py::handle one : given) {
        const py::sequence items = items_of(one, name, 3, "tuples (sample, phases, duty)");
        const py::object sample = items[0], phases = items[1], duty = items[2];
        const int index = whole_number(sample, name);
        if (index < 0) value_error(name, "must have samples of times");
        result.push_back(
            {static_cast<std::size_t>(index), numbers_argument(phases, name), number(duty, name)});
    }
    return result;
}

struct WayArguments {
    const py::object &times, &poses, &rest, &phases, &duty, &stride, &cadence, &up, &resets, &jump, &changes,
        &transition, &strides, &cadences, &duties, &hip_height;
};

[[nodiscard]] walker::Way way_of(const WayArguments& given) {
    walker::Way way;
    way.times = numbers_argument(given.times, "times");
    way.poses = matrices(given.poses, "poses");
    way.rest = points_argument(given.rest, "rest");
    way.phases = numbers_argument(given.phases, "phases");
    way.duty = number(given.duty, "duty");
    way.stride = number(given.stride, "stride");
    way.cadence = number(given.cadence, "cadence");
    way.up = vector(given.up, "up");
    way.resets = indices(given.resets, "resets");
    if (!given.jump.is_none()) way.jump = number(given.jump, "jump");
    way.changes = changes_argument(given.changes);
    way.transition = number(given.transition, "transition");
    way.hip_height = number(given.hip_height, "hip_height");
    if (!given.strides.is_none()) way.strides = numbers_argument(given.strides, "strides");
    if (!given.cadences.is_none()) way.cadences = numbers_argument(given.cadences, "cadences");
    if (!given.duties.is_none()) way.duties = numbers_argument(given.duties, "duties");
    return way;
}

/// A quaternion w, x, y, z.
[[nodiscard]] glm::dquat turn_argument(py::handle object, std::string_view name) {
    const std::vector<double> parts = numbers_argument(object, name);
    if (parts.size() != 4) value_error(name, "must have rotations of the shape (4,)");
    return {parts[0], parts[1], parts[2], parts[3]};
}

[[nodiscard]] std::vector<walker::ChosenStep> chosen_argument(py::handle given) {
    constexpr std::string_view name = "chosen";
    std::vector<walker::ChosenStep> result;
    if (given.is_none()) return result;
    if (!py::isinstance<py::iterable>(given)) wrong_type(given, name, "a sequence of tuples");
    for (const py::handle one : given) {
        const py::sequence items =
            items_of(one, name, 7, "tuples (leg, time, offset, turn, fixed, touch, until)");
        const py::object leg = items[0], time = items[1], offset = items[2], turn = items[3],
                         fixed = items[4], touch = items[5], until = items[6];
        const int row = whole_number(leg, name);
        if (row < 0) value_error(name, "must have legs of rest");
        walker::ChosenStep step{static_cast<std::size_t>(row), number(time, name), vector(offset, name),
                                number(turn, name), std::nullopt};
        if (!fixed.is_none()) {
            const py::sequence stand = items_of(fixed, name, 2, "None or tuples (place, rotation)");
            const py::object place = stand[0], rotation = stand[1];
            step.fixed = walker::Stand{vector(place, name), turn_argument(rotation, name)};
        }
        if (!touch.is_none()) step.touch = number(touch, name);
        if (!until.is_none()) step.until = number(until, name);
        result.push_back(step);
    }
    return result;
}

[[nodiscard]] Walker walker_of(
    const ArrayLike& times, const ArrayLike& poses, const ArrayLike& rest,
    const Typed<"motus_native.WalkerGround | None">& ground, const ArrayLike& phases, const Number& duty,
    const Number& stride, const Number& cadence, const Number& clearance, const Number& reach_up,
    const Number& reach_down, const Number& minimum_step, const ArrayLike& up, const OptionalArrayLike& hips,
    const OptionalArrayLike& lengths, const OptionalArrayLike& bodies, const OptionalWholeNumbers& resets,
    const OptionalNumber& jump, const Number& frequency, const Number& damping, const Number& response,
    const Number& height, const Number& tilt, const ArrayLike& forward, const Number& ankle,
    const Number& heel, const Number& toe, const Number& strike, const Number& push,
    const ChosenSteps& chosen, const GaitChanges& changes, const Number& transition,
    const OptionalArrayLike& strides, const OptionalArrayLike& cadences, const OptionalArrayLike& duties,
    const Number& hip_height) {
    walker::Way way = way_of({times, poses, rest, phases, duty, stride, cadence, up, resets, jump, changes,
                              transition, strides, cadences, duties, hip_height});
    walker::WalkSettings settings;
    settings.clearance = number(clearance, "clearance");
    settings.reach_up = number(reach_up, "reach_up");
    settings.reach_down = number(reach_down, "reach_down");
    settings.minimum_step = number(minimum_step, "minimum_step");
    if (!hips.is_none()) settings.hips = points_argument(hips, "hips");
    if (!lengths.is_none()) settings.lengths = numbers_argument(lengths, "lengths");
    if (!bodies.is_none()) settings.bodies = matrices(bodies, "bodies");
    settings.filter = {number(frequency, "frequency"), number(damping, "damping"),
                       number(response, "response")};
    settings.height = number(height, "height");
    settings.tilt = number(tilt, "tilt");
    settings.soles = {vector(forward, "forward"), number(ankle, "ankle"),   number(heel, "heel"),
                      number(toe, "toe"),         number(strike, "strike"), number(push, "push")};
    settings.chosen = chosen_argument(chosen);
    const Ground* on =
        ground.is_none() ? nullptr : &instance<Ground>(ground, "ground", "a WalkerGround or None");
    const py::gil_scoped_release released;
    return {std::move(way), std::move(settings), on};
}

/// Each time's feet: (n, ...) of a number, (m, n, ...) of more. write(foot, row): `width` numbers, 0 for one
/// that is no row.
template <class Write>
[[nodiscard]] DoubleArray feet_at(const Walker& self, const ArrayLike& times, py::ssize_t width,
                                  const Write& write) {
    const Numbers at(times, "times");
    const std::size_t legs = self.leg_count(), count = at.values().size();
    std::vector<py::ssize_t> shape;
    if (!at.is_single()) shape.push_back(static_cast<py::ssize_t>(count));
    shape.push_back(static_cast<py::ssize_t>(legs));
    if (width > 0) shape.push_back(width);
    DoubleArray result(shape);
    double* row = result.mutable_data();
    {
        const ReleaseGil released(count * legs, foot_cost);
        for (const double time : at.values()) {
            for (std::size_t leg = 0; leg < legs; ++leg) {
                write(self.foot(leg, time), row);
                row += std::max<py::ssize_t>(width, 1);
            }
        }
    }
    return result;
}

[[nodiscard]] DoubleArray vectors_at(const Walker& self, const ArrayLike& times,
                                     glm::dvec3 walker::Foot::*part) {
    return feet_at(self, times, 3, [&](const walker::Foot& foot, double* row) {
        for (int axis = 0; axis < 3; ++axis) row[axis] = (foot.*part)[axis];
    });
}

[[nodiscard]] Typed<"tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]"> body(
    const Walker& self, const ArrayLike& times) {
    const Numbers at(times, "times");
    const std::size_t count = at.values().size();
    DoubleArray offsets = at.is_single() ? new_array({3}) : new_array({count, 3});
    DoubleArray rotations = at.is_single() ? new_array({4}) : new_array({count, 4});
    const std::span<glm::dvec3> moved = points_of(offsets);
    const std::span<glm::dquat> turned = quaternions_in(rotations.mutable_data(), count);
    {
        const ReleaseGil released(count, body_cost);
        for (std::size_t i = 0; i < count; ++i) {
            const walker::Correction correction = self.body(at.values()[i]);
            moved[i] = correction.offset;
            turned[i] = correction.rotation;
        }
        rows_from_quaternions(turned);
    }
    return py::make_tuple(offsets, rotations);
}

[[nodiscard]] Typed<"dict[str, numpy.typing.NDArray[typing.Any]]"> steps(const Walker& self) {
    std::vector<int> legs, chosen;
    std::vector<double> lifts, touches, middles, planned;
    std::vector<glm::dquat> turns;
    std::vector<glm::dvec3> starts, ends, apexes;
    for (std::size_t leg = 0; leg < self.leg_count(); ++leg) {
        for (const walker::Footstep& step : self.steps(leg)) {
            legs.push_back(static_cast<int>(leg));
            lifts.push_back(step.lift);
            touches.push_back(step.touch);
            starts.push_back(step.start);
            ends.push_back(step.end);
            apexes.push_back(0.5 * (step.start + step.end) + step.rise);
            middles.push_back(step.middle);
            planned.push_back(step.planned);
            turns.push_back(step.end_turn);
            chosen.push_back(step.chosen ? static_cast<int>(*step.chosen) : -1);
        }
    }
    DoubleArray rotations = new_array({turns.size(), 4});
    const std::span<glm::dquat> rows = quaternions_in(rotations.mutable_data(), turns.size());
    std::ranges::copy(turns, rows.begin());
    rows_from_quaternions(rows);
    return py::dict("leg"_a = array_of(legs), "lift"_a = array_of(lifts), "touch"_a = array_of(touches),
                    "start"_a = to_array(starts), "end"_a = to_array(ends), "apex"_a = to_array(apexes),
                    "middle"_a = array_of(middles), "turn"_a = rotations, "chosen"_a = array_of(chosen),
                    "planned"_a = array_of(planned));
}

[[nodiscard]] std::string_view name_of(walker::Trouble trouble) {
    switch (trouble) {
        case walker::Trouble::no_ground:
            return "no_ground";
        case walker::Trouble::out_of_reach:
            return "out_of_reach";
        case walker::Trouble::no_length:
            return "no_length";
        case walker::Trouble::no_touch:
            return "no_touch";
        case walker::Trouble::no_lift:
            return "no_lift";
        case walker::Trouble::left_out:
            return "left_out";
    }
    return "";
}

[[nodiscard]] Typed<"list[tuple[int, float, float, str]]"> problems(const Walker& self) {
    py::list result;
    for (const walker::Problem& problem : self.problems())
        result.append(py::make_tuple(problem.leg, problem.first, problem.last, name_of(problem.trouble)));
    return result;
}

void bind_plan(py::module_& m) {
    py::class_<Walker>(m, "Walker", py::module_local(), R"(
The steps of legs that walk under a moving body, planned for a whole shot; any time afterwards is a look-up. Immutable.
Metres, seconds, radians, world space; rest, hips and up are in the body's space.

times (k,), s, strictly rising, 1 to 100,000; poses (k, 4, 4): the body's matrices, of any scale, also mirrored.
Between samples the body moves evenly; before the first sample it moves at its first velocity, or rests if that is slow;
after the last sample it rests. Sample once a frame.
rest (n, 3), 1 to 256 legs: where each foot stands when the body rests.  ground: a WalkerGround; None: feet stand on these
rest places.
phases (n,), duty, [0.05, 0.95]: as from walker_gait(): leg i swings while frac(phase + phases[i]) < 1 - duty.
stride, [1e-6, 1e6]: the most that the body moves while a foot stands, which is the duty's share of the way from touch to touch.
cadence, cycles/s, [0.001, 1000]: the slowest; the
cadence in use is max(cadence, duty * speed / stride) with the speed of the leg whose rest place moves fastest across `up`.
A foothold is the ground under the foot's rest place, along `up`, at the middle of its stand; so a foot is never further than
half a stride from its rest place. Steps of no length are left out: feet of a body at rest end on their rest places and stay.
clearance: height of a foot half-way through its swing above the ground under it, less in steps below a quarter of the stride.
reach_up, reach_down: height and depth about a rest place within which ground is searched.  minimum_step: shorter steps are
left out; all of these >= 0.  up: not zero.
hips (n, 3), lengths (n,), >= 0, in the world, of whole legs; both or None: footholds out of reach are replaced by places nearer
to the hip.  bodies (k, 4, 4) or None: how the body's own animation moves the hips in the body's space at the samples, before the
body follows its feet.  resets: rising indices of samples to which the body jumps, at which the plan begins anew, as
it does if a rest place moves further than `jump`, > 0, from one sample to the next; None: 4 strides, with
hip_height those of Froude number 1, 9.2 hip heights times the duty.
frequency, damping, response: the SecondOrder of the body's height and tilt, which follow the plane of its feet; height,
tilt, [0, 1]: share of each that the body follows.
forward: of the feet, in the body's space, of which the part across up counts.  ankle, >= 0: height of a foot's place above the ground under its
sole.  heel, toe, >= 0: how far behind and ahead of a foot's place its sole rolls.  strike, push, rad, [0, pi/2]: how much the toe
is up when a heel touches down, and the heel when a toe lifts; less in steps shorter than the stride, the other way round in
steps that go backwards.
chosen: footholds that are chosen by hand, tuples (leg, time, offset, turn, fixed, touch, until): of the stand of a leg at a time, s, or of the
swing before it, the rest place below which ground is looked for is moved by offset (3,), in the body's space, and the sole is
turned by turn, rad, about the ground's normal, counter-clockwise from above. fixed: None, or (place (3,), rotation (4,)), w, x,
y, z, of the foot with its flat sole, which stands there whatever body and ground do. touch, until: s, when the foot touches down
and when it lifts again, or None; the leg's steps before and after make room. Such footholds are never replaced by nearer ones; of
several for one stand the last one counts. time is as steps has it in 'planned', without any touch and until.
changes: of the gait over time, tuples (sample, phases (n,), duty) in the order of samples: from there on legs go over to this gait
within `transition` cycles, [1, 1000], each by half a cycle at most, while feet that stand stay.  strides, cadences, duties (k,) or
None: at the samples, in place of stride, cadence, and the duty of all gaits. A step has the stride and the duty of when it lifts.
hip_height, [0, 1e6]: above 0 feet stand for the duty's share of walker_natural_stride() at the body's speed, in place of stride.
Raises ValueError or TypeError that names the argument, also if more than 1,000,000 steps would be planned.)")
        .def(py::init(&walker_of), "times"_a, "poses"_a, "rest"_a, "ground"_a = py::none(), py::kw_only(),
             "phases"_a, "duty"_a = 0.5, "stride"_a = 0.5, "cadence"_a = 1.0, "clearance"_a = 0.1,
             "reach_up"_a = 0.5, "reach_down"_a = 1.0, "minimum_step"_a = 0.0,
             "up"_a = py::make_tuple(0.0, 0.0, 1.0), "hips"_a = py::none(), "lengths"_a = py::none(),
             "bodies"_a = py::none(), "resets"_a = py::none(), "jump"_a = py::none(), "frequency"_a = 2.0,
             "damping"_a = 1.0, "response"_a = 0.0, "height"_a = 1.0, "tilt"_a = 1.0,
             "forward"_a = py::make_tuple(0.0, 1.0, 0.0), "ankle"_a = 0.0, "heel"_a = 0.0, "toe"_a = 0.0,
             "strike"_a = 0.0, "push"_a = 0.0, "chosen"_a = py::none(), "changes"_a = py::none(),
             "transition"_a = 1.0, "strides"_a = py::none(), "cadences"_a = py::none(),
             "duties"_a = py::none(), "hip_height"_a = 0.0)
        .def(
            "feet",
            [](const Walker& self, const ArrayLike& times) {
                return vectors_at(self, times, &walker::Foot::position);
            },
            "times"_a, R"(
Positions of the feet at times, s, a number or (m,): (n, 3) or (m, n, 3). While a sole lies flat its position has the same bits.)")
        .def(
            "normals",
            [](const Walker& self, const ArrayLike& times) {
                return vectors_at(self, times, &walker::Foot::normal);
            },
            "times"_a, R"(
Unit normals of the ground under the feet, (n, 3) or (m, n, 3); during a swing they turn from one foothold's normal to the next.)")
        .def(
            "turns",
            [](const Walker& self, const ArrayLike& times) {
                return feet_at(self, times, 4, [](const walker::Foot& foot, double* row) {
                    row[0] = foot.turn.w;
                    for (int axis = 0; axis < 3; ++axis) row[axis + 1] = foot.turn[axis];
                });
            },
            "times"_a, R"(
Rotations of the soles from the body's space to the world, w, x, y, z, (n, 4) or (m, n, 4): flat on the ground, the heading that
of the body at the middle of the stand, rolled over heel and toe, or in a swing between.)")
        .def(
            "swing",
            [](const Walker& self, const ArrayLike& times) {
                return feet_at(self, times, 0,
                               [](const walker::Foot& foot, double* row) { *row = foot.swing; });
            },
            "times"_a, R"(
Fraction of the swing of each foot, 0 to 1, and 0 while it stands: (n,) or (m, n).)")
        .def("body", &body, "times"_a, R"(
How the body follows its feet at times: (offsets (3,) or (m, 3), rotations (4,) or (m, 4)), w, x, y, z. In the world it is
turned about its own origin, then moved.)")
        .def(
            "phase",
            [](const Walker& self, const ArrayLike& times) {
                return map_numbers(Numbers(times, "times"), phase_cost,
                                   [&](double time) { return self.phase(time); });
            },
            "times"_a, R"(
Cycles since the first sample or the last jump, at times: a float or (m,).)")
        .def_property_readonly("leg_count", &Walker::leg_count, "How many legs there are.")
        .def_property_readonly("steps", &steps, R"(
All steps by leg, then time, as a dict of arrays: leg (s,) int32; lift, touch (s,), s; start, end (s, 3); apex (s, 3), where the
foot is half-way; middle (s,), s, of the stand; turn (s, 4), w, x, y, z, of the flat sole on `end`; chosen (s,) int32: which of
`chosen` it follows, -1 for none; planned (s,), s: `middle` if none had a touch or until. If lift equals touch the foot is put there at once: at the first sample and at jumps.)")
        .def_property_readonly("problems", &problems, R"(
Problems with footholds, by leg, then time: tuples (leg, first, last, reason), s, with the reasons 'no_ground', where the
foot stands on its rest place, 'out_of_reach' of the hip, 'no_length' of a leg, 'no_touch' and 'no_lift' if a foot cannot touch
down or lift when `chosen` says, and 'left_out' if a chosen foothold has no step, since a timed one lasts beyond it.)")
        .def_property_readonly("settled", &Walker::settled, "When the last foot has come to rest, s.")
        .def_property_readonly("nbytes", &Walker::bytes, "Of the memory that it takes.");
}

}  // namespace

void bind_walker(py::module_& m) {
    m.def("walker_gait", &gait, "gait"_a, "rest"_a, "forward"_a = py::make_tuple(0.0, 1.0, 0.0),
          "up"_a = py::make_tuple(0.0, 0.0, 1.0), R"(
When the legs of a gait swing: (phases (n,), [0, 1), duty): leg i swings while frac(phase + phases[i]) < 1 - duty.

gait: 'tripod', neighbours alternate; 'tetrapod', neighbours alternate, and all stand for a moment in between: L1 R2 L3 R4 | R1 L2 R3 L4; 'ripple',
on each side from the back to the front, the sides about half a cycle apart; 'wave', one after the other; 'trot', the front
half of a side with the rear half of the other; 'pace', all left legs, then all right legs; 'walk', on each side from the
back to the front, the sides half a cycle apart; 'run', as a trot with all feet in the air in between; 'canter', three beats, the
left side leads; 'gallop', four beats, the left side leads; 'hop', all together.
rest (n, 3), 1 to 256 legs in any order: where feet stand when the body rests, in the space of forward and up (3,).
Raises ValueError or TypeError that names the argument.)");
    m.def(
        "walker_natural_stride",
        [](const ArrayLike& speeds, const Number& hip_height) {
            const double height = number(hip_height, "hip_height");
            return map_numbers(Numbers(speeds, "speeds"), phase_cost,
                               [&](double speed) { return walker::natural_stride(speed, height); });
        },
        "speeds"_a, "hip_height"_a, R"(
How far a body goes from a touch of a foot to the next touch of the same foot, m, as animals of all sizes have it: 2.3 h F^0.3
with the Froude number F = v^2 / (g h), of at least 0.001, and g = 9.81 m/s^2.

speeds: v, m/s, a number or (m,), hip_height: h, m, all from 0 to 1e12. Returns a float or (m,).
Raises ValueError or TypeError that names the argument.)");
    py::class_<Ground, std::shared_ptr<Ground>>(m, "WalkerGround", py::module_local(), R"(
The ground that feet stand on, on either side of its surfaces; it does not move. Immutable: made once, for any number of Walkers.

positions (v, 3), world space, of which vertices that are not finite are never met.  triangles (t, 3): indices of vertices,
counter-clockwise seen from outside: feet stay below a roof, a face whose normal points down into air.
plane (2, 3): a point of an endless plane and its normal. All may be None.
Raises ValueError or TypeError that names the argument.)")
        .def(py::init(&ground_of), "positions"_a = py::none(), "triangles"_a = py::none(),
             "plane"_a = py::none())
        .def(
            "with_plane",
            [](const Ground& self, const OptionalArrayLike& plane) {
                return std::make_shared<Ground>(self.with_plane(plane_argument(plane)));
            },
            "plane"_a, R"(
A ground that shares these triangles, with this plane (2, 3), or None, in place of its own.)")
        .def_property_readonly("vertex_count", &Ground::vertex_count, "How many vertices it has.")
        .def_property_readonly("triangle_count", &Ground::triangle_count, "How many triangles it has.")
        .def_property_readonly("nbytes", &Ground::bytes, "Of the memory that it takes, about.");
    bind_plan(m);
}

}  // namespace motus::bindings
